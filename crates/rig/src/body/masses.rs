//! Masses of a body: shares of segments by sex, by volume, and the whole by stature and build.

use glam::DVec3;

use super::{Body, BodySlider};
use crate::{Bone, Joint, Mesh, bone_of_place};

/// Kilograms of body to a cubic metre.
const DENSITY: f64 = 1000.0;

/// Total mass over that of the figure as it is: by the square of the stature (the same body mass index), and by 25 %
/// less or 40 % more from build, 12 % from muscle, 30 % less for a child's body.
pub(super) fn total_factor(body: &Body, stature_factor: f64) -> f64 {
    let build = body.off(BodySlider::Build);
    let by_build = 1.0 + build * if build < 0.0 { 0.25 } else { 0.40 };
    let by_muscle = 1.0 + 0.12 * body.off(BodySlider::Muscle);
    let by_age = 1.0 + 0.30 * body.off(BodySlider::Age).min(0.0);
    stature_factor * stature_factor * by_build * by_muscle * by_age
}

/// A segment's share of the whole body over the mean of both sexes. [DE-LEVA-1996]
pub(super) fn share_by_sex(bone: Bone, sex: f64) -> f64 {
    let (man, woman) = match bone {
        Bone::Neck | Bone::Head | Bone::Jaw | Bone::LeftEye | Bone::RightEye => (0.0694, 0.0668),
        Bone::UpperChest | Bone::LeftShoulder | Bone::RightShoulder => (0.1596, 0.1545),
        Bone::Spine | Bone::Chest => (0.1633, 0.1465),
        Bone::Hips => (0.1117, 0.1247),
        Bone::LeftUpperArm | Bone::RightUpperArm => (0.0271, 0.0255),
        Bone::LeftLowerArm | Bone::RightLowerArm => (0.0162, 0.0138),
        Bone::LeftUpperLeg | Bone::RightUpperLeg => (0.1416, 0.1478),
        Bone::LeftLowerLeg | Bone::RightLowerLeg => (0.0433, 0.0481),
        Bone::LeftFoot | Bone::RightFoot | Bone::LeftToes | Bone::RightToes => (0.0137, 0.0129),
        _ => (0.0061, 0.0056),
    };
    let mean = 0.5 * (man + woman);
    (mean + 0.5 * sex * (woman - man)) / mean
}

/// Cubic metres by which each bone's part of a skin grows as its vertices move: the swept layer, by weights.
pub(super) fn swept(before: &Mesh, after: &Mesh) -> [f64; Bone::COUNT] {
    let mut volumes = [0.0; Bone::COUNT];
    let at = |mesh: &Mesh, v: u32| DVec3::from(mesh.positions[v as usize].map(f64::from));
    for t in before.indices.chunks_exact(3) {
        let [a, b, c] = [t[0], t[1], t[2]].map(|v| at(before, v));
        let area = 0.5 * (b - a).cross(c - a);
        for &v in t {
            let layer = area.dot(at(after, v) - at(before, v)) / 3.0;
            if layer == 0.0 {
                continue;
            }
            let rows = before.joints[v as usize].iter().zip(before.weights[v as usize]);
            for (joint, weight) in rows {
                volumes[bone_of_place(usize::from(*joint)).index()] += layer * f64::from(weight) / 65535.0;
            }
        }
    }
    volumes
}

/// Gives joints their masses: the shares that they had, times `factor` each and what their volume gained, brought to
/// a total of `total` times what it was.
pub(super) fn share_out(
    joints: &mut [Joint],
    factor: impl Fn(Bone) -> f64,
    gained: &[f64; Bone::COUNT],
    total: f64,
) {
    let before: f64 = joints.iter().map(|j| j.mass).sum();
    for joint in joints.iter_mut().filter(|j| j.mass > 0.0) {
        let grown = 1.0 + gained[joint.bone.index()] * DENSITY / joint.mass;
        joint.mass *= factor(joint.bone) * grown.clamp(0.3, 4.0);
    }
    let after: f64 = joints.iter().map(|j| j.mass).sum();
    if after > 0.0 {
        joints.iter_mut().for_each(|j| j.mass *= total * before / after);
    }
}
