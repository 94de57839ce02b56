//! The rotation about an axis, for the hundred joint angles of a figure: sine and cosine without a call.

use std::f64::consts::FRAC_PI_4;

use glam::{DQuat, DVec3};

/// The rotation by an angle in radians about a unit axis.
///
/// The same as `DQuat::from_axis_angle` to the last bit or two, and opposite angles give exactly opposite
/// turns. Most fingers are straight most of the time: an angle of 0 costs nothing. One that is not finite gives NaN.
#[inline(always)]
pub fn axis_angle(axis: DVec3, angle: f64) -> DQuat {
    if angle == 0.0 {
        return DQuat::IDENTITY;
    }
    let (sine, cosine) = sin_cos(0.5 * angle);
    let v = axis * sine;
    DQuat::from_xyzw(v.x, v.y, v.z, cosine)
}

/// The rotation of a rotation vector, axis times angle in radians.
#[inline(always)]
pub(crate) fn scaled_axis(v: DVec3) -> DQuat {
    let angle = v.length();
    if angle == 0.0 {
        return DQuat::IDENTITY;
    }
    let (sine, cosine) = sin_cos(0.5 * angle);
    let v = v * (sine / angle);
    DQuat::from_xyzw(v.x, v.y, v.z, cosine)
}

/// Sine and cosine: quarter turns taken off in two parts, then the polynomials of fdlibm.
#[inline(always)]
pub(crate) fn sin_cos(angle: f64) -> (f64, f64) {
    if angle.abs() <= FRAC_PI_4 {
        return near_zero(angle);
    }
    if angle.abs() > 8.0 || angle.is_nan() {
        return angle.sin_cos();
    }
    let quarters = (angle * std::f64::consts::FRAC_2_PI + ROUND) - ROUND;
    let (sine, cosine) = near_zero((angle - quarters * QUARTER[0]) - quarters * QUARTER[1]);
    match quarters as i32 & 3 {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// Adding this rounds a small number to a whole one.
const ROUND: f64 = 6_755_399_441_055_744.0;

/// A quarter turn in two parts; small multiples of the first are exact.
const QUARTER: [f64; 2] = [f64::from_bits(0x3FF9_21FB_5440_0000), 6.077_100_506_506_192e-11];

/// Sine and cosine up to an eighth of a turn either way.
#[inline(always)]
fn near_zero(x: f64) -> (f64, f64) {
    let z = x * x;
    let (sine, cosine) = (series(&SINE, z), series(&COSINE, z));
    let half = 0.5 * z;
    let first = 1.0 - half;
    (x + x * z * sine, first + ((1.0 - first - half) + z * z * cosine))
}

/// The sum of terms times ever higher powers of `z`, in pairs: the second and the third don't wait for the first.
#[inline(always)]
fn series(terms: &[f64; 6], z: f64) -> f64 {
    let w = z * z;
    (terms[0] + z * terms[1]) + w * ((terms[2] + z * terms[3]) + w * (terms[4] + z * terms[5]))
}

/// Terms of x^3, x^5 and on, divided by x^3.
const SINE: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_49e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];

/// Terms of x^4, x^6 and on, divided by x^4.
const COSINE: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_are_those_of_the_standard_library() {
        for i in -400_000..=400_000 {
            let angle = f64::from(i) * 4.3e-5;
            let ((s, c), (sine, cosine)) = (sin_cos(angle), angle.sin_cos());
            assert!((s - sine).abs() <= 2.3e-16 && (c - cosine).abs() <= 2.3e-16, "{angle}: {s} {c}");
            assert_eq!(sin_cos(-angle), (-s, c), "{angle}");
        }
    }

    #[test]
    fn multiples_of_a_quarter_turn_are_as_near_to_zero_as_they_should() {
        for i in 1..=5 {
            let angle = f64::from(i) * std::f64::consts::FRAC_PI_2;
            let ((s, c), (sine, cosine)) = (sin_cos(angle), angle.sin_cos());
            assert!((s - sine).abs() < 1e-16 && (c - cosine).abs() < 1e-16, "{angle}: {s} {c}");
        }
    }

    #[test]
    fn angles_without_end_or_number_give_nan_and_tiny_ones_themselves() {
        for angle in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(axis_angle(DVec3::X, angle).is_nan(), "{angle}");
        }
        assert_eq!(sin_cos(1e-300), (1e-300, 1.0));
        assert_eq!(axis_angle(DVec3::X, 0.0), DQuat::IDENTITY);
        assert_eq!(scaled_axis(DVec3::ZERO), DQuat::IDENTITY);
    }
}
