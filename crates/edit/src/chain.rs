//! Chains and robots: their commands, document, history, scripts and reports, beside those of figures.

mod apply;
mod command;
mod document;
mod editor;
mod handle;
mod hands;
mod node;
mod pick;
mod report;
mod script;
mod span;

pub use command::{ChainCommand, ChainGoal, ChainPart, ChainRoot, ChainSolver};
pub use document::{ChainDocument, ChainOutcome, ChainReach};
pub use editor::{ChainEditor, ChainRequest};
pub use handle::{ChainHandle, ChainShape, ChainTrack, chain_axis, chain_handles};
pub use hands::{ChainHands, ChainSpot, ChainStage};
pub use node::ChainNode;
pub use pick::{LinkHit, LinkPicker};
pub use report::{ChainJointReport, ChainLinkReport, ChainReport, ReachReport};
pub use script::{ChainScript, chain_of_script, parse_chain_script, run_chain_script};
pub use span::{ChainSpan, chain_span};
