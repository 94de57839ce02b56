//! The closed form of a limb against the plain two-bone solve: time for one call each, over many different inputs.

mod sampling;
#[path = "../tests/seeded/mod.rs"]
mod seeded;
mod yardstick;

use std::f64::consts::FRAC_PI_6;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::DVec3;
use kin::{Carrier, Cone, Interval, Limb, LimbGoal, LimbRanges, LimbState, RootRange};
use sampling::each;
use seeded::Seeded;
use yardstick::TwoBone;

/// How far a reach may change the elevation, as in the gestures, radians.
const WINDOW: f64 = FRAC_PI_6;

/// An arm: the limb, its ranges and random articulators on the hand.
struct Arm {
    limb: Limb,
    ranges: LimbRanges,
    seeded: Seeded,
}

/// A pose of the arm and a goal for it.
#[derive(Clone, Copy)]
struct Case {
    articulator: DVec3,
    from: LimbState,
    goal: LimbGoal,
}

impl Arm {
    fn new() -> Arm {
        let base = DVec3::new(0.5, 0.8, 0.33).normalize();
        let limb = Limb::new(DVec3::X * 0.32, DVec3::Z, Carrier::Swing { base }).expect("a limb");
        let cone = Cone { axis: DVec3::new(0.6, 0.75, 0.1).normalize(), half_angle: 125f64.to_radians() };
        let twist = Interval::new(-90f64.to_radians(), 90f64.to_radians());
        let root = RootRange { cone, bone: DVec3::X, twist_axis: DVec3::X, twist };
        let ranges = LimbRanges { root, hinge: Interval::new(0.0, 150f64.to_radians()) };
        Arm { limb, ranges, seeded: Seeded(5) }
    }

    /// A pose inside the ranges.
    fn state(&mut self) -> LimbState {
        let range = self.ranges;
        let root = std::iter::repeat_with(|| self.seeded.rotation()).find(|q| range.root.contains(*q, 0.0));
        let hinge = self.seeded.between(range.hinge.min, range.hinge.max);
        LimbState { root: root.expect("ranges hold some rotation"), hinge }
    }

    /// A pose, and as goal what another pose of the same hand recovers to.
    fn case(&mut self) -> Case {
        let articulator =
            DVec3::new(0.3, 0.0, 0.0) + self.seeded.direction() * self.seeded.between(0.0, 0.18);
        let (from, there) = (self.state(), self.state());
        let goal = self.limb.recover(articulator, &there).expect("a goal");
        Case { articulator, from, goal }
    }

    /// A reach of a few centimetres from a pose in range.
    fn drag(&mut self) -> Case {
        let case = self.case();
        let held = self.limb.recover(case.articulator, &case.from).expect("a goal");
        let target = held.target + self.seeded.direction() * self.seeded.between(0.0, 0.05);
        Case { goal: LimbGoal { target, ..held }, ..case }
    }

    /// A reach to a place that some elevation of the window holds, or none does.
    fn reach(&mut self, holds: bool) -> Case {
        loop {
            let case = if holds { self.drag() } else { self.far_drag() };
            let limb = self.limb;
            let held = limb.hold_within(case.articulator, &case.goal, &case.from, &self.ranges, WINDOW);
            if held.expect("a goal").is_some() == holds {
                return case;
            }
        }
    }

    /// A reach to anywhere within the length of the arm, with the elevation kept.
    fn far_drag(&mut self) -> Case {
        let case = self.case();
        let held = self.limb.recover(case.articulator, &case.from).expect("a goal");
        let target = self.seeded.direction() * self.seeded.between(0.15, 0.6);
        Case { goal: LimbGoal { target, ..held }, ..case }
    }
}

/// The same arms and targets for the plain solve; the pole is where the hinge goes.
fn two_bones(arm: &mut Arm) -> TwoBone {
    let case = arm.case();
    let solved = arm.limb.solve(case.articulator, &case.goal).expect("a pose");
    TwoBone {
        root: DVec3::ZERO,
        middle: arm.limb.hinge(&case.from),
        end: arm.limb.articulator(&case.from, case.articulator),
        target: case.goal.target,
        pole: arm.limb.hinge(&solved.state),
    }
}

fn plain(c: &mut Criterion) {
    let mut arm = Arm::new();
    let case = || {
        let case = two_bones(&mut arm);
        assert!(case.missed() < 1e-9, "the yardstick misses by {} m", case.missed());
        case
    };
    each(c, "plain two-bone solve", case, TwoBone::solve);
}

fn closed_form(c: &mut Criterion) {
    let mut arm = Arm::new();
    let limb = arm.limb;
    each(c, "solve", || arm.case(), |case| limb.solve(case.articulator, &case.goal));
    each(c, "recover", || arm.case(), |case| limb.recover(case.articulator, &case.from));
    let range = arm.ranges.root;
    each(
        c,
        "elevations",
        || {
            let case = arm.case();
            (case.articulator, case.from.hinge, case.goal.target.normalize())
        },
        |&(articulator, hinge, toward)| limb.elevations(articulator, hinge, toward, &range),
    );
}

fn ranges(c: &mut Criterion) {
    let mut arm = Arm::new();
    let (limb, ranges) = (arm.limb, arm.ranges);
    let reach = |case: &Case| limb.reach_within(case.articulator, &case.goal, &case.from, &ranges, WINDOW);
    each(c, "reach within ranges", || arm.reach(true), reach);
    each(c, "reach outside the ranges", || arm.reach(false), reach);
}

criterion_group! {
    name = limb;
    config = sampling::many_short();
    targets = plain, closed_form, ranges
}
criterion_main!(limb);
