//! Ranges of joints: an interval of one angle, a cone of directions.

use glam::DVec3;

use crate::arc_tangent;

/// A closed interval; the unit is its user's. Empty intervals can't be built.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Interval {
    /// Lower end.
    pub min: f64,
    /// Upper end, not below the lower.
    pub max: f64,
}

impl Interval {
    /// No limit either way.
    pub const FREE: Interval = Interval { min: f64::NEG_INFINITY, max: f64::INFINITY };

    /// The interval between two ends, in whichever order they come.
    pub fn new(a: f64, b: f64) -> Interval {
        Interval { min: a.min(b), max: a.max(b) }
    }

    /// The nearest value inside.
    pub fn clamp(self, value: f64) -> f64 {
        value.max(self.min).min(self.max)
    }

    /// Whether the value lies inside, ends included.
    pub fn contains(self, value: f64) -> bool {
        self.min <= value && value <= self.max
    }

    /// How far the value lies outside; 0 inside.
    pub fn excess(self, value: f64) -> f64 {
        (self.min - value).max(value - self.max).max(0.0)
    }

    /// The smallest interval that holds this one and the value: a joint that starts outside its
    /// range may stay where it is and only move inward.
    pub fn reaching(self, value: f64) -> Interval {
        Interval { min: self.min.min(value), max: self.max.max(value) }
    }

    /// What lies in another interval too; one of its ends where the two have nothing in common.
    pub(crate) fn within(self, other: Interval) -> Interval {
        Interval { min: other.clamp(self.min), max: other.clamp(self.max) }
    }

    /// Both ends times a factor, for a change of unit.
    pub fn scaled(self, factor: f64) -> Interval {
        Interval::new(self.min * factor, self.max * factor)
    }
}

/// A quarter of a circle over its chord, rounded up.
const ARC_OVER_CHORD: f64 = 1.1108;

/// The directions within an angle of an axis.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Cone {
    /// Unit axis.
    pub axis: DVec3,
    /// Angle between axis and rim, radians, 0 to pi.
    pub half_angle: f64,
}

impl Cone {
    /// Every direction.
    pub const FREE: Cone = Cone { axis: DVec3::X, half_angle: std::f64::consts::PI };

    /// The angle of a unit direction from the axis, radians; accurate at 0 and at pi.
    pub fn angle(self, direction: DVec3) -> f64 {
        arc_tangent(self.axis.cross(direction).length(), self.axis.dot(direction))
    }

    /// Whether the unit direction lies inside by more than `-slack` radians.
    pub fn contains(self, direction: DVec3, slack: f64) -> bool {
        let most = self.half_angle + slack;
        // Within a right angle an arc is at most so many times as long as its chord.
        let near = ARC_OVER_CHORD * self.axis.distance(direction) < most && self.axis.dot(direction) > 0.0;
        near || self.angle(direction) <= most
    }

    /// The smallest cone about the same axis that holds the unit direction too.
    pub fn reaching(self, direction: DVec3) -> Cone {
        if self.contains(direction, 0.0) {
            return self;
        }
        Cone { half_angle: self.half_angle.max(self.angle(direction)), ..self }
    }

    /// The nearest unit direction inside; along an arbitrary side if the direction is opposite to the axis.
    pub fn clamp(self, direction: DVec3) -> DVec3 {
        let angle = self.angle(direction);
        if angle <= self.half_angle {
            return direction;
        }
        let side = (direction - self.axis * self.axis.dot(direction))
            .try_normalize()
            .unwrap_or_else(|| self.axis.any_orthonormal_vector());
        (self.axis * self.half_angle.cos() + side * self.half_angle.sin()).normalize()
    }
}
