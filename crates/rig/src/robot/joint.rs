//! The joints of a robot: how each moves, how far, and which other it follows.

use glam::{DQuat, DVec3, EulerRot};
use kin::{Frame, Interval, axis_angle};

/// How a joint moves, in the words of URDF.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum RobotJointKind {
    /// Not at all.
    Fixed,
    /// Turns about its axis within limits.
    Revolute,
    /// Turns about its axis without limits.
    Continuous,
    /// Slides along its axis within limits.
    Prismatic,
    /// Slides in the plane across its axis and turns about the axis: x, y, turn.
    Planar,
    /// Turns every way: roll, pitch, yaw, as in the origins of URDF. Not in URDF itself but read by many.
    Ball,
    /// Moves every way: x, y, z, then roll, pitch, yaw.
    Floating,
}

impl RobotJointKind {
    /// All kinds.
    pub const ALL: [RobotJointKind; 7] = [
        RobotJointKind::Fixed,
        RobotJointKind::Revolute,
        RobotJointKind::Continuous,
        RobotJointKind::Prismatic,
        RobotJointKind::Planar,
        RobotJointKind::Ball,
        RobotJointKind::Floating,
    ];

    /// The name in URDF files.
    pub const fn name(self) -> &'static str {
        match self {
            RobotJointKind::Fixed => "fixed",
            RobotJointKind::Revolute => "revolute",
            RobotJointKind::Continuous => "continuous",
            RobotJointKind::Prismatic => "prismatic",
            RobotJointKind::Planar => "planar",
            RobotJointKind::Ball => "spherical",
            RobotJointKind::Floating => "floating",
        }
    }

    /// What its values are, in their order.
    pub const fn parts(self) -> &'static [DofPart] {
        use DofPart::{Pitch, Roll, Slide, Turn, X, Y, Yaw, Z};
        match self {
            RobotJointKind::Fixed => &[],
            RobotJointKind::Revolute | RobotJointKind::Continuous => &[Turn],
            RobotJointKind::Prismatic => &[Slide],
            RobotJointKind::Planar => &[X, Y, Turn],
            RobotJointKind::Ball => &[Roll, Pitch, Yaw],
            RobotJointKind::Floating => &[X, Y, Z, Roll, Pitch, Yaw],
        }
    }

    /// Whether it moves between two ends.
    pub const fn is_limited(self) -> bool {
        matches!(self, RobotJointKind::Revolute | RobotJointKind::Prismatic)
    }

    /// Whether it has an axis.
    pub const fn has_axis(self) -> bool {
        matches!(
            self,
            RobotJointKind::Revolute
                | RobotJointKind::Continuous
                | RobotJointKind::Prismatic
                | RobotJointKind::Planar
        )
    }
}

/// What one value of a joint does.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum DofPart {
    /// Turns about the joint's axis, radians.
    Turn,
    /// Slides along the joint's axis, metres.
    Slide,
    /// Slides along the joint's x, of a planar joint along the first direction across its axis; metres.
    X,
    /// Slides along the joint's y, of a planar joint along the second direction across its axis; metres.
    Y,
    /// Slides along the joint's z, metres.
    Z,
    /// Turns about the carrier's x, radians; applies first.
    Roll,
    /// Turns about the carrier's y, radians; applies after the roll.
    Pitch,
    /// Turns about the carrier's z, radians; applies last.
    Yaw,
}

impl DofPart {
    /// The name in lower case.
    pub const fn name(self) -> &'static str {
        match self {
            DofPart::Turn => "turn",
            DofPart::Slide => "slide",
            DofPart::X => "x",
            DofPart::Y => "y",
            DofPart::Z => "z",
            DofPart::Roll => "roll",
            DofPart::Pitch => "pitch",
            DofPart::Yaw => "yaw",
        }
    }

    /// Whether the value is an angle in radians; the others are lengths in metres.
    pub const fn is_angle(self) -> bool {
        matches!(self, DofPart::Turn | DofPart::Roll | DofPart::Pitch | DofPart::Yaw)
    }
}

/// How far, how strongly and how fast a joint moves.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct JointLimit {
    /// Radians or metres; infinite where free.
    pub range: Interval,
    /// Newton metres or newtons; 0 where not given.
    pub effort: f64,
    /// Radians or metres a second; 0 where not given.
    pub velocity: f64,
}

/// A joint that follows another: value = multiplier · master + offset.
#[derive(Clone, PartialEq, Debug)]
pub struct Mimic {
    /// The joint that is followed, by name.
    pub master: String,
    /// Times the master's value.
    pub multiplier: f64,
    /// Radians or metres.
    pub offset: f64,
}

/// A joint: what it hangs on, what it carries, how it moves.
#[derive(Clone, PartialEq, Debug)]
pub struct RobotJoint {
    /// Its name, of which a robot has one.
    pub name: String,
    /// How it moves.
    pub kind: RobotJointKind,
    /// The link that it hangs on, by name.
    pub parent: String,
    /// The link that it carries, by name.
    pub child: String,
    /// The joint's frame in that of the link it hangs on, all values 0.
    pub parent_from_joint: Frame,
    /// The axis in the joint's frame: any length but 0 in what [`Robot::new`](crate::Robot::new) takes, a unit vector in
    /// what it gives.
    pub axis: DVec3,
    /// Its limits, where it has some.
    pub limit: Option<JointLimit>,
    /// The joint that it follows, if it does.
    pub mimic: Option<Mimic>,
}

impl RobotJoint {
    /// How far one of its values goes, radians or metres; infinite where free. Values beyond are shown as given.
    pub fn range(&self) -> Interval {
        self.limit.filter(|_| self.kind.is_limited()).map_or(Interval::FREE, |limit| limit.range)
    }

    /// The frame of the carried link in the joint's, for values in the order of [`RobotJointKind::parts`]. Missing ones count as 0.
    pub fn joint_from_child(&self, values: &[f64]) -> Frame {
        let value = |i: usize| values.get(i).copied().unwrap_or(0.0);
        match self.kind {
            RobotJointKind::Fixed => Frame::IDENTITY,
            RobotJointKind::Revolute | RobotJointKind::Continuous => {
                Frame::new(axis_angle(self.axis, value(0)), DVec3::ZERO)
            }
            RobotJointKind::Prismatic => Frame::new(DQuat::IDENTITY, self.axis * value(0)),
            RobotJointKind::Planar => {
                let [x, y] = across(self.axis);
                Frame::new(axis_angle(self.axis, value(2)), x * value(0) + y * value(1))
            }
            RobotJointKind::Ball => Frame::new(rotation_of_rpy([value(0), value(1), value(2)]), DVec3::ZERO),
            RobotJointKind::Floating => Frame::new(
                rotation_of_rpy([value(3), value(4), value(5)]),
                DVec3::new(value(0), value(1), value(2)),
            ),
        }
    }
}

/// The two directions of a plane by its normal: x and y turned as z turns to the normal by the shortest way.
pub(crate) fn across(normal: DVec3) -> [DVec3; 2] {
    let turn = DQuat::from_rotation_arc(DVec3::Z, normal);
    [turn * DVec3::X, turn * DVec3::Y]
}

/// The rotation of roll, pitch and yaw: about the fixed x, then y, then z, radians, as in URDF.
pub fn rotation_of_rpy([roll, pitch, yaw]: [f64; 3]) -> DQuat {
    DQuat::from_euler(EulerRot::ZYX, yaw, pitch, roll)
}

/// Roll, pitch and yaw of a rotation, radians, pitch within a quarter turn. Where roll and yaw turn about one line the roll is 0.
pub fn rpy_of_rotation(rotation: DQuat) -> [f64; 3] {
    let DQuat { x, y, z, w } = rotation.normalize();
    let sin = 2.0 * (w * y - x * z);
    // The column that carries x, seen from above, has the length of the pitch's cosine.
    let (across_x, across_y) = (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z));
    let cos = across_x.hypot(across_y);
    let pitch = sin.atan2(cos);
    if cos < 1e-9 {
        let yaw = 2.0 * z.atan2(w);
        return [0.0, pitch, yaw];
    }
    let roll = (2.0 * (y * z + w * x)).atan2(1.0 - 2.0 * (x * x + y * y));
    [roll, pitch, across_y.atan2(across_x)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn roll_pitch_and_yaw_come_back() {
        for a in -12..=12 {
            for b in -6..=6 {
                for c in -12..=12 {
                    let rotation = rotation_of_rpy([a, b, c].map(|i| f64::from(i) * 15_f64.to_radians()));
                    let again = rotation_of_rpy(rpy_of_rotation(rotation));
                    assert!(rotation.dot(again).abs() > 1.0 - 1e-14, "{a} {b} {c}");
                }
            }
        }
    }

    #[test]
    fn a_plane_across_z_has_x_and_y() {
        assert_eq!(across(DVec3::Z), [DVec3::X, DVec3::Y]);
        let [x, y] = across(DVec3::NEG_Z);
        assert!(x.cross(y).abs_diff_eq(DVec3::NEG_Z, 1e-12));
    }
}
