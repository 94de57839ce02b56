//! The collar: the smallest turn that brings the shoulder within reach, and the rhythm that may lead it.

use glam::{DQuat, DVec3};

use crate::limb::usable;

/// How the collar turns for a target.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum CollarTurn {
    /// The arm reaches from where the shoulder is.
    Unneeded,
    /// The smallest turn after which the arm reaches, fully stretched.
    Turned(DQuat),
    /// No turn is enough; this one brings the shoulder nearest.
    OutOfReach {
        /// The turn.
        rotation: DQuat,
        /// What is still missing after it, metres.
        residual: f64,
    },
    /// Numbers that are not finite, a negative reach, or a shoulder or target at the collar joint: no turn
    /// of the collar helps.
    Degenerate,
}

impl CollarTurn {
    /// The turn to apply; the identity where there is none.
    pub fn rotation(self) -> DQuat {
        match self {
            CollarTurn::Turned(rotation) | CollarTurn::OutOfReach { rotation, .. } => rotation,
            CollarTurn::Unneeded | CollarTurn::Degenerate => DQuat::IDENTITY,
        }
    }
}

/// The smallest turn about the collar joint that brings the shoulder within `reach` of a target.
///
/// `shoulder` and `target` are seen from the collar joint, with the collar as it is now, metres, in any one
/// frame; `reach` is the arm's far end of [`Limb::reach`](crate::Limb::reach). The turn is applied on the
/// left of the collar's present rotation in that frame, and is about the normal of the plane of both: it
/// carries no twist about the shoulder's line. Clamping to the collar's range is the caller's, for instance
/// through the angles of its [`Ball`](crate::Ball).
///
/// For a shoulder exactly opposite to its target the plane is any.
pub fn collar_turn(shoulder: DVec3, target: DVec3, reach: f64) -> CollarTurn {
    let numbers = usable(shoulder) && usable(target) && reach >= 0.0;
    if !numbers {
        return CollarTurn::Degenerate;
    }
    if shoulder.distance(target) <= reach {
        return CollarTurn::Unneeded;
    }
    let (Some(from), Some(to)) = (shoulder.try_normalize(), target.try_normalize()) else {
        return CollarTurn::Degenerate;
    };
    let (arm, far) = (shoulder.length(), target.length());
    let cross = from.cross(to);
    let present = cross.length().atan2(from.dot(to));
    let axis = normal(from, cross);
    // The half-angle form of cos(wanted) = (arm² + far² - reach²) / (2 arm far), accurate at both ends.
    let closest = arm - far;
    let short = (reach - closest) * (reach + closest);
    if short < 0.0 {
        let rotation = DQuat::from_axis_angle(axis, present);
        return CollarTurn::OutOfReach { rotation, residual: closest.abs() - reach };
    }
    let wanted = 2.0 * short.sqrt().atan2(((arm + far - reach) * (arm + far + reach)).max(0.0).sqrt());
    CollarTurn::Turned(DQuat::from_axis_angle(axis, (present - wanted).max(0.0)))
}

/// The unit normal of a plane that holds `from`, given a rough one; any if there is none.
///
/// Near to parallel the product is mostly rounding, and a normal that is not perpendicular would miss.
fn normal(from: DVec3, rough: DVec3) -> DVec3 {
    if rough.length() < 1e-15 {
        return from.any_orthonormal_vector();
    }
    (rough - from * rough.dot(from)).normalize()
}

/// How far the collar rises with the arm: nothing up to an onset, then a share of each further degree.
///
/// Source: `inman`: of every three degrees of elevation past about 30 the upper arm gives two and the
/// girdle one. Measured with bone pins it is nearer to 2.3 to one (`braman`).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Rhythm {
    /// The arm's elevation at which the collar begins to rise, radians.
    pub onset_rad: f64,
    /// The collar's part of each further radian, 0 to 1.
    pub share: f64,
    /// The most that it rises, radians.
    pub most_rad: f64,
}

impl Rhythm {
    /// From 30 degrees on one third, to 45 degrees.
    pub const INMAN: Rhythm = Rhythm {
        onset_rad: std::f64::consts::FRAC_PI_6,
        share: 1.0 / 3.0,
        most_rad: std::f64::consts::FRAC_PI_4,
    };

    /// The collar's elevation in radians for an arm along a direction, or for its target's direction from the
    /// shoulder, which keeps the collar in closed form.
    ///
    /// `down` is where a hanging arm points, in the frame that carries the collar; neither needs to be of unit
    /// length. The elevation counts from a hanging arm's girdle: a figure whose zero is the T pose takes
    /// the difference to `elevation` of its own rest arm (20 degrees) if its rest is to stay as it is.
    /// Continuous everywhere. `None` for a direction without length or numbers that are not finite.
    pub fn elevation(&self, arm: DVec3, down: DVec3) -> Option<f64> {
        if !usable(arm) || !usable(down) {
            return None;
        }
        let (arm, down) = (arm.try_normalize()?, down.try_normalize()?);
        let raised = arm.cross(down).length().atan2(arm.dot(down));
        let rise = self.share * (raised - self.onset_rad);
        rise.is_finite().then(|| rise.min(self.most_rad).max(0.0))
    }
}
