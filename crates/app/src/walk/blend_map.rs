//! The axis blend that is live, as a map: its points where their parameters are, and where the walk is between them.

use egui::{Align2, FontId, Pos2, Rect, Sense, Stroke, Ui, WidgetInfo, pos2, vec2};
use motion::{OutlineNode, Parameter, Steering};

use crate::theme;

/// A map's height, points.
const HEIGHT: f32 = 104.0;
const GAP: f32 = 8.0;
/// What is left free around the points of a map.
const INSET: f32 = 14.0;

/// An axis blend that has a weight.
#[derive(Clone, PartialEq, Debug)]
pub struct BlendMap {
    by: Vec<Parameter>,
    /// Where each point is, and its weight in the whole.
    points: Vec<([f64; 3], f64)>,
    /// Where the walk is.
    at: [f64; 3],
}

impl BlendMap {
    /// The first axis blend with a weight among a tree's nodes, and where steering is in it.
    pub fn of<'a>(outline: impl Iterator<Item = OutlineNode<'a>>, steering: &Steering) -> Option<BlendMap> {
        let nodes: Vec<OutlineNode> = outline.collect();
        let place = nodes.iter().position(|node| node.blend.is_some())?;
        let (depth, view) = (nodes[place].depth, nodes[place].blend?);
        let inside = nodes[place + 1..].iter().take_while(|node| node.depth > depth);
        let weights = inside.filter(|node| node.depth == depth + 1).map(|node| node.weight);
        let mut at = [0.0; 3];
        for (value, parameter) in at.iter_mut().zip(view.by) {
            *value = steering.get(*parameter);
        }
        Some(BlendMap {
            by: view.by.to_vec(),
            points: view.points.iter().copied().zip(weights).collect(),
            at,
        })
    }

    /// Shows one map for a blend by one or two parameters, two maps for one by three: each has the first parameter upward.
    pub fn show(&self, ui: &mut Ui) {
        let across: &[Option<usize>] = match self.by.len() {
            0 | 1 => &[None],
            2 => &[Some(1)],
            _ => &[Some(1), Some(2)],
        };
        let (_, whole) = ui.allocate_space(vec2(ui.available_width(), HEIGHT));
        let width = (whole.width() - GAP * (across.len() - 1) as f32) / across.len() as f32;
        for (i, across) in across.iter().enumerate() {
            let left = whole.left() + (width + GAP) * i as f32;
            let rect = Rect::from_min_size(pos2(left, whole.top()), vec2(width, HEIGHT));
            if ui.is_rect_visible(rect) {
                self.map(ui, rect, *across);
            }
            let response = ui.interact(rect, egui::Id::unique(("blend map", i)), Sense::hover());
            let words = format!("Blend by {}", self.name(*across));
            response.widget_info(|| WidgetInfo::labeled(egui::Role::Image, true, &words));
            response
                .on_hover_text("Dots: what is blended, as large as its weight. Ring: where the walk is now");
        }
    }

    fn name(&self, across: Option<usize>) -> String {
        let first = self.by.first().map_or("", |by| by.name());
        across.map_or_else(|| first.to_owned(), |across| format!("{first} and {}", self.by[across].name()))
    }

    fn map(&self, ui: &Ui, rect: Rect, across: Option<usize>) {
        let (painter, palette) = (ui.painter().with_clip_rect(rect.intersect(ui.clip_rect())), theme::of(ui));
        painter.rect_filled(rect, 3.0, palette.well);
        let field = rect.shrink(INSET);
        let [low, high] = self.span(0);
        let [left, right] = across.map_or([-1.0, 1.0], |across| self.span(across));
        let place = |point: &[f64; 3]| -> Pos2 {
            let share =
                |value: f64, from: f64, to: f64| ((value - from) / (to - from)).clamp(-0.1, 1.1) as f32;
            let sideways = across.map_or(0.0, |across| point[across]);
            // What goes to the figure's left is at the left.
            let x = field.right() - field.width() * share(sideways, left, right);
            pos2(x, field.bottom() - field.height() * share(point[0], low, high))
        };
        let origin = place(&[0.0; 3]);
        let axis = Stroke::new(1.0, palette.line);
        painter.hline(rect.x_range(), origin.y, axis);
        painter.vline(origin.x, rect.y_range(), axis);
        let font = FontId::proportional(10.5);
        let first = self.by.first().map_or("", |by| by.name());
        let at = pos2(origin.x + 4.0, rect.top() + 2.0);
        painter.text(at, Align2::LEFT_TOP, first, font.clone(), palette.faint_text);
        if let Some(across) = across {
            let at = pos2(rect.left() + 4.0, rect.bottom() - 2.0);
            painter.text(at, Align2::LEFT_BOTTOM, self.by[across].name(), font, palette.faint_text);
        }
        for (point, weight) in &self.points {
            painter.circle_filled(place(point), 2.5, palette.live);
            if *weight > 0.0 {
                painter.circle_filled(place(point), 3.0 + 5.0 * (*weight as f32).sqrt(), palette.accent);
            }
        }
        let now = place(&self.at);
        painter.circle_stroke(now, 6.0, Stroke::new(2.0, palette.strong_text));
    }

    /// The least and the greatest value of a parameter among the points, and 0.
    fn span(&self, part: usize) -> [f64; 2] {
        let values = self.points.iter().map(|(point, _)| point[part]);
        let [low, high] = values.fold([0.0, 0.0], |[low, high]: [f64; 2], v| [low.min(v), high.max(v)]);
        if high - low > 1e-9 { [low, high] } else { [low - 1.0, high + 1.0] }
    }
}
