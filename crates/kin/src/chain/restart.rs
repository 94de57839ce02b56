//! A search's budget, and where it begins again when the start leads nowhere: the same places for the same
//! problem, always.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};

use super::least_squares::Scratch;
use super::linkage::Linkage;
use super::{Joint, Value};
use crate::axis_angle::scaled_axis;

/// What a search may still do, and has done.
#[derive(Default)]
pub(super) struct Run {
    pub spent: usize,
    pub cap: usize,
    pub restarts: usize,
    pub scratch: Scratch,
}

impl Run {
    /// Takes one step from the budget, if there is one.
    pub(super) fn spend(&mut self) -> bool {
        let may = self.spent < self.cap;
        self.spent += usize::from(may);
        may
    }
}

/// Numbers from -1 to 1 without pattern: `splitmix64`.
struct Scatter(u64);

impl Scatter {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }
}

impl Linkage {
    /// Another start, in range: near the given one at first, anywhere later on.
    pub(super) fn elsewhere(&self, start: &[Value], restart: usize) -> Vec<Value> {
        let mut scatter = Scatter(restart as u64);
        let far = (0.08 * restart as f64).min(1.0);
        let one = |(mover, &value): (&super::linkage::Mover, &Value)| match (mover.joint, value) {
            (Joint::Revolute { range, .. }, Value::Amount(x)) => {
                Value::Amount(toward(x, range.min.max(x - PI), range.max.min(x + PI), scatter.next(), far))
            }
            (Joint::Prismatic { range, .. }, Value::Amount(x)) => {
                let (min, max) = (range.min.max(x - self.size), range.max.min(x + self.size));
                Value::Amount(toward(x, min, max, scatter.next(), far))
            }
            (joint, Value::Turn(q)) => {
                let turn = DVec3::new(scatter.next(), scatter.next(), scatter.next()) * (PI * far);
                let moved: DQuat = (q * scaled_axis(turn)).normalize();
                joint.clamp(Value::Turn(moved))
            }
            (_, value) => value,
        };
        self.movers.iter().zip(start).map(one).collect()
    }
}

/// From `x` part of the way to a place between two ends, given by a number from -1 to 1.
fn toward(x: f64, min: f64, max: f64, at: f64, part: f64) -> f64 {
    (x + part * (min + (max - min) * (0.5 + 0.5 * at) - x)).max(min).min(max)
}
