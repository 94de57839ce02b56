//! What one joint can do: its degrees of freedom, their axes and their ranges.

use glam::{DQuat, DVec3};
use kin::{Ball, Cone, Interval, axis_angle};
use serde::{Deserialize, Serialize};

use crate::Bone;

/// A degree of freedom, in the words of goniometry.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
#[allow(missing_docs)]
pub enum Dof {
    Flexion,
    Abduction,
    Twist,
}

impl Dof {
    /// All three, in the order in which files name them.
    pub const ALL: [Dof; 3] = [Dof::Flexion, Dof::Abduction, Dof::Twist];

    /// The name in lower case, as in reports and URDF joint names.
    pub const fn name(self) -> &'static str {
        match self {
            Dof::Flexion => "flexion",
            Dof::Abduction => "abduction",
            Dof::Twist => "twist",
        }
    }
}

/// The joint angles of one bone in degrees; a degree of freedom that the joint lacks stays 0.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
#[allow(missing_docs)]
pub struct Angles {
    pub flexion: f64,
    pub abduction: f64,
    pub twist: f64,
}

impl Angles {
    /// All angles zero: the rest pose.
    pub const REST: Angles = Angles { flexion: 0.0, abduction: 0.0, twist: 0.0 };

    /// The angle of one degree of freedom, degrees.
    pub const fn get(&self, dof: Dof) -> f64 {
        match dof {
            Dof::Flexion => self.flexion,
            Dof::Abduction => self.abduction,
            Dof::Twist => self.twist,
        }
    }

    /// Sets the angle of one degree of freedom, degrees.
    pub fn set(&mut self, dof: Dof, degrees: f64) {
        match dof {
            Dof::Flexion => self.flexion = degrees,
            Dof::Abduction => self.abduction = degrees,
            Dof::Twist => self.twist = degrees,
        }
    }
}

/// One axis of a joint with one or two degrees of freedom.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Hinge {
    /// The name of the angle.
    pub dof: Dof,
    /// Unit axis in the joint's frame (world axes at rest).
    pub axis: DVec3,
    /// The range in degrees.
    pub range: Interval,
}

/// How a joint moves.
#[derive(Clone, PartialEq, Debug)]
pub enum Articulation {
    /// Up to two hinges; the rotation is their product in this order.
    Hinges(Vec<Hinge>),
    /// A swing vector (flexion, abduction) followed by a twist about the bone.
    Ball {
        /// The three axes.
        ball: Ball,
        /// Ranges in degrees of flexion, abduction and twist; infinite where free.
        ranges: [Interval; 3],
        /// The swing's cone; where present it rules instead of the ranges of flexion and abduction.
        cone: Option<Cone>,
    },
}

/// A joint and the bone that it turns.
#[derive(Clone, PartialEq, Debug)]
pub struct Joint {
    /// Which bone.
    pub bone: Bone,
    /// The bone that carries it; `None` for the hips.
    pub carrier: Option<Bone>,
    /// From the carrier's joint to this one at rest, metres, world axes; for the hips from the origin.
    pub offset: DVec3,
    /// How it moves.
    pub articulation: Articulation,
    /// Kilograms of the segment that it moves.
    pub mass: f64,
    /// Centre of that mass in the joint's frame, metres.
    pub center_of_mass: DVec3,
}

impl Joint {
    /// The degrees of freedom, in the order in which they apply.
    pub fn dofs(&self) -> impl Iterator<Item = Dof> + '_ {
        let (hinges, ball) = match &self.articulation {
            Articulation::Hinges(hinges) => (hinges.as_slice(), &[][..]),
            Articulation::Ball { .. } => (&[][..], &Dof::ALL[..]),
        };
        hinges.iter().map(|h| h.dof).chain(ball.iter().copied())
    }

    /// Whether the joint has that degree of freedom.
    pub fn has(&self, dof: Dof) -> bool {
        self.dofs().any(|d| d == dof)
    }

    /// The fixed range of one degree of freedom in degrees, cones aside; `None` if the joint lacks it.
    pub fn range(&self, dof: Dof) -> Option<Interval> {
        match &self.articulation {
            Articulation::Hinges(hinges) => hinges.iter().find(|h| h.dof == dof).map(|h| h.range),
            Articulation::Ball { ranges, .. } => Some(ranges[dof as usize]),
        }
    }

    /// The direction of a ball joint's bone at rest: along its twist axis, to the side on which its cone
    /// lies. `None` for joints of hinges.
    pub fn bone_direction(&self) -> Option<DVec3> {
        let Articulation::Ball { ball, cone, .. } = &self.articulation else { return None };
        let against = cone.is_some_and(|c| c.axis.dot(ball.twist) < 0.0);
        Some(if against { -ball.twist } else { ball.twist })
    }

    /// The rotation of those angles, from the joint's frame to its carrier's.
    pub fn rotation(&self, angles: Angles) -> DQuat {
        match &self.articulation {
            Articulation::Hinges(hinges) => {
                let turn = |h: &Hinge| axis_angle(h.axis, angles.get(h.dof).to_radians());
                match hinges.as_slice() {
                    [] => DQuat::IDENTITY,
                    [only] => turn(only),
                    [outer, inner] => turn(outer) * turn(inner),
                    [outer, middle, inner] => turn(outer) * turn(middle) * turn(inner),
                    more => more.iter().map(turn).fold(DQuat::IDENTITY, |outer, inner| outer * inner),
                }
            }
            Articulation::Ball { ball, .. } => ball.rotation(
                angles.flexion.to_radians(),
                angles.abduction.to_radians(),
                angles.twist.to_radians(),
            ),
        }
    }
}
