//! Ball joints: a swing vector, which has no gimbal lock inside a half turn, and a twist about the bone.

use glam::{DQuat, DVec3};

/// The axes of a ball joint: rotation = swing(flexion, abduction) then, innermost, twist.
///
/// The swing is a rotation vector in the plane of the flexion and abduction axes; the twist is about
/// their common normal. All three are unit vectors and mutually perpendicular; handedness is free, so a
/// right limb carries the mirrored axes of the left.
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
    /// The rotation of those angles, radians.
    pub fn rotation(&self, flexion: f64, abduction: f64, twist: f64) -> DQuat {
        let swing = DQuat::from_scaled_axis(self.flexion * flexion + self.abduction * abduction);
        swing * DQuat::from_axis_angle(self.twist, twist)
    }

    /// The angles of a rotation: flexion, abduction, twist in radians.
    ///
    /// Swing is at most pi; twist is in (-pi, pi]. At a swing of exactly pi the twist is 0.
    pub fn angles(&self, rotation: DQuat) -> [f64; 3] {
        let (swing, twist) = swing_twist(rotation, self.twist);
        let v = positive(swing).to_scaled_axis();
        [v.dot(self.flexion), v.dot(self.abduction), twist]
    }
}

/// Splits a unit rotation into `swing * twist` about a unit axis: the swing and the twist's angle in (-pi, pi].
///
/// Where the swing is exactly pi every twist would do; it is then 0.
pub fn swing_twist(rotation: DQuat, axis: DVec3) -> (DQuat, f64) {
    let along = DVec3::new(rotation.x, rotation.y, rotation.z).dot(axis);
    let (sine, cosine) = if rotation.w < 0.0 { (-along, -rotation.w) } else { (along, rotation.w) };
    if sine == 0.0 && cosine == 0.0 {
        return (rotation, 0.0);
    }
    let twist = 2.0 * sine.atan2(cosine);
    (rotation * DQuat::from_axis_angle(axis, -twist), twist)
}

/// The same rotation with a non-negative scalar part.
fn positive(q: DQuat) -> DQuat {
    if q.w < 0.0 { -q } else { q }
}
