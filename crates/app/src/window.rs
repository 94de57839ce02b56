//! The window: its event loop, and the same window drawn without a display.

mod desk;
mod display;
mod frames;
mod offscreen;
mod screen;
mod showing;
mod ui_map;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use edit::Editor;
use rig::Figure;

use crate::failure::Failure;
use crate::load::{self, Kind};
use crate::session::{MANNEQUIN, Session};

use desk::Desk;
pub use offscreen::{chain_ui_picture, session_picture, ui_picture};
pub use showing::Showing;

/// Opens the window on files and returns when it is closed.
///
/// Without a file the figure stands relaxed. A figure file brings the figure, another file its pose; a chain or a robot has the
/// window for itself.
/// With `ui_map` the place of every labelled control is written there after each frame.
///
/// # Errors
/// No display or no adapter, with the cure; files at fault.
pub fn run(files: &[PathBuf], ui_map: Option<&Path>) -> Result<(), Failure> {
    frames::run(desk(files)?.of_user(), ui_map.map(Path::to_owned))
}

/// The desk that a command line asks for.
fn desk(files: &[PathBuf]) -> Result<Desk, Failure> {
    for path in files {
        if let Some(desk) = Desk::of_chain(path)? {
            return match files {
                [_] => Ok(desk),
                _ => {
                    let message = format!("{}: a chain can't be open beside another file", path.display());
                    Err(Failure::Usage(message))
                }
            };
        }
    }
    session(files).map(|session| Desk::Figure(Box::new(session)))
}

/// The session that a command line asks for.
fn session(files: &[PathBuf]) -> Result<Session, Failure> {
    let mut figure = None;
    let mut shown = None;
    for path in files {
        let place = if Kind::of(path)? == Kind::Figure { &mut figure } else { &mut shown };
        if let Some(former) = place.replace(path) {
            let message = format!("{} and {}: only one can be open", former.display(), path.display());
            return Err(Failure::Usage(message));
        }
    }
    let file = figure.cloned().unwrap_or_else(|| PathBuf::from(MANNEQUIN));
    let mut session = posed(load::figure(figure.map(PathBuf::as_path))?, shown)?;
    session.figure_from(file);
    Ok(session)
}

/// The session of a figure in a file's pose, else standing.
fn posed(figure: Arc<Figure>, shown: Option<&PathBuf>) -> Result<Session, Failure> {
    let Some(path) = shown else {
        let pose = load::standing(&figure);
        return Ok(Session::new(Editor::in_pose(figure, pose), None));
    };
    if Kind::of(path)? == Kind::Pose {
        let pose = load::pose(&figure, path)?;
        return Ok(Session::new(Editor::in_pose(figure, pose), Some(path.clone())));
    }
    if Kind::of(path)? == Kind::Clip {
        let message = "the window doesn't play clips yet; `posewright render` draws their frames";
        return Err(Failure::Input(format!("{}: {message}", path.display())));
    }
    load::editor(&figure, path).map(|editor| Session::new(editor, None))
}
