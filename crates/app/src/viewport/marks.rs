//! What is drawn over the figure: joints, articulators and targets.

use edit::{Axis, Editor, Selection};
use glam::{DVec3, Vec3};
use render::{Color, Layer, Line, Marker, Overlay, Shape};
use rig::{Bone, Contact, Limb, Part, Reacher};

use crate::theme;

/// A miss smaller than this is none, metres.
const MET_M: f64 = 0.0005;
/// How far a guide goes to either side, as a share of the camera's distance: not as far as the eye.
const GUIDE_SHARE: f32 = 0.5;

/// The marks of a pose; sizes grow with the pixels of a point. A figure without a skin shows its bones as lines.
pub fn of(editor: &Editor, selection: &Selection, marks: bool, scale: f32) -> Overlay {
    let mut overlay = Overlay::default();
    if editor.figure().skin.is_none() {
        bones(&mut overlay, editor, scale);
    }
    if marks {
        joints(&mut overlay, editor, selection, scale);
        for limb in Limb::ALL {
            reach(&mut overlay, editor, limb, scale);
        }
    }
    overlay
}

/// The bone that carries a limb's articulator; the end if the figure doesn't know the articulator.
pub fn reaching_bone(editor: &Editor, limb: Limb) -> Bone {
    match &editor.pose().limb(limb).reacher {
        Reacher::Point(bone, _) => *bone,
        Reacher::Named(name) => {
            let known = editor.figure().articulators[limb.index()].get(name);
            known.map_or(limb.parts().end, |articulator| articulator.bone)
        }
    }
}

fn rgba(color: egui::Color32, alpha: u8) -> Color {
    let [r, g, b, _] = color.to_array();
    [r, g, b, alpha]
}

fn bones(overlay: &mut Overlay, editor: &Editor, scale: f32) {
    let frames = &editor.evaluation().frames;
    for joint in editor.figure().skeleton.joints() {
        let Some(carrier) = joint.carrier else { continue };
        overlay.lines.push(Line {
            from: frames[carrier].position.as_vec3(),
            to: frames[joint.bone].position.as_vec3(),
            color: [205, 206, 210, 255],
            width_px: 4.0 * scale,
            dash_px: 0.0,
            layer: Layer::Tested,
        });
    }
}

fn joints(overlay: &mut Overlay, editor: &Editor, selection: &Selection, scale: f32) {
    let frames = &editor.evaluation().frames;
    for joint in editor.figure().skeleton.joints() {
        let bone = joint.bone;
        let small = matches!(bone.part(), Part::LeftHand | Part::RightHand)
            || matches!(bone, Bone::LeftEye | Bone::RightEye | Bone::Jaw);
        let chosen = selection.contains(bone);
        let radius = if small { 1.6 } else { 3.2 };
        overlay.markers.push(Marker {
            at: frames[bone].position.as_vec3(),
            radius_px: if chosen { radius + 2.0 } else { radius } * scale,
            color: if chosen { rgba(theme::ACCENT, 255) } else { [236, 236, 238, 200] },
            outline: [24, 24, 26, 150],
            outline_px: 1.0 * scale,
            layer: Layer::OnTop,
            shape: Shape::Disc,
        });
    }
}

/// A limb's articulator and target; the target as a cross, and a dashed line to it where it is not met.
fn reach(overlay: &mut Overlay, editor: &Editor, limb: Limb, scale: f32) {
    let view = &editor.evaluation().limbs[limb.index()];
    let side = theme::side(limb.side());
    let (articulator, target) = (view.articulator.as_vec3(), view.target.as_vec3());
    overlay.markers.push(Marker {
        at: articulator,
        radius_px: 3.0 * scale,
        color: rgba(side, 255),
        outline: [20, 20, 22, 190],
        outline_px: 1.0 * scale,
        layer: Layer::OnTop,
        shape: Shape::Disc,
    });
    let held = editor.pose().limb(limb).contact != Contact::Free;
    let missed = view.residual > MET_M;
    let line = Line {
        from: articulator,
        to: target,
        color: rgba(side, 230),
        width_px: 2.0 * scale,
        dash_px: 8.0 * scale,
        layer: Layer::OnTop,
    };
    if missed {
        overlay.lines.push(line);
    }
    if held || missed {
        cross(overlay, target, Line { dash_px: 0.0, ..line });
    }
}

/// The lines along which a drag may go, through the point where it began.
pub fn guides(overlay: &mut Overlay, first: DVec3, axes: &[Axis], camera_distance: f32, scale: f32) {
    for axis in axes {
        let reach = axis.vector() * f64::from(GUIDE_SHARE * camera_distance);
        overlay.lines.push(Line {
            from: (first - reach).as_vec3(),
            to: (first + reach).as_vec3(),
            color: match axis {
                Axis::X => [236, 92, 84, 220],
                Axis::Y => [126, 200, 92, 220],
                Axis::Z => [88, 150, 246, 220],
            },
            width_px: 1.5 * scale,
            dash_px: 0.0,
            layer: Layer::OnTop,
        });
    }
}

/// Three short strokes along the world's axes.
fn cross(overlay: &mut Overlay, at: Vec3, style: Line) {
    for axis in Vec3::AXES {
        overlay.lines.push(Line { from: at - axis * 0.035, to: at + axis * 0.035, ..style });
    }
}
