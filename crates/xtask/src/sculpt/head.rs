//! Neck and skull, as drawn: metres, the figure's left half.

use glam::DVec3;
use rig::{Bone, Skeleton};

use super::field::{Part, Region};
use super::fit::Fit;
use super::physique::Physique;
use super::{character, face};

/// Radius of the eyeball as drawn.
pub const EYE_RADIUS: f64 = 0.0136;
/// The drawn centre of the left eye.
pub const EYE: [f64; 3] = [0.031, 1.61, 0.082];

/// The head as one piece, hung on the height between neck and eyes.
pub fn head_fit(skeleton: &Skeleton) -> Fit {
    let neck = skeleton.rest_position(Bone::Neck);
    let eye = skeleton.rest_position(Bone::LeftEye);
    let fit = Fit::chain(skeleton, DVec3::Y, &[(Bone::LeftEye, EYE)]);
    if skeleton.joint(Bone::LeftEye).is_none() {
        return super::torso::fit(skeleton);
    }
    let scale = ((eye.y - neck.y) / (EYE[1] - 1.452)).clamp(0.2, 5.0);
    fit.with_girth(scale)
}

fn neck_fit(skeleton: &Skeleton) -> Fit {
    Fit::chain(
        skeleton,
        DVec3::Y,
        &[
            (Bone::UpperChest, [0.0, 1.308, 0.0]),
            (Bone::Neck, [0.0, 1.452, 0.0]),
            (Bone::Head, [0.0, 1.562, 0.0]),
        ],
    )
}

/// Neck, skull and face without ears.
pub fn part(skeleton: &Skeleton, physique: &Physique) -> Part {
    let f = head_fit(skeleton);
    let throat = neck_fit(skeleton);
    let mut head = Part::new(Region::Head, 0.03);
    skull(&f, &mut head);
    neck(&throat, &mut head);
    mask(&f, &mut head);
    jaw(&f, &mut head);
    cheeks(&f, &mut head);
    face::add(&f, &mut head);
    character::add(&f, &throat, physique, &mut head);
    // Last, for lids keep to the eyeballs in every body.
    face::eye(&f, &mut head);
    head
}

fn skull(f: &Fit, head: &mut Part) {
    // Two eggs for the brain case: a fuller one behind, a narrower one in front.
    head.add(0.0, f.ball([0.0, 1.6440, -0.0180], [0.0735, 0.0760, 0.0675]));
    head.add(0.040, f.ball([0.0, 1.6400, 0.0290], [0.0630, 0.0770, 0.0730]));
}

/// The face below the brow, without features.
fn mask(f: &Fit, head: &mut Part) {
    // Height: centre z, half width, front and back edge, squareness.
    let rows = [
        (1.4985, 0.080, 0.0120, 0.0960, 0.064, 0.2),
        (1.5040, 0.068, 0.0195, 0.1005, 0.044, 0.2),
        (1.5150, 0.054, 0.0272, 0.1025, 0.028, 0.22),
        (1.5285, 0.040, 0.0362, 0.1025, 0.012, 0.26),
        (1.5430, 0.027, 0.0452, 0.1035, -0.004, 0.3),
        (1.5560, 0.018, 0.0536, 0.1040, -0.018, 0.32),
        (1.5700, 0.010, 0.0602, 0.1025, -0.028, 0.40),
        (1.5850, 0.006, 0.0632, 0.0995, -0.034, 0.46),
        (1.6000, 0.004, 0.0630, 0.0975, -0.040, 0.42),
        (1.6150, 0.002, 0.0645, 0.0975, -0.040, 0.36),
        (1.6300, 0.000, 0.0640, 0.0990, -0.040, 0.30),
        (1.6500, 0.000, 0.0600, 0.0960, -0.040, 0.26),
    ];
    let knots = rows.map(|(y, z, w, front, back, square)| (y, [z, 0.0, front - z, z - back, w, w, square]));
    head.add(0.016, f.loft([0.0; 3], DVec3::Z, DVec3::X, 0.012, &knots));
}

/// Chin, jaw line, the chewing muscle.
fn jaw(f: &Fit, head: &mut Part) {
    head.add(0.014, f.ball([0.0, 1.5110, 0.0930], [0.0162, 0.0125, 0.0138]));
    head.add(
        0.024,
        f.strand(&[
            [0.0480, 1.5740, -0.0040, 0.0070],
            [0.0438, 1.5490, 0.0020, 0.0080],
            [0.0374, 1.5315, 0.0180, 0.0085],
            [0.0276, 1.5175, 0.0480, 0.0080],
            [0.0152, 1.5080, 0.0780, 0.0078],
            [0.0060, 1.5045, 0.0920, 0.0078],
        ]),
    );
    head.swell(
        0.0020,
        f.egg([0.0540, 1.5560, 0.0200], [0.0300, 0.0160, 0.0220], [0.0, 1.0, 0.25], [1.0, 0.0, 0.0]),
    );
}

/// Cheek bone and its arch, the flesh beside the nose, the temple.
fn cheeks(f: &Fit, head: &mut Part) {
    head.add(
        0.028,
        f.strand(&[
            [0.0340, 1.5840, 0.0780, 0.0090],
            [0.0440, 1.5880, 0.0695, 0.0098],
            [0.0520, 1.5920, 0.0550, 0.0085],
            [0.0550, 1.5950, 0.0300, 0.0080],
            [0.0550, 1.5960, 0.0080, 0.0070],
        ]),
    );
    head.add(0.022, f.ball([0.0290, 1.5690, 0.0790], [0.0190, 0.0210, 0.0165]));
    head.swell(
        0.0030,
        f.egg([0.0520, 1.5620, 0.0600], [0.0420, 0.0380, 0.0420], [0.0, 0.3, 1.0], [1.0, 0.0, 0.0]),
    );
    head.cut(0.034, f.ball([0.0855, 1.6330, 0.0560], [0.0160, 0.0240, 0.0280]));
}

fn neck(f: &Fit, head: &mut Part) {
    // Height: centre z, half width, to the front, to the back.
    let rows = [
        (1.4000, -0.008, 0.064, 0.050, 0.060, 0.0),
        (1.4350, -0.008, 0.0590, 0.0515, 0.057, 0.0),
        (1.4700, -0.005, 0.0532, 0.0510, 0.0550, 0.05),
        (1.5050, -0.001, 0.0505, 0.0505, 0.0555, 0.05),
        (1.5400, 0.001, 0.0500, 0.0460, 0.0580, 0.08),
        (1.5800, -0.004, 0.0520, 0.0380, 0.0630, 0.12),
        (1.6050, -0.008, 0.0530, 0.0300, 0.0600, 0.15),
    ];
    let knots = rows.map(|(y, z, w, front, back, square)| (y, [z, 0.0, front, back, w, w, square]));
    head.add(0.030, f.loft([0.0, 1.452, 0.0], DVec3::Z, DVec3::X, 0.012, &knots));
    // The muscle from behind the ear to the breast bone with its second head to the collarbone.
    head.add(
        0.016,
        f.strand(&[
            [0.0530, 1.5740, -0.0190, 0.0080],
            [0.0460, 1.5270, 0.0020, 0.0085],
            [0.0365, 1.4740, 0.0270, 0.0078],
            [0.0235, 1.4330, 0.0405, 0.0058],
            [0.0110, 1.4010, 0.0475, 0.0042],
        ]),
    );
    head.add(
        0.018,
        f.strand(&[
            [0.0435, 1.4850, 0.0190, 0.0060],
            [0.0475, 1.4500, 0.0230, 0.0055],
            [0.0500, 1.4150, 0.0255, 0.0045],
        ]),
    );
    // The throat's cartilage, the cords of the nape and the hollow between them.
    head.add(0.018, f.ball([0.0, 1.4860, 0.0445], [0.0080, 0.0140, 0.0085]));
    head.swell(-0.0018, f.cone([0.0, 1.5500, -0.0640], 0.0240, [0.0, 1.4950, -0.0540], 0.0240));
}
