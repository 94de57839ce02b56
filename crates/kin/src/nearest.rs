//! Where no elevation in the window is feasible: the joints in range that bring the articulator nearest to its target.

use glam::DVec3;

use crate::reach::Quest;
use crate::settle::Settling;
use crate::{Interval, LimbState};

/// A place that can be held, the joints that hold it, and what they cost, metres: at first how far it is from the target.
#[derive(Clone, Copy)]
struct Candidate {
    place: DVec3,
    state: LimbState,
    cost: f64,
}

type Candidates = [Option<Candidate>; SEEDS];

impl Quest<'_> {
    /// The joints in range that bring the articulator nearest to the target.
    ///
    /// The places that the window can hold are bounded by pieces of a few surfaces, with corners and
    /// dents, so the best of an even spread of places are closed in on, all of them, and then the best of these.
    pub(crate) fn nearest(&self) -> Option<LimbState> {
        let mut rough = self.seeds().map(|seed| seed.map(|seed| self.settled(&seed, ROUGHLY)));
        rough.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
        let bound = cost(&rough[0]) + SPARE_M;
        let mut best: Option<Candidate> = None;
        for (i, seed) in rough.iter().enumerate() {
            let Some(seed) = seed.filter(|seed| seed.cost <= bound) else { break };
            let same = |other: &Candidate| other.place.distance(seed.place) < 1e-3;
            if rough[..i].iter().flatten().any(same) {
                continue;
            }
            let found = self.settled(&seed, FULLY);
            best = best.filter(|best| best.cost <= found.cost).or(Some(found));
        }
        best.map(|best| best.state)
    }

    /// The best places of an even spread round the root, and of where the gesture began, some way apart.
    fn seeds(&self) -> Candidates {
        let mut best: Candidates = [None; SEEDS];
        let start = self.limb.articulator(self.from, self.in_hinge);
        let (near, far) = self.limb.reach(self.in_hinge);
        let spread = (0..SPREAD).flat_map(|i| {
            let direction = sphere(i, SPREAD);
            let along = self.goal.target.dot(direction).clamp(near, far);
            [along, near, near + 0.3 * (far - near), near + 0.7 * (far - near), far].map(|d| direction * d)
        });
        for place in std::iter::once(start).chain(spread) {
            if let Some(found) = self.candidate(place, cost(&best[SEEDS - 1])) {
                keep_apart(&mut best, found, 0.2 * far);
            }
        }
        best
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
        Some(Candidate { place, state, cost: missed })
    }

    /// What closing in from a candidate leads to.
    fn settled(&self, seed: &Candidate, rounds: usize) -> Candidate {
        let (near, far) = self.limb.reach_in(self.in_hinge, self.ranges.hinge);
        let hinge = self.limb.on_branch(self.in_hinge, self.goal.branch, seed.state.hinge);
        let settling = Settling {
            limb: self.limb,
            in_hinge: self.in_hinge,
            target: self.goal.target,
            root: &self.ranges.root,
            hinge: hinge.within(self.ranges.hinge),
            elevation: self.goal.elevation,
            window: self.window,
            gap: Interval::new(near, far).excess(self.goal.target.length()),
        };
        let settled = settling.settle(seed.state, rounds);
        let out = settling.excess(&settled) > OUT;
        let at = if out { settling.standing(seed.state) } else { settled };
        Candidate { place: at.place, state: at.state, cost: settling.cost(&at) }
    }
}

/// Keeps the best candidates, none nearer than `apart` to a better one, best first.
fn keep_apart(best: &mut Candidates, found: Candidate, apart: f64) {
    let close = |kept: &Candidate| kept.place.distance(found.place) < apart;
    if best.iter().flatten().any(|kept| close(kept) && kept.cost <= found.cost) {
        return;
    }
    let mut all = [None; SEEDS + 1];
    let others = best.iter().flatten().filter(|kept| !close(kept)).copied();
    for (slot, candidate) in all.iter_mut().zip(others.chain(std::iter::once(found))) {
        *slot = Some(candidate);
    }
    all.sort_by(|a, b| cost(a).total_cmp(&cost(b)));
    best.copy_from_slice(&all[..SEEDS]);
}

fn cost(candidate: &Option<Candidate>) -> f64 {
    candidate.map_or(f64::INFINITY, |c| c.cost)
}

/// The i-th of n directions spread evenly over the sphere.
fn sphere(i: u32, n: u32) -> DVec3 {
    let z = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(n);
    let (sine, cosine) = (f64::from(i) * 2.399_963_229_728_653).sin_cos();
    let r = (1.0 - z * z).sqrt();
    DVec3::new(r * cosine, r * sine, z)
}

/// Directions tried all round the root, and places kept.
const SPREAD: u32 = 160;
const SEEDS: usize = 8;

/// Rounds for every place kept, and for those that are by then not farther off than the best by more than the spare.
const ROUGHLY: usize = 10;
const FULLY: usize = 50;
const SPARE_M: f64 = 0.02;

/// Joints farther out of their ranges than this are no answer, radians.
const OUT: f64 = 1e-9;
