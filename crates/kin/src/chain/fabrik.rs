//! Forward and backward reaching: the joints' places are drawn to the target and back to the root, then each
//! joint aims at its successor's place as far as it can. For links on balls without ranges that is the published
//! method; the aiming is what keeps hinges, slides and ranges. Source: `fabrik`.

use glam::DVec3;

use super::ccd::aimed;
use super::forward::carried;
use super::linkage::Linkage;
use super::{Joint, Value};
use crate::{Frame, axis_angle};

/// Where the joints are and the end is, and where they are drawn to.
#[derive(Default)]
pub(super) struct Places {
    now: Vec<DVec3>,
    drawn: Vec<DVec3>,
}

impl Linkage {
    /// One sweep there and back; returns where the point is then. It may be farther from the target where joints
    /// or ranges bend the way. `places` are those of the sweep before, or empty.
    pub(super) fn fabrik_sweep(&self, state: &mut [Value], places: &mut Places) -> DVec3 {
        if places.now.is_empty() {
            self.joints(state, &mut places.now);
        }
        let Places { now, drawn } = places;
        self.draw(now, drawn);
        now.clear();
        self.aim(state, drawn, now)
    }

    /// Every joint pointed at the target.
    pub(super) fn pointed(&self, start: &[Value]) -> Vec<Value> {
        let mut state = start.to_vec();
        self.aim(&mut state, &vec![self.target; start.len() + 1], &mut Vec::new());
        state
    }

    /// Root to tip, each joint aims with what is behind it at that one's place, as far as its range lets it. Adds
    /// where the joints and the end are then to `now`, and returns the last.
    fn aim(&self, state: &mut [Value], places: &[DVec3], now: &mut Vec<DVec3>) -> DVec3 {
        let mut at = Frame::IDENTITY;
        for (k, mover) in self.movers.iter().enumerate() {
            let before = carried(at, &mover.origin, &mover.joint, state[k]);
            at = before;
            if let Some((lever, aim)) = self.lever(k, before, state) {
                let (from, to) = (lever - before.position, places[aim] - before.position);
                let value = aimed(&mover.joint, state[k], before, from, to);
                at = moved(before, &mover.joint, state[k], value);
                state[k] = value;
            }
            now.push(slid_back(at, &mover.joint, state[k]));
        }
        now.push(at.point(self.end.position));
        at.point(self.end.position)
    }

    /// Where the joints are, before their slides, and the end.
    fn joints(&self, state: &[Value], out: &mut Vec<DVec3>) {
        let mut at = Frame::IDENTITY;
        for (mover, &value) in self.movers.iter().zip(state) {
            at = carried(at, &mover.origin, &mover.joint, value);
            out.push(slid_back(at, &mover.joint, value));
        }
        out.push(at.point(self.end.position));
    }

    /// Where each joint and the end would be, were they drawn to the target link by link.
    fn draw(&self, now: &[DVec3], out: &mut Vec<DVec3>) {
        out.clear();
        out.extend_from_slice(now);
        let last = self.movers.len();
        out[last] = self.target;
        for k in (1..last).rev() {
            let ahead = out[k + 1];
            let length = self.drawn_length(k, now[k].distance(now[k + 1]), now[k].distance(ahead));
            out[k] = ahead + (now[k] - ahead).try_normalize().unwrap_or(DVec3::ZERO) * length;
        }
    }

    /// A link's length while it is drawn: its own, or for a slide the nearest to what is wanted.
    fn drawn_length(&self, k: usize, now: f64, wanted: f64) -> f64 {
        let Joint::Prismatic { axis, range } = self.movers[k].joint else { return now };
        let next = self.next(k);
        let nearest = slid(axis, range.clamp(-axis.dot(next)), next);
        let farthest = slid(axis, range.min, next).max(slid(axis, range.max, next));
        wanted.max(nearest).min(farthest)
    }

    /// What a joint can aim with: the first place behind it that is off its axis. The place in the world, and
    /// its index.
    fn lever(&self, k: usize, world_from_mover: Frame, state: &[Value]) -> Option<(DVec3, usize)> {
        let mut at = world_from_mover;
        let off = |place: DVec3| {
            let arm = place - world_from_mover.position;
            match self.movers[k].joint {
                Joint::Revolute { axis, .. } => world_from_mover.vector(axis).cross(arm).length(),
                Joint::Prismatic { .. } => self.size,
                _ => arm.length(),
            }
        };
        let far = |place: DVec3| off(place) > 1e-6 * self.size;
        for (next, (mover, &value)) in self.movers.iter().zip(state).enumerate().skip(k + 1) {
            let joint_at = at.then(mover.origin);
            if far(joint_at.position) {
                return Some((joint_at.position, next));
            }
            at = joint_at.then(mover.joint.frame(value));
        }
        let end = at.then(self.end).position;
        far(end).then_some((end, self.movers.len()))
    }
}

/// A joint's place before its slide, from the frame behind it.
fn slid_back(world_from_node: Frame, joint: &Joint, value: Value) -> DVec3 {
    match joint {
        Joint::Prismatic { .. } => world_from_node.point(-joint.frame(value).position),
        _ => world_from_node.position,
    }
}

/// The frame behind a joint after its value has changed.
fn moved(world_from_node: Frame, joint: &Joint, from: Value, to: Value) -> Frame {
    match (joint, from, to) {
        (Joint::Ball { .. }, Value::Turn(from), Value::Turn(to)) => {
            Frame::new(world_from_node.rotation * (from.conjugate() * to), world_from_node.position)
        }
        (Joint::Revolute { axis, .. }, Value::Amount(from), Value::Amount(to)) => {
            Frame::new(world_from_node.rotation * axis_angle(*axis, to - from), world_from_node.position)
        }
        (Joint::Prismatic { axis, .. }, Value::Amount(from), Value::Amount(to)) => {
            Frame::new(world_from_node.rotation, world_from_node.point(*axis * (to - from)))
        }
        _ => world_from_node,
    }
}

/// How far the next joint is after a slide; without end for a slide without end.
pub(super) fn slid(axis: DVec3, slide: f64, next: DVec3) -> f64 {
    if slide.is_finite() { (axis * slide + next).length() } else { f64::INFINITY }
}
