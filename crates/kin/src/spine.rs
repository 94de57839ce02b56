//! A column of ball joints that shares one bend evenly: the spine, or neck and head.
//!
//! The cumulative turn of segment `i` of `N` is `Swing(i/N v) * Twist(i/N tau)`: each segment bends by the
//! same angle in one plane and turns by the same angle about the column's own line. Multiplying equal local
//! turns joint by joint would miss the aim by degrees.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec2, DVec3};

use crate::aim::{AIM_TOLERANCE_RAD, AimError, Aimed, Sight, aim, best_of, is_turn};
use crate::ball::{rotation_vector, swing_twist};
use crate::carrier::arc;
use crate::limb::usable;

/// A column of `N` ball joints at rest: any segments, any curvature.
///
/// The base frame has its origin at the first joint and the axes of what carries it; at rest every joint
/// has those axes.
///
/// ```
/// use glam::DVec3;
/// use kin::{Column, ColumnState};
/// let spine = Column::new([DVec3::Y * 0.15; 3])?;
/// let aim = DVec3::new(0.0, 1.0, 0.4);
/// let bent = spine.solve(&ColumnState::REST, aim, 0.3)?;
/// assert!(bent.reached());
/// let top = spine.top(&spine.pose(&bent.state));
/// assert!(top.angle_between(aim) < 1e-7);
/// # Ok::<(), kin::AimError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Column<const N: usize> {
    segments: [DVec3; N],
    /// Unit axis of the twist.
    axis: DVec3,
}

/// The even bend of a whole column.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Bend {
    /// Rotation vector of the last segment's swing, perpendicular to the twist axis; at most pi long.
    pub swing: DVec3,
    /// Turn of the last segment about the column's line, radians.
    pub twist: f64,
}

/// A column's pose as an even bend and what no even bend can express.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ColumnState<const N: usize> {
    /// The bend.
    pub bend: Bend,
    /// By joint: what turns the segment of the even bend to the actual one, innermost. The last one is
    /// the identity to rounding, since the bend is read off the last segment.
    pub residues: [DQuat; N],
}

impl<const N: usize> ColumnState<N> {
    /// Unbent.
    pub const REST: ColumnState<N> =
        ColumnState { bend: Bend { swing: DVec3::ZERO, twist: 0.0 }, residues: [DQuat::IDENTITY; N] };
}

/// A solved column.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ColumnSolution<const N: usize> {
    /// The new bend with the old residues.
    pub state: ColumnState<N>,
    /// Angle between the chord and its aim, radians.
    pub residual_rad: f64,
    /// Newton steps taken: 0 where the closed form is exact.
    pub steps: u32,
}

impl<const N: usize> ColumnSolution<N> {
    /// Whether the chord meets its aim to [`AIM_TOLERANCE_RAD`].
    pub fn reached(&self) -> bool {
        self.residual_rad <= AIM_TOLERANCE_RAD
    }
}

impl<const N: usize> Column<N> {
    /// A column from its rest segments in metres: from each joint to the next, from the last to the top.
    ///
    /// The twist axis is the rest chord's direction.
    ///
    /// # Errors
    /// Numbers that are not finite; a rest chord without length.
    pub fn new(segments: [DVec3; N]) -> Result<Column<N>, AimError> {
        let chord = segments.iter().sum();
        let column = Column::about(segments, chord)?;
        column.direction(chord).map(|_| column).ok_or(AimError::NoLine)
    }

    /// A column whose twist axis is not its rest chord; the chord may have no length.
    ///
    /// # Errors
    /// Numbers that are not finite; an axis without length.
    pub fn about(segments: [DVec3; N], axis: DVec3) -> Result<Column<N>, AimError> {
        if !usable(axis) || !segments.iter().all(|s| usable(*s)) {
            return Err(AimError::NotFinite);
        }
        let axis = axis.try_normalize().ok_or(AimError::NoLine)?;
        Ok(Column { segments, axis })
    }

    /// Unit axis of the twist, base frame.
    pub fn axis(&self) -> DVec3 {
        self.axis
    }

    /// The top in the base frame, metres, given the joints' local turns.
    pub fn top(&self, locals: &[DQuat; N]) -> DVec3 {
        let mut turn = DQuat::IDENTITY;
        let mut top = DVec3::ZERO;
        for (local, segment) in locals.iter().zip(self.segments) {
            turn *= *local;
            top += turn * segment;
        }
        top
    }

    /// The cumulative turns of the segments under an even bend.
    pub fn even(&self, bend: Bend) -> [DQuat; N] {
        std::array::from_fn(|i| {
            let share = (i + 1) as f64 / N as f64;
            DQuat::from_scaled_axis(bend.swing * share)
                * DQuat::from_axis_angle(self.axis, bend.twist * share)
        })
    }

    /// The even bend whose last segment has that turn.
    pub fn bend_of(&self, turn: DQuat) -> Bend {
        let (swing, twist) = swing_twist(turn, self.axis);
        Bend { swing: rotation_vector(swing), twist }
    }

    /// The joints' local turns.
    pub fn pose(&self, state: &ColumnState<N>) -> [DQuat; N] {
        let even = self.even(state.bend);
        let mut carrier = DQuat::IDENTITY;
        std::array::from_fn(|i| {
            let turn = even[i] * state.residues[i];
            let local = (carrier.conjugate() * turn).normalize();
            carrier = turn;
            local
        })
    }

    /// Reads bend and residues off the joints: `pose(recover(locals))` is `locals`, and
    /// `recover(pose(state))` is `state` while its swing is below pi and its twist in (-pi, pi].
    ///
    /// Turns need not be exactly of unit length.
    ///
    /// # Errors
    /// Turns that are not finite or have no length.
    pub fn recover(&self, locals: &[DQuat; N]) -> Result<ColumnState<N>, AimError> {
        self.recover_as(locals, |turn| self.bend_of(turn))
    }

    /// [`Column::recover`] with a bend of the caller's choice for the last segment's turn.
    pub(crate) fn recover_as(
        &self,
        locals: &[DQuat; N],
        bend_of: impl Fn(DQuat) -> Bend,
    ) -> Result<ColumnState<N>, AimError> {
        let mut turn = DQuat::IDENTITY;
        let mut turns = [DQuat::IDENTITY; N];
        for (out, local) in turns.iter_mut().zip(locals) {
            // Also refuses lengths whose square overflows or vanishes.
            let unit = local.normalize();
            if !is_turn(unit) {
                return Err(AimError::NotFinite);
            }
            turn *= unit;
            *out = turn;
        }
        let bend = bend_of(turn);
        let even = self.even(bend);
        Ok(ColumnState { bend, residues: std::array::from_fn(|i| even[i].conjugate() * turns[i]) })
    }

    /// Bends the column so that its chord, first joint to top, points along an aim; the twist is given, the
    /// residues stay.
    ///
    /// An aim along which the chord points already changes nothing. The swing is at most pi, which lets
    /// the chord of three equal segments lean by 120 degrees from rest; beyond, the nearest lean on that rim
    /// is taken and the angle that is missing reported. An aim opposite to the rest chord is leant
    /// toward in the plane of the present bend. Equal straight segments need no iteration: the swing is
    /// 2N/(N+1) times the chord's angle. Otherwise that is where damped Newton steps start, shifted by
    /// what the present bend differs from it; at most [`AIM_STEPS`](crate::AIM_STEPS) of them.
    ///
    /// # Errors
    /// An aim without direction, a chord without length at the present bend, numbers that are not finite.
    pub fn solve(
        &self,
        present: &ColumnState<N>,
        toward: DVec3,
        twist: f64,
    ) -> Result<ColumnSolution<N>, AimError> {
        let numbers = usable(toward) && usable(present.bend.swing) && twist.is_finite();
        if !numbers || !present.residues.iter().all(|r| is_turn(*r)) {
            return Err(AimError::NotFinite);
        }
        let goal = toward.try_normalize().ok_or(AimError::NoAim)?;
        let basis = self.basis();
        let swing_of = |at: DVec2| basis[0] * at.x + basis[1] * at.y;
        let sight = |at: DVec2| {
            let along = self.chord(Bend { swing: swing_of(at), twist }, &present.residues)?;
            Some(Sight { along, goal })
        };
        let at = DVec2::new(present.bend.swing.dot(basis[0]), present.bend.swing.dot(basis[1]));
        let now = sight(at).ok_or(AimError::NoLine)?;
        let lent = if now.off() > AIM_TOLERANCE_RAD {
            self.lean(goal, at) - self.lean(now.along, at)
        } else {
            DVec2::ZERO
        };
        let hold = |at: DVec2| at.clamp_length_max(PI);
        let from = |start: DVec2| Some(along_rim(aim(hold(start), hold, sight)?, sight));
        let found = best_of([at + lent, self.lean(goal, at), at], from).ok_or(AimError::NoLine)?;
        let bend = Bend { swing: swing_of(found.at), twist };
        let state = ColumnState { bend, residues: present.residues };
        Ok(ColumnSolution { state, residual_rad: found.off, steps: found.steps })
    }

    /// Two axes of the swing, perpendicular to the twist's.
    fn basis(&self) -> [DVec3; 2] {
        let (a, b) = self.axis.any_orthonormal_pair();
        [a, b]
    }

    /// The chord's direction under a bend; `None` where it has no length.
    fn chord(&self, bend: Bend, residues: &[DQuat; N]) -> Option<DVec3> {
        let even = self.even(bend);
        let top = (0..N).map(|i| even[i] * (residues[i] * self.segments[i])).sum();
        self.direction(top)
    }

    /// Direction of a chord that is not vanishingly short beside the segments.
    fn direction(&self, top: DVec3) -> Option<DVec3> {
        let total: f64 = self.segments.iter().map(|s| s.length()).sum();
        top.try_normalize().filter(|_| top.length() > 1e-9 * total)
    }

    /// The swing that would lean the chord of an equal straight column from rest to a direction, in the basis.
    ///
    /// Opposite to rest it leans the way of `present`.
    fn lean(&self, to: DVec3, present: DVec2) -> DVec2 {
        let basis = self.basis();
        let from = self.segments.iter().sum::<DVec3>().normalize_or(self.axis);
        let share = 2.0 * N as f64 / (N as f64 + 1.0);
        if from.dot(to) < 0.0 && from.cross(to).length() < 1e-12 {
            return present.try_normalize().unwrap_or(DVec2::X) * (share * PI);
        }
        let turn = rotation_vector(arc(from, to)) * share;
        DVec2::new(turn.dot(basis[0]), turn.dot(basis[1]))
    }
}

/// Slides a bend at its rim to the place nearest to the goal; one that reaches, or is not at the rim, stays.
///
/// Newton steps that are pushed back to the rim creep along it, so a look around it and a golden section
/// search do the rest.
fn along_rim(found: Aimed, sight: impl Fn(DVec2) -> Option<Sight>) -> Aimed {
    const GOLDEN: f64 = 0.618_033_988_749_895;
    const LOOKS: u32 = 48;
    if found.off <= AIM_TOLERANCE_RAD || found.at.length() < PI - 1e-9 {
        return found;
    }
    let place = |way: f64| DVec2::from_angle(way) * PI;
    let off = |way: f64| sight(place(way)).map_or(f64::INFINITY, |s| s.off());
    let look = TAU / f64::from(LOOKS);
    let ways = (0..LOOKS).map(|i| found.at.to_angle() + look * f64::from(i));
    let Some(way) = ways.min_by(|a, b| off(*a).total_cmp(&off(*b))) else { return found };
    let (mut low, mut high) = (way - look, way + look);
    while high - low > 1e-9 {
        let width = (high - low) * GOLDEN;
        if off(high - width) <= off(low + width) {
            high = low + width;
        } else {
            low = high - width;
        }
    }
    let way = 0.5 * (low + high);
    let best = Aimed { at: place(way), off: off(way), steps: found.steps };
    if best.off < found.off { best } else { found }
}
