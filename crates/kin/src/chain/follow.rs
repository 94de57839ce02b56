//! A chain that is drawn by a point, as a rope is or a snake: each link turns no more than it must to stay on
//! the one ahead of it.
//!
//! From the dragged point to the root: the link's far joint heads for where it was, its near end is where the
//! link ahead has it. A long drag is made in steps, so that the body follows the head's way and not a straight
//! cut. The root joint keeps its value; the whole chain's place moves.

use glam::{DQuat, DVec3};

use super::ccd::aimed;
use super::goal::Goal;
use super::linkage::Linkage;
use super::{Joint, Value};
use crate::Frame;

/// The most steps of one drag.
const MOST_STEPS: f64 = 16.0;

impl Linkage {
    /// Draws the point to the target and returns the frame of the first mover's joint then, and how many steps
    /// it took.
    ///
    /// The first mover's own value stays: with the whole chain free to turn about it, it has nothing to add.
    pub(super) fn follow(&self, state: &mut [Value], frames: &mut Vec<Frame>, goal: &Goal) -> (Frame, usize) {
        let mut end = self.forward(state, frames);
        let from = end.position;
        let links = self.movers.len().max(1) as f64;
        let steps = (from.distance(goal.target) * links / self.length(state)).ceil().clamp(1.0, MOST_STEPS);
        for step in 1..=steps as usize {
            end = self.drawn_to(from.lerp(goal.target, step as f64 / steps), end, state, frames);
        }
        let first = frames.first().copied().unwrap_or(Frame::IDENTITY);
        let turned = self.movers.first().map_or(Frame::IDENTITY, |mover| mover.joint.frame(state[0]));
        (first.then(turned.inverse()), steps as usize)
    }

    /// One step: frames and state change, and the new frame of the end comes back.
    fn drawn_to(&self, place: DVec3, end: Frame, state: &mut [Value], frames: &mut [Frame]) -> Frame {
        let Some(last) = self.movers.len().checked_sub(1) else {
            return Frame::new(end.rotation, place);
        };
        // The link that is held by the point swings about it, as if on a ball.
        let swing = arc(end.position - frames[last].position, place - frames[last].position);
        let rotation = (swing * frames[last].rotation).normalize();
        frames[last] = Frame::new(rotation, place - rotation * self.end.position);
        for k in (1..=last).rev() {
            self.trail(k, state, frames);
        }
        Frame::new((frames[last].rotation * self.end.rotation).normalize(), place)
    }

    /// Lets the link before joint `k` follow: the joint turns so that the link's root stays as near as it can to
    /// where it was.
    fn trail(&self, k: usize, state: &mut [Value], frames: &mut [Frame]) {
        let (mover, before) = (&self.movers[k], frames[k - 1]);
        let ahead = frames[k];
        // The joint seen from the far side: the link ahead stands, the one behind it turns the other way.
        let behind =
            |value: Value| ahead.then(mover.joint.frame(value).inverse()).then(mover.origin.inverse());
        let now = behind(state[k]);
        let root = now.position;
        let joint_at = ahead.position;
        let (from, to) = (root - joint_at, before.position - joint_at);
        let moved = backward(&mover.joint, state[k], ahead, from, to);
        if behind(moved).position.distance_squared(before.position) < root.distance_squared(before.position) {
            state[k] = moved;
        }
        frames[k - 1] = behind(state[k]);
    }
}

/// The value with which the link behind a joint points at a place while the link ahead stays.
fn backward(joint: &Joint, value: Value, ahead: Frame, from: DVec3, to: DVec3) -> Value {
    match (*joint, value) {
        // The link behind turns by `t` when the joint's value falls by `t`: aim with the ends exchanged.
        (Joint::Revolute { .. } | Joint::Prismatic { .. }, _) => aimed(joint, value, ahead, to, from),
        (Joint::Ball { .. }, Value::Turn(q)) => {
            let turn = arc(from, to);
            let in_ahead = ahead.rotation.conjugate() * turn * ahead.rotation;
            joint.clamp(Value::Turn((q * in_ahead.conjugate()).normalize()))
        }
        _ => value,
    }
}

/// The smallest turn from one direction to another; none without direction.
fn arc(from: DVec3, to: DVec3) -> DQuat {
    match (from.try_normalize(), to.try_normalize()) {
        (Some(from), Some(to)) => DQuat::from_rotation_arc(from, to),
        _ => DQuat::IDENTITY,
    }
}
