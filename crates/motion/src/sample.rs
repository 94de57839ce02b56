//! What a motion asks of a figure at a moment.

use glam::DVec3;
use rig::{Angles, Bone};

/// How firmly a foot stands, in the motion on flat ground: 0 in the air, 1 with its whole weight to take.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Bearing {
    /// The heel.
    pub heel: f64,
    /// The ball, and the toes with it.
    pub ball: f64,
}

/// A figure at a moment of a motion on flat ground: what clips give, trees blend and the feet's placement bends.
///
/// Angles blend linearly (swing vectors, twists and hinges alike), so blends of poses in range stay in range,
/// and weights of 0 and 1 give the ends bit for bit.
#[derive(Clone, PartialEq, Debug)]
pub struct Sample {
    /// The hips joint in figure space, metres; flat ground is at height 0.
    pub hips: DVec3,
    /// Degrees, by [`Bone::index`].
    pub angles: [Angles; Bone::COUNT],
    /// Left foot, right foot.
    pub bearing: [Bearing; 2],
}
