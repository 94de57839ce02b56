//! What lies under the pointer: a joint, or the target of a limb.

use edit::Editor;
use glam::{DVec3, Vec2, Vec3};
use rig::{Bone, Bounds, Camera, Limb};

/// A mark under the pointer.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Picked {
    /// The disc of a joint.
    Joint(Bone),
    /// The cross of a limb's target.
    Target(Limb),
}

/// How near the pointer must come, points.
const REACH: f32 = 9.0;

impl Picked {
    /// The bone that a click chooses.
    pub fn bone(self, editor: &Editor) -> Bone {
        match self {
            Picked::Joint(bone) => bone,
            Picked::Target(limb) => super::marks::reaching_bone(editor, limb),
        }
    }

    /// Where it is, metres, world.
    pub fn place(self, editor: &Editor) -> DVec3 {
        match self {
            Picked::Joint(bone) => editor.evaluation().frames[bone].position,
            Picked::Target(limb) => editor.evaluation().limbs[limb.index()].target,
        }
    }
}

/// The nearest mark within reach of a place in the picture. Of marks at one place the target comes first; of joints the
/// one nearer to the eye wins by a little.
pub fn at(camera: &Camera, size: Vec2, editor: &Editor, at: Vec2) -> Option<Picked> {
    let joints = editor.figure().skeleton.joints().map(|joint| Picked::Joint(joint.bone));
    let targets = Limb::ALL.into_iter().map(Picked::Target);
    let toward = camera.axes().z_axis;
    let cost = |picked: Picked| {
        let place = picked.place(editor).as_vec3();
        let distance = camera.pixel_of(place, size)?.distance(at);
        let favour = if matches!(picked, Picked::Target(_)) { -3.0 } else { 0.0 };
        (distance <= REACH).then(|| distance + favour - 4.0 * (place - camera.target).dot(toward))
    };
    let all = targets.chain(joints).filter_map(|picked| cost(picked).map(|cost| (cost, picked)));
    all.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, picked)| picked)
}

/// A box around the figure, or around a bone and what it carries next.
pub fn bounds(editor: &Editor, bone: Option<Bone>) -> Bounds {
    let frames = &editor.evaluation().frames;
    let place = |bone: Bone| frames[bone].position.as_vec3();
    let joints = editor.figure().skeleton.joints();
    let (points, air): (Vec<Vec3>, f32) = match bone {
        None => (joints.map(|joint| place(joint.bone)).collect(), 0.16),
        Some(bone) => {
            let near = joints.filter(|joint| joint.carrier == Some(bone)).map(|joint| place(joint.bone));
            (near.chain([place(bone)]).collect(), 0.1)
        }
    };
    let tight = Bounds::of(points);
    Bounds { min: tight.min - air, max: tight.max + air }
}
