//! Brackets at the corners of what is chosen, as it lies in the picture.

use edit::{ChainEditor, ChainNode};
use egui::{Color32, Pos2, Rect, Stroke, Ui, vec2};

use super::picture::ChainPicture;
use crate::theme;

/// Free around what is chosen, points.
const AIR: f32 = 7.0;
/// Smaller things have brackets around so much.
const LEAST: f32 = 30.0;
/// A bracket's arm: at most so long, and no more than so much of an edge.
const ARM: f32 = 16.0;
const ARM_SHARE: f32 = 0.32;

/// Paints the brackets.
pub fn paint(ui: &Ui, picture: &ChainPicture, editor: &ChainEditor, node: ChainNode) {
    let Some(rect) = around(picture, editor, node) else { return };
    let painter = ui.painter().with_clip_rect(picture.rect());
    let [x, y] = [rect.width(), rect.height()].map(|edge| ARM.min(edge * ARM_SHARE));
    let corners = [
        (rect.left_top(), 1.0, 1.0),
        (rect.right_top(), -1.0, 1.0),
        (rect.right_bottom(), -1.0, -1.0),
        (rect.left_bottom(), 1.0, -1.0),
    ];
    for stroke in [Stroke::new(4.0, Color32::from_black_alpha(110)), Stroke::new(2.0, theme::of(ui).accent)] {
        for (at, right, down) in corners {
            let arms = [at + vec2(x * right, 0.0), at, at + vec2(0.0, y * down)];
            painter.add(egui::Shape::line(arms.to_vec(), stroke));
        }
    }
}

/// What is chosen in the picture, points; `None` behind the eye. The root stands for the whole chain.
fn around(picture: &ChainPicture, editor: &ChainEditor, node: ChainNode) -> Option<Rect> {
    let seen: Vec<Pos2> =
        picture.corners(editor, node).into_iter().filter_map(|corner| picture.window_of(corner)).collect();
    let (first, rest) = seen.split_first()?;
    let tight = rest
        .iter()
        .fold(Rect::from_min_max(*first, *first), |rect, at| rect.union(Rect::from_min_max(*at, *at)));
    let size = (tight.size() + vec2(2.0 * AIR, 2.0 * AIR)).max(vec2(LEAST, LEAST));
    Some(Rect::from_center_size(tight.center(), size))
}
