//! Saving pictures of the figure.

use std::path::Path;

use egui::{Context, Ui};

use super::Session;
use crate::failure::Failure;
use crate::picture::Subject;
use crate::saving::{Saving, Seen};

impl Session {
    /// Begins to write what the view shows, without marks, as was chosen in the dialog.
    pub(super) fn save_picture(&mut self, ctx: &Context, path: &Path) {
        if self.saving.is_some() {
            self.tell(Err(Failure::Usage("another picture is still being saved".to_owned())));
            return;
        }
        let seen = Seen {
            subject: Subject::of(&self.editor),
            camera: self.viewport.camera_for_picture(),
            finish: self.settings.finish,
            file: self.path.as_deref(),
        };
        match Saving::begin(ctx, path, seen, &self.settings.picture) {
            Ok(saving) => {
                self.say(format!("Saving {}", path.display()));
                self.saving = Some(saving);
            }
            Err(failure) => self.tell(Err(failure)),
        }
    }

    /// Shows how far the pictures are, stops them when asked, and tells when they are done.
    pub(super) fn show_saving(&mut self, ui: &Ui) {
        match Saving::show(&mut self.saving, ui) {
            Some(Ok(words)) => self.say(words),
            Some(Err(failure)) => self.tell(Err(failure)),
            None => {}
        }
    }

    /// Whether a picture is being saved.
    pub fn is_saving(&self) -> bool {
        self.saving.is_some()
    }
}
