//! The joint values of a robot.

use std::ops::Range;

use kin::Interval;

use super::{DofPart, Robot, RobotJointKind};

/// A value for each way in which a robot's joints move, radians and metres, in the order of [`Robot::dofs`]. Limits bind
/// whoever sets them, not the pose.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct RobotPose(pub Vec<f64>);

/// One way in which a joint moves.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RobotDof {
    /// The number of the joint.
    pub joint: usize,
    /// What its value does.
    pub part: DofPart,
    /// How far it goes, radians or metres; infinite where free.
    pub range: Interval,
    /// Whether it follows another joint, so that its own value isn't used.
    pub follows: bool,
}

impl Robot {
    /// All values 0 but those that mimicking joints take from it.
    pub fn rest(&self) -> RobotPose {
        self.followed(&RobotPose(vec![0.0; self.value_count()]))
    }

    /// The number of values in a pose.
    pub fn value_count(&self) -> usize {
        self.slots.last().copied().unwrap_or(0)
    }

    /// Where the values of a joint are in a pose; empty for a fixed joint and for one that isn't there.
    pub fn slot(&self, joint: usize) -> Range<usize> {
        match (self.slots.get(joint), self.slots.get(joint + 1)) {
            (Some(&start), Some(&end)) => start..end,
            _ => 0..0,
        }
    }

    /// The values of a joint; empty where the pose is too short.
    pub fn values<'a>(&self, pose: &'a RobotPose, joint: usize) -> &'a [f64] {
        pose.0.get(self.slot(joint)).unwrap_or_default()
    }

    /// Every way in which its joints move, in the order of a pose's values.
    pub fn dofs(&self) -> impl Iterator<Item = RobotDof> + '_ {
        self.joints.iter().enumerate().flat_map(|(i, joint)| {
            let follows = self.masters[i].is_some();
            let dof = move |&part| RobotDof { joint: i, part, range: joint.range(), follows };
            joint.kind.parts().iter().map(dof)
        })
    }

    /// The pose with mimicking joints where their masters put them, through any number of masters, and with as many values as
    /// there are: missing ones are 0.
    #[must_use]
    pub fn followed(&self, pose: &RobotPose) -> RobotPose {
        let mut values = pose.0.clone();
        values.resize(self.value_count(), 0.0);
        for &joint in &self.followers {
            if let (Some(master), Some(mimic)) = (self.masters[joint], &self.joints[joint].mimic) {
                values[self.slots[joint]] = mimic.multiplier * values[self.slots[master]] + mimic.offset;
            }
        }
        RobotPose(values)
    }

    /// The nearest pose with every value in its range. Mimicking joints follow, into their ranges or not.
    #[must_use]
    pub fn clamped(&self, pose: &RobotPose) -> RobotPose {
        let mut pose = self.followed(pose);
        for (value, dof) in pose.0.iter_mut().zip(self.dofs()) {
            *value = value.clamp(dof.range.min, dof.range.max);
        }
        self.followed(&pose)
    }
}

impl RobotJointKind {
    /// The kind of that name in URDF files.
    pub fn from_name(name: &str) -> Option<RobotJointKind> {
        RobotJointKind::ALL.into_iter().find(|k| k.name() == name)
    }
}
