//! Stepping stones: tops at random heights, some tilted, with lower ground in the gaps.

use glam::{DVec2, DVec3};

use super::hashed;
use crate::GroundPoint;

/// Stones lie in rows of this pitch along x and z, metres; every other row is shifted by half.
const PITCH: DVec2 = DVec2::new(0.8, 0.62);

/// The ground in the gaps, metres.
const GAP_M: f64 = -0.14;

/// Stepping stones without end.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Stones {
    seed: u64,
}

/// One stone.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Stone {
    /// Its corners of least and greatest x and z, metres.
    pub low: DVec2,
    /// As `low`.
    pub high: DVec2,
    height: f64,
    gradient: DVec2,
}

impl Stone {
    /// The height of the top at a place of it.
    pub fn height(&self, at: DVec2) -> f64 {
        self.height + self.gradient.dot(at - 0.5 * (self.low + self.high))
    }

    /// The top's unit normal.
    pub fn normal(&self) -> DVec3 {
        DVec3::new(-self.gradient.x, 1.0, -self.gradient.y).normalize()
    }
}

impl Stones {
    /// The stones of a seed.
    pub fn new(seed: u64) -> Stones {
        Stones { seed }
    }

    /// The height of the ground between the stones, metres.
    pub(crate) fn gap(&self) -> f64 {
        GAP_M
    }

    /// The stone whose share of the plane holds a place.
    pub(crate) fn stone(&self, at: DVec2) -> Stone {
        let row = (at.y / PITCH.y).floor();
        let shift = 0.5 * PITCH.x * row.rem_euclid(2.0);
        let column = ((at.x + shift) / PITCH.x).floor();
        let random = |which| hashed(self.seed, column as i64, row as i64, which);
        let inset = |which| 0.015 + 0.04 * random(which);
        let corner = DVec2::new(column * PITCH.x - shift, row * PITCH.y);
        let (angle, tilt) = (random(4) * std::f64::consts::TAU, (10.0 * random(5) - 4.0).max(0.0));
        Stone {
            low: corner + DVec2::new(inset(0), inset(1)),
            high: corner + PITCH - DVec2::new(inset(2), inset(3)),
            height: 0.1 * (random(6) - 0.5),
            gradient: DVec2::from_angle(angle) * tilt.to_radians().tan(),
        }
    }

    pub(crate) fn under(&self, x: f64, z: f64) -> GroundPoint {
        let at = DVec2::new(x, z);
        let stone = self.stone(at);
        if at.cmpge(stone.low).all() && at.cmple(stone.high).all() {
            GroundPoint { height: stone.height(at), normal: stone.normal() }
        } else {
            GroundPoint::level(GAP_M)
        }
    }

    /// The stones that touch a rectangle, row by row.
    pub(crate) fn stones(&self, low: DVec2, high: DVec2) -> Vec<Stone> {
        let mut stones = Vec::new();
        let mut z = (low.y / PITCH.y).floor() * PITCH.y + 0.5 * PITCH.y;
        while z < high.y + PITCH.y {
            let mut x = low.x;
            while x < high.x + PITCH.x {
                stones.push(self.stone(DVec2::new(x, z)));
                x += PITCH.x;
            }
            z += PITCH.y;
        }
        stones
    }
}
