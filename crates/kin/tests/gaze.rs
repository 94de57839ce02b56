//! Gaze: neck and head share an aim without rolling, the eyes take the rest.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DQuat, DVec3};
use kin::{AimError, Ball, Eye, Gaze, GazeState, Interval, wrapped};
use proptest::prelude::*;
use seeded::Seeded;

mod seeded;

const NECK_TO_HEAD: DVec3 = DVec3::new(0.0, 0.09, 0.015);
const EYES_IN_HEAD: DVec3 = DVec3::new(0.0, 0.065, 0.085);

fn gaze() -> Gaze<2> {
    Gaze::new([NECK_TO_HEAD, EYES_IN_HEAD], DVec3::Z, DVec3::Y).expect("axes")
}

/// A neck with any segments, its head set on askew, and one eye off the middle.
fn awkward(s: &mut Seeded) -> Gaze<2> {
    let neck = DVec3::new(s.between(-0.02, 0.02), s.between(0.02, 0.15), s.between(-0.03, 0.05));
    let eye = DVec3::new(s.between(-0.04, 0.04), s.between(0.03, 0.1), s.between(0.05, 0.12));
    let forward = DVec3::new(s.between(-0.3, 0.3), s.between(-0.3, 0.3), 1.0);
    let up = DVec3::new(s.between(-0.3, 0.3), 1.0, s.between(-0.3, 0.3));
    Gaze::new([neck, eye], forward, up).expect("axes")
}

/// Joints turned by up to `most` radians each.
fn posed(s: &mut Seeded, most: f64) -> [DQuat; 2] {
    std::array::from_fn(|_| DQuat::from_axis_angle(s.direction(), s.between(0.0, most)))
}

fn angle(a: DVec3, b: DVec3) -> f64 {
    a.cross(b).length().atan2(a.dot(b))
}

fn apart(a: DQuat, b: DQuat) -> f64 {
    let d = a.conjugate() * b;
    2.0 * d.xyz().length().atan2(d.w.abs())
}

fn furthest(a: &[DQuat; 2], b: &[DQuat; 2]) -> f64 {
    a.iter().zip(b).map(|(a, b)| apart(*a, *b)).fold(0.0, f64::max)
}

#[test]
fn looking_where_it_looks_already_changes_nothing() {
    let mut s = Seeded(1);
    let mut worst = 0.0_f64;
    for i in 0..100_000 {
        let gaze = awkward(&mut s);
        let locals = posed(&mut s, [0.0, 1e-9, 0.5, 1.5][i % 4]);
        let state = gaze.recover(&locals).unwrap();
        worst = worst.max(furthest(&gaze.pose(&state), &locals));
        let (eye, along) = gaze.sight(&locals);
        let solved = gaze.solve(&state, eye + along * s.between(0.05, 10.0)).unwrap();
        assert!(solved.reached() && solved.steps == 0, "{solved:?}");
        worst = worst.max(furthest(&gaze.pose(&solved.state), &locals));
    }
    assert!(worst < 1e-12, "{worst:e}");
}

#[test]
fn every_target_in_front_is_met_and_nothing_rolls() {
    let mut s = Seeded(2);
    let mut steps = 0;
    for i in 0..50_000 {
        let gaze = awkward(&mut s);
        let state = gaze.recover(&posed(&mut s, [0.0, 0.4][i % 2])).unwrap();
        let toward = s.direction();
        let target = DVec3::new(toward.x, toward.y, toward.z.abs()) * s.between(0.5, 20.0);
        // An eye off the middle can't see what is straight below the neck: its sight passes beside it.
        if toward.y.abs() > 0.9 {
            continue;
        }
        let solved = gaze.solve(&state, target).unwrap();
        steps += solved.steps;
        assert!(solved.reached(), "{target} {solved:?}");
        let locals = gaze.pose(&solved.state);
        let (eye, along) = gaze.sight(&locals);
        assert!(angle(target - eye, along) < 2e-12);
        let again = gaze.recover(&locals).unwrap();
        assert_eq!((solved.state.roll, solved.state.residues), (state.roll, state.residues));
        assert!(furthest(&gaze.pose(&again), &locals) < 1e-12);
        // Toward the pole yaw and roll run into each other.
        if solved.state.pitch.abs() < 1.5 {
            let (yaw, roll) = (wrapped(again.yaw - solved.state.yaw), again.roll - state.roll);
            assert!(yaw.abs() < 1e-12 && roll.abs() < 1e-12, "{yaw:e} {roll:e}");
        }
    }
    assert!(steps < 5 * 50_000, "{steps} Newton steps");
}

#[test]
fn a_level_head_stays_level() {
    let mut s = Seeded(3);
    for _ in 0..10_000 {
        let target = DVec3::new(s.between(-3.0, 3.0), s.between(-2.0, 2.0), s.between(0.3, 3.0));
        let solved = gaze().solve(&GazeState::REST, target).unwrap();
        let [neck, head] = gaze().pose(&solved.state);
        assert!((neck * head * DVec3::X).y.abs() < 1e-14, "the line through the ears");
    }
}

#[test]
fn neck_and_head_share_evenly() {
    let ahead = gaze().solve(&GazeState::REST, DVec3::new(0.0, 0.155, 2.0)).unwrap();
    assert!(furthest(&gaze().pose(&ahead.state), &[DQuat::IDENTITY; 2]) < 1e-12);
    let aside = gaze().solve(&GazeState::REST, DVec3::new(4.0, 0.155, 4.0)).unwrap();
    let [neck, head] = gaze().pose(&aside.state);
    assert!(apart(neck, head) < 1e-3 && apart(neck, DQuat::from_rotation_y(aside.state.yaw / 2.0)) < 1e-3);
    let down = gaze().solve(&GazeState::REST, DVec3::new(0.0, -1.0, 1.0)).unwrap();
    let [neck, head] = gaze().pose(&down.state);
    assert!(down.state.pitch > 0.5, "down is positive");
    assert!(apart(neck, head) < 1e-12 && apart(neck, DQuat::from_rotation_x(down.state.pitch / 2.0)) < 1e-12);
}

#[test]
fn positive_yaw_is_left_and_positive_roll_is_to_the_right() {
    let left = gaze().solve(&GazeState::REST, DVec3::new(1.0, 0.1, 1.0)).unwrap();
    assert!(left.state.yaw > 0.5);
    let [neck, head] = gaze().pose(&GazeState { roll: 0.4, ..GazeState::REST });
    assert!((neck * head * DVec3::Y).x < -0.3, "the crown goes to the figure's right");
}

#[test]
fn a_slow_target_never_makes_the_head_jump() {
    let mut s = Seeded(4);
    for _ in 0..200 {
        let gaze = awkward(&mut s);
        let state = gaze.recover(&posed(&mut s, 0.3)).unwrap();
        let mut place = || DVec3::new(s.between(-1.5, 1.5), s.between(-0.8, 0.8), s.between(0.6, 2.0));
        let (from, to) = (place(), place());
        let mut before: Option<[DQuat; 2]> = None;
        for i in 0..=1000 {
            let locals = gaze.pose(&gaze.solve(&state, from.lerp(to, f64::from(i) / 1000.0)).unwrap().state);
            assert!(before.is_none_or(|before| furthest(&before, &locals) < 0.02), "step {i}");
            before = Some(locals);
        }
    }
}

#[test]
fn targets_behind_are_met_the_short_way_round() {
    for x in [-0.01, 0.01] {
        let solved = gaze().solve(&GazeState::REST, DVec3::new(x, 0.1, -2.0)).unwrap();
        assert!(solved.reached() && (solved.state.yaw.abs() - PI).abs() < 0.1, "{solved:?}");
        assert_eq!(solved.state.yaw.signum(), x.signum());
    }
}

#[test]
fn straight_up_and_down_have_an_answer() {
    for y in [3.0, -3.0] {
        let target = DVec3::new(0.0, y, 0.0);
        let solved = gaze().solve(&GazeState::REST, target).unwrap();
        assert!(solved.reached(), "{solved:?}");
        let nodded = GazeState { pitch: -FRAC_PI_2 * y.signum(), ..GazeState::REST };
        let again = gaze().recover(&gaze().pose(&nodded)).unwrap();
        assert!(furthest(&gaze().pose(&again), &gaze().pose(&nodded)) < 1e-12);
    }
}

#[test]
fn a_target_that_passes_overhead_is_followed_by_a_nod() {
    let mut before: Option<[DQuat; 2]> = None;
    for i in 0..=1000 {
        let target = DVec3::new(0.0, 2.0, 0.6 - 1e-3 * f64::from(i));
        let solved = gaze().solve(&GazeState::REST, target).unwrap();
        assert!(solved.reached() && solved.state.yaw.abs() < 1e-9, "step {i}: {solved:?}");
        let locals = gaze().pose(&solved.state);
        assert!(before.is_none_or(|before| furthest(&before, &locals) < 0.005), "step {i}");
        before = Some(locals);
    }
}

#[test]
fn a_target_inside_the_head_has_a_finite_answer() {
    let mut s = Seeded(5);
    for _ in 0..4_000 {
        let target = s.direction() * s.between(0.0, 0.2);
        if let Ok(solved) = gaze().solve(&GazeState::REST, target) {
            assert!(solved.residual_rad.is_finite() && solved.residual_rad <= PI);
            assert!(gaze().pose(&solved.state).iter().all(|q| q.is_normalized()));
        }
    }
}

#[test]
fn a_target_at_the_eye_is_degenerate() {
    let eye = NECK_TO_HEAD + EYES_IN_HEAD;
    assert_eq!(gaze().solve(&GazeState::REST, eye), Err(AimError::NoAim));
}

#[test]
fn an_eye_in_the_head_joint_is_a_neck_of_one() {
    let gaze = Gaze::new([DVec3::ZERO], DVec3::Z, DVec3::Y).unwrap();
    let solved = gaze.solve(&GazeState::REST, DVec3::new(1.0, 1.0, 1.0)).unwrap();
    assert!(solved.reached() && solved.steps == 0, "{solved:?}");
}

#[test]
fn axes_without_length_or_along_each_other_are_degenerate() {
    let make = |forward, up| Gaze::new([NECK_TO_HEAD, EYES_IN_HEAD], forward, up).unwrap_err();
    assert_eq!(make(DVec3::ZERO, DVec3::Y), AimError::NoLine);
    assert_eq!(make(DVec3::Z, DVec3::ZERO), AimError::NoLine);
    assert_eq!(make(DVec3::Y * 2.0, DVec3::Y), AimError::NoLine);
    assert_eq!(make(DVec3::NAN, DVec3::Y), AimError::NotFinite);
    assert_eq!(make(DVec3::Z, DVec3::INFINITY), AimError::NotFinite);
}

#[test]
fn numbers_that_are_not_finite_are_named_in_every_place() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let target = DVec3::new(0.0, 0.0, bad);
        assert_eq!(gaze().solve(&GazeState::REST, target), Err(AimError::NotFinite));
        let solve = |state| gaze().solve(&state, DVec3::Z);
        assert_eq!(solve(GazeState { yaw: bad, ..GazeState::REST }), Err(AimError::NotFinite));
        assert_eq!(solve(GazeState { roll: bad, ..GazeState::REST }), Err(AimError::NotFinite));
        let locals = [DQuat::IDENTITY, DQuat::from_xyzw(0.0, bad, 0.0, 1.0)];
        assert_eq!(gaze().recover(&locals), Err(AimError::NotFinite));
    }
}

/// Eyes of both orders and mirrored axes.
fn eyes() -> [Eye; 6] {
    let (x, y, forward) = (DVec3::X, DVec3::Y, DVec3::Z);
    [(x, y), (x, -y), (-x, y), (y, x), (y, -x), (-y, -x)].map(|(outer, inner)| Eye { outer, inner, forward })
}

#[test]
fn eyes_aim_in_closed_form_whatever_the_order_and_signs_of_their_hinges() {
    let mut s = Seeded(6);
    for i in 0..100_000 {
        let eye = eyes()[i % 6];
        let toward = s.direction();
        let angles = eye.angles(toward * 10.0_f64.powf(s.between(-6.0, 6.0))).unwrap();
        assert!(angles[1].abs() <= FRAC_PI_2 && angles[0].abs() <= PI);
        assert!((eye.rotation(angles) * eye.forward).distance(toward) < 1e-14, "{toward} {angles:?}");
    }
}

#[test]
fn angles_of_an_eye_come_back_from_its_sight() {
    let mut s = Seeded(7);
    for i in 0..20_000 {
        let eye = eyes()[i % 6];
        let given = [s.between(-3.1, 3.1), s.between(-1.5, 1.5)];
        let got = eye.angles(eye.rotation(given) * eye.forward).unwrap();
        assert!((got[0] - given[0]).abs() < 1e-13 && (got[1] - given[1]).abs() < 1e-13, "{given:?} {got:?}");
    }
}

#[test]
fn an_eye_that_looks_along_its_outer_axis_has_no_outer_angle() {
    for eye in eyes() {
        let [outer, inner] = eye.angles(eye.outer).unwrap();
        assert_eq!((outer, inner.abs()), (0.0, FRAC_PI_2));
        assert!((eye.rotation([outer, inner]) * eye.forward).distance(eye.outer) < 1e-15);
    }
}

#[test]
fn an_eye_without_a_direction_is_degenerate() {
    assert_eq!(eyes()[0].angles(DVec3::ZERO), Err(AimError::NoAim));
    assert_eq!(eyes()[0].angles(DVec3::NAN), Err(AimError::NotFinite));
    assert_eq!(eyes()[0].angles(DVec3::INFINITY), Err(AimError::NotFinite));
}

#[test]
fn eyes_take_what_the_ranges_of_neck_and_head_leave() {
    let target = DVec3::new(2.0, 0.3, 0.4);
    let solved = gaze().solve(&GazeState::REST, target).unwrap();
    let ball = Ball { flexion: DVec3::X, abduction: -DVec3::Z, twist: DVec3::Y };
    let range = Interval::new(-0.5, 0.5);
    let [neck, head] = gaze().pose(&solved.state).map(|local| {
        let [flexion, abduction, twist] = ball.angles(local);
        ball.rotation(flexion, abduction, range.clamp(twist))
    });
    let turn = neck * head;
    let mut turned = 0.0;
    for side in [0.032, -0.032] {
        let eye_in_head = EYES_IN_HEAD + DVec3::X * side;
        let eye = neck * NECK_TO_HEAD + turn * eye_in_head;
        let angles = eyes()[0].angles(turn.conjugate() * (target - eye)).unwrap();
        let along = turn * eyes()[0].rotation(angles) * DVec3::Z;
        assert!(angle(along, target - eye) < 1e-14);
        turned += angles[1] / 2.0;
    }
    // The head stops at 1 radian of the 1.4 that it wants.
    assert!((turned - (solved.state.yaw - 1.0)).abs() < 0.05, "{turned} of {}", solved.state.yaw);
}

proptest! {
    #[test]
    fn whatever_the_input_the_answer_is_finite_or_typed(
        axes in prop::array::uniform2(prop::array::uniform3(prop::num::f64::ANY)),
        segments in prop::array::uniform2(prop::array::uniform3(prop::num::f64::ANY)),
        locals in prop::array::uniform2(prop::array::uniform4(prop::num::f64::ANY)),
        target in prop::array::uniform3(prop::num::f64::ANY),
        (tame_axes, tame_segments, tame_locals) in any::<(bool, bool, bool)>(),
    ) {
        let [forward, up] = if tame_axes { [DVec3::Z, DVec3::Y] } else { axes.map(DVec3::from) };
        let segments = if tame_segments { [NECK_TO_HEAD, EYES_IN_HEAD] } else { segments.map(DVec3::from) };
        let locals = if tame_locals { [DQuat::IDENTITY; 2] } else { locals.map(DQuat::from_array) };
        let Ok(gaze) = Gaze::new(segments, forward, up) else { return Ok(()) };
        let Ok(state) = gaze.recover(&locals) else { return Ok(()) };
        if let Ok(solved) = gaze.solve(&state, DVec3::from(target)) {
            prop_assert!(solved.residual_rad.is_finite() && solved.state.yaw.is_finite());
            prop_assert!(gaze.pose(&solved.state).iter().all(|q| q.is_normalized()));
        }
    }
}
