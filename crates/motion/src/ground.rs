//! Ground to stand on.

use glam::DVec3;

/// The ground under a point.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct GroundPoint {
    /// World height, metres.
    pub height: f64,
    /// Unit normal, upward.
    pub normal: DVec3,
}

/// Ground to stand on: a height for every place.
#[derive(Clone, PartialEq, Debug, Default)]
pub enum Ground {
    /// Level, at height 0.
    #[default]
    Flat,
}

impl Ground {
    /// The ground under (or over) a place, `x` and `z` in metres, world.
    pub fn under(&self, _x: f64, _z: f64) -> GroundPoint {
        match self {
            Ground::Flat => GroundPoint { height: 0.0, normal: DVec3::Y },
        }
    }
}
