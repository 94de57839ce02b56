//! The rows about the ground under the figure that is posed.

use egui::Ui;

use super::{Sheet, row};
use crate::action::Action;

/// What the rows show, and what was done to them.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct GroundRow {
    /// The kind of ground that is chosen, in words.
    pub words: &'static str,
    /// Whether it shows under the figure.
    pub shows: bool,
    /// Whether the feet are to come to it.
    pub stand: bool,
}

impl Sheet<'_> {
    /// Whether the ground of the walk shows here, too, and the button that stands the figure on it.
    pub(super) fn ground(&mut self, ui: &mut Ui) {
        row::subtitle(ui, "Ground");
        let ground = &mut self.panels.ground;
        ui.horizontal(|ui| {
            if ui
                .button(Action::StandOnGround.words())
                .on_hover_text(Action::StandOnGround.explained())
                .clicked()
            {
                ground.stand = true;
            }
            let tip = "Shows the ground that is chosen in the Walk mode (F5) under the figure";
            ui.checkbox(&mut ground.shows, format!("Show {}", ground.words.to_lowercase()))
                .on_hover_text(tip);
        });
    }
}
