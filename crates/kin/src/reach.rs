//! Reaching with joint ranges: the nearest feasible elevation, else joints that stop at their ranges.

use std::f64::consts::TAU;

use glam::{DQuat, DVec3};

use crate::limb::direction;
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
    /// of the window finds. `from` is the state at which the gesture began: ranges stretch to hold it.
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
        direction(goal)?;
        let quest = Quest { limb: self, in_hinge, goal, from, ranges: ranges.reaching(from), window };
        let direct = quest.held(goal.target)?;
        let found = match direct.state {
            Some(state) => state,
            None => quest.nearest().unwrap_or(*from),
        };
        let residual = self.articulator(&found, in_hinge).distance(goal.target);
        Ok(Reach { state: found, span: direct.span, residual, limited: direct.limited })
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
        let quest = Quest { limb: self, in_hinge, goal, from, ranges: ranges.reaching(from), window };
        Ok(quest.held(goal.target)?.state)
    }

    /// The hinge angle, or the end of its range whose distance comes nearer.
    fn stopped(&self, in_hinge: DVec3, angle: f64, distance: f64, range: Interval) -> f64 {
        if range.contains(angle) {
            return angle;
        }
        let miss = |hinge: f64| {
            let state = LimbState { root: DQuat::IDENTITY, hinge };
            (self.articulator(&state, in_hinge).length() - distance).abs()
        };
        let ends = [range.min, range.max].into_iter().filter(|end| end.is_finite());
        ends.min_by(|a, b| miss(*a).total_cmp(&miss(*b))).unwrap_or(angle)
    }
}

/// One reach: what is asked and what is allowed.
struct Quest<'a> {
    limb: &'a Limb,
    in_hinge: DVec3,
    goal: &'a LimbGoal,
    from: &'a LimbState,
    ranges: LimbRanges,
    window: f64,
}

/// How the limb holds a place: `None` if no elevation in the window is feasible there.
struct Held {
    state: Option<LimbState>,
    span: Span,
    limited: bool,
}

/// A place that can be held, and how far from the target it leaves the articulator.
#[derive(Clone, Copy)]
struct Candidate {
    place: DVec3,
    state: LimbState,
    missed: f64,
}

impl Quest<'_> {
    /// The joints that bring the articulator to a place, or along its direction as far as the hinge goes.
    fn held(&self, place: DVec3) -> Result<Held, Degenerate> {
        let (direction, distance) = direction(&LimbGoal { target: place, ..*self.goal })?;
        let free = self.limb.hinge_for(self.in_hinge, distance, self.goal.branch)?;
        let angle = unwound(free.angle, self.from.hinge, self.ranges.hinge);
        let hinge = self.limb.stopped(self.in_hinge, angle, distance, self.ranges.hinge);
        let elevations = self.limb.elevations(self.in_hinge, hinge, direction, &self.ranges.root);
        let turn = elevations.nearest(self.goal.elevation).filter(|turn| turn.abs() <= self.window);
        let state = turn.map(|turn| {
            let elevation = self.goal.elevation + turn;
            LimbState { root: self.limb.root_for(self.in_hinge, hinge, direction, elevation), hinge }
        });
        Ok(Held { state, span: free.span, limited: turn != Some(0.0) || hinge != angle })
    }

    fn candidate(&self, place: DVec3) -> Option<Candidate> {
        let state = self.held(place).ok()?.state?;
        let missed = self.limb.articulator(&state, self.in_hinge).distance(self.goal.target);
        Some(Candidate { place, state, missed })
    }

    /// The joints in range that bring the articulator nearest to the target.
    ///
    /// The places that the window can hold are bounded by pieces of a few surfaces, with corners and
    /// dents, so the best of an even spread of places is taken and closed in on.
    fn nearest(&self) -> Option<LimbState> {
        let mut best: [Option<Candidate>; SEEDS] = [None; SEEDS];
        let start = self.limb.articulator(self.from, self.in_hinge);
        let (near, far) = self.limb.reach(self.in_hinge);
        let spread = (0..SPREAD).flat_map(|i| {
            let direction = sphere(i, SPREAD);
            let along = self.goal.target.dot(direction).clamp(near, far);
            [along, near, near + 0.3 * (far - near), near + 0.7 * (far - near), far].map(|d| direction * d)
        });
        for place in std::iter::once(start).chain(spread) {
            if let Some(found) = self.candidate(place) {
                keep_apart(&mut best, found, 0.15 * far);
            }
        }
        let coarse = best.into_iter().flatten().map(|seed| self.close_in(seed, 0.06, 2e-3));
        let seed = coarse.min_by(|a, b| a.missed.total_cmp(&b.missed))?;
        Some(self.close_in(seed, 2e-3, 1e-9).state)
    }

    /// Compass search over places, from one step width down to another, metres.
    fn close_in(&self, mut best: Candidate, mut step: f64, finest: f64) -> Candidate {
        while step > finest {
            let around = (0..COMPASS).filter_map(|i| self.candidate(best.place + sphere(i, COMPASS) * step));
            match around.min_by(|a, b| a.missed.total_cmp(&b.missed)) {
                Some(next) if next.missed < best.missed => best = next,
                _ => step *= 0.5,
            }
        }
        best
    }
}

/// Keeps the best candidates, none nearer than `apart` to a better one, best first.
fn keep_apart(best: &mut [Option<Candidate>; SEEDS], found: Candidate, apart: f64) {
    let close = |kept: &Candidate| kept.place.distance(found.place) < apart;
    if best.iter().flatten().any(|kept| close(kept) && kept.missed <= found.missed) {
        return;
    }
    let mut all = [None; SEEDS + 1];
    let others = best.iter().flatten().filter(|kept| !close(kept)).copied();
    for (slot, candidate) in all.iter_mut().zip(others.chain(std::iter::once(found))) {
        *slot = Some(candidate);
    }
    all.sort_by(|a, b| missed(a).total_cmp(&missed(b)));
    best.copy_from_slice(&all[..SEEDS]);
}

fn missed(candidate: &Option<Candidate>) -> f64 {
    candidate.map_or(f64::INFINITY, |c| c.missed)
}

/// Places tried all round the root, places kept, and directions tried at each step.
const SPREAD: u32 = 160;
const SEEDS: usize = 5;
const COMPASS: u32 = 24;

/// The i-th of n directions spread evenly over the sphere.
fn sphere(i: u32, n: u32) -> DVec3 {
    let z = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(n);
    let (sine, cosine) = (f64::from(i) * 2.399_963_229_728_653).sin_cos();
    let r = (1.0 - z * z).sqrt();
    DVec3::new(r * cosine, r * sine, z)
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
