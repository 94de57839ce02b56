//! Guides to what a line of links reaches, each switched on by itself: target, line, limits, swing, grids, axes.

use edit::{ChainEditor, ChainNode, ChainReach, ChainSpan, chain_axis, chain_span};
use egui::{Color32, Ui};
use glam::DVec3;
use rig::DofPart;

use super::panel::line;
use crate::theme;
use crate::viewport::Guide;
use crate::viewport::drawing::{Drawing, Pen, rgba};
use crate::viewport::guides;

/// Which guides are shown.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct ChainGuides([bool; Guide::ALL.len()]);

/// The line, the outer limit: what reaches; the inner limit: what is folded; the swing of a middle joint.
const REACH: Color32 = Color32::from_rgb(92, 176, 240);
const SWING: Color32 = Color32::from_rgb(214, 164, 255);
/// Lines of a grid from the root to the outer limit, about.
const LINES: f64 = 6.0;
const AXIS_PT: f64 = 44.0;

impl ChainGuides {
    /// Shows a guide.
    pub fn set(&mut self, guide: Guide) {
        self.0[guide as usize] = true;
    }

    /// A button for each guide.
    pub fn show(&mut self, ui: &mut Ui) {
        line(ui, "Guides", |ui| {
            // A narrow panel has room for them in two rows.
            ui.horizontal_wrapped(|ui| {
                ui.spacing_mut().item_spacing = egui::vec2(1.0, 2.0);
                ui.spacing_mut().button_padding.x = 5.0;
                Guide::ALL.into_iter().for_each(|guide| self.button(ui, guide));
            });
        });
    }

    fn button(&mut self, ui: &mut Ui, guide: Guide) {
        let on = &mut self.0[guide as usize];
        let word = egui::RichText::new(guide.word()).size(11.0);
        let button = egui::Button::selectable(*on, word).min_size(egui::vec2(0.0, 20.0));
        let name = format!("Guide: {}", guide.name());
        if ui.add(button).accessible_name(name).on_hover_text(explained(guide)).clicked() {
            *on = !*on;
        }
    }

    /// Draws those that are on for the line of links through a node.
    pub fn draw(
        self,
        drawing: &mut Drawing,
        editor: &ChainEditor,
        node: ChainNode,
        reach: Option<&ChainReach>,
    ) {
        if !self.0.contains(&true) {
            return;
        }
        let Some(span) = chain_span(editor, node) else { return };
        let end = &editor.robot().links()[span.link].name;
        let target = reach.filter(|reach| reach.link == *end).map_or(span.end_in_world, |reach| reach.target);
        let root = span.root_in_world;
        for guide in Guide::ALL.into_iter().filter(|guide| self.0[*guide as usize]) {
            match guide {
                Guide::Cursor => guides::cursor(drawing, target),
                Guide::Pointer => guides::pointer(drawing, [root, target], span.outer_m, REACH),
                Guide::Outer => guides::limit(drawing, root, span.outer_m, REACH, "outer limit"),
                Guide::Inner => guides::limit(drawing, root, span.inner_m, theme::ACCENT, "inner limit"),
                Guide::Elevation => swing(drawing, &span),
                Guide::Planes => {
                    let turn = editor.document().world_from_root.rotation;
                    guides::planes(drawing, root, turn, span.outer_m, pitch(span.outer_m));
                }
                Guide::Axes => span.joints.iter().for_each(|joint| axes(drawing, editor, *joint)),
            }
        }
    }
}

const fn explained(guide: Guide) -> &'static str {
    match guide {
        Guide::Cursor => "The target of the last reach, or the end, with a plumb line to the ground",
        Guide::Pointer => "The line from the first joint that turns to the target, and its length",
        Guide::Outer => "How far the end gets when the line of links is stretched",
        Guide::Inner => "How near the end gets when the line of links is folded",
        Guide::Elevation => "The circle on which the middle joint of two can swing while the end stays",
        Guide::Planes => "Grids through the first joint that turns, on three planes",
        Guide::Axes => "The axes about which the joints turn",
    }
}

fn swing(drawing: &mut Drawing, span: &ChainSpan) {
    let Some(circle) = span.swing else { return };
    drawing.ring(circle.center, circle.axis, circle.radius_m, Pen::new(rgba(SWING, 255), 2.5).under());
    drawing.ring(circle.center, circle.axis, circle.radius_m, Pen::new(rgba(SWING, 255), 2.5));
    drawing.line(circle.center, circle.point(0.0), Pen::new(rgba(SWING, 200), 1.5));
    drawing.disc(circle.center, 2.0, rgba(SWING, 255), render::Layer::OnTop);
    let words = format!("swings at {:.0} mm", circle.radius_m * 1e3);
    drawing.write(circle.point(0.0), [24.0, -16.0], words, SWING);
}

/// Each axis of a joint through its place, to the side about which larger values turn to the left.
fn axes(drawing: &mut Drawing, editor: &ChainEditor, joint: usize) {
    let Some(frame) = editor.frames().get(joint + 1) else { return };
    let (at, own) = (frame.position, &editor.robot().joints()[joint]);
    let arm = AXIS_PT * drawing.sight.metres_per_px(at);
    for part in own.kind.parts().iter().filter(|part| part.is_angle()) {
        let Some(axis): Option<DVec3> = chain_axis(editor, joint, *part) else { continue };
        let (color, words) = match part {
            DofPart::Turn => (theme::ACCENT, own.name.clone()),
            other => (super::marks::color(*other), other.name().to_owned()),
        };
        let pen = Pen::new(rgba(color, 255), 2.0);
        drawing.line(at - axis * arm * 0.5, at + axis * arm, pen.under());
        drawing.line(at - axis * arm * 0.5, at + axis * arm, pen);
        drawing.write(at + axis * arm * 1.2, [0.0, 0.0], words, color);
    }
}

/// A power of ten, twice or five times that, metres, so that a reach has some lines.
fn pitch(reach_m: f64) -> f64 {
    let wanted = reach_m / LINES;
    let ten = 10f64.powf(wanted.log10().floor());
    [1.0, 2.0, 5.0].into_iter().map(|times| times * ten).find(|pitch| *pitch >= wanted).unwrap_or(10.0 * ten)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn grids_have_round_pitches_and_some_lines() {
        for (reach, expected) in [(0.9, 0.2), (4.2, 1.0), (0.05, 0.01), (60.0, 10.0), (2.9, 0.5)] {
            assert!((pitch(reach) - expected).abs() < 1e-9, "{reach}: {}", pitch(reach));
        }
    }
}
