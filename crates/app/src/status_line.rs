//! The line at the bottom: what happened, what pointer and keys would do now, what is out of reach, which file.

mod hints;

use egui::{Align, Color32, Label, Layout, RichText, Ui};
use rig::Limb;

use crate::session::Session;
use crate::{keycap, labels, reaching, sign, theme};
pub use hints::Hint;

/// Shows the line.
pub fn show(ui: &mut Ui, session: &Session) {
    let frame = egui::Frame::new().fill(theme::of(ui).bar).inner_margin(egui::Margin::symmetric(10, 4));
    egui::Panel::bottom("status").frame(frame).resizable(false).exact_size(26.0).show(ui, |ui| {
        // The file and what is missed come from the right and keep their room; the rest takes what is left.
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            file(ui, session);
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                ui.set_clip_rect(ui.max_rect().intersect(ui.clip_rect()));
                ui.spacing_mut().item_spacing.x = 5.0;
                news(ui, session);
                for hint in hints::now(session, ui.input(|i| i.pointer.hover_pos())) {
                    if !show_hint(ui, &hint) {
                        break;
                    }
                }
            });
        });
    });
}

/// Words of the line, cut off where there is no room.
pub fn text(ui: &mut Ui, words: impl Into<String>, color: Color32) {
    ui.add(Label::new(RichText::new(words).size(12.0).color(color)).truncate());
}

fn file(ui: &mut Ui, session: &Session) {
    let palette = theme::of(ui);
    let mark = if session.is_modified() { " · not saved" } else { "" };
    text(ui, format!("{}{mark}", session.file_name()), palette.faint_text);
    let misses = misses(session);
    if !misses.is_empty() {
        ui.add_space(12.0);
        text(ui, misses.join(" · "), palette.warning);
        sign::fault(ui, palette.warning);
    }
    ui.add_space(12.0);
}

/// What happened last; a drag tells of itself among the hints.
fn news(ui: &mut Ui, session: &Session) {
    let (palette, status) = (theme::of(ui), session.status());
    let mut words = if session.viewport.telling().is_some() { String::new() } else { status.message.clone() };
    if status.clamped {
        words.push_str(if words.is_empty() { "Stopped short by a range" } else { " · stopped short" });
    }
    if words.is_empty() {
        return;
    }
    match status.fault {
        true => {
            sign::fault(ui, palette.warning);
            text(ui, words, palette.warning);
        }
        false => text(ui, words, palette.text),
    }
    ui.add_space(10.0);
}

/// Shows a hint if there is room for it whole; whether there was.
pub fn show_hint(ui: &mut Ui, hint: &Hint) -> bool {
    let palette = theme::of(ui);
    let font = egui::FontId::proportional(12.0);
    let measured = format!("{}    {}", hint.keys.join("    "), hint.does);
    let width = ui.painter().layout_no_wrap(measured, font, palette.text).size().x + 12.0;
    if width > ui.available_width() {
        return false;
    }
    for key in &hint.keys {
        keycap::show(ui, key);
    }
    let color = if hint.keys.is_empty() { palette.text } else { palette.faint_text };
    text(ui, &hint.does, color);
    ui.add_space(8.0);
    true
}

/// Limbs whose contact is not met.
fn misses(session: &Session) -> Vec<String> {
    let editor = session.editor();
    let missed = |limb: &Limb| {
        let words = reaching::miss_words(editor, *limb)?;
        Some(format!("{} {words}", labels::limb(*limb)))
    };
    Limb::ALL.iter().filter_map(missed).collect()
}
