//! The skeleton: which bones a figure has, where their joints are at rest and how they move.

use glam::DVec3;

use crate::{Bone, Joint, Locks};

/// A humanoid skeleton at rest in the VRM T pose: every joint frame along the world axes.
#[derive(Clone, PartialEq, Debug)]
pub struct Skeleton {
    joints: [Option<Joint>; Bone::COUNT],
    rest: [DVec3; Bone::COUNT],
    /// Joints whose ranges are narrowed to where they are.
    locks: Locks,
}

/// Why joints do not make a skeleton.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[allow(missing_docs)]
pub enum SkeletonError {
    #[error("bone \"{0}\" is given twice")]
    Twice(Bone),
    #[error("bone \"{0}\" is missing: every figure needs it")]
    Missing(Bone),
    #[error("bone \"{bone}\" is carried by \"{carrier}\", which is not in the skeleton or comes after it")]
    Carrier { bone: Bone, carrier: Bone },
    #[error("bone \"{bone}\": {what} is not finite")]
    NotFinite { bone: Bone, what: &'static str },
}

impl Skeleton {
    /// Builds a skeleton; order does not matter.
    ///
    /// # Errors
    /// A bone twice, no hips, a bone carried by one that is absent or does not come before it in
    /// [`Bone::ALL`], numbers that are not finite.
    pub fn new(list: Vec<Joint>) -> Result<Skeleton, SkeletonError> {
        let mut joints = [const { None }; Bone::COUNT];
        for joint in list {
            let bone = joint.bone;
            if !joint.offset.is_finite() {
                return Err(SkeletonError::NotFinite { bone, what: "its place" });
            }
            if !joint.center_of_mass.is_finite() || !joint.mass.is_finite() {
                return Err(SkeletonError::NotFinite { bone, what: "its mass" });
            }
            if joints[bone.index()].replace(joint).is_some() {
                return Err(SkeletonError::Twice(bone));
            }
        }
        let mut rest = [DVec3::ZERO; Bone::COUNT];
        if joints[Bone::Hips.index()].is_none() {
            return Err(SkeletonError::Missing(Bone::Hips));
        }
        for bone in Bone::ALL {
            let Some(joint) = &joints[bone.index()] else { continue };
            rest[bone.index()] = joint.offset;
            match joint.carrier {
                None if bone == Bone::Hips => {}
                None => return Err(SkeletonError::Carrier { bone, carrier: bone }),
                Some(carrier) if carrier < bone && joints[carrier.index()].is_some() => {
                    rest[bone.index()] += rest[carrier.index()];
                }
                Some(carrier) => return Err(SkeletonError::Carrier { bone, carrier }),
            }
        }
        Ok(Skeleton { joints, rest, locks: Locks::NONE })
    }

    /// The joints that are locked.
    pub fn locks(&self) -> Locks {
        self.locks
    }

    /// The skeleton with other ranges, and the joints that those lock.
    pub(crate) fn changed(&self, locks: Locks, mut change: impl FnMut(&mut Joint)) -> Skeleton {
        let mut skeleton = Skeleton { locks, ..self.clone() };
        skeleton.joints.iter_mut().flatten().for_each(&mut change);
        skeleton
    }

    /// The joint of a bone, if the figure has it.
    pub fn joint(&self, bone: Bone) -> Option<&Joint> {
        self.joints[bone.index()].as_ref()
    }

    /// Every joint that the figure has, carriers first.
    pub fn joints(&self) -> impl Iterator<Item = &Joint> {
        self.joints.iter().flatten()
    }

    /// Where a joint is at rest, metres, figure space; the origin if the figure lacks it.
    pub fn rest_position(&self, bone: Bone) -> DVec3 {
        self.rest[bone.index()]
    }
}
