//! Settings and keys: where they come from, what they change, and when they are kept.

use egui::{Context, Ui};

use super::Session;
use crate::finish::Finish;
use crate::keymap::Keymap;
use crate::settings::{ConfigFolder, Keeper};
use crate::theme;

impl Session {
    /// Takes settings and keys from a folder and keeps them there from now on.
    ///
    /// A file at fault is told in the status line with its place; its defaults stay in force.
    pub fn configure_from(&mut self, folder: ConfigFolder) {
        let (keeper, settings, keymap, fault) = Keeper::open(folder);
        self.viewport.marks = settings.marks;
        self.viewport.side_view = settings.second_view;
        self.viewport.preset = settings.navigation;
        self.use_keys(keymap);
        self.settings = settings;
        self.keeper = keeper;
        self.tell(fault.map_or(Ok(()), Err));
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
        let saved = self.keeper.keep(&self.settings);
        self.tell(saved);
    }

    /// Takes on other keys.
    pub(super) fn use_keys(&mut self, keymap: Keymap) {
        self.viewport.keymap = keymap.clone();
        self.keymap = keymap;
    }

    /// Writes the keys, which have changed.
    pub(super) fn keep_keys(&mut self) {
        let saved = self.keeper.keep_keys(&self.keymap);
        self.tell(saved);
    }
}
