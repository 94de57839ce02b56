//! A display in memory (Xvfb), so that a window can be tested without a screen and without disturbing one.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};

use anyhow::{Context, Result, ensure};

/// The server picks a free number and writes it to descriptor 1. The shell lives until its standard
/// input closes, which happens when we end in whatever way, a kill included; then it ends the server.
const SERVE: &str = "\
Xvfb -displayfd 1 -screen 0 1400x900x24 -nolisten tcp 2>/dev/null & server=$!
exec >&-
read -r _
kill \"$server\" 2>/dev/null
wait \"$server\"";

/// A running display; it ends when dropped.
pub struct VirtualDisplay {
    shell: Child,
    name: String,
}

impl VirtualDisplay {
    /// Starts a display of 1400 by 900 pixels under a free number.
    ///
    /// # Errors
    /// Xvfb can't be started, or ends before it says its number.
    pub fn start() -> Result<VirtualDisplay> {
        let mut command = Command::new("sh");
        command.args(["-c", SERVE]).stdin(Stdio::piped()).stdout(Stdio::piped());
        // A group of its own: a Ctrl-C in the terminal ends us, and our end closes its input.
        #[cfg(unix)]
        std::os::unix::process::CommandExt::process_group(&mut command, 0);
        let mut shell = command.spawn().context("starting Xvfb")?;
        let mut number = String::new();
        let read = shell.stdout.take().map(|out| BufReader::new(out).read_line(&mut number));
        let display = VirtualDisplay { shell, name: format!(":{}", number.trim()) };
        read.transpose().context("reading the display's number from Xvfb")?;
        ensure!(display.name.len() > 1, "Xvfb ended before it opened a display");
        Ok(display)
    }

    /// The value for `DISPLAY`.
    pub fn name(&self) -> &str {
        &self.name
    }
}

impl Drop for VirtualDisplay {
    fn drop(&mut self) {
        drop(self.shell.stdin.take());
        let _ = self.shell.wait(); // Nothing is left to do if it has gone already.
    }
}

#[cfg(test)]
mod tests {
    use super::VirtualDisplay;
    use crate::machine::has_program;

    #[test]
    fn displays_are_apart_and_end_with_their_owners() {
        if !has_program("Xvfb") {
            return; // `cargo xtask test` says so.
        }
        let socket = |display: &VirtualDisplay| {
            std::path::Path::new("/tmp/.X11-unix").join(display.name().replace(':', "X"))
        };
        let one = VirtualDisplay::start().expect("a display");
        let two = VirtualDisplay::start().expect("a second display");
        let (of_one, of_two) = (socket(&one), socket(&two));
        assert_ne!(of_one, of_two);
        assert!(of_one.exists() && of_two.exists());
        drop(one);
        assert!(!of_one.exists() && of_two.exists());
        drop(two);
        assert!(!of_two.exists());
    }
}
