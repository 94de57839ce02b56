//! Palm and fingers, as drawn: metres, the left hand with its palm down.

use glam::DVec3;
use rig::{Bone, Skeleton};

use super::field::{Part, Region};
use super::fit::{Fit, figure_scale};
use super::shape::Shape;

/// Thumb to little finger: the three bones of each.
pub const FINGERS: [[Bone; 3]; 5] = [
    [Bone::LeftThumbMetacarpal, Bone::LeftThumbProximal, Bone::LeftThumbDistal],
    [Bone::LeftIndexProximal, Bone::LeftIndexIntermediate, Bone::LeftIndexDistal],
    [Bone::LeftMiddleProximal, Bone::LeftMiddleIntermediate, Bone::LeftMiddleDistal],
    [Bone::LeftRingProximal, Bone::LeftRingIntermediate, Bone::LeftRingDistal],
    [Bone::LeftLittleProximal, Bone::LeftLittleIntermediate, Bone::LeftLittleDistal],
];

/// Last bone's length over the one before it.
const TIP: [f64; 5] = [0.800, 0.677, 0.636, 0.648, 0.797];

/// Radii at the three joints and the tip, metres.
const RADII: [[f64; 4]; 5] = [
    [0.0150, 0.0122, 0.0104, 0.0080],
    [0.0088, 0.0083, 0.0075, 0.0064],
    [0.0088, 0.0084, 0.0077, 0.0066],
    [0.0083, 0.0079, 0.0072, 0.0062],
    [0.0074, 0.0068, 0.0062, 0.0054],
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
        (0.692, [0.000, 0.001, 0.0185, 0.0195, 0.0275, 0.0250, 0.3]),
        (0.712, [-0.001, 0.001, 0.0185, 0.0190, 0.0285, 0.0265, 0.35]),
        (0.735, [-0.001, 0.000, 0.0175, 0.0185, 0.0310, 0.0320, 0.45]),
        (0.758, [-0.001, -0.001, 0.0150, 0.0170, 0.0340, 0.0365, 0.55]),
        (0.778, [-0.001, -0.002, 0.0125, 0.0150, 0.0350, 0.0380, 0.65]),
        (0.791, [-0.001, -0.003, 0.0095, 0.0125, 0.0340, 0.0370, 0.7]),
        (0.801, [-0.001, -0.003, 0.0050, 0.0095, 0.0320, 0.0350, 0.7]),
    ];
    palm.add(0.0, f.loft([0.704, 1.388, 0.0], DVec3::Y, DVec3::Z, 0.006, &rows));
    // Ball of the thumb and its web, ball of the little finger, pads under the knuckles, the hollow.
    palm.add(
        0.014,
        f.egg([0.738, 1.3760, 0.0230], [0.0300, 0.0150, 0.0150], [0.80, -0.30, 0.55], [0.0, 1.0, 0.0]),
    );
    palm.add(
        0.020,
        f.egg([0.756, 1.3790, 0.0315], [0.0210, 0.0080, 0.0100], [0.80, -0.10, 0.30], [0.0, 1.0, 0.0]),
    );
    palm.add(
        0.014,
        f.egg([0.740, 1.3760, -0.0230], [0.0320, 0.0120, 0.0135], [1.0, 0.0, -0.12], [0.0, 1.0, 0.0]),
    );
    palm.add(0.020, f.cone([0.784, 1.3810, 0.0230], 0.0080, [0.776, 1.3800, -0.0280], 0.0075));
    palm.cut(
        0.012,
        f.egg([0.760, 1.3635, -0.0010], [0.0220, 0.0085, 0.0130], [1.0, 0.0, 0.3], [0.0, 1.0, 0.0]),
    );
    // Knuckles and the tendons that run to them.
    for finger in &FINGERS[1..] {
        let at = skeleton.rest_position(finger[0]);
        let g = f.girth();
        let up = DVec3::new(-0.001, 0.0010, 0.0) * g;
        let radii = DVec3::new(0.0095, 0.0082, 0.0080) * g;
        palm.add(0.008, Shape::Ellipsoid { center: at + up, frame: glam::DMat3::IDENTITY, radii });
        let wrist = skeleton.rest_position(Bone::LeftHand);
        let start = wrist.lerp(at, 0.45) + DVec3::Y * 0.0120 * g;
        palm.add(
            0.008,
            Shape::Cone { a: start, b: at + DVec3::Y * 0.0055 * g, ra: 0.003 * g, rb: 0.0035 * g },
        );
    }
    palm
}

/// Where the skin of a finger ends, figure space.
pub fn fingertip(skeleton: &Skeleton, finger: usize) -> DVec3 {
    let [_, middle, last] = FINGERS[finger].map(|b| skeleton.rest_position(b));
    last + (last - middle) * TIP[finger]
}

/// The side of the nail, square to the last bone: up for the fingers, for the thumb across its own plane.
pub fn nail_side(finger: usize, along: DVec3) -> DVec3 {
    let side = if finger == 0 { DVec3::new(0.35, 0.75, -0.55) } else { DVec3::Y };
    (side - along * side.dot(along)).normalize_or(DVec3::Y)
}

/// One finger from its knuckle to its tip.
pub fn finger(skeleton: &Skeleton, number: usize) -> Part {
    let bones = FINGERS[number];
    let [a, b, c] = bones.map(|bone| skeleton.rest_position(bone));
    let g = figure_scale(skeleton);
    let [ra, rb, rc, rt] = RADII[number].map(|r| r * g);
    let tip = fingertip(skeleton, number);
    let thumb = number == 0;
    let along = (tip - c).normalize_or(DVec3::X);
    let up = nail_side(number, along);
    let mut part = Part::new(Region::Finger(number as u8), if thumb { 0.014 } else { 0.005 });
    let start = if thumb { a } else { a + (a - b).normalize_or(-DVec3::X) * 0.006 * g };
    part.add(0.0, Shape::Cone { a: start, b, ra, rb: rb * 0.97 });
    part.add(0.004 * g, Shape::Cone { a: b, b: c, ra: rb * 0.97, rb: rc * 0.97 });
    let end = tip - along * rt;
    part.add(0.004 * g, Shape::Cone { a: c, b: end, ra: rc * 0.95, rb: rt });
    // Joints a little wider, pads on the palm side, a flat place for the nail.
    let (pad, frame) = (rb * 1.02, glam::DMat3::from_cols(along, up, along.cross(up)));
    part.add(
        0.005 * g,
        Shape::Ellipsoid { center: b + up * rb * 0.04, frame, radii: DVec3::new(pad * 1.15, pad, pad) },
    );
    part.add(
        0.004 * g,
        Shape::Ellipsoid { center: c, frame, radii: DVec3::new(rc * 1.2, rc * 0.99, rc * 1.01) },
    );
    let mid = |p: DVec3, q: DVec3, r: f64| p.lerp(q, 0.48) - up * r * 0.22;
    part.add(
        0.005 * g,
        Shape::Ellipsoid {
            center: mid(b, c, rb),
            frame,
            radii: DVec3::new((c - b).length() * 0.38, rb * 0.80, rb * 0.90),
        },
    );
    if !thumb {
        part.add(
            0.005 * g,
            Shape::Ellipsoid {
                center: a.lerp(b, 0.62) - up * ra * 0.26,
                frame,
                radii: DVec3::new((b - a).length() * 0.28, ra * 0.84, ra * 0.94),
            },
        );
    }
    part.add(
        0.005 * g,
        Shape::Ellipsoid {
            center: c.lerp(tip, 0.55) - up * rt * 0.22,
            frame,
            radii: DVec3::new((tip - c).length() * 0.44, rt * 0.98, rt * 1.12),
        },
    );
    let nail = c.lerp(tip, 0.66) + up * (rt * 1.0 + 0.0072 * g);
    part.cut(
        0.003 * g,
        Shape::Slab {
            center: nail,
            frame,
            half: DVec3::new(0.0075, 0.0075, 0.0052) * g * (rt / (0.0064 * g)),
            round: 0.0025 * g,
        },
    );
    part
}
