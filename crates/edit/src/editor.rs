//! The editor: the one door through which a document changes, with its history.

use std::sync::Arc;

use rig::{Evaluation, Figure, Pose};

use crate::apply::{Applied, apply};
use crate::{Command, Files, Rejected};

/// What is edited: the pose, and whether ranges hold.
#[derive(Clone, PartialEq, Debug)]
pub struct Document {
    /// The pose.
    pub pose: Pose,
    /// Whether joints stop at their ranges.
    pub ranges: bool,
}

/// What can be asked of the editor.
#[derive(Clone, PartialEq, Debug)]
pub enum Request {
    /// Applies a command as one step of history.
    Do(Command),
    /// Shows what a command would do: the first preview begins a gesture, each later one starts again
    /// from the gesture's first state.
    Preview(Command),
    /// As [`Request::Preview`] for commands that make one gesture together, one after another.
    PreviewAll(Vec<Command>),
    /// Ends the gesture under way as one step of history.
    Commit,
    /// Ends the gesture under way as if it had never been.
    Cancel,
    /// Takes back the last step, or cancels the gesture under way.
    Undo,
    /// Does the step again that was last taken back.
    Redo,
    /// Replaces the pose, as one step of history.
    Open(Box<Pose>),
}

/// What a request did.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Outcome {
    /// One sentence for the status line.
    pub message: String,
    /// Whether a range, reach or contact stopped the command short.
    pub clamped: bool,
    /// Limbs whose goal was not met: how far their articulator is from it, metres.
    pub missed: Vec<(rig::Limb, f64)>,
}

/// A step of history: the document before it, and its name.
#[derive(Clone, Debug)]
struct Step {
    document: Document,
    name: String,
}

/// The document, its history and the gesture under way.
#[derive(Clone, Debug)]
pub struct Editor {
    figure: Arc<Figure>,
    document: Document,
    evaluation: Evaluation,
    past: Vec<Step>,
    future: Vec<Step>,
    gesture: Option<Step>,
    revision: u64,
}

impl Editor {
    /// An editor with the figure at rest and every limb free.
    pub fn new(figure: Arc<Figure>) -> Editor {
        let document = Document { pose: figure.rest_pose(), ranges: true };
        let evaluation = rig::evaluate(&figure, &document.pose, document.ranges);
        Editor {
            figure,
            document,
            evaluation,
            past: Vec::new(),
            future: Vec::new(),
            gesture: None,
            revision: 0,
        }
    }

    /// An editor with the figure in a pose, and nothing to undo.
    pub fn in_pose(figure: Arc<Figure>, pose: Pose) -> Editor {
        let document = Document { pose, ranges: true };
        let evaluation = rig::evaluate(&figure, &document.pose, document.ranges);
        Editor { document, evaluation, ..Editor::new(figure) }
    }

    /// The figure.
    pub fn figure(&self) -> &Arc<Figure> {
        &self.figure
    }

    /// The document as it shows now, a gesture's preview included.
    pub fn document(&self) -> &Document {
        &self.document
    }

    /// The pose as it shows now.
    pub fn pose(&self) -> &Pose {
        &self.document.pose
    }

    /// What the pose comes to.
    pub fn evaluation(&self) -> &Evaluation {
        &self.evaluation
    }

    /// Changes whenever the document does: what is derived from the document is good for one revision.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Whether a gesture is under way.
    pub fn in_gesture(&self) -> bool {
        self.gesture.is_some()
    }

    /// The name of the step that undo would take back.
    pub fn undo_name(&self) -> Option<&str> {
        self.past.last().map(|step| step.name.as_str())
    }

    /// The name of the step that redo would do again.
    pub fn redo_name(&self) -> Option<&str> {
        self.future.last().map(|step| step.name.as_str())
    }

    /// The number of steps that undo can take back.
    pub fn undo_depth(&self) -> usize {
        self.past.len()
    }

    /// Does what is asked, or leaves the document bit for bit as it was.
    ///
    /// # Errors
    /// What was asked can't be done: why, and what is allowed.
    pub fn submit(&mut self, request: Request, files: &mut dyn Files) -> Result<Outcome, Rejected> {
        match request {
            Request::Do(command) => self.run(&command, files),
            Request::Preview(command) => self.preview(&[command], files),
            Request::PreviewAll(commands) => self.preview(&commands, files),
            Request::Commit => Ok(self.commit()),
            Request::Cancel => Ok(self.cancel()),
            Request::Undo => Ok(self.undo()),
            Request::Redo => Ok(self.redo()),
            Request::Open(pose) => Ok(self.open(*pose)),
        }
    }

    fn run(&mut self, command: &Command, files: &mut dyn Files) -> Result<Outcome, Rejected> {
        let Applied { document, outcome } = apply(&self.figure, &self.document, command, files)?;
        self.commit();
        let name = command.name().to_owned();
        self.push(Step { document: self.document.clone(), name });
        self.show(document);
        Ok(outcome)
    }

    fn preview(&mut self, commands: &[Command], files: &mut dyn Files) -> Result<Outcome, Rejected> {
        let Some(last) = commands.last() else { return Ok(Outcome::default()) };
        let first = self.gesture.as_ref().map_or(&self.document, |step| &step.document);
        let mut document = first.clone();
        let mut outcome = Outcome::default();
        for command in commands {
            let applied = apply(&self.figure, &document, command, files)?;
            let clamped = outcome.clamped || applied.outcome.clamped;
            (document, outcome) = (applied.document, Outcome { clamped, ..applied.outcome });
        }
        if self.gesture.is_none() {
            self.gesture = Some(Step { document: self.document.clone(), name: last.name().to_owned() });
        }
        self.show(document);
        Ok(outcome)
    }

    fn commit(&mut self) -> Outcome {
        if let Some(step) = self.gesture.take().filter(|step| step.document != self.document) {
            self.push(step);
        }
        Outcome::default()
    }

    fn cancel(&mut self) -> Outcome {
        match self.gesture.take() {
            Some(step) => {
                self.show(step.document);
                Outcome { message: format!("{} cancelled", step.name), ..Outcome::default() }
            }
            None => Outcome::default(),
        }
    }

    fn undo(&mut self) -> Outcome {
        if self.gesture.is_some() {
            return self.cancel();
        }
        let Some(step) = self.past.pop() else {
            return Outcome { message: "Nothing to undo".to_owned(), ..Outcome::default() };
        };
        let message = format!("Undid: {}", step.name);
        self.future.push(Step { document: self.document.clone(), name: step.name });
        self.show(step.document);
        Outcome { message, ..Outcome::default() }
    }

    fn redo(&mut self) -> Outcome {
        self.commit();
        let Some(step) = self.future.pop() else {
            return Outcome { message: "Nothing to redo".to_owned(), ..Outcome::default() };
        };
        let message = format!("Redid: {}", step.name);
        self.past.push(Step { document: self.document.clone(), name: step.name });
        self.show(step.document);
        Outcome { message, ..Outcome::default() }
    }

    fn open(&mut self, pose: Pose) -> Outcome {
        self.commit();
        self.push(Step { document: self.document.clone(), name: "Open".to_owned() });
        self.show(Document { pose, ..self.document });
        Outcome { message: "Opened".to_owned(), ..Outcome::default() }
    }

    fn push(&mut self, step: Step) {
        self.past.push(step);
        self.future.clear();
    }

    fn show(&mut self, document: Document) {
        self.evaluation = rig::evaluate(&self.figure, &document.pose, document.ranges);
        self.document = document;
        self.revision += 1;
    }
}
