//! Stages of a check: each is one command, timed, and the first that fails ends the run.

use std::ffi::OsStr;
use std::process::Command;
use std::time::{Duration, Instant};

use anyhow::{Context, Result, ensure};

/// The stages that ran, with the time that each took.
#[derive(Default)]
pub struct Stages {
    done: Vec<(&'static str, Duration)>,
}

impl Stages {
    /// Runs a stage to its end, its output going straight to the terminal.
    ///
    /// # Errors
    /// The command can't be started or ends with anything but success.
    pub fn run(&mut self, name: &'static str, command: &mut Command) -> Result<()> {
        println!("== {name}");
        let start = Instant::now();
        let status = command.status().with_context(|| format!("{name}: starting {}", line(command)))?;
        self.done.push((name, start.elapsed()));
        ensure!(status.success(), "{name} failed ({status}): {}", line(command));
        Ok(())
    }
}

impl Drop for Stages {
    /// Prints the times, of a run that failed as well.
    fn drop(&mut self) {
        println!();
        for (name, time) in &self.done {
            println!("{:8.1} s  {name}", time.as_secs_f64());
        }
        let total: Duration = self.done.iter().map(|(_, time)| *time).sum();
        println!("{:8.1} s  in all", total.as_secs_f64());
    }
}

/// Cargo, as it called us, in the project's top folder.
pub fn cargo<A: AsRef<OsStr>>(args: impl IntoIterator<Item = A>) -> Command {
    let mut command = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command.current_dir(crate::root()).args(args);
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        // Without it Mesa prints a harmless "error:" for every picture.
        command.env("XDG_RUNTIME_DIR", std::env::temp_dir());
    }
    command
}

/// A command as one would type it.
fn line(command: &Command) -> String {
    let words = std::iter::once(command.get_program()).chain(command.get_args());
    words.map(OsStr::to_string_lossy).collect::<Vec<_>>().join(" ")
}
