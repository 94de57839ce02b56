//! Guides to a limb's reach, each switched on by itself: target, pointer line, limits, elevation, planes, axes.

use edit::{Axis, Circle, Editor, axis, elevation_circle};
use egui::Color32;
use glam::{DQuat, DVec3};
use render::{Ball, Color, Layer};
use rig::{Bone, Dof, Limb, ReachLimits, reach_limits};

use super::drawing::{Drawing, Pen, rgba};
use super::marks::axis_color;
use crate::theme;

/// One thing that can be shown of a limb's reach.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Guide {
    /// The target: a cross along the world's axes, and a plumb line to the ground.
    Cursor,
    /// The line from the root to the target.
    Pointer,
    /// The sphere of the stretched limb.
    Outer,
    /// The sphere of the folded limb.
    Inner,
    /// The circle on which elbow or knee can swing.
    Elevation,
    /// Grids through the root, on the three planes of what carries it.
    Planes,
    /// The axes of the limb's joints.
    Axes,
}

impl Guide {
    /// All of them.
    pub const ALL: [Guide; 7] = [
        Guide::Cursor,
        Guide::Pointer,
        Guide::Outer,
        Guide::Inner,
        Guide::Elevation,
        Guide::Planes,
        Guide::Axes,
    ];

    /// The word on its button.
    pub const fn word(self) -> &'static str {
        match self {
            Guide::Cursor => "Target",
            Guide::Pointer => "Line",
            Guide::Outer => "Outer",
            Guide::Inner => "Inner",
            Guide::Elevation => "Circle",
            Guide::Planes => "Grids",
            Guide::Axes => "Axes",
        }
    }

    /// Its name in full.
    pub const fn name(self) -> &'static str {
        match self {
            Guide::Cursor => "target",
            Guide::Pointer => "pointer line",
            Guide::Outer => "outer limit",
            Guide::Inner => "inner limit",
            Guide::Elevation => "elevation circle",
            Guide::Planes => "grids",
            Guide::Axes => "joint axes",
        }
    }

    /// What it shows.
    pub const fn tip(self) -> &'static str {
        match self {
            Guide::Cursor => "The target, with a plumb line to the ground",
            Guide::Pointer => "The line from the limb's root to its target, and its length",
            Guide::Outer => "How far the limb reaches when it is stretched",
            Guide::Inner => "How near it reaches when it is folded as far as it goes",
            Guide::Elevation => {
                "The circle on which elbow or knee swings; the thick part is what the ranges leave open"
            }
            Guide::Planes => "Grids of 10 cm through the limb's root, on three planes",
            Guide::Axes => {
                "The axes of the limb's joints: flexion F solid, abduction A in dashes, twist T in dots, as the rings are"
            }
        }
    }
}

/// Which guides are shown, limb by limb.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Guides([[bool; Guide::ALL.len()]; Limb::ALL.len()]);

impl Guides {
    /// Whether a guide is shown.
    pub fn has(&self, limb: Limb, guide: Guide) -> bool {
        self.0[limb.index()][guide as usize]
    }

    /// Shows or hides a guide.
    pub fn set(&mut self, limb: Limb, guide: Guide, on: bool) {
        self.0[limb.index()][guide as usize] = on;
    }

    /// Whether any guide of a limb is shown.
    pub fn any(&self, limb: Limb) -> bool {
        self.0[limb.index()].contains(&true)
    }
}

/// The pitch of the grids, metres.
const PITCH_M: f64 = 0.1;
const AXIS_PT: f64 = 46.0;
const ELEVATION: Color = [214, 164, 255, 255];

/// Draws the guides that are on.
pub fn draw(drawing: &mut Drawing, editor: &Editor, guides: &Guides) {
    for limb in Limb::ALL.into_iter().filter(|limb| guides.any(*limb)) {
        let document = editor.document();
        let frames = &editor.evaluation().frames;
        let Some(limits) = reach_limits(editor.figure(), &document.pose, frames, limb, document.ranges)
        else {
            continue;
        };
        let of = Of { editor, limb, limits, side: theme::side(limb.side()) };
        let root = limits.root_in_world;
        for guide in Guide::ALL.into_iter().filter(|guide| guides.has(limb, *guide)) {
            match guide {
                Guide::Cursor => cursor(drawing, of.target()),
                Guide::Pointer => pointer(drawing, [root, of.target()], limits.outer_m, of.side),
                Guide::Outer => limit(drawing, root, limits.outer_m, of.side, "outer limit"),
                Guide::Inner => limit(drawing, root, limits.inner_m, theme::ACCENT, "inner limit"),
                Guide::Elevation => of.elevation(drawing),
                Guide::Planes => of.planes(drawing),
                Guide::Axes => of.axes(drawing),
            }
        }
    }
}

/// A limb whose guides are drawn.
struct Of<'a> {
    editor: &'a Editor,
    limb: Limb,
    limits: ReachLimits,
    side: Color32,
}

impl Of<'_> {
    fn target(&self) -> DVec3 {
        self.editor.evaluation().limbs[self.limb.index()].target
    }

    /// The whole circle thin, what the ranges leave open thick, with a spoke to the hinge.
    fn elevation(&self, drawing: &mut Drawing) {
        let view = self.editor.evaluation().limbs[self.limb.index()];
        let (figure, pose) = (self.editor.figure(), self.editor.pose());
        let frames = &self.editor.evaluation().frames;
        let (Some(now), Some((circle, sense))) =
            (view.elevation, elevation_circle(figure, pose, frames, self.limb))
        else {
            return;
        };
        let [r, g, b, _] = ELEVATION;
        drawing.ring(circle.center, circle.axis, circle.radius_m, Pen::new([r, g, b, 110], 1.25).dashed(6.0));
        if let Some(range) = view.elevation_range {
            let [low, high] = range.map(|end| (end - now).to_radians() * sense);
            drawing.arc(&circle, low, high, Pen::new(ELEVATION, 3.0).under());
            drawing.arc(&circle, low, high, Pen::new(ELEVATION, 3.0));
        }
        let spoke = Pen::new([r, g, b, 200], 1.5);
        drawing.line(circle.center, circle.point(0.0), spoke);
        self.tick(drawing, &circle, -now.to_radians() * sense);
        drawing.disc(circle.center, 2.0, ELEVATION, Layer::OnTop);
        let words = format!("{now:.0}°");
        drawing.write(circle.point(0.0), [18.0, -14.0], words, Color32::from_rgb(r, g, b));
    }

    /// Where the elevation is 0.
    fn tick(&self, drawing: &mut Drawing, circle: &Circle, angle_rad: f64) {
        let (from, to) = (circle.direction(angle_rad) * 0.85, circle.direction(angle_rad) * 1.15);
        let place = |share: DVec3| circle.center + share * circle.radius_m;
        drawing.line(place(from), place(to), Pen::new(ELEVATION, 2.0));
    }

    /// On the planes of what carries the root.
    fn planes(&self, drawing: &mut Drawing) {
        let frames = &self.editor.evaluation().frames;
        let carrier = self.editor.figure().skeleton.joint(self.limb.parts().root).and_then(|j| j.carrier);
        let turn = carrier.map_or(DQuat::IDENTITY, |bone| frames[bone].rotation);
        planes(drawing, self.limits.root_in_world, turn, self.limits.outer_m, PITCH_M);
    }

    fn axes(&self, drawing: &mut Drawing) {
        let parts = self.limb.parts();
        for bone in [parts.root, parts.hinge, parts.end] {
            self.axes_of(drawing, bone);
        }
    }

    /// Each axis of a joint through its place, the letter at the end about which positive angles turn to the left.
    fn axes_of(&self, drawing: &mut Drawing, bone: Bone) {
        let (figure, pose) = (self.editor.figure(), self.editor.pose());
        let frames = &self.editor.evaluation().frames;
        let at = frames[bone].position;
        let arm = AXIS_PT * drawing.sight.metres_per_px(at);
        for dof in Dof::ALL {
            let Some(axis) = axis(figure, pose, frames, bone, dof) else { continue };
            let (letter, color, dash) = look(dof);
            let pen = Pen { dash, ..Pen::new(color, 2.0) };
            drawing.line(
                at - axis * arm * 0.5,
                at + axis * arm,
                Pen { color: [12, 12, 14, 150], width: 4.0, ..pen },
            );
            drawing.line(at - axis * arm * 0.5, at + axis * arm, pen);
            let [r, g, b, _] = color;
            drawing.write(at + axis * arm * 1.18, [0.0, 0.0], letter, Color32::from_rgb(r, g, b));
        }
    }
}

/// A target: arms along the world's axes, and how high it is over the ground.
pub fn cursor(drawing: &mut Drawing, target: DVec3) {
    let arm = 26.0 * drawing.sight.metres_per_px(target);
    for along in Axis::ALL {
        let pen = Pen::new(axis_color(along), 1.75);
        drawing.line(target - along.vector() * arm, target + along.vector() * arm, pen);
    }
    let ground = DVec3 { y: 0.0, ..target };
    let pen = Pen::new([226, 228, 234, 120], 1.25);
    drawing.line(target, ground, pen.dashed(6.0).ghosted());
    for radius in [0.015, 0.045] {
        drawing.ring(ground, DVec3::Y, radius, pen.ghosted());
    }
}

/// The line from root to target: solid as far as is reached, dashed from there.
pub fn pointer(drawing: &mut Drawing, [root, target]: [DVec3; 2], outer_m: f64, color: Color32) {
    let far = root.distance(target);
    let reached = root + (target - root) * (outer_m / far.max(1e-9)).min(1.0);
    let pen = Pen::new(rgba(color, 255), 1.75);
    drawing.line(root, reached, pen.under());
    drawing.line(root, reached, pen);
    drawing.line(reached, target, pen.dashed(7.0));
    drawing.disc(root, 3.5, rgba(color, 255), Layer::OnTop);
    drawing.write(root.lerp(target, 0.5), [0.0, -14.0], format!("{:.0} mm", far * 1000.0), color);
}

/// A ball about the root with its radius.
pub fn limit(drawing: &mut Drawing, root: DVec3, radius_m: f64, color: Color32, name: &str) {
    drawing.overlay.balls.push(Ball {
        center: root.as_vec3(),
        radius_m: radius_m as f32,
        color: rgba(color, 150),
        layer: Layer::Ghosted,
    });
    let up = drawing.sight.camera.axes().y_axis.as_dvec3();
    let words = format!("{name} {:.0} mm", radius_m * 1000.0);
    drawing.write(root + up * radius_m, [0.0, -9.0], words, color);
}

/// Grids through the root that end at the outer limit, on the planes of turned axes, metres.
pub fn planes(drawing: &mut Drawing, root: DVec3, turn: DQuat, reach: f64, pitch: f64) {
    for across in Axis::ALL {
        let color = axis_color(across);
        let [first, second] = sides(across).map(|axis| turn * axis.vector());
        for (along, step) in [(first, second), (second, first)] {
            grid(drawing, (root, reach), along, step * pitch, color);
        }
        let [r, g, b, _] = color;
        let pen = Pen::new([r, g, b, 130], 1.25).ghosted();
        drawing.ring(root, turn * across.vector(), reach, pen);
    }
}

/// Lines along one direction, each a step farther, cut off by a ball about a root.
fn grid(drawing: &mut Drawing, (root, reach): (DVec3, f64), along: DVec3, step: DVec3, [r, g, b, _]: Color) {
    let pitch = step.length().max(1e-9);
    let count = (reach / pitch).floor() as i32;
    for i in -count..=count {
        let off = f64::from(i) * pitch;
        let half = (reach * reach - off * off).max(0.0).sqrt();
        let (alpha, width) = if i == 0 { (150, 1.5) } else { (64, 1.0) };
        let middle = root + step * f64::from(i);
        let pen = Pen::new([r, g, b, alpha], width).ghosted();
        drawing.line(middle - along * half, middle + along * half, pen);
    }
}

/// The axes that span the plane across one.
fn sides(across: Axis) -> [Axis; 2] {
    match across {
        Axis::X => [Axis::Y, Axis::Z],
        Axis::Y => [Axis::Z, Axis::X],
        Axis::Z => [Axis::X, Axis::Y],
    }
}

/// Letter, colour and dash of an angle's axis: told apart without the colour, too.
fn look(dof: Dof) -> (&'static str, Color, f32) {
    match dof {
        Dof::Flexion => ("F", [242, 98, 88, 255], 0.0),
        Dof::Abduction => ("A", [138, 208, 98, 255], 11.0),
        Dof::Twist => ("T", [94, 160, 252, 255], 4.5),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use edit::{Command, Hold, Request, Sight};
    use glam::Vec2;
    use rig::{Camera, Space, View};

    use super::*;

    fn editor() -> Editor {
        let mut editor = Editor::new(crate::load::figure(None).unwrap());
        let bend =
            Command::Turn { joint: Bone::LeftLowerArm, dof: Dof::Flexion, degrees: 60.0, by: edit::By::To };
        let keep = Command::Keep { limb: Limb::LeftArm, contact: Hold::Point, space: Space::World };
        for command in [bend, keep] {
            editor.submit(Request::Do(command), &mut edit::NoFiles).unwrap();
        }
        editor
    }

    fn drawn(editor: &Editor, guides: &[Guide]) -> Drawing {
        let camera = Camera::default().seen_from(View::ThreeQuarter);
        let mut drawing = Drawing::new(Sight { camera, size_px: Vec2::new(800.0, 600.0) }, 1.0);
        let mut on = Guides::default();
        guides.iter().for_each(|guide| on.set(Limb::LeftArm, *guide, true));
        draw(&mut drawing, editor, &on);
        drawing
    }

    #[test]
    fn a_guide_is_switched_by_itself() {
        let mut guides = Guides::default();
        guides.set(Limb::RightArm, Guide::Outer, true);
        for limb in Limb::ALL {
            for guide in Guide::ALL {
                let set = limb == Limb::RightArm && guide == Guide::Outer;
                assert_eq!(guides.has(limb, guide), set);
            }
            assert_eq!(guides.any(limb), limb == Limb::RightArm);
        }
        guides.set(Limb::RightArm, Guide::Outer, false);
        assert_eq!(guides, Guides::default());
    }

    #[test]
    fn each_guide_draws_something_of_its_own() {
        let editor = editor();
        let sizes = |guides: &[Guide]| {
            let d = drawn(&editor, guides);
            [d.overlay.lines.len(), d.overlay.markers.len(), d.overlay.balls.len(), d.words.len()]
        };
        assert_eq!(sizes(&[]), [0; 4]);
        let sum = Guide::ALL.map(|guide| sizes(&[guide]));
        assert!(sum.iter().all(|size| *size != [0; 4]), "{sum:?}");
        let added: [usize; 4] = std::array::from_fn(|i| sum.iter().map(|size| size[i]).sum());
        assert_eq!(sizes(&Guide::ALL), added, "none hides or changes another");
    }

    #[test]
    fn the_balls_are_as_large_as_the_arm_is_when_stretched_and_folded() {
        let editor = editor();
        let balls = drawn(&editor, &[Guide::Outer, Guide::Inner]).overlay.balls;
        let [outer, inner] = balls[..] else { panic!("{balls:?}") };
        let frames = &editor.evaluation().frames;
        let shoulder = frames[Bone::LeftUpperArm].position.as_vec3();
        assert!(outer.center == shoulder && inner.center == shoulder);
        let straight = Editor::new(editor.figure().clone());
        let palm = straight.evaluation().limbs[0].articulator;
        let reach = palm.distance(straight.evaluation().frames[Bone::LeftUpperArm].position) as f32;
        assert!((outer.radius_m - reach).abs() < 0.01, "{} {reach}", outer.radius_m);
        assert!(inner.radius_m < 0.4 * outer.radius_m && inner.radius_m > 0.02);
    }
}
