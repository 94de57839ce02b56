//! The warp of a body at rest: each bone's part grows by factors of its own about its joint.

use glam::{DMat3, DVec3};

use crate::{Bone, Part, Skeleton, bone_of_place};

/// Factors of the parts of a body, before it is brought to its stature.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Factors {
    pub head: f64,
    pub arms: f64,
    pub legs: f64,
    pub shoulders: f64,
    pub hips: f64,
}

/// Hands and feet, and the neck's girth, follow the head by these powers of its factor; the neck keeps its length.
const EXTREMITIES_POWER: f64 = 0.25;
const NECK_POWER: f64 = 0.5;

/// A warp of the rest pose: a map of space for each bone, which agree at the joints.
#[derive(Clone, Debug)]
pub(super) struct Warp {
    /// How each bone's part grows about its joint.
    pub linear: [DMat3; Bone::COUNT],
    /// Where each joint was.
    from: [DVec3; Bone::COUNT],
    /// Where it goes.
    to: [DVec3; Bone::COUNT],
}

impl Warp {
    /// The warp of a skeleton about its hips, which stay.
    pub fn new(skeleton: &Skeleton, factors: &Factors) -> Warp {
        let mut warp = Warp {
            linear: [DMat3::IDENTITY; Bone::COUNT],
            from: Bone::ALL.map(|b| skeleton.rest_position(b)),
            to: [DVec3::ZERO; Bone::COUNT],
        };
        for joint in skeleton.joints() {
            let i = joint.bone.index();
            warp.linear[i] = linear(skeleton, joint.bone, factors);
            warp.to[i] = match joint.carrier {
                None => joint.offset,
                Some(c) => warp.to[c.index()] + warp.linear[c.index()] * joint.offset,
            };
        }
        warp
    }

    /// Then everything larger by a factor about the origin, then higher by some metres.
    pub fn then(mut self, scale: f64, rise: f64) -> Warp {
        for (to, linear) in self.to.iter_mut().zip(&mut self.linear) {
            *to = *to * scale + DVec3::Y * rise;
            *linear *= scale;
        }
        self
    }

    /// Where a joint goes.
    pub fn joint(&self, bone: Bone) -> DVec3 {
        self.to[bone.index()]
    }

    /// Where a point at rest goes if it belongs to that bone alone.
    pub fn point(&self, bone: Bone, p: DVec3) -> DVec3 {
        let i = bone.index();
        self.to[i] + self.linear[i] * (p - self.from[i])
    }

    /// Where a vertex goes: the mean of its bones' maps by its weights.
    pub fn vertex(&self, p: DVec3, joints: [u8; 4], weights: [u16; 4]) -> DVec3 {
        let mut sum = DVec3::ZERO;
        for (joint, weight) in joints.into_iter().zip(weights).filter(|(_, w)| *w > 0) {
            sum += self.point(bone_of_place(usize::from(joint)), p) * (f64::from(weight) / 65535.0);
        }
        sum
    }
}

/// How the part of one bone grows.
fn linear(skeleton: &Skeleton, bone: Bone, f: &Factors) -> DMat3 {
    let broader = |x: f64| DMat3::from_diagonal(DVec3::new(x, 1.0, 1.0));
    let even = |s: f64| DMat3::from_diagonal(DVec3::splat(s));
    let along = |next: Bone, factor: f64| {
        let axis = skeleton.joint(next).map_or(DVec3::ZERO, |j| j.offset.normalize_or_zero());
        let stretch = axis * (factor - 1.0);
        DMat3::IDENTITY + DMat3::from_cols(stretch * axis.x, stretch * axis.y, stretch * axis.z)
    };
    let mix = |t: f64| f.hips + (f.shoulders - f.hips) * t;
    match bone {
        Bone::Hips => broader(f.hips),
        Bone::Spine => broader(mix(1.0 / 3.0)),
        Bone::Chest => broader(mix(2.0 / 3.0)),
        Bone::UpperChest | Bone::LeftShoulder | Bone::RightShoulder => broader(f.shoulders),
        Bone::Neck => {
            let girth = f.head.powf(NECK_POWER);
            DMat3::from_diagonal(DVec3::new(girth, 1.0, girth))
        }
        Bone::LeftUpperArm => along(Bone::LeftLowerArm, f.arms),
        Bone::RightUpperArm => along(Bone::RightLowerArm, f.arms),
        Bone::LeftLowerArm => along(Bone::LeftHand, f.arms),
        Bone::RightLowerArm => along(Bone::RightHand, f.arms),
        Bone::LeftUpperLeg => along(Bone::LeftLowerLeg, f.legs),
        Bone::RightUpperLeg => along(Bone::RightLowerLeg, f.legs),
        Bone::LeftLowerLeg => along(Bone::LeftFoot, f.legs),
        Bone::RightLowerLeg => along(Bone::RightFoot, f.legs),
        _ if bone.part() == Part::Head => even(f.head),
        _ => even(f.head.powf(EXTREMITIES_POWER)),
    }
}
