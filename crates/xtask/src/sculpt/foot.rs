//! The foot and its toes, as drawn: metres, the left foot.

use glam::DVec3;
use rig::{Bone, Skeleton};

use super::field::{Part, Region};
use super::fit::Fit;

/// Drawn places of the toes' middle line: x, base z, tip z, radius; big toe first.
const TOES: [(f64, f64, f64, f64); 5] = [
    (0.0625, 0.132, 0.1990, 0.0116),
    (0.0860, 0.130, 0.1965, 0.0084),
    (0.1005, 0.126, 0.1870, 0.0080),
    (0.1145, 0.119, 0.1755, 0.0076),
    (0.1270, 0.110, 0.1620, 0.0078),
];

fn fit(skeleton: &Skeleton) -> Fit {
    Fit::chain(
        skeleton,
        DVec3::Z,
        &[(Bone::LeftFoot, [0.086, 0.067, 0.0]), (Bone::LeftToes, [0.086, 0.022, 0.126])],
    )
}

/// Heel, instep and ball.
pub fn foot(skeleton: &Skeleton) -> Part {
    let f = fit(skeleton);
    let mut foot = Part::new(Region::Foot, 0.034);
    foot.add(
        0.0,
        f.egg([0.087, 0.0300, -0.0200], [0.0360, 0.0330, 0.0290], [0.0, -0.1, -1.0], [0.0, 1.0, 0.0]),
    );
    foot.add(0.030, f.cone([0.0860, 0.0600, 0.0100], 0.0320, [0.0820, 0.0360, 0.0780], 0.0240));
    foot.add(0.028, f.cone([0.0820, 0.0360, 0.0780], 0.0240, [0.0800, 0.0200, 0.1240], 0.0170));
    foot.add(0.024, f.cone([0.1020, 0.0170, -0.0150], 0.0190, [0.1130, 0.0150, 0.0700], 0.0170));
    foot.add(0.024, f.cone([0.1130, 0.0150, 0.0700], 0.0170, [0.1180, 0.0140, 0.1080], 0.0140));
    foot.add(0.020, f.cone([0.0660, 0.0170, 0.1260], 0.0185, [0.1140, 0.0140, 0.1080], 0.0145));
    foot.add(0.020, f.cone([0.0700, 0.0260, 0.0500], 0.0180, [0.0650, 0.0185, 0.1180], 0.0180));
    // The arch, and the sole flat on the ground.
    foot.cut(0.020, f.ball([0.0480, 0.0000, 0.0450], [0.0260, 0.0190, 0.0480]));
    foot.cut(0.008, f.slab([0.0860, -0.0500, 0.0700], [0.1500, 0.0500, 0.2500], 0.001));
    foot
}

/// One toe.
pub fn toe(skeleton: &Skeleton, number: usize) -> Part {
    let f = fit(skeleton);
    let (x, base, tip, r) = TOES[number];
    let mut toe = Part::new(Region::Toe(number as u8), 0.010);
    let length = tip - base;
    let knuckle = [x, r * 1.30 + 0.004, base + length * 0.38];
    toe.add(0.0, f.cone([x, 0.0170, base - 0.006], r * 1.02, knuckle, r * 0.92));
    toe.add(0.004, f.cone(knuckle, r * 0.92, [x, r * 1.02, tip - r], r * 0.94));
    toe.add(0.004, f.ball([x, r * 0.98, tip - r * 1.25], [r * 1.05, r, r * 1.25]));
    toe.cut(0.004, f.slab([0.0860, -0.0500, 0.0700], [0.1500, 0.0500, 0.2500], 0.001));
    toe
}
