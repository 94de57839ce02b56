//! Feather curves: how one motion gives way to another.

use serde::{Deserialize, Serialize};

/// A curve from 0 at 0 to 1 at 1.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub enum Feather {
    /// At an even rate; the rate jumps at both ends.
    Linear,
    /// 3x² − 2x³: the rate is 0 at both ends.
    #[default]
    Smooth,
    /// 6x⁵ − 15x⁴ + 10x³: rate and acceleration are 0 at both ends.
    Smoother,
}

impl Feather {
    /// The curve's value; 0 before 0 and for NaN, 1 beyond 1, exactly.
    pub fn at(self, x: f64) -> f64 {
        let x = unit(x);
        match self {
            Feather::Linear => x,
            Feather::Smooth => x * x * (3.0 - 2.0 * x),
            Feather::Smoother => x * x * x * (x * (6.0 * x - 15.0) + 10.0),
        }
    }

    /// The curve's rate; 0 outside 0 to 1.
    pub fn rate(self, x: f64) -> f64 {
        if !(0.0..=1.0).contains(&x) {
            return 0.0;
        }
        match self {
            Feather::Linear => 1.0,
            Feather::Smooth => 6.0 * x * (1.0 - x),
            Feather::Smoother => 30.0 * (x * (1.0 - x)).powi(2),
        }
    }
}

/// The nearest number from 0 to 1; 0 for NaN.
fn unit(x: f64) -> f64 {
    if x >= 1.0 {
        1.0
    } else if x > 0.0 {
        x
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ALL: [Feather; 3] = [Feather::Linear, Feather::Smooth, Feather::Smoother];

    #[test]
    fn curves_go_from_0_to_1_exactly_and_never_back() {
        for feather in ALL {
            for (x, y) in [(0.0, 0.0), (1.0, 1.0), (-3.0, 0.0), (7.0, 1.0), (f64::NAN, 0.0), (0.5, 0.5)] {
                assert_eq!(feather.at(x), y, "{feather:?} at {x}");
            }
            for i in 0..1000 {
                let x = f64::from(i) / 1000.0;
                assert!(feather.at(x + 1e-3) >= feather.at(x), "{feather:?} at {x}");
            }
        }
    }

    #[test]
    fn rates_are_those_of_the_curves() {
        for feather in ALL {
            for i in 1..100 {
                let (x, h) = (f64::from(i) / 100.0, 1e-6);
                let rate = (feather.at(x + h) - feather.at(x - h)) / (2.0 * h);
                assert!((rate - feather.rate(x)).abs() < 1e-7, "{feather:?} at {x}");
            }
        }
        assert_eq!(Feather::Smooth.rate(0.0), 0.0);
        assert_eq!(Feather::Smoother.rate(1.0), 0.0);
    }
}
