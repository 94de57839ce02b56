//! Pelvis to collar, as drawn: metres, the figure's left half.

use glam::DVec3;
use rig::{Bone, Skeleton};

use super::field::{Part, Region};
use super::fit::Fit;
use super::physique::Physique;

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
pub fn part(skeleton: &Skeleton, _physique: &Physique) -> Part {
    let f = fit(skeleton);
    let mut torso = Part::new(Region::Torso, 0.03);
    torso.add(0.0, trunk(&f));
    pelvis(&f, &mut torso);
    chest(&f, &mut torso);
    back(&f, &mut torso);
    collar(&f, &mut torso);
    torso
}

fn trunk(f: &Fit) -> super::shape::Shape {
    // Height: centre z, half width, to the front, to the back, squareness.
    let rows = [
        (0.805, 0.005, 0.050, 0.050, 0.050, 0.1),
        (0.835, 0.005, 0.100, 0.072, 0.070, 0.2),
        (0.870, 0.004, 0.139, 0.086, 0.078, 0.25),
        (0.915, 0.002, 0.155, 0.093, 0.084, 0.3),
        (0.960, 0.002, 0.1525, 0.096, 0.080, 0.32),
        (1.000, 0.004, 0.146, 0.095, 0.070, 0.32),
        (1.040, 0.006, 0.139, 0.091, 0.062, 0.3),
        (1.080, 0.007, 0.131, 0.087, 0.058, 0.3),
        (1.115, 0.007, 0.1275, 0.085, 0.058, 0.3),
        (1.150, 0.006, 0.129, 0.086, 0.062, 0.32),
        (1.190, 0.004, 0.133, 0.089, 0.068, 0.35),
        (1.230, 0.002, 0.137, 0.092, 0.074, 0.38),
        (1.270, 0.000, 0.1385, 0.092, 0.079, 0.4),
        (1.310, -0.002, 0.1375, 0.088, 0.081, 0.4),
        (1.350, -0.004, 0.134, 0.080, 0.080, 0.35),
        (1.385, -0.006, 0.122, 0.070, 0.075, 0.3),
        (1.415, -0.009, 0.100, 0.058, 0.066, 0.2),
        (1.440, -0.010, 0.074, 0.052, 0.057, 0.1),
        (1.465, -0.010, 0.058, 0.050, 0.050, 0.0),
    ];
    // u = +Z, v = +X, so that the axis is +Y.
    let knots = rows.map(|(y, z, w, front, back, square)| (y, [z, 0.0, front, back, w, w, square]));
    f.loft([0.0, 0.94, 0.0], DVec3::Z, DVec3::X, 0.02, &knots)
}

fn pelvis(f: &Fit, torso: &mut Part) {
    // Hip muscle under the crest, then the seat.
    torso.add(0.05, f.ball([0.094, 0.955, -0.018], [0.062, 0.062, 0.062]));
    torso.add(0.05, f.egg([0.081, 0.885, -0.048], [0.082, 0.066, 0.062], [0.25, 1.0, 0.1], [1.0, 0.0, 0.0]));
    torso.meeting(0.012);
    // Lower belly and the dip inside the hip bones.
    torso.add(0.05, f.ball([0.0, 0.985, 0.050], [0.070, 0.075, 0.050]));
    torso.cut(0.05, f.cone([0.125, 0.965, 0.125], 0.014, [0.055, 0.865, 0.128], 0.014));
}

fn chest(f: &Fit, torso: &mut Part) {
    // Rib cage edge, breast muscles, breast bone.
    torso.add(0.04, f.egg([0.066, 1.205, 0.030], [0.075, 0.058, 0.050], [0.35, 1.0, 0.0], [1.0, 0.0, 0.0]));
    torso.meeting(0.01);
    torso.add(0.04, f.egg([0.078, 1.290, 0.050], [0.080, 0.050, 0.040], [1.0, 0.28, -0.30], [0.0, 1.0, 0.1]));
    torso.meeting(0.014);
    torso.add(0.035, f.egg([0.070, 1.268, 0.060], [0.052, 0.034, 0.032], [1.0, 0.1, -0.30], [0.0, 1.0, 0.0]));
    torso.meeting(0.014);
    // The middle line of the belly, and the navel.
    torso.cut(0.03, f.cone([0.0, 1.19, 0.112], 0.008, [0.0, 1.06, 0.110], 0.008));
    torso.cut(0.012, f.ball([0.0, 1.045, 0.101], [0.0045, 0.006, 0.007]));
    torso.cut(0.03, f.cone([0.060, 1.175, 0.115], 0.008, [0.110, 1.135, 0.098], 0.008));
}

fn back(f: &Fit, torso: &mut Part) {
    // Broad back muscle to the armpit, shoulder blade, the columns beside the spine and the furrow between them.
    torso.add(0.05, f.cone([0.092, 1.130, -0.020], 0.016, [0.124, 1.300, -0.034], 0.034));
    torso.add(0.05, f.cone([0.068, 1.385, -0.046], 0.034, [0.090, 1.305, -0.044], 0.034));
    torso.cut(0.05, f.cone([0.0, 0.98, -0.090], 0.010, [0.0, 1.10, -0.082], 0.012));
    torso.cut(0.05, f.cone([0.0, 1.10, -0.082], 0.012, [0.0, 1.36, -0.106], 0.010));
}

fn collar(f: &Fit, torso: &mut Part) {
    // Between collar bone, breast and shoulder the skin runs flat.
    torso.add(0.04, f.egg([0.108, 1.372, 0.024], [0.052, 0.030, 0.024], [1.0, 0.25, -0.35], [0.0, 1.0, 0.0]));
    // Trapezius from neck to shoulder, front and back; collar bones; the pit between them.
    torso.add(0.04, f.cone([0.030, 1.475, -0.028], 0.030, [0.150, 1.398, -0.016], 0.030));
    torso.add(0.04, f.cone([0.020, 1.440, -0.040], 0.036, [0.080, 1.360, -0.056], 0.030));
    torso.add(0.022, f.cone([0.018, 1.388, 0.053], 0.0085, [0.080, 1.403, 0.044], 0.0070));
    torso.add(0.024, f.cone([0.080, 1.403, 0.044], 0.0070, [0.155, 1.418, 0.008], 0.0085));
    torso.cut(0.018, f.ball([0.0, 1.405, 0.070], [0.010, 0.014, 0.014]));
    torso.cut(0.035, f.egg([0.070, 1.435, 0.055], [0.040, 0.014, 0.016], [1.0, 0.1, -0.3], [0.0, 1.0, 0.0]));
}
