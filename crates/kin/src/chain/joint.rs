//! What a joint can do, where its range ends, and the value that says where it is.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3};

use super::ChainError;
use crate::{Cone, Frame, Interval, axis_angle, swing_twist};

/// How a node moves in its parent. Axes are unit vectors in the joint's frame.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Joint {
    /// Not at all; its value is ignored.
    Fixed,
    /// Turns about an axis.
    Revolute {
        /// The axis; positive by the right hand.
        axis: DVec3,
        /// Where it may turn to, radians; [`Interval::FREE`] turns on and on.
        range: Interval,
    },
    /// Slides along an axis.
    Prismatic {
        /// The direction of positive values.
        axis: DVec3,
        /// Where it may slide to, metres.
        range: Interval,
    },
    /// Turns any way.
    Ball {
        /// Where it may turn to; `None` for everywhere.
        range: Option<BallRange>,
    },
}

/// Where a ball joint may turn to: the directions of its bone, and the twist about the bone.
///
/// A rotation is split into `swing * twist` about `bone`, as by [`swing_twist`]: the swing, the smallest turn
/// that brings the bone to where it points, is judged by the cone, the twist by the interval. Both may be
/// clamped one by one.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct BallRange {
    /// The bone's direction in the node's frame, a unit vector; the twist is about it.
    pub bone: DVec3,
    /// Where the bone may point, in the joint's frame.
    pub cone: Cone,
    /// The twist about the bone, radians.
    pub twist: Interval,
}

/// Where one joint is.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Value {
    /// Radians of a revolute joint, metres of a prismatic one; ignored for a fixed one.
    Amount(f64),
    /// The rotation of a ball joint, `joint_from_node`; a unit quaternion.
    Turn(DQuat),
}

impl BallRange {
    /// Swing and twist of a rotation, the twist as near to the middle of its range as full turns bring it.
    pub(super) fn split(&self, rotation: DQuat) -> (DQuat, f64) {
        let (swing, twist) = swing_twist(rotation, self.bone);
        let middle = 0.5 * (self.twist.min + self.twist.max);
        let turns = ((middle - twist) / TAU).round();
        (swing, if turns.is_finite() { twist + turns * TAU } else { twist })
    }

    /// The rotation, in range: the bone to the nearest direction of the cone, the twist to the nearest of its
    /// interval.
    ///
    /// A rotation in range comes back to the bit.
    #[must_use]
    pub fn clamp(&self, rotation: DQuat) -> DQuat {
        let (swing, twist) = self.split(rotation);
        let direction = swing * self.bone;
        let inside = self.cone.clamp(direction);
        if inside == direction && self.twist.contains(twist) {
            return rotation;
        }
        self.joined(inside, self.twist.clamp(twist))
    }

    /// How far a rotation lies outside, radians: of the cone or of the twist's interval, whichever is more.
    pub fn excess(&self, rotation: DQuat) -> f64 {
        let (swing, twist) = self.split(rotation);
        (self.cone.angle(swing * self.bone) - self.cone.half_angle).max(self.twist.excess(twist)).max(0.0)
    }

    /// The rotation that points the bone and twists it.
    pub(super) fn joined(&self, direction: DVec3, twist: f64) -> DQuat {
        DQuat::from_rotation_arc(self.bone, direction) * axis_angle(self.bone, twist)
    }

    /// The smallest such range that holds the rotation too.
    #[must_use]
    pub fn reaching(self, rotation: DQuat) -> BallRange {
        let (swing, twist) = self.split(rotation);
        BallRange {
            cone: self.cone.reaching(swing * self.bone),
            twist: self.twist.reaching(twist),
            bone: self.bone,
        }
    }

    fn sound(mut self, node: usize) -> Result<BallRange, ChainError> {
        self.bone = direction(self.bone, node, "bone")?;
        self.cone.axis = direction(self.cone.axis, node, "axis of the cone")?;
        let half = self.cone.half_angle;
        if !(0.0..=PI).contains(&half) {
            return Err(ChainError::Range { node, what: "cone", min: 0.0, max: half });
        }
        interval(self.twist, node, "range of the twist")?;
        Ok(self)
    }
}

impl Joint {
    /// The value of rest: zero, or the identity.
    pub const fn rest(&self) -> Value {
        match self {
            Joint::Ball { .. } => Value::Turn(DQuat::IDENTITY),
            _ => Value::Amount(0.0),
        }
    }

    /// `joint_from_node` at a value; rest if the value is of another kind.
    pub fn frame(&self, value: Value) -> Frame {
        match (self, value) {
            (Joint::Revolute { axis, .. }, Value::Amount(angle)) => {
                Frame::new(axis_angle(*axis, angle), DVec3::ZERO)
            }
            (Joint::Prismatic { axis, .. }, Value::Amount(way)) => Frame::new(DQuat::IDENTITY, *axis * way),
            (Joint::Ball { .. }, Value::Turn(rotation)) => Frame::new(rotation, DVec3::ZERO),
            _ => Frame::IDENTITY,
        }
    }

    /// The nearest value in range.
    #[must_use]
    pub fn clamp(&self, value: Value) -> Value {
        match (self, value) {
            (Joint::Revolute { range, .. } | Joint::Prismatic { range, .. }, Value::Amount(x)) => {
                Value::Amount(range.clamp(x))
            }
            (Joint::Ball { range: Some(range) }, Value::Turn(q)) => Value::Turn(range.clamp(q)),
            _ => value,
        }
    }

    /// How far a value lies outside its range, radians or metres; 0 inside, and for a value of another kind.
    pub fn excess(&self, value: Value) -> f64 {
        match (self, value) {
            (Joint::Revolute { range, .. } | Joint::Prismatic { range, .. }, Value::Amount(x)) => {
                range.excess(x)
            }
            (Joint::Ball { range: Some(range) }, Value::Turn(q)) => range.excess(q),
            _ => 0.0,
        }
    }

    /// The joint with a range that holds the value too: what starts outside may stay there or move inward.
    #[must_use]
    pub fn reaching(self, value: Value) -> Joint {
        match (self, value) {
            (Joint::Revolute { axis, range }, Value::Amount(x)) => {
                Joint::Revolute { axis, range: range.reaching(x) }
            }
            (Joint::Prismatic { axis, range }, Value::Amount(x)) => {
                Joint::Prismatic { axis, range: range.reaching(x) }
            }
            (Joint::Ball { range: Some(range) }, Value::Turn(q)) => {
                Joint::Ball { range: Some(range.reaching(q)) }
            }
            _ => self,
        }
    }

    /// What the joint is called in messages.
    pub(super) const fn name(&self) -> &'static str {
        match self {
            Joint::Fixed => "fixed",
            Joint::Revolute { .. } => "a revolute joint",
            Joint::Prismatic { .. } => "a prismatic joint",
            Joint::Ball { .. } => "a ball joint",
        }
    }

    /// What value the joint takes, for messages.
    pub(super) const fn takes(&self) -> &'static str {
        match self {
            Joint::Fixed => "no value but zero",
            Joint::Revolute { .. } => "an angle in radians",
            Joint::Prismatic { .. } => "a way in metres",
            Joint::Ball { .. } => "a rotation",
        }
    }

    pub(super) fn sound(self, node: usize) -> Result<Joint, ChainError> {
        Ok(match self {
            Joint::Fixed => self,
            Joint::Revolute { axis, range } => Joint::Revolute {
                axis: direction(axis, node, "axis")?,
                range: interval(range, node, "range")?,
            },
            Joint::Prismatic { axis, range } => Joint::Prismatic {
                axis: direction(axis, node, "axis")?,
                range: interval(range, node, "range")?,
            },
            Joint::Ball { range } => Joint::Ball { range: range.map(|range| range.sound(node)).transpose()? },
        })
    }
}

impl Value {
    /// The number of a revolute or prismatic joint.
    pub const fn amount(self) -> Option<f64> {
        match self {
            Value::Amount(x) => Some(x),
            Value::Turn(_) => None,
        }
    }

    /// Whether the value fits the joint and can be computed with.
    pub(super) fn check(self, joint: &Joint, node: usize) -> Result<(), ChainError> {
        match (joint, self) {
            (Joint::Ball { .. }, Value::Turn(q)) => {
                let length_squared = q.length_squared();
                if length_squared == 0.0 {
                    return Err(ChainError::NoRotation { node });
                }
                if (length_squared - 1.0).abs() > 1e-6 || length_squared.is_nan() {
                    return Err(ChainError::NotUnit { node, length: length_squared.sqrt() });
                }
            }
            (Joint::Ball { .. }, Value::Amount(_)) | (_, Value::Turn(_)) => {
                return Err(ChainError::Kind { node, joint: joint.name(), wanted: joint.takes() });
            }
            (_, Value::Amount(x)) => {
                if !x.is_finite() {
                    return Err(ChainError::NotFinite { node, what: "value" });
                }
            }
        }
        Ok(())
    }
}

/// A vector at unit length, itself to the bit if it has that.
fn direction(v: DVec3, node: usize, what: &'static str) -> Result<DVec3, ChainError> {
    if !v.is_finite() {
        return Err(ChainError::NotFinite { node, what });
    }
    if (v.length() - 1.0).abs() < 1e-14 {
        return Ok(v);
    }
    v.try_normalize().ok_or(ChainError::NoAxis { node, what })
}

/// An interval that holds some finite number.
pub(super) fn interval(range: Interval, node: usize, what: &'static str) -> Result<Interval, ChainError> {
    let Interval { min, max } = range;
    let sound = min <= max && min < f64::INFINITY && max > f64::NEG_INFINITY;
    if sound { Ok(range) } else { Err(ChainError::Range { node, what, min, max }) }
}
