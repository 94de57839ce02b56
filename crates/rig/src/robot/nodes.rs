//! A robot as a chain of nodes, for solvers.

use glam::{DQuat, DVec3};
use kin::chain::{Chain, ChainError, Joint, Node, Value};
use kin::{Frame, Interval};

use super::joint::across;
use super::{Robot, RobotJointKind, RobotPose, rotation_of_rpy, rpy_of_rotation};

/// A robot as a [`Chain`] in the frame of its root link, at a pose.
///
/// Node 0 is the root link. A joint is one node, but for planar ones (slide, slide, turn) and floating ones (three slides and a
/// ball): their inner nodes weigh nothing and have no length, and the last carries the link.
#[derive(Clone, PartialEq, Debug)]
pub struct RobotChain {
    /// The nodes. Joints that follow another are fixed where the pose puts them: see [`Robot::chain`].
    pub chain: Chain,
    /// The values of the pose, one a node.
    pub values: Vec<Value>,
    /// The node of each link: the last of its joint.
    pub node_of_link: Vec<usize>,
    /// The first node of each joint.
    first_of_joint: Vec<usize>,
}

impl RobotChain {
    /// The joint whose node this is; `None` for the root.
    pub fn joint_of_node(&self, node: usize) -> Option<usize> {
        self.first_of_joint.partition_point(|&first| first <= node).checked_sub(1)
    }
}

impl Robot {
    /// The robot as a chain at a pose. Joints that mimic another stand still in it, so that no solver moves them against
    /// their master; [`Robot::pose_of`] lets them follow again, and a solve that goes through them may be repeated from there.
    ///
    /// The end of a link is where its first moving joint is, or else its first joint, or else the far end of what is seen of it.
    ///
    /// # Errors
    /// None for a robot and a pose of finite numbers.
    pub fn chain(&self, pose: &RobotPose) -> Result<RobotChain, ChainError> {
        let pose = self.followed(pose);
        let root = Node { parent: None, origin: Frame::IDENTITY, joint: Joint::Fixed, tip: self.tip(0) };
        let mut nodes = vec![root];
        let mut values = vec![Joint::Fixed.rest()];
        let (mut node_of_link, mut first_of_joint) = (vec![0], Vec::new());
        for (i, joint) in self.joints.iter().enumerate() {
            first_of_joint.push(nodes.len());
            let own = self.values(&pose, i);
            let mut origin = joint.parent_from_joint;
            let mut steps = steps(joint.kind, joint.axis, joint.range(), own);
            if self.masters[i].is_some() || joint.kind == RobotJointKind::Fixed {
                origin = origin.then(joint.joint_from_child(own));
                steps = vec![(Joint::Fixed, Joint::Fixed.rest())];
            }
            let mut parent = node_of_link[self.carriers[i]];
            for (joint, value) in steps {
                nodes.push(Node { parent: Some(parent), origin, joint, tip: DVec3::ZERO });
                values.push(value);
                parent = nodes.len() - 1;
                origin = Frame::IDENTITY;
            }
            nodes[parent].tip = self.tip(i + 1);
            node_of_link.push(parent);
        }
        Ok(RobotChain { chain: Chain::new(nodes)?, values, node_of_link, first_of_joint })
    }

    /// The pose that values of its chain stand for, following joints where their masters put them. Values that are missing or of
    /// another kind leave what `before` has.
    #[must_use]
    pub fn pose_of(&self, chain: &RobotChain, values: &[Value], before: &RobotPose) -> RobotPose {
        let mut pose = self.followed(before);
        for (i, joint) in self.joints.iter().enumerate() {
            if self.masters[i].is_some() {
                continue;
            }
            let first = chain.first_of_joint.get(i).copied().unwrap_or(usize::MAX);
            let slot = self.slot(i);
            let amount = |k: usize| match values.get(first.saturating_add(k)) {
                Some(Value::Amount(v)) => Some(*v),
                _ => None,
            };
            let turn = |k: usize| match values.get(first.saturating_add(k)) {
                Some(Value::Turn(q)) => Some(rpy_of_rotation(*q)),
                _ => None,
            };
            let (slides, ball) = match joint.kind {
                RobotJointKind::Fixed => (0, None),
                RobotJointKind::Ball => (0, turn(0)),
                RobotJointKind::Floating => (3, turn(3)),
                RobotJointKind::Planar => (3, None),
                _ => (1, None),
            };
            for k in 0..slides {
                if let Some(v) = amount(k) {
                    pose.0[slot.start + k] = v;
                }
            }
            if let Some(rpy) = ball {
                pose.0[slot.start + slides..slot.end].copy_from_slice(&rpy);
            }
        }
        self.followed(&pose)
    }

    /// Where a link ends, in its own frame, metres: where the file says, or else where its first moving joint is, or else its
    /// first joint, or else the far end of what is seen of it. The origin for a link that isn't there.
    pub fn tip(&self, link: usize) -> DVec3 {
        if let Some(tip) = self.links.get(link).and_then(|l| l.tip) {
            return tip;
        }
        let carried = || self.joints.iter().enumerate().filter(|(i, _)| self.carriers[*i] == link);
        let moving = carried().find(|(_, j)| j.kind != RobotJointKind::Fixed);
        match moving.or_else(|| carried().next()) {
            Some((_, joint)) => joint.parent_from_joint.position,
            None => self.far_end(link),
        }
    }

    /// The far end of what is seen of a link; the origin if nothing is.
    fn far_end(&self, link: usize) -> DVec3 {
        let mut corners = Vec::new();
        for visual in self.links.get(link).map_or(&[][..], |l| &l.visuals) {
            let Some([low, high]) = visual.bounds() else { continue };
            for i in 0..8 {
                let pick = |axis: usize| if i >> axis & 1 == 0 { low[axis] } else { high[axis] };
                let corner = DVec3::new(pick(0), pick(1), pick(2));
                corners.push(visual.link_from_visual.point(corner));
            }
        }
        let center = corners.iter().sum::<DVec3>() / corners.len().max(1) as f64;
        let Some(direction) = center.try_normalize() else { return DVec3::ZERO };
        direction * corners.iter().map(|c| c.dot(direction)).fold(0.0, f64::max)
    }
}

/// The joints of a chain that move as a joint of a robot, and where they are.
fn steps(kind: RobotJointKind, axis: DVec3, range: Interval, values: &[f64]) -> Vec<(Joint, Value)> {
    let value = |i: usize| values.get(i).copied().unwrap_or(0.0);
    let turn = |axis, i| (Joint::Revolute { axis, range }, Value::Amount(value(i)));
    let slide = |axis, i| (Joint::Prismatic { axis, range }, Value::Amount(value(i)));
    let ball = |i| {
        let rotation: DQuat = rotation_of_rpy([value(i), value(i + 1), value(i + 2)]);
        (Joint::Ball { range: None }, Value::Turn(rotation))
    };
    match kind {
        RobotJointKind::Fixed => Vec::new(),
        RobotJointKind::Revolute | RobotJointKind::Continuous => vec![turn(axis, 0)],
        RobotJointKind::Prismatic => vec![slide(axis, 0)],
        RobotJointKind::Planar => {
            let [x, y] = across(axis);
            vec![slide(x, 0), slide(y, 1), turn(axis, 2)]
        }
        RobotJointKind::Ball => vec![ball(0)],
        RobotJointKind::Floating => {
            vec![slide(DVec3::X, 0), slide(DVec3::Y, 1), slide(DVec3::Z, 2), ball(3)]
        }
    }
}
