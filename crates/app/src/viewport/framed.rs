//! What the camera is fitted to.

use edit::Editor;
use glam::Vec3;
use rig::{Bone, Bounds};

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
