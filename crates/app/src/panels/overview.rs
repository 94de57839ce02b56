//! The top of the panel: what is chosen, and the body map or the tree of joints to choose from.

use egui::{Align2, FontId, Rect, Ui, UiBuilder, pos2, vec2};

use super::Sheet;
use crate::{labels, theme};

/// What the top of the panel shows.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub enum Overview {
    /// The drawn figure.
    #[default]
    Map,
    /// The joints in their order.
    Tree,
    /// Nothing: more room for the sliders.
    Hidden,
}

impl Overview {
    /// Each with its word and its accessible name.
    const ALL: [(Overview, &'static str, &'static str); 3] = [
        (Overview::Map, "Map", "Body map shown"),
        (Overview::Tree, "Tree", "Part tree shown"),
        (Overview::Hidden, "None", "Neither map nor tree"),
    ];
}

const HEIGHT: f32 = 26.0;

impl Sheet<'_> {
    pub(super) fn overview(&mut self, ui: &mut Ui) {
        self.overview_bar(ui);
        match self.panels.overview {
            Overview::Map => self.body_map(ui),
            Overview::Tree => self.tree(ui),
            Overview::Hidden => {}
        }
        ui.add_space(4.0);
    }

    /// What is chosen at the left, the three views at the right.
    fn overview_bar(&mut self, ui: &mut Ui) {
        let (_, bar) = ui.allocate_space(vec2(ui.available_width(), HEIGHT));
        let place = UiBuilder::new()
            .scope_id(egui::Id::unique("overview"))
            .max_rect(bar)
            .layout(egui::Layout::right_to_left(egui::Align::Center));
        let buttons = ui.scope_builder(place, |ui| {
            ui.spacing_mut().item_spacing.x = 2.0;
            for (overview, word, name) in Overview::ALL.into_iter().rev() {
                let shown = self.panels.overview == overview;
                let button = egui::Button::selectable(shown, egui::RichText::new(word).size(12.0));
                if ui.add(button).accessible_name(name).clicked() {
                    self.panels.overview = overview;
                    self.panels.reveal_row = true;
                }
            }
        });
        let words = Rect::from_min_max(bar.min, pos2(buttons.response.rect.left() - 6.0, bar.bottom()));
        let palette = theme::of(ui);
        let painter = ui.painter().with_clip_rect(words.intersect(ui.clip_rect()));
        let (text, color) = match (self.panels.selection.bones(), self.panels.selected()) {
            ([], _) | (_, None) => ("Nothing chosen".to_owned(), palette.faint_text),
            ([_], Some(bone)) => (labels::full(bone), palette.text),
            (bones, Some(bone)) => {
                (format!("{} and {} more", labels::full(bone), bones.len() - 1), palette.text)
            }
        };
        let at = pos2(words.left() + 4.0, words.center().y);
        painter.text(at, Align2::LEFT_CENTER, text, FontId::proportional(13.5), color);
    }
}
