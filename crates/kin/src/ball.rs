//! Ball joints: a swing vector, which has no gimbal lock inside a half turn, and a twist about the bone.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};

use crate::arc_tangent;
use crate::axis_angle::{axis_angle, scaled_axis};

/// The axes of a ball joint: rotation = swing(flexion, abduction) then, innermost, twist.
///
/// The swing is a rotation vector in the plane of the flexion and abduction axes; the twist is about
/// their common normal. All three are unit vectors and mutually perpendicular; handedness is free, so a
/// right limb carries the mirrored axes of the left.
///
/// ```
/// let ball = kin::Ball { flexion: glam::DVec3::X, abduction: -glam::DVec3::Z, twist: glam::DVec3::Y };
/// let [flexion, abduction, twist] = ball.angles(ball.rotation(0.5, -0.2, 1.0));
/// assert!((flexion - 0.5).abs() + (abduction + 0.2).abs() + (twist - 1.0).abs() < 1e-14);
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ball {
    /// Axis of positive flexion.
    pub flexion: DVec3,
    /// Axis of positive abduction.
    pub abduction: DVec3,
    /// Axis of positive twist, along the bone or against it.
    pub twist: DVec3,
}

impl Ball {
    /// The rotation of those angles, radians; any size, NaN in is NaN out.
    pub fn rotation(&self, flexion: f64, abduction: f64, twist: f64) -> DQuat {
        let swing = scaled_axis(self.flexion * flexion + self.abduction * abduction);
        if twist == 0.0 { swing } else { swing * axis_angle(self.twist, twist) }
    }

    /// The angles of a rotation: flexion, abduction, twist in radians.
    ///
    /// The swing is at most pi; the twist is in (-pi, pi]. `q` and `-q` give the same angles, and the length
    /// of `q` does not matter. Angles whose swing is below pi come back from their rotation: to 1e-13 up
    /// to a swing of 3.1, then to the rounding divided by the distance from pi. At a swing of exactly pi
    /// the twist is 0 and the first of flexion and abduction that is not 0 is positive. A rotation that
    /// is not finite, or has no length, gives NaN or zeros.
    pub fn angles(&self, rotation: DQuat) -> [f64; 3] {
        let (swing, twist) = swing_twist(rotation, self.twist);
        let v = rotation_vector(swing);
        let [flexion, abduction] = [v.dot(self.flexion), v.dot(self.abduction)];
        let first = if flexion == 0.0 { abduction } else { flexion };
        if swing.w == 0.0 && first < 0.0 {
            [-flexion, -abduction, twist]
        } else {
            [flexion, abduction, twist]
        }
    }
}

/// Squares below this have lost bits.
const TINY: f64 = 1e-290;

/// Splits a rotation into `swing * twist` about a unit axis: the swing, whose scalar part is not
/// negative, and the twist's angle in (-pi, pi].
///
/// The swing is perpendicular to the axis to the last bit or two, also near a half turn. Where the swing is
/// exactly pi every twist would do; it is then 0.
pub fn swing_twist(rotation: DQuat, axis: DVec3) -> (DQuat, f64) {
    let q = if rotation.w < 0.0 { -rotation } else { rotation };
    let v = DVec3::new(q.x, q.y, q.z);
    let along = v.dot(axis);
    // The cosine of half the swing.
    let square = along * along + q.w * q.w;
    let upright = if square > TINY { square.sqrt() } else { along.hypot(q.w) };
    if upright == 0.0 {
        return (q, 0.0);
    }
    let (sine, cosine) = (along / upright, q.w / upright);
    let across = v - axis * along;
    let swing = across * cosine - across.cross(axis) * sine;
    let twist = 2.0 * arc_tangent(along, q.w);
    (DQuat::from_xyzw(swing.x, swing.y, swing.z, upright), if twist <= -PI { PI } else { twist })
}

/// The twist of a rotation about a unit axis alone, radians, as [`swing_twist`] has it.
pub fn twist_about(rotation: DQuat, axis: DVec3) -> f64 {
    let along = rotation.xyz().dot(axis);
    let (along, upright) = if rotation.w < 0.0 { (-along, -rotation.w) } else { (along, rotation.w) };
    if along == 0.0 && upright == 0.0 {
        return 0.0;
    }
    let twist = 2.0 * arc_tangent(along, upright);
    if twist <= -PI { PI } else { twist }
}

/// The rotation vector of a rotation: axis times angle, the angle at most pi, accurate at both ends.
pub(crate) fn rotation_vector(q: DQuat) -> DVec3 {
    let q = if q.w < 0.0 { -q } else { q };
    let v = DVec3::new(q.x, q.y, q.z);
    let sine = v.length();
    // Below the smallest sine whose square is a normal number, angle / sine is 2 / w to the last bit.
    if sine < 1e-150 {
        v * (2.0 / q.w.max(f64::MIN_POSITIVE))
    } else {
        v * (2.0 * arc_tangent(sine, q.w) / sine)
    }
}
