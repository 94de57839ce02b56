//! Reaching with joint ranges: the nearest feasible elevation, else joints that stop at their ranges.

use std::cell::OnceCell;
use std::f64::consts::TAU;

use glam::DVec3;

use crate::elevation::feasible;
use crate::limb::{direction, root};
use crate::{Degenerate, Interval, Limb, LimbGoal, LimbState, RootRange, Span};

/// The ranges of a limb's own joints.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LimbRanges {
    /// The root's swing and twist.
    pub root: RootRange,
    /// The hinge, radians.
    pub hinge: Interval,
}

impl LimbRanges {
    /// No limits.
    pub const FREE: LimbRanges = LimbRanges { root: RootRange::FREE, hinge: Interval::FREE };

    /// The smallest ranges that hold a state too: joints that start outside may stay or move inward.
    pub fn reaching(&self, state: &LimbState) -> LimbRanges {
        LimbRanges { root: self.root.reaching(state.root), hinge: self.hinge.reaching(state.hinge) }
    }

    /// Whether a state lies inside, give or take some radians.
    pub fn contains(&self, state: &LimbState, slack: f64) -> bool {
        self.hinge.excess(state.hinge) <= slack && self.root.contains(state.root, slack)
    }
}

/// How a limb went to its target.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Reach {
    /// The joints.
    pub state: LimbState,
    /// Whether the hinge could span the distance, ranges aside.
    pub span: Span,
    /// Distance from articulator to target, metres.
    pub residual: f64,
    /// Whether a range changed the answer: another elevation, or a joint stopped.
    pub limited: bool,
}

impl Limb {
    /// Brings the articulator to the target inside the ranges, with a change of elevation of at most `window` radians.
    ///
    /// The branch is kept. If the hinge's angle is out of range it stops there. The elevation is the
    /// feasible one nearest to the goal's. Where none lies within the window, the articulator goes to the
    /// place nearest to the target that the joints can hold: within 5 mm of the best that a dense search
    /// of the window finds, with a change of elevation that is worth up to 3 mm. Small moves of the target
    /// make small moves of the joints, but where two places far apart are equally near: between them the limb
    /// has to jump. `from` is the state at which the gesture began: ranges stretch to hold it.
    ///
    /// # Errors
    /// As [`Limb::solve`].
    pub fn reach_within(
        &self,
        in_hinge: DVec3,
        goal: &LimbGoal,
        from: &LimbState,
        ranges: &LimbRanges,
        window: f64,
    ) -> Result<Reach, Degenerate> {
        let quest = Quest::new(self, in_hinge, goal, from, ranges, window);
        let direct = quest.aimed(goal.target)?;
        let (state, limited) = match quest.held(&direct) {
            Some((state, turn)) => (state, turn != 0.0 || direct.stopped),
            None => (quest.nearest().unwrap_or(*from), true),
        };
        let residual = self.articulator(&state, in_hinge).distance(goal.target);
        Ok(Reach { state, span: direct.span, residual, limited })
    }

    /// As [`Limb::reach_within`], but `None` where no elevation in the window is feasible: nothing is searched.
    ///
    /// # Errors
    /// As [`Limb::solve`].
    pub fn hold_within(
        &self,
        in_hinge: DVec3,
        goal: &LimbGoal,
        from: &LimbState,
        ranges: &LimbRanges,
        window: f64,
    ) -> Result<Option<LimbState>, Degenerate> {
        let quest = Quest::new(self, in_hinge, goal, from, ranges, window);
        let direct = quest.aimed(goal.target)?;
        Ok(quest.held(&direct).map(|(state, _)| state))
    }
}

/// One reach: what is asked and what is allowed.
pub(crate) struct Quest<'a> {
    pub limb: &'a Limb,
    pub in_hinge: DVec3,
    pub goal: &'a LimbGoal,
    pub from: &'a LimbState,
    pub ranges: LimbRanges,
    pub window: f64,
    stops: OnceCell<[Stop; 2]>,
}

/// An end of the hinge's range, radians.
struct Stop {
    end: f64,
    /// At which it holds the articulator, metres.
    distance: f64,
    /// Whether it lies on the branch that the goal keeps.
    kept: bool,
}

/// A limb bent for a place; the elevation is still open, and no matter where the articulator goes.
pub(crate) struct Aimed {
    pub direction: DVec3,
    hinge: f64,
    /// The articulator in the upper segment's frame.
    pub bent: DVec3,
    span: Span,
    /// Whether the hinge stopped at its range.
    stopped: bool,
}

impl<'a> Quest<'a> {
    fn new(
        limb: &'a Limb,
        in_hinge: DVec3,
        goal: &'a LimbGoal,
        from: &'a LimbState,
        ranges: &LimbRanges,
        window: f64,
    ) -> Quest<'a> {
        let ranges = ranges.reaching(from);
        Quest { limb, in_hinge, goal, from, ranges, window, stops: OnceCell::new() }
    }

    /// The limb bent so that its articulator is at a place's distance, or as near to it as the hinge goes.
    pub fn aimed(&self, place: DVec3) -> Result<Aimed, Degenerate> {
        let (direction, distance) = direction(&LimbGoal { target: place, ..*self.goal })?;
        let free = self.limb.hinge_for(self.in_hinge, distance, self.goal.branch)?;
        let angle = unwound(free.angle, self.from.hinge, self.ranges.hinge);
        let hinge = self.stopped(angle, distance);
        let bent = self.limb.bent(self.in_hinge, hinge);
        Ok(Aimed { direction, hinge, bent, span: free.span, stopped: hinge != angle })
    }

    /// The hinge angle, or the end of its range whose distance comes nearer: one on the kept branch if there is one.
    fn stopped(&self, angle: f64, distance: f64) -> f64 {
        let range = self.ranges.hinge;
        if range.contains(angle) {
            return angle;
        }
        let stops = self.stops.get_or_init(|| {
            [range.min, range.max].map(|end| Stop {
                end,
                distance: self.limb.bent(self.in_hinge, end).length(),
                kept: end.is_finite() && self.limb.branch(self.in_hinge, end) == self.goal.branch,
            })
        });
        let any = stops.iter().any(|stop| stop.kept);
        let miss = |stop: &Stop| (stop.distance - distance).abs();
        let ends = stops.iter().filter(|stop| stop.kept || (!any && stop.end.is_finite()));
        ends.min_by(|a, b| miss(a).total_cmp(&miss(b))).map_or(angle, |stop| stop.end)
    }

    /// The joints at the feasible elevation nearest to the goal's, and how far that is from it; `None` if
    /// none lies in the window.
    pub fn held(&self, aimed: &Aimed) -> Option<(LimbState, f64)> {
        let frame = self.limb.frame_of(aimed.bent, aimed.direction);
        let elevations = feasible(frame, &self.ranges.root);
        let turn = elevations.nearest(self.goal.elevation).filter(|turn| turn.abs() <= self.window)?;
        Some((LimbState { root: root(frame, self.goal.elevation + turn), hinge: aimed.hinge }, turn))
    }
}

/// The angle plus whole turns: inside the range if possible, else nearest to it, then nearest to `near`.
fn unwound(angle: f64, near: f64, range: Interval) -> f64 {
    let base = angle + TAU * ((near - angle) / TAU).round();
    let better = |a: &f64, b: &f64| {
        range.excess(*a).total_cmp(&range.excess(*b)).then((a - near).abs().total_cmp(&(b - near).abs()))
    };
    [base, base - TAU, base + TAU].into_iter().min_by(better).unwrap_or(base)
}

/// Eases a distance near full stretch, so that the hinge slows down instead of snapping straight.
///
/// Below `full - softness` the distance is kept; beyond, it approaches `full` and never gets there.
/// Continuous with its first derivative. Softness is in metres; 0 keeps every distance.
pub fn softened(distance: f64, full: f64, softness: f64) -> f64 {
    let knee = full - softness;
    if softness <= 0.0 || distance <= knee {
        return distance;
    }
    full - softness * (-(distance - knee) / softness).exp()
}
