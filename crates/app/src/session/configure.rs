//! Settings and keys: where they come from, what they change, and when they are kept.

use egui::{Context, Ui};

use super::Session;
use crate::finish::Finish;
use crate::keymap::Keymap;
use crate::settings::ConfigFolder;
use crate::theme;

impl Session {
    /// Takes settings and keys from a folder and keeps them there from now on.
    ///
    /// A file at fault is told in the status line with its place; its defaults stay in force.
    pub fn configure_from(&mut self, folder: ConfigFolder) {
        let (settings, keymap, faults) = folder.load();
        self.viewport.marks = settings.marks;
        self.viewport.side_view = settings.second_view;
        self.viewport.preset = settings.navigation;
        self.use_keys(keymap);
        self.settings = settings.clone();
        self.config = Some((folder, settings));
        let words: Vec<String> = faults.iter().map(ToString::to_string).collect();
        if !words.is_empty() {
            let message = format!("{} · the defaults are used", words.join(" · "));
            self.tell(Err(crate::failure::Failure::Input(message)));
        }
    }

    /// Gives the figure another look.
    pub fn set_finish(&mut self, finish: Finish) {
        self.settings.finish = finish;
    }

    /// Gives the window the look and the size that were chosen.
    pub(super) fn show_as_chosen(&self, ctx: &Context) {
        theme::follow(ctx, self.settings.look);
        ctx.set_zoom_factor(self.settings.ui_scale);
    }

    /// Writes what has changed, once the pointer lets go.
    pub(super) fn keep_settings(&mut self, ui: &Ui) {
        if ui.input(|i| i.pointer.any_down()) {
            return;
        }
        let changed = self.config.as_mut().filter(|(_, kept)| *kept != self.settings);
        let Some((folder, kept)) = changed else { return };
        // Tried once for each change, also where the folder can't be written.
        *kept = self.settings.clone();
        let saved = folder.save_settings(kept);
        self.tell(saved);
    }

    /// Takes on other keys.
    pub(super) fn use_keys(&mut self, keymap: Keymap) {
        self.viewport.keymap = keymap.clone();
        self.keymap = keymap;
    }

    /// Writes the keys, which have changed.
    pub(super) fn keep_keys(&mut self) {
        let saved = self.config.as_ref().map(|(folder, _)| folder.save_keys(&self.keymap));
        self.tell(saved.unwrap_or(Ok(())));
    }
}
