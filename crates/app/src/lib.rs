//! Posewright, the program: command line, window and disk around the crates that do the work.

mod action;
mod choosing;
pub mod cli;
mod dialogs;
pub mod disk;
pub mod failure;
mod finish;
pub mod keepsafe;
mod keycap;
mod keymap;
pub mod labels;
pub mod library;
pub mod load;
mod number;
mod painter;
mod panels;
pub mod picture;
mod rail;
mod reaching;
mod session;
mod settings;
mod sign;
mod status_line;
mod theme;
mod toolbar;
mod viewport;
pub mod window;

pub use action::{Action, Group};
pub use finish::Finish;
pub use keymap::{Chord, Keymap};
pub use panels::{Overview, Panels, Section};
pub use session::{Session, Status};
pub use settings::{ConfigFolder, Look, Settings};
pub use theme::apply as apply_theme;
pub use viewport::{Guide, Guides, Viewport, install as install_picture};
