//! How a motion carries the whole figure along.

use glam::DVec2;

/// The figure's own motion over the ground.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Travel {
    /// Metres a second in the figure's axes: x to its left, y ahead.
    pub velocity: DVec2,
    /// Degrees a second about +Y, positive to the figure's left.
    pub turn_rate: f64,
}
