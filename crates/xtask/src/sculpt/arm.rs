//! The arm from shoulder to wrist, as drawn: metres, the figure's left side, palm down, thumb to the front.

use glam::DVec3;
use rig::{Bone, Skeleton};

use super::field::{Part, Region};
use super::fit::Fit;
use super::fullness;
use super::physique::Physique;
use super::shape::Shape;

/// The drawn places along the arm.
pub fn fit(skeleton: &Skeleton) -> Fit {
    Fit::chain(
        skeleton,
        DVec3::X,
        &[
            (Bone::LeftShoulder, [0.022, 1.378, 0.025]),
            (Bone::LeftUpperArm, [0.172, 1.388, 0.0]),
            (Bone::LeftLowerArm, [0.452, 1.388, 0.0]),
            (Bone::LeftHand, [0.704, 1.388, 0.0]),
        ],
    )
}

/// Shoulder to wrist.
pub fn arm(skeleton: &Skeleton, physique: &Physique) -> Part {
    let f = fit(skeleton);
    let mut arm = Part::new(Region::Arm, 0.045);
    arm.add(0.0, limb(&f));
    shoulder(&f, &mut arm);
    let (tone, bone) = (fullness::tone(physique), fullness::bone(physique));
    upper(&f, tone, &mut arm);
    elbow(&f, bone, &mut arm);
    forearm(&f, tone, &mut arm);
    fullness::arm(&f, physique, &mut arm);
    arm
}

fn limb(f: &Fit) -> Shape {
    // Place: lower and upper edge (from the joints' height), back and front edge, squareness.
    let rows = [
        (0.150, -0.0400, 0.0280, -0.0440, 0.0440, 0.0),
        (0.190, -0.0450, 0.0350, -0.0470, 0.0460, 0.05),
        (0.240, -0.0430, 0.0400, -0.0465, 0.0450, 0.1),
        (0.300, -0.0385, 0.0385, -0.0425, 0.0415, 0.1),
        (0.360, -0.0355, 0.0355, -0.0395, 0.0385, 0.1),
        (0.410, -0.0340, 0.0340, -0.0370, 0.0350, 0.1),
        (0.452, -0.0345, 0.0345, -0.0355, 0.0325, 0.15),
        (0.490, -0.0350, 0.0355, -0.0330, 0.0345, 0.1),
        (0.530, -0.0335, 0.0340, -0.0320, 0.0360, 0.05),
        (0.580, -0.0300, 0.0300, -0.0305, 0.0350, 0.05),
        (0.630, -0.0250, 0.0245, -0.0280, 0.0315, 0.15),
        (0.680, -0.0200, 0.0195, -0.0255, 0.0280, 0.25),
        (0.730, -0.0185, 0.0175, -0.0255, 0.0275, 0.3),
    ];
    let knots = rows.map(|(x, low, high, back, front, square)| {
        let (y, tall) = (0.5 * (high + low), 0.5 * (high - low));
        let (z, deep) = (0.5 * (front + back), 0.5 * (front - back));
        (x, [y, z, tall, tall, deep, deep, square])
    });
    f.limb([0.172, 1.388, 0.0], DVec3::Y, DVec3::Z, 0.015, &knots)
}

/// The shoulder muscle with its three heads; breast and back run into the arm before and behind the pit.
fn shoulder(f: &Fit, arm: &mut Part) {
    arm.add(0.03, f.egg([0.212, 1.390, 0.000], [0.086, 0.042, 0.046], [1.0, -0.02, 0.0], [0.0, 1.0, 0.0]));
    arm.add(0.03, f.egg([0.200, 1.387, 0.027], [0.080, 0.036, 0.026], [1.0, 0.0, -0.14], [0.0, 1.0, 0.0]));
    arm.add(0.03, f.egg([0.200, 1.387, -0.029], [0.078, 0.036, 0.026], [1.0, 0.0, 0.16], [0.0, 1.0, 0.0]));
    arm.add(0.04, f.cone([0.090, 1.318, 0.046], 0.030, [0.215, 1.374, 0.022], 0.016));
    arm.add(0.04, f.cone([0.104, 1.318, -0.044], 0.026, [0.212, 1.372, -0.024], 0.017));
    // The bone's corner on top, the dip behind it, the muscle's pointed end.
    arm.swell(0.002, f.ball([0.165, 1.424, -0.010], [0.028, 0.024, 0.024]));
    arm.swell(
        -0.0035,
        f.ridge(&[
            [0.225, 1.352, 0.052, 0.024],
            [0.255, 1.385, 0.052, 0.026],
            [0.300, 1.418, 0.028, 0.026],
            [0.335, 1.428, 0.000, 0.022],
        ]),
    );
    arm.swell(
        -0.0035,
        f.ridge(&[
            [0.225, 1.350, -0.052, 0.024],
            [0.255, 1.385, -0.052, 0.026],
            [0.295, 1.418, -0.030, 0.026],
            [0.335, 1.428, -0.004, 0.022],
        ]),
    );
    arm.swell(
        -0.0015,
        f.ridge(&[[0.170, 1.425, 0.030, 0.018], [0.220, 1.425, 0.030, 0.020], [0.270, 1.422, 0.018, 0.018]]),
    );
    arm.swell(
        -0.0015,
        f.ridge(&[
            [0.170, 1.425, -0.034, 0.018],
            [0.220, 1.425, -0.032, 0.020],
            [0.270, 1.422, -0.018, 0.018],
        ]),
    );
}

/// Biceps in front, triceps behind, the furrows between them.
fn upper(f: &Fit, tone: f64, arm: &mut Part) {
    arm.swell(
        tone * 0.0065,
        f.egg([0.342, 1.386, 0.036], [0.095, 0.044, 0.040], [1.0, 0.0, -0.05], [0.0, 1.0, 0.0]),
    );
    arm.swell(
        tone * 0.003,
        f.egg([0.330, 1.400, 0.034], [0.080, 0.026, 0.030], [1.0, 0.0, -0.05], [0.0, 1.0, 0.0]),
    );
    arm.swell(
        tone * 0.006,
        f.egg([0.300, 1.374, -0.038], [0.095, 0.040, 0.040], [1.0, 0.0, 0.05], [0.0, 1.0, 0.0]),
    );
    arm.swell(
        tone * 0.005,
        f.egg([0.320, 1.406, -0.032], [0.085, 0.034, 0.036], [1.0, 0.0, 0.05], [0.0, 1.0, 0.0]),
    );
    arm.swell(
        -tone * 0.003,
        f.ridge(&[
            [0.345, 1.395, -0.044, 0.018],
            [0.395, 1.390, -0.040, 0.022],
            [0.445, 1.388, -0.038, 0.020],
        ]),
    );
    arm.swell(
        -tone * 0.0045,
        f.ridge(&[
            [0.230, 1.346, 0.004, 0.022],
            [0.310, 1.348, 0.002, 0.026],
            [0.380, 1.352, 0.004, 0.026],
            [0.440, 1.354, 0.010, 0.020],
        ]),
    );
    arm.swell(
        -tone * 0.003,
        f.ridge(&[[0.300, 1.428, 0.006, 0.020], [0.360, 1.424, 0.004, 0.024], [0.420, 1.420, 0.002, 0.020]]),
    );
}

/// The elbow's tip between the two knobs of the upper arm's bone, the hollow in front of it.
fn elbow(f: &Fit, bone: f64, arm: &mut Part) {
    arm.add(
        0.020,
        f.egg([0.456, 1.3885, -0.0290], [0.0200, 0.0125, 0.0090], [1.0, 0.0, 0.1], [0.0, 1.0, 0.0]),
    );
    arm.swell(bone * 0.0035, f.ball([0.447, 1.354, -0.006], [0.036, 0.026, 0.028]));
    arm.swell(bone * 0.0022, f.ball([0.452, 1.422, -0.008], [0.030, 0.022, 0.022]));
    arm.swell(
        -bone * 0.0008,
        f.ridge(&[
            [0.425, 1.367, -0.034, 0.020],
            [0.456, 1.367, -0.034, 0.023],
            [0.495, 1.372, -0.034, 0.020],
        ]),
    );
    arm.swell(
        -bone * 0.0025,
        f.ridge(&[
            [0.420, 1.410, -0.030, 0.020],
            [0.456, 1.410, -0.030, 0.023],
            [0.495, 1.404, -0.032, 0.020],
        ]),
    );
    arm.swell(
        -bone * 0.0035,
        f.egg([0.458, 1.386, 0.036], [0.055, 0.034, 0.030], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
    );
}

/// Outer muscles from above the elbow over to the thumb, inner ones to the palm; the edge of the bone behind; wrist.
fn forearm(f: &Fit, tone: f64, arm: &mut Part) {
    arm.swell(
        tone * 0.0065,
        f.ridge(&[
            [0.395, 1.412, 0.010, 0.026],
            [0.455, 1.412, 0.020, 0.036],
            [0.520, 1.404, 0.032, 0.038],
            [0.590, 1.395, 0.034, 0.030],
            [0.670, 1.390, 0.028, 0.020],
        ]),
    );
    arm.swell(
        tone * 0.0050,
        f.ridge(&[
            [0.440, 1.420, -0.006, 0.024],
            [0.510, 1.420, -0.006, 0.034],
            [0.580, 1.414, -0.006, 0.032],
            [0.670, 1.404, -0.002, 0.022],
        ]),
    );
    arm.swell(
        tone * 0.0075,
        f.ridge(&[
            [0.430, 1.356, -0.002, 0.024],
            [0.500, 1.354, 0.004, 0.040],
            [0.570, 1.360, 0.008, 0.036],
            [0.660, 1.370, 0.006, 0.024],
        ]),
    );
    arm.swell(
        tone * 0.0030,
        f.ridge(&[
            [0.460, 1.372, -0.026, 0.022],
            [0.530, 1.370, -0.026, 0.030],
            [0.620, 1.376, -0.022, 0.024],
        ]),
    );
    arm.swell(
        -tone * 0.0015,
        f.ridge(&[
            [0.480, 1.398, -0.034, 0.016],
            [0.550, 1.400, -0.032, 0.018],
            [0.620, 1.400, -0.028, 0.016],
            [0.680, 1.402, -0.022, 0.012],
        ]),
    );
    arm.swell(
        -tone * 0.0015,
        f.ridge(&[[0.470, 1.378, 0.038, 0.018], [0.540, 1.374, 0.038, 0.020], [0.620, 1.374, 0.030, 0.018]]),
    );
    arm.swell(
        -tone * 0.0012,
        f.ridge(&[[0.470, 1.424, 0.010, 0.016], [0.540, 1.420, 0.014, 0.018], [0.620, 1.412, 0.014, 0.016]]),
    );
    // Wrist: the two bones' heads, the cords on the palm side.
    arm.add(
        0.012,
        f.egg([0.6890, 1.3995, -0.0165], [0.0130, 0.0080, 0.0090], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
    );
    arm.swell(tone * 0.0020, f.ball([0.694, 1.390, 0.027], [0.022, 0.014, 0.014]));
    arm.swell(
        tone * 0.0014,
        f.ridge(&[[0.630, 1.366, 0.003, 0.010], [0.680, 1.369, 0.003, 0.009], [0.720, 1.370, 0.003, 0.009]]),
    );
}
