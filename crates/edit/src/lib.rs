//! The one door to change: commands, document, history, gestures, scripts.

mod apply;
mod command;
mod drag;
mod editor;
mod files;
mod grab;
mod pick;
mod rejected;
mod report;
mod script;
mod snap;
mod selection;
mod telling;

pub use command::{At, By, Command, Goal, Hold};
pub use drag::{Axis, Constraint, Drag, Modifiers};
pub use editor::{Document, Editor, Outcome, Request};
pub use files::{Files, NoFiles};
pub use grab::{Grab, Handle};
pub use pick::{Hit, Near, SkinPicker};
pub use rejected::Rejected;
pub use report::{JointReport, LimbReport, Report};
pub use script::{SCRIPT_VERSION, Script, parse_script, run_script};
pub use snap::{Snap, Surfaces, nearest_space};
pub use selection::{Choose, Selection};
