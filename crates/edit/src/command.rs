//! Every way to change a pose, as data: window, scripts and tests use the same commands.

use glam::DVec3;
use rig::{Bone, Dof, Limb, Part, Side};
use serde::{Deserialize, Serialize};

/// Whether an angle is a change or a goal.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[allow(missing_docs)]
pub enum By {
    Delta,
    To,
}

/// Where a reach goes.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub enum Goal {
    /// A point of the world, metres.
    World(DVec3),
    /// A point in a bone's joint frame, metres.
    Body(Bone, DVec3),
    /// From where the articulator is, metres, world axes.
    Offset(DVec3),
    /// Where the articulator is: nothing moves.
    Here,
}

/// Which point of a limb reaches.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub enum At {
    /// A named articulator.
    Named(String),
    /// A point in the joint frame of a bone of the limb, metres.
    Point(Bone, DVec3),
}

/// How a limb holds on.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[allow(missing_docs)]
pub enum Hold {
    Free,
    Point,
    Planted,
}

/// A change of the pose.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs)]
pub enum Command {
    /// Turns one degree of freedom of a joint; all beyond it follows.
    Turn { joint: Bone, dof: Dof, degrees: f64, by: By },
    /// Brings a limb's articulator to a goal.
    Reach { limb: Limb, to: Goal },
    /// Swings the hinge about the line from root to articulator.
    Elevate { limb: Limb, degrees: f64, by: By },
    /// Turns the end, or the forearm's twist, about the articulator, which stays.
    TurnInContact { limb: Limb, dof: Dof, degrees: f64, by: By },
    /// Takes the other solution of the hinge, if it is in range.
    Flip { limb: Limb },
    /// Chooses the point that reaches.
    Articulate { limb: Limb, at: At },
    /// Holds the articulator where it is now, or lets go.
    Keep {
        limb: Limb,
        contact: Hold,
        #[serde(default = "world")]
        space: rig::Space,
    },
    /// Shifts the hips, metres, world axes.
    MoveHips { by: DVec3 },
    /// Shifts and turns the whole figure with its world contacts.
    Place {
        #[serde(default)]
        by: DVec3,
        #[serde(default)]
        turn: f64,
    },
    /// Bends the spine evenly so that its top aims at a point of the world; twist in degrees.
    AimSpine {
        at: DVec3,
        #[serde(default)]
        twist: f64,
    },
    /// Turns neck, head and eyes to a point of the world, once.
    LookAt { at: DVec3 },
    /// Blends the fingers of a hand to a handshape; amount 1 is the shape itself.
    Handshape {
        side: Side,
        name: String,
        #[serde(default = "one")]
        amount: f64,
    },
    /// Blends to a pose file.
    ApplyPose {
        path: String,
        #[serde(default)]
        parts: Vec<Part>,
        #[serde(default = "one")]
        amount: f64,
        #[serde(default)]
        mirrored: bool,
    },
    /// Each named part takes the mirror image of its twin; no parts: all.
    Mirror {
        #[serde(default)]
        parts: Vec<Part>,
    },
    /// Returns parts to rest and their limbs to free; no parts: all.
    Reset {
        #[serde(default)]
        parts: Vec<Part>,
    },
    /// Switches the ranges of joints.
    Ranges { on: bool },
    /// Shifts the hips so that the centre of mass comes over the feet in contact.
    Balance {
        #[serde(default = "one")]
        amount: f64,
    },
}

fn one() -> f64 {
    1.0
}

fn world() -> rig::Space {
    rig::Space::World
}
