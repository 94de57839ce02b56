//! Chains and robots: their commands, document, history, scripts and reports, beside those of figures.

mod apply;
mod command;
mod document;
mod editor;
mod report;
mod script;

pub use command::{ChainCommand, ChainGoal, ChainPart, ChainRoot, ChainSolver};
pub use document::{ChainDocument, ChainOutcome, ChainReach};
pub use editor::{ChainEditor, ChainRequest};
pub use report::{ChainJointReport, ChainLinkReport, ChainReport, ReachReport};
pub use script::{ChainScript, chain_of_script, parse_chain_script, run_chain_script};
