//! The editor: the one door through which a document changes, with its history.

use std::sync::Arc;

use rig::{Body, Bone, Evaluation, Figure, Locks, Mechanics, Pose};

use crate::apply::{Applied, apply, paste};
use crate::history::{Back, History};
use crate::symmetry::twin_of;
use crate::telling::words;
use crate::{Clay, Command, Document, Files, Outcome, Rejected};

/// What can be asked of the editor.
#[derive(Clone, PartialEq, Debug)]
pub enum Request {
    /// Applies a command as one step of history.
    Do(Command),
    /// Shows what a command would do: the first preview begins a gesture, each later one starts again
    /// from the gesture's first state.
    Preview(Command),
    /// As [`Request::Preview`] for commands that make one gesture together, one after another; none of them shows the
    /// gesture's first state.
    PreviewAll(Vec<Command>),
    /// Ends the gesture under way as one step of history.
    Commit,
    /// Ends the gesture under way as if it had never been.
    Cancel,
    /// Takes back the last step, or cancels the gesture under way.
    Undo,
    /// Does the step again that was last taken back.
    Redo,
    /// Replaces the pose, as one step of history. Locked joints take the new angles and keep those.
    Open(Box<Pose>),
    /// Shows another pose within the gesture under way, or begins one of that name: what solves the whole pose at once.
    PreviewPose {
        /// The pose.
        pose: Box<Pose>,
        /// What the step is called, unless a gesture is under way.
        name: &'static str,
    },
    /// Applies what the text of a pose file names, or its mirror image, as one step of history.
    Paste {
        /// The text; that of any pose file will do.
        text: String,
        /// Whether left and right change sides.
        mirrored: bool,
    },
    /// Sets what gestures bring along, as one step of history.
    Mechanics(Mechanics),
    /// Locks or unlocks joints, as one step of history; their twins, too, while symmetry is on.
    Lock(Locks, bool),
    /// Switches live symmetry, as one step of history.
    Symmetry(bool),
    /// Makes the figure over to a body, as one step of history; the pose is fitted to it.
    Body(Body),
    /// Shows what a body would come to, as a gesture; the pose is fitted from the gesture's first state.
    PreviewBody(Body),
}

/// The name of the steps that change the body.
const BODY: &str = "Body";

/// The document, its history and the gesture under way.
#[derive(Clone, Debug)]
pub struct Editor {
    figure: Arc<Figure>,
    /// What the figure is made of, once its body may be changed.
    clay: Option<Arc<Clay>>,
    /// The figure as it was when the gesture under way began, where that changes the body.
    former: Option<Arc<Figure>>,
    document: Document,
    evaluation: Evaluation,
    history: History<Document>,
    revision: u64,
}

impl Editor {
    /// An editor with the figure at rest and every limb free.
    pub fn new(figure: Arc<Figure>) -> Editor {
        let document = Document::of(figure.rest_pose());
        let evaluation = document.evaluated(&figure);
        Editor {
            figure,
            clay: None,
            former: None,
            document,
            evaluation,
            history: History::default(),
            revision: 0,
        }
    }

    /// An editor with the figure in a pose, and nothing to undo.
    pub fn in_pose(figure: Arc<Figure>, pose: Pose) -> Editor {
        let document = Document::of(pose);
        let evaluation = document.evaluated(&figure);
        Editor { document, evaluation, ..Editor::new(figure) }
    }

    /// Makes the figure's body changeable: what it is made of, and the body that it has now. Nothing else changes.
    pub fn give_clay(&mut self, clay: Arc<Clay>, body: Body) {
        self.clay = Some(clay);
        self.document.body = body;
    }

    /// What the figure is made of, if its body may be changed.
    pub fn clay(&self) -> Option<&Clay> {
        self.clay.as_deref()
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

    /// The document from which the gesture under way starts, or as it shows now: what a control that reads a value off
    /// the pose writes it onto.
    pub fn first(&self) -> &Document {
        self.history.gesture().map_or(&self.document, |step| &step.document)
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
            Request::Cancel => {
                let back = self.history.cancel();
                Ok(self.back(back))
            }
            Request::Undo => {
                let back = self.history.undo(&self.document);
                Ok(self.back(back))
            }
            Request::Redo => {
                let back = self.history.redo(&self.document);
                Ok(self.back(back))
            }
            Request::Open(pose) => Ok(self.open(*pose)),
            Request::PreviewPose { pose, name } => {
                self.history.begin(&self.document, name);
                self.show(Document { pose: *pose, ..self.document.clone() });
                Ok(Outcome::default())
            }
            Request::Paste { text, mirrored } => {
                let applied = paste(&self.figure, &self.document, &text, mirrored)?;
                Ok(self.step_to(applied, "Paste"))
            }
            Request::Mechanics(mechanics) => Ok(self.set_mechanics(mechanics)),
            Request::Lock(bones, on) => self.lock(bones, on),
            Request::Symmetry(symmetry) => {
                self.step(Document { symmetry, ..self.document.clone() }, "Symmetry");
                Ok(told(format!("Symmetry {}", if symmetry { "on" } else { "off" })))
            }
            Request::Body(body) => {
                self.preview_body(body)?;
                Ok(self.commit())
            }
            Request::PreviewBody(body) => self.preview_body(body),
        }
    }

    fn run(&mut self, command: &Command, files: &mut dyn Files) -> Result<Outcome, Rejected> {
        let applied = apply(&self.figure, &self.document, std::slice::from_ref(command), files)?;
        Ok(self.step_to(applied, command.name()))
    }

    fn preview(&mut self, commands: &[Command], files: &mut dyn Files) -> Result<Outcome, Rejected> {
        let Some(last) = commands.last() else {
            // Nothing is done to the gesture's first state.
            if self.in_gesture() {
                self.show(self.first().clone());
            }
            return Ok(Outcome::default());
        };
        let Applied { document, evaluation, outcome } = apply(&self.figure, self.first(), commands, files)?;
        self.history.begin(&self.document, last.name());
        self.show_evaluated(document, evaluation);
        Ok(outcome)
    }

    /// Shows the gesture's first pose on the figure with another body.
    fn preview_body(&mut self, body: Body) -> Result<Outcome, Rejected> {
        let Some(clay) = self.clay.clone() else {
            return Err(Rejected("it is not known what this figure's body is made of".to_owned()));
        };
        if self.history.gesture().is_some_and(|step| step.name != BODY) {
            self.commit();
        }
        let first = self.first().clone();
        let is = clay.made(&body)?;
        if !self.in_gesture() {
            self.history.begin(&first, BODY);
            self.former = Some(self.figure.clone());
        }
        let was = self.former.as_ref().unwrap_or(&self.figure);
        let pose = rig::carried_over(was, &first.pose, &is);
        self.figure = is;
        let document = Document { pose, body, ..first };
        let evaluation = document.evaluated(&self.figure);
        self.show_evaluated(document, evaluation);
        Ok(Outcome::default())
    }

    fn set_mechanics(&mut self, mechanics: Mechanics) -> Outcome {
        self.step(Document { mechanics, ..self.document.clone() }, "Mechanics");
        let rhythm = if mechanics.collar_rhythm { "on" } else { "off" };
        let follow = mechanics.torso_follow * 100.0;
        told(format!("Collar rhythm {rhythm}, torso follows by {follow:.0} %"))
    }

    fn lock(&mut self, bones: Locks, on: bool) -> Result<Outcome, Rejected> {
        let lacks = |bone: &Bone| self.figure.skeleton.joint(*bone).is_none();
        if let Some(lacking) = bones.iter().find(lacks) {
            return Err(rig::GestureError::NoBone(lacking).into());
        }
        let twin = |bone| twin_of(&self.figure, bone).filter(|twin| !bones.contains(*twin));
        let twins: Vec<Bone> =
            if self.document.symmetry { bones.iter().filter_map(twin).collect() } else { Vec::new() };
        let both = bones.iter().chain(twins.iter().copied());
        let locks = both.fold(self.document.locks, |all, bone| all.with(bone, on));
        self.step(Document { locks, ..self.document.clone() }, if on { "Lock" } else { "Unlock" });
        let (names, also) = match (&bones.iter().collect::<Vec<_>>()[..], twins.is_empty()) {
            ([bone], true) => (words(bone.name()), ""),
            ([bone], false) => (words(bone.name()), " and its twin"),
            (bones, true) => (format!("{} joints", bones.len()), ""),
            (bones, false) => (format!("{} joints", bones.len()), " and their twins"),
        };
        Ok(told(format!("{} {names}{also}", if on { "Locked" } else { "Unlocked" })))
    }

    /// Makes a document the next step; a gesture under way is committed first.
    fn step(&mut self, document: Document, name: &str) {
        let evaluation = document.evaluated(&self.figure);
        self.step_to(Applied { document, evaluation, outcome: Outcome::default() }, name);
    }

    fn step_to(&mut self, applied: Applied, name: &str) -> Outcome {
        self.history.step(&self.document, name);
        self.show_evaluated(applied.document, applied.evaluation);
        applied.outcome
    }

    fn commit(&mut self) -> Outcome {
        self.history.commit(&self.document);
        Outcome::default()
    }

    /// Shows what the history gives back.
    fn back(&mut self, back: Back<Document>) -> Outcome {
        if let Some(document) = back.document {
            self.show(document);
        }
        told(back.message)
    }

    fn open(&mut self, pose: Pose) -> Outcome {
        self.step(Document { pose, ..self.document.clone() }, "Open");
        told("Opened".to_owned())
    }

    fn show(&mut self, document: Document) {
        if let Some(clay) = self.clay.clone().filter(|_| document.body != self.document.body) {
            // It was made of this body before.
            self.figure = clay.made(&document.body).unwrap_or_else(|_| self.figure.clone());
        }
        let evaluation = document.evaluated(&self.figure);
        self.show_evaluated(document, evaluation);
    }

    fn show_evaluated(&mut self, document: Document, evaluation: Evaluation) {
        self.evaluation = evaluation;
        self.document = document;
        self.revision += 1;
    }
}

fn told(message: String) -> Outcome {
    Outcome { message, ..Outcome::default() }
}
