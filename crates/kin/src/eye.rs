//! Eyes: two hinges that aim a line of sight, in closed form.

use glam::{DQuat, DVec3};

use crate::aim::AimError;
use crate::limb::usable;

/// The two hinges of an eye (or of any pan and tilt head): rotation = outer hinge, then inner.
///
/// Unit axes in the eye's rest frame, mutually perpendicular; handedness is free, so a mirrored eye carries
/// mirrored axes. In an eye whose flexion comes first in the file the flexion is the outer one.
///
/// ```
/// use glam::DVec3;
/// let eye = kin::Eye { outer: DVec3::X, inner: DVec3::Y, forward: DVec3::Z };
/// let target_from_eye = DVec3::new(0.3, 0.2, 1.0);
/// let [flexion, twist] = eye.angles(target_from_eye)?;
/// assert!(flexion < 0.0 && twist > 0.0, "up and to the figure's left");
/// assert!((eye.rotation([flexion, twist]) * DVec3::Z).distance(target_from_eye.normalize()) < 1e-15);
/// # Ok::<(), kin::AimError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Eye {
    /// Axis of the hinge that carries the other.
    pub outer: DVec3,
    /// Axis of the hinge that the other carries.
    pub inner: DVec3,
    /// Line of sight at rest.
    pub forward: DVec3,
}

impl Eye {
    /// The rotation of those angles, outer and inner, radians.
    pub fn rotation(&self, [outer, inner]: [f64; 2]) -> DQuat {
        DQuat::from_axis_angle(self.outer, outer) * DQuat::from_axis_angle(self.inner, inner)
    }

    /// The angles, outer and inner, that aim the eye along a direction of any length in the frame that carries it.
    ///
    /// The outer one is in (-pi, pi], the inner one in [-pi/2, pi/2]. Along the outer axis itself, where any
    /// outer angle would do, it is 0.
    ///
    /// # Errors
    /// A direction without length, numbers that are not finite.
    pub fn angles(&self, toward: DVec3) -> Result<[f64; 2], AimError> {
        if !usable(toward) {
            return Err(AimError::NotFinite);
        }
        let along = toward.try_normalize().ok_or(AimError::NoAim)?;
        // inner turns forward to cos(b) forward + sin(b) inner x forward, and that last one is outer or -outer
        let side = along.dot(self.outer) * self.inner.cross(self.forward).dot(self.outer).signum();
        let [ahead, round] = [along.dot(self.forward), along.dot(self.outer.cross(self.forward))];
        let outer = if ahead == 0.0 && round == 0.0 { 0.0 } else { round.atan2(ahead) };
        Ok([outer, side.atan2(ahead.hypot(round))])
    }
}
