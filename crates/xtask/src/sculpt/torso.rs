//! Pelvis to collar, as drawn: metres, the figure's left half.

use glam::DVec3;
use rig::{Bone, Skeleton};

use super::field::{Part, Region};
use super::fit::Fit;
use super::fullness;
use super::physique::Physique;
use super::shape::Shape;

/// The drawn places of the spine.
pub fn fit(skeleton: &Skeleton) -> Fit {
    Fit::chain(
        skeleton,
        DVec3::Y,
        &[
            (Bone::Hips, [0.0, 0.94, 0.0]),
            (Bone::Spine, [0.0, 1.02, 0.0]),
            (Bone::Chest, [0.0, 1.164, 0.0]),
            (Bone::UpperChest, [0.0, 1.308, 0.0]),
            (Bone::Neck, [0.0, 1.452, 0.0]),
        ],
    )
}

/// The trunk without limbs.
pub fn part(skeleton: &Skeleton, physique: &Physique) -> Part {
    let f = fit(skeleton);
    let (tone, bone) = (fullness::tone(physique), fullness::bone(physique));
    let mut torso = Part::new(Region::Torso, 0.03);
    torso.add(0.0, trunk(&f));
    seat(&f, &mut torso);
    chest(&f, tone, &mut torso);
    shoulders(&f, &mut torso);
    belly(&f, tone, &mut torso);
    hips(&f, bone, &mut torso);
    groin(&f, &mut torso);
    back(&f, tone, bone, &mut torso);
    collar(&f, bone, &mut torso);
    seat_fold(&f, &mut torso);
    fullness::chest(&f, physique, &mut torso);
    fullness::back(&f, physique, &mut torso);
    fullness::belly(&f, physique, &mut torso);
    fullness::hips(&f, physique, &mut torso);
    torso
}

/// Ribs, waist and pelvis in one.
fn trunk(f: &Fit) -> Shape {
    // Height: back and front edge, half width, squareness.
    let rows = [
        (0.821, -0.050, 0.050, 0.045, 0.0),
        (0.846, -0.067, 0.068, 0.094, 0.1),
        (0.873, -0.077, 0.080, 0.134, 0.2),
        (0.910, -0.083, 0.087, 0.153, 0.25),
        (0.950, -0.084, 0.091, 0.1555, 0.3),
        (0.990, -0.0772, 0.0927, 0.1496, 0.3),
        (1.030, -0.0667, 0.0935, 0.1418, 0.3),
        (1.070, -0.0592, 0.0944, 0.1350, 0.3),
        (1.110, -0.0582, 0.0954, 0.1315, 0.3),
        (1.150, -0.0632, 0.0979, 0.1330, 0.3),
        (1.190, -0.0716, 0.1005, 0.1375, 0.3),
        (1.230, -0.081, 0.1015, 0.1420, 0.3),
        (1.270, -0.089, 0.0990, 0.1460, 0.42),
        (1.310, -0.094, 0.0920, 0.1460, 0.52),
        (1.350, -0.093, 0.0810, 0.1385, 0.45),
        (1.385, -0.088, 0.0690, 0.122, 0.2),
        (1.415, -0.080, 0.0570, 0.099, 0.15),
        (1.445, -0.069, 0.0450, 0.067, 0.1),
        (1.475, -0.051, 0.0300, 0.042, 0.0),
        // The end lies so deep in the neck that nothing of it shows.
        (1.500, -0.036, 0.0200, 0.026, 0.0),
        (1.525, -0.024, 0.0080, 0.014, 0.0),
    ];
    // u = +Z, v = +X, so that the axis is +Y.
    let knots = rows.map(|(y, back, front, w, square)| {
        let (middle, half) = (0.5 * (front + back), 0.5 * (front - back));
        (y, [middle, 0.0, half, half, w, w, square])
    });
    f.limb([0.0, 0.94, 0.0], DVec3::Z, DVec3::X, 0.02, &knots)
}

/// The seat: large muscle, its fold below, the cleft.
fn seat(f: &Fit, torso: &mut Part) {
    torso
        .add(0.06, f.egg([0.078, 0.903, -0.051], [0.079, 0.072, 0.062], [0.26, 1.0, 0.12], [1.0, 0.0, 0.35]));
    torso.meeting(0.010);
    // The middle muscle of the hip, under the crest.
    torso
        .swell(0.006, f.egg([0.118, 0.985, -0.035], [0.075, 0.06, 0.07], [0.15, 1.0, -0.1], [0.0, 0.0, 1.0]));
    // The hollow behind the thigh's head.
    torso.swell(
        -0.006,
        f.egg([0.150, 0.895, -0.050], [0.070, 0.045, 0.060], [0.1, 1.0, 0.0], [0.0, 0.0, 1.0]),
    );
}

/// Breast muscle, breast bone, rib arch, the saw muscle on the ribs.
fn chest(f: &Fit, tone: f64, torso: &mut Part) {
    torso
        .add(0.04, f.egg([0.072, 1.286, 0.044], [0.084, 0.064, 0.052], [1.0, 0.34, -0.36], [0.0, 1.0, 0.18]));
    torso.meeting(0.014);
    torso.swell(
        tone * 0.004,
        f.egg([0.070, 1.250, 0.098], [0.080, 0.050, 0.060], [1.0, 0.28, -0.35], [0.0, 1.0, 0.0]),
    );
    torso.meeting(0.010);
    torso.swell(
        -tone * 0.004,
        f.ridge(&[[0.0, 1.410, 0.055, 0.036], [0.0, 1.30, 0.100, 0.046], [0.0, 1.185, 0.105, 0.046]]),
    );
    // Under the breast muscle, then along the rib arch.
    torso.swell(
        -tone * 0.0035,
        f.ridge(&[
            [-0.030, 1.202, 0.107, 0.040],
            [0.040, 1.204, 0.106, 0.040],
            [0.090, 1.216, 0.090, 0.040],
            [0.135, 1.250, 0.055, 0.036],
        ]),
    );
    torso.meeting(0.010);
    torso.swell(
        -tone * 0.0045,
        f.ridge(&[
            [-0.060, 1.140, 0.100, 0.046],
            [0.0, 1.178, 0.105, 0.048],
            [0.045, 1.150, 0.100, 0.050],
            [0.085, 1.105, 0.085, 0.050],
            [0.120, 1.060, 0.050, 0.046],
        ]),
    );
    torso.meeting(0.016);
    torso.swell(
        tone * 0.003,
        f.ridge(&[
            [0.020, 1.210, 0.104, 0.040],
            [0.065, 1.170, 0.096, 0.042],
            [0.100, 1.125, 0.072, 0.044],
            [0.125, 1.100, 0.030, 0.044],
        ]),
    );
    for (y, x, z) in [(1.226, 0.136, 0.026), (1.192, 0.134, 0.034), (1.158, 0.129, 0.042)] {
        torso.swell(tone * 0.0013, f.egg([x, y, z], [0.042, 0.021, 0.03], [0.4, -0.5, 1.0], [0.0, 1.0, 0.0]));
    }
}

/// Belly: the straight muscle with its middle line and faint steps, flank muscle, navel.
fn belly(f: &Fit, tone: f64, torso: &mut Part) {
    torso.swell(
        tone * 0.004,
        f.ridge(&[
            [0.038, 1.230, 0.100, 0.050],
            [0.038, 1.13, 0.098, 0.054],
            [0.036, 1.02, 0.096, 0.054],
            [0.020, 0.88, 0.088, 0.050],
        ]),
    );
    torso.meeting(0.010);
    torso.swell(
        -tone * 0.0026,
        f.ridge(&[
            [0.0, 1.220, 0.106, 0.024],
            [0.0, 1.13, 0.102, 0.026],
            [0.0, 1.05, 0.100, 0.026],
            [0.0, 0.96, 0.098, 0.022],
        ]),
    );
    torso.swell(
        -tone * 0.0034,
        f.ridge(&[
            [0.078, 1.160, 0.090, 0.040],
            [0.082, 1.08, 0.084, 0.042],
            [0.078, 1.00, 0.084, 0.042],
            [0.048, 0.91, 0.085, 0.038],
        ]),
    );
    for y in [1.146, 1.098, 1.050] {
        torso.swell(
            -tone * 0.0007,
            f.egg([0.036, y, 0.102], [0.044, 0.020, 0.03], [1.0, 0.06, 0.0], [0.0, 1.0, 0.0]),
        );
    }
    torso.swell(-0.0025, f.ball([0.0, 1.045, 0.100], [0.015, 0.019, 0.025]));
    torso.cut(0.007, f.ball([0.0, 1.0445, 0.1025], [0.0042, 0.0066, 0.0100]));
    // The lower belly's soft fullness.
    torso.swell(tone * 0.006, f.ball([0.0, 0.975, 0.090], [0.105, 0.085, 0.07]));
    // The flank muscle over the crest.
    torso.swell(
        tone * 0.0035,
        f.egg([0.130, 1.074, 0.020], [0.075, 0.055, 0.085], [0.15, 1.0, -0.2], [1.0, 0.0, 0.0]),
    );
}

/// The rim of the pelvis: its crest and front point, the groin's line, the mound.
fn hips(f: &Fit, bone: f64, torso: &mut Part) {
    torso.swell(
        bone * 0.0026,
        f.ridge(&[
            [0.104, 0.970, 0.080, 0.030],
            [0.124, 1.005, 0.056, 0.036],
            [0.137, 1.028, 0.016, 0.038],
            [0.136, 1.030, -0.030, 0.034],
        ]),
    );
    torso.swell(
        -bone * 0.0020,
        f.ridge(&[
            [0.132, 1.045, -0.020, 0.036],
            [0.138, 1.046, 0.016, 0.038],
            [0.124, 1.026, 0.060, 0.036],
            [0.100, 0.998, 0.086, 0.030],
        ]),
    );
    torso.swell(bone * 0.0025, f.ball([0.112, 0.984, 0.074], [0.032, 0.032, 0.032]));
    torso.swell(0.0035, f.ball([0.0, 0.890, 0.085], [0.070, 0.060, 0.055]));
}

/// The groin's line: thigh and trunk both have it, so that it stays where they join.
pub fn groin(f: &Fit, part: &mut Part) {
    part.swell(
        -0.0065,
        f.ridge(&[
            [0.130, 0.985, 0.080, 0.034],
            [0.086, 0.925, 0.094, 0.044],
            [0.050, 0.872, 0.088, 0.044],
            [0.024, 0.820, 0.070, 0.034],
        ]),
    );
}

/// The fold below the seat.
pub fn seat_fold(f: &Fit, part: &mut Part) {
    part.swell(
        -0.0045,
        f.ridge(&[
            [0.010, 0.826, -0.070, 0.032],
            [0.060, 0.812, -0.090, 0.036],
            [0.100, 0.818, -0.090, 0.034],
            [0.135, 0.842, -0.075, 0.030],
        ]),
    );
}

/// Broad back muscle, shoulder blade, the columns beside the spine with the furrow between them, the sacrum.
fn back(f: &Fit, tone: f64, bone: f64, torso: &mut Part) {
    torso
        .add(0.05, f.egg([0.114, 1.262, -0.036], [0.150, 0.039, 0.040], [0.20, 1.0, -0.03], [1.0, 0.0, 0.0]));
    // Ribs and muscle that the inner side of a hanging arm lies on.
    torso.swell(0.016, f.ball([0.146, 1.303, 0.0], [0.050, 0.070, 0.085]));
    for z in [0.054, -0.054] {
        torso.swell(0.010, f.ball([0.144, 1.314, z], [0.036, 0.048, 0.036]));
    }
    // Shoulder blade: body, inner border with the furrow beside it, spine, the hollow above that.
    torso.swell(
        tone * 0.008,
        f.egg([0.092, 1.318, -0.085], [0.105, 0.062, 0.06], [0.22, 1.0, 0.0], [1.0, 0.0, 0.4]),
    );
    torso.swell(
        bone * 0.0035,
        f.ridge(&[
            [0.050, 1.410, -0.088, 0.034],
            [0.060, 1.340, -0.097, 0.036],
            [0.074, 1.275, -0.094, 0.038],
            [0.095, 1.215, -0.080, 0.034],
        ]),
    );
    torso.swell(
        bone * 0.0045,
        f.ridge(&[
            [0.035, 1.355, -0.094, 0.034],
            [0.080, 1.388, -0.088, 0.036],
            [0.125, 1.408, -0.066, 0.036],
            [0.180, 1.420, -0.030, 0.034],
        ]),
    );
    torso.swell(
        -tone * 0.0036,
        f.ridge(&[
            [0.036, 1.40, -0.090, 0.034],
            [0.040, 1.32, -0.098, 0.040],
            [0.050, 1.26, -0.094, 0.040],
            [0.075, 1.19, -0.078, 0.036],
        ]),
    );
    // Columns and furrow.
    torso.swell(
        tone * 0.0068,
        f.ridge(&[
            [0.034, 1.32, -0.090, 0.040],
            [0.037, 1.19, -0.074, 0.052],
            [0.039, 1.06, -0.060, 0.056],
            [0.034, 0.93, -0.084, 0.040],
        ]),
    );
    torso.meeting(0.008);
    torso.swell(
        -tone * 0.0068,
        f.ridge(&[
            [0.0, 1.47, -0.070, 0.026],
            [0.0, 1.33, -0.097, 0.036],
            [0.0, 1.18, -0.072, 0.042],
            [0.0, 1.06, -0.062, 0.044],
            [0.0, 0.93, -0.090, 0.034],
        ]),
    );
    // Dimples of the sacrum.
    torso.swell(-bone * 0.0030, f.ball([0.042, 0.998, -0.084], [0.036, 0.036, 0.036]));
}

/// Trapezius from neck to shoulder, and the flat in front of the armpit.
fn shoulders(f: &Fit, torso: &mut Part) {
    torso.add(0.04, f.egg([0.108, 1.366, 0.020], [0.052, 0.034, 0.026], [1.0, 0.25, -0.35], [0.0, 1.0, 0.0]));
    torso.add(
        0.045,
        f.strand(&[
            [0.028, 1.490, -0.030, 0.025],
            [0.052, 1.452, -0.030, 0.026],
            [0.095, 1.416, -0.026, 0.027],
            [0.155, 1.390, -0.018, 0.027],
        ]),
    );
    torso.meeting(0.012);
    torso.add(0.045, f.cone([0.022, 1.440, -0.042], 0.034, [0.080, 1.365, -0.056], 0.032));
    torso.meeting(0.016);
}

/// Collar bones, the hollows above and below them, the pit between.
fn collar(f: &Fit, bone: f64, torso: &mut Part) {
    torso.swell(
        -bone * 0.0065,
        f.egg([0.078, 1.432, 0.040], [0.058, 0.034, 0.042], [1.0, 0.15, -0.3], [0.0, 1.0, 0.0]),
    );
    torso.swell(
        -bone * 0.0032,
        f.egg([0.120, 1.380, 0.046], [0.042, 0.028, 0.036], [1.0, 0.5, -0.4], [0.0, 1.0, 0.0]),
    );
    torso.add(
        0.019,
        f.strand(&[
            [0.014, 1.389, 0.0545, 0.0085],
            [0.035, 1.393, 0.0560, 0.0076],
            [0.070, 1.402, 0.0500, 0.0068],
            [0.110, 1.408, 0.0300, 0.0066],
            [0.150, 1.410, 0.0100, 0.0080],
        ]),
    );
    torso.swell(
        -bone * 0.0065,
        f.egg([0.0, 1.406, 0.054], [0.024, 0.034, 0.034], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
    );
}
