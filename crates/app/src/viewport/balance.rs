//! The centre of mass over what the figure stands on: marks in the picture, and words for the panel.

use edit::Editor;
use glam::{DVec3, Vec2};
use render::Layer;
use rig::{Falls, Support};

use super::drawing::{Drawing, Pen, rgba};
use crate::theme;

/// What the figure stands on as it is shown now; `None` if no sole is near the ground.
fn support(editor: &Editor) -> Option<Support> {
    let evaluation = editor.evaluation();
    rig::support(editor.figure(), &evaluation.frames, evaluation.center_of_mass)
}

/// Whether and how well the figure stands, in words, and whether they warn.
pub fn words(editor: &Editor) -> (String, bool) {
    let Some(support) = support(editor) else { return ("no sole on the ground".to_owned(), true) };
    let centimetres = support.margin_m.abs() * 100.0;
    match support.falls(editor.pose()) {
        None => (format!("balanced, {centimetres:.1} cm inside the soles"), false),
        Some(falls) => (format!("falls {}, by {centimetres:.1} cm", way(falls)), true),
    }
}

fn way(falls: Falls) -> &'static str {
    match falls {
        Falls::Forward => "forward",
        Falls::Backward => "backward",
        Falls::Left => "to its left",
        Falls::Right => "to its right",
    }
}

/// Draws the outline of the soles on the ground, the centre of mass and its plumb line: a ring where it meets the ground
/// within the outline, a cross outside.
pub fn draw(drawing: &mut Drawing, editor: &Editor) {
    let (text, warns) = words(editor);
    let color = if warns { theme::WARNING } else { theme::ACCENT };
    let (pen, center) = (Pen::new(rgba(color, 255), 2.0), editor.evaluation().center_of_mass);
    let ground = DVec3::new(center.x, 0.0, center.z);
    if let Some(support) = support(editor) {
        let outline: Vec<DVec3> = support.outline.iter().map(|corner| *corner + DVec3::Y * LIFT_M).collect();
        let corners: Vec<_> = outline.iter().map(|corner| corner.as_vec3()).collect();
        drawing.overlay.polygon(&corners, rgba(color, 90), Layer::Tested);
        for (from, to) in outline.iter().zip(outline.iter().cycle().skip(1)) {
            drawing.line(*from, *to, pen.ghosted());
        }
        if !support.is_balanced() {
            drawing.line(ground, ground + support.to_edge, pen.dashed(4.0));
        }
    }
    drawing.line(center, ground, Pen { width: 1.5, ..pen }.dashed(6.0));
    let foot = if warns { cross() } else { ring() };
    drawing.glyph(ground, &foot, pen);
    drawing.disc(center, 5.0, rgba(color, 255), Layer::OnTop);
    drawing.write(ground, [0.0, 18.0], text, color);
}

/// Above the ground, so that neither hides the other.
const LIFT_M: f64 = 0.004;

fn cross() -> Vec<[Vec2; 2]> {
    [Vec2::new(6.0, 6.0), Vec2::new(6.0, -6.0)].map(|v| [v, -v]).to_vec()
}

fn ring() -> Vec<[Vec2; 2]> {
    super::drawing::circle_strokes(6.0, 20)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)] // helpers of tests may unwrap too
mod tests {
    use std::sync::Arc;

    use edit::{Command, NoFiles, Request};

    use super::*;

    #[test]
    fn words_say_where_the_figure_falls() {
        let mut editor = Editor::new(Arc::new(interchange::figure::bare_mannequin().unwrap()));
        assert!(words(&editor).0.starts_with("balanced"), "{:?}", words(&editor));
        let mut shift = |by, expected: &str| {
            editor.submit(Request::Do(Command::MoveHips { by }), &mut NoFiles).unwrap();
            assert!(words(&editor).0.contains(expected), "{:?} for {expected}", words(&editor));
        };
        // Legs in the air hang along, so the soles go with the hips and nothing falls.
        shift(DVec3::X * 0.2, "balanced");
        shift(DVec3::Y * 0.2, "no sole");
    }
}
