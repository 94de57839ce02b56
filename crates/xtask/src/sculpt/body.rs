//! The whole body: its parts in order, and how fine its skin is where.

use glam::DVec3;
use rig::{Bone, Skeleton};

use super::field::{Field, Part};
use super::fit::figure_scale;
use super::physique::Physique;
use super::{arm, ear, foot, hand, head, leg, torso};

/// Every part of the left half, carriers before fingers and toes.
pub fn field(skeleton: &Skeleton, physique: &Physique) -> Field {
    let s = skeleton;
    let mut parts: Vec<Part> = vec![
        torso::part(s, physique),
        head::part(s, physique),
        ear::ear(s, physique),
        leg::leg(s, physique),
        foot::foot(s),
        arm::arm(s, physique),
        hand::palm(s),
    ];
    parts.extend((0..5).map(|i| hand::finger(s, i)));
    parts.extend((0..5).map(|i| foot::toe(s, i)));
    Field::new(parts)
}

/// The wanted edge length at a point of the skin where it bends by `bend` (1/m): short at hands, face and joints.
pub fn edge_length(skeleton: &Skeleton, p: DVec3, bend: f64) -> f64 {
    let at = |bone: Bone| skeleton.rest_position(bone);
    let near = |bone: Bone, reach: f64| p.distance(at(bone)) < reach;
    let scale = figure_scale(skeleton);
    let roomy = if p.x > at(Bone::LeftHand).x {
        0.0066
    } else if p.y > at(Bone::Neck).y + 0.02 {
        if p.z > 0.06 { 0.0065 } else { 0.012 }
    } else if p.y < at(Bone::LeftFoot).y {
        0.0085
    } else if near(Bone::LeftUpperArm, 0.11)
        || near(Bone::LeftLowerArm, 0.07)
        || near(Bone::LeftLowerLeg, 0.09)
    {
        0.0115
    } else {
        0.0165
    };
    let (turn, least, most) = match face_detail(p - at(Bone::LeftEye), scale) {
        Some(fine) => fine,
        None if hand::near_nail(skeleton, p) => (0.45, 0.0013, 0.0066),
        None => (0.54, 0.0026, roomy),
    };
    (turn / bend.max(1.0)).clamp(least * scale, roomy.min(most) * scale)
}

/// How much an edge may turn (radians), how short and how long it may be at lids, brows, nose, lips and ear: a place
/// from the eye.
fn face_detail(p: DVec3, scale: f64) -> Option<(f64, f64, f64)> {
    let near = |x: f64, y: f64, z: f64, reach: f64| p.distance(DVec3::new(x, y, z) * scale) < reach * scale;
    if near(0.0, 0.0, 0.010, 0.022) {
        Some((0.40, 0.0011, 0.0050))
    } else if near(-0.031, -0.063, 0.020, 0.031) || near(-0.020, -0.040, 0.028, 0.018) {
        Some((0.42, 0.0014, 0.0034))
    } else if near(0.0, 0.020, 0.012, 0.024) {
        Some((0.54, 0.0026, 0.0034))
    } else if near(0.042, -0.014, -0.094, 0.040) {
        Some((0.48, 0.0015, 0.0080))
    } else {
        None
    }
}
