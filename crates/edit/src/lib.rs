//! The one door to change: commands, document, history, gestures, scripts.

mod command;

pub use command::{At, By, Command, Goal, Hold};
