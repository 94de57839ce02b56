//! Palm and fingers, as drawn: metres, the left hand with its palm down.

use glam::DVec3;
use rig::{Bone, Skeleton};

use super::blend::ease;
use super::curve::Curve;
use super::field::{Part, Region};
use super::fit::{Fit, figure_scale};
use super::shape::{Loft, Section, Shape};

/// Thumb to little finger: the three bones of each.
pub const FINGERS: [[Bone; 3]; 5] = [
    [Bone::LeftThumbMetacarpal, Bone::LeftThumbProximal, Bone::LeftThumbDistal],
    [Bone::LeftIndexProximal, Bone::LeftIndexIntermediate, Bone::LeftIndexDistal],
    [Bone::LeftMiddleProximal, Bone::LeftMiddleIntermediate, Bone::LeftMiddleDistal],
    [Bone::LeftRingProximal, Bone::LeftRingIntermediate, Bone::LeftRingDistal],
    [Bone::LeftLittleProximal, Bone::LeftLittleIntermediate, Bone::LeftLittleDistal],
];

/// Last bone's length over the one before it.
const TIP: [f64; 5] = [0.800, 0.774, 0.715, 0.730, 0.903];

/// Half the width of each finger at its middle joint, metres.
const WIDTH: [f64; 5] = [0.0105, 0.0094, 0.0093, 0.0084, 0.0077];

/// Sections of a long finger: the bone (0 to 2), how far along it, half width, height to the back, to the palm side;
/// in half widths of the middle joint. Joints are wide, pads lie between them.
const FINGER: [(usize, f64, [f64; 3]); 13] = [
    (0, -0.30, [0.92, 0.82, 1.10]),
    (0, 0.00, [1.00, 0.94, 1.26]),
    (0, 0.30, [0.98, 0.91, 1.34]),
    (0, 0.58, [0.945, 0.84, 1.38]),
    (0, 0.85, [0.94, 0.87, 1.08]),
    (0, 1.00, [1.00, 0.93, 0.90]),
    (1, 0.18, [0.965, 0.87, 0.98]),
    (1, 0.50, [0.90, 0.77, 1.16]),
    (1, 0.82, [0.87, 0.76, 0.90]),
    (1, 1.00, [0.89, 0.78, 0.79]),
    (2, 0.25, [0.85, 0.71, 0.80]),
    (2, 0.55, [0.81, 0.63, 0.77]),
    (2, 0.80, [0.70, 0.52, 0.65]),
];

/// Sections of the thumb, from within the ball of the thumb on.
const THUMB: [(usize, f64, [f64; 3]); 11] = [
    (0, 0.12, [0.84, 0.79, 1.05]),
    (0, 0.50, [1.05, 0.92, 1.28]),
    (0, 0.82, [1.08, 0.99, 1.21]),
    (0, 1.00, [1.05, 1.02, 1.08]),
    (1, 0.30, [0.96, 0.87, 1.06]),
    (1, 0.70, [0.93, 0.84, 0.98]),
    (1, 1.00, [1.00, 0.93, 0.90]),
    (2, 0.22, [0.99, 0.85, 0.89]),
    (2, 0.50, [0.98, 0.73, 0.84]),
    (2, 0.70, [0.90, 0.63, 0.77]),
    (2, 0.82, [0.80, 0.54, 0.66]),
];

/// The drawn places from the wrist to the knuckles.
fn palm_fit(skeleton: &Skeleton) -> Fit {
    Fit::chain(
        skeleton,
        DVec3::X,
        &[(Bone::LeftHand, [0.704, 1.388, 0.0]), (Bone::LeftMiddleProximal, [0.7867, 1.390, 0.004])],
    )
}

/// The palm.
pub fn palm(skeleton: &Skeleton) -> Part {
    let f = palm_fit(skeleton);
    let mut palm = Part::new(Region::Palm, 0.014);
    let rows = [
        // It grows out of the forearm, without a cuff.
        (0.672, [0.000, 0.001, 0.0100, 0.0110, 0.0180, 0.0160, 0.2]),
        (0.694, [0.000, 0.001, 0.0155, 0.0165, 0.0245, 0.0220, 0.3]),
        (0.714, [-0.001, 0.001, 0.0178, 0.0188, 0.0280, 0.0262, 0.35]),
        (0.735, [-0.001, 0.000, 0.0165, 0.0175, 0.0305, 0.0320, 0.45]),
        (0.758, [-0.001, -0.002, 0.0142, 0.0160, 0.0330, 0.0360, 0.55]),
        (0.774, [-0.001, -0.003, 0.0122, 0.0142, 0.0355, 0.0360, 0.62]),
        (0.787, [-0.001, -0.003, 0.0098, 0.0122, 0.0360, 0.0310, 0.66]),
    ];
    palm.add(0.0, f.loft([0.704, 1.388, 0.0], DVec3::Y, DVec3::Z, 0.010, &rows));
    pads(&f, &mut palm);
    webs(&f, &mut palm);
    back(skeleton, &f, &mut palm);
    palm
}

/// Ball of the thumb, ball of the little finger, pads under the knuckles, the hollow.
fn pads(f: &Fit, palm: &mut Part) {
    palm.add(
        0.014,
        f.egg([0.7400, 1.3740, 0.0240], [0.0300, 0.0150, 0.0145], [0.80, -0.28, 0.53], [0.0, 1.0, 0.0]),
    );
    palm.add(
        0.012,
        f.egg([0.7400, 1.3755, -0.0235], [0.0330, 0.0120, 0.0125], [1.0, 0.0, -0.10], [0.0, 1.0, 0.0]),
    );
    // The skin between thumb and index finger.
    palm.add(
        0.016,
        f.strand(&[
            [0.7780, 1.3835, 0.0265, 0.0068],
            [0.7690, 1.3790, 0.0380, 0.0066],
            [0.7590, 1.3715, 0.0455, 0.0070],
        ]),
    );
    for [x, z] in [[0.7830, 0.0145], [0.7815, -0.0055], [0.7750, -0.0235]] {
        palm.swell(0.0016, f.ball([x, 1.3730, z], [0.0130, 0.0110, 0.0110]));
    }
    palm.swell(
        -0.0028,
        f.egg([0.7490, 1.3680, -0.0020], [0.0270, 0.0180, 0.0165], [1.0, 0.0, 0.25], [0.0, 1.0, 0.0]),
    );
}

/// The skin between the long fingers: from between the knuckles it slopes down to the palm's side and ends two fifths of
/// the way to the middle joints.
fn webs(f: &Fit, palm: &mut Part) {
    for (x, y, z) in [(0.7865, 1.3885, 0.0145), (0.7830, 1.3885, -0.0055), (0.7748, 1.3865, -0.0235)] {
        palm.add(
            0.006,
            f.strand(&[
                [x - 0.0080, y - 0.0030, z, 0.0084],
                [x + 0.0040, y - 0.0052, z, 0.0060],
                [x + 0.0135, y - 0.0072, z, 0.0040],
            ]),
        );
    }
}

/// Knuckles, the valleys between them, tendons.
fn back(skeleton: &Skeleton, f: &Fit, palm: &mut Part) {
    let g = f.girth();
    let wrist = skeleton.rest_position(Bone::LeftHand);
    for (finger, height) in FINGERS[1..].iter().zip([0.0036, 0.0034, 0.0027, 0.0024]) {
        let at = skeleton.rest_position(finger[0]);
        let top = at + DVec3::new(-0.0010, 0.0105, 0.0) * g;
        let ball = |center: DVec3, radii: DVec3| Shape::Ellipsoid {
            center,
            frame: glam::DMat3::IDENTITY,
            radii: radii * g,
        };
        palm.swell(height * g, ball(top, DVec3::new(0.0160, 0.0140, 0.0108)));
        let start = wrist.lerp(at, 0.48) + DVec3::Y * 0.0150 * g;
        let end = at + DVec3::new(-0.012, 0.0115, 0.0) * g;
        palm.swell(0.0013 * g, Shape::Cone { a: start, b: end, ra: 0.0055 * g, rb: 0.0060 * g });
    }
    for pair in FINGERS[1..].windows(2) {
        let [one, other] = [0, 1].map(|i| skeleton.rest_position(pair[i][0]));
        let between = one.lerp(other, 0.5) + DVec3::new(-0.002, 0.0100, 0.0) * g;
        let radii = DVec3::new(0.0150, 0.0100, 0.0060) * g;
        palm.swell(-0.0016 * g, Shape::Ellipsoid { center: between, frame: glam::DMat3::IDENTITY, radii });
    }
}

/// Where the skin of a finger ends, figure space.
pub fn fingertip(skeleton: &Skeleton, finger: usize) -> DVec3 {
    let [_, middle, last] = FINGERS[finger].map(|b| skeleton.rest_position(b));
    last + (last - middle) * TIP[finger]
}

/// The side of the nail, square to the last bone: up for the fingers; for the thumb opposite to where it bends, turned
/// a little up.
pub fn nail_side(finger: usize, along: DVec3) -> DVec3 {
    let side = if finger == 0 { DVec3::new(-0.349, 0.606, 0.723) } else { DVec3::Y };
    (side - along * side.dot(along)).normalize_or(DVec3::Y)
}

/// A finger's bones as one straight line from its base, with the side of its nail.
struct Line {
    base: DVec3,
    along: DVec3,
    up: DVec3,
    /// Where each bone begins and the tip, metres from the base.
    stops: [f64; 4],
    /// Half the width at the middle joint.
    width: f64,
}

impl Line {
    fn new(skeleton: &Skeleton, number: usize) -> Line {
        let [a, b, c] = FINGERS[number].map(|bone| skeleton.rest_position(bone));
        let tip = fingertip(skeleton, number);
        let along = (tip - a).normalize_or(DVec3::X);
        let stops = [a, b, c, tip].map(|p| (p - a).dot(along));
        let width = WIDTH[number] * figure_scale(skeleton);
        Line { base: a, along, up: nail_side(number, along), stops, width }
    }

    /// Metres from the base at a part of a bone.
    fn at(&self, bone: usize, part: f64) -> f64 {
        self.stops[bone] + (self.stops[bone + 1] - self.stops[bone]) * part
    }

    /// A place: metres along, then half widths across and to the nail's side.
    fn place(&self, along: f64, across: f64, up: f64) -> DVec3 {
        let side = self.up.cross(self.along);
        self.base + self.along * along + (side * across + self.up * up) * self.width
    }

    /// Columns across, to the nail's side, along.
    fn frame(&self) -> glam::DMat3 {
        glam::DMat3::from_cols(self.up.cross(self.along), self.up, self.along)
    }
}

/// One finger from its knuckle to its tip.
pub fn finger(skeleton: &Skeleton, number: usize) -> Part {
    let thumb = number == 0;
    let g = figure_scale(skeleton);
    let line = Line::new(skeleton, number);
    let w = line.width;
    let mut part = Part::new(Region::Finger(number as u8), if thumb { 0.014 } else { 0.010 });
    let table: &[(usize, f64, [f64; 3])] = if thumb { &THUMB } else { &FINGER };
    let rows: Vec<(f64, Section)> = table
        .iter()
        .map(|&(bone, t, [wide, back, front])| {
            (line.at(bone, t), [0.0, 0.0, wide * w, wide * w, back * w, front * w, 0.12])
        })
        .collect();
    part.add(
        0.0,
        Shape::Loft(Loft {
            origin: line.base,
            frame: line.frame(),
            sections: Curve::new(&rows),
            cap: 0.5 * w,
        }),
    );
    // The finger's end, with its pad.
    let last = line.stops[3] - line.stops[2];
    let (reach, broad) = if thumb { (0.36, 0.86) } else { (0.40, 0.76) };
    part.add(
        0.4 * w,
        Shape::Ellipsoid {
            center: line.place(line.stops[3] - reach * last, 0.0, -0.10),
            frame: line.frame(),
            radii: DVec3::new(broad * w, 0.66 * w, reach * last),
        },
    );
    nail(&line, thumb, g, &mut part);
    part
}

/// Half the width and the height of a nail's outline, in half widths of the finger.
fn nail_size(thumb: bool) -> (f64, f64) {
    if thumb { (0.68, 0.62) } else { (0.58, 0.56) }
}

/// The groove around the nail.
fn nail(line: &Line, thumb: bool, g: f64, part: &mut Part) {
    let (wide, high) = nail_size(thumb);
    let outline = [(0.97, -0.94, 0.62), (0.84, -1.00, 0.80), (0.66, -1.00, 0.90), (0.52, -0.86, 1.02)];
    let root = [(0.455, -0.45, 1.18), (0.44, 0.0, 1.24), (0.455, 0.45, 1.18)];
    let back = outline.iter().rev().map(|(t, across, up)| (*t, -across, *up));
    let edge = outline.iter().copied().chain(root).chain(back);
    let bead =
        |(t, across, up): (f64, f64, f64)| (line.place(line.at(2, t), across * wide, up * high), 0.0004 * g);
    part.cut(0.0022 * g, Shape::Strand(edge.map(bead).collect()));
}

/// How much a place belongs to a finger's nail, 0 to 1.
pub fn nail_share(skeleton: &Skeleton, finger: usize, p: DVec3) -> f64 {
    let line = Line::new(skeleton, finger);
    let d = p - line.base;
    let t = (d.dot(line.along) - line.stops[2]) / (line.stops[3] - line.stops[2]);
    let (wide, _) = nail_size(finger == 0);
    let across = d.dot(line.frame().x_axis).abs() / (line.width * wide);
    let root = 0.46 + 0.12 * across * across * across * across;
    let back = d.dot(line.up) / line.width;
    ease(1.05, 0.88, across) * ease(root - 0.02, root + 0.03, t) * ease(0.15, 0.35, back)
}

/// Whether a place is on the back of a finger's end, where the skin must be fine enough for a nail.
pub fn near_nail(skeleton: &Skeleton, p: DVec3) -> bool {
    let g = figure_scale(skeleton);
    (0..5).any(|finger| {
        let last = skeleton.rest_position(FINGERS[finger][2]);
        let tip = fingertip(skeleton, finger);
        let up = nail_side(finger, (tip - last).normalize_or(DVec3::X));
        let reach = if finger == 0 { 0.0120 } else { 0.0092 } * g;
        p.distance(last.lerp(tip, 0.70) + up * (0.005 * g)) < reach && (p - last).dot(up) > 0.001 * g
    })
}
