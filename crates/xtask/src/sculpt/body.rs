//! The whole body: its parts in order, and how fine its skin is where.

use glam::DVec3;
use rig::{Bone, Skeleton};

use super::field::{Field, Part};
use super::fit::figure_scale;
use super::physique::Physique;
use super::{foot, hand, head, limbs, torso};

/// Every part of the left half, carriers before fingers and toes.
pub fn field(skeleton: &Skeleton, physique: &Physique) -> Field {
    let s = skeleton;
    let mut parts: Vec<Part> = vec![
        torso::part(s, physique),
        head::part(s, physique),
        head::ear(s),
        limbs::leg(s, physique),
        foot::foot(s),
        limbs::arm(s, physique),
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
    // Lids and lips are the finest.
    let features = near(Bone::LeftEye, 0.024)
        || (p - at(Bone::LeftEye) - DVec3::new(-0.031, -0.063, 0.02)).length() < 0.036;
    let (turn, least) = if features { (0.42, 0.0018) } else { (0.54, 0.0026) };
    (turn / bend.max(1.0)).clamp(least * scale, roomy * scale)
}
