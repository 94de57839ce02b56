//! Forward and backward reaching: the joints' places are drawn to the target and back to the root, then each
//! joint aims at its successor's place as far as it can. For links on balls without ranges that is the published
//! method; the aiming is what keeps hinges, slides and ranges. Source: `fabrik`.

use glam::DVec3;

use super::ccd::aimed;
use super::linkage::Linkage;
use super::{Joint, Value};
use crate::Frame;

impl Linkage {
    /// One sweep there and back. May move the point away from the target where joints or ranges bend the way.
    pub(super) fn fabrik_sweep(&self, state: &mut [Value], places: &mut Vec<DVec3>) {
        self.drawn(state, places);
        self.aim(state, places);
    }

    /// Root to tip, each joint aims with what is behind it at that one's place, as far as its range lets it.
    pub(super) fn aim(&self, state: &mut [Value], places: &[DVec3]) {
        let mut at = Frame::IDENTITY;
        for k in 0..self.movers.len() {
            let mover = &self.movers[k];
            let joint_at = at.then(mover.origin);
            let now = joint_at.then(mover.joint.frame(state[k]));
            if let Some((lever, aim)) = self.lever(k, now, state) {
                state[k] =
                    aimed(&mover.joint, state[k], now, lever - now.position, places[aim] - now.position);
            }
            at = joint_at.then(mover.joint.frame(state[k]));
        }
    }

    /// Where each joint and the end would be, were they drawn to the target link by link.
    fn drawn(&self, state: &[Value], places: &mut Vec<DVec3>) {
        places.clear();
        let mut at = Frame::IDENTITY;
        for (mover, &value) in self.movers.iter().zip(state) {
            let joint_at = at.then(mover.origin);
            places.push(joint_at.position);
            at = joint_at.then(mover.joint.frame(value));
        }
        places.push(self.target);
        let mut last = at.then(self.end).position;
        for k in (0..self.movers.len()).rev() {
            let here = places[k];
            let length = self.drawn_length(k, here.distance(last), here.distance(places[k + 1]));
            let way = (here - places[k + 1]).try_normalize();
            last = here;
            if k > 0 {
                places[k] = places[k + 1] + way.unwrap_or(DVec3::ZERO) * length;
            }
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

/// How far the next joint is after a slide; without end for a slide without end.
pub(super) fn slid(axis: DVec3, slide: f64, next: DVec3) -> f64 {
    if slide.is_finite() { (axis * slide + next).length() } else { f64::INFINITY }
}
