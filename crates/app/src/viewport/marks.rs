//! What is drawn over the figure: joints, and what each limb holds on to. The shape tells the kind of a contact, the
//! colour only the side.

use edit::{Axis, Editor, Selection, marked_joints};
use glam::{DVec3, Vec2};
use render::{Layer, Overlay};
use rig::{Bone, Contact, Limb};

use super::drawing::{Drawing, Pen, circle_strokes, rgba};
use crate::{reaching, theme};

/// How far a guide goes to either side, as a share of the camera's distance: not as far as the eye.
const GUIDE_SHARE: f32 = 0.5;

/// Draws the marks of a pose, and for a figure without a skin its bones as lines. `lit` are the bones under the pointer.
pub fn draw(drawing: &mut Drawing, editor: &Editor, selection: &Selection, lit: &[Bone], marks: bool) {
    if editor.figure().skin.is_none() {
        bones(drawing, editor);
    }
    if marks {
        joints(drawing, editor, selection, lit);
        for limb in Limb::ALL {
            contact(drawing, editor, limb);
        }
    }
}

fn bones(drawing: &mut Drawing, editor: &Editor) {
    let frames = &editor.evaluation().frames;
    let pen = Pen { layer: Layer::Tested, ..Pen::new([205, 206, 210, 255], 4.0) };
    for joint in editor.figure().skeleton.joints() {
        let Some(carrier) = joint.carrier else { continue };
        drawing.line(frames[carrier].position, frames[joint.bone].position, pen);
    }
}

fn joints(drawing: &mut Drawing, editor: &Editor, selection: &Selection, lit: &[Bone]) {
    let frames = &editor.evaluation().frames;
    let all: Vec<Bone> = selection.bones().iter().chain(lit).copied().collect();
    for bone in marked_joints(editor, &drawing.sight, &all) {
        let chosen = selection.contains(bone);
        let (radius, color) =
            if chosen { (5.0, rgba(theme::ACCENT, 255)) } else { (3.0, [236, 236, 238, 190]) };
        drawing.disc(frames[bone].position, radius, color, Layer::OnTop);
    }
}

/// A limb's articulator and what it holds on to: a disc if it is free, crosshairs about a point, a square on its feet
/// where the end is planted. A dashed line leads to a target that is missed, and says by how much and why.
fn contact(drawing: &mut Drawing, editor: &Editor, limb: Limb) {
    let view = &editor.evaluation().limbs[limb.index()];
    let side = theme::side(limb.side());
    let pen = Pen::new(rgba(side, 255), 1.75);
    let contact = editor.pose().limb(limb).contact;
    let shape = match contact {
        Contact::Free => Vec::new(),
        Contact::Point { .. } => crosshairs(),
        Contact::Planted { .. } => square_on_feet(),
    };
    drawing.glyph(view.target, &shape, pen);
    let radius = if contact == Contact::Free { 4.0 } else { 2.5 };
    drawing.disc(view.articulator, radius, rgba(side, 255), Layer::OnTop);
    let Some(words) = reaching::miss_words(editor, limb) else { return };
    drawing.line(view.articulator, view.target, Pen::new(rgba(theme::WARNING, 255), 2.0).under());
    drawing.line(view.articulator, view.target, Pen::new(rgba(theme::WARNING, 255), 2.0).dashed(8.0));
    drawing.write(view.target, [0.0, 22.0], words, theme::WARNING);
}

/// A ring with four ticks through it.
fn crosshairs() -> Vec<[Vec2; 2]> {
    let tick = |v: Vec2| [v * 3.5, v * 10.5];
    circle_strokes(7.0, 20).into_iter().chain([Vec2::X, -Vec2::X, Vec2::Y, -Vec2::Y].map(tick)).collect()
}

/// A square with a foot at each corner.
fn square_on_feet() -> Vec<[Vec2; 2]> {
    let corners = [Vec2::new(1.0, 1.0), Vec2::new(-1.0, 1.0), Vec2::new(-1.0, -1.0), Vec2::new(1.0, -1.0)];
    let sides = (0..4).map(|i| [corners[i] * 6.5, corners[(i + 1) % 4] * 6.5]);
    sides.chain(corners.map(|corner| [corner * 6.5, corner * 10.0])).collect()
}

/// The lines along which a drag may go, through the point where it began.
pub fn axes(overlay: &mut Overlay, first: DVec3, axes: &[Axis], camera_distance: f32, scale: f32) {
    for axis in axes {
        let reach = axis.vector() * f64::from(GUIDE_SHARE * camera_distance);
        overlay.lines.push(render::Line {
            from: (first - reach).as_vec3(),
            to: (first + reach).as_vec3(),
            color: axis_color(*axis),
            width_px: 1.5 * scale,
            dash_px: 0.0,
            layer: Layer::OnTop,
        });
    }
}

/// The colour of an axis of the world.
pub fn axis_color(axis: Axis) -> render::Color {
    match axis {
        Axis::X => [236, 92, 84, 220],
        Axis::Y => [126, 200, 92, 220],
        Axis::Z => [88, 150, 246, 220],
    }
}
