//! Reaching with ranges: feasible elevations against a dense search, clamping, residuals.

mod seeded;

use glam::{DQuat, DVec3};
use kin::{Carrier, Cone, Interval, Limb, LimbGoal, LimbRanges, LimbState, RootRange, wrapped};
use seeded::Seeded;

const WINDOW: f64 = std::f64::consts::FRAC_PI_6;

/// The whole shoulder in the arm frame: x outward, y forward, z down; the arm at rest along x.
fn shoulder() -> (Limb, LimbRanges) {
    let base = DVec3::new(0.5, 0.8, 0.33).normalize();
    let limb = Limb::new(DVec3::X * 0.32, DVec3::Z, Carrier::Swing { base }).expect("a limb");
    let cone = Cone { axis: DVec3::new(0.6, 0.75, 0.1).normalize(), half_angle: 125f64.to_radians() };
    let twist = Interval::new(-90f64.to_radians(), 90f64.to_radians());
    let root = RootRange { cone, bone: DVec3::X, twist_axis: DVec3::X, twist };
    (limb, LimbRanges { root, hinge: Interval::new(0.0, 150f64.to_radians()) })
}

/// A hip whose rest is an A pose, its knee offset and its hinge askew.
fn awkward() -> (Limb, LimbRanges) {
    let base = DVec3::new(0.1, 0.9, -0.1).normalize();
    let bone = DVec3::new(0.25, 0.95, 0.1).normalize();
    let axis = DVec3::new(1.0, -0.2, 0.15).normalize();
    let limb = Limb::new(bone * 0.43 + axis * 0.02, axis, Carrier::Swing { base }).expect("a limb");
    let cone = Cone { axis: DVec3::new(0.3, 0.6, -0.7).normalize(), half_angle: 70f64.to_radians() };
    let twist = Interval::new(-45f64.to_radians(), 40f64.to_radians());
    let root = RootRange { cone, bone, twist_axis: -bone, twist };
    (limb, LimbRanges { root, hinge: Interval::new(-0.05, 2.6) })
}

/// A state inside the ranges.
fn inside(seeded: &mut Seeded, ranges: &LimbRanges) -> LimbState {
    let root = std::iter::repeat_with(|| seeded.rotation()).find(|q| ranges.root.contains(*q, 0.0));
    let hinge = seeded.between(ranges.hinge.min, ranges.hinge.max);
    LimbState { root: root.expect("ranges hold some rotation"), hinge }
}

fn end_point(seeded: &mut Seeded) -> DVec3 {
    DVec3::new(0.3, 0.0, 0.0) + seeded.direction() * seeded.between(0.0, 0.18)
}

#[test]
fn feasible_elevations_agree_with_a_dense_search() {
    let mut seeded = Seeded(11);
    let (mut two, mut none) = (0, 0);
    let cases = 3_000;
    for case in 0..cases {
        let (limb, ranges) = if case % 2 == 0 { shoulder() } else { awkward() };
        let (a, hinge) = (end_point(&mut seeded), seeded.between(0.0, 2.4));
        let toward = seeded.direction();
        let found = limb.elevations(a, hinge, toward, &ranges.root);
        let inside = |e: f64| ranges.root.contains(limb.root_for(a, hinge, toward, e), 0.0);
        let distance_to_edge = |e: f64| {
            found
                .arcs()
                .flat_map(|arc| [arc.start, arc.start + arc.width])
                .map(|edge| wrapped(e - edge).abs())
                .fold(f64::INFINITY, f64::min)
        };
        for step in 0..1_440 {
            let e = wrapped(f64::from(step) * 0.25f64.to_radians());
            let says = found.around(e).is_some();
            if says != inside(e) {
                assert!(
                    distance_to_edge(e) < 0.1f64.to_radians(),
                    "case {case} at {}: says {says}",
                    e.to_degrees()
                );
            }
        }
        // The ends themselves, to a thousandth of a degree.
        for arc in found.arcs().filter(|arc| arc.width < 6.0 && arc.width > 1e-3) {
            let slip = 1e-5;
            for (edge, inward) in [(arc.start, slip), (arc.start + arc.width, -slip)] {
                assert!(inside(edge + inward), "case {case}");
                assert!(!inside(edge - inward), "case {case}");
            }
        }
        two += usize::from(found.arcs().count() == 2);
        none += usize::from(found.arcs().count() == 0);
    }
    assert!(two > cases / 50 && none > cases / 50, "the cases must meet two arcs ({two}) and none ({none})");
}

#[test]
fn a_recovered_elevation_lies_in_its_interval() {
    let mut seeded = Seeded(12);
    for case in 0..100_000 {
        let (limb, ranges) = if case % 2 == 0 { shoulder() } else { awkward() };
        let (a, state) = (end_point(&mut seeded), inside(&mut seeded, &ranges));
        let goal = limb.recover(a, &state).unwrap();
        let around =
            limb.elevations(a, state.hinge, goal.target.normalize(), &ranges.root).around(goal.elevation);
        let (low, high) = around.expect("the state is in range, so its elevation is feasible");
        assert!(low - 1e-7 <= goal.elevation && goal.elevation <= high + 1e-7);
    }
}

#[test]
fn reaches_keep_every_range_and_meet_what_can_be_met() {
    let mut seeded = Seeded(13);
    let mut met = 0;
    for case in 0..100_000 {
        let (limb, ranges) = if case % 2 == 0 { shoulder() } else { awkward() };
        let (a, from) = (end_point(&mut seeded), inside(&mut seeded, &ranges));
        let goal = limb.recover(a, &from).unwrap();
        // Most targets are near, as in a drag; every fiftieth is anywhere.
        let target = if case % 50 != 0 {
            goal.target + seeded.direction() * seeded.between(0.0, 0.1)
        } else {
            seeded.direction() * seeded.between(0.0, 0.9)
        };
        let goal = LimbGoal { target, ..goal };
        let Ok(reach) = limb.reach_within(a, &goal, &from, &ranges, WINDOW) else { continue };
        assert!(ranges.contains(&reach.state, 1e-9), "case {case}: {:?}", reach.state);
        let hinge = limb.hinge_for(a, target.length(), goal.branch).unwrap();
        let spans = hinge.span == kin::Span::Reached && ranges.hinge.contains(hinge.angle);
        let turn = limb.elevations(a, hinge.angle, target.normalize(), &ranges.root).nearest(goal.elevation);
        if spans && turn.is_some_and(|turn| turn.abs() < WINDOW) {
            met += 1;
            assert!(reach.residual < 1e-9, "case {case}: residual {}", reach.residual);
            let now = limb.recover(a, &reach.state).unwrap();
            assert_eq!(now.branch, goal.branch);
            let change = wrapped(now.elevation - goal.elevation).abs();
            let bent = limb.bend_sine(a, reach.state.hinge).abs();
            assert!((change - turn.unwrap().abs()).abs() < 1e-9 / bent.max(1e-3), "case {case}: {change}");
        }
    }
    assert!(met > 30_000, "{met}");
}

#[test]
fn a_joint_outside_its_range_may_stay_and_move_inward_only() {
    let (limb, ranges) = shoulder();
    let a = DVec3::X * 0.3;
    let from = LimbState { root: DQuat::from_rotation_z(-2.6), hinge: 2.8 };
    assert!(!ranges.contains(&from, 1e-3));
    let goal = limb.recover(a, &from).unwrap();
    let stay = limb.reach_within(a, &goal, &from, &ranges, WINDOW).unwrap();
    assert!(stay.residual < 1e-9 && (stay.state.hinge - 2.8).abs() < 1e-9);
    let inward = LimbGoal { target: goal.target * 1.5, ..goal };
    let moved = limb.reach_within(a, &inward, &from, &ranges, WINDOW).unwrap();
    assert!(moved.state.hinge < 2.8);
    let outward = LimbGoal { target: goal.target * 0.5, ..goal };
    let held = limb.reach_within(a, &outward, &from, &ranges, WINDOW).unwrap();
    assert!(held.state.hinge <= 2.8 + 1e-12, "{}", held.state.hinge);
}

/// The least distance to the target over joints in range whose elevation is within the window: a
/// random search that closes in on its best answers.
fn dense(
    limb: &Limb,
    a: DVec3,
    goal: &LimbGoal,
    ranges: &LimbRanges,
    seeded: &mut Seeded,
    start: LimbState,
) -> f64 {
    let allowed = |state: &LimbState| {
        ranges.contains(state, 0.0)
            && limb.branch(a, state.hinge) == goal.branch
            && limb.recover(a, state).is_ok_and(|g| wrapped(g.elevation - goal.elevation).abs() <= WINDOW)
    };
    let missed = |state: &LimbState| limb.articulator(state, a).distance(goal.target);
    let mut pool: Vec<LimbState> = vec![start];
    for _ in 0..4_000 {
        pool.push(inside(seeded, ranges));
    }
    pool.retain(|s| allowed(s));
    pool.sort_by(|x, y| missed(x).total_cmp(&missed(y)));
    pool.truncate(8);
    let mut best = f64::INFINITY;
    for mut state in pool {
        let mut size = 0.4;
        for _ in 0..1_500 {
            let root = DQuat::from_scaled_axis(seeded.direction() * size * seeded.unit()) * state.root;
            let next = LimbState {
                root: root.normalize(),
                hinge: ranges.hinge.clamp(state.hinge + size * seeded.between(-1.0, 1.0)),
            };
            if allowed(&next) && missed(&next) < missed(&state) {
                state = next;
            } else {
                size = (size * 0.985).max(1e-4);
            }
        }
        best = best.min(missed(&state));
    }
    best
}

#[test]
fn where_ranges_stop_the_limb_the_residual_is_near_the_best() {
    let mut seeded = Seeded(14);
    let (mut worst, mut seen) = (0.0f64, 0);
    let mut outside = 0;
    while seen < 200 {
        let (limb, ranges) = if seen % 2 == 0 { shoulder() } else { awkward() };
        let (a, from) = (end_point(&mut seeded), inside(&mut seeded, &ranges));
        let goal = limb.recover(a, &from).unwrap();
        let goal = LimbGoal { target: seeded.direction() * seeded.between(0.1, 0.7), ..goal };
        let Ok(reach) = limb.reach_within(a, &goal, &from, &ranges, WINDOW) else { continue };
        if reach.residual < 1e-6 {
            continue;
        }
        seen += 1;
        let now = limb.recover(a, &reach.state).unwrap();
        let change = wrapped(now.elevation - goal.elevation).abs();
        outside += usize::from(change > WINDOW + 1e-6);
        let best = dense(&limb, a, &goal, &ranges, &mut seeded, reach.state);
        worst = worst.max(reach.residual - best);
    }
    assert_eq!(outside, 0, "an elevation changed by more than the window");
    assert!(worst < 0.005, "worst {worst}");
}

fn turn_between(a: DQuat, b: DQuat) -> f64 {
    let d = a.conjugate() * b;
    2.0 * d.xyz().length().atan2(d.w.abs())
}

/// A target that a gesture drags along a line in millimetres, always solved from the same first state.
#[test]
fn where_the_target_is_met_the_elevation_hops_rarely_and_within_the_window() {
    let mut seeded = Seeded(15);
    let (mut steps, mut hops) = (0, 0);
    let (limb, ranges) = shoulder();
    // Opposite to the base of the swing carrier the elevation itself is singular.
    let singular = -DVec3::new(0.5, 0.8, 0.33).normalize();
    for case in 0..400 {
        let (a, from) = (end_point(&mut seeded), inside(&mut seeded, &ranges));
        let goal = limb.recover(a, &from).unwrap();
        let (along, far) = (seeded.direction(), limb.reach(a).1);
        let middle = along.any_orthonormal_vector() * seeded.between(0.1, 1.0) * far;
        let mut before: Option<LimbState> = None;
        for step in -900..=900 {
            let goal = LimbGoal { target: middle + along * (f64::from(step) * 1e-3), ..goal };
            let now = limb.hold_within(a, &goal, &from, &ranges, WINDOW).unwrap();
            let now = now.filter(|_| goal.target.normalize().dot(singular) < 0.8);
            if let (Some(before), Some(now)) = (before, now) {
                let turned = turn_between(before.root, now.root).max((before.hinge - now.hinge).abs());
                steps += 1;
                // Two ends equally near, or the nearer one has run out. Other steps may be fast, but hop nowhere.
                hops += usize::from(turned > 0.35);
                assert!(turned < 2.0 * WINDOW + 0.2, "case {case}, {step}: {turned}");
            }
            before = now;
        }
    }
    assert!(steps > 200_000 && hops * 30_000 < steps, "{hops} of {steps}");
}
