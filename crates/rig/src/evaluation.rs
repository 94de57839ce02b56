//! What a pose comes to: every joint in the world, every limb's contact and inverse parameters.

use glam::DVec3;

use crate::{Frames, Limb};

/// Derived from figure and pose, never stored.
#[derive(Clone, PartialEq, Debug)]
pub struct Evaluation {
    /// `world_from_joint` of every bone; bones that the figure lacks share their carrier's frame.
    pub frames: Frames,
    /// The limbs by [`Limb::index`].
    pub limbs: [LimbView; Limb::ALL.len()],
    /// Centre of mass, metres, world.
    pub center_of_mass: DVec3,
}

/// A limb as the animator sees it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LimbView {
    /// Where the articulator is, metres, world.
    pub articulator: DVec3,
    /// The contact's target, else the articulator itself; metres, world.
    pub target: DVec3,
    /// From articulator to target, metres.
    pub residual: f64,
    /// How far a planted end is turned from the rotation it should keep, degrees; else 0.
    pub rotation_residual: f64,
    /// Degrees in (-180, 180]; `None` where articulator and root joint coincide.
    pub elevation: Option<f64>,
    /// The feasible interval around the elevation, degrees, so that it contains it (ends may pass
    /// 180); -180 to 180 if free, `None` if the ranges leave none.
    pub elevation_range: Option<[f64; 2]>,
    /// +1 or -1: which solution of the hinge.
    pub branch: i8,
}
