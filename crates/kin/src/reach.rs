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
struct Quest<'a> {
    limb: &'a Limb,
    in_hinge: DVec3,
    goal: &'a LimbGoal,
    from: &'a LimbState,
    ranges: LimbRanges,
    window: f64,
    /// The ends of the hinge's range and the distances at which they hold the articulator.
    stops: OnceCell<[(f64, f64); 2]>,
}

/// A limb bent for a place; the elevation is still open, and no matter where the articulator goes.
struct Aimed {
    direction: DVec3,
    hinge: f64,
    /// The articulator in the upper segment's frame.
    bent: DVec3,
    span: Span,
    /// Whether the hinge stopped at its range.
    stopped: bool,
}

/// A place that can be held, and how far from the target it leaves the articulator.
#[derive(Clone, Copy)]
struct Candidate {
    place: DVec3,
    state: LimbState,
    missed: f64,
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
    fn aimed(&self, place: DVec3) -> Result<Aimed, Degenerate> {
        let (direction, distance) = direction(&LimbGoal { target: place, ..*self.goal })?;
        let free = self.limb.hinge_for(self.in_hinge, distance, self.goal.branch)?;
        let angle = unwound(free.angle, self.from.hinge, self.ranges.hinge);
        let hinge = self.stopped(angle, distance);
        let bent = self.limb.bent(self.in_hinge, hinge);
        Ok(Aimed { direction, hinge, bent, span: free.span, stopped: hinge != angle })
    }

    /// The hinge angle, or the end of its range whose distance comes nearer.
    fn stopped(&self, angle: f64, distance: f64) -> f64 {
        let range = self.ranges.hinge;
        if range.contains(angle) {
            return angle;
        }
        let at = |end| (end, self.limb.bent(self.in_hinge, end).length());
        let stops = self.stops.get_or_init(|| [at(range.min), at(range.max)]);
        let miss = |stop: &(f64, f64)| (stop.1 - distance).abs();
        let ends = stops.iter().filter(|(end, _)| end.is_finite());
        ends.min_by(|a, b| miss(a).total_cmp(&miss(b))).map_or(angle, |(end, _)| *end)
    }

    /// The joints at the feasible elevation nearest to the goal's, and how far that is from it; `None` if
    /// none lies in the window.
    fn held(&self, aimed: &Aimed) -> Option<(LimbState, f64)> {
        let frame = self.limb.frame_of(aimed.bent, aimed.direction);
        let elevations = feasible(frame, &self.ranges.root);
        let turn = elevations.nearest(self.goal.elevation).filter(|turn| turn.abs() <= self.window)?;
        Some((LimbState { root: root(frame, self.goal.elevation + turn), hinge: aimed.hinge }, turn))
    }

    /// A place that can be held and misses the target by less than a bound; what can't do so is left early.
    fn candidate(&self, place: DVec3, below: f64) -> Option<Candidate> {
        let target = self.goal.target;
        let along = target.dot(place).max(0.0);
        // The articulator lies on the ray through the place, so it misses by what the ray does or more.
        if (target.length_squared() - below * below) * place.length_squared() > along * along {
            return None;
        }
        let aimed = self.aimed(place).ok()?;
        let missed = (aimed.direction * aimed.bent.length()).distance(target);
        if missed >= below {
            return None;
        }
        let (state, _) = self.held(&aimed)?;
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
            if let Some(found) = self.candidate(place, missed(&best[SEEDS - 1])) {
                keep_apart(&mut best, found, 0.15 * far);
            }
        }
        let compass = std::array::from_fn(|i| sphere(i as u32, COMPASS as u32));
        let coarse = best.into_iter().flatten().map(|seed| self.close_in(seed, &compass, 0.06, 2e-3));
        let seed = coarse.min_by(|a, b| a.missed.total_cmp(&b.missed))?;
        Some(self.close_in(seed, &compass, 2e-3, 1e-9).state)
    }

    /// Compass search over places, from one step width down to another, metres.
    fn close_in(
        &self,
        mut best: Candidate,
        compass: &[DVec3; COMPASS],
        mut step: f64,
        finest: f64,
    ) -> Candidate {
        while step > finest {
            let mut next = best;
            for toward in compass {
                next = self.candidate(best.place + toward * step, next.missed).unwrap_or(next);
            }
            if next.missed < best.missed {
                best = next;
            } else {
                step *= 0.5;
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
const COMPASS: usize = 24;

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
