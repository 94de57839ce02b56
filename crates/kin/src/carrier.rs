//! The carrier: the rotation that brings the limb from +y to the direction of its target.

use glam::{DQuat, DVec3};

/// How the reference orientation of the limb follows the target's direction; it fixes what elevation 0 means.
///
/// No carrier is smooth over the whole sphere: each has at least one direction near which a small
/// move of the target turns the limb a lot.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Carrier {
    /// The minimal rotation from a base direction to the target's, after the constant minimal
    /// rotation from +y to the base. Singular only opposite to the base. Source: `sew`.
    Swing {
        /// Unit base direction in the limb frame.
        base: DVec3,
    },
    /// Turn about x, then about z, as in the hybrid method's paper. Singular along both z directions.
    /// Source: `hybrid`.
    Spherical,
}

impl Carrier {
    /// The rotation that takes +y to a unit direction.
    pub fn rotation(self, direction: DVec3) -> DQuat {
        match self {
            Carrier::Swing { base } => arc(base, direction) * arc(DVec3::Y, base),
            Carrier::Spherical => {
                let lift = direction.z.atan2(direction.x.hypot(direction.y));
                let turn = (-direction.x).atan2(direction.y);
                DQuat::from_rotation_z(turn) * DQuat::from_rotation_x(lift)
            }
        }
    }
}

/// The minimal rotation from one unit vector to another, accurate to rounding for small turns too.
///
/// For opposite vectors a fixed half turn is taken.
pub fn arc(from: DVec3, to: DVec3) -> DQuat {
    let half = from + to;
    let axis = from.cross(half);
    let turn = DQuat::from_xyzw(axis.x, axis.y, axis.z, from.dot(half));
    if turn.length_squared() >= f64::MIN_POSITIVE {
        turn.normalize()
    } else {
        let axis = from.any_orthonormal_vector();
        DQuat::from_xyzw(axis.x, axis.y, axis.z, 0.0)
    }
}

/// Sine and cosine of half the angle of `(cosine, sine)`, a vector of any length, without the angle: half of
/// `atan2(sine, cosine)`, so the cosine is not negative. The null vector is no turn.
pub fn half_turn(sine: f64, cosine: f64) -> (f64, f64) {
    let length = (sine * sine + cosine * cosine).sqrt();
    let (s, c) =
        if cosine >= 0.0 { (sine, length + cosine) } else { ((length - cosine).copysign(sine), sine.abs()) };
    let norm = (s * s + c * c).sqrt();
    if norm > 0.0 { (s / norm, c / norm) } else { (0.0, 1.0) }
}
