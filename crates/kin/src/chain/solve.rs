//! From a goal to values: which solver does what, in which order.

use glam::{DQuat, DVec3};

use super::bend::Survey;
use super::fabrik::Places;
use super::goal::{Goal, Options, Root, Solved, Solver};
use super::linkage::Linkage;
use super::restart::Run;
use super::{Chain, ChainError, Value};
use crate::Frame;
use crate::ball::rotation_vector;

/// Steps of damped least squares from one start.
const STEPS: usize = 80;

/// Sweeps in which the distance must halve, else damped least squares take over.
const HALVING: usize = 8;

/// Another start must bring the point to less than that part of the distance.
const LEAP: f64 = 0.95;

/// A problem as it was given.
struct Task<'a> {
    chain: &'a Chain,
    path: Vec<usize>,
    values: &'a [Value],
    world_from_root: Frame,
    goal: Goal,
    options: &'a Options<'a>,
}

impl Chain {
    /// Finds values that bring a point of a node to a target, starting from given ones.
    ///
    /// Joints stay in their ranges; one that starts outside may only move inward. Nodes that are held, and nodes
    /// off the way from the root to the goal's node, keep their values to the bit. A goal that is met already
    /// changes nothing, and the answer is never farther off than the start (where a rotation is asked for, in
    /// `sqrt(way² + (turn * half the length)²)`). Where many answers exist, it is one near the start; only a
    /// chain that is straight to a thousandth takes the even bend, and only where the start leads nowhere are
    /// other starts tried, always the same ones. A target out of reach is pointed at. With [`Root::Follows`] the
    /// point gets there and the chain moves: the solver does not matter then and a rotation is not sought,
    /// ranges and held nodes are kept.
    ///
    /// # Errors
    /// No such node; values, flags or tolerances that don't fit; numbers that are not finite; a rotation for a
    /// solver of positions.
    pub fn solve(
        &self,
        values: &[Value],
        world_from_root: Frame,
        goal: &Goal,
        options: &Options,
    ) -> Result<Solved, ChainError> {
        self.check(values)?;
        options.check(self.nodes.len())?;
        let goal = goal.sound()?;
        if !(world_from_root.position.is_finite() && world_from_root.rotation.is_finite()) {
            return Err(ChainError::BadNumber { what: "place of the chain" });
        }
        let positions_only = !matches!(options.solver, Solver::Best | Solver::DampedLeastSquares);
        if goal.rotation.is_some() && positions_only && goal.root == Root::Held {
            return Err(ChainError::PositionsOnly { solver: options.solver });
        }
        let path = self.path(goal.node)?;
        let task = Task { chain: self, path, values, world_from_root, goal, options };
        Ok(match goal.root {
            Root::Held => task.held(),
            Root::Follows => task.follows(),
        })
    }
}

impl Task<'_> {
    /// The answer with a fixed root.
    fn held(&self) -> Solved {
        let (path, values, root) = (&self.path, self.values, self.world_from_root);
        let survey = self.chain.survey(path, values, root, &self.goal, self.options);
        let (start_m, start_rad) = self.residuals(survey.end);
        if self.within(start_m, start_rad) {
            return self.answer(values.to_vec(), survey.end, &Run::default());
        }
        let mut run = Run { cap: self.options.cap, ..Run::default() };
        let bent = match self.bent(&survey, &mut run) {
            Some(bent) if bent.reached => return bent,
            bent => bent,
        };
        let (linkage, state) = self.linkage();
        let guess = bent.as_ref().map(|bent| linkage.pick(&bent.values));
        let found = linkage.search_with(self.options.solver, &state, guess, &mut run);
        let found = self.answer_of(&linkage, &found, &run);
        // How far off, turns counted as metres at the arm's length.
        let off = |metres: f64, rad: f64| metres.hypot(rad * linkage.arm());
        if off(found.residual_m, found.residual_rad) <= off(start_m, start_rad) {
            found
        } else {
            self.answer(values.to_vec(), survey.end, &run)
        }
    }

    /// The even bend, where it applies; to the other side if one does not get there.
    fn bent(&self, survey: &Survey, run: &mut Run) -> Option<Solved> {
        let closed = matches!(self.options.solver, Solver::Best | Solver::ClosedForm);
        let straight = survey.straight.as_ref().filter(|_| closed && self.goal.rotation.is_none())?;
        let mut bend = |turned_over: bool| {
            run.spend();
            let (chain, path) = (self.chain, &self.path);
            let values =
                chain.even_bend(path, self.values, &self.goal, self.options, straight, turned_over)?;
            let end = self.end(&values);
            Some(self.answer(values, end, run))
        };
        let first = bend(false)?;
        if first.reached || !straight.has_sides() {
            return Some(first);
        }
        let second = bend(true).filter(|second| second.residual_m < first.residual_m);
        second.or(Some(first))
    }

    /// The answer where the chain is drawn along.
    fn follows(&self) -> Solved {
        let (linkage, mut state) = self.linkage();
        let mut frames = Vec::with_capacity(state.len());
        let start = linkage.end_at(&state);
        let world_from_root = match linkage.movers.first() {
            Some(first) => {
                let (joint, steps) = linkage.follow(&mut state, &mut frames, &self.goal);
                let run = Run { spent: steps, ..Run::default() };
                let root = joint.then(first.origin.inverse()).then(self.world_from_root);
                return self.moved(&linkage, &state, root, &run);
            }
            None => {
                let way = self.goal.target - start.position;
                Frame::new(self.world_from_root.rotation, self.world_from_root.position + way)
            }
        };
        self.moved(&linkage, &state, world_from_root, &Run { spent: 1, ..Run::default() })
    }

    /// The answer with the chain in another place; the start where the numbers overflowed.
    fn moved(&self, linkage: &Linkage, state: &[Value], mut root: Frame, run: &Run) -> Solved {
        root.rotation = root.rotation.normalize();
        let mut task = Task { path: self.path.clone(), world_from_root: root, ..*self };
        let mut answer = task.answer_of(linkage, state, run);
        if !(root.position.is_finite() && root.rotation.is_finite() && answer.residual_m.is_finite()) {
            task.world_from_root = self.world_from_root;
            let values = self.values.to_vec();
            answer = task.answer(values, task.end(self.values), run);
        }
        answer
    }

    fn linkage(&self) -> (Linkage, Vec<Value>) {
        let (path, values, root) = (&self.path, self.values, self.world_from_root);
        Linkage::of(self.chain, path, values, root, &self.goal, self.options)
    }

    /// The frame of the goal's point.
    fn end(&self, values: &[Value]) -> Frame {
        self.chain.end(&self.path, values, self.world_from_root, &self.goal)
    }

    fn answer_of(&self, linkage: &Linkage, state: &[Value], run: &Run) -> Solved {
        let mut values = self.values.to_vec();
        for (mover, &value) in linkage.movers.iter().zip(state) {
            values[mover.node] = value;
        }
        let end = self.end(&values);
        self.answer(values, end, run)
    }

    fn answer(&self, values: Vec<Value>, end: Frame, run: &Run) -> Solved {
        let (residual_m, residual_rad) = self.residuals(end);
        Solved {
            values,
            world_from_root: self.world_from_root,
            reached: self.within(residual_m, residual_rad),
            residual_m,
            residual_rad,
            iterations: run.spent,
            restarts: run.restarts,
        }
    }

    /// How far an end is from the goal, metres and radians.
    fn residuals(&self, end: Frame) -> (f64, f64) {
        let turn = |wanted: DQuat| rotation_vector((wanted * end.rotation.conjugate()).normalize()).length();
        (end.position.distance(self.goal.target), self.goal.rotation.map_or(0.0, turn))
    }

    fn within(&self, residual_m: f64, residual_rad: f64) -> bool {
        residual_m <= self.options.tolerance_m && residual_rad <= self.options.tolerance_rad
    }
}

impl Linkage {
    /// The movers' values among those of all nodes.
    fn pick(&self, values: &[Value]) -> Vec<Value> {
        self.movers.iter().map(|mover| values[mover.node]).collect()
    }

    /// The best state that a solver finds, from the start or from a guess.
    fn search_with(
        &self,
        solver: Solver,
        start: &[Value],
        guess: Option<Vec<Value>>,
        run: &mut Run,
    ) -> Vec<Value> {
        match solver {
            Solver::ClosedForm => {
                let closed = self.two_links(start).inspect(|_| {
                    run.spend();
                });
                self.nearer(start.to_vec(), closed.or(guess))
            }
            Solver::Best => {
                let closed = self.two_links(start).inspect(|_| {
                    run.spend();
                });
                let guess = closed.or(guess);
                if let Some(guess) = guess.as_ref().filter(|guess| self.is_met(guess)) {
                    return guess.clone();
                }
                self.search(start, guess, run, |linkage, state, run| linkage.least_squares(state, run, STEPS))
            }
            Solver::DampedLeastSquares => {
                self.search(start, None, run, |linkage, state, run| linkage.least_squares(state, run, STEPS))
            }
            Solver::Ccd => self.search(start, None, run, |linkage, state, run| {
                let mut frames = Vec::with_capacity(state.len());
                linkage.sweeps(state, run, |state| linkage.ccd_sweep(state, &mut frames))
            }),
            Solver::Fabrik => self.search(start, None, run, |linkage, state, run| {
                let mut places = Places::default();
                linkage.sweeps(state, run, |state| linkage.fabrik_sweep(state, &mut places))
            }),
        }
    }

    fn is_met(&self, state: &[Value]) -> bool {
        self.met(&self.gap(self.end_at(state)))
    }

    /// The second state if it is nearer to the goal, else the first.
    fn nearer(&self, first: Vec<Value>, second: Option<Vec<Value>>) -> Vec<Value> {
        second.filter(|second| self.cost_at(second) < self.cost_at(&first)).unwrap_or(first)
    }

    /// Searches from a guess, from the start and, while the goal is in reach and the budget lasts, from elsewhere.
    fn search(
        &self,
        start: &[Value],
        guess: Option<Vec<Value>>,
        run: &mut Run,
        local: impl Fn(&Linkage, &mut Vec<Value>, &mut Run) -> bool,
    ) -> Vec<Value> {
        let far = self.out_of_reach();
        let stretched = far.then(|| self.pointed(start));
        let mut best = start.to_vec();
        let guess = stretched.or(guess);
        for mut state in guess.into_iter().chain([start.to_vec()]) {
            if local(self, &mut state, run) {
                return state;
            }
            best = self.nearer(best, Some(state));
        }
        let mut off = self.cost_at(&best).sqrt();
        while !far && !self.movers.is_empty() && run.spent < run.cap {
            run.restarts += 1;
            let mut state = self.elsewhere(start, run.restarts);
            if local(self, &mut state, run) {
                return state;
            }
            let found = self.cost_at(&state).sqrt();
            // What is clearly nearer is worth a leap; a hair's breadth is not.
            if found < LEAP * off && found + 10.0 * self.tolerance_m < off {
                (best, off) = (state, found);
            }
        }
        best
    }

    /// Sweeps while they halve the distance, then damped least squares. Says whether the goal is met. A sweep
    /// returns where the point is after it.
    fn sweeps(
        &self,
        state: &mut Vec<Value>,
        run: &mut Run,
        mut sweep: impl FnMut(&mut [Value]) -> DVec3,
    ) -> bool {
        let mut best = state.clone();
        let mut off = self.end_at(state).position.distance(self.target);
        let (mut mark, mut since) = (off, 0);
        while off > 0.999 * self.tolerance_m && run.spend() {
            let now = sweep(state).distance(self.target);
            if now < off {
                off = now;
                best.clone_from(state);
            }
            since += 1;
            if since == HALVING {
                if off > 0.5 * mark {
                    self.least_squares(&mut best, run, STEPS);
                    break;
                }
                (mark, since) = (off, 0);
            }
        }
        *state = best;
        self.is_met(state)
    }
}
