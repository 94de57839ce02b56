//! A procedural body of tapered capsules, and shapes whose pictures are known exactly.
#![allow(dead_code)]

use glam::{DQuat, DVec3, Vec3};
use rig::{Bone, Frame, Frames, Mesh, Palette};

/// Bone, start, end (left side or middle, metres), radii.
type Capsule = (Bone, [f32; 3], [f32; 3], f32, f32);

const CAPSULES: [Capsule; 18] = [
    (Bone::Hips, [0.0, 0.96, 0.0], [0.0, 1.02, 0.0], 0.135, 0.125),
    (Bone::Spine, [0.0, 1.06, 0.01], [0.0, 1.14, 0.01], 0.118, 0.115),
    (Bone::Chest, [0.0, 1.18, 0.01], [0.0, 1.28, 0.0], 0.125, 0.13),
    (Bone::UpperChest, [0.0, 1.30, 0.0], [0.0, 1.40, -0.01], 0.128, 0.085),
    (Bone::Neck, [0.0, 1.46, -0.01], [0.0, 1.54, 0.0], 0.05, 0.048),
    (Bone::Head, [0.0, 1.60, 0.02], [0.0, 1.68, 0.02], 0.082, 0.095),
    (Bone::LeftShoulder, [0.05, 1.41, 0.0], [0.16, 1.415, 0.0], 0.06, 0.058),
    (Bone::LeftUpperArm, [0.18, 1.41, 0.0], [0.44, 1.41, 0.0], 0.055, 0.042),
    (Bone::LeftLowerArm, [0.45, 1.41, 0.0], [0.69, 1.41, 0.0], 0.043, 0.03),
    (Bone::LeftHand, [0.70, 1.41, 0.0], [0.78, 1.41, 0.01], 0.032, 0.034),
    (Bone::LeftIndexProximal, [0.80, 1.41, 0.025], [0.86, 1.41, 0.03], 0.011, 0.009),
    (Bone::LeftMiddleProximal, [0.80, 1.41, 0.005], [0.87, 1.41, 0.005], 0.011, 0.009),
    (Bone::LeftRingProximal, [0.80, 1.41, -0.015], [0.86, 1.41, -0.018], 0.011, 0.009),
    (Bone::LeftThumbProximal, [0.73, 1.40, 0.03], [0.78, 1.385, 0.055], 0.014, 0.010),
    (Bone::LeftUpperLeg, [0.09, 0.92, 0.0], [0.095, 0.52, 0.0], 0.09, 0.058),
    (Bone::LeftLowerLeg, [0.095, 0.50, 0.0], [0.095, 0.12, -0.015], 0.056, 0.036),
    (Bone::LeftFoot, [0.095, 0.045, -0.03], [0.105, 0.035, 0.10], 0.045, 0.035),
    (Bone::LeftToes, [0.107, 0.03, 0.13], [0.11, 0.026, 0.17], 0.03, 0.026),
];

/// Where the joints are at rest.
pub fn rest() -> [DVec3; Bone::COUNT] {
    let mut at = [DVec3::new(0.0, 0.98, 0.0); Bone::COUNT];
    for bone in Bone::ALL {
        at[bone.index()] = at[bone.carrier().index()];
        for (b, from, _, _, _) in CAPSULES {
            let from = Vec3::from(from).as_dvec3();
            if b == bone {
                at[bone.index()] = from;
            } else if b.mirrored() == bone {
                at[bone.index()] = from * DVec3::new(-1.0, 1.0, 1.0);
            }
        }
    }
    at
}

/// The palette of a pose given as turns of joints in their carriers' frames.
pub fn posed(turns: &[(Bone, DQuat)]) -> Palette {
    let rest = rest();
    let mut frames = Frames(rest.map(|position| Frame { rotation: DQuat::IDENTITY, position }));
    for bone in Bone::ALL {
        let turn = turns.iter().find(|t| t.0 == bone).map_or(DQuat::IDENTITY, |t| t.1);
        let carrier = bone.carrier();
        if bone == carrier {
            frames.0[bone.index()].rotation = turn;
            continue;
        }
        let base = frames.0[carrier.index()];
        let offset = rest[bone.index()] - rest[carrier.index()];
        frames.0[bone.index()] =
            Frame { rotation: base.rotation * turn, position: base.position + base.rotation * offset };
    }
    Palette::new(&frames, &rest)
}

/// A relaxed pose with one arm raised.
pub fn standing() -> Palette {
    let q = |x: f64, y: f64, z: f64| {
        DQuat::from_euler(glam::EulerRot::ZYX, z.to_radians(), y.to_radians(), x.to_radians())
    };
    posed(&[
        (Bone::LeftUpperArm, q(0.0, -25.0, -30.0)),
        (Bone::LeftLowerArm, q(0.0, -95.0, 0.0)),
        (Bone::RightUpperArm, q(0.0, 0.0, 75.0)),
        (Bone::RightLowerArm, q(0.0, 25.0, 0.0)),
        (Bone::Chest, q(0.0, 8.0, 4.0)),
        (Bone::Head, q(8.0, 20.0, 0.0)),
        (Bone::LeftUpperLeg, q(0.0, 0.0, 6.0)),
        (Bone::RightUpperLeg, q(-22.0, 0.0, -6.0)),
        (Bone::RightLowerLeg, q(28.0, 0.0, 0.0)),
    ])
}

/// A body of some 15,000 vertices.
pub fn mesh() -> Mesh {
    let mut mesh = Mesh::default();
    for (bone, from, to, r0, r1) in CAPSULES {
        let (from, to) = (Vec3::from(from), Vec3::from(to));
        let flip = Vec3::new(-1.0, 1.0, 1.0);
        capsule(&mut mesh, bone, from, to, r0, r1);
        if bone.mirrored() != bone {
            capsule(&mut mesh, bone.mirrored(), from * flip, to * flip, r0, r1);
        }
    }
    mesh
}

const AROUND: u32 = 24;
const ALONG: u32 = 18;

fn capsule(mesh: &mut Mesh, bone: Bone, from: Vec3, to: Vec3, r0: f32, r1: f32) {
    let axis = (to - from).normalize();
    let (u, v) = axis.any_orthonormal_pair();
    let first = mesh.positions.len() as u32;
    for i in 0..=ALONG {
        // Half a ball, the shaft, half a ball.
        let t = i as f32 / ALONG as f32;
        let latitude = (t * 2.0 - 1.0) * std::f32::consts::FRAC_PI_2;
        let shaft = ((t - 0.3) / 0.4).clamp(0.0, 1.0);
        let radius = r0 + (r1 - r0) * shaft;
        for j in 0..=AROUND {
            let a = j as f32 / AROUND as f32 * std::f32::consts::TAU;
            let out = (u * a.cos() + v * a.sin()) * latitude.cos() + axis * latitude.sin();
            mesh.positions.push((from + (to - from) * shaft + out * radius).to_array());
            mesh.normals.push(out.to_array());
            mesh.colors.push([0.56, 0.50, 0.45]);
            mesh.joints.push([bone.index() as u8, bone.carrier().index() as u8, 0, 0]);
            let own = 65535 - (20000.0 * (1.0 - (t * 4.0).min(1.0))) as u16;
            mesh.weights.push([own, 65535 - own, 0, 0]);
        }
    }
    let row = AROUND + 1;
    for i in 0..ALONG {
        for j in 0..AROUND {
            let a = first + i * row + j;
            mesh.indices.extend([a, a + 1, a + row + 1, a, a + row + 1, a + row]);
        }
    }
}

/// A fine ball that belongs to the hips alone.
pub fn ball(center: Vec3, radius: f32) -> Mesh {
    const N: u32 = 128;
    let mut mesh = Mesh::default();
    for i in 0..=N {
        let polar = i as f32 / N as f32 * std::f32::consts::PI;
        for j in 0..=2 * N {
            let a = j as f32 / N as f32 * std::f32::consts::PI;
            let n = Vec3::new(polar.sin() * a.sin(), polar.cos(), polar.sin() * a.cos());
            mesh.positions.push((center + n * radius).to_array());
            mesh.normals.push(n.to_array());
            mesh.colors.push([0.6; 3]);
            mesh.joints.push([0; 4]);
            mesh.weights.push([65535, 0, 0, 0]);
        }
    }
    let row = 2 * N + 1;
    for i in 0..N {
        for j in 0..2 * N {
            let a = i * row + j;
            mesh.indices.extend([a, a + row, a + row + 1, a, a + row + 1, a + 1]);
        }
    }
    mesh
}

/// The mannequin that comes with the program, and its palette in a pose given as angles in degrees by joint.
pub fn mannequin(angles: &[(Bone, rig::Angles)]) -> (Mesh, Palette) {
    let figure = interchange::figure::mannequin().expect("the mannequin is whole");
    let palette = palette_of(&figure, angles);
    (figure.skin.expect("the mannequin has a skin"), palette)
}

/// The palette of a figure in a pose given as angles in degrees by joint.
pub fn palette_of(figure: &rig::Figure, angles: &[(Bone, rig::Angles)]) -> Palette {
    let rest = Bone::ALL.map(|bone| figure.skeleton.rest_position(bone));
    let mut pose = rig::Pose::rest(rest[Bone::Hips.index()]);
    for (bone, a) in angles {
        pose.angles[bone.index()] = *a;
    }
    Palette::new(&rig::frames(figure, &pose), &rest)
}

/// Hands at the sides, one forearm raised, weight on one leg.
pub fn relaxed() -> Vec<(Bone, rig::Angles)> {
    let a = |flexion, abduction, twist| rig::Angles { flexion, abduction, twist };
    vec![
        (Bone::LeftUpperArm, a(40.0, -55.0, 0.0)),
        (Bone::LeftLowerArm, a(95.0, 0.0, -60.0)),
        (Bone::RightUpperArm, a(5.0, -78.0, 0.0)),
        (Bone::RightLowerArm, a(15.0, 0.0, -40.0)),
        (Bone::Head, a(4.0, 0.0, 20.0)),
        (Bone::Chest, a(0.0, 3.0, 8.0)),
        (Bone::LeftUpperLeg, a(0.0, 6.0, 0.0)),
        (Bone::RightUpperLeg, a(22.0, 5.0, 0.0)),
        (Bone::RightLowerLeg, a(28.0, 0.0, 0.0)),
        (Bone::LeftIndexProximal, a(20.0, 0.0, 0.0)),
        (Bone::LeftMiddleProximal, a(30.0, 0.0, 0.0)),
    ]
}
