//! The ear, drawn on its own plane: metres backward (u), upward (v) and outward (n) from the ear hole.

use glam::DVec3;
use rig::Skeleton;

use super::field::{Part, Region};
use super::fit::Fit;
use super::head::head_fit;
use super::physique::Physique;
use super::shape::Shape;

/// The drawn place of the ear hole.
const HOLE: [f64; 3] = [0.0650, 1.5940, 0.0010];

/// The ear's plane: its back stands 22 degrees off the head, its top leans 10 degrees back and a little out.
const BACK: DVec3 = DVec3::new(0.375, -0.160, -0.913);
const UP: DVec3 = DVec3::new(0.080, 0.982, -0.172);

struct Plane {
    fit: Fit,
    size: f64,
}

impl Plane {
    fn at(&self, [u, v, n]: [f64; 3]) -> [f64; 3] {
        let out = UP.cross(BACK).normalize() * -1.0;
        let across = BACK.normalize() * u + UP.normalize() * v + out * n;
        (DVec3::from(HOLE) + across * self.size).to_array()
    }

    fn line(&self, knots: &[[f64; 4]]) -> Shape {
        let place = |k: &[f64; 4]| {
            let [x, y, z] = self.at([k[0], k[1], k[2]]);
            [x, y, z, k[3]]
        };
        self.fit.strand(&knots.iter().map(place).collect::<Vec<_>>())
    }

    /// A ball with radii along u, v and n.
    fn ball(&self, at: [f64; 3], radii: [f64; 3]) -> Shape {
        self.fit.egg(self.at(at), radii, BACK.to_array(), UP.to_array())
    }
}

/// The ear, a little larger in men and with age: plate and bowl, rim, inner fold, the two knobs before the hole, lobe.
pub fn ear(skeleton: &Skeleton, physique: &Physique) -> Part {
    let size = 1.0 - 0.03 * physique.sex + 0.05 * physique.age;
    let plane = Plane { fit: head_fit(skeleton), size };
    let mut ear = Part::new(Region::Ear, 0.005);
    ear.add(0.0, plane.ball([0.0122, 0.0080, 0.0012], [0.0158, 0.0275, 0.0030]));
    ear.add(0.008, plane.ball([0.0080, 0.0020, -0.0050], [0.0100, 0.0150, 0.0060]));
    // The lobe.
    ear.add(0.010, plane.ball([0.0055, -0.0195, 0.0012], [0.0066, 0.0066, 0.0028]));
    // Rim.
    ear.add(
        0.0016,
        plane.line(&[
            [0.0065, 0.0050, 0.0005, 0.0014],
            [0.0015, 0.0085, 0.0018, 0.0020],
            [-0.0015, 0.0160, 0.0030, 0.0023],
            [0.0005, 0.0250, 0.0040, 0.0025],
            [0.0060, 0.0318, 0.0046, 0.0026],
            [0.0135, 0.0340, 0.0048, 0.0026],
            [0.0205, 0.0312, 0.0046, 0.0025],
            [0.0252, 0.0248, 0.0042, 0.0024],
            [0.0266, 0.0165, 0.0040, 0.0023],
            [0.0252, 0.0075, 0.0038, 0.0021],
            [0.0215, -0.0020, 0.0034, 0.0019],
            [0.0165, -0.0105, 0.0028, 0.0018],
            [0.0120, -0.0180, 0.0020, 0.0018],
        ]),
    );
    // The fold within the rim and its two legs.
    ear.add(
        0.0030,
        plane.line(&[
            [0.0085, -0.0110, 0.0030, 0.0022],
            [0.0140, -0.0070, 0.0034, 0.0020],
            [0.0178, 0.0000, 0.0040, 0.0021],
            [0.0186, 0.0080, 0.0044, 0.0022],
            [0.0172, 0.0155, 0.0040, 0.0022],
            [0.0140, 0.0235, 0.0024, 0.0020],
        ]),
    );
    ear.add(
        0.0030,
        plane.line(&[
            [0.0172, 0.0140, 0.0036, 0.0018],
            [0.0120, 0.0165, 0.0024, 0.0017],
            [0.0060, 0.0170, 0.0010, 0.0014],
        ]),
    );
    // The bowl and the hole, then the knob that half covers it.
    ear.cut(0.0035, plane.ball([0.0092, 0.0015, 0.0042], [0.0076, 0.0106, 0.0066]));
    ear.add(
        0.0030,
        plane.line(&[
            [-0.0010, 0.0055, 0.0020, 0.0024],
            [0.0006, 0.0010, 0.0034, 0.0026],
            [-0.0002, -0.0045, 0.0022, 0.0024],
        ]),
    );
    ear
}
