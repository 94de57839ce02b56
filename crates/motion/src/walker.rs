//! A figure that walks: tree, ground and time go in, a pose comes out.

use std::sync::Arc;

use rig::{Figure, Pose};

use crate::{FootView, Ground, Steering};

/// A figure that walks. Same start, same steps, same bits.
#[derive(Clone, Debug)]
pub struct Walker {
    pose: Pose,
    feet: [FootView; 2],
}

impl Walker {
    /// A figure that stands at the origin, facing +Z.
    pub fn new(figure: Arc<Figure>) -> Walker {
        Walker { pose: figure.rest_pose(), feet: Default::default() }
    }

    /// Goes on by a time step, seconds.
    pub fn step(&mut self, _ground: &Ground, _steering: &Steering, _dt_secs: f64) {}

    /// The pose as it now is, limbs free.
    pub fn pose(&self) -> &Pose {
        &self.pose
    }

    /// The feet as they were placed, left and right.
    pub fn feet(&self) -> &[FootView; 2] {
        &self.feet
    }
}
