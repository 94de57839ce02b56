//! What a crowd needs to know of its figure.

use glam::DVec3;
use rig::{Articulation, Bone, Dof, Figure, Limb, twist_places};

use super::leg::LegShape;
use super::twist::Twist;

/// A figure's joints in single precision, carriers first.
#[derive(Clone, PartialEq, Debug)]
pub struct CrowdFigure {
    /// By bone: carrier's number, the hips their own.
    pub(super) carriers: [usize; Bone::COUNT],
    /// By bone: from the carrier's joint, metres.
    pub(super) offsets: [[f32; 3]; Bone::COUNT],
    /// By bone: where the joint is at rest, metres.
    pub(super) rest: [[f32; 3]; Bone::COUNT],
    /// Left and right.
    pub(super) legs: [LegShape; 2],
    /// The palette's places after the bones.
    pub(super) twists: Vec<Twist>,
}

/// The legs' bones: hips' child, knee, foot, toes.
pub(super) const LEGS: [[usize; 4]; 2] = [
    [Bone::LeftUpperLeg.index(), Bone::LeftLowerLeg.index(), Bone::LeftFoot.index(), Bone::LeftToes.index()],
    [
        Bone::RightUpperLeg.index(),
        Bone::RightLowerLeg.index(),
        Bone::RightFoot.index(),
        Bone::RightToes.index(),
    ],
];

impl CrowdFigure {
    /// Reads a figure; `None` if it has no two legs of hip, knee and foot.
    pub fn of(figure: &Figure) -> Option<CrowdFigure> {
        let skeleton = &figure.skeleton;
        let single = |v: DVec3| v.as_vec3().to_array();
        let offset = |bone: Bone| skeleton.joint(bone).map_or(DVec3::ZERO, |joint| joint.offset);
        let carrier = |bone: Bone| skeleton.joint(bone).and_then(|j| j.carrier).unwrap_or(bone.carrier());
        let rest = Bone::ALL.map(|bone| single(skeleton.rest_position(bone)));
        Some(CrowdFigure {
            carriers: Bone::ALL.map(|bone| carrier(bone).index()),
            offsets: Bone::ALL.map(|bone| if bone == Bone::Hips { [0.0; 3] } else { single(offset(bone)) }),
            legs: [leg(figure, Limb::LeftLeg)?, leg(figure, Limb::RightLeg)?],
            twists: twist_places().iter().map(|place| Twist::of(place, &rest)).collect(),
            rest,
        })
    }
}

fn leg(figure: &Figure, limb: Limb) -> Option<LegShape> {
    let parts = limb.parts();
    let joint = |bone| figure.skeleton.joint(bone);
    let (knee, foot) = (joint(parts.hinge)?, joint(parts.end)?);
    joint(parts.root)?;
    let Articulation::Hinges(hinges) = &knee.articulation else { return None };
    let hinge = hinges.iter().find(|hinge| hinge.dof == Dof::Flexion)?;
    let (upper, lower) = (knee.offset, foot.offset);
    let unit = |v: DVec3| Some(v.try_normalize()?.as_vec3().to_array());
    Some(LegShape {
        upper: upper.length() as f32,
        lower: lower.length() as f32,
        upper_direction: unit(upper)?,
        lower_direction: unit(lower)?,
        hinge: unit(hinge.axis)?,
    })
}
