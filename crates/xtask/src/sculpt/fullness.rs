//! How trunk and limbs differ with sex, build, muscle and age: the neutral skin raised and lowered over wide places.
//!
//! All amounts are in millimetres and follow each number of the physique in a straight line on either side of 0.

use super::field::Part;
use super::fit::Fit;
use super::physique::{Ends, Physique};
use super::shape::Shape;

/// How clearly muscles part under the skin, 1 in the neutral adult.
pub fn tone(physique: &Physique) -> f64 {
    let e = physique.ends();
    let tone = 1.0 + 0.6 * e.muscle + 0.15 * e.male - 0.35 * e.female + 0.15 * e.slender
        - 0.55 * e.heavy
        - 0.65 * e.child
        - 0.15 * e.old;
    tone.clamp(0.1, 2.0)
}

/// How clearly bones show under the skin, 1 in the neutral adult.
pub fn bone(physique: &Physique) -> f64 {
    let e = physique.ends();
    let bone = 1.0 + 0.10 * e.male - 0.25 * e.female + 0.35 * e.slender - 0.50 * e.heavy - 0.65 * e.child
        + 0.40 * e.old;
    bone.clamp(0.1, 2.0)
}

/// Raises by so many millimetres, on the middle plane without a crease.
fn raise(part: &mut Part, millimetres: f64, shape: Shape) {
    if millimetres != 0.0 {
        part.swell(millimetres * 0.001, shape);
        part.meeting(0.010);
    }
}

/// Breasts, breast muscle and rib cage.
pub fn chest(f: &Fit, physique: &Physique, part: &mut Part) {
    let e = physique.ends();
    if e.female > 0.0 {
        // They rise from within the rib cage, so that nothing shows at 0.
        let z = 0.010 + 0.066 * e.female;
        part.add(0.032, f.egg([0.079, 1.246, z], [0.062, 0.060, 0.058], [1.0, 0.1, -0.40], [0.0, 1.0, 0.2]));
        part.meeting(0.006);
        part.swell(
            0.006 * e.female,
            f.egg([0.074, 1.300, 0.095], [0.060, 0.060, 0.060], [1.0, 0.0, -0.3], [0.0, 1.0, 0.0]),
        );
    }
    let Ends { male, female, heavy, slender, muscle, child, old } = e;
    raise(
        part,
        5.0 * male - 3.0 * female + 12.0 * muscle - 3.0 * child - 6.0 * old,
        f.egg([0.082, 1.290, 0.085], [0.105, 0.072, 0.075], [1.0, 0.3, -0.4], [0.0, 1.0, 0.0]),
    );
    raise(
        part,
        5.0 * heavy - 3.0 * slender + 3.0 * child + 5.0 * old,
        f.egg([0.080, 1.238, 0.088], [0.090, 0.060, 0.070], [1.0, 0.2, -0.4], [0.0, 1.0, 0.0]),
    );
    raise(
        part,
        7.0 * male - 8.0 * female + 9.0 * heavy - 4.0 * slender - 5.0 * child - 3.0 * old,
        f.egg([0.140, 1.230, -0.005], [0.150, 0.090, 0.120], [0.05, 1.0, 0.0], [1.0, 0.0, 0.0]),
    );
    raise(part, 12.0 * heavy, f.ball([0.060, 1.230, 0.080], [0.150, 0.130, 0.095]));
}

/// Back: its broad muscle and trapezius, the bent upper spine of age.
pub fn back(f: &Fit, physique: &Physique, part: &mut Part) {
    let Ends { male, female, heavy, slender, muscle, child, old } = physique.ends();
    raise(
        part,
        4.0 * male - 4.0 * female + 15.0 * muscle + 10.0 * heavy - 3.0 * slender - 4.0 * child - 3.0 * old,
        f.egg([0.128, 1.270, -0.055], [0.120, 0.070, 0.075], [0.2, 1.0, 0.0], [1.0, 0.0, 0.4]),
    );
    raise(
        part,
        4.0 * male - 4.0 * female + 10.0 * muscle + 5.0 * heavy - 2.0 * slender - 4.0 * child - 2.0 * old,
        f.ridge(&[
            [0.035, 1.490, -0.050, 0.050],
            [0.080, 1.440, -0.035, 0.058],
            [0.165, 1.415, -0.020, 0.055],
        ]),
    );
    raise(
        part,
        13.0 * old + 8.0 * heavy - 3.0 * slender,
        f.ball([0.0, 1.365, -0.090], [0.130, 0.120, 0.080]),
    );
    raise(
        part,
        16.0 * heavy - 3.0 * slender + 2.0 * child,
        f.ball([0.050, 1.110, -0.065], [0.130, 0.110, 0.080]),
    );
}

/// Waist and belly.
pub fn belly(f: &Fit, physique: &Physique, part: &mut Part) {
    let Ends { male, female, heavy, slender, muscle, child, old } = physique.ends();
    raise(
        part,
        37.0 * heavy - 6.0 * slender - 2.0 * muscle + 13.0 * child + 12.0 * old,
        f.ball([0.0, 1.035, 0.085], [0.160, 0.150, 0.110]),
    );
    raise(part, 4.0 * female + 10.0 * heavy + 4.0 * old, f.ball([0.0, 0.960, 0.085], [0.120, 0.090, 0.080]));
    raise(
        part,
        8.0 * male - 10.0 * female + 27.0 * heavy - 8.0 * slender + 3.0 * child + 4.0 * old,
        f.egg([0.130, 1.095, 0.005], [0.130, 0.090, 0.120], [0.05, 1.0, 0.0], [1.0, 0.0, 0.0]),
    );
    raise(
        part,
        16.0 * heavy,
        f.egg([0.135, 1.035, -0.010], [0.100, 0.085, 0.130], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]),
    );
}

/// Hips and seat: trunk and thigh both have them, so that they stay where the two join.
pub fn hips(f: &Fit, physique: &Physique, part: &mut Part) {
    let Ends { male, female, heavy, slender, muscle, child, old } = physique.ends();
    raise(
        part,
        -7.0 * male + 11.0 * female + 20.0 * heavy - 7.0 * slender - 5.0 * child - 2.0 * old,
        f.egg([0.160, 0.915, -0.005], [0.170, 0.090, 0.120], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]),
    );
    raise(
        part,
        -3.0 * male + 7.0 * female + 18.0 * heavy - 7.0 * slender + 5.0 * muscle - 6.0 * child - 11.0 * old,
        f.ball([0.085, 0.900, -0.105], [0.095, 0.095, 0.080]),
    );
    raise(part, 5.0 * old + 4.0 * heavy, f.ball([0.080, 0.838, -0.095], [0.070, 0.040, 0.055]));
}

/// Thigh and calf.
pub fn leg(f: &Fit, physique: &Physique, part: &mut Part) {
    let Ends { male, female, heavy, slender, muscle, child, old } = physique.ends();
    let bulk = -2.0 * male + 3.0 * female + 20.0 * heavy - 7.0 * slender - 1.0 * child - 7.0 * old;
    raise(
        part,
        bulk + 13.0 * muscle,
        f.ridge(&[
            [0.110, 0.880, 0.080, 0.100],
            [0.118, 0.740, 0.082, 0.110],
            [0.105, 0.600, 0.070, 0.090],
            [0.096, 0.470, 0.050, 0.060],
        ]),
    );
    raise(
        part,
        bulk + 7.0 * muscle,
        f.ridge(&[
            [0.110, 0.850, -0.065, 0.090],
            [0.112, 0.720, -0.062, 0.095],
            [0.100, 0.590, -0.052, 0.080],
            [0.092, 0.470, -0.044, 0.060],
        ]),
    );
    // Inside there is little room.
    raise(
        part,
        1.0 * female + 2.5 * heavy - 5.0 * slender - 4.0 * old + 0.5 * muscle,
        f.ridge(&[
            [0.018, 0.800, -0.010, 0.070],
            [0.022, 0.720, 0.000, 0.070],
            [0.032, 0.620, 0.000, 0.060],
            [0.040, 0.520, 0.000, 0.050],
        ]),
    );
    raise(
        part,
        6.0 * heavy - 3.0 * slender + 2.0 * female - male - 2.0 * old + 3.0 * child,
        f.ball([0.086, 0.490, 0.000], [0.100, 0.090, 0.100]),
    );
    raise(
        part,
        -2.0 * female + 2.0 * male + 11.0 * heavy - 4.0 * slender + 8.0 * muscle - 3.0 * child - 6.0 * old,
        f.ridge(&[
            [0.086, 0.460, -0.050, 0.080],
            [0.086, 0.380, -0.056, 0.090],
            [0.086, 0.300, -0.050, 0.085],
            [0.086, 0.160, -0.036, 0.060],
        ]),
    );
    raise(
        part,
        4.0 * heavy - 2.0 * slender + 1.5 * male - 2.0 * female + 2.0 * child,
        f.ridge(&[
            [0.086, 0.380, 0.0, 0.080],
            [0.086, 0.230, 0.0, 0.080],
            [0.086, 0.100, 0.0, 0.075],
            [0.086, 0.040, 0.0, 0.070],
        ]),
    );
}

/// Shoulder, upper arm and forearm.
pub fn arm(f: &Fit, physique: &Physique, part: &mut Part) {
    let Ends { male, female, heavy, slender, muscle, child, old } = physique.ends();
    raise(
        part,
        5.0 * male - 6.0 * female + 14.0 * muscle + 9.0 * heavy - 4.0 * slender - 5.0 * child - 5.0 * old,
        f.egg([0.215, 1.410, 0.000], [0.110, 0.060, 0.075], [1.0, -0.1, 0.0], [0.0, 1.0, 0.0]),
    );
    let bulk = 2.0 * male - 2.0 * female + 14.0 * heavy - 5.0 * slender - 2.0 * child - 6.0 * old;
    raise(
        part,
        bulk + 11.0 * muscle,
        f.ridge(&[[0.200, 1.386, 0.034, 0.060], [0.320, 1.386, 0.038, 0.064], [0.440, 1.386, 0.034, 0.056]]),
    );
    raise(
        part,
        bulk + 11.0 * muscle + 3.0 * old,
        f.ridge(&[
            [0.190, 1.366, -0.034, 0.062],
            [0.310, 1.370, -0.036, 0.066],
            [0.440, 1.384, -0.034, 0.056],
        ]),
    );
    raise(
        part,
        3.0 * male - 3.0 * female + 7.0 * muscle + 7.0 * heavy - 3.0 * slender - 2.0 * child - 4.0 * old,
        f.ridge(&[[0.400, 1.396, 0.018, 0.056], [0.520, 1.392, 0.020, 0.066], [0.690, 1.389, 0.012, 0.048]]),
    );
    raise(
        part,
        2.0 * male - 3.0 * female + 6.0 * muscle + 6.0 * heavy - 3.0 * slender - 2.0 * child - 4.0 * old,
        f.ridge(&[
            [0.410, 1.372, -0.012, 0.056],
            [0.530, 1.374, -0.012, 0.062],
            [0.700, 1.386, -0.008, 0.048],
        ]),
    );
    // The wrist.
    raise(
        part,
        1.5 * male - 1.5 * female + 2.5 * heavy - 1.5 * slender + child,
        f.egg([0.690, 1.388, 0.0], [0.070, 0.045, 0.050], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
    );
}
