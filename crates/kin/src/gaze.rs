//! Looking: neck and head share an aim, the eyes take what is left.
//!
//! The head's turn is kept as yaw, pitch and roll in the frame that carries the neck, outermost first: a
//! change of gaze turns about the upright and nods about the head's own side, and never rolls. The neck's
//! joints share the head's turn as an even bend.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DQuat, DVec2, DVec3};

use crate::aim::{AIM_TOLERANCE_RAD, AimError, Sight, aim, best_of, is_turn};
use crate::limb::{usable, wrapped};
use crate::spine::{Bend, Column, ColumnState};

/// How far beyond straight up or down a nod follows a target before the head turns round instead.
const OVER_THE_POLE_RAD: f64 = 0.35;

/// A neck of `N` joints, the last of which is the head's, with an eye point in the head.
///
/// The base frame has its origin at the first joint and the axes of what carries it; at rest every joint
/// has those axes. For a single eye, or the point between both.
///
/// ```
/// use glam::DVec3;
/// use kin::{Gaze, GazeState};
/// let neck_to_head = DVec3::new(0.0, 0.1, 0.02);
/// let eyes_in_head = DVec3::new(0.0, 0.07, 0.08);
/// let gaze = Gaze::new([neck_to_head, eyes_in_head], DVec3::Z, DVec3::Y)?;
/// let target = DVec3::new(0.6, 0.0, 1.0);
/// let looking = gaze.solve(&GazeState::REST, target)?;
/// let (eye, along) = gaze.sight(&gaze.pose(&looking.state));
/// assert!((target - eye).normalize().distance(along) < 1e-12);
/// # Ok::<(), kin::AimError>(())
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Gaze<const N: usize> {
    column: Column<N>,
    /// Unit axes in the base frame: to the figure's left, up, along the gaze at rest.
    left: DVec3,
    up: DVec3,
    forward: DVec3,
}

/// Where a head is turned, and what an even share among its joints can't express.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct GazeState<const N: usize> {
    /// Turn about the base's upright, radians, positive to the figure's left; a little beyond pi for some
    /// targets right behind.
    pub yaw: f64,
    /// Nod about the head's side, radians, positive downward; beyond a right angle past straight up and down.
    pub pitch: f64,
    /// Roll about the line of sight, radians, positive to the figure's right; no gaze changes it.
    pub roll: f64,
    /// As [`ColumnState::residues`].
    pub residues: [DQuat; N],
}

impl<const N: usize> GazeState<N> {
    /// Looking straight ahead.
    pub const REST: GazeState<N> =
        GazeState { yaw: 0.0, pitch: 0.0, roll: 0.0, residues: [DQuat::IDENTITY; N] };
}

/// A solved gaze.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct GazeSolution<const N: usize> {
    /// The new yaw and pitch with the old roll and residues.
    pub state: GazeState<N>,
    /// Angle between the line of sight and the target, radians.
    pub residual_rad: f64,
    /// Newton steps taken.
    pub steps: u32,
}

impl<const N: usize> GazeSolution<N> {
    /// Whether the line of sight meets the target to [`AIM_TOLERANCE_RAD`].
    pub fn reached(&self) -> bool {
        self.residual_rad <= AIM_TOLERANCE_RAD
    }
}

impl<const N: usize> Gaze<N> {
    /// A neck from its rest segments in metres: from each joint to the next, from the last to the eye point.
    ///
    /// `up` is the axis of yaw; `forward` is the gaze at rest, levelled to it.
    ///
    /// # Errors
    /// Numbers that are not finite; axes without length or along each other.
    pub fn new(segments: [DVec3; N], forward: DVec3, up: DVec3) -> Result<Gaze<N>, AimError> {
        if !usable(forward) {
            return Err(AimError::NotFinite);
        }
        let column = Column::about(segments, up)?;
        let up = column.axis();
        let left = up.cross(forward.normalize_or_zero());
        let left = left.try_normalize().filter(|_| left.length() > 1e-6).ok_or(AimError::NoLine)?;
        Ok(Gaze { column, left, up, forward: left.cross(up) })
    }

    /// The joints' local turns.
    pub fn pose(&self, state: &GazeState<N>) -> [DQuat; N] {
        let bend = self.bend(self.head(state.yaw, state.pitch, state.roll), state.yaw);
        self.column.pose(&ColumnState { bend, residues: state.residues })
    }

    /// Eye point in metres and unit line of sight in the base frame, given the joints' local turns.
    pub fn sight(&self, locals: &[DQuat; N]) -> (DVec3, DVec3) {
        let head = locals.iter().fold(DQuat::IDENTITY, |turn, local| turn * *local);
        (self.column.top(locals), head * self.forward)
    }

    /// Reads the state off the joints: `pose(recover(locals))` is `locals`.
    ///
    /// Of the two sets of angles that any turn has, the one with the roll in [-pi/2, pi/2] is taken: the pitch
    /// passes a right angle rather than that the head stands on its crown. Straight up and straight down,
    /// where yaw and roll are the same turn, the split is arbitrary.
    ///
    /// # Errors
    /// Turns that are not finite or have no length.
    pub fn recover(&self, locals: &[DQuat; N]) -> Result<GazeState<N>, AimError> {
        let angles = |head: DQuat| {
            let [yaw, pitch] = self.yaw_pitch(head * self.forward);
            let rolled = self.head(yaw, pitch, 0.0).conjugate() * head;
            let roll = wrapped(2.0 * rolled.xyz().dot(self.forward).atan2(rolled.w));
            if roll.abs() <= FRAC_PI_2 {
                return [yaw, pitch, roll];
            }
            [wrapped(yaw + PI), past_the_pole(pitch), wrapped(roll + PI)]
        };
        let state = self.column.recover_as(locals, |head| self.bend(head, angles(head)[0]))?;
        let [yaw, pitch, roll] = angles(locals.iter().fold(DQuat::IDENTITY, |turn, l| turn * l.normalize()));
        Ok(GazeState { yaw, pitch, roll, residues: state.residues })
    }

    /// Turns the head so that its line of sight, from the eye point, meets a target in the base frame, metres.
    ///
    /// A target that is looked at already changes nothing. The eye point moves as the head turns, so damped
    /// Newton steps follow a closed-form start: at most [`AIM_STEPS`](crate::AIM_STEPS). A target inside the
    /// sphere that the eye point sweeps may have no answer, nor one nearer to the neck's upright than an eye
    /// is off the middle; the nearest found comes with the angle that is missing. Ranges are the caller's:
    /// clamp the joints of [`Gaze::pose`], then let each [`Eye`](crate::Eye) take the rest.
    ///
    /// Straight up and down the yaw is free: a target that passes overhead within 20 degrees of the pole is
    /// followed over it by a nod, one beyond by turning round.
    ///
    /// # Errors
    /// A target at the eye point, numbers that are not finite.
    pub fn solve(&self, present: &GazeState<N>, target: DVec3) -> Result<GazeSolution<N>, AimError> {
        let angles = DVec3::new(present.yaw, present.pitch, present.roll);
        if !usable(target) || !usable(angles) || !present.residues.iter().all(|r| is_turn(*r)) {
            return Err(AimError::NotFinite);
        }
        let sight = |at: DVec2| {
            let (eye, along) = self.sight(&self.pose(&GazeState { yaw: at.x, pitch: at.y, ..*present }));
            Some(Sight { along, goal: direction(target - eye)? })
        };
        let now = DVec2::new(present.yaw, present.pitch);
        let seen = sight(now).ok_or(AimError::NoAim)?;
        let furthest = present.pitch.abs().max(1.5 * FRAC_PI_2);
        let hold = |at: DVec2| DVec2::new(at.x, at.y.clamp(-furthest, furthest));
        let starts = if seen.off() > AIM_TOLERANCE_RAD {
            let first = self.toward(seen.goal, present.yaw);
            let second = sight(first).map_or(now, |s| self.toward(s.goal, first.x));
            // The same line of sight from the other side of the pole.
            [first, second, DVec2::new(second.x + PI, past_the_pole(second.y))]
        } else {
            [now; 3]
        };
        let found = best_of(starts, |start| aim(hold(start), hold, sight)).ok_or(AimError::NoAim)?;
        let state = GazeState { yaw: found.at.x, pitch: found.at.y, ..*present };
        Ok(GazeSolution { state, residual_rad: found.off, steps: found.steps })
    }

    /// The head's whole turn.
    fn head(&self, yaw: f64, pitch: f64, roll: f64) -> DQuat {
        DQuat::from_axis_angle(self.up, yaw)
            * DQuat::from_axis_angle(self.left, pitch)
            * DQuat::from_axis_angle(self.forward, roll)
    }

    /// The even bend of that turn, its twist the one nearest to the yaw, so that it does not flip behind.
    fn bend(&self, head: DQuat, yaw: f64) -> Bend {
        let bend = self.column.bend_of(head);
        Bend { twist: yaw + wrapped(bend.twist - yaw), ..bend }
    }

    /// Yaw and pitch of a line of sight, the yaw near the present one.
    fn toward(&self, along: DVec3, present_yaw: f64) -> DVec2 {
        let [yaw, pitch] = self.yaw_pitch(along);
        let (turn, over) = (wrapped(yaw - present_yaw), past_the_pole(pitch));
        if turn.abs() > FRAC_PI_2 && over.abs() < FRAC_PI_2 + OVER_THE_POLE_RAD {
            return DVec2::new(present_yaw + wrapped(turn + PI), over);
        }
        DVec2::new(present_yaw + turn, pitch)
    }

    /// Yaw and pitch of a line of sight.
    fn yaw_pitch(&self, along: DVec3) -> [f64; 2] {
        let (left, up, ahead) = (along.dot(self.left), along.dot(self.up), along.dot(self.forward));
        [left.atan2(ahead), (-up).atan2(left.hypot(ahead))]
    }
}

/// The pitch of the same line of sight for a head that faces the other way.
fn past_the_pole(pitch: f64) -> f64 {
    PI.copysign(pitch) - pitch
}

/// Unit direction to a point; `None` for one that is too near to have any.
fn direction(to: DVec3) -> Option<DVec3> {
    to.try_normalize().filter(|_| to.length() > 1e-9)
}
