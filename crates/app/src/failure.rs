//! How a command line ends badly: what is said, and with which exit code.

use std::process::ExitCode;

/// Why the program stops. Each prints one message.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Failure {
    /// The input is at fault: exit code 1.
    #[error("{0}")]
    Input(String),
    /// The command line is at fault: exit code 2.
    #[error("{0}")]
    Usage(String),
    /// There is no display for a window, or no graphics adapter: exit code 3. The message names the cure.
    #[error("{0}")]
    NoScreen(String),
    /// The user stopped it: exit code 130, as shells have it for Ctrl+C.
    #[error("stopped")]
    Stopped,
}

impl From<render::DrawError> for Failure {
    fn from(error: render::DrawError) -> Failure {
        Failure::Input(error.to_string())
    }
}

impl Failure {
    /// The exit code.
    pub fn code(&self) -> ExitCode {
        ExitCode::from(match self {
            Failure::Input(_) => 1,
            Failure::Usage(_) => 2,
            Failure::NoScreen(_) => 3,
            Failure::Stopped => 130,
        })
    }
}
