//! The panel's grid: every row has the same columns, so that rails and numbers stand under each other.

use egui::{Align2, Color32, FontId, Rect, Sense, Ui, pos2, vec2};

use crate::theme;

/// Height of a row, points.
pub const HEIGHT: f32 = 21.0;
const JOINT: f32 = 92.0;
const ANGLE: f32 = 66.0;
const NUMBER: f32 = 58.0;

/// The columns of one row.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// All of it.
    pub whole: Rect,
    /// What turns.
    pub joint: Rect,
    /// How it turns.
    pub angle: Rect,
    /// The slider.
    pub rail: Rect,
    /// The number.
    pub number: Rect,
}

/// Takes the next row.
pub fn next(ui: &mut Ui) -> Row {
    ui.spacing_mut().item_spacing.y = 2.0;
    let (_, whole) = ui.allocate_space(vec2(ui.available_width(), HEIGHT));
    let column =
        |from: f32, to: f32| Rect::from_min_max(pos2(from, whole.top()), pos2(to.max(from), whole.bottom()));
    let joint_end = whole.left() + JOINT;
    let angle_end = joint_end + ANGLE;
    let number_start = whole.right() - NUMBER;
    Row {
        whole,
        joint: column(whole.left(), joint_end),
        angle: column(joint_end, angle_end),
        rail: column(angle_end + 4.0, number_start - 10.0),
        number: column(number_start, whole.right()),
    }
}

impl Row {
    /// Everything right of the joint's column.
    pub fn rest(&self) -> Rect {
        Rect::from_min_max(self.angle.min, self.whole.max)
    }
}

/// What words are written with.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Ink {
    /// What a row is about.
    Plain,
    /// What explains.
    Faint,
    /// What went short.
    Warning,
    /// What is chosen.
    Chosen,
}

impl Ink {
    fn color(self, ui: &Ui) -> Color32 {
        let palette = theme::of(ui);
        match self {
            Ink::Plain => palette.text,
            Ink::Faint => palette.faint_text,
            Ink::Warning => palette.warning,
            Ink::Chosen => palette.accent,
        }
    }
}

/// Writes into a cell, cut off at its end; the response is for tooltips and clicks.
pub fn text(ui: &mut Ui, rect: Rect, words: &str, ink: Ink) -> egui::Response {
    let painter = ui.painter().with_clip_rect(rect.intersect(ui.clip_rect()));
    let at = pos2(rect.left() + 2.0, rect.center().y);
    painter.text(at, Align2::LEFT_CENTER, words, FontId::proportional(12.5), ink.color(ui));
    ui.interact(rect, egui::Id::unique(("cell", rect.min.x as i32, rect.min.y as i32)), Sense::hover())
}

/// A quiet title between rows.
pub fn subtitle(ui: &mut Ui, words: &str) {
    ui.add_space(6.0);
    let (_, rect) = ui.allocate_space(vec2(ui.available_width(), 18.0));
    let painter = ui.painter();
    let at = pos2(rect.left() + 2.0, rect.center().y);
    let written =
        painter.text(at, Align2::LEFT_CENTER, words, FontId::proportional(11.5), theme::of(ui).faint_text);
    let line = egui::Stroke::new(1.0, theme::of(ui).line);
    painter.hline((written.right() + 8.0)..=rect.right(), rect.center().y, line);
}
