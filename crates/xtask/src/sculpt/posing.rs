//! Poses for the preview: what skins are asked for most and find hardest.

use glam::DVec3;
use rig::{Angles, Bone, Frame, Frames, Mesh, Palette, Skeleton, skin_normals, skin_positions, spread_twist};

/// Angles of some bones in degrees: flexion, abduction, twist. Left bones stand for both sides.
pub type Stance = [(Bone, [f64; 3])];

/// As sculpted.
pub const REST: &Stance = &[];

/// Arms hanging, a little bent: the commonest pose.
pub const RELAXED: &Stance = &[
    (Bone::LeftUpperArm, [4.0, -82.0, 0.0]),
    (Bone::LeftLowerArm, [14.0, 0.0, 0.0]),
    (Bone::LeftThumbMetacarpal, [8.0, 8.0, 0.0]),
    (Bone::LeftIndexProximal, [15.0, 2.0, 0.0]),
    (Bone::LeftIndexIntermediate, [25.0, 0.0, 0.0]),
    (Bone::LeftIndexDistal, [15.0, 0.0, 0.0]),
    (Bone::LeftMiddleProximal, [18.0, 0.0, 0.0]),
    (Bone::LeftMiddleIntermediate, [28.0, 0.0, 0.0]),
    (Bone::LeftMiddleDistal, [18.0, 0.0, 0.0]),
    (Bone::LeftRingProximal, [20.0, 0.0, 0.0]),
    (Bone::LeftRingIntermediate, [30.0, 0.0, 0.0]),
    (Bone::LeftRingDistal, [20.0, 0.0, 0.0]),
    (Bone::LeftLittleProximal, [22.0, 4.0, 0.0]),
    (Bone::LeftLittleIntermediate, [30.0, 0.0, 0.0]),
    (Bone::LeftLittleDistal, [20.0, 0.0, 0.0]),
];

/// Sitting, elbows folded, palms to the face.
pub const SEATED: &Stance = &[
    (Bone::LeftUpperLeg, [90.0, 6.0, 0.0]),
    (Bone::LeftLowerLeg, [90.0, 0.0, 0.0]),
    (Bone::LeftUpperArm, [20.0, -70.0, 0.0]),
    (Bone::LeftLowerArm, [120.0, 0.0, -80.0]),
];

/// A fist on a straight arm, arms up, one long step.
pub const FISTS: &Stance = &[
    (Bone::LeftThumbMetacarpal, [6.0, 31.0, 0.0]),
    (Bone::LeftThumbProximal, [52.0, 0.0, 0.0]),
    (Bone::LeftThumbDistal, [60.0, 0.0, 0.0]),
    (Bone::LeftIndexProximal, [80.0, 0.0, 0.0]),
    (Bone::LeftIndexIntermediate, [95.0, 0.0, 0.0]),
    (Bone::LeftIndexDistal, [60.0, 0.0, 0.0]),
    (Bone::LeftMiddleProximal, [82.0, 0.0, 0.0]),
    (Bone::LeftMiddleIntermediate, [98.0, 0.0, 0.0]),
    (Bone::LeftMiddleDistal, [60.0, 0.0, 0.0]),
    (Bone::LeftRingProximal, [84.0, 0.0, 0.0]),
    (Bone::LeftRingIntermediate, [98.0, 0.0, 0.0]),
    (Bone::LeftRingDistal, [60.0, 0.0, 0.0]),
    (Bone::LeftLittleProximal, [86.0, 0.0, 0.0]),
    (Bone::LeftLittleIntermediate, [98.0, 0.0, 0.0]),
    (Bone::LeftLittleDistal, [60.0, 0.0, 0.0]),
    (Bone::LeftUpperArm, [0.0, 60.0, 0.0]),
    (Bone::LeftUpperLeg, [0.0, 35.0, 0.0]),
    (Bone::Head, [-10.0, 0.0, 30.0]),
    (Bone::Jaw, [14.0, 0.0, 0.0]),
];

/// The fist alone.
pub const FIST: &Stance = FISTS.split_at(15).0;

/// Head turned, mouth open.
pub const JAW: &Stance = FISTS.split_at(17).1;

/// The mesh in a pose, skinned as a loaded figure is.
pub fn posed(mesh: &Mesh, skeleton: &Skeleton, stance: &Stance) -> Mesh {
    let mut frames = Frames([Frame::IDENTITY; Bone::COUNT]);
    let mut rest = [DVec3::ZERO; Bone::COUNT];
    for joint in skeleton.joints() {
        let given = stance.iter().find(|(b, _)| *b == joint.bone || b.mirrored() == joint.bone);
        let [flexion, abduction, twist] = given.map_or([0.0; 3], |g| g.1);
        let local = Frame::new(joint.rotation(Angles { flexion, abduction, twist }), joint.offset);
        let base = joint.carrier.map_or(Frame::IDENTITY, |c| frames[c]);
        frames.0[joint.bone.index()] = base.then(local);
        rest[joint.bone.index()] = skeleton.rest_position(joint.bone);
    }
    let palette = Palette::new(&frames, &rest);
    let mut posed = mesh.clone();
    spread_twist(&mut posed, skeleton);
    posed.normals = skin_normals(&posed, &palette).iter().map(|p| p.to_array()).collect();
    posed.positions = skin_positions(&posed, &palette).iter().map(|p| p.to_array()).collect();
    posed
}
