//! Which poses are shown: a search in titles and tags, and tags to choose from.

use std::collections::BTreeSet;

use egui::{RichText, TextEdit, Ui};

use super::entry::Entry;

/// What is looked for.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Search {
    /// Words that must all be found.
    words: String,
    /// Tags of which a pose has one at least; none asks for nothing.
    tags: BTreeSet<String>,
}

impl Search {
    /// The poses that are looked for, in their order.
    pub fn found<'a>(&self, entries: &'a [Entry]) -> Vec<&'a Entry> {
        entries.iter().filter(|entry| entry.has_any(&self.tags) && entry.matches(&self.words)).collect()
    }

    /// Shows the field and a chip for each tag that there is.
    pub fn show(&mut self, ui: &mut Ui, entries: &[Entry]) {
        let height = ui.spacing().interact_size.y;
        let line = egui::Layout::right_to_left(egui::Align::Center);
        ui.allocate_ui_with_layout(egui::vec2(ui.available_width(), height), line, |ui| {
            let full = !self.words.is_empty() || !self.tags.is_empty();
            let cross = egui::Button::new(RichText::new("×").size(15.0));
            let cross = ui.add_enabled(full, cross).on_hover_text("Show all poses");
            let clear = cross.accessible_name("Clear the search").clicked();
            if clear {
                *self = Search::default();
            }
            let field = TextEdit::singleline(&mut self.words)
                .id(egui::Id::unique("library search"))
                .hint_text("Search poses and tags")
                .desired_width(f32::INFINITY);
            let field = ui.add(field).accessible_name("Search poses");
            if clear {
                field.request_focus();
            }
        });
        let tags: BTreeSet<&String> = entries.iter().flat_map(|entry| &entry.tags).collect();
        self.tags.retain(|tag| tags.contains(tag));
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing = egui::vec2(4.0, 4.0);
            ui.spacing_mut().button_padding.x = 7.0;
            for tag in tags {
                self.chip(ui, tag);
            }
        });
    }

    fn chip(&mut self, ui: &mut Ui, tag: &str) {
        let on = self.tags.contains(tag);
        // A point, not colour alone, says that a tag is on.
        let text = if on { format!("• {tag}") } else { tag.to_owned() };
        let chip = egui::Button::selectable(on, RichText::new(text).size(11.5))
            .corner_radius(9)
            .frame_when_inactive(true);
        let chip = ui.add(chip).accessible_name(format!("Tag {tag}"));
        if chip.clicked() {
            if on {
                self.tags.remove(tag);
            } else {
                self.tags.insert(tag.to_owned());
            }
        }
    }
}
