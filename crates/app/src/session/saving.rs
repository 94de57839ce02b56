//! Saving pictures of the figure.

use std::path::Path;

use egui::{Context, Ui};

use super::Session;
use crate::failure::Failure;
use crate::picture::Subject;
use crate::saving::{Saving, Seen};

impl Session {
    /// Begins to write what the view shows, without marks, as was chosen in the dialog.
    pub(super) fn save_picture(&mut self, ctx: &Context, path: &Path) -> Result<(), Failure> {
        let (subject, camera) = match self.walk.subject().filter(|_| self.is_walking()) {
            Some(subject) => (subject, self.walk.picture.camera),
            None => {
                let (editor, ground) = (&self.editor, self.viewport.ground.clone());
                let subject = Subject::of_pose(editor.figure(), editor.pose(), ground);
                (subject, self.viewport.camera_for_picture())
            }
        };
        let seen = Seen { subject, camera, finish: self.settings.finish, file: self.path.as_deref() };
        let begun = Saving::begin(&mut self.saving, ctx, path, seen, &self.settings.picture)?;
        self.say(begun);
        Ok(())
    }

    fn told(&mut self, words: Result<String, Failure>) {
        match words {
            Ok(words) => self.say(words),
            Err(failure) => self.tell(Err(failure)),
        }
    }

    /// Shows how far the pictures are, stops them when asked, and tells when they are done.
    pub(super) fn show_saving(&mut self, ui: &Ui) {
        if let Some(words) = Saving::show(&mut self.saving, ui) {
            self.told(words);
        }
    }

    /// Whether a picture is being saved.
    pub fn is_saving(&self) -> bool {
        self.saving.is_some()
    }
}
