//! Cyclic coordinate descent: from the tip to the root, each joint brings the point as near to the target as it
//! alone can. Source: `ccd`.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3};

use super::linkage::Linkage;
use super::{Joint, Value};
use crate::ball::rotation_vector;
use crate::{Frame, Interval, axis_angle::scaled_axis};

impl Linkage {
    /// One sweep; returns where the point is then. Never moves it away from the target.
    pub(super) fn ccd_sweep(&self, state: &mut [Value], frames: &mut Vec<Frame>) -> DVec3 {
        let mut point = self.forward(state, frames).position;
        let most = TAU / self.movers.len() as f64;
        for k in (0..self.movers.len()).rev() {
            let frame = frames[k];
            let (from, to) = (point - frame.position, self.target - frame.position);
            let joint = self.movers[k].joint;
            let moved = part_way(&joint, state[k], aimed(&joint, state[k], frame, from, to), most);
            if moved == state[k] {
                continue;
            }
            let after = if let (Joint::Prismatic { axis, .. }, Value::Amount(now), Value::Amount(was)) =
                (joint, moved, state[k])
            {
                point + frame.vector(axis) * (now - was)
            } else {
                let world_from_joint = frame.rotation * joint.frame(state[k]).rotation.conjugate();
                let turned = world_from_joint * joint.frame(moved).rotation;
                frame.position + turned * (frame.rotation.conjugate() * from)
            };
            if after.distance_squared(self.target) < point.distance_squared(self.target) {
                (point, state[k]) = (after, moved);
            }
        }
        point
    }
}

/// A turn by at most so many radians: else the tip of a long chain curls up before the rest has moved.
fn part_way(joint: &Joint, from: Value, to: Value, most: f64) -> Value {
    match (joint, from, to) {
        (Joint::Revolute { .. }, Value::Amount(from), Value::Amount(to)) => {
            Value::Amount(to.max(from - most).min(from + most))
        }
        (Joint::Ball { .. }, Value::Turn(from), Value::Turn(to)) => {
            let turn = rotation_vector(from.conjugate() * to);
            let angle = turn.length();
            if angle <= most {
                return Value::Turn(to);
            }
            joint.clamp(Value::Turn((from * scaled_axis(turn * (most / angle))).normalize()))
        }
        _ => to,
    }
}

/// The value of a joint, in range, that brings a lever's end as near to another place as the joint alone can.
/// Both are seen from the joint, in the world's axes; `frame` is `world_from_node` at the present value.
pub(super) fn aimed(joint: &Joint, value: Value, frame: Frame, from: DVec3, to: DVec3) -> Value {
    match (*joint, value) {
        (Joint::Revolute { axis, range }, Value::Amount(x)) => {
            let axis = frame.vector(axis);
            let (from, to) = (from - axis * axis.dot(from), to - axis * axis.dot(to));
            let angle = axis.dot(from.cross(to)).atan2(from.dot(to));
            Value::Amount(nearest_turn(x, angle, range))
        }
        (Joint::Prismatic { axis, range }, Value::Amount(x)) => {
            Value::Amount(range.clamp(x + frame.vector(axis).dot(to - from)))
        }
        (Joint::Ball { .. }, Value::Turn(q)) => match (from.try_normalize(), to.try_normalize()) {
            (Some(from), Some(to)) => {
                let back = frame.rotation.conjugate();
                let turn = DQuat::from_rotation_arc(back * from, back * to);
                joint.clamp(Value::Turn((q * turn).normalize()))
            }
            _ => value,
        },
        _ => value,
    }
}

/// From `x` by an angle, up to full turns, in range: the end of the range that is nearest where the angle itself
/// is outside.
fn nearest_turn(x: f64, angle: f64, range: Interval) -> f64 {
    let wanted = x + angle;
    let other = if angle > 0.0 { wanted - TAU } else { wanted + TAU };
    if range.contains(wanted) || angle == 0.0 {
        return wanted;
    }
    if range.contains(other) {
        return other;
    }
    let off = |at: f64| {
        let turn = (at - wanted).rem_euclid(TAU);
        if turn > PI { TAU - turn } else { turn }
    };
    [range.min, range.max]
        .into_iter()
        .filter(|end| end.is_finite())
        .fold(x, |best, end| if off(end) < off(best) { end } else { best })
}
