//! Opening the program, or, where no window can open, rendering the sample poses with it.

use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, ensure};

use crate::machine;
use crate::stages::cargo;

/// `cargo xtask run`: builds in release and starts the program with the arguments.
///
/// Without arguments and without a display it renders the sample poses instead.
///
/// # Errors
/// The build or the program fails.
pub fn run(args: &[String]) -> Result<()> {
    machine::prepare(machine::WINDOW);
    let built = cargo(["build", "--release", "--package", "app", "--bin", "posewright"]).status();
    ensure!(built.context("starting cargo")?.success(), "the program can't be built");
    let args = args.strip_prefix(&["--".to_owned()][..]).unwrap_or(args);
    if args.is_empty() && !has_display() {
        return render_samples();
    }
    let status = posewright().args(args).status().context("starting cargo")?;
    ensure!(status.success(), "posewright ended with {status}");
    Ok(())
}

/// The program as it was built.
fn posewright() -> Command {
    cargo(["run", "--quiet", "--release", "--package", "app", "--bin", "posewright", "--"])
}

/// Whether a window can open as far as the environment tells.
fn has_display() -> bool {
    let named = |name| std::env::var_os(name).is_some_and(|value| !value.is_empty());
    cfg!(any(windows, target_os = "macos"))
        || ["DISPLAY", "WAYLAND_DISPLAY", "WAYLAND_SOCKET"].iter().any(named)
}

/// Renders each sample pose to a picture and says where they are.
fn render_samples() -> Result<()> {
    println!("There is no display: rendering the sample poses instead.");
    let folder = target_folder().join("pictures");
    std::fs::create_dir_all(&folder).with_context(|| format!("making the folder {}", folder.display()))?;
    let poses = sample_poses()?;
    for pose in &poses {
        let name = pose.file_name().unwrap_or_default().to_string_lossy();
        let picture = folder.join(name.replace(".pose.ron", ".png"));
        let status = posewright().arg("render").arg(pose).arg("-o").arg(&picture).status()?;
        ensure!(status.success(), "rendering {name} ended with {status}");
    }
    println!("{} pictures are in {}", poses.len(), folder.display());
    Ok(())
}

/// The `.pose.ron` files of `assets/poses`, by name.
fn sample_poses() -> Result<Vec<PathBuf>> {
    let folder = crate::root().join("assets").join("poses");
    let entries = folder.read_dir().with_context(|| format!("reading the folder {}", folder.display()))?;
    let mut poses: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    poses.retain(|path| path.to_string_lossy().ends_with(".pose.ron"));
    poses.sort();
    ensure!(!poses.is_empty(), "there are no poses in {}", folder.display());
    Ok(poses)
}

/// Cargo's target folder, which holds this program in a folder of its profile.
fn target_folder() -> PathBuf {
    let program = std::env::current_exe().ok();
    let folder = program.as_deref().and_then(Path::parent).and_then(Path::parent);
    folder.map_or_else(|| crate::root().join("target"), Path::to_owned)
}
