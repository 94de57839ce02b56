//! Stairs along z: up, a landing, down, a landing, and again.

use crate::GroundPoint;

/// Stairs along z, as wide as the world: up, a landing, down, a landing, and again. The origin is in the middle of a
/// lower landing, at height 0.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Stairs {
    rise_m: f64,
    going_m: f64,
    risers: u32,
    landing_m: f64,
}

impl Default for Stairs {
    fn default() -> Stairs {
        Stairs::new(Stairs::RISE_M, Stairs::GOING_M, Stairs::RISERS, Stairs::LANDING_M)
    }
}

impl Stairs {
    /// The height of a riser by default, metres.
    pub const RISE_M: f64 = 0.15;
    /// The depth of a tread by default, metres.
    pub const GOING_M: f64 = 0.37;
    /// How many risers a flight has by default.
    pub const RISERS: u32 = 8;
    /// The length of a landing by default, metres.
    pub const LANDING_M: f64 = 3.0;

    /// Stairs of so many risers a flight (1 to 1000) of a height (within 0 and 0.5 m), treads of a depth and landings
    /// of a length (both within 0.1 and 100 m). Numbers that are none count as the least.
    pub fn new(rise_m: f64, going_m: f64, risers: u32, landing_m: f64) -> Stairs {
        let held =
            |value: f64, low: f64, high: f64| if value.is_nan() { low } else { value.clamp(low, high) };
        Stairs {
            rise_m: held(rise_m, 0.0, 0.5),
            going_m: held(going_m, 0.1, 100.0),
            risers: risers.clamp(1, 1000),
            landing_m: held(landing_m, 0.1, 100.0),
        }
    }

    fn flight(&self) -> f64 {
        f64::from(self.risers - 1) * self.going_m
    }

    fn period(&self) -> f64 {
        2.0 * (self.landing_m + self.flight())
    }

    /// The level of the tread at a place, in risers above the lower landing, and the distance to the next riser ahead.
    fn tread(&self, z: f64) -> (u32, f64) {
        let (flight, period) = (self.flight(), self.period());
        let at = (z + 0.5 * self.landing_m).rem_euclid(period);
        let up = self.landing_m;
        let down = 2.0 * self.landing_m + flight;
        let climbed = |along: f64| ((along / self.going_m).floor() as u32 + 1).min(self.risers);
        if at < up {
            (0, up - at)
        } else if at < up + flight {
            let level = climbed(at - up);
            (level, up + f64::from(level) * self.going_m - at)
        } else if at < down {
            (self.risers, down - at)
        } else {
            let level = climbed(at - down);
            (self.risers - level, (down + f64::from(level) * self.going_m).min(period + up) - at)
        }
    }

    pub(crate) fn under(&self, _x: f64, z: f64) -> GroundPoint {
        GroundPoint::level(f64::from(self.tread(z).0) * self.rise_m)
    }

    /// The treads between two places: where each begins and ends, and its height, metres.
    pub(crate) fn treads(&self, from: f64, to: f64) -> Vec<(f64, f64, f64)> {
        let mut treads = Vec::new();
        let mut z = from;
        while z < to {
            let (level, ahead) = self.tread(z);
            let end = (z + ahead.max(1e-6)).min(to);
            treads.push((z, end, f64::from(level) * self.rise_m));
            // A rounding beyond the riser, so that it isn't met twice.
            z = end + 1e-9;
        }
        treads
    }
}
