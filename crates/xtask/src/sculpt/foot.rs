//! The foot and its toes, as drawn: metres, the left foot.

use glam::DVec3;
use rig::{Bone, Skeleton};

use super::field::{Part, Region};
use super::fit::Fit;
use super::shape::Shape;

/// Drawn places of the toes' middle line: x and z at the base and at the tip, radius; big toe first.
const TOES: [[f64; 5]; 5] = [
    [0.0645, 0.1400, 0.0688, 0.2035, 0.0122],
    [0.0838, 0.1400, 0.0872, 0.2015, 0.0084],
    [0.0980, 0.1340, 0.1007, 0.1925, 0.0080],
    [0.1110, 0.1260, 0.1130, 0.1810, 0.0077],
    [0.1230, 0.1150, 0.1238, 0.1670, 0.0078],
];

/// From ankle to toes.
pub fn fit(skeleton: &Skeleton) -> Fit {
    Fit::chain(
        skeleton,
        DVec3::Z,
        &[(Bone::LeftFoot, [0.086, 0.067, 0.0]), (Bone::LeftToes, [0.086, 0.022, 0.126])],
    )
}

/// The ground: the sole is flat on it.
fn ground(f: &Fit) -> Shape {
    f.slab([0.0860, -0.0500, 0.0700], [0.1500, 0.0500, 0.2500], 0.001)
}

/// Heel, instep and ball.
pub fn foot(skeleton: &Skeleton) -> Part {
    let f = fit(skeleton);
    let mut foot = Part::new(Region::Foot, 0.030);
    foot.add(0.0, mass(&f));
    foot.add(0.020, f.ball([0.0866, 0.0300, -0.0275], [0.0285, 0.0295, 0.0305]));
    // The ball of the foot, running back to the little toe's side, and its cushions.
    foot.add(
        0.026,
        f.strand(&[
            [0.0630, 0.0160, 0.1480, 0.0145],
            [0.0840, 0.0140, 0.1490, 0.0130],
            [0.0995, 0.0130, 0.1420, 0.0122],
            [0.1120, 0.0120, 0.1320, 0.0114],
            [0.1225, 0.0115, 0.1200, 0.0108],
        ]),
    );
    foot.swell(0.0025, f.ball([0.0560, 0.0180, 0.1280], [0.026, 0.022, 0.032]));
    foot.swell(0.0015, f.ball([0.1300, 0.0140, 0.1060], [0.020, 0.018, 0.028]));
    // The outer side is lower than the inner one; the bump of its middle bone.
    foot.swell(
        -0.0055,
        f.ridge(&[
            [0.1180, 0.0780, 0.0100, 0.034],
            [0.1180, 0.0580, 0.0500, 0.036],
            [0.1240, 0.0400, 0.0950, 0.034],
            [0.1240, 0.030, 0.1300, 0.028],
        ]),
    );
    foot.swell(0.0020, f.ball([0.1215, 0.0160, 0.0480], [0.020, 0.020, 0.028]));
    // Cords to the toes, the instep's ridge.
    foot.swell(
        0.0028,
        f.ridge(&[
            [0.0760, 0.0960, 0.0200, 0.020],
            [0.0700, 0.0640, 0.0720, 0.018],
            [0.0660, 0.0400, 0.1180, 0.016],
            [0.0660, 0.0300, 0.1600, 0.013],
        ]),
    );
    for (x0, x1, z) in [(0.0860, 0.0850, 0.160), (0.0920, 0.0990, 0.153), (0.0960, 0.1120, 0.143)] {
        foot.swell(
            0.0012,
            f.ridge(&[
                [x0, 0.0700, 0.0550, 0.011],
                [0.5 * (x0 + x1), 0.0480, 0.1000, 0.011],
                [x1, 0.0260, z, 0.010],
            ]),
        );
    }
    // The arch, hollow on the inside.
    foot.cut(0.020, f.ball([0.0480, 0.0000, 0.0450], [0.0250, 0.0200, 0.0480]));
    foot.swell(-0.0035, f.ball([0.0500, 0.0260, 0.0420], [0.022, 0.024, 0.050]));
    foot.swell(-0.0020, f.ball([0.0500, 0.0400, -0.0200], [0.020, 0.026, 0.024]));
    instep(&f, &mut foot);
    foot.cut(0.008, ground(&f));
    foot
}

/// The bend from shin to instep: leg and foot both have it.
pub fn instep(f: &Fit, part: &mut Part) {
    part.swell(
        0.0045,
        f.egg([0.0840, 0.1000, 0.0340], [0.042, 0.050, 0.040], [1.0, 0.0, 0.0], [0.0, 1.0, -0.7]),
    );
}

fn mass(f: &Fit) -> Shape {
    // Place: inner and outer edge, sole, height where it is widest, instep, squareness.
    let rows = [
        (-0.0480, 0.0660, 0.1070, 0.0080, 0.0270, 0.0520, 0.05),
        (-0.0360, 0.0605, 0.1130, 0.0020, 0.0260, 0.0660, 0.15),
        (-0.0150, 0.0570, 0.1160, -0.0010, 0.0260, 0.0820, 0.2),
        (0.0100, 0.0580, 0.1160, -0.0010, 0.0260, 0.0900, 0.2),
        (0.0350, 0.0580, 0.1180, -0.0010, 0.0240, 0.0860, 0.2),
        (0.0600, 0.0550, 0.1215, -0.0010, 0.0220, 0.0705, 0.2),
        (0.0850, 0.0515, 0.1255, -0.0010, 0.0190, 0.0535, 0.25),
        (0.1050, 0.0490, 0.1290, -0.0010, 0.0170, 0.0430, 0.3),
        (0.1250, 0.0500, 0.1250, -0.0010, 0.0150, 0.0330, 0.2),
        (0.1400, 0.0600, 0.1050, -0.0010, 0.0130, 0.0230, 0.0),
    ];
    let knots = rows.map(|(z, inner, outer, sole, wide, top, square)| {
        let (x, half) = (0.5 * (inner + outer) - 0.086, 0.5 * (outer - inner));
        (z, [x, wide, half, half, top - wide, wide - sole, square])
    });
    f.limb([0.086, 0.0, 0.0], DVec3::X, DVec3::Y, 0.016, &knots)
}

/// One toe.
pub fn toe(skeleton: &Skeleton, number: usize) -> Part {
    let f = fit(skeleton);
    let [x0, z0, x1, z1, r] = TOES[number];
    let mut toe = Part::new(Region::Toe(number as u8), 0.012);
    let big = number == 0;
    // Along the toe: how far, height of the middle line, share of the radius.
    let rows: [[f64; 3]; 5] = if big {
        [[0.0, 1.25, 1.05], [0.35, 1.15, 0.92], [0.60, 1.08, 0.94], [0.82, 0.98, 0.92], [0.92, 0.90, 0.74]]
    } else {
        [[0.0, 1.60, 1.05], [0.36, 1.85, 0.92], [0.60, 1.50, 0.90], [0.80, 1.08, 0.94], [0.90, 0.95, 0.86]]
    };
    // The small toes bend inwards.
    let bow = if big { 0.0006 } else { 0.0012 + 0.0005 * number as f64 };
    let knots = rows.map(|[t, height, share]| {
        let x = x0 + (x1 - x0) * t + bow * 4.0 * t * (1.0 - t);
        [x, r * height, z0 + (z1 - z0) * t, r * share]
    });
    toe.add(0.0, f.strand(&knots));
    // The pad below, the nail's flat above.
    let pad = z0 + (z1 - z0) * 0.80;
    toe.add(0.004, f.ball([x1, r * 0.80, pad], [r * 1.04, r * 0.86, r * 1.25]));
    let top = if big { 1.92 } else { 2.04 };
    toe.swell(-0.0012, f.ball([x1, r * top, z0 + (z1 - z0) * 0.86], [r * 0.95, r * 0.8, r * 0.95]));
    toe.cut(0.004, ground(&f));
    toe
}
