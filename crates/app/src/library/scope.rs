//! Which parts of the body a pose of the library is applied to, and saved from.

use egui::{RichText, Ui};
use rig::Part;

use crate::labels;

/// The choice of parts.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Reach {
    /// The whole figure.
    #[default]
    All,
    /// The parts of what is selected.
    Selection,
    /// The parts that are ticked.
    Ticked,
}

/// The choice, and what is ticked; ticks are kept while another choice is on.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Scope {
    /// Which of the three.
    pub reach: Reach,
    /// Ticks in the order of [`Part::ALL`].
    pub ticks: [bool; Part::ALL.len()],
}

impl Scope {
    /// The parts as commands name them, none for the whole figure; `None` if there is nothing to apply to.
    pub fn parts(&self, selected: &[Part]) -> Option<Vec<Part>> {
        let some = match self.reach {
            Reach::All => return Some(Vec::new()),
            Reach::Selection => Part::ALL.into_iter().filter(|part| selected.contains(part)).collect(),
            Reach::Ticked => {
                let ticked = |(part, on): (Part, bool)| on.then_some(part);
                Part::ALL.into_iter().zip(self.ticks).filter_map(ticked).collect::<Vec<Part>>()
            }
        };
        match some.len() {
            0 => None,
            8 => Some(Vec::new()),
            _ => Some(some),
        }
    }

    /// Shows the choice: three words, what is selected, or ticks.
    pub fn show(&mut self, ui: &mut Ui, selected: &[Part]) {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 2.0;
            for (reach, words, name, tip) in [
                (Reach::All, "All", "Apply to all", "The whole figure"),
                (Reach::Selection, "Selection", "Apply to the selection", "Only the parts that are selected"),
                (Reach::Ticked, "Parts…", "Apply to parts", "Only the parts that are ticked"),
            ] {
                let button = egui::Button::selectable(self.reach == reach, words);
                if ui.add(button).on_hover_text(tip).accessible_name(name).clicked() {
                    self.reach = reach;
                }
            }
        });
        match self.reach {
            Reach::All => {}
            Reach::Selection => self.selection(ui, selected),
            Reach::Ticked => self.ticks(ui),
        }
    }

    fn selection(self, ui: &mut Ui, selected: &[Part]) {
        let names: Vec<&str> = selected.iter().map(|part| labels::part(*part)).collect();
        let words = if names.is_empty() { "Nothing is selected".to_owned() } else { names.join(", ") };
        ui.label(RichText::new(words).small().weak());
    }

    fn ticks(&mut self, ui: &mut Ui) {
        egui::Grid::new("library parts").num_columns(2).spacing([12.0, 2.0]).show(ui, |ui| {
            for pair in Part::ALL.chunks(2) {
                for part in pair {
                    let name = labels::part(*part);
                    ui.checkbox(&mut self.ticks[*part as usize], name)
                        .accessible_name(format!("Apply to {}", name.to_lowercase()));
                }
                ui.end_row();
            }
        });
        if self.parts(&[]).is_none() {
            ui.label(RichText::new("No part is ticked").small().weak());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_part_is_not_the_same_as_all_parts() {
        let mut scope = Scope::default();
        assert_eq!(scope.parts(&[]), Some(Vec::new()));
        scope.reach = Reach::Ticked;
        assert_eq!(scope.parts(&[Part::Head]), None);
        scope.ticks[Part::LeftArm as usize] = true;
        assert_eq!(scope.parts(&[]), Some(vec![Part::LeftArm]));
        scope.ticks = [true; 8];
        assert_eq!(scope.parts(&[]), Some(Vec::new()));
        scope.reach = Reach::Selection;
        assert_eq!(scope.parts(&[]), None);
        assert_eq!(scope.parts(&[Part::Head]), Some(vec![Part::Head]));
    }
}
