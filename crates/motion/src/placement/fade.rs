//! A value that goes after another without a jump of value or rate.

use std::ops::{Add, Mul, Sub};

/// A value and its rate a second.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Fade<T> {
    pub value: T,
    pub rate: T,
}

impl<T> Fade<T>
where
    T: Copy + Default + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
{
    /// A critically damped spring's step toward a value, exact for any step: `quickness` in 1/s, so that it is nearly
    /// there after five of its parts of a second.
    pub fn toward(self, goal: T, quickness: f64, dt_secs: f64) -> Fade<T> {
        let (off, decay) = (self.value - goal, (-quickness * dt_secs).exp());
        let pull = self.rate + off * quickness;
        Fade {
            value: goal + (off + pull * dt_secs) * decay,
            rate: (self.rate - pull * (quickness * dt_secs)) * decay,
        }
    }

    /// Goes toward a value, or is there at once.
    pub fn follow(&mut self, goal: T, quickness: f64, dt_secs: f64, at_once: bool) {
        *self = if at_once {
            Fade { value: goal, rate: T::default() }
        } else {
            self.toward(goal, quickness, dt_secs)
        };
    }

    /// Part of the way, 0 to 1, to a value that stands still.
    pub fn held(self, value: T, share: f64) -> Fade<T> {
        Fade { value: self.value * (1.0 - share) + value * share, rate: self.rate * (1.0 - share) }
    }
}

/// 0 to 1 without a kink as a value goes from one edge to the other.
pub(super) fn smooth(value: f64, from: f64, to: f64) -> f64 {
    let t = ((value - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_of_any_length_lead_to_the_same_place() {
        let start = Fade { value: 1.0, rate: -3.0 };
        let once = start.toward(0.2, 12.0, 0.1);
        let many = (0..50).fold(start, |fade, _| fade.toward(0.2, 12.0, 0.002));
        assert!((once.value - many.value).abs() < 1e-12 && (once.rate - many.rate).abs() < 1e-10);
        assert!((start.toward(0.2, 12.0, 2.0).value - 0.2).abs() < 1e-7);
        // The rate is that of the value.
        let after = start.toward(0.2, 12.0, 1e-6);
        assert!(((after.value - start.value) / 1e-6 + 3.0).abs() < 1e-3);
    }
}
