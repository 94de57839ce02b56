//! The line at the bottom: what happened, what is out of reach, which file.

use egui::{Color32, RichText, Ui};
use rig::{Contact, Limb};

use crate::session::Session;
use crate::{labels, theme};

/// A miss smaller than this is none, metres.
const MET_M: f64 = 0.0005;

/// Shows the line.
pub fn show(ui: &mut Ui, session: &Session) {
    let frame = egui::Frame::new().fill(theme::BAR).inner_margin(egui::Margin::symmetric(10, 4));
    egui::Panel::bottom("status").frame(frame).resizable(false).exact_size(26.0).show(ui, |ui| {
        ui.horizontal_centered(|ui| {
            let status = session.status();
            let color = if status.fault { theme::WARNING } else { theme::TEXT };
            let mut words = session.viewport.telling().unwrap_or_else(|| status.message.clone());
            if status.clamped {
                words.push_str(if words.is_empty() {
                    "Stopped short by a range"
                } else {
                    " · stopped short"
                });
            }
            if words.is_empty() {
                words = "Drag the figure, a slider, or the view. F1 explains.".to_owned();
                text(ui, words, theme::FAINT_TEXT);
            } else {
                text(ui, words, color);
            }
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let mark = if session.is_modified() { " · not saved" } else { "" };
                text(ui, format!("{}{mark}", session.file_name()), theme::FAINT_TEXT);
                let misses = misses(session);
                if !misses.is_empty() {
                    ui.add_space(12.0);
                    text(ui, misses.join(" · "), theme::WARNING);
                }
            });
        });
    });
}

fn text(ui: &mut Ui, words: String, color: Color32) {
    ui.add(egui::Label::new(RichText::new(words).size(12.0).color(color)).truncate());
}

/// Limbs whose contact is not met.
fn misses(session: &Session) -> Vec<String> {
    let editor = session.editor();
    let missed = |limb: &Limb| {
        let view = &editor.evaluation().limbs[limb.index()];
        let held = editor.pose().limb(*limb).contact != Contact::Free;
        (held && view.residual > MET_M)
            .then(|| format!("{} {:.0} mm short", labels::limb(*limb), view.residual * 1000.0))
    };
    Limb::ALL.iter().filter_map(missed).collect()
}
