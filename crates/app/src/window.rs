//! The window. (Signatures that the command line calls; the window's author fills them in.)

use std::path::{Path, PathBuf};

use edit::Editor;
use render::Image;

use crate::failure::Failure;
use crate::picture::Shot;

/// Opens the window on files and returns when it is closed.
///
/// # Errors
/// No display or no adapter, with the cure; files at fault.
pub fn run(_files: &[PathBuf], _ui_map: Option<&Path>) -> Result<(), Failure> {
    Err(Failure::NoScreen("no window yet".to_owned()))
}

/// Draws the whole window, panels included, without a display.
///
/// # Errors
/// No adapter.
pub fn ui_picture(_editor: &Editor, _file: &Path, _shot: &Shot) -> Result<Image, Failure> {
    Err(Failure::NoScreen("no window yet".to_owned()))
}
