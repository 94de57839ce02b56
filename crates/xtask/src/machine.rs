//! What the machine must have: system packages of Debian and Ubuntu, looked for and, where we may, installed.

use std::path::Path;
use std::process::{Command, Output, Stdio};

/// Drawing and opening a window: Vulkan in software for machines without a graphics card, and the X
/// libraries that the window loads when it starts.
pub const WINDOW: &[&str] = &["mesa-vulkan-drivers", "libxcursor1", "libxi6", "libxkbcommon-x11-0"];

/// Driving a window on a display of its own.
pub const WINDOW_TEST: &[&str] = &["xvfb", "xdotool", "x11-utils", "imagemagick"];

/// Installs what is missing; says in one line what to type where that is not permitted or fails.
///
/// Quiet where nothing is missing and on systems without `dpkg-query` and `apt-get`.
pub fn prepare(packages: &[&str]) {
    if !has_program("apt-get") {
        return;
    }
    let Some(missing) = missing(packages) else { return };
    if missing.is_empty() {
        return;
    }
    let by_hand =
        format!("sudo apt-get update && sudo apt-get install --no-install-recommends {}", missing.join(" "));
    let Some(prefix) = privilege() else {
        eprintln!("Some system packages are missing. Please type:\n    {by_hand}");
        return;
    };
    println!("Installing {} …", missing.join(" "));
    if let Err(reason) = install(prefix, &missing) {
        eprintln!("That did not work:\n{}\nPlease type:\n    {by_hand}", reason.trim_end());
    }
}

/// Whether a program of that name lies on the PATH.
pub fn has_program(name: &str) -> bool {
    std::env::var_os("PATH")
        .is_some_and(|path| std::env::split_paths(&path).any(|dir| dir.join(name).is_file()))
}

/// Whether Mesa's software Vulkan driver is registered with the loader.
pub fn has_software_vulkan() -> bool {
    ["/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d"].iter().any(|folder| {
        let files = Path::new(folder).read_dir().into_iter().flatten().flatten();
        files.map(|file| file.file_name()).any(|name| name.to_string_lossy().starts_with("lvp_icd"))
    })
}

/// Those of the packages that dpkg doesn't list as installed; `None` without dpkg.
fn missing<'a>(packages: &[&'a str]) -> Option<Vec<&'a str>> {
    // The exit code is 1 when any package is unknown; the list is right all the same.
    let query = Command::new("dpkg-query")
        .args(["--show", "--showformat=${Package} ${db:Status-Status}\\n"])
        .args(packages)
        .stderr(Stdio::null())
        .output()
        .ok()?;
    Some(absent(packages, &String::from_utf8_lossy(&query.stdout)))
}

/// Those of the packages that have no `NAME installed` line in the list.
fn absent<'a>(packages: &[&'a str], list: &str) -> Vec<&'a str> {
    let installed = |package: &str| list.lines().any(|line| line == format!("{package} installed"));
    packages.iter().copied().filter(|package| !installed(package)).collect()
}

/// What to put before a command so that it runs as root without asking; `None` if there is no way.
fn privilege() -> Option<&'static [&'static str]> {
    let answers = |program: &str, args: &[&str]| {
        let output = Command::new(program).args(args).stderr(Stdio::null()).output().ok()?;
        output.status.success().then_some(output.stdout)
    };
    if answers("id", &["-u"]).is_some_and(|id| id.trim_ascii() == b"0") {
        return Some(&["env"]);
    }
    answers("sudo", &["-n", "true"]).map(|_| ["sudo", "-n", "env"].as_slice())
}

/// Updates the package lists and installs; the error is what apt said.
fn install(prefix: &[&str], packages: &[&str]) -> Result<(), String> {
    let apt = |args: &[&str]| -> std::io::Result<Output> {
        Command::new(prefix[0])
            .args(&prefix[1..])
            .args(["DEBIAN_FRONTEND=noninteractive", "apt-get", "-qq", "-o", "DPkg::Lock::Timeout=120"])
            .args(args)
            .stdin(Stdio::null())
            .output()
    };
    let _ = apt(&["update"]); // Lists from earlier may do: whether they do, the installation tells.
    let output = apt(&[&["install", "--yes", "--no-install-recommends"], packages].concat());
    let output = output.map_err(|error| error.to_string())?;
    if output.status.success() { Ok(()) } else { Err(String::from_utf8_lossy(&output.stderr).into_owned()) }
}

#[cfg(test)]
mod tests {
    use super::absent;

    #[test]
    fn only_installed_packages_count_as_present() {
        let list = "xvfb installed\nxdotool config-files\nlibxi6-dev installed\n";
        assert_eq!(
            absent(&["xvfb", "xdotool", "libxi6", "imagemagick"], list),
            ["xdotool", "libxi6", "imagemagick"]
        );
        assert!(absent(&["xvfb"], list).is_empty());
    }
}
