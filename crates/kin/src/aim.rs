//! Two numbers that make a line of sight meet its goal: damped Newton steps on the sphere of directions.

use glam::{DMat2, DQuat, DVec2, DVec3};

/// The angle in radians below which a line of sight has met its goal.
pub const AIM_TOLERANCE_RAD: f64 = 1e-12;

/// The most Newton steps that a solve takes; from the closed-form start it needs two to five.
pub const AIM_STEPS: u32 = 48;

/// Input for which an aim has no answer.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum AimError {
    /// Some number is NaN, infinite or beyond 1e100, or a rotation is not one: it has no length, or a
    /// residue not that of a unit.
    #[error("a number is not finite, or a rotation is not one")]
    NotFinite,
    /// The line that should be aimed has no length or an axis has none.
    #[error("what should be aimed has no direction")]
    NoLine,
    /// The aim has no direction, or the target is where the line starts.
    #[error("the aim has no direction")]
    NoAim,
}

/// Where a line of sight points and where it should point, unit vectors; both may depend on the unknowns.
pub(crate) struct Sight {
    pub(crate) along: DVec3,
    pub(crate) goal: DVec3,
}

impl Sight {
    /// The angle between line and goal, radians.
    pub(crate) fn off(&self) -> f64 {
        self.miss().length()
    }

    /// The rotation vector that takes the line to its goal; half a turn about any normal if they are opposite.
    fn miss(&self) -> DVec3 {
        let cross = self.along.cross(self.goal);
        let (sine, cosine) = (cross.length(), self.along.dot(self.goal));
        if sine > 1e-150 {
            cross * (sine.atan2(cosine) / sine)
        } else if cosine < 0.0 {
            self.along.any_orthonormal_vector() * std::f64::consts::PI
        } else {
            DVec3::ZERO
        }
    }
}

/// What a solve found.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct Aimed {
    pub(crate) at: DVec2,
    /// Angle between line and goal, radians.
    pub(crate) off: f64,
    pub(crate) steps: u32,
}

/// Damped Newton steps from a start: every accepted step comes nearer to the goal.
///
/// `hold` brings the unknowns back to where they may be. `None` from `sight` marks a place without an
/// answer; from the start itself it is the result. The slopes are central differences, whose error of about
/// 1e-10 leaves the convergence as good as quadratic.
pub(crate) fn aim(
    start: DVec2,
    hold: impl Fn(DVec2) -> DVec2,
    sight: impl Fn(DVec2) -> Option<Sight>,
) -> Option<Aimed> {
    let mut at = start;
    let mut miss = sight(at)?.miss();
    let mut damping = 0.0;
    let mut steps = 0;
    while steps < AIM_STEPS && miss.length() > AIM_TOLERANCE_RAD {
        steps += 1;
        let Some(slopes) = slopes(at, &sight) else { break };
        let next = hold(at + newton(slopes, miss, damping));
        match sight(next).map(|s| s.miss()) {
            Some(nearer) if nearer.length() < miss.length() => {
                (at, miss) = (next, nearer);
                damping = if damping < 1e-6 { 0.0 } else { damping * 0.1 };
            }
            _ if damping > 1e12 => break,
            _ => damping = (damping * 10.0).max(1e-4),
        }
    }
    Some(Aimed { at, off: miss.length(), steps })
}

/// Whether a quaternion is a rotation.
pub(crate) fn is_turn(q: DQuat) -> bool {
    q.is_finite() && q.is_normalized()
}

/// The first start that reaches, else the best; the others are for the rare case in which the first
/// one ends in a blind alley.
pub(crate) fn best_of(starts: [DVec2; 3], from: impl Fn(DVec2) -> Option<Aimed>) -> Option<Aimed> {
    let mut best: Option<Aimed> = None;
    for start in starts {
        let Some(found) = from(start) else { continue };
        if found.off <= AIM_TOLERANCE_RAD || best.is_none_or(|best| found.off < best.off - 1e-3) {
            best = Some(found);
        }
        if best.is_some_and(|best| best.off <= AIM_TOLERANCE_RAD) {
            break;
        }
    }
    best
}

/// How the miss changes with each unknown.
fn slopes(at: DVec2, sight: impl Fn(DVec2) -> Option<Sight>) -> Option<[DVec3; 2]> {
    const STEP: f64 = 1e-5;
    let slope = |way: DVec2| {
        let (ahead, behind) = (sight(at + way * STEP)?.miss(), sight(at - way * STEP)?.miss());
        Some((ahead - behind) / (2.0 * STEP))
    };
    Some([slope(DVec2::X)?, slope(DVec2::Y)?])
}

/// The step that would undo the miss, damped in the manner of Levenberg and Marquardt, at most one radian long.
fn newton([x, y]: [DVec3; 2], miss: DVec3, damping: f64) -> DVec2 {
    let size = (x.length_squared() + y.length_squared()).max(f64::MIN_POSITIVE);
    // A trace of damping keeps the matrix regular where one unknown has no effect.
    let held = size * (damping + 1e-15);
    let normal = DMat2::from_cols(
        DVec2::new(x.length_squared() + held, x.dot(y)),
        DVec2::new(x.dot(y), y.length_squared() + held),
    );
    let step = -(normal.inverse() * DVec2::new(x.dot(miss), y.dot(miss)));
    if step.is_finite() { step.clamp_length_max(1.0) } else { DVec2::ZERO }
}
