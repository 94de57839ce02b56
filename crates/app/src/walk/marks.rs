//! Marks over a walker, each switched on by itself: what the feet's placement changed, where soles stand and stood.

use egui::Color32;
use glam::{DQuat, DVec3};
use render::{Color, Layer};
use rig::{Bone, Frames, Side};

use super::prints::{Prints, rounded};
use super::stage::Moment;
use crate::theme;
use crate::viewport::drawing::{Drawing, Pen, rgba};

/// One thing that can be shown over a walker.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Mark {
    /// The axes of each foot at its ankle.
    AnkleAxes,
    /// From hip to ankle, as the motion has it and as it was placed.
    LegLines,
    /// The axis about which that line was turned.
    TurnAxis,
    /// How far the hips are lowered.
    HipsDrop,
    /// Where soles stood.
    Footprints,
    /// The points of the soles, and how far off the ground each is.
    SolePoints,
}

impl Mark {
    /// All of them.
    pub const ALL: [Mark; 6] =
        [Mark::LegLines, Mark::TurnAxis, Mark::AnkleAxes, Mark::HipsDrop, Mark::SolePoints, Mark::Footprints];

    /// The words beside its box.
    pub const fn words(self) -> &'static str {
        match self {
            Mark::AnkleAxes => "Ankle axes",
            Mark::LegLines => "Hip to foot",
            Mark::TurnAxis => "Turn axis",
            Mark::HipsDrop => "Hips drop",
            Mark::Footprints => "Footprints",
            Mark::SolePoints => "Sole points",
        }
    }

    /// What it shows.
    pub const fn tip(self) -> &'static str {
        match self {
            Mark::AnkleAxes => {
                "The foot's own axes at the ankle: X red to its left, Y green up, Z blue ahead"
            }
            Mark::LegLines => {
                "From the hip to the foot: dashed as the motion on flat ground has it, solid as it was placed"
            }
            Mark::TurnAxis => {
                "The axis through the hip about which the leg was turned to its place, and by how much"
            }
            Mark::HipsDrop => "How far the hips are lowered so that both feet reach the ground",
            Mark::Footprints => "Where soles stood",
            Mark::SolePoints => {
                "The points of the soles: filled where they touch, with what they are off the ground in millimetres"
            }
        }
    }
}

/// Which marks are shown.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Marks([bool; Mark::ALL.len()]);

impl Default for Marks {
    fn default() -> Marks {
        let mut marks = Marks([false; Mark::ALL.len()]);
        marks.set(Mark::Footprints, true);
        marks
    }
}

impl Marks {
    /// Whether a mark is shown.
    pub fn has(&self, mark: Mark) -> bool {
        self.0[mark as usize]
    }

    /// Shows or hides a mark.
    pub fn set(&mut self, mark: Mark, on: bool) {
        self.0[mark as usize] = on;
    }
}

/// Points this near to the ground touch it, metres.
const TOUCH_M: f64 = 0.01;
/// Marks on the ground lie so far above it, metres: the depth of a picture is not exact.
const LIFT_M: f64 = 0.006;
const AXES: [(DVec3, Color); 3] =
    [(DVec3::X, [242, 98, 88, 255]), (DVec3::Y, [138, 208, 98, 255]), (DVec3::Z, [94, 160, 252, 255])];
const PALE: Color = [236, 238, 244, 190];

/// A walker whose marks are drawn.
pub struct Of<'a> {
    /// The walker as it is shown.
    pub moment: &'a Moment,
    /// Its joints in the world.
    pub frames: &'a Frames,
    /// Where its feet stood.
    pub prints: &'a Prints,
}

impl Of<'_> {
    /// Draws the marks that are on.
    pub fn draw(&self, drawing: &mut Drawing, marks: Marks) {
        if marks.has(Mark::Footprints) {
            self.footprints(drawing);
        }
        for side in [Side::Left, Side::Right] {
            if marks.has(Mark::LegLines) {
                self.leg_line(drawing, side);
            }
            if marks.has(Mark::TurnAxis) {
                self.turn_axis(drawing, side);
            }
            if marks.has(Mark::AnkleAxes) {
                self.ankle_axes(drawing, side);
            }
            if marks.has(Mark::SolePoints) {
                self.sole_points(drawing, side);
            }
        }
        if marks.has(Mark::HipsDrop) {
            self.hips_drop(drawing);
        }
    }

    fn hip(&self, side: Side) -> DVec3 {
        self.frames[if side == Side::Left { Bone::LeftUpperLeg } else { Bone::RightUpperLeg }].position
    }

    /// The ankle as the motion has it and as it was placed.
    fn ankles(&self, side: Side) -> [DVec3; 2] {
        let foot = &self.moment.feet[side as usize];
        [foot.animated_ankle_in_world, foot.ankle_in_world]
    }

    fn footprints(&self, drawing: &mut Drawing) {
        for (print, fresh) in self.prints.all() {
            let alpha = 40.0 + 130.0 * fresh;
            let color = rgba(theme::side(print.side), alpha as u8);
            let outline = rounded(&print.outline);
            let corners: Vec<_> = outline.iter().map(|p| (*p + DVec3::Y * LIFT_M).as_vec3()).collect();
            drawing.overlay.polygon(&corners, color, Layer::Tested);
            let rim =
                Pen { layer: Layer::Tested, ..Pen::new(rgba(theme::side(print.side), alpha as u8), 1.25) };
            for (from, to) in outline.iter().zip(outline.iter().cycle().skip(1)) {
                drawing.line(*from + DVec3::Y * LIFT_M, *to + DVec3::Y * LIFT_M, rim);
            }
        }
    }

    fn leg_line(&self, drawing: &mut Drawing, side: Side) {
        let (hip, [animated, placed]) = (self.hip(side), self.ankles(side));
        let was = Pen::new(PALE, 1.5).dashed(7.0);
        drawing.line(hip, animated, was.under());
        drawing.line(hip, animated, was);
        drawing.disc(animated, 3.0, PALE, Layer::OnTop);
        let is = Pen::new(rgba(theme::side(side), 255), 2.25);
        drawing.line(hip, placed, is.under());
        drawing.line(hip, placed, is);
        drawing.disc(placed, 4.0, rgba(theme::side(side), 255), Layer::OnTop);
        drawing.disc(hip, 4.0, rgba(theme::side(side), 255), Layer::OnTop);
    }

    fn turn_axis(&self, drawing: &mut Drawing, side: Side) {
        let (hip, [animated, placed]) = (self.hip(side), self.ankles(side));
        let Some((axis, degrees)) = turn_between(animated - hip, placed - hip) else { return };
        let [r, g, b, _] = theme::ACCENT.to_array();
        let pen = Pen::new([r, g, b, 255], 2.25);
        let arm = 44.0 * drawing.sight.metres_per_px(hip);
        drawing.line(hip - axis * arm, hip + axis * arm, pen.under());
        drawing.line(hip - axis * arm, hip + axis * arm, pen);
        drawing.ring(hip, axis, 14.0 * drawing.sight.metres_per_px(hip), Pen { width: 1.5, ..pen });
        drawing.write(hip + axis * arm * 1.2, [0.0, 0.0], format!("{degrees:.0}°"), theme::ACCENT);
    }

    fn ankle_axes(&self, drawing: &mut Drawing, side: Side) {
        let foot = self.frames[if side == Side::Left { Bone::LeftFoot } else { Bone::RightFoot }];
        let arm = 34.0 * drawing.sight.metres_per_px(foot.position);
        for (axis, color) in AXES {
            let pen = Pen::new(color, 2.25);
            let end = foot.position + foot.rotation * axis * arm;
            drawing.line(foot.position, end, pen.under());
            drawing.line(foot.position, end, pen);
        }
        drawing.disc(foot.position, 3.0, PALE, Layer::OnTop);
    }

    fn sole_points(&self, drawing: &mut Drawing, side: Side) {
        let foot = &self.moment.feet[side as usize];
        let mut worst: Option<(DVec3, f64)> = None;
        for (point, ground) in foot.sole_in_world.iter().zip(&foot.ground_under_sole) {
            let off = point.y - ground;
            let touches = off.abs() <= TOUCH_M;
            let color = match touches {
                true => rgba(theme::side(side), 255),
                false if off < 0.0 => rgba(theme::WARNING, 255),
                false => PALE,
            };
            let down = DVec3 { y: *ground, ..*point };
            let pen = Pen::new([color[0], color[1], color[2], 200], 1.25);
            drawing.line(*point, down, pen);
            drawing.disc(*point, if touches { 3.0 } else { 2.25 }, color, Layer::OnTop);
            if worst.is_none_or(|(_, w)| off.abs() > w.abs()) {
                worst = Some((*point, off));
            }
        }
        if let Some((at, off)) = worst.filter(|_| foot.stance) {
            let color = if off < -TOUCH_M { theme::WARNING } else { Color32::from_gray(225) };
            drawing.write(at, [0.0, 16.0], format!("{:+.0} mm", off * 1000.0), color);
        }
    }

    /// A bar behind the hips from where they were to where they are, with the way in centimetres.
    fn hips_drop(&self, drawing: &mut Drawing) {
        let (drop, hips) = (self.moment.hips_drop_m, self.frames[Bone::Hips].position);
        let right = drawing.sight.camera.axes().x_axis.as_dvec3();
        let aside = right * (70.0 * drawing.sight.metres_per_px(hips));
        let (is, was) = (hips + aside, hips + aside + DVec3::Y * drop);
        let tick = right * (9.0 * drawing.sight.metres_per_px(hips));
        let [r, g, b, _] = theme::ACCENT.to_array();
        let bar = Pen::new([r, g, b, 255], 5.0);
        for (from, to, pen) in [
            (was, is, bar),
            (was - tick, was + tick, Pen::new(PALE, 1.75)),
            (is - tick, is + tick, Pen::new([r, g, b, 255], 2.0)),
        ] {
            drawing.line(from, to, pen.under());
            drawing.line(from, to, pen);
        }
        drawing.write(is, [38.0, 0.0], format!("{:.1} cm", drop * 100.0), theme::ACCENT);
    }
}

/// The axis and the angle, degrees, that turn one direction to another; `None` where there is nothing to turn.
fn turn_between(from: DVec3, to: DVec3) -> Option<(DVec3, f64)> {
    let (from, to) = (from.try_normalize()?, to.try_normalize()?);
    let (axis, angle_rad) = DQuat::from_rotation_arc(from, to).to_axis_angle();
    (angle_rad > 0.3_f64.to_radians()).then_some((axis, angle_rad.to_degrees()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_turn_from_down_to_ahead_is_about_the_side() {
        let (axis, degrees) = turn_between(DVec3::NEG_Y, DVec3::new(0.0, -2.0, 2.0)).unwrap_or_default();
        assert!((degrees - 45.0).abs() < 1e-9 && axis.distance(DVec3::NEG_X) < 1e-9, "{axis} {degrees}");
        assert_eq!(turn_between(DVec3::X, DVec3::X), None);
        assert_eq!(turn_between(DVec3::ZERO, DVec3::X), None);
    }

    #[test]
    fn marks_are_switched_by_themselves() {
        let mut marks = Marks::default();
        for mark in Mark::ALL {
            marks.set(mark, true);
            assert!(marks.has(mark));
        }
        marks.set(Mark::TurnAxis, false);
        assert!(Mark::ALL.iter().all(|mark| marks.has(*mark) == (*mark != Mark::TurnAxis)));
    }
}
