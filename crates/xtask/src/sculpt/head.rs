//! Neck, head and face, as drawn: metres, the figure's left half.

use glam::DVec3;
use rig::{Bone, Skeleton};

use super::field::{Part, Region};
use super::fit::Fit;
use super::physique::Physique;

/// Radius of the eyeball as drawn.
pub const EYE_RADIUS: f64 = 0.0128;
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
pub fn part(skeleton: &Skeleton, _physique: &Physique) -> Part {
    let f = head_fit(skeleton);
    let mut head = Part::new(Region::Head, 0.03);
    skull(&f, &mut head);
    face(&f, &mut head);
    neck(&neck_fit(skeleton), &mut head);
    eyes(&f, &mut head);
    nose(&f, &mut head);
    mouth(&f, &mut head);
    head
}

fn skull(f: &Fit, head: &mut Part) {
    // Height: centre z, half width, front and back edge, squareness.
    let rows = [
        (1.5060, 0.080, 0.016, 0.0980, 0.062, 0.3),
        (1.5120, 0.072, 0.027, 0.1040, 0.042, 0.4),
        (1.5200, 0.060, 0.0375, 0.1060, 0.028, 0.5),
        (1.5300, 0.048, 0.046, 0.1065, 0.010, 0.45),
        (1.5420, 0.034, 0.0525, 0.1075, -0.012, 0.4),
        (1.5550, 0.022, 0.0595, 0.1070, -0.034, 0.42),
        (1.5700, 0.012, 0.0635, 0.1040, -0.052, 0.6),
        (1.5850, 0.006, 0.0660, 0.1005, -0.066, 0.75),
        (1.6000, 0.003, 0.0680, 0.0990, -0.075, 0.65),
        (1.6150, 0.001, 0.0698, 0.1015, -0.0805, 0.5),
        (1.6300, 0.000, 0.0710, 0.1055, -0.0838, 0.42),
        (1.6450, 0.000, 0.0715, 0.1055, -0.0848, 0.4),
        (1.6600, 0.002, 0.0702, 0.1025, -0.0835, 0.36),
        (1.6750, 0.004, 0.0665, 0.0965, -0.0785, 0.32),
        (1.6900, 0.006, 0.0590, 0.0865, -0.0675, 0.27),
        (1.7020, 0.008, 0.0485, 0.0730, -0.0530, 0.2),
        (1.7110, 0.010, 0.0360, 0.0570, -0.0370, 0.1),
        (1.7170, 0.010, 0.0215, 0.0375, -0.0180, 0.0),
        (1.7200, 0.010, 0.0030, 0.0130, 0.0060, 0.0),
    ];
    let knots = rows.map(|(y, z, w, front, back, square)| (y, [z, 0.0, front - z, z - back, w, w, square]));
    head.add(0.0, f.loft([0.0; 3], DVec3::Z, DVec3::X, 0.010, &knots));
}

fn face(f: &Fit, head: &mut Part) {
    // Chin, jaw line, cheek bones, temples, brows.
    head.add(0.016, f.ball([0.0, 1.5165, 0.0950], [0.0165, 0.0125, 0.0135]));
    head.add(0.020, f.cone([0.0505, 1.549, 0.012], 0.0095, [0.024, 1.5165, 0.080], 0.0105));
    head.add(
        0.022,
        f.egg([0.0500, 1.588, 0.0700], [0.0240, 0.0120, 0.0120], [-0.55, -0.1, 1.0], [0.0, 1.0, 0.0]),
    );
    head.add(0.020, f.ball([0.0380, 1.562, 0.0720], [0.0200, 0.0220, 0.0200]));
    head.cut(0.025, f.ball([0.0850, 1.628, 0.0580], [0.0150, 0.0230, 0.0260]));
    head.add(0.018, f.cone([0.0120, 1.6285, 0.0955], 0.0075, [0.0300, 1.6325, 0.0945], 0.0070));
    head.add(0.018, f.cone([0.0300, 1.6325, 0.0945], 0.0070, [0.0500, 1.6275, 0.0750], 0.0040));
}

fn neck(f: &Fit, head: &mut Part) {
    // Height: centre z, half width, to the front, to the back.
    let rows = [
        (1.4000, -0.008, 0.060, 0.050, 0.056, 0.0),
        (1.4350, -0.006, 0.056, 0.051, 0.054, 0.0),
        (1.4700, -0.002, 0.0510, 0.0500, 0.0525, 0.05),
        (1.5050, 0.001, 0.0490, 0.0500, 0.0520, 0.05),
        (1.5400, 0.003, 0.0490, 0.0480, 0.0540, 0.05),
        (1.5800, 0.002, 0.0500, 0.0400, 0.0560, 0.05),
    ];
    let knots = rows.map(|(y, z, w, front, back, square)| (y, [z, 0.0, front, back, w, w, square]));
    head.add(0.022, f.loft([0.0, 1.452, 0.0], DVec3::Z, DVec3::X, 0.012, &knots));
    // The muscle from behind the ear to the breast bone, the throat's cartilage, the nape.
    head.add(0.024, f.cone([0.0500, 1.562, -0.016], 0.010, [0.029, 1.470, 0.034], 0.0080));
    head.add(0.024, f.cone([0.029, 1.470, 0.034], 0.0080, [0.012, 1.404, 0.045], 0.0065));
    head.add(0.022, f.ball([0.0, 1.487, 0.0440], [0.0085, 0.0130, 0.0080]));
}

fn eyes(f: &Fit, head: &mut Part) {
    let [x, y, z] = EYE;
    // Socket, then the lids as a shell around the ball, then the opening between them.
    head.cut(
        0.012,
        f.egg([0.0338, 1.6105, 0.1040], [0.0205, 0.0125, 0.0135], [1.0, -0.06, -0.28], [0.0, 1.0, 0.0]),
    );
    head.add(0.006, f.ball([x + 0.0004, y, z], [0.0156, 0.0146, 0.0145]));
    // Upper lid's fold and the pouch below.
    head.add(0.005, f.cone([0.0185, 1.6182, 0.0900], 0.0032, [0.0320, 1.6212, 0.0930], 0.0034));
    head.add(0.005, f.cone([0.0320, 1.6212, 0.0930], 0.0034, [0.0460, 1.6155, 0.0835], 0.0030));
    head.cut(
        0.0015,
        f.egg(
            [x + 0.0002, y - 0.0013, 0.0990],
            [0.0143, 0.0039, 0.0150],
            [1.0, 0.06, -0.22],
            [0.0, 1.0, 0.0],
        ),
    );
}

fn nose(f: &Fit, head: &mut Part) {
    head.add(0.012, f.cone([0.0, 1.6180, 0.0985], 0.0080, [0.0, 1.6000, 0.1060], 0.0066));
    head.add(0.009, f.cone([0.0, 1.6000, 0.1060], 0.0066, [0.0, 1.5795, 0.1168], 0.0078));
    head.add(0.006, f.cone([0.0, 1.6020, 0.0970], 0.0085, [0.0, 1.5780, 0.1020], 0.0110));
    head.add(0.008, f.ball([0.0, 1.5765, 0.1168], [0.0092, 0.0084, 0.0088]));
    head.add(0.010, f.ball([0.0102, 1.5728, 0.1075], [0.0058, 0.0060, 0.0095]));
    head.add(0.008, f.cone([0.0, 1.5690, 0.1110], 0.0042, [0.0, 1.5640, 0.1050], 0.0040));
    head.cut(
        0.003,
        f.egg([0.0062, 1.5668, 0.1115], [0.0058, 0.0028, 0.0030], [-0.35, 0.25, 1.0], [1.0, 0.0, 0.0]),
    );
}

fn mouth(f: &Fit, head: &mut Part) {
    // The dental arch under the lips, then the lips, the line between them, philtrum and corners.
    head.add(0.016, f.ball([0.0, 1.5480, 0.0820], [0.0300, 0.0200, 0.0285]));
    head.add(0.006, f.cone([0.0035, 1.5514, 0.1094], 0.0052, [0.0215, 1.5488, 0.0995], 0.0030));
    head.meeting(0.002);
    head.add(0.006, f.cone([0.0, 1.5416, 0.1080], 0.0062, [0.0200, 1.5460, 0.0990], 0.0032));
    head.meeting(0.004);
    head.cut(0.0045, f.cone([0.0, 1.5466, 0.1152], 0.0018, [0.0130, 1.5470, 0.1108], 0.0017));
    head.cut(0.0050, f.cone([0.0130, 1.5470, 0.1108], 0.0017, [0.0228, 1.5475, 0.1042], 0.0010));
    head.cut(0.006, f.cone([0.0, 1.5570, 0.1148], 0.0022, [0.0, 1.5630, 0.1135], 0.0020));
    head.cut(0.012, f.cone([0.0, 1.5320, 0.1170], 0.0050, [0.0150, 1.5330, 0.1110], 0.0040));
}

/// The ear: plate, rim, bowl, lobe.
pub fn ear(skeleton: &Skeleton) -> Part {
    let f = head_fit(skeleton);
    let mut ear = Part::new(Region::Ear, 0.006);
    let out = [0.90, 0.0, 0.42];
    ear.add(0.0, f.egg([0.0745, 1.5910, -0.0060], [0.0060, 0.0290, 0.0165], out, [0.0, 1.0, -0.22]));
    ear.cut(0.005, f.egg([0.0820, 1.5925, -0.0035], [0.0062, 0.0205, 0.0115], out, [0.0, 1.0, -0.22]));
    let rim = [
        [0.0715, 1.5970, 0.0085],
        [0.0728, 1.6060, 0.0080],
        [0.0745, 1.6130, 0.0045],
        [0.0770, 1.6175, -0.0010],
        [0.0797, 1.6188, -0.0075],
        [0.0820, 1.6165, -0.0140],
        [0.0833, 1.6105, -0.0190],
        [0.0836, 1.6020, -0.0212],
        [0.0828, 1.5930, -0.0205],
        [0.0808, 1.5850, -0.0175],
        [0.0780, 1.5780, -0.0130],
        [0.0750, 1.5720, -0.0080],
    ];
    for pair in rim.windows(2) {
        ear.add(0.0012, f.cone(pair[0], 0.0029, pair[1], 0.0029));
    }
    ear.add(0.005, f.ball([0.0730, 1.5665, -0.0020], [0.0042, 0.0080, 0.0062]));
    ear.add(0.004, f.ball([0.0725, 1.5890, 0.0090], [0.0032, 0.0060, 0.0036]));
    ear
}
