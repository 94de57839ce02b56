//! The angle of a vector in the plane, for the dozen angles that bending a leg asks for: an arc tangent without a call.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// The angle of the vector `(x, y)`, radians, from -pi to pi.
///
/// The same as `y.atan2(x)` to the last bit or two, and exactly the same where a part is 0, infinite or no number. An
/// opposite `y` gives the opposite angle.
#[inline]
pub fn arc_tangent(y: f64, x: f64) -> f64 {
    let (high, wide) = (y.abs(), x.abs());
    let (less, more) = if high < wide { (high, wide) } else { (wide, high) };
    if !(less > SMALLEST && more < LARGEST) {
        return y.atan2(x);
    }
    // Of the eight parts of the circle the first; beyond half of it the angle from its end, so that one division does.
    let beyond = less > TAN_PI_8 * more;
    let (sine, cosine) = if beyond { (less - more, less + more) } else { (less, more) };
    let t = sine / cosine;
    let angle = t - t * series(t * t);
    let eighths = usize::from(beyond);
    let (eighths, angle) = if high < wide { (eighths, angle) } else { (2 - eighths, -angle) };
    let (eighths, angle) = if x < 0.0 { (4 - eighths, -angle) } else { (eighths, angle) };
    (EIGHTHS[eighths].0 + (EIGHTHS[eighths].1 + angle)).copysign(y)
}

/// The terms' sum times `z`; every other power apart, so that neither waits for the other.
#[inline(always)]
fn series(z: f64) -> f64 {
    let w = z * z;
    let odd = TERMS.iter().step_by(2).rev().fold(0.0, |sum, term| sum * w + term);
    let even = TERMS.iter().skip(1).step_by(2).rev().fold(0.0, |sum, term| sum * w + term);
    z * odd + w * even
}

/// Parts between which products and quotients are numbers with all their bits.
const SMALLEST: f64 = 1e-140;
const LARGEST: f64 = 1e140;

const TAN_PI_8: f64 = 0.414_213_562_373_095_03;

/// Eighths of a turn, each in two parts.
const EIGHTHS: [(f64, f64); 5] = [
    (0.0, 0.0),
    (FRAC_PI_4, 3.061_616_997_868_383e-17),
    (FRAC_PI_2, 6.123_233_995_736_766e-17),
    (2.356_194_490_192_345, 9.184_850_993_605_148e-17),
    (PI, 1.224_646_799_147_353_2e-16),
];

/// Terms of -x^3, -x^5 and on, divided by x^3: those of fdlibm, good to an angle of 0.41.
const TERMS: [f64; 11] = [
    3.333_333_333_333_293e-1,
    -1.999_999_999_987_648_3e-1,
    1.428_571_427_250_346_6e-1,
    -1.111_111_040_546_235_6e-1,
    9.090_887_133_436_507e-2,
    -7.691_876_205_044_83e-2,
    6.661_073_137_387_531e-2,
    -5.833_570_133_790_573_5e-2,
    4.976_877_994_615_932e-2,
    -3.653_157_274_421_691_6e-2,
    1.628_582_011_536_578_2e-2,
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_are_those_of_the_standard_library() {
        for i in -300_000..=300_000 {
            let angle = f64::from(i) * 1.05e-5;
            for length in [1.0, 3e-9, 7e20] {
                let (y, x) = (length * angle.sin(), length * angle.cos());
                let (got, wanted) = (arc_tangent(y, x), y.atan2(x));
                assert!((got - wanted).abs() <= 3e-16 * wanted.abs(), "{y} {x}: {got} {wanted}");
                assert_eq!(arc_tangent(-y, x), -got);
            }
        }
    }

    #[test]
    fn small_angles_keep_their_bits() {
        for i in 1..60 {
            let y = 0.7_f64.powi(5 * i);
            let (got, wanted) = (arc_tangent(y, 1.3), y.atan2(1.3));
            assert!((got - wanted).abs() <= 3e-16 * wanted, "{y}: {got} {wanted}");
        }
    }

    #[test]
    fn odd_numbers_give_what_the_standard_library_gives() {
        let odd = [0.0, -0.0, 1.0, -1.0, 1e-300, -1e300, f64::INFINITY, f64::NEG_INFINITY, f64::NAN];
        for y in odd {
            for x in odd {
                let (got, wanted) = (arc_tangent(y, x), y.atan2(x));
                assert!(
                    got.to_bits() == wanted.to_bits() || got.is_nan() && wanted.is_nan(),
                    "{y} {x}: {got}"
                );
            }
        }
    }
}
