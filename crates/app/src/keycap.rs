//! A key as it looks on the keyboard, among words.

use egui::{CornerRadius, Frame, Label, Margin, Response, RichText, Stroke, Ui};

use crate::theme;

/// Shows a key, a button of the mouse or a gesture as a cap.
pub fn show(ui: &mut Ui, words: &str) -> Response {
    let palette = theme::of(ui);
    let frame = Frame::new()
        .fill(palette.button[0])
        .stroke(Stroke::new(1.0, palette.line))
        .corner_radius(CornerRadius::same(3))
        .inner_margin(Margin::symmetric(4, 0));
    let text = RichText::new(words).size(11.0).color(palette.strong_text);
    frame.show(ui, |ui| ui.add(Label::new(text).extend())).response
}
