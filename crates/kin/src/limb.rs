//! One limb, arm or leg: a root ball joint, a hinge, and an end that carries the articulator.
//!
//! Solve and recover in closed form. Source: `hybrid`, extended by the branch, the swing carrier and
//! offset hinges.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3};

use crate::axis_angle::{axis_angle, sin_cos};
use crate::carrier::{arc, half_turn};
use crate::{Carrier, Interval, arc_tangent};

/// The fixed geometry of a limb, in its limb frame: origin at the root joint, any rest direction.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Limb {
    hinge_at_rest: DVec3,
    axis: DVec3,
    carrier: Carrier,
    /// The constant part of a swing carrier, from +y to its base.
    base_from_y: DQuat,
    /// `R_D`: takes the rest limb to upper segment along +y and hinge axis +x.
    rest: DQuat,
    /// The hinge's shift along its own axis, metres.
    side: f64,
    /// Length of the upper segment across the hinge axis, metres.
    upper: f64,
}

/// The joints of a limb.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LimbState {
    /// Root rotation, from rest, in limb axes.
    pub root: DQuat,
    /// Hinge angle, radians.
    pub hinge: f64,
}

/// Which of the two hinge angles that put the articulator at a given distance.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Branch {
    /// sin(g + psi) >= 0: the usual one.
    #[default]
    Plus,
    /// sin(g + psi) < 0.
    Minus,
}

impl Branch {
    /// +1 or -1.
    pub const fn sign(self) -> f64 {
        match self {
            Branch::Plus => 1.0,
            Branch::Minus => -1.0,
        }
    }

    /// The other one.
    pub const fn flipped(self) -> Branch {
        match self {
            Branch::Plus => Branch::Minus,
            Branch::Minus => Branch::Plus,
        }
    }
}

/// The inverse parameters of a limb: what an inverse gesture changes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LimbGoal {
    /// Where the articulator goes, metres, limb frame.
    pub target: DVec3,
    /// Turn about the line from root to articulator, radians.
    pub elevation: f64,
    /// Which solution of the hinge.
    pub branch: Branch,
}

/// How a target lies to what the hinge can span.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Span {
    /// Within reach.
    Reached,
    /// Beyond full stretch: the limb is stretched toward the target.
    TooFar,
    /// Inside the fully folded limb: it is folded toward the target.
    TooNear,
}

/// Input for which the closed form has no answer.
#[derive(Clone, Copy, PartialEq, Eq, Debug, thiserror::Error)]
pub enum Degenerate {
    /// Some number is NaN, infinite or beyond 1e100.
    #[error("a number is not finite")]
    NotFinite,
    /// The upper segment has no length across the hinge axis.
    #[error("the upper segment has no length across the hinge axis")]
    NoUpper,
    /// The hinge axis has no length.
    #[error("the hinge axis has no length")]
    NoAxis,
    /// The articulator lies on the hinge axis: bending moves it nowhere.
    #[error("the articulator lies on the hinge axis")]
    ArticulatorOnHinge,
    /// The target is at the root joint: no direction to point in.
    #[error("the target is at the root joint")]
    TargetAtRoot,
    /// The articulator is at the root joint: no line to elevate about.
    #[error("the articulator is at the root joint")]
    ArticulatorAtRoot,
}

/// A hinge angle for a distance.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HingeSolution {
    /// Radians.
    pub angle: f64,
    /// Whether the distance can be had.
    pub span: Span,
}

/// A solved limb.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LimbSolution {
    /// The joints.
    pub state: LimbState,
    /// Whether the target can be reached.
    pub span: Span,
    /// Distance from articulator to target, metres.
    pub residual: f64,
}

impl Limb {
    /// A limb from its rest pose: where the hinge is and which way it turns, in the limb frame.
    ///
    /// # Errors
    /// Numbers that are not finite, an axis without length, a hinge on the line of its own axis through the root.
    pub fn new(hinge_at_rest: DVec3, axis: DVec3, carrier: Carrier) -> Result<Limb, Degenerate> {
        let carrier_is_finite = match carrier {
            Carrier::Swing { base } => base.is_finite() && base.is_normalized(),
            Carrier::Spherical => true,
        };
        if !usable(hinge_at_rest) || !usable(axis) || !carrier_is_finite {
            return Err(Degenerate::NotFinite);
        }
        let axis = axis.try_normalize().ok_or(Degenerate::NoAxis)?;
        let side = hinge_at_rest.dot(axis);
        let across = hinge_at_rest - axis * side;
        let upper = across.length();
        if upper <= 1e-12 {
            return Err(Degenerate::NoUpper);
        }
        let to_y = arc(across / upper, DVec3::Y);
        let swung = to_y * axis;
        let (sine, cosine) = half_turn(swung.z, swung.x);
        let about_y = DQuat::from_xyzw(0.0, sine, 0.0, cosine);
        let base_from_y = match carrier {
            Carrier::Swing { base } => arc(DVec3::Y, base),
            Carrier::Spherical => DQuat::IDENTITY,
        };
        Ok(Limb { hinge_at_rest, axis, carrier, base_from_y, rest: about_y * to_y, side, upper })
    }

    /// The textbook limb: upper segment along +y, hinge axis +x.
    ///
    /// # Errors
    /// As [`Limb::new`].
    pub fn straight(upper: f64, carrier: Carrier) -> Result<Limb, Degenerate> {
        Limb::new(DVec3::Y * upper, DVec3::X, carrier)
    }

    /// The articulator in the limb frame, given where it is in the hinge's frame (limb axes at rest).
    pub fn articulator(&self, state: &LimbState, in_hinge: DVec3) -> DVec3 {
        state.root * (self.hinge_at_rest + axis_angle(self.axis, state.hinge) * in_hinge)
    }

    /// How the articulator goes as the hinge bends, metres a radian, limb frame.
    pub(crate) fn along_hinge(&self, state: &LimbState, in_hinge: DVec3) -> DVec3 {
        state.root * self.axis.cross(axis_angle(self.axis, state.hinge) * in_hinge)
    }

    /// The half turn of the hinge that is a branch, with the whole turns of an angle, and as much more as holds that.
    pub(crate) fn on_branch(&self, in_hinge: DVec3, branch: Branch, angle: f64) -> Interval {
        let local = self.local(in_hinge);
        let middle = 0.5 * PI * branch.sign() - local.z.atan2(local.y);
        let middle = middle + TAU * ((angle - middle) / TAU).round();
        Interval::new(middle - 0.5 * PI, middle + 0.5 * PI).reaching(angle)
    }

    /// Where the hinge is in the limb frame.
    pub fn hinge(&self, state: &LimbState) -> DVec3 {
        state.root * self.hinge_at_rest
    }

    /// The nearest and the farthest distance from the root at which the hinge can hold that articulator.
    pub fn reach(&self, in_hinge: DVec3) -> (f64, f64) {
        let local = self.local(in_hinge);
        let (rho, across) = (length(local.y, local.z), self.side + local.x);
        (length(self.upper - rho, across), length(self.upper + rho, across))
    }

    /// As [`Limb::reach`] with the hinge held in an interval, radians.
    pub fn reach_in(&self, in_hinge: DVec3, hinge: Interval) -> (f64, f64) {
        let (near, far) = self.reach(in_hinge);
        let local = self.local(in_hinge);
        // The distance grows and shrinks with cos(g + psi): it is greatest at g = -psi, least half a turn from there.
        let straight = -local.z.atan2(local.y);
        let at = |angle: f64| self.bent(in_hinge, angle).length();
        let (low, high) = (at(hinge.min), at(hinge.max));
        let passes = |angle: f64| angle + TAU * ((hinge.min - angle) / TAU).ceil() <= hinge.max;
        let whole = !(hinge.min.is_finite() && hinge.max.is_finite());
        let near = if whole || passes(straight + PI) { near } else { low.min(high) };
        let far = if whole || passes(straight) { far } else { low.max(high) };
        (near, far)
    }

    /// The hinge angle in (-pi, pi] that puts the articulator at a distance from the root.
    ///
    /// Half-angle form, accurate to the square root of the rounding at full stretch and full fold.
    ///
    /// # Errors
    /// An articulator on the hinge axis; numbers that are not finite.
    pub fn hinge_for(
        &self,
        in_hinge: DVec3,
        distance: f64,
        branch: Branch,
    ) -> Result<HingeSolution, Degenerate> {
        let ([sine, cosine], span) = self.hinge_turn(in_hinge, distance, branch)?;
        Ok(HingeSolution { angle: hinge_angle(sine, cosine), span })
    }

    /// Sine and cosine, times some length, of the angle that [`Limb::hinge_for`] gives.
    fn hinge_turn(
        &self,
        in_hinge: DVec3,
        distance: f64,
        branch: Branch,
    ) -> Result<([f64; 2], Span), Degenerate> {
        if !usable(in_hinge) || !distance.is_finite() {
            return Err(Degenerate::NotFinite);
        }
        let local = self.local(in_hinge);
        let rho = length(local.y, local.z);
        if rho <= 1e-12 {
            return Err(Degenerate::ArticulatorOnHinge);
        }
        // Distance across the hinge axis, squared; negative when the target is nearer than the shift along it.
        let across = self.side + local.x;
        let planar = ((distance - across) * (distance + across)).max(0.0).sqrt();
        let to_far = (self.upper + rho - planar) * (self.upper + rho + planar);
        let to_near = (planar - (self.upper - rho)) * (planar + (self.upper - rho));
        let span = if to_far < 0.0 {
            Span::TooFar
        } else if to_near < 0.0 || distance < across.abs() {
            Span::TooNear
        } else {
            Span::Reached
        };
        // (near + i far)^2 has the angle g + psi, (y + i z) has psi: one arc tangent of the quotient.
        let (far, near) = (to_far.max(0.0), to_near.max(0.0));
        let (sine, cosine) = (branch.sign() * 2.0 * (far.sqrt() * near.sqrt()), near - far);
        Ok(([sine * local.y - cosine * local.z, cosine * local.y + sine * local.z], span))
    }

    /// The root rotation that points the articulator along a unit direction with the hinge at an angle.
    pub fn root_for(&self, in_hinge: DVec3, hinge: f64, direction: DVec3, elevation: f64) -> DQuat {
        root(self.frame_of(self.bent(in_hinge, hinge), direction), elevation)
    }

    /// Root rotation = first * turn about y by the elevation * second, for an articulator that
    /// [`Limb::bent`] gives.
    pub(crate) fn frame_of(&self, bent: DVec3, direction: DVec3) -> [DQuat; 2] {
        let (sine, cosine) = half_turn(-bent.z, bent.y);
        let phi = DQuat::from_xyzw(sine, 0.0, 0.0, cosine);
        let (sine, cosine) = half_turn(bent.x, length(bent.y, bent.z));
        let theta = DQuat::from_xyzw(0.0, 0.0, sine, cosine);
        let carrier = match self.carrier {
            Carrier::Swing { base } => arc(base, direction) * self.base_from_y,
            spherical => spherical.rotation(direction),
        };
        [carrier, theta * phi * self.rest]
    }

    /// Brings the articulator to the target; joint ranges are not looked at.
    ///
    /// Out of reach the limb points at the target, stretched or folded.
    ///
    /// # Errors
    /// Every case that has no answer, by name.
    #[inline]
    pub fn solve(&self, in_hinge: DVec3, goal: &LimbGoal) -> Result<LimbSolution, Degenerate> {
        let (direction, distance) = direction(goal)?;
        let ([sine, cosine], span) = self.hinge_turn(in_hinge, distance, goal.branch)?;
        // What the root does needs the hinge's turn, and doesn't wait for its angle.
        let long = length(sine, cosine);
        let turn = if long > 0.0 { (sine / long, cosine / long) } else { (0.0, 1.0) };
        let bent = self.turned(in_hinge, turn);
        let root = root(self.frame_of(bent, direction), goal.elevation);
        let state = LimbState { root, hinge: hinge_angle(sine, cosine) };
        let residual = self.placed(root, bent).distance(goal.target);
        Ok(LimbSolution { state, span, residual })
    }

    /// Reads the inverse parameters off the joints: `solve(recover(state))` is the same state.
    ///
    /// # Errors
    /// An articulator at the root joint; numbers that are not finite.
    pub fn recover(&self, in_hinge: DVec3, state: &LimbState) -> Result<LimbGoal, Degenerate> {
        if !usable(in_hinge) || !state.hinge.is_finite() {
            return Err(Degenerate::NotFinite);
        }
        let articulator = self.placed(state.root, self.bent(in_hinge, state.hinge));
        self.read(state.root, articulator).map(|(goal, _)| goal)
    }

    /// As [`Limb::recover`] for an articulator whose place is known: `articulator` in the limb frame, metres.
    /// With what [`Limb::frame_of`] gives on the way.
    pub(crate) fn read(&self, root: DQuat, articulator: DVec3) -> Result<(LimbGoal, [DQuat; 2]), Degenerate> {
        if !usable(articulator) || !root.is_finite() {
            return Err(Degenerate::NotFinite);
        }
        let distance = articulator.length();
        if distance <= 1e-12 {
            return Err(Degenerate::ArticulatorAtRoot);
        }
        let bent = self.rest * (root.conjugate() * articulator);
        let [carrier, inner] = self.frame_of(bent, articulator / distance);
        let about_y = carrier.conjugate() * root * inner.conjugate();
        let elevation = wrapped(2.0 * arc_tangent(about_y.y, about_y.w));
        let (along, beside) = (bent.y - self.upper, bent.z);
        let branch = branch(beside / length(along, beside));
        Ok((LimbGoal { target: articulator, elevation, branch }, [carrier, inner]))
    }

    /// The branch on which a hinge angle lies; a limb that is straight to its articulator, give or take
    /// the rounding, is on the usual one.
    pub fn branch(&self, in_hinge: DVec3, hinge: f64) -> Branch {
        branch(self.bend_sine(in_hinge, hinge))
    }

    /// sin(g + psi): 0 where the limb is straight or folded to its articulator and angles are loose.
    pub fn bend_sine(&self, in_hinge: DVec3, hinge: f64) -> f64 {
        self.sine(in_hinge, sin_cos(hinge))
    }

    fn sine(&self, in_hinge: DVec3, (sine, cosine): (f64, f64)) -> f64 {
        let local = self.local(in_hinge);
        (sine * local.y + cosine * local.z) / length(local.y, local.z)
    }

    /// The articulator in the upper segment's frame with the hinge at an angle, upper along +y.
    pub(crate) fn bent(&self, in_hinge: DVec3, hinge: f64) -> DVec3 {
        self.turned(in_hinge, sin_cos(hinge))
    }

    /// As [`Limb::bent`], given the sine and cosine of the hinge's angle.
    fn turned(&self, in_hinge: DVec3, (sine, cosine): (f64, f64)) -> DVec3 {
        let DVec3 { x, y, z } = self.local(in_hinge);
        DVec3::new(self.side + x, self.upper + cosine * y - sine * z, sine * y + cosine * z)
    }

    /// A point that [`Limb::bent`] gives, in the limb frame with the root at a rotation.
    pub(crate) fn placed(&self, root: DQuat, bent: DVec3) -> DVec3 {
        root * (self.rest.conjugate() * bent)
    }

    fn local(&self, in_hinge: DVec3) -> DVec3 {
        self.rest * in_hinge
    }
}

/// The angle of a hinge's turn in (-pi, pi].
fn hinge_angle(sine: f64, cosine: f64) -> f64 {
    let angle = arc_tangent(sine, cosine);
    if angle <= -PI { PI } else { angle }
}

/// The root's rotation from what [`Limb::frame_of`] gives and the elevation.
pub(crate) fn root([carrier, inner]: [DQuat; 2], elevation: f64) -> DQuat {
    (carrier * axis_angle(DVec3::Y, elevation) * inner).normalize()
}

fn branch(bend_sine: f64) -> Branch {
    if bend_sine < -1e-8 { Branch::Minus } else { Branch::Plus }
}

/// The length of a vector whose squares are known to stay in range.
fn length(a: f64, b: f64) -> f64 {
    (a * a + b * b).sqrt()
}

/// Direction and distance of a goal's target.
pub(crate) fn direction(goal: &LimbGoal) -> Result<(DVec3, f64), Degenerate> {
    if !usable(goal.target) || !goal.elevation.is_finite() {
        return Err(Degenerate::NotFinite);
    }
    let distance = goal.target.length();
    if distance <= 1e-12 {
        return Err(Degenerate::TargetAtRoot);
    }
    Ok((goal.target / distance, distance))
}

/// Whether squares of the numbers stay finite; no length of a body comes near the bound.
pub(crate) fn usable(v: DVec3) -> bool {
    v.is_finite() && v.abs().max_element() < 1e100
}

/// The same angle in (-pi, pi].
pub fn wrapped(angle: f64) -> f64 {
    if -PI < angle && angle <= PI {
        return angle;
    }
    let turned = angle - TAU * (angle / TAU).round();
    if turned <= -PI { turned + TAU } else { turned }
}
