//! What can be chosen of a chain, and the walk from its root to its tip.

use rig::{Robot, RobotDof, RobotJointKind, RootMoves};

use super::document::ChainDocument;

/// What is chosen of a chain: its root, or one way in which a joint moves.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum ChainNode {
    /// The root link, with which the whole chain goes.
    #[default]
    Root,
    /// The value of a pose at that place: see [`Robot::dofs`].
    Value(usize),
}

impl ChainNode {
    /// All of a chain that a hand can move, from root to tip. The root is left out where it is held, and where its first joint
    /// is a base that slides: moving that moves the whole chain.
    pub fn all(document: &ChainDocument) -> Vec<ChainNode> {
        let robot = &document.robot;
        let free = robot.dofs().enumerate().filter(|(_, dof)| !dof.follows);
        let values = free.map(|(slot, _)| ChainNode::Value(slot));
        let moves = document.root != RootMoves::Held && base(robot).is_none();
        let root = moves.then_some(ChainNode::Root);
        root.into_iter().chain(values).collect()
    }

    /// The first of all.
    pub fn first(document: &ChainDocument) -> ChainNode {
        ChainNode::all(document).first().copied().unwrap_or_default()
    }

    /// The next toward the tip, or back toward the root, round and round. What is none of them counts as before the first.
    #[must_use]
    pub fn next(self, document: &ChainDocument, back: bool) -> ChainNode {
        let all = ChainNode::all(document);
        let Some(last) = all.len().checked_sub(1) else { return ChainNode::Root };
        let place = all.iter().position(|node| *node == self);
        all[match (place, back) {
            (None, _) => 0,
            (Some(at), false) => (at + 1) % all.len(),
            (Some(at), true) => at.checked_sub(1).unwrap_or(last),
        }]
    }

    /// What moves a link: its joint, or the nearest one toward the root that moves at all.
    pub fn of_link(robot: &Robot, link: usize) -> ChainNode {
        let mut at = link;
        while let Some(joint) = at.checked_sub(1) {
            let slot = robot.slot(joint);
            if !slot.is_empty() {
                return ChainNode::Value(slot.start);
            }
            at = robot.carrier(joint).unwrap_or(0);
        }
        base(robot).map_or(ChainNode::Root, |joint| ChainNode::Value(robot.slot(joint).start))
    }

    /// What it is a value of; `None` for the root, and for a place that no pose of the robot has.
    pub fn dof(self, robot: &Robot) -> Option<RobotDof> {
        match self {
            ChainNode::Root => None,
            ChainNode::Value(slot) => robot.dofs().nth(slot),
        }
    }

    /// Its joint; `None` for the root.
    pub fn joint(self, robot: &Robot) -> Option<usize> {
        self.dof(robot).map(|dof| dof.joint)
    }

    /// Its link: the root link, or the one that its joint carries.
    pub fn link(self, robot: &Robot) -> usize {
        self.joint(robot).map_or(0, |joint| joint + 1)
    }

    /// Whether moving it moves the whole chain.
    pub fn is_base(self, robot: &Robot) -> bool {
        match self.joint(robot) {
            None => true,
            Some(joint) => base(robot) == Some(joint),
        }
    }
}

/// The joint on which all others hang and that slides: what a chain drives about on.
pub(super) fn base(robot: &Robot) -> Option<usize> {
    use RobotJointKind::{Floating, Planar, Prismatic};
    let moves = |joint: usize| !robot.slot(joint).is_empty();
    let first = (0..robot.joints().len()).find(|joint| moves(*joint))?;
    let slides = matches!(robot.joints()[first].kind, Prismatic | Planar | Floating);
    let hangs = |mut joint: usize| loop {
        match robot.carrier(joint).and_then(|link| link.checked_sub(1)) {
            Some(carrier) if carrier == first => break true,
            Some(carrier) => joint = carrier,
            None => break false,
        }
    };
    let all = (first + 1..robot.joints().len()).filter(|joint| moves(*joint)).all(hangs);
    (slides && all && robot.master(first).is_none()).then_some(first)
}
