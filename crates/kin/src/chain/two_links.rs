//! Two links in closed form: the second joint sets how far the point is, the first where it points. The elbow
//! keeps its side.

use std::f64::consts::TAU;

use glam::DVec3;

use super::ccd::aimed;
use super::linkage::Linkage;
use super::{Joint, Value};
use crate::axis_angle;

impl Linkage {
    /// The state that brings the point to the target, or as near as it can without leaving its ranges; `None` if
    /// there are not two turning joints, or the goal has a rotation.
    ///
    /// Exact where the first joint is a ball, or both are hinges with parallel axes; else, or where a range
    /// stops it, a good guess.
    pub(super) fn two_links(&self, state: &[Value]) -> Option<Vec<Value>> {
        if self.movers.len() != 2 || self.rotation.is_some() {
            return None;
        }
        let mut frames = Vec::with_capacity(2);
        let point = self.forward(state, &mut frames).position;
        let (root, elbow) = (frames[0], frames[1]);
        let (upper, lower) = (elbow.position - root.position, point - elbow.position);
        let (axis, now) = match (self.movers[1].joint, state[1]) {
            (Joint::Revolute { axis, .. }, Value::Amount(now)) => (elbow.vector(axis), now),
            (Joint::Ball { .. }, Value::Turn(_)) => (self.fold_axis(upper, lower)?, 0.0),
            _ => return None,
        };
        let turn = turn_for(upper, lower, axis, self.target.distance(root.position))?;
        let mut out = state.to_vec();
        out[1] = match (self.movers[1].joint, state[1]) {
            (Joint::Revolute { range, .. }, _) => {
                let kept = turned_into(range, now, turn.kept);
                let other = turned_into(range, now, turn.other);
                Value::Amount(kept.or(other).unwrap_or_else(|| range.clamp(now + turn.kept)))
            }
            (joint, Value::Turn(q)) => {
                let axis = elbow.rotation.conjugate() * axis;
                joint.clamp(Value::Turn((q * axis_angle(axis, turn.kept)).normalize()))
            }
            (_, value) => value,
        };
        let bent = self.end_at(&out).position;
        let (from, to) = (bent - root.position, self.target - root.position);
        out[0] = aimed(&self.movers[0].joint, state[0], root, from, to);
        Some(out)
    }

    /// The axis about which two links on balls fold: across both, or, if they are straight, across them and the
    /// target. `None` for links without length.
    fn fold_axis(&self, upper: DVec3, lower: DVec3) -> Option<DVec3> {
        let (u, l) = (upper.try_normalize()?, lower.try_normalize()?);
        let across = u.cross(l);
        if across.length() > 1e-6 {
            return across.try_normalize();
        }
        let root = self.movers.first()?.origin.position;
        let to = (self.target - root).try_normalize()?;
        // The elbow goes where it turns least: the lower link folds toward the target.
        let aside = u.cross(to);
        if aside.length() > 1e-6 { aside.try_normalize() } else { Some(u.any_orthonormal_vector()) }
    }
}

/// Two turns of an elbow that give the same distance.
struct Turns {
    /// On the side where the elbow is.
    kept: f64,
    other: f64,
}

/// The turns about an axis that bring the far end of the lower link to a distance from the upper one's root, or
/// nearest to it.
///
/// With `w` the lower link across the axis: `d² = |u|² + |l|² + 2 u.(l - w) + 2 (u.w cos g + u.(axis x w) sin g)`.
fn turn_for(upper: DVec3, lower: DVec3, axis: DVec3, distance: f64) -> Option<Turns> {
    let across = lower - axis * axis.dot(lower);
    let (cosine, sine) = (upper.dot(across), upper.dot(axis.cross(across)));
    let swing = cosine.hypot(sine);
    if swing <= 0.0 || !swing.is_finite() {
        return None;
    }
    let rest = upper.length_squared() + lower.length_squared() + 2.0 * upper.dot(lower - across);
    let wanted = 0.5 * (distance * distance - rest) / swing;
    // Half-angle form: accurate near a straight elbow and near a folded one.
    let fold = 2.0 * (1.0 - wanted).max(0.0).sqrt().atan2((1.0 + wanted).max(0.0).sqrt());
    let straight = sine.atan2(cosine);
    let near = |angle: f64| (angle + std::f64::consts::PI).rem_euclid(TAU) - std::f64::consts::PI;
    // At turn 0 the elbow is `-straight` past the straight one.
    let side = if -straight < 0.0 { -1.0 } else { 1.0 };
    Some(Turns { kept: near(straight + side * fold), other: near(straight - side * fold) })
}

/// The value after a turn, up to full turns, if some such value lies in range: the nearest.
fn turned_into(range: crate::Interval, now: f64, turn: f64) -> Option<f64> {
    let back = if turn > 0.0 { turn - TAU } else { turn + TAU };
    [now + turn, now + back].into_iter().find(|&x| range.contains(x))
}
