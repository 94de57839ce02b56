//! Closing in on a target with a limb's joints in range: least-squares steps between straight bounds.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::axis_angle::scaled_axis;
use crate::bounded_step::{Bounds, Step, bounded_step};
use crate::{Interval, Limb, LimbState, RootRange, swing_twist, wrapped};

/// A target, and what the joints that close in on it may do.
///
/// A step is a turn of the root in limb axes and of the hinge, radians.
pub(crate) struct Settling<'a> {
    pub limb: &'a Limb,
    pub in_hinge: DVec3,
    pub target: DVec3,
    pub root: &'a RootRange,
    /// The hinge's range on the branch that is kept.
    pub hinge: Interval,
    /// The elevation to stay near, and how near, radians.
    pub elevation: f64,
    pub window: f64,
    /// What the hinge alone leaves missed, metres.
    pub gap: f64,
}

/// Joints, and how they stand to target and ranges.
#[derive(Clone, Copy)]
pub(crate) struct Standing {
    pub state: LimbState,
    /// Where the articulator is.
    pub place: DVec3,
    /// From the elevation to stay near, radians.
    turned: f64,
    /// Near the middle of its range, radians.
    twist: f64,
    bone: DVec3,
}

impl Settling<'_> {
    pub fn standing(&self, state: LimbState) -> Standing {
        let place = self.limb.articulator(&state, self.in_hinge);
        let (_, twist) = swing_twist(state.root, self.root.twist_axis);
        let middle = 0.5 * (self.root.twist.min + self.root.twist.max);
        let twist = if middle.is_finite() { middle + wrapped(twist - middle) } else { twist };
        Standing {
            state,
            place,
            turned: self.turned(&state, place),
            twist,
            bone: state.root * self.root.bone,
        }
    }

    /// How far the elevation is from the one to stay near, radians.
    fn turned(&self, state: &LimbState, place: DVec3) -> f64 {
        self.limb.read(state.root, place).map_or(0.0, |(goal, _)| wrapped(goal.elevation - self.elevation))
    }

    /// How far the joints are out of their ranges, radians.
    pub fn excess(&self, at: &Standing) -> f64 {
        let cone = (self.root.cone.angle(at.bone) - self.root.cone.half_angle).max(0.0);
        cone + self.root.twist.excess(at.twist) + (at.turned.abs() - self.window).max(0.0)
    }

    /// What the joints cost, metres: the miss, and a little for a change of the elevation.
    ///
    /// Where the miss hardly depends on the elevation, this keeps it from wandering.
    pub fn cost(&self, at: &Standing) -> f64 {
        let missed = at.place.distance(self.target);
        let turned = at.turned / self.window.max(1e-6);
        missed + self.calm(missed) * turned * turned
    }

    /// What a change of the elevation by the whole window costs at a miss, metres: nothing where the root points at
    /// the target, so that there the elevation is the feasible one nearest to the goal's, as it is within range.
    fn calm(&self, missed: f64) -> f64 {
        let aside = (missed - self.gap).max(0.0);
        CALM_M * aside / (aside + 0.02)
    }

    /// Joints in range from which no small step leads nearer; the rounds bound the work.
    pub fn settle(&self, from: LimbState, rounds: usize) -> Standing {
        let price = |at: &Standing| self.cost(at) + PRICE * self.excess(at);
        let mut at = self.standing(from);
        let mut cost = price(&at);
        let mut damping = 0.02;
        for _ in 0..rounds {
            let step = self.step(&at, damping);
            let longest = step.iter().fold(0.0f64, |a, s| a.max(s.abs()));
            let next = self.standing(self.stepped(&at.state, &step, (LONGEST / longest).min(1.0)));
            let gain = cost - price(&next);
            if gain > 0.0 {
                (at, cost) = (next, cost - gain);
                damping = (0.3 * damping).max(1e-4);
            } else {
                damping *= 4.0;
            }
            if gain.abs() < 1e-12 {
                break;
            }
        }
        self.returned(at)
    }

    /// Joints that straight steps left a little out of their ranges, brought back the shortest way.
    fn returned(&self, mut at: Standing) -> Standing {
        for _ in 0..RETURNS {
            if self.excess(&at) <= 0.0 {
                break;
            }
            at = self.standing(self.stepped(&at.state, &self.step(&at, 1e9), 1.0));
        }
        at
    }

    fn stepped(&self, state: &LimbState, step: &Step, share: f64) -> LimbState {
        let turn = DVec3::new(step[0], step[1], step[2]) * share;
        LimbState {
            root: (scaled_axis(turn) * state.root).normalize(),
            hinge: self.hinge.clamp(state.hinge + step[3] * share),
        }
    }

    /// The damped least-squares step for half the square of the cost, inside the ranges.
    fn step(&self, at: &Standing, damping: f64) -> Step {
        let off = at.place - self.target;
        let along_hinge = self.limb.along_hinge(&at.state, self.in_hinge);
        let columns = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| axis.cross(at.place));
        let columns = [columns[0], columns[1], columns[2], along_hinge];
        let slope = self.elevation_slope(at);
        let missed = off.length();
        let weight = 2.0 * self.calm(missed) * missed / (self.window * self.window).max(1e-12);
        let mut matrix = [[0.0; 4]; 4];
        let mut pull = [0.0; 4];
        for i in 0..4 {
            (0..4).for_each(|j| matrix[i][j] = columns[i].dot(columns[j]) + weight * slope[i] * slope[j]);
            matrix[i][i] += damping;
            pull[i] = -columns[i].dot(off) - weight * at.turned * slope[i];
        }
        bounded_step(&matrix, pull, &self.bounds(at, slope))
    }

    /// How the elevation goes with a step.
    fn elevation_slope(&self, at: &Standing) -> Step {
        std::array::from_fn(|i| {
            let mut nudge = [0.0; 3];
            let mut state = at.state;
            match nudge.get_mut(i) {
                Some(turn) => *turn = NUDGE,
                None => state.hinge += NUDGE,
            }
            state.root = scaled_axis(DVec3::from(nudge)) * state.root;
            let place = self.limb.articulator(&state, self.in_hinge);
            wrapped(self.turned(&state, place) - at.turned) / NUDGE
        })
    }

    /// The ranges as straight bounds on a step.
    fn bounds(&self, at: &Standing, elevation_slope: Step) -> Bounds {
        let mut bounds = Bounds::default();
        // What a step can't come near does not bound it.
        let mut push = |slope: Step, room: f64| {
            if room < ROOM {
                bounds.push(slope, room - MARGIN);
            }
        };
        let turn = |v: DVec3| [v.x, v.y, v.z, 0.0];
        let minus = |slope: Step| slope.map(|s| -s);
        let cone = self.root.cone;
        let across = cone.axis.cross(at.bone);
        if cone.half_angle < PI && across.length() > 1e-6 {
            push(turn(across.normalize()), cone.half_angle - cone.angle(at.bone));
        }
        if let Some(slope) = self.twist_slope(at) {
            push(turn(slope), self.root.twist.max - at.twist);
            push(turn(-slope), at.twist - self.root.twist.min);
        }
        push(elevation_slope, self.window - at.turned);
        push(minus(elevation_slope), self.window + at.turned);
        let along = [0.0, 0.0, 0.0, 1.0];
        push(along, self.hinge.max - at.state.hinge);
        push(minus(along), at.state.hinge - self.hinge.min);
        bounds
    }

    /// How the twist 2 atan2(v . t, w) goes with a turn of the root; `None` where it is free, or swung by a half turn.
    fn twist_slope(&self, at: &Standing) -> Option<DVec3> {
        let (q, t) = (at.state.root, self.root.twist_axis);
        let v = DVec3::new(q.x, q.y, q.z);
        let along = v.dot(t);
        let upright = along * along + q.w * q.w;
        let bounded = self.root.twist.max - self.root.twist.min < TAU && upright > 1e-9;
        bounded.then(|| ((t * q.w + v.cross(t)) * q.w + v * along) / upright)
    }
}

/// What a change of the elevation by the whole window costs at most, metres.
const CALM_M: f64 = 0.003;

/// What a radian out of range costs on the way, metres.
const PRICE: f64 = 3.0;

/// Bounds farther off than this are left out of a step; the longest step; the step of a difference, radians.
const ROOM: f64 = 0.8;
const LONGEST: f64 = 0.4;
const NUDGE: f64 = 1e-6;

/// How far inside their ranges joints settle, radians.
const MARGIN: f64 = 1e-10;

/// Steps at the end that bring joints back into their ranges.
const RETURNS: usize = 6;
