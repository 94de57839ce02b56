//! Brow, eyes, nose and mouth, as drawn: metres, the figure's left half.

use glam::DVec3;

use super::field::Part;
use super::fit::Fit;
use super::head::{EYE, EYE_RADIUS};

/// How far the lids' skin lies over the eyeball.
const LID: f64 = 0.0011;

/// Edges between the lids: metres beside the eye's centre, height of the lower and of the upper edge.
pub const LIDS: [(f64, [f64; 2]); 9] = [
    (-0.0123, [-0.0026, -0.0022]),
    (-0.0108, [-0.0033, -0.0009]),
    (-0.0080, [-0.0040, 0.0011]),
    (-0.0045, [-0.0047, 0.0025]),
    (0.0000, [-0.0052, 0.0031]),
    (0.0045, [-0.0051, 0.0027]),
    (0.0085, [-0.0042, 0.0016]),
    (0.0110, [-0.0025, 0.0004]),
    (0.0123, [-0.0008, -0.0004]),
];

/// Adds brow, nose and mouth to the skull.
pub fn add(f: &Fit, head: &mut Part) {
    brow(f, head);
    nose(f, head);
    mouth(f, head);
}

fn brow(f: &Fit, head: &mut Part) {
    head.add(
        0.020,
        f.strand(&[
            [0.0, 1.6265, 0.0925, 0.0062],
            [0.0120, 1.6290, 0.0922, 0.0066],
            [0.0260, 1.6325, 0.0893, 0.0064],
            [0.0400, 1.6325, 0.0815, 0.0060],
            [0.0495, 1.6260, 0.0700, 0.0052],
            [0.0515, 1.6140, 0.0640, 0.0050],
            [0.0500, 1.6020, 0.0640, 0.0055],
        ]),
    );
}

/// Adds an eye: socket, lids, the opening between them.
pub fn eye(f: &Fit, head: &mut Part) {
    let [x, y, z] = EYE;
    // The socket, the eyeball under its lids, the fold above, the opening.
    head.cut(
        0.014,
        f.egg([0.0330, 1.6100, 0.1078], [0.0205, 0.0120, 0.0140], [1.0, -0.04, -0.34], [0.0, 1.0, 0.0]),
    );
    head.add(0.0055, f.ball(EYE, [EYE_RADIUS + LID; 3]));
    let fold = |dx: f64, dy: f64, r: f64| {
        // On the ball, so that the fold follows the lid.
        let (far, rise) = (EYE_RADIUS + LID + 0.0010, dy);
        let depth = (far * far - dx * dx - rise * rise).max(0.0).sqrt();
        [x + dx, y + rise, z + depth, r]
    };
    head.add(
        0.010,
        f.strand(&[
            fold(-0.0115, 0.0045, 0.0012),
            fold(-0.0070, 0.0100, 0.0030),
            fold(0.0000, 0.0128, 0.0040),
            fold(0.0070, 0.0116, 0.0042),
            fold(0.0120, 0.0072, 0.0034),
            fold(0.0148, 0.0010, 0.0016),
        ]),
    );
    head.cut(
        0.0017,
        f.strand(&[
            fold(-0.0108, 0.0020, 0.0001),
            fold(-0.0060, 0.0062, 0.0004),
            fold(0.0000, 0.0078, 0.0005),
            fold(0.0065, 0.0069, 0.0005),
            fold(0.0120, 0.0022, 0.0002),
        ]),
    );
    head.cut(0.0018, f.slit(EYE, EYE_RADIUS, EYE_RADIUS - 0.0020, &LIDS));
    // The inner corner's little knob, and the fold that leans from it on the eyeball.
    head.add(
        0.0016,
        f.strand(&[
            [x - 0.0132, y - 0.0023, z + 0.0054, 0.0026],
            [x - 0.0112, y - 0.0023, z + 0.0064, 0.0024],
        ]),
    );
}

fn nose(f: &Fit, head: &mut Part) {
    // The bridge: height, centre z, half width, front edge.
    let rows = [
        (1.5760, 0.0960, 0.0125, 0.1190),
        (1.5850, 0.0950, 0.0112, 0.1180),
        (1.5950, 0.0930, 0.0102, 0.1128),
        (1.6050, 0.0915, 0.0094, 0.1072),
        (1.6150, 0.0900, 0.0092, 0.1026),
        (1.6250, 0.0890, 0.0105, 0.1005),
    ];
    let knots = rows.map(|(y, z, w, front)| (y, [z, 0.0, front - z, 0.012, w, w, 0.0]));
    head.add(0.008, f.loft([0.0; 3], DVec3::Z, DVec3::X, 0.008, &knots));
    // Tip, wings, the bridge between the nostrils, the nostrils.
    head.add(0.011, f.ball([0.0, 1.5785, 0.1150], [0.0072, 0.0070, 0.0086]));
    head.add(0.008, f.ball([0.0036, 1.5755, 0.1140], [0.0052, 0.0050, 0.0070]));
    head.add(
        0.0060,
        f.egg([0.0110, 1.5728, 0.1060], [0.0088, 0.0054, 0.0046], [-0.40, -0.05, 1.0], [0.0, 1.0, 0.0]),
    );
    head.add(
        0.006,
        f.strand(&[
            [0.0, 1.5715, 0.1165, 0.0036],
            [0.0, 1.5690, 0.1110, 0.0036],
            [0.0, 1.5670, 0.1050, 0.0042],
        ]),
    );
    head.cut(
        0.0025,
        f.egg([0.0070, 1.5682, 0.1098], [0.0062, 0.0029, 0.0050], [-0.42, 0.15, 1.0], [1.0, 0.0, 0.4]),
    );
}

fn mouth(f: &Fit, head: &mut Part) {
    // The dental arch, the groove over the chin, the groove under the nose and its two ridges.
    head.add(0.022, f.ball([0.0, 1.5490, 0.0780], [0.0290, 0.0250, 0.0300]));
    head.swell(
        -0.0020,
        f.ridge(&[
            [-0.0260, 1.5290, 0.0940, 0.0165],
            [-0.0120, 1.5260, 0.1020, 0.0170],
            [0.0, 1.5250, 0.1050, 0.0170],
            [0.0120, 1.5260, 0.1020, 0.0170],
            [0.0260, 1.5290, 0.0940, 0.0165],
        ]),
    );
    head.swell(
        0.0008,
        f.strand(&[
            [0.0068, 1.5550, 0.1090, 0.0062],
            [0.0058, 1.5610, 0.1070, 0.0056],
            [0.0052, 1.5660, 0.1050, 0.0050],
        ]),
    );
    head.swell(
        -0.0010,
        f.strand(&[
            [0.0, 1.5545, 0.1105, 0.0056],
            [0.0, 1.5610, 0.1080, 0.0052],
            [0.0, 1.5670, 0.1060, 0.0042],
        ]),
    );
    // Upper and lower lip, the line between, the corners.
    head.add(
        0.0050,
        f.strand(&[
            [0.0, 1.5498, 0.1085, 0.0042],
            [0.0058, 1.5510, 0.1080, 0.0044],
            [0.0125, 1.5503, 0.1052, 0.0038],
            [0.0185, 1.5492, 0.1012, 0.0027],
            [0.0250, 1.5487, 0.0950, 0.0011],
        ]),
    );
    head.add(
        0.0065,
        f.strand(&[
            [0.0, 1.5409, 0.1056, 0.0055],
            [0.0065, 1.5411, 0.1050, 0.0054],
            [0.0140, 1.5430, 0.1020, 0.0043],
            [0.0200, 1.5458, 0.0984, 0.0029],
            [0.0250, 1.5484, 0.0948, 0.0011],
        ]),
    );
    head.cut(
        0.0030,
        f.strand(&[
            [0.0, 1.5460, 0.1136, 0.0004],
            [0.0060, 1.5467, 0.1128, 0.0004],
            [0.0125, 1.5466, 0.1094, 0.0004],
            [0.0185, 1.5474, 0.1044, 0.0003],
            [0.0226, 1.5482, 0.1018, 0.0001],
        ]),
    );
    head.swell(-0.0008, f.ball([0.0268, 1.5486, 0.0950], [0.0095, 0.0110, 0.0110]));
}
