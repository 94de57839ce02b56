//! The blend tree as a picture: nodes and links from the outermost down, each with its live weight; what has none is greyed.

use egui::{Align2, Color32, FontId, Pos2, Rect, Stroke, Ui, WidgetInfo, pos2, vec2};

use super::Walk;
use crate::theme;

/// The height of a node's row, points.
const ROW: f32 = 18.0;
/// From a node to what is in it, points to the right.
const STEP: f32 = 12.0;
/// Room for the weight's bar, and for its number.
const BAR: f32 = 48.0;
const NUMBER: f32 = 40.0;

/// A node as it is drawn.
#[derive(Clone, PartialEq, Debug)]
pub struct Row {
    /// How many nodes it is in.
    pub depth: usize,
    /// What it is.
    pub label: String,
    /// Its weight in the whole, 0 to 1.
    pub weight: f64,
    /// Whether it plays a clip.
    pub is_clip: bool,
}

/// Shows the tree of the walker that is steered.
pub fn show(ui: &mut Ui, walk: &Walk) {
    ui.add_space(4.0);
    let rows = walk.tree_rows();
    let (_, rect) = ui.allocate_space(vec2(ui.available_width(), ROW * rows.len() as f32));
    for (i, row) in rows.iter().enumerate() {
        let place = Rect::from_min_size(rect.left_top() + vec2(0.0, ROW * i as f32), vec2(rect.width(), ROW));
        if ui.is_rect_visible(place) {
            links(ui, place, &rows, i);
            node(ui, place, row);
        }
        // What a screen reader tells, and a test reads.
        let response = ui.interact(place, egui::Id::unique(("tree node", i)), egui::Sense::hover());
        let words = format!("{} {:.0} %", row.label, row.weight * 100.0);
        response.widget_info(|| WidgetInfo::labeled(egui::Role::Label, true, &words));
    }
}

fn dot(place: Rect, depth: usize) -> Pos2 {
    pos2(place.left() + 8.0 + STEP * depth as f32, place.center().y)
}

/// The lines that lead to a node, and past it to its siblings below.
fn links(ui: &Ui, place: Rect, rows: &[Row], i: usize) {
    let (painter, palette) = (ui.painter(), theme::of(ui));
    let stroke = |weight: f64| match weight > 0.0 {
        true => Stroke::new(1.5, palette.accent),
        false => Stroke::new(1.0, palette.line),
    };
    let depth = rows[i].depth;
    if depth > 0 {
        let at = dot(place, depth - 1).x;
        let end = dot(place, depth);
        painter.vline(at, place.top()..=end.y, stroke(rows[i].weight));
        painter.hline(at..=end.x - 4.0, end.y, stroke(rows[i].weight));
    }
    for level in 1..=depth {
        // A later sibling at this level, before the branch ends.
        let later = rows[i + 1..].iter().take_while(|row| row.depth >= level);
        let siblings: Vec<&Row> = later.filter(|row| row.depth == level).collect();
        if siblings.is_empty() {
            continue;
        }
        let weight = siblings.iter().map(|row| row.weight).fold(0.0, f64::max);
        let from = if level == depth { place.center().y } else { place.top() };
        painter.vline(dot(place, level - 1).x, from..=place.bottom(), stroke(weight));
    }
    if rows.get(i + 1).is_some_and(|next| next.depth > depth) {
        let weight = rows[i + 1..].iter().take_while(|row| row.depth > depth).map(|row| row.weight);
        painter.vline(
            dot(place, depth).x,
            place.center().y..=place.bottom(),
            stroke(weight.fold(0.0, f64::max)),
        );
    }
}

fn node(ui: &Ui, place: Rect, row: &Row) {
    let (painter, palette) = (ui.painter(), theme::of(ui));
    let (at, lives) = (dot(place, row.depth), row.weight > 0.0);
    let color = if lives { palette.accent } else { palette.line };
    match row.is_clip {
        true => painter.circle_filled(at, 4.0, color),
        false => painter.rect_filled(Rect::from_center_size(at, vec2(8.0, 8.0)), 2.0, color),
    };
    let ink = if lives { palette.text } else { palette.faint_text };
    let end = place.right() - NUMBER;
    let words = Rect::from_min_max(pos2(at.x + 9.0, place.top()), pos2(end - BAR - 6.0, place.bottom()));
    painter.with_clip_rect(words.intersect(ui.clip_rect())).text(
        words.left_center(),
        Align2::LEFT_CENTER,
        &row.label,
        FontId::proportional(12.0),
        ink,
    );
    let rail = Rect::from_min_max(pos2(end - BAR, place.center().y - 3.0), pos2(end, place.center().y + 3.0));
    painter.rect_filled(rail, 2.0, palette.rail);
    let share = row.weight.clamp(0.0, 1.0) as f32;
    let bar = rail.with_max_x(rail.left() + rail.width() * share);
    painter.rect_filled(bar, 2.0, if lives { palette.accent } else { Color32::TRANSPARENT });
    let number = if lives { format!("{:.0} %", row.weight * 100.0) } else { "–".to_owned() };
    painter.text(
        pos2(place.right() - 2.0, place.center().y),
        Align2::RIGHT_CENTER,
        number,
        FontId::proportional(11.5),
        ink,
    );
}
