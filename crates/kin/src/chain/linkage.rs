//! The part of a chain that a search moves: the free joints between the root and the goal's point, what is rigid
//! between them folded in.

use glam::{DQuat, DVec3};

use super::fabrik::slid;
use super::forward::carried;
use super::goal::{Goal, Options};
use super::{Chain, Joint, Value};
use crate::Frame;
use crate::ball::rotation_vector;

/// A joint that may move.
#[derive(Clone, Copy, Debug)]
pub(super) struct Mover {
    /// Its node.
    pub node: usize,
    /// From the mover before it, or the world.
    pub origin: Frame,
    /// Its joint, the range widened to hold the value of the start.
    pub joint: Joint,
}

/// The joints that may move, root first, and the goal.
#[derive(Clone, Debug)]
pub(super) struct Linkage {
    pub movers: Vec<Mover>,
    /// The goal's node, shifted to the goal's point, in the last mover's frame.
    pub end: Frame,
    pub target: DVec3,
    pub rotation: Option<DQuat>,
    /// The length at the start, or the way to the target if that is more, metres: weighs turns against slides.
    pub size: f64,
    pub tolerance_m: f64,
    pub tolerance_rad: f64,
}

/// How far the end is from the goal.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    /// From the point to the target, metres.
    pub way: DVec3,
    /// The rotation vector that is missing, in the world; zero without a rotation in the goal.
    pub turn: DVec3,
}

impl Linkage {
    /// The free joints on a path, and the values where they start.
    pub(super) fn of(
        chain: &Chain,
        path: &[usize],
        values: &[Value],
        world_from_root: Frame,
        goal: &Goal,
        options: &Options,
    ) -> (Linkage, Vec<Value>) {
        let mut movers = Vec::with_capacity(path.len());
        let mut state = Vec::with_capacity(path.len());
        let mut rigid = world_from_root;
        for &i in path {
            let (node, value) = (&chain.nodes[i], values[i]);
            rigid = rigid.then(node.origin);
            if matches!(node.joint, Joint::Fixed) || options.holds(i) {
                rigid = rigid.then(node.joint.frame(value));
            } else {
                movers.push(Mover { node: i, origin: rigid, joint: node.joint.reaching(value) });
                state.push(value);
                rigid = Frame::IDENTITY;
            }
        }
        let end = Frame::new(rigid.rotation, rigid.point(goal.point));
        let mut linkage = Linkage {
            movers,
            end,
            target: goal.target,
            rotation: goal.rotation,
            size: 0.0,
            tolerance_m: options.tolerance_m,
            tolerance_rad: options.tolerance_rad,
        };
        let way = linkage.end_at(&state).position.distance(goal.target);
        linkage.size = linkage.length(&state).max(way).max(options.tolerance_m);
        (linkage, state)
    }

    /// From the first joint along all joints to the end, at those slides, metres.
    pub(super) fn length(&self, state: &[Value]) -> f64 {
        let slide = |k: usize| self.movers[k].joint.frame(state[k]).position;
        (0..self.movers.len()).map(|k| (slide(k) + self.next(k)).length()).sum()
    }

    /// The next joint's place, or the end's, in the frame of a mover.
    pub(super) fn next(&self, k: usize) -> DVec3 {
        self.movers.get(k + 1).map_or(self.end.position, |next| next.origin.position)
    }

    /// Writes the frame of every mover and returns that of the end.
    pub(super) fn forward(&self, state: &[Value], frames: &mut Vec<Frame>) -> Frame {
        frames.clear();
        frames.reserve(state.len());
        let mut at = Frame::IDENTITY;
        for (mover, &value) in self.movers.iter().zip(state) {
            at = mover.world_from_mover(at, value);
            frames.push(at);
        }
        at.then(self.end)
    }

    /// The frame of the end.
    pub(super) fn end_at(&self, state: &[Value]) -> Frame {
        let chain = self.movers.iter().zip(state);
        chain.fold(Frame::IDENTITY, |at, (mover, &value)| mover.world_from_mover(at, value)).then(self.end)
    }

    /// What is missing at an end.
    pub(super) fn gap(&self, end: Frame) -> Gap {
        let turn = |wanted: DQuat| rotation_vector((wanted * end.rotation.conjugate()).normalize());
        Gap { way: self.target - end.position, turn: self.rotation.map_or(DVec3::ZERO, turn) }
    }

    /// Metres for a radian, where a rotation is asked for too.
    pub(super) fn arm(&self) -> f64 {
        0.5 * self.size
    }

    /// The squared residual, metres squared.
    pub(super) fn cost(&self, gap: &Gap) -> f64 {
        gap.way.length_squared() + gap.turn.length_squared() * self.arm() * self.arm()
    }

    /// The squared residual of a state.
    pub(super) fn cost_at(&self, state: &[Value]) -> f64 {
        self.cost(&self.gap(self.end_at(state)))
    }

    /// Whether the gap is within the tolerances, with a little to spare for the rounding of another order of
    /// products.
    pub(super) fn met(&self, gap: &Gap) -> bool {
        gap.way.length() <= 0.999 * self.tolerance_m && gap.turn.length() <= 0.999 * self.tolerance_rad
    }

    /// Whether the target is so far that no values could meet it; slides are taken at their longest.
    pub(super) fn out_of_reach(&self) -> bool {
        let Some(first) = self.movers.first() else { return true };
        let longest = |k: usize| {
            let next = self.next(k);
            match self.movers[k].joint {
                Joint::Prismatic { axis, range } => {
                    slid(axis, range.min, next).max(slid(axis, range.max, next))
                }
                _ => next.length(),
            }
        };
        let lengths = || (0..self.movers.len()).map(longest);
        let total: f64 = lengths().sum();
        let slides = self.movers.iter().any(|mover| matches!(mover.joint, Joint::Prismatic { .. }));
        let inner = if slides { 0.0 } else { 2.0 * lengths().fold(0.0, f64::max) - total };
        let distance = self.target.distance(first.origin.position);
        distance > total + self.tolerance_m || distance < inner - self.tolerance_m
    }
}

impl Mover {
    #[inline(always)]
    fn world_from_mover(&self, world_from_before: Frame, value: Value) -> Frame {
        carried(world_from_before, &self.origin, &self.joint, value)
    }
}
