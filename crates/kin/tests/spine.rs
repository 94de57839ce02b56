//! The spine: an even bend meets its aim, and solving what was recovered changes nothing.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DMat3, DQuat, DVec3};
use kin::{AIM_STEPS, AimError, Bend, Column, ColumnState};
use proptest::prelude::*;
use seeded::Seeded;

mod seeded;

/// Three equal segments straight up.
fn straight() -> Column<3> {
    Column::new([DVec3::Y * 0.15; 3]).expect("a chord")
}

/// Segments of any length and lean: a spine at rest with lordosis, kyphosis and a tilt.
fn awkward(s: &mut Seeded) -> Column<3> {
    let segment = |_| DVec3::new(s.between(-0.03, 0.03), s.between(0.05, 0.25), s.between(-0.08, 0.08));
    Column::new(std::array::from_fn(segment)).expect("a chord")
}

/// A direction at an angle from the twist axis.
fn leaning(column: &Column<3>, s: &mut Seeded, angle: f64) -> DVec3 {
    let axis = column.axis();
    let side = s.direction();
    let side = (side - axis * side.dot(axis)).normalize();
    axis * angle.cos() + side * angle.sin()
}

/// A pose near an even bend, each joint off by up to `residue` radians.
fn posed(column: &Column<3>, s: &mut Seeded, residue: f64) -> [DQuat; 3] {
    let side = leaning(column, s, FRAC_PI_2);
    let bend = Bend { swing: side * s.between(0.0, 1.5), twist: s.between(-1.5, 1.5) };
    let even = column.pose(&ColumnState { bend, ..ColumnState::REST });
    even.map(|local| local * DQuat::from_axis_angle(s.direction(), s.between(-residue, residue)))
}

fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

/// Angle between rotations, accurate for small ones.
fn apart(a: DQuat, b: DQuat) -> f64 {
    let d = a.conjugate() * b;
    2.0 * d.xyz().length().atan2(d.w.abs())
}

fn furthest(a: &[DQuat; 3], b: &[DQuat; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| apart(*a, *b)).fold(0.0, f64::max)
}

/// The top by matrices, independently of the code under test.
fn top(segments: &[DVec3], locals: &[DQuat]) -> DVec3 {
    let mut turn = DMat3::IDENTITY;
    segments.iter().zip(locals).fold(DVec3::ZERO, |top, (segment, local)| {
        turn *= DMat3::from_quat(*local);
        top + turn * *segment
    })
}

fn closed_form<const N: usize>(share: f64) {
    let column = Column::new([DVec3::Y * 0.2; N]).expect("a chord");
    let mut s = Seeded(N as u64);
    for _ in 0..2_000 {
        let lean = s.between(0.0, 1.0_f64.min(PI / share));
        let way = s.between(-PI, PI);
        let aim = DVec3::new(lean.sin() * way.cos(), lean.cos(), lean.sin() * way.sin());
        let solved = column.solve(&ColumnState::REST, aim * 3.0, s.between(-3.0, 3.0)).expect("an answer");
        assert!(solved.reached() && solved.steps == 0, "{solved:?}");
        assert!((solved.state.bend.swing.length() - share * lean).abs() < 1e-12);
        assert!(angle(top(&[DVec3::Y * 0.2; N], &column.pose(&solved.state)), aim) < 1e-12);
    }
}

#[test]
fn equal_straight_segments_need_no_iteration() {
    closed_form::<1>(1.0);
    closed_form::<2>(4.0 / 3.0);
    closed_form::<3>(1.5);
    closed_form::<4>(1.6);
}

#[test]
fn each_joint_of_an_even_bend_bends_and_twists_by_the_same_angle_in_one_plane() {
    let bend = Bend { swing: DVec3::new(0.9, 0.0, -0.6), twist: 1.2 };
    let even = straight().even(bend);
    let ups = [DVec3::Y, even[0] * DVec3::Y, even[1] * DVec3::Y, even[2] * DVec3::Y];
    for (i, pair) in ups.windows(2).enumerate() {
        assert!((angle(pair[0], pair[1]) - bend.swing.length() / 3.0).abs() < 1e-14, "segment {i}");
        assert!(pair[1].dot(bend.swing.normalize()).abs() < 1e-15, "segment {i}");
        let share = (i + 1) as f64 / 3.0;
        let unswung = DQuat::from_scaled_axis(bend.swing * -share) * even[i];
        assert!(apart(unswung, DQuat::from_rotation_y(bend.twist * share)) < 1e-14);
    }
    let locals = straight().pose(&ColumnState { bend, ..ColumnState::REST });
    assert!(apart(locals[0] * locals[1] * locals[2], even[2]) < 1e-14);
    // What equal local turns would give instead.
    let naive = even[0] * even[0] * even[0];
    assert!(angle(naive * DVec3::Y, even[2] * DVec3::Y) > 5_f64.to_radians());
}

#[test]
fn solving_what_was_recovered_changes_nothing() {
    let mut s = Seeded(2);
    let mut worst = 0.0_f64;
    for i in 0..100_000 {
        let column = awkward(&mut s);
        let locals = posed(&column, &mut s, [0.0, 1e-9, 0.3, 0.8][i % 4]);
        let state = column.recover(&locals).unwrap();
        worst = worst.max(furthest(&column.pose(&state), &locals));
        let solved = column.solve(&state, column.top(&locals), state.bend.twist).unwrap();
        assert!(solved.reached() && solved.steps == 0);
        worst = worst.max(furthest(&column.pose(&solved.state), &locals));
    }
    assert!(worst < 1e-12, "{worst:e}");
}

#[test]
fn recovering_what_was_solved_gives_the_same_bend_twist_and_residues() {
    let mut s = Seeded(3);
    let mut reached = 0;
    for _ in 0..20_000 {
        let column = awkward(&mut s);
        let state = column.recover(&posed(&column, &mut s, 0.3)).unwrap();
        let lean = s.between(0.0, 1.4);
        let (aim, twist) = (leaning(&column, &mut s, lean), s.between(-3.0, 3.0));
        let solved = column.solve(&state, aim, twist).unwrap();
        if solved.state.bend.swing.length() > 3.0 {
            continue;
        }
        reached += 1;
        let again = column.recover(&column.pose(&solved.state)).unwrap();
        assert!((again.bend.twist - twist).abs() < 1e-12, "{again:?}");
        assert!(again.bend.swing.distance(solved.state.bend.swing) < 1e-12);
        assert!(furthest(&again.residues, &state.residues) < 1e-12);
    }
    assert!(reached > 19_000, "{reached}");
}

#[test]
fn uneven_curved_and_wrung_columns_meet_every_moderate_aim() {
    let mut s = Seeded(4);
    for i in 0..20_000 {
        let column = awkward(&mut s);
        let residue = [0.0, 0.1, 0.3][i % 3];
        let state = column.recover(&posed(&column, &mut s, residue)).unwrap();
        let lean = s.between(0.0, 1.1);
        let (aim, twist) = (leaning(&column, &mut s, lean), s.between(-1.5, 1.5));
        let solved = column.solve(&state, aim, twist).unwrap();
        assert!(solved.reached() && solved.steps <= 8, "{solved:?}");
        let locals = column.pose(&solved.state);
        assert!(angle(column.top(&locals), aim) < 1e-12);
        assert_eq!(solved.state.bend.twist, twist);
        assert_eq!(solved.state.residues, state.residues);
    }
}

#[test]
fn the_top_agrees_with_matrices() {
    let mut s = Seeded(5);
    for _ in 0..10_000 {
        let segments = std::array::from_fn(|_| s.direction() * s.between(0.0, 0.3));
        let Ok(column) = Column::<3>::new(segments) else { continue };
        let locals = std::array::from_fn(|_| s.rotation());
        assert!(column.top(&locals).distance(top(&segments, &locals)) < 1e-14);
    }
}

#[test]
fn near_straight_columns_keep_the_accuracy_of_tiny_leans() {
    for exponent in 1..=16 {
        let lean = 10.0_f64.powi(-exponent);
        let aim = DVec3::new(lean, 1.0, 0.0);
        let solved = straight().solve(&ColumnState::REST, aim, 0.0).unwrap();
        assert!(solved.reached());
        let swing = solved.state.bend.swing;
        // Below the tolerance a lean may be taken as met.
        if lean > 1e-12 {
            assert!((swing.length() / lean.atan() - 1.5).abs() < 1e-9, "{lean:e} {swing}");
        }
        assert!(swing.z <= 0.0 && swing.length() <= 1.5 * lean * (1.0 + 1e-9));
    }
}

#[test]
fn a_straight_column_leans_by_120_degrees_at_most_and_says_what_is_missing() {
    let mut s = Seeded(6);
    let most = 120_f64.to_radians();
    for _ in 0..2_000 {
        let lean = s.between(most + 1e-3, PI - 1e-3);
        let aim = leaning(&straight(), &mut s, lean);
        let solved = straight().solve(&ColumnState::REST, aim, s.between(-1.0, 1.0)).unwrap();
        assert!(!solved.reached());
        assert!((solved.residual_rad - (lean - most)).abs() < 1e-9, "{lean} {solved:?}");
        assert!((solved.state.bend.swing.length() - PI).abs() < 1e-9);
        assert!(solved.state.bend.swing.normalize().dot(aim).abs() < 1e-3, "in the plane of the aim");
    }
}

#[test]
fn an_aim_opposite_to_rest_is_leant_toward_in_the_plane_of_the_present_bend() {
    let present =
        ColumnState { bend: Bend { swing: DVec3::new(0.3, 0.0, 0.4), twist: 0.0 }, ..ColumnState::REST };
    let solved = straight().solve(&present, -DVec3::Y, 0.0).unwrap();
    assert!((solved.residual_rad - 60_f64.to_radians()).abs() < 1e-9);
    assert!(solved.state.bend.swing.distance(DVec3::new(0.6, 0.0, 0.8) * PI) < 1e-6, "{solved:?}");
    let unbent = straight().solve(&ColumnState::REST, -DVec3::Y, 0.0).unwrap();
    assert!((unbent.residual_rad - 60_f64.to_radians()).abs() < 1e-9);
}

#[test]
fn out_of_reach_no_bend_of_a_dense_search_comes_nearer() {
    let mut s = Seeded(7);
    let mut missed = 0;
    for _ in 0..400 {
        let column = awkward(&mut s);
        let state = column.recover(&posed(&column, &mut s, 0.3)).unwrap();
        let lean = s.between(1.6, 3.1);
        let aim = leaning(&column, &mut s, lean);
        let solved = column.solve(&state, aim, 0.2).unwrap();
        assert!(solved.state.bend.swing.length() < PI + 1e-12);
        if solved.reached() {
            continue;
        }
        missed += 1;
        let (a, b) = column.axis().any_orthonormal_pair();
        for step in 0..60 * 120 {
            let (size, way) = (PI * f64::from(step / 120) / 59.0, PI * f64::from(step % 120) / 60.0);
            let bend = Bend { swing: (a * way.cos() + b * way.sin()) * size, twist: 0.2 };
            let tried = column.pose(&ColumnState { bend, residues: state.residues });
            let off = angle(column.top(&tried), aim);
            assert!(off > solved.residual_rad - 2e-3, "{off} beats {}", solved.residual_rad);
        }
    }
    assert!(missed > 100, "{missed}");
}

#[test]
fn a_slow_aim_never_makes_the_column_jump() {
    let mut s = Seeded(8);
    for _ in 0..200 {
        let column = awkward(&mut s);
        let state = column.recover(&posed(&column, &mut s, 0.3)).unwrap();
        let [from, to] = [leaning(&column, &mut s, 0.9), leaning(&column, &mut s, 0.6)];
        let mut before: Option<[DQuat; 3]> = None;
        for i in 0..=1000 {
            let aim = from.lerp(to, f64::from(i) / 1000.0);
            let locals = column.pose(&column.solve(&state, aim, 0.4).unwrap().state);
            if let Some(before) = before {
                assert!(furthest(&before, &locals) < 0.02, "step {i}");
            }
            before = Some(locals);
        }
    }
}

#[test]
fn the_mirror_of_a_solution_is_the_solution_of_the_mirror() {
    let flip = |v: DVec3| DVec3::new(-v.x, v.y, v.z);
    let mirrored = |q: DQuat| DQuat::from_xyzw(q.x, -q.y, -q.z, q.w);
    let segments = [DVec3::new(0.01, 0.1, 0.03), DVec3::new(0.0, 0.2, -0.02), DVec3::new(-0.02, 0.12, 0.05)];
    let (left, right) = (Column::new(segments).unwrap(), Column::new(segments.map(flip)).unwrap());
    let mut s = Seeded(9);
    for _ in 0..2_000 {
        let locals = posed(&left, &mut s, 0.3);
        let aim = leaning(&left, &mut s, 0.8);
        let a = left.solve(&left.recover(&locals).unwrap(), aim, 0.3).unwrap();
        let b = right.solve(&right.recover(&locals.map(mirrored)).unwrap(), flip(aim), -0.3).unwrap();
        let off = furthest(&left.pose(&a.state).map(mirrored), &right.pose(&b.state));
        assert!(off < 1e-10, "{off:e}");
    }
}

#[test]
fn an_aim_without_direction_is_degenerate() {
    let solve = |aim| straight().solve(&ColumnState::REST, aim, 0.0).unwrap_err();
    assert_eq!(solve(DVec3::ZERO), AimError::NoAim);
    assert_eq!(solve(DVec3::splat(1e-200)), AimError::NoAim);
    assert_eq!(solve(DVec3::new(0.0, f64::NAN, 0.0)), AimError::NotFinite);
    assert_eq!(solve(DVec3::new(0.0, f64::INFINITY, 0.0)), AimError::NotFinite);
}

#[test]
fn numbers_that_are_not_finite_are_named_in_every_place() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let column = straight();
        assert_eq!(column.solve(&ColumnState::REST, DVec3::Y, bad), Err(AimError::NotFinite));
        let mut state = ColumnState::REST;
        state.bend.swing.x = bad;
        assert_eq!(column.solve(&state, DVec3::Y, 0.0), Err(AimError::NotFinite));
        let mut state = ColumnState::REST;
        state.residues[1].z = bad;
        assert_eq!(column.solve(&state, DVec3::Y, 0.0), Err(AimError::NotFinite));
        let mut locals = [DQuat::IDENTITY; 3];
        locals[2].w = bad;
        assert_eq!(column.recover(&locals), Err(AimError::NotFinite));
        assert_eq!(Column::new([DVec3::Y, DVec3::Y * bad]), Err(AimError::NotFinite));
        assert_eq!(Column::about([DVec3::Y], DVec3::Y * bad), Err(AimError::NotFinite));
    }
}

#[test]
fn turns_without_a_usable_length_are_refused_and_others_are_made_unit() {
    for length in [0.0, 1e-200, 1e200] {
        assert_eq!(straight().recover(&[DQuat::IDENTITY * length; 3]), Err(AimError::NotFinite));
        let state = ColumnState { residues: [DQuat::IDENTITY * length; 3], ..ColumnState::REST };
        assert_eq!(straight().solve(&state, DVec3::Y, 0.0), Err(AimError::NotFinite));
    }
    assert_eq!(straight().recover(&[DQuat::IDENTITY * 3.0; 3]), Ok(ColumnState::REST));
}

#[test]
fn a_column_without_a_rest_chord_is_degenerate() {
    assert_eq!(Column::new([DVec3::ZERO; 3]), Err(AimError::NoLine));
    assert_eq!(Column::new([DVec3::Y, DVec3::X, -DVec3::Y - DVec3::X]), Err(AimError::NoLine));
    assert_eq!(Column::<0>::new([]), Err(AimError::NoLine));
    assert_eq!(Column::about([DVec3::Y], DVec3::ZERO), Err(AimError::NoLine));
}

#[test]
fn a_pose_whose_chord_vanishes_is_degenerate() {
    let column = Column::new([DVec3::Y; 2]).unwrap();
    let folded = column.recover(&[DQuat::IDENTITY, DQuat::from_rotation_x(PI)]).unwrap();
    assert!(column.top(&column.pose(&folded)).length() < 1e-15);
    assert_eq!(column.solve(&folded, DVec3::Z, folded.bend.twist), Err(AimError::NoLine));
}

#[test]
fn a_segment_without_length_is_no_obstacle() {
    let column = Column::new([DVec3::Y * 0.2, DVec3::ZERO, DVec3::new(0.0, 0.3, 0.1)]).unwrap();
    assert!(column.solve(&ColumnState::REST, DVec3::new(0.3, 1.0, 0.5), 0.7).unwrap().reached());
}

proptest! {
    #[test]
    fn whatever_the_input_the_answer_is_finite_or_typed(
        segments in prop::array::uniform3(prop::array::uniform3(prop::num::f64::ANY)),
        swing in prop::array::uniform3(prop::num::f64::ANY),
        residues in prop::array::uniform3(prop::array::uniform4(prop::num::f64::ANY)),
        aim in prop::array::uniform3(prop::num::f64::ANY),
        twist in prop::num::f64::ANY,
        (tame_segments, tame_residues, tame_swing) in any::<(bool, bool, bool)>(),
    ) {
        let segments = if tame_segments { [DVec3::Y; 3] } else { segments.map(DVec3::from) };
        let locals = if tame_residues { [DQuat::IDENTITY; 3] } else { residues.map(DQuat::from_array) };
        let Ok(column) = Column::new(segments) else { return Ok(()) };
        let Ok(mut state) = column.recover(&locals) else { return Ok(()) };
        prop_assert!(state.bend.swing.is_finite() && state.residues.iter().all(|r| r.is_finite()));
        if !tame_swing {
            state.bend.swing = DVec3::from(swing);
        }
        if let Ok(solved) = column.solve(&state, DVec3::from(aim), twist) {
            prop_assert!(solved.residual_rad.is_finite() && solved.steps <= AIM_STEPS);
            prop_assert!(solved.state.bend.swing.length() <= PI + 1e-9);
            prop_assert!(column.pose(&solved.state).iter().all(|q| q.is_normalized()));
        }
    }
}
