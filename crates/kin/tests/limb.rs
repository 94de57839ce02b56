//! The limb's closed form: checked vectors, round trips, degenerate cases, continuity.

mod seeded;

use glam::{DMat3, DQuat, DVec3};
use kin::{Branch, Carrier, Degenerate, Limb, LimbGoal, LimbState, Span, softened};
use seeded::Seeded;
use serde::Deserialize;

#[derive(Deserialize)]
struct Vectors {
    swing_base: [f64; 3],
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    upper: f64,
    fore: f64,
    articulator: [f64; 3],
    wrist: [[f64; 3]; 3],
    elbow: f64,
    shoulder: [[f64; 3]; 3],
    target: [f64; 3],
    branch: i32,
    spherical: Elevation,
    swing: Elevation,
}

#[derive(Deserialize)]
struct Elevation {
    elevation: f64,
}

fn rows(m: [[f64; 3]; 3]) -> DMat3 {
    DMat3::from_cols_array_2d(&m).transpose()
}

fn base() -> DVec3 {
    DVec3::new(0.5, 0.8, 0.33).normalize()
}

fn turn_between(a: DQuat, b: DQuat) -> f64 {
    let d = a.conjugate() * b;
    2.0 * d.xyz().length().atan2(d.w.abs())
}

fn difference(a: f64, b: f64) -> f64 {
    kin::wrapped(a - b).abs()
}

/// Where the limb is straight or folded to its articulator, the angle is loose to the root of the rounding.
fn angle_bound(limb: &Limb, a: DVec3, hinge: f64) -> f64 {
    if limb.bend_sine(a, hinge).abs() > 1e-3 { 1e-9 } else { 5e-7 }
}

#[test]
fn checked_arm_vectors() {
    let vectors: Vectors = serde_json::from_str(include_str!("fixtures/arm-vectors.json")).unwrap();
    assert!(vectors.cases.len() > 100);
    let swing = Carrier::Swing { base: DVec3::from(vectors.swing_base) };
    for (i, case) in vectors.cases.iter().enumerate() {
        for (carrier, elevation) in
            [(swing, case.swing.elevation), (Carrier::Spherical, case.spherical.elevation)]
        {
            let limb = Limb::straight(case.upper, carrier).unwrap();
            let a = DVec3::Y * case.fore + rows(case.wrist) * DVec3::from(case.articulator);
            let target = DVec3::from(case.target);
            let state = LimbState { root: DQuat::from_mat3(&rows(case.shoulder)), hinge: case.elbow };
            let bound = angle_bound(&limb, a, case.elbow);
            assert!(limb.articulator(&state, a).distance(target) < 1e-9, "row {i}: forward");
            let goal = limb.recover(a, &state).unwrap();
            assert!(goal.target.distance(target) < 1e-9, "row {i}");
            assert!(difference(goal.elevation, elevation) < bound, "row {i}: {carrier:?}");
            // On a straight limb both branches are one and the sign is the rounding's.
            if limb.bend_sine(a, case.elbow).abs() > 1e-8 {
                assert_eq!(goal.branch.sign() as i32, case.branch, "row {i}");
            }
            let branch = if case.branch < 0 { Branch::Minus } else { Branch::Plus };
            let solved = limb.solve(a, &LimbGoal { target, elevation, branch }).unwrap();
            assert!(solved.residual < 1e-9, "row {i}: residual {}", solved.residual);
            assert!(difference(solved.state.hinge, case.elbow) < bound, "row {i}");
            let matrix = DMat3::from_quat(solved.state.root) - rows(case.shoulder);
            assert!(matrix.to_cols_array().iter().all(|c| c.abs() < bound), "row {i}: {matrix}");
        }
    }
}

/// Limbs of every make: straight arms and legs, and awkward ones with bent rest poses and offset hinges.
fn random_limb(seeded: &mut Seeded, awkward: bool) -> (Limb, DVec3) {
    let carrier = if seeded.unit() < 0.8 { Carrier::Swing { base: base() } } else { Carrier::Spherical };
    let (upper, fore) = (seeded.between(0.2, 0.45), seeded.between(0.2, 0.45));
    let end = seeded.direction() * seeded.between(0.0, 0.2);
    if awkward {
        let hinge = seeded.direction() * upper;
        let axis = (hinge.any_orthonormal_vector() + 0.3 * seeded.direction()).normalize();
        (Limb::new(hinge, axis, carrier).expect("a limb"), seeded.direction() * fore + end)
    } else {
        (Limb::straight(upper, carrier).expect("a limb"), DVec3::Y * fore + end)
    }
}

#[test]
fn recover_then_solve_is_the_same_pose() {
    let mut seeded = Seeded(1);
    for case in 0..120_000 {
        let (limb, a) = random_limb(&mut seeded, case % 2 == 1);
        let psi = limb.hinge_for(a, limb.reach(a).1, Branch::Plus).unwrap().angle;
        let hinge = match case % 12 {
            0 => 0.0,
            1 => psi,
            2 => psi + 1e-9 * seeded.between(-1.0, 1.0),
            _ => seeded.between(-3.1, 3.1),
        };
        let root = match case % 5 {
            0 => seeded.rotation(),
            // Hanging straight down through the paper's singular pole, and near it.
            1 => DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2),
            _ => {
                DQuat::from_rotation_x(std::f64::consts::FRAC_PI_2 + 1e-4 * seeded.unit()) * seeded.rotation()
            }
        };
        let state = LimbState { root, hinge };
        let goal = match limb.recover(a, &state) {
            Ok(goal) => goal,
            Err(e) => panic!("case {case}: {e}"),
        };
        let solved = limb.solve(a, &goal).unwrap();
        assert!(solved.residual < 1e-9, "case {case}: residual {}", solved.residual);
        let bound = angle_bound(&limb, a, hinge);
        assert!(
            difference(solved.state.hinge, hinge) < bound,
            "case {case}: hinge {hinge} {:?}",
            solved.state.hinge
        );
        let turn = turn_between(solved.state.root, root);
        assert!(turn < bound, "case {case}: root off by {turn}, bound {bound}");
    }
}

#[test]
fn reachable_targets_are_met_on_the_kept_branch() {
    let mut seeded = Seeded(2);
    for case in 0..120_000 {
        let (limb, a) = random_limb(&mut seeded, case % 2 == 1);
        let (near, far) = limb.reach(a);
        let branch = if case % 3 == 0 { Branch::Minus } else { Branch::Plus };
        let goal = LimbGoal {
            target: seeded.direction() * seeded.between(near, far),
            elevation: seeded.between(-3.1, 3.1),
            branch,
        };
        let solved = limb.solve(a, &goal).unwrap();
        assert!(solved.residual < 1e-9, "case {case}: {solved:?}");
        if limb.bend_sine(a, solved.state.hinge).abs() > 1e-6 {
            assert_eq!(limb.branch(a, solved.state.hinge), branch, "case {case}");
        }
    }
}

#[test]
fn out_of_reach_points_at_the_target_and_says_how_far() {
    let limb = Limb::straight(0.3, Carrier::Swing { base: base() }).unwrap();
    let a = DVec3::new(0.02, 0.26, 0.05);
    let (near, far) = limb.reach(a);
    let mut seeded = Seeded(3);
    for _ in 0..2_000 {
        let toward = seeded.direction();
        for (distance, span, missed) in
            [(far + 0.2, Span::TooFar, 0.2), (near * 0.5, Span::TooNear, near * 0.5)]
        {
            let goal = LimbGoal { target: toward * distance, elevation: 0.7, branch: Branch::Plus };
            let solved = limb.solve(a, &goal).unwrap();
            assert_eq!(solved.span, span);
            assert!((solved.residual - missed).abs() < 1e-9);
            let at = limb.articulator(&solved.state, a);
            assert!(at.angle_between(toward) < 1e-7, "{at} {toward}");
        }
    }
}

#[test]
fn target_at_the_root_is_named() {
    let limb = Limb::straight(0.3, Carrier::Swing { base: base() }).unwrap();
    let goal = LimbGoal { target: DVec3::ZERO, elevation: 0.0, branch: Branch::Plus };
    assert_eq!(limb.solve(DVec3::Y * 0.25, &goal).unwrap_err(), Degenerate::TargetAtRoot);
}

#[test]
fn articulator_at_the_root_is_named() {
    let limb = Limb::straight(0.3, Carrier::Swing { base: base() }).unwrap();
    let folded = LimbState { root: DQuat::IDENTITY, hinge: std::f64::consts::PI };
    assert_eq!(limb.recover(DVec3::Y * 0.3, &folded).unwrap_err(), Degenerate::ArticulatorAtRoot);
}

#[test]
fn articulator_on_the_hinge_axis_is_named() {
    let limb = Limb::straight(0.3, Carrier::Swing { base: base() }).unwrap();
    let goal = LimbGoal { target: DVec3::X * 0.3, elevation: 0.0, branch: Branch::Plus };
    assert_eq!(limb.solve(DVec3::X * 0.05, &goal).unwrap_err(), Degenerate::ArticulatorOnHinge);
    assert_eq!(limb.solve(DVec3::ZERO, &goal).unwrap_err(), Degenerate::ArticulatorOnHinge);
}

#[test]
fn articulator_beside_the_upper_segment_along_the_axis_is_solved() {
    // A.y = A.z = 0: the articulator lies on the hinge axis through the root.
    let limb = Limb::straight(0.3, Carrier::Swing { base: base() }).unwrap();
    let a = DVec3::new(0.1, 0.3, 0.0);
    let state = LimbState { root: DQuat::from_rotation_z(0.4), hinge: std::f64::consts::PI };
    let solved = limb.solve(a, &limb.recover(a, &state).unwrap()).unwrap();
    assert!(solved.residual < 1e-9 && turn_between(solved.state.root, state.root) < 5e-7, "{solved:?}");
}

#[test]
fn upper_segment_without_length_is_named() {
    let carrier = Carrier::Swing { base: base() };
    assert_eq!(Limb::straight(0.0, carrier).unwrap_err(), Degenerate::NoUpper);
    assert_eq!(Limb::new(DVec3::X, DVec3::X, carrier).unwrap_err(), Degenerate::NoUpper);
    assert_eq!(Limb::new(DVec3::Y, DVec3::ZERO, carrier).unwrap_err(), Degenerate::NoAxis);
}

#[test]
fn lower_segment_without_length_reaches_with_the_end_alone() {
    let limb = Limb::straight(0.3, Carrier::Swing { base: base() }).unwrap();
    let a = DVec3::new(0.0, 0.0, 0.1);
    let goal = LimbGoal { target: DVec3::new(0.1, 0.25, 0.05), elevation: 0.3, branch: Branch::Plus };
    assert!(limb.solve(a, &goal).unwrap().residual < 1e-12);
}

#[test]
fn no_number_makes_a_nan() {
    let odd =
        [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, f64::MAX, -f64::MAX, 1e300, 1e-300, 0.0, -0.0, 0.3];
    let mut seeded = Seeded(4);
    let mut pick =
        || if seeded.unit() < 0.5 { odd[(seeded.unit() * 10.0) as usize] } else { seeded.between(-1.0, 1.0) };
    for _ in 0..200_000 {
        let mut v = || DVec3::new(pick(), pick(), pick());
        let Ok(limb) = Limb::new(v(), v(), Carrier::Swing { base: base() }) else { continue };
        let (a, target) = (v(), v());
        let goal = LimbGoal { target, elevation: pick(), branch: Branch::Plus };
        if let Ok(solved) = limb.solve(a, &goal) {
            assert!(solved.state.root.is_finite() && solved.state.hinge.is_finite(), "{limb:?} {a} {goal:?}");
        }
        let state = LimbState { root: DQuat::from_rotation_x(pick()), hinge: pick() };
        if let Ok(goal) = limb.recover(a, &state) {
            assert!(goal.target.is_finite() && goal.elevation.is_finite(), "{limb:?} {a} {state:?}");
        }
    }
}

/// Millimetre steps; x outward, y forward, z down.
#[test]
fn no_joint_turns_fast_through_down_ahead_across_and_overhead() {
    let limb = Limb::straight(0.32, Carrier::Swing { base: base() }).unwrap();
    let a = DVec3::new(0.01, 0.33, 0.03);
    let far = limb.reach(a).1;
    let mut worst = 0.0f64;
    for reach in [0.35, 0.45, far - 0.08] {
        for through in [DVec3::Z, DVec3::Y, DVec3::new(-0.5, 0.8, 0.2).normalize(), -DVec3::Z] {
            for way in 0..8 {
                let side = through.any_orthonormal_vector();
                let side = DQuat::from_axis_angle(through, f64::from(way) * 0.785) * side;
                let mut before: Option<LimbState> = None;
                for step in -150..=150 {
                    let target = through * reach + side * (f64::from(step) * 1e-3);
                    if target.length() < 0.35 || target.length() > far - 0.08 {
                        before = None;
                        continue;
                    }
                    let goal = LimbGoal { target, elevation: 2.9, branch: Branch::Plus };
                    let state = limb.solve(a, &goal).unwrap().state;
                    if let Some(before) = before {
                        worst = worst
                            .max(turn_between(before.root, state.root))
                            .max((before.hinge - state.hinge).abs());
                    }
                    before = Some(state);
                }
            }
        }
    }
    assert!(worst.to_degrees() < 0.5, "{} degrees a millimetre", worst.to_degrees());
    assert!(worst > 0.0);
}

#[test]
fn soft_reach_never_arrives_and_has_no_corner() {
    let (full, soft) = (0.6, 0.02);
    assert_eq!(softened(0.5, full, soft), 0.5);
    assert_eq!(softened(0.7, full, 0.0), 0.7);
    let mut before = softened(0.55, full, soft);
    for step in 1..400 {
        let at = softened(0.55 + f64::from(step) * 1e-3, full, soft);
        assert!(at <= full && at >= before && at - before <= 1e-3 + 1e-12);
        before = at;
    }
    let slope = (softened(0.58 + 1e-6, full, soft) - softened(0.58, full, soft)) / 1e-6;
    assert!((slope - 1.0).abs() < 1e-4, "{slope}");
}
