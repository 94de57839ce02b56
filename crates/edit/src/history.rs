//! The history of a document of any kind: steps that undo takes back, and the gesture under way.

/// A step of history: the document before it, and its name.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Step<D> {
    pub document: D,
    pub name: String,
}

/// A way back or on again.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Back<D> {
    /// What to show; `None` if what is shown stays.
    pub document: Option<D>,
    /// One sentence for the status line.
    pub message: String,
}

/// Former values of a document. The present one is its owner's, who hands it in.
#[derive(Clone, Debug)]
pub(crate) struct History<D> {
    past: Vec<Step<D>>,
    future: Vec<Step<D>>,
    gesture: Option<Step<D>>,
}

impl<D> Default for History<D> {
    fn default() -> History<D> {
        History { past: Vec::new(), future: Vec::new(), gesture: None }
    }
}

impl<D: Clone + PartialEq> History<D> {
    /// The gesture under way: the document before it, and its name.
    pub fn gesture(&self) -> Option<&Step<D>> {
        self.gesture.as_ref()
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
    pub fn depth(&self) -> usize {
        self.past.len()
    }

    /// Begins a gesture from the present document, unless one is under way.
    pub fn begin(&mut self, now: &D, name: &str) {
        if self.gesture.is_none() {
            self.gesture = Some(Step { document: now.clone(), name: name.to_owned() });
        }
    }

    /// Ends the gesture under way as one step, if it came to anything.
    pub fn commit(&mut self, now: &D) {
        if let Some(step) = self.gesture.take().filter(|step| step.document != *now) {
            self.push(step);
        }
    }

    /// Ends the gesture under way as if it had never been: what to show again, and what to say; nothing without one.
    pub fn cancel(&mut self) -> Back<D> {
        match self.gesture.take() {
            Some(step) => Back { document: Some(step.document), message: format!("{} cancelled", step.name) },
            None => Back { document: None, message: String::new() },
        }
    }

    /// A step away from the present document; a gesture under way is committed first.
    pub fn step(&mut self, now: &D, name: &str) {
        self.commit(now);
        self.push(Step { document: now.clone(), name: name.to_owned() });
    }

    /// Takes the last step back, or cancels the gesture under way.
    pub fn undo(&mut self, now: &D) -> Back<D> {
        if self.gesture.is_some() {
            return self.cancel();
        }
        let Some(step) = self.past.pop() else {
            return Back { document: None, message: "Nothing to undo".to_owned() };
        };
        let message = format!("Undid: {}", step.name);
        self.future.push(Step { document: now.clone(), name: step.name });
        Back { document: Some(step.document), message }
    }

    /// Does the step again that was last taken back; a gesture under way is committed first.
    pub fn redo(&mut self, now: &D) -> Back<D> {
        self.commit(now);
        let Some(step) = self.future.pop() else {
            return Back { document: None, message: "Nothing to redo".to_owned() };
        };
        let message = format!("Redid: {}", step.name);
        self.past.push(Step { document: now.clone(), name: step.name });
        Back { document: Some(step.document), message }
    }

    fn push(&mut self, step: Step<D>) {
        self.past.push(step);
        self.future.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gesture_that_came_to_nothing_is_no_step_and_keeps_what_can_be_redone() {
        let mut history = History::default();
        history.step(&1, "first");
        let back = history.undo(&2);
        assert_eq!((back.document, back.message.as_str()), (Some(1), "Undid: first"));
        history.begin(&1, "nothing");
        history.commit(&1);
        assert_eq!((history.depth(), history.redo_name()), (0, Some("first")));
        assert_eq!(history.redo(&1).document, Some(2));
        assert_eq!(history.undo_name(), Some("first"));
        assert_eq!(history.redo(&2), Back { document: None, message: "Nothing to redo".to_owned() });
    }

    #[test]
    fn a_gesture_is_one_step_from_its_first_state() {
        let mut history = History::default();
        history.begin(&1, "drag");
        history.begin(&2, "drag");
        assert_eq!(history.gesture().unwrap().document, 1);
        history.step(&3, "key");
        assert_eq!(history.depth(), 2);
        assert_eq!(history.undo(&4).document, Some(3));
        assert_eq!(history.undo(&3).document, Some(1));
        assert_eq!(history.undo(&1).document, None);
    }

    #[test]
    fn undo_during_a_gesture_takes_the_gesture_back() {
        let mut history = History::default();
        history.step(&1, "first");
        history.begin(&2, "drag");
        let back = history.undo(&5);
        assert_eq!((back.document, back.message.as_str()), (Some(2), "drag cancelled"));
        assert_eq!((history.depth(), history.cancel().document), (1, None));
    }
}
