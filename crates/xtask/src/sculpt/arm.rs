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
        (0.105, -0.0220, 0.0110, -0.0240, 0.0240, 0.0),
        (0.150, -0.0445, 0.0215, -0.0440, 0.0440, 0.0),
        (0.190, -0.0555, 0.0300, -0.0475, 0.0465, 0.3),
        (0.240, -0.0565, 0.0390, -0.0475, 0.0460, 0.4),
        (0.300, -0.0471, 0.0411, -0.0456, 0.0446, 0.35),
        (0.360, -0.0392, 0.0392, -0.0432, 0.0422, 0.1),
        (0.410, -0.0359, 0.0359, -0.0389, 0.0369, 0.1),
        (0.452, -0.0361, 0.0361, -0.0371, 0.0341, 0.15),
        (0.490, -0.0369, 0.0374, -0.0349, 0.0364, 0.1),
        (0.530, -0.0357, 0.0362, -0.0342, 0.0382, 0.05),
        (0.580, -0.0315, 0.0315, -0.0320, 0.0365, 0.05),
        (0.630, -0.0268, 0.0263, -0.0298, 0.0333, 0.15),
        (0.670, -0.0226, 0.0221, -0.0272, 0.0300, 0.2),
        (0.695, -0.0196, 0.0190, -0.0246, 0.0268, 0.3),
        (0.715, -0.0145, 0.0135, -0.0190, 0.0215, 0.3),
        (0.735, -0.0090, 0.0080, -0.0130, 0.0150, 0.3),
    ];
    // Below the shoulder it is so deep that a hanging arm lies against the ribs.
    let knots = rows.map(|(x, low, high, back, front, square)| {
        let (y, tall) = (0.5 * (high + low), 0.5 * (high - low));
        let (z, deep) = (0.5 * (front + back), 0.5 * (front - back));
        (x, [y, z, tall, tall, deep, deep, square])
    });
    f.limb([0.172, 1.388, 0.0], DVec3::Y, DVec3::Z, 0.015, &knots)
}

/// The shoulder muscle with its three heads; breast and back run into the arm before and behind the pit.
fn shoulder(f: &Fit, arm: &mut Part) {
    arm.add(0.03, f.egg([0.224, 1.386, 0.000], [0.084, 0.0430, 0.047], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]));
    arm.add(0.03, f.egg([0.210, 1.383, 0.028], [0.080, 0.035, 0.026], [1.0, 0.0, -0.14], [0.0, 1.0, 0.0]));
    arm.add(0.03, f.egg([0.210, 1.383, -0.030], [0.078, 0.035, 0.026], [1.0, 0.0, 0.16], [0.0, 1.0, 0.0]));
    arm.add(0.04, f.cone([0.096, 1.316, 0.050], 0.032, [0.228, 1.367, 0.028], 0.018));
    arm.add(0.04, f.cone([0.108, 1.318, -0.046], 0.029, [0.224, 1.368, -0.028], 0.018));
    // What lies against the ribs beside the pit of a hanging arm, and shuts it.
    for z in [0.040, -0.040] {
        arm.swell(0.013, f.ball([0.197, 1.332, z], [0.042, 0.036, 0.036]));
        arm.swell(0.007, f.ball([0.224, 1.336, z], [0.044, 0.036, 0.036]));
    }
    // The bone's corner on top, the dip behind it, the muscle's pointed end.
    arm.swell(0.002, f.ball([0.160, 1.418, -0.010], [0.028, 0.024, 0.024]));
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
