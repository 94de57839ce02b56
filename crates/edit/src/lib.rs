//! The one door to change: commands, document, history, gestures, scripts.

mod apply;
mod chain;
mod circle;
mod clay;
mod clear;
mod clipboard;
mod command;
mod document;
mod drag;
mod drive;
mod editor;
mod elevation;
mod files;
mod fingers;
mod gaze;
mod grab;
mod hands;
mod hands_telling;
mod held;
mod history;
mod knob;
mod marked_joints;
mod navigate;
mod pick;
mod rejected;
mod report;
mod ring;
mod script;
mod selection;
mod sight;
mod skin;
mod snap;
mod spot;
mod swivel;
mod symmetry;
mod telling;
mod typed;

pub use chain::{
    ChainCommand, ChainDocument, ChainEditor, ChainGoal, ChainHandle, ChainHands, ChainJointReport,
    ChainLinkReport, ChainNode, ChainOutcome, ChainPart, ChainReach, ChainReport, ChainRequest, ChainRoot,
    ChainScript, ChainShape, ChainSolver, ChainSpan, ChainSpot, ChainStage, ChainTrack, LinkHit, LinkPicker,
    ReachReport, chain_axis, chain_handles, chain_of_script, chain_span, parse_chain_script,
    run_chain_script,
};
pub use circle::{Circle, NearCircle};
pub use clay::Clay;
pub use clear::{clear_place, to_rest};
pub use clipboard::{copy, copy_parts};
pub use command::{At, By, Command, Goal, Hold};
pub use document::{Document, Outcome};
pub use drag::{Axis, Constraint, Drag, Modifiers};
pub use drive::{DRIVE_FRAMES_PER_SEC, Drive, DriveLaw, Push};
pub use editor::{Editor, Request};
pub use elevation::elevation_circle;
pub use files::{Files, NoFiles};
pub use fingers::{Finger, curl, set_curl, set_spread, spread};
pub use gaze::{eye_point, eyes, gaze_point, set_eyes};
pub use grab::{Grab, Handle};
pub use hands::{Event, Hands, Reaction, Stage};
pub use hands_telling::{Turned, Words};
pub use knob::{Knob, Placed, Shape};
pub use marked_joints::marked_joints;
pub use navigate::{Button, Keys, Motion, Navigator, Preset, Step, ViewEvent};
pub use pick::{Hit, Near, SkinPicker};
pub use rejected::Rejected;
pub use report::{JointReport, LimbReport, Report};
pub use ring::axis;
pub use script::{SCRIPT_VERSION, Script, parse_script, run_script};
pub use selection::{Choose, Selection};
pub use sight::Sight;
pub use skin::PosedSkin;
pub use snap::{Snap, Surfaces, nearest_space};
pub use spot::{Mark, Spot};
pub use symmetry::mirrored;
pub use typed::Typed;
