//! Which elevations keep a root joint inside its range: arcs of a circle, their ends in closed form.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3};

use crate::ball::twist_about;
use crate::{Cone, Degenerate, Interval, Limb, LimbGoal, swing_twist, wrapped};

/// The range of a root ball joint, in limb axes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct RootRange {
    /// Where the bone may point.
    pub cone: Cone,
    /// The bone's direction at rest, along or against the twist axis.
    pub bone: DVec3,
    /// Axis of positive twist.
    pub twist_axis: DVec3,
    /// The twist, radians.
    pub twist: Interval,
}

impl RootRange {
    /// No limit.
    pub const FREE: RootRange =
        RootRange { cone: Cone::FREE, bone: DVec3::Y, twist_axis: DVec3::Y, twist: Interval::FREE };

    /// Whether a rotation lies inside, give or take some radians.
    pub fn contains(&self, root: DQuat, slack: f64) -> bool {
        let twist = twist_about(root, self.twist_axis);
        self.cone.contains(root * self.bone, slack) && self.twist.excess(twist) <= slack
    }

    /// The smallest range that holds a rotation too.
    pub fn reaching(&self, root: DQuat) -> RootRange {
        let twist = twist_about(root, self.twist_axis);
        RootRange { cone: self.cone.reaching(root * self.bone), twist: self.twist.reaching(twist), ..*self }
    }
}

/// An arc of elevations: from `start` upward by `width`, radians; a whole circle has the width of a full turn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Arc {
    /// Lower end, in (-pi, pi].
    pub start: f64,
    /// 0 to a full turn.
    pub width: f64,
}

impl Arc {
    const CIRCLE: Arc = Arc { start: -PI, width: TAU };

    /// The signed turn from an elevation to the nearest one of the arc; 0 inside.
    fn toward(self, elevation: f64) -> f64 {
        let past = positive(elevation - self.start);
        if past <= self.width || self.width >= TAU {
            return 0.0;
        }
        let (back, on) = (past - self.width, TAU - past);
        if back <= on { -back } else { on }
    }
}

/// The elevations that keep the root in range: none, one or two arcs.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Elevations {
    arcs: [Option<Arc>; 2],
}

impl Elevations {
    /// The arcs.
    pub fn arcs(&self) -> impl Iterator<Item = Arc> + '_ {
        self.arcs.iter().flatten().copied()
    }

    /// The interval around an elevation, unwrapped so that it contains it (within a slack of 1e-7 rad);
    /// `None` if the elevation is not feasible. A whole circle is -pi to pi.
    pub fn around(&self, elevation: f64) -> Option<(f64, f64)> {
        let arc = self.arcs().find(|arc| arc.toward(elevation).abs() <= 1e-7)?;
        if arc.width >= TAU {
            return Some((-PI, PI));
        }
        let past = wrapped(elevation - arc.start - 0.5 * arc.width) + 0.5 * arc.width;
        let start = elevation - past;
        Some((start, start + arc.width))
    }

    /// The signed turn from an elevation to the nearest feasible one; `None` if there is none.
    pub fn nearest(&self, elevation: f64) -> Option<f64> {
        self.arcs().map(|arc| arc.toward(elevation)).min_by(|a, b| a.abs().total_cmp(&b.abs()))
    }
}

impl Limb {
    /// The elevations that keep the root in range with the hinge at an angle and the articulator along a unit direction.
    ///
    /// A cone leaves one arc and a twist interval leaves one arc, so there are at most two.
    pub fn elevations(&self, in_hinge: DVec3, hinge: f64, direction: DVec3, range: &RootRange) -> Elevations {
        feasible(self.frame_of(self.bent(in_hinge, hinge), direction), range)
    }

    /// [`Limb::recover`] and [`Limb::elevations`] in one, for a limb as it is, whose articulator is at a known
    /// place of the limb frame, metres: needs no trigonometry of the joints.
    ///
    /// # Errors
    /// As [`Limb::recover`].
    pub fn read_within(
        &self,
        root: DQuat,
        articulator: DVec3,
        range: &RootRange,
    ) -> Result<(LimbGoal, Elevations), Degenerate> {
        let (goal, frame) = self.read(root, articulator)?;
        Ok((goal, feasible(frame, range)))
    }
}

/// The elevations between the two rotations of [`Limb::frame_of`] that keep the root in range.
pub(crate) fn feasible([carrier, inner]: [DQuat; 2], range: &RootRange) -> Elevations {
    let Some(a) = cone_arc(carrier, inner, range) else { return Elevations::default() };
    let Some(b) = twist_arc(carrier, inner, range) else { return Elevations::default() };
    Elevations { arcs: intersection(a, b) }
}

/// Elevations at which the bone lies in its cone.
fn cone_arc(carrier: DQuat, inner: DQuat, range: &RootRange) -> Option<Arc> {
    let bone = inner * range.bone;
    let axis = carrier.conjugate() * range.cone.axis;
    // bone(delta) . axis = level + radius cos(delta - best)
    let level = bone.y * axis.y;
    let along = bone.x * axis.x + bone.z * axis.z;
    let beside = bone.z * axis.x - bone.x * axis.z;
    let radius = (along * along + beside * beside).sqrt();
    let rim = range.cone.half_angle.cos();
    if range.cone.half_angle >= PI || level - radius >= rim {
        Some(Arc::CIRCLE)
    } else if level + radius < rim {
        None
    } else {
        let half = ((rim - level) / radius).clamp(-1.0, 1.0).acos();
        Some(Arc { start: wrapped(beside.atan2(along) - half), width: 2.0 * half })
    }
}

/// Elevations at which the twist lies in its interval: the twist runs once round as the elevation does.
fn twist_arc(carrier: DQuat, inner: DQuat, range: &RootRange) -> Option<Arc> {
    if range.twist.max - range.twist.min >= TAU {
        return Some(Arc::CIRCLE);
    }
    // Scalar part and part along the axis of carrier * turn(delta) * inner, as a cos(delta/2) + b sin(delta/2).
    let parts = |q: DQuat| (q.w, DVec3::new(q.x, q.y, q.z).dot(range.twist_axis));
    let (w0, p0) = parts(carrier * inner);
    let (w1, p1) = parts(carrier * DQuat::from_xyzw(0.0, 1.0, 0.0, 0.0) * inner);
    let orientation = w0 * p1 - p0 * w1;
    if orientation.abs() < 1e-14 {
        let (_, twist) = swing_twist(carrier * inner, range.twist_axis);
        return range.twist.contains(twist).then_some(Arc::CIRCLE);
    }
    let at = |twist: f64| {
        let (sine, cosine) = (0.5 * twist).sin_cos();
        2.0 * (w0 * sine - p0 * cosine).atan2(p1 * cosine - w1 * sine)
    };
    let (low, high) = (at(range.twist.min), at(range.twist.max));
    let (start, end) = if orientation > 0.0 { (low, high) } else { (high, low) };
    Some(Arc { start: wrapped(start), width: positive(end - start) })
}

/// What two arcs share.
fn intersection(a: Arc, b: Arc) -> [Option<Arc>; 2] {
    if a.width >= TAU {
        return [Some(b), None];
    }
    if b.width >= TAU {
        return [Some(a), None];
    }
    // With a from 0: b covers [offset, offset + b.width] and its copy one turn lower.
    let offset = positive(b.start - a.start);
    let piece = |from: f64, to: f64| {
        let (from, to) = (from.max(0.0), to.min(a.width));
        (to >= from).then(|| Arc { start: wrapped(a.start + from), width: to - from })
    };
    let mut pieces = [piece(offset, offset + b.width), piece(offset - TAU, offset - TAU + b.width)];
    if pieces[0].is_none() {
        pieces.swap(0, 1);
    }
    pieces
}

/// The same angle in [0, 2 pi).
fn positive(angle: f64) -> f64 {
    if (0.0..TAU).contains(&angle) {
        return angle;
    }
    let turned = if (-TAU..0.0).contains(&angle) { angle + TAU } else { angle.rem_euclid(TAU) };
    if turned >= TAU { 0.0 } else { turned }
}
