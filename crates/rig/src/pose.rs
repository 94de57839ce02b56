//! The pose: the only state of a figure. Everything else is derived from it.

use glam::{DQuat, DVec3};
use serde::{Deserialize, Serialize};

use crate::{Angles, Bone, Limb};

/// Where the whole figure stands: a turn about the vertical, then a shift.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Place {
    /// Metres, world.
    pub position: DVec3,
    /// Degrees about +Y, positive to the figure's left.
    pub turn: f64,
}

/// The frame in which a contact's target is fixed.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[allow(missing_docs)]
pub enum Space {
    World,
    Body(Bone),
}

/// What a limb holds on to.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum Contact {
    /// Nothing.
    #[default]
    Free,
    /// The articulator stays on a point; the end turns freely about it.
    Point {
        /// The target's frame.
        space: Space,
        /// Metres in that space.
        target: DVec3,
    },
    /// The articulator stays on a point and the end keeps its rotation.
    Planted {
        /// The target's frame.
        space: Space,
        /// Metres in that space.
        target: DVec3,
        /// The end's rotation in that space.
        rotation: DQuat,
    },
}

impl Contact {
    /// The target and its space; `None` if the limb is free.
    pub fn target(&self) -> Option<(Space, DVec3)> {
        match *self {
            Contact::Free => None,
            Contact::Point { space, target } | Contact::Planted { space, target, .. } => {
                Some((space, target))
            }
        }
    }
}

/// Which point of a limb reaches.
#[derive(Clone, PartialEq, Debug)]
pub enum Reacher {
    /// A named articulator of the figure.
    Named(String),
    /// A point in a bone's joint frame, metres.
    Point(Bone, DVec3),
}

/// A limb's stored state.
#[derive(Clone, PartialEq, Debug)]
pub struct LimbState {
    /// The point that reaches.
    pub reacher: Reacher,
    /// What it holds on to.
    pub contact: Contact,
}

impl LimbState {
    /// Free, with the default articulator: palm or ankle.
    pub fn rest(limb: Limb) -> LimbState {
        let name = if limb.is_arm() { "palm" } else { "ankle" };
        LimbState { reacher: Reacher::Named(name.to_owned()), contact: Contact::Free }
    }
}

/// A pose. Angles in degrees, lengths in metres.
#[derive(Clone, PartialEq, Debug)]
pub struct Pose {
    /// Where the figure stands.
    pub place: Place,
    /// The hips joint in figure space.
    pub hips: DVec3,
    /// Angles by [`Bone::index`].
    pub angles: [Angles; Bone::COUNT],
    /// Limbs by [`Limb::index`].
    pub limbs: [LimbState; Limb::ALL.len()],
}

impl Pose {
    /// The rest pose of a figure whose hips are at that place at rest.
    pub fn rest(hips: DVec3) -> Pose {
        Pose {
            place: Place::default(),
            hips,
            angles: [Angles::REST; Bone::COUNT],
            limbs: Limb::ALL.map(LimbState::rest),
        }
    }

    /// The angles of a bone's joint.
    pub fn angles(&self, bone: Bone) -> Angles {
        self.angles[bone.index()]
    }

    /// The state of a limb.
    pub fn limb(&self, limb: Limb) -> &LimbState {
        &self.limbs[limb.index()]
    }
}
