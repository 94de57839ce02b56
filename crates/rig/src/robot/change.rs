//! Changing a robot's structure: links come and go, lengths and ranges change, all else stays where it is on what carries it.

use glam::{DQuat, DVec3};
use kin::{Frame, Interval};

use super::{
    JointLimit, Paint, Robot, RobotError, RobotJoint, RobotJointKind, RobotLink, RobotPose, Shape, Visual,
};
use crate::nearest;

/// Why a structure can't be changed so.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[allow(missing_docs)]
pub enum ChangeError {
    #[error("there is no link \"{link}\", did you mean \"{nearest}\"?")]
    NoLink { link: String, nearest: String },
    #[error("there is no joint \"{joint}\", did you mean \"{nearest}\"?")]
    NoJoint { joint: String, nearest: String },
    #[error("link \"{link}\" is the root: only links that hang on a joint can be removed")]
    Root { link: String },
    #[error("joint \"{joint}\" is {kind}: it has no range to set")]
    NoRange { joint: String, kind: &'static str },
    #[error("a length must be above 0 and finite, not {length} m")]
    Length { length: f64 },
    #[error("link \"{link}\" has no length of its own, so it has no direction to grow in")]
    NoDirection { link: String },
    #[error("joint \"{joint}\" is followed by joint \"{follower}\", which would have nothing to follow")]
    Followed { joint: String, follower: String },
    #[error(transparent)]
    Robot(#[from] RobotError),
}

/// A link that is added at the end of another, on a revolute joint of the same name.
#[derive(Clone, PartialEq, Debug)]
pub struct NewLink {
    /// Its name and that of its joint, of which there must be none yet.
    pub name: String,
    /// Metres, above 0.
    pub length: f64,
    /// Radians from the direction of the link that carries it.
    pub range: Interval,
    /// The joint's axis in the frame of the link that carries it; any length but 0.
    pub axis: DVec3,
}

impl Robot {
    /// The number of a link.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn find_link(&self, name: &str) -> Result<usize, ChangeError> {
        self.link(name).ok_or_else(|| ChangeError::NoLink {
            link: name.to_owned(),
            nearest: nearest(name, self.links.iter().map(|l| &*l.name)).to_owned(),
        })
    }

    /// The number of a joint.
    ///
    /// # Errors
    /// There is none of that name.
    pub fn find_joint(&self, name: &str) -> Result<usize, ChangeError> {
        self.joint(name).ok_or_else(|| ChangeError::NoJoint {
            joint: name.to_owned(),
            nearest: nearest(name, self.joints.iter().map(|j| &*j.name)).to_owned(),
        })
    }

    /// How long a link is: from its origin to its end, metres.
    pub fn length_of(&self, link: usize) -> f64 {
        self.tip(link).length()
    }

    /// The axis that a link appended to this one would most naturally have, in this link's frame: that of its own joint, or
    /// else across the plane of x and z.
    pub fn axis_for_more(&self, link: usize) -> DVec3 {
        let joint = link.checked_sub(1).and_then(|i| self.joints.get(i));
        joint.filter(|j| j.kind.has_axis()).map_or(DVec3::Y, |j| j.axis)
    }

    /// With one more link at the end of another, straight on from it, looking like a rod.
    ///
    /// # Errors
    /// No such link, a length that is not above 0, a name or an axis that no robot may have.
    pub fn appended(&self, to: usize, new: NewLink) -> Result<Robot, ChangeError> {
        let carrier = self.links.get(to).ok_or_else(|| missing(to))?;
        check_length(new.length)?;
        let end = self.tip(to);
        let direction = end.try_normalize().unwrap_or(DVec3::X);
        let tip = direction * new.length;
        let link = RobotLink {
            name: new.name.clone(),
            visuals: vec![rod(tip, carrier)],
            tip: Some(tip),
            ..RobotLink::default()
        };
        let joint = RobotJoint {
            name: new.name,
            kind: RobotJointKind::Revolute,
            parent: carrier.name.clone(),
            child: link.name.clone(),
            parent_from_joint: Frame::new(DQuat::IDENTITY, end),
            axis: new.axis,
            limit: Some(JointLimit { range: new.range, effort: 0.0, velocity: 0.0 }),
            mimic: None,
        };
        let (mut links, mut joints) = (self.links.clone(), self.joints.clone());
        // What would have ended at the end of what it looks like ends where the next link begins.
        links[to].tip = Some(end);
        links.push(link);
        joints.push(joint);
        Ok(Robot::new(self.name.clone(), links, joints)?)
    }

    /// Without a link and its joint. What it carried joins where it was joined, as if it had shrunk to nothing.
    ///
    /// # Errors
    /// No such link, the root, or one whose joint another follows.
    pub fn without(&self, link: usize) -> Result<Robot, ChangeError> {
        let removed = self.links.get(link).ok_or_else(|| missing(link))?;
        let Some(joint) = link.checked_sub(1) else {
            return Err(ChangeError::Root { link: removed.name.clone() });
        };
        if let Some(follower) = self.masters.iter().position(|m| *m == Some(joint)) {
            let [joint, follower] = [joint, follower].map(|j| self.joints[j].name.clone());
            return Err(ChangeError::Followed { joint, follower });
        }
        let (gone, tip) = (&self.joints[joint], self.tip(link));
        let (mut links, mut joints) = (self.links.clone(), self.joints.clone());
        for (other, _) in joints.iter_mut().zip(&self.carriers).filter(|(_, carrier)| **carrier == link) {
            let at = other.parent_from_joint;
            other.parent.clone_from(&gone.parent);
            other.parent_from_joint = gone.parent_from_joint.then(Frame::new(at.rotation, at.position - tip));
        }
        joints.remove(joint);
        links.remove(link);
        Ok(Robot::new(self.name.clone(), links, joints)?)
    }

    /// With a link longer or shorter. What joins it at its end moves along; what is seen of it is stretched if it lies along it.
    ///
    /// # Errors
    /// No such link, a length that is not above 0, or a link that has none.
    pub fn with_length(&self, link: usize, length: f64) -> Result<Robot, ChangeError> {
        let changed = self.links.get(link).ok_or_else(|| missing(link))?;
        check_length(length)?;
        let before = self.tip(link);
        let direction =
            before.try_normalize().ok_or_else(|| ChangeError::NoDirection { link: changed.name.clone() })?;
        let after = direction * length;
        let (mut links, mut joints) = (self.links.clone(), self.joints.clone());
        for (joint, _) in joints.iter_mut().zip(&self.carriers).filter(|(_, carrier)| **carrier == link) {
            if joint.parent_from_joint.position.distance(before) <= 1e-9 * before.length() {
                joint.parent_from_joint.position = after;
            }
        }
        links[link].tip = Some(after);
        let factor = length / before.length();
        links[link].visuals.iter_mut().for_each(|visual| stretch(visual, direction, factor));
        Ok(Robot::new(self.name.clone(), links, joints)?)
    }

    /// With another range of a joint of one value, radians or metres. A continuous joint becomes a revolute one.
    ///
    /// # Errors
    /// No such joint, one of another kind, or an empty range.
    pub fn with_range(&self, joint: usize, range: Interval) -> Result<Robot, ChangeError> {
        let mut joints = self.joints.clone();
        let changed = joints.get_mut(joint).ok_or_else(|| ChangeError::NoJoint {
            joint: format!("number {joint}"),
            nearest: String::new(),
        })?;
        match changed.kind {
            RobotJointKind::Revolute | RobotJointKind::Prismatic => {}
            RobotJointKind::Continuous => changed.kind = RobotJointKind::Revolute,
            kind => return Err(ChangeError::NoRange { joint: changed.name.clone(), kind: kind.name() }),
        }
        let limit = changed.limit.unwrap_or(JointLimit { range, effort: 0.0, velocity: 0.0 });
        changed.limit = Some(JointLimit { range, ..limit });
        Ok(Robot::new(self.name.clone(), self.links.clone(), joints)?)
    }

    /// With other names for the files of its meshes; what was read of them stays.
    #[must_use]
    pub fn with_mesh_files(mut self, renamed: impl Fn(&str) -> String) -> Robot {
        for link in &mut self.links {
            for visual in link.visuals.iter_mut().chain(&mut link.collisions) {
                if let Shape::Mesh { file, .. } = &mut visual.shape {
                    *file = renamed(file);
                }
            }
        }
        self
    }

    /// The pose of another robot with the values of the joints that both have, by name and kind; others 0.
    #[must_use]
    pub fn pose_from(&self, other: &Robot, pose: &RobotPose) -> RobotPose {
        let mut own = RobotPose(vec![0.0; self.value_count()]);
        for (i, joint) in self.joints.iter().enumerate() {
            let Some(there) = other.joint(&joint.name) else { continue };
            let values = other.values(pose, there);
            let slot = self.slot(i);
            if values.len() == slot.len() {
                own.0[slot].copy_from_slice(values);
            }
        }
        self.followed(&own)
    }
}

fn missing(link: usize) -> ChangeError {
    ChangeError::NoLink { link: format!("number {link}"), nearest: String::new() }
}

fn check_length(length: f64) -> Result<(), ChangeError> {
    if length > 0.0 && length.is_finite() { Ok(()) } else { Err(ChangeError::Length { length }) }
}

/// A rod from a link's origin to its end, painted like the link that carries it.
fn rod(tip: DVec3, carrier: &RobotLink) -> Visual {
    let radius = carrier
        .visuals
        .iter()
        .find_map(|v| match v.shape {
            Shape::Capsule { radius, .. } | Shape::Cylinder { radius, .. } => Some(radius),
            _ => None,
        })
        .unwrap_or(0.06 * tip.length());
    let paint: Option<Paint> = carrier.visuals.iter().find_map(|v| v.paint.clone());
    let turn = DQuat::from_rotation_arc(DVec3::Z, tip.normalize());
    Visual {
        name: None,
        link_from_visual: Frame::new(turn, tip * 0.5),
        shape: Shape::Capsule { radius, length: tip.length() },
        paint,
    }
}

/// Makes a visual longer along a direction of its link, if one of its axes lies along it; in any case it moves along.
fn stretch(visual: &mut Visual, direction: DVec3, factor: f64) {
    let at = visual.link_from_visual.position;
    let along = at.dot(direction) * direction;
    visual.link_from_visual.position = at - along + along * factor;
    let own = (visual.link_from_visual.rotation.conjugate() * direction).abs();
    let factors =
        if own.max_element() > 1.0 - 1e-6 { DVec3::ONE + (factor - 1.0) * own.round() } else { DVec3::ONE };
    match &mut visual.shape {
        Shape::Box(edges) => *edges *= factors,
        Shape::Cylinder { length, .. } | Shape::Capsule { length, .. } => *length *= factors.z,
        Shape::Mesh { scale, .. } => *scale *= factors,
        Shape::Sphere(_) => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A line of links of 1 m along x that turn about z.
    fn line(count: usize) -> Robot {
        let root = RobotLink { name: "link0".to_owned(), tip: Some(DVec3::X), ..RobotLink::default() };
        let mut robot = Robot::new("line", vec![root], Vec::new()).unwrap();
        for i in 1..count {
            let range = Interval::new(-2.0, 2.0);
            let new = NewLink { name: format!("link{i}"), length: 1.0, range, axis: DVec3::Z };
            robot = robot.appended(i - 1, new).unwrap();
        }
        robot
    }

    fn ends(robot: &Robot, pose: &RobotPose) -> Vec<DVec3> {
        let frames = robot.frames(pose);
        frames.iter().enumerate().map(|(i, f)| f.point(robot.tip(i))).collect()
    }

    #[test]
    fn what_is_appended_goes_straight_on_and_what_follows_a_removed_link_joins_on() {
        let robot = line(4);
        assert!(ends(&robot, &robot.rest())[3].abs_diff_eq(DVec3::X * 4.0, 1e-12));
        let pose = RobotPose(vec![0.3, 0.4, 0.5]);
        let fewer = robot.without(2).unwrap();
        let posed = fewer.pose_from(&robot, &pose);
        assert_eq!(posed.0, [0.3, 0.5]);
        let (before, after) = (ends(&robot, &pose), ends(&fewer, &posed));
        assert!(after[1].abs_diff_eq(before[1], 1e-12));
        let turned = DQuat::from_rotation_z(0.8) * DVec3::X;
        assert!(after[2].abs_diff_eq(after[1] + turned, 1e-12), "{}", after[2]);
    }

    #[test]
    fn a_longer_link_takes_along_what_joins_at_its_end() {
        let robot = line(3).with_length(1, 2.5).unwrap();
        let ends = ends(&robot, &robot.rest());
        assert!(ends[1].abs_diff_eq(DVec3::X * 3.5, 1e-12) && ends[2].abs_diff_eq(DVec3::X * 4.5, 1e-12));
        let Shape::Capsule { length, .. } = robot.links()[1].visuals[0].shape else { panic!("a rod") };
        assert!((length - 2.5).abs() < 1e-12);
        assert!(robot.links()[1].visuals[0].link_from_visual.position.abs_diff_eq(DVec3::X * 1.25, 1e-12));
    }

    #[test]
    fn faults_are_named_and_change_nothing() {
        let robot = line(3);
        let new = |name: &str, length| NewLink {
            name: name.to_owned(),
            length,
            range: Interval::new(0.0, 1.0),
            axis: DVec3::Z,
        };
        assert!(matches!(
            robot.appended(1, new("link1", 1.0)),
            Err(ChangeError::Robot(RobotError::Twice { .. }))
        ));
        assert!(matches!(robot.appended(1, new("more", 0.0)), Err(ChangeError::Length { .. })));
        assert!(matches!(robot.appended(1, new("more", f64::NAN)), Err(ChangeError::Length { .. })));
        assert!(matches!(robot.without(0), Err(ChangeError::Root { .. })));
        assert!(matches!(robot.without(9), Err(ChangeError::NoLink { .. })));
        assert!(matches!(robot.with_length(0, -1.0), Err(ChangeError::Length { .. })));
        let empty = Interval { min: 1.0, max: 0.0 };
        assert!(matches!(robot.with_range(0, empty), Err(ChangeError::Robot(RobotError::Limit { .. }))));
        let told = robot.find_link("lonk1").unwrap_err().to_string();
        assert_eq!(told, "there is no link \"lonk1\", did you mean \"link1\"?");
    }
}
