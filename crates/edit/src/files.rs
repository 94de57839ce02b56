//! The outside world, as far as commands need it.

/// Reads the files that commands name. The program reads the disk; tests read from memory.
pub trait Files {
    /// The text of a file.
    ///
    /// # Errors
    /// One sentence why it can't be read.
    fn read(&mut self, path: &str) -> Result<String, String>;
}

/// A world without files: every read fails.
#[derive(Clone, Copy, Debug)]
pub struct NoFiles;

impl Files for NoFiles {
    fn read(&mut self, path: &str) -> Result<String, String> {
        Err(format!("{path}: no files can be read here"))
    }
}
