//! Locks: joints that keep their angles whatever the gesture.

use kin::Interval;

use crate::{Angles, Articulation, Bone, Figure, GestureError, Joint, LimbRigs, Pose, Skeleton};

/// A set of bones whose joints are locked. The hips' lock holds their place in the figure, too.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Locks(u64);

impl Locks {
    /// Nothing is locked.
    pub const NONE: Locks = Locks(0);

    /// Whether a bone's joint is locked.
    pub const fn contains(self, bone: Bone) -> bool {
        self.0 & (1 << bone.index()) != 0
    }

    /// The set with a bone locked or unlocked.
    #[must_use]
    pub const fn with(self, bone: Bone, on: bool) -> Locks {
        let bit = 1 << bone.index();
        Locks(if on { self.0 | bit } else { self.0 & !bit })
    }

    /// Whether nothing is locked.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// The locked bones, carriers first.
    pub fn iter(self) -> impl Iterator<Item = Bone> {
        Bone::ALL.into_iter().filter(move |bone| self.contains(*bone))
    }
}

impl From<Bone> for Locks {
    fn from(bone: Bone) -> Locks {
        Locks::NONE.with(bone, true)
    }
}

impl FromIterator<Bone> for Locks {
    fn from_iter<T: IntoIterator<Item = Bone>>(bones: T) -> Locks {
        bones.into_iter().fold(Locks::NONE, |locks, bone| locks.with(bone, true))
    }
}

impl Figure {
    /// The figure whose locked joints can't leave the angles that they have in a pose: their ranges are narrowed to
    /// those. With `ranges` off all other joints are free. Gestures on it are made with ranges on; it has no skin.
    #[must_use]
    pub fn with_locks(&self, pose: &Pose, locks: Locks, ranges: bool) -> Figure {
        let skeleton = self.skeleton.changed(locks, |joint| {
            if locks.contains(joint.bone) {
                narrow(joint, pose.angles(joint.bone));
            } else if !ranges {
                free(joint);
            }
        });
        let bases = crate::Limb::ALL.map(|limb| self.limbs.swing_base(limb));
        Figure {
            name: self.name.clone(),
            limbs: LimbRigs::new(&skeleton, bases),
            skeleton,
            articulators: self.articulators.clone(),
            handshapes: self.handshapes.clone(),
            skin: None,
        }
    }
}

/// A joint that stays where it is.
fn narrow(joint: &mut Joint, angles: Angles) {
    let only = |dof| Interval::new(angles.get(dof), angles.get(dof));
    match &mut joint.articulation {
        Articulation::Hinges(hinges) => hinges.iter_mut().for_each(|hinge| hinge.range = only(hinge.dof)),
        Articulation::Ball { ranges, cone, .. } => {
            *ranges = crate::Dof::ALL.map(only);
            *cone = None;
        }
    }
}

fn free(joint: &mut Joint) {
    match &mut joint.articulation {
        Articulation::Hinges(hinges) => hinges.iter_mut().for_each(|hinge| hinge.range = Interval::FREE),
        Articulation::Ball { ranges, cone, .. } => {
            *ranges = [Interval::FREE; 3];
            *cone = None;
        }
    }
}

/// Whether one of the joints that a gesture turns can turn.
///
/// # Errors
/// All are locked: the first by name. None of them is no error.
pub(crate) fn check_unlocked(skeleton: &Skeleton, bones: &[Bone]) -> Result<(), GestureError> {
    let locked = |bone: &&Bone| skeleton.locks().contains(**bone);
    match bones.first() {
        Some(bone) if bones.iter().all(|bone| locked(&bone)) => Err(GestureError::Locked(*bone)),
        _ => Ok(()),
    }
}
