//! Whether a limb runs inside the body: ranges allow it, but there the skin passes through itself whatever its weights.

use glam::DVec3;
use rig::{Angles, Bone, Mesh, Palette, Skeleton};

use super::stances::{Stance, palette};

/// The first and the second bone of each limb.
const LIMBS: [(Bone, Bone); 4] = [
    (Bone::LeftUpperArm, Bone::LeftLowerArm),
    (Bone::RightUpperArm, Bone::RightLowerArm),
    (Bone::LeftUpperLeg, Bone::LeftLowerLeg),
    (Bone::RightUpperLeg, Bone::RightLowerLeg),
];

/// The skin at rest without one limb.
struct Remainder {
    limb: (Bone, Bone),
    triangles: Vec<[DVec3; 3]>,
}

/// Tells limbs inside the body from those outside.
pub struct Depths(Vec<Remainder>);

impl Depths {
    /// Of a whole skin at rest.
    pub fn new(mesh: &Mesh) -> Depths {
        let place = |v: &u32| DVec3::from(mesh.positions[*v as usize].map(f64::from));
        let belongs = |v: &u32, limb: Bone| {
            let parts = mesh.joints[*v as usize].iter().zip(mesh.weights[*v as usize]);
            let own = |place: u8| {
                let mut bone = rig::bone_of_place(usize::from(place));
                while bone != limb && bone != Bone::Hips {
                    bone = bone.carrier();
                }
                bone == limb
            };
            parts.filter(|(j, _)| own(**j)).map(|(_, w)| u32::from(w)).sum::<u32>() > 32768
        };
        let remainder = |limb: (Bone, Bone)| {
            let triangles = mesh.indices.chunks_exact(3).filter(|t| !t.iter().any(|v| belongs(v, limb.0)));
            Remainder { limb, triangles: triangles.map(|t| [&t[0], &t[1], &t[2]].map(place)).collect() }
        };
        Depths(LIMBS.map(remainder).into())
    }

    /// The stance with its palette, limbs drawn back toward rest until none runs inside the body, and then some more, as
    /// limbs are thick.
    pub fn freed(&self, skeleton: &Skeleton, mut stance: Stance) -> Option<(Stance, Palette)> {
        let mut back = Vec::new();
        for _ in 0..12 {
            let now = palette(skeleton, &stance.angles);
            let held: Vec<Bone> =
                self.0.iter().filter(|r| r.holds(skeleton, &now)).map(|r| r.limb.0).collect();
            if held.is_empty() && back.is_empty() {
                return Some((stance, now));
            }
            for bone in if held.is_empty() { &back } else { &held } {
                let angles: &mut Angles = &mut stance.angles[bone.index()];
                angles.flexion *= 0.88;
                angles.abduction *= 0.88;
            }
            back = held;
        }
        None
    }
}

impl Remainder {
    fn holds(&self, skeleton: &Skeleton, palette: &Palette) -> bool {
        let (root, next) = self.limb;
        let [from, to] = [root, next].map(|b| skeleton.rest_position(b));
        let posed = |t: f64| palette.point(root, from.lerp(to, t).as_vec3()).as_dvec3();
        // Limbs are thick: a thigh that leans farther inward than this goes through the other one, an upper arm whose
        // elbow comes to the middle plane through the chest.
        let leg = root.part().name().ends_with("Leg");
        let (nearest, middle, inward) = if leg { (0.25, 0.5, 0.4) } else { (0.4, 1.0, 0.1) };
        [nearest, 0.7, 1.0].iter().any(|t| winding(&self.triangles, posed(*t)) > 0.5)
            || posed(middle).x * from.x.signum() < inward * from.x.abs()
    }
}

/// How often the triangles wind around a point: 1 inside a closed surface, 0 outside, in between where it is open.
fn winding(triangles: &[[DVec3; 3]], p: DVec3) -> f64 {
    let solid = |triangle: &[DVec3; 3]| {
        let [a, b, c] = triangle.map(|q| q - p);
        let (la, lb, lc) = (a.length(), b.length(), c.length());
        let below = la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb;
        2.0 * a.dot(b.cross(c)).atan2(below)
    };
    triangles.iter().map(solid).sum::<f64>() / (4.0 * std::f64::consts::PI)
}
