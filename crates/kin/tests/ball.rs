//! Ball joints: angles and rotations are inverse to each other, from the tiniest turn to a half turn.

use std::f64::consts::PI;

use glam::{DQuat, DVec3};
use kin::{Ball, swing_twist};
use proptest::prelude::*;
use seeded::Seeded;

mod seeded;

/// A left upper arm: bone along +x, axes in any of the four handednesses a figure can have.
fn balls() -> [Ball; 4] {
    let left = Ball { flexion: -DVec3::Y, abduction: DVec3::Z, twist: DVec3::X };
    let right = Ball { flexion: DVec3::Y, abduction: -DVec3::Z, twist: DVec3::X };
    let turn = DQuat::from_scaled_axis(DVec3::new(0.3, -1.1, 2.0));
    let askew = Ball { flexion: turn * DVec3::X, abduction: turn * DVec3::Z, twist: turn * DVec3::Y };
    [left, right, askew, Ball { twist: -askew.twist, ..askew }]
}

/// Angle between two rotations, accurate for small ones.
fn apart(a: DQuat, b: DQuat) -> f64 {
    let d = a.conjugate() * b;
    2.0 * DVec3::new(d.x, d.y, d.z).length().atan2(d.w.abs())
}

#[test]
fn angles_come_back_from_their_rotation_to_1e12_below_a_swing_of_3_1() {
    let mut lots = Seeded(1);
    let mut worst = 0.0_f64;
    for i in 0..400_000 {
        let ball = balls()[i % 4];
        // Every fourth swing is tiny: down to 1e-18.
        let size = if i % 16 < 4 { 10.0_f64.powf(lots.between(-18.0, 0.0)) } else { lots.between(0.0, 3.1) };
        let (way, twist) = (lots.between(-PI, PI), lots.between(1e-4 - PI, PI - 1e-4));
        let given = [size * way.cos(), size * way.sin(), twist];
        let q = ball.rotation(given[0], given[1], given[2]);
        for q in [q, -q] {
            let got = ball.angles(q);
            let error = (0..3).map(|k| (got[k] - given[k]).abs()).fold(0.0, f64::max);
            worst = worst.max(error);
            assert!(error < 1e-12, "{given:?} came back as {got:?}");
        }
    }
    // Far below the promise, or the promise is about to break.
    assert!(worst < 1e-13, "{worst:e}");
}

#[test]
fn tiny_angles_keep_their_relative_accuracy() {
    for ball in balls() {
        for exponent in [-3, -8, -9, -12, -100, -140] {
            let size = 10.0_f64.powi(exponent);
            let [f, a, _] = ball.angles(ball.rotation(0.8 * size, -0.6 * size, 0.0));
            assert!((f / size - 0.8).abs() < 1e-14 && (a / size + 0.6).abs() < 1e-14, "{exponent}: {f} {a}");
        }
        assert_eq!(ball.angles(ball.rotation(0.0, 0.0, 0.0)), [0.0; 3]);
        assert_eq!(ball.angles(-DQuat::IDENTITY), [0.0; 3]);
    }
}

#[test]
fn q_and_minus_q_have_the_same_angles_even_at_half_turns() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let special = [
        (1.0, 0.0, 0.0, 0.0),
        (-1.0, 0.0, 0.0, 0.0),
        (0.0, 1.0, 0.0, 0.0),
        (0.0, -1.0, 0.0, 0.0),
        (0.0, 0.0, 1.0, 0.0),
        (half, half, 0.0, 0.0),
        (half, -half, 0.0, 0.0),
        (half, 0.0, -half, 0.0),
        (0.0, half, half, 0.0),
        (0.5, 0.5, 0.5, 0.5),
        (0.5, -0.5, 0.5, -0.5),
        (1.0, 0.0, 0.0, -1e-17),
        (0.0, -1.0, 0.0, -1e-17),
    ];
    for ball in balls() {
        for (x, y, z, w) in special {
            let q = DQuat::from_xyzw(x, y, z, w).normalize();
            let angles = ball.angles(q);
            assert_eq!(angles, ball.angles(-q), "{q}");
            assert!(-PI < angles[2] && angles[2] <= PI, "{angles:?}");
            let off = apart(ball.rotation(angles[0], angles[1], angles[2]), q);
            assert!(off < 1e-14, "{q} {angles:?} {off:e}");
        }
    }
}

#[test]
fn a_swing_of_exactly_pi_has_no_twist() {
    let ball = Ball { flexion: DVec3::X, abduction: DVec3::Z, twist: DVec3::Y };
    assert_eq!(ball.angles(DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0)), [PI, 0.0, 0.0]);
    assert_eq!(ball.angles(DQuat::from_xyzw(-1.0, 0.0, 0.0, -0.0)), [PI, 0.0, 0.0]);
    assert_eq!(ball.angles(DQuat::from_xyzw(0.0, 0.0, -1.0, 0.0)), [0.0, PI, 0.0]);
}

#[test]
fn a_twist_of_minus_pi_reads_as_pi() {
    let ball = Ball { flexion: DVec3::X, abduction: DVec3::Z, twist: DVec3::Y };
    for y in [1.0, -1.0] {
        for w in [0.0, -0.0, 1e-17, -1e-17, 1e-300] {
            assert_eq!(ball.angles(DQuat::from_xyzw(0.0, y, 0.0, w)), [0.0, 0.0, PI], "{y} {w}");
        }
    }
}

#[test]
fn a_swing_beyond_a_half_turn_is_the_same_rotation_the_other_way() {
    for ball in balls() {
        let q = ball.rotation(4.0, -1.0, 0.4);
        let [f, a, t] = ball.angles(q);
        assert!(f.hypot(a) <= PI + 1e-15);
        assert!(apart(ball.rotation(f, a, t), q) < 1e-14);
    }
}

#[test]
fn the_length_of_a_quaternion_does_not_matter() {
    let ball = balls()[2];
    let q = ball.rotation(0.7, -1.9, 2.2);
    for scale in [1e-100, 0.5, 1.0 + 1e-9, 3.0, 1e100] {
        let (got, given) = (ball.angles(q * scale), [0.7, -1.9, 2.2]);
        assert!((0..3).all(|k| (got[k] - given[k]).abs() < 1e-14), "{scale}: {got:?}");
    }
}

#[test]
fn nan_goes_through_without_a_panic_and_zero_gives_zeros() {
    let ball = balls()[0];
    assert!(ball.angles(DQuat::from_xyzw(f64::NAN, 0.0, 0.0, 1.0)).iter().any(|a| a.is_nan()));
    assert_eq!(ball.angles(DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0)), [0.0; 3]);
    assert!(!ball.rotation(f64::INFINITY, 0.0, 0.0).is_finite());
}

proptest! {
    #[test]
    fn any_rotation_is_its_swing_times_its_twist(
        v in prop::array::uniform4(-1.0..1.0_f64), axis in prop::array::uniform3(-1.0..1.0_f64),
    ) {
        let axis = DVec3::from(axis).try_normalize();
        let q = DQuat::from_array(v);
        prop_assume!(axis.is_some() && q.length() > 1e-3);
        let (axis, q) = (axis.unwrap(), q.normalize());
        let (swing, twist) = swing_twist(q, axis);
        prop_assert!(apart(swing * DQuat::from_axis_angle(axis, twist), q) < 1e-14);
        prop_assert!(swing.w >= 0.0 && swing.is_normalized());
        prop_assert!(DVec3::new(swing.x, swing.y, swing.z).dot(axis).abs() < 1e-15);
        prop_assert!(-PI < twist && twist <= PI);
    }
}
