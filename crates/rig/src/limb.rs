//! The four limbs and the joints that make one.

use serde::{Deserialize, Serialize};

use crate::{Bone, Side};

/// A limb that reaches.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[allow(missing_docs)]
pub enum Limb {
    LeftArm,
    RightArm,
    LeftLeg,
    RightLeg,
}

/// The bones that make a limb.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct LimbParts {
    /// What the root joint turns in: collar or hips.
    pub base: Bone,
    /// The ball joint at the root.
    pub root: Bone,
    /// The hinge.
    pub hinge: Bone,
    /// The end: hand or foot.
    pub end: Bone,
}

impl Limb {
    /// Every limb.
    pub const ALL: [Limb; 4] = [Limb::LeftArm, Limb::RightArm, Limb::LeftLeg, Limb::RightLeg];

    /// The name in reports and pose files.
    pub const fn name(self) -> &'static str {
        match self {
            Limb::LeftArm => "leftArm",
            Limb::RightArm => "rightArm",
            Limb::LeftLeg => "leftLeg",
            Limb::RightLeg => "rightLeg",
        }
    }

    /// Place in [`Limb::ALL`].
    pub const fn index(self) -> usize {
        self as usize
    }

    /// Whether it is an arm.
    pub const fn is_arm(self) -> bool {
        matches!(self, Limb::LeftArm | Limb::RightArm)
    }

    /// Its side.
    pub const fn side(self) -> Side {
        match self {
            Limb::LeftArm | Limb::LeftLeg => Side::Left,
            Limb::RightArm | Limb::RightLeg => Side::Right,
        }
    }

    /// The twin on the other side.
    pub const fn mirrored(self) -> Limb {
        match self {
            Limb::LeftArm => Limb::RightArm,
            Limb::RightArm => Limb::LeftArm,
            Limb::LeftLeg => Limb::RightLeg,
            Limb::RightLeg => Limb::LeftLeg,
        }
    }

    /// Its bones.
    pub const fn parts(self) -> LimbParts {
        let (base, root, hinge, end) = match self {
            Limb::LeftArm => (Bone::LeftShoulder, Bone::LeftUpperArm, Bone::LeftLowerArm, Bone::LeftHand),
            Limb::RightArm => {
                (Bone::RightShoulder, Bone::RightUpperArm, Bone::RightLowerArm, Bone::RightHand)
            }
            Limb::LeftLeg => (Bone::Hips, Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot),
            Limb::RightLeg => (Bone::Hips, Bone::RightUpperLeg, Bone::RightLowerLeg, Bone::RightFoot),
        };
        LimbParts { base, root, hinge, end }
    }

    /// The limb whose root, hinge or end that bone is, or whose fingers or toes it belongs to.
    pub fn of(bone: Bone) -> Option<Limb> {
        Limb::ALL.into_iter().find(|limb| {
            let p = limb.parts();
            let mut b = bone;
            while b != Bone::Hips && b != p.root {
                b = b.carrier();
            }
            b == p.root
        })
    }
}
