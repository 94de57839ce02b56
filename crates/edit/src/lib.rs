//! The one door to change: commands, document, history, gestures, scripts.

mod apply;
mod command;
mod editor;
mod files;
mod rejected;

pub use command::{At, By, Command, Goal, Hold};
pub use editor::{Document, Editor, Outcome, Request};
pub use files::{Files, NoFiles};
pub use rejected::Rejected;
