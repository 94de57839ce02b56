//! The editor of a chain: the one door through which it changes, with its history.

use std::sync::Arc;

use rig::{Frame, Robot, RobotPose};

use super::apply::apply;
use super::command::ChainCommand;
use super::document::{ChainDocument, ChainOutcome};
use crate::Rejected;
use crate::history::{Back, History};

/// What can be asked of the editor of a chain. Gestures are as those of [`crate::Request`].
#[derive(Clone, PartialEq, Debug)]
pub enum ChainRequest {
    /// Applies a command as one step of history.
    Do(ChainCommand),
    /// Shows what a command would do: the first preview begins a gesture, each later one starts again from the gesture's first
    /// state.
    Preview(ChainCommand),
    /// As [`ChainRequest::Preview`], but each goes on from the one before: for keys that drive a joint as long as they are held.
    Drive(ChainCommand),
    /// Ends the gesture under way as one step of history.
    Commit,
    /// Ends the gesture under way as if it had never been.
    Cancel,
    /// Takes back the last step, or cancels the gesture under way.
    Undo,
    /// Does the step again that was last taken back.
    Redo,
}

/// A chain, its history and the gesture under way.
#[derive(Clone, Debug)]
pub struct ChainEditor {
    document: ChainDocument,
    frames: Vec<Frame>,
    history: History<ChainDocument>,
    revision: u64,
}

impl ChainEditor {
    /// An editor with a chain in a pose, and nothing to undo.
    pub fn new(robot: Arc<Robot>, pose: &RobotPose) -> ChainEditor {
        ChainEditor::of(ChainDocument::of(robot, pose))
    }

    /// An editor of a document, and nothing to undo.
    pub fn of(document: ChainDocument) -> ChainEditor {
        ChainEditor { frames: document.frames(), document, history: History::default(), revision: 0 }
    }

    /// The document as it shows now, a gesture's preview included.
    pub fn document(&self) -> &ChainDocument {
        &self.document
    }

    /// The document from which the gesture under way starts, or as it shows now.
    pub fn first(&self) -> &ChainDocument {
        self.history.gesture().map_or(&self.document, |step| &step.document)
    }

    /// The chain.
    pub fn robot(&self) -> &Arc<Robot> {
        &self.document.robot
    }

    /// Where each link is in the world.
    pub fn frames(&self) -> &[Frame] {
        &self.frames
    }

    /// Changes whenever the document does.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Whether a gesture is under way.
    pub fn in_gesture(&self) -> bool {
        self.history.gesture().is_some()
    }

    /// The name of the step that undo would take back.
    pub fn undo_name(&self) -> Option<&str> {
        self.history.undo_name()
    }

    /// The name of the step that redo would do again.
    pub fn redo_name(&self) -> Option<&str> {
        self.history.redo_name()
    }

    /// The number of steps that undo can take back.
    pub fn undo_depth(&self) -> usize {
        self.history.depth()
    }

    /// Does what is asked, or leaves the chain bit for bit as it was.
    ///
    /// # Errors
    /// What was asked can't be done: why, and what is allowed.
    pub fn submit(&mut self, request: ChainRequest) -> Result<ChainOutcome, Rejected> {
        match request {
            ChainRequest::Do(command) => {
                let (document, outcome) = apply(&self.document, &command)?;
                self.history.step(&self.document, command.name());
                self.show(document);
                Ok(outcome)
            }
            ChainRequest::Preview(command) => {
                let (document, outcome) = apply(self.first(), &command)?;
                self.history.begin(&self.document, command.name());
                self.show(document);
                Ok(outcome)
            }
            ChainRequest::Drive(command) => {
                let (document, outcome) = apply(&self.document, &command)?;
                self.history.begin(&self.document, command.name());
                self.show(document);
                Ok(outcome)
            }
            ChainRequest::Commit => {
                self.history.commit(&self.document);
                Ok(ChainOutcome::default())
            }
            ChainRequest::Cancel => {
                let back = self.history.cancel();
                Ok(self.back(back))
            }
            ChainRequest::Undo => {
                let back = self.history.undo(&self.document);
                Ok(self.back(back))
            }
            ChainRequest::Redo => {
                let back = self.history.redo(&self.document);
                Ok(self.back(back))
            }
        }
    }

    /// Shows what the history gives back.
    fn back(&mut self, back: Back<ChainDocument>) -> ChainOutcome {
        if let Some(document) = back.document {
            self.show(document);
        }
        told(back.message)
    }

    fn show(&mut self, document: ChainDocument) {
        self.frames = document.frames();
        self.document = document;
        self.revision += 1;
    }
}

fn told(message: String) -> ChainOutcome {
    ChainOutcome { message, ..ChainOutcome::default() }
}
