//! The history of a document of any kind: steps that undo takes back, and the gesture under way.

/// A step of history: the document before it, and its name.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Step<D> {
    pub document: D,
    pub name: String,
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

    /// Ends the gesture under way as if it had never been: what to show again.
    pub fn cancel(&mut self) -> Option<Step<D>> {
        self.gesture.take()
    }

    /// A step away from the present document; a gesture under way is committed first.
    pub fn step(&mut self, now: &D, name: &str) {
        self.commit(now);
        self.push(Step { document: now.clone(), name: name.to_owned() });
    }

    /// Takes the last step back: what to show again.
    pub fn undo(&mut self, now: &D) -> Option<Step<D>> {
        let step = self.past.pop()?;
        self.future.push(Step { document: now.clone(), name: step.name.clone() });
        Some(step)
    }

    /// Does the step again that was last taken back: what to show again.
    pub fn redo(&mut self, now: &D) -> Option<Step<D>> {
        self.commit(now);
        let step = self.future.pop()?;
        self.past.push(Step { document: now.clone(), name: step.name.clone() });
        Some(step)
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
        let back = history.undo(&2).unwrap();
        assert_eq!((back.document, back.name.as_str()), (1, "first"));
        history.begin(&1, "nothing");
        history.commit(&1);
        assert_eq!((history.depth(), history.redo_name()), (0, Some("first")));
        assert_eq!(history.redo(&1).unwrap().document, 2);
        assert_eq!(history.undo_name(), Some("first"));
    }

    #[test]
    fn a_gesture_is_one_step_from_its_first_state() {
        let mut history = History::default();
        history.begin(&1, "drag");
        history.begin(&2, "drag");
        assert_eq!(history.gesture().unwrap().document, 1);
        history.step(&3, "key");
        assert_eq!(history.depth(), 2);
        assert_eq!(history.undo(&4).unwrap().document, 3);
        assert_eq!(history.undo(&3).unwrap().document, 1);
        assert_eq!(history.undo(&1), None);
    }
}
