//! The collar: the smallest turn that brings the shoulder within reach, and the rhythm of the girdle.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};
use kin::{CollarTurn, Rhythm, collar_turn};
use proptest::prelude::*;
use seeded::Seeded;

mod seeded;

const SHOULDER: DVec3 = DVec3::new(0.15, 0.02, -0.03);

fn turn_of(q: DQuat) -> f64 {
    2.0 * q.xyz().length().atan2(q.w.abs())
}

#[test]
fn the_turned_shoulder_is_just_within_reach() {
    let mut s = Seeded(1);
    let (mut turned, mut unneeded, mut out) = (0, 0, 0);
    for _ in 0..100_000 {
        let shoulder = s.direction() * s.between(0.05, 0.25);
        let target = s.direction() * s.between(0.01, 1.2);
        let reach = s.between(0.0, 0.8);
        let now = shoulder.distance(target);
        match collar_turn(shoulder, target, reach) {
            CollarTurn::Unneeded => {
                unneeded += 1;
                assert!(now <= reach);
            }
            CollarTurn::Turned(q) => {
                turned += 1;
                assert!(now > reach && q.is_normalized());
                assert!(((q * shoulder).distance(target) - reach).abs() < 1e-12);
                assert!(q.xyz().dot(shoulder).abs() < 1e-14 && q.xyz().dot(target).abs() < 1e-13);
            }
            CollarTurn::OutOfReach { rotation, residual } => {
                out += 1;
                let left = (rotation * shoulder).distance(target) - reach;
                assert!(residual > 0.0 && (left - residual).abs() < 1e-12, "{left} {residual}");
            }
            CollarTurn::Degenerate => panic!("{shoulder} {target} {reach}"),
        }
    }
    assert!(turned > 10_000 && unneeded > 10_000 && out > 10_000, "{turned} {unneeded} {out}");
}

#[test]
fn no_smaller_turn_reaches_and_no_turn_comes_nearer() {
    let mut s = Seeded(2);
    for _ in 0..2_000 {
        let shoulder = s.direction() * s.between(0.05, 0.25);
        let target = s.direction() * s.between(0.3, 0.9);
        let reach = s.between(0.3, 0.7);
        let found = collar_turn(shoulder, target, reach);
        for _ in 0..100 {
            let axis = s.direction();
            match found {
                CollarTurn::Turned(q) => {
                    let smaller = DQuat::from_axis_angle(axis, turn_of(q) * s.between(0.0, 1.0 - 1e-6));
                    assert!((smaller * shoulder).distance(target) > reach);
                }
                CollarTurn::OutOfReach { residual, .. } => {
                    let any = DQuat::from_axis_angle(axis, s.between(0.0, PI));
                    assert!((any * shoulder).distance(target) - reach > residual - 1e-12);
                }
                CollarTurn::Unneeded | CollarTurn::Degenerate => {}
            }
        }
    }
}

#[test]
fn a_target_that_leaves_reach_turns_the_collar_without_a_jump() {
    // Straight out, sideways and up: from well within reach to far beyond it.
    for way in [DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Z, DVec3::new(0.2, -1.0, 0.3)] {
        let mut before = DQuat::IDENTITY;
        let mut most = 0.0_f64;
        for i in 0..20_000 {
            let target = way.normalize() * (0.3 + 1e-4 * f64::from(i));
            let q = collar_turn(SHOULDER, target, 0.6).rotation();
            most = most.max(turn_of(before.conjugate() * q));
            before = q;
        }
        // Toward full alignment the angle goes with the square root, so a step is larger there.
        assert!(most < 0.06, "{way}: {most}");
    }
}

#[test]
fn turning_again_is_unneeded_but_for_the_rounding() {
    let target = DVec3::new(0.3, 0.55, 0.3);
    let CollarTurn::Turned(q) = collar_turn(SHOULDER, target, 0.55) else { panic!("should turn") };
    assert!(turn_of(collar_turn(q * SHOULDER, target, 0.55).rotation()) < 1e-14);
}

#[test]
fn a_target_too_near_the_collar_for_any_shoulder_is_out_of_reach() {
    let target = SHOULDER.normalize() * -0.02;
    let CollarTurn::OutOfReach { rotation, residual } = collar_turn(SHOULDER, target, 0.05) else {
        panic!("out of reach");
    };
    assert!((residual - (SHOULDER.length() - 0.02 - 0.05)).abs() < 1e-15);
    assert!((rotation * SHOULDER).normalize().distance(target.normalize()) < 1e-14);
}

#[test]
fn a_shoulder_in_line_with_a_far_target_stays() {
    let found = collar_turn(SHOULDER, SHOULDER * 20.0, 0.5);
    let CollarTurn::OutOfReach { rotation, residual } = found else { panic!("{found:?}") };
    assert!(turn_of(rotation) < 1e-15 && (residual - (19.0 * SHOULDER.length() - 0.5)).abs() < 1e-12);
}

#[test]
fn a_shoulder_opposite_to_its_target_turns_in_some_plane() {
    let found = collar_turn(DVec3::X * 0.2, DVec3::X * -0.6, 0.5);
    let CollarTurn::Turned(q) = found else { panic!("{found:?}") };
    assert!(((q * DVec3::X * 0.2).distance(DVec3::X * -0.6) - 0.5).abs() < 1e-14);
}

#[test]
fn a_shoulder_almost_opposite_to_its_target_is_turned_as_exactly() {
    for exponent in 1..=18 {
        let aside = DVec3::new(1.0, -2.0, 3.0).cross(SHOULDER).normalize() * 10.0_f64.powi(-exponent);
        let target = SHOULDER.normalize() * -0.6 + aside;
        let found = collar_turn(SHOULDER, target, 0.5);
        let CollarTurn::Turned(q) = found else { panic!("{found:?}") };
        assert!(((q * SHOULDER).distance(target) - 0.5).abs() < 1e-15, "{exponent}");
        assert!(q.xyz().normalize().dot(SHOULDER).abs() < 1e-16, "{exponent}: carries a twist");
    }
}

#[test]
fn exactly_at_full_reach_nothing_turns() {
    let target = SHOULDER + DVec3::new(0.0, 0.0, 0.5);
    assert_eq!(collar_turn(SHOULDER, target, SHOULDER.distance(target)), CollarTurn::Unneeded);
}

#[test]
fn a_shoulder_or_a_target_at_the_collar_is_degenerate_unless_within_reach() {
    assert_eq!(collar_turn(DVec3::ZERO, DVec3::X, 0.5), CollarTurn::Degenerate);
    assert_eq!(collar_turn(DVec3::X, DVec3::ZERO, 0.5), CollarTurn::Degenerate);
    assert_eq!(collar_turn(DVec3::ZERO, DVec3::X, 1.5), CollarTurn::Unneeded);
    assert_eq!(collar_turn(DVec3::ZERO, DVec3::ZERO, 0.0), CollarTurn::Unneeded);
}

#[test]
fn numbers_that_are_not_finite_and_a_negative_reach_are_degenerate() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_eq!(collar_turn(DVec3::new(bad, 0.0, 0.0), DVec3::X, 0.5), CollarTurn::Degenerate);
        assert_eq!(collar_turn(DVec3::X, DVec3::new(0.0, bad, 0.0), 0.5), CollarTurn::Degenerate);
    }
    assert_eq!(collar_turn(DVec3::X, DVec3::Y, f64::NAN), CollarTurn::Degenerate);
    assert_eq!(collar_turn(DVec3::X, DVec3::Y, -0.1), CollarTurn::Degenerate);
    assert_eq!(collar_turn(DVec3::X, DVec3::Y, f64::INFINITY), CollarTurn::Unneeded);
    assert_eq!(CollarTurn::Degenerate.rotation(), DQuat::IDENTITY);
}

fn raised(degrees: f64, way: DVec3) -> DVec3 {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    way * sine - DVec3::Y * cosine
}

#[test]
fn the_girdle_rises_by_a_third_of_each_degree_past_thirty_up_to_45() {
    for (arm, girdle) in [
        (0.0, 0.0),
        (29.9, 0.0),
        (30.0, 0.0),
        (60.0, 10.0),
        (90.0, 20.0),
        (150.0, 40.0),
        (165.0, 45.0),
        (180.0, 45.0),
    ] {
        for way in [DVec3::X, DVec3::Z, DVec3::new(0.6, 0.0, -0.8)] {
            let rise = Rhythm::INMAN.elevation(raised(arm, way) * 0.3, -DVec3::Y * 2.0).unwrap();
            assert!((rise.to_degrees() - girdle).abs() < 1e-12, "{arm}: {rise}");
        }
    }
}

#[test]
fn the_rhythm_is_continuous_and_never_falls_as_the_arm_rises() {
    let mut before = 0.0;
    for i in 0..=180_000 {
        let rise = Rhythm::INMAN.elevation(raised(f64::from(i) / 1000.0, DVec3::X), -DVec3::Y).unwrap();
        assert!((-1e-15..1e-5).contains(&(rise - before)), "{i}");
        before = rise;
    }
}

#[test]
fn a_rhythm_without_a_direction_has_no_answer() {
    for bad in [DVec3::ZERO, DVec3::NAN, DVec3::INFINITY] {
        assert_eq!(Rhythm::INMAN.elevation(bad, -DVec3::Y), None);
        assert_eq!(Rhythm::INMAN.elevation(DVec3::X, bad), None);
    }
    assert_eq!(Rhythm { share: f64::NAN, ..Rhythm::INMAN }.elevation(DVec3::X, -DVec3::Y), None);
}

proptest! {
    #[test]
    fn whatever_the_input_the_turn_is_a_rotation(
        shoulder in prop::array::uniform3(prop::num::f64::ANY), tame in any::<bool>(),
        target in prop::array::uniform3(prop::num::f64::ANY), reach in prop::num::f64::ANY,
    ) {
        let shoulder = if tame { SHOULDER } else { DVec3::from(shoulder) };
        let found = collar_turn(shoulder, DVec3::from(target), reach);
        prop_assert!(found.rotation().is_normalized(), "{:?}", found);
        if let CollarTurn::OutOfReach { residual, .. } = found {
            prop_assert!(residual.is_finite());
        }
    }
}
