//! The skin keeps its volume where limbs twist and bend, moves without jumps, and stays in its boxes.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

#[path = "../../kin/tests/seeded/mod.rs"]
mod seeded;

use glam::{DVec3, Vec3};
use interchange::figure::{bare_mannequin, mannequin};
use rig::{
    Angles, Bone, Bounds, Figure, Mesh, Palette, Pose, SkinBounds, bone_of_place, frames, skin_normals,
    skin_positions, spread_twist,
};
use seeded::Seeded;

fn palette(figure: &Figure, pose: &Pose) -> Palette {
    Palette::new(&frames(figure, pose), &Bone::ALL.map(|bone| figure.skeleton.rest_position(bone)))
}

fn posed(figure: &Figure, bone: Bone, angles: Angles) -> Palette {
    let mut pose = figure.rest_pose();
    pose.angles[bone.index()] = angles;
    palette(figure, &pose)
}

const RADIUS_M: f64 = 0.04;
const AROUND: u32 = 48;
const ALONG: u32 = 60;

/// A closed tube about two bones, from a joint over the next to a third, whose skin passes from the one bone to the
/// other within a radius of the joint between. `u` along and `v` around, with the rings' middles on the bones.
fn tube(figure: &Figure, bones: [Bone; 3]) -> Mesh {
    let [from, joint, to] = bones.map(|bone| figure.skeleton.rest_position(bone));
    let axis = (to - from).normalize();
    let (x, y) = axis.any_orthonormal_pair();
    let mut mesh = Mesh::default();
    for i in 0..=ALONG {
        for j in 0..AROUND {
            let angle = f64::from(j) / f64::from(AROUND) * std::f64::consts::TAU;
            let out = x * angle.cos() + y * angle.sin();
            let place = from.lerp(to, f64::from(i) / f64::from(ALONG)) + out * RADIUS_M;
            let share = ((place - joint).dot(axis) / RADIUS_M * 0.5 + 0.5).clamp(0.0, 1.0);
            let beyond = (share * 65535.0).round() as u16;
            mesh.positions.push(place.as_vec3().to_array());
            mesh.normals.push(out.as_vec3().to_array());
            mesh.colors.push([0.5; 3]);
            mesh.joints.push([bones[0].index() as u8, bones[1].index() as u8, 0, 0]);
            mesh.weights.push([65535 - beyond, beyond, 0, 0]);
        }
    }
    let at = |i: u32, j: u32| i * AROUND + j % AROUND;
    for i in 0..ALONG {
        for j in 0..AROUND {
            let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
            mesh.indices.extend([a, b, c, a, c, d]);
        }
    }
    for j in 1..AROUND - 1 {
        mesh.indices.extend([at(0, 0), at(0, j + 1), at(0, j)]);
        mesh.indices.extend([at(ALONG, 0), at(ALONG, j), at(ALONG, j + 1)]);
    }
    assert_eq!(mesh.fault(), None);
    mesh
}

fn volume(mesh: &Mesh, positions: &[Vec3]) -> f64 {
    let corner = |i: u32| positions[i as usize].as_dvec3();
    let six = |t: &[u32]| corner(t[0]).dot(corner(t[1]).cross(corner(t[2])));
    mesh.indices.chunks_exact(3).map(six).sum::<f64>() / 6.0
}

/// The area within each ring of a tube.
fn areas(positions: &[Vec3]) -> Vec<f64> {
    let area = |ring: &[Vec3]| {
        let corner = |j: usize| (ring[j % ring.len()] - ring[0]).as_dvec3();
        (0..ring.len()).map(|j| corner(j).cross(corner(j + 1))).sum::<DVec3>().length() * 0.5
    };
    positions.chunks_exact(AROUND as usize).map(area).collect()
}

/// What a linear blend of the bones would make of the skin.
fn linear(mesh: &Mesh, palette: &Palette) -> Vec<Vec3> {
    let rows = mesh.positions.iter().zip(&mesh.joints).zip(&mesh.weights);
    rows.map(|((&p, joints), weights)| {
        let parts = joints.iter().zip(weights).map(|(&joint, &weight)| {
            palette.point(bone_of_place(usize::from(joint)), Vec3::from_array(p))
                * (f32::from(weight) / 65535.0)
        });
        parts.sum()
    })
    .collect()
}

const ARM: [Bone; 3] = [Bone::LeftUpperArm, Bone::LeftLowerArm, Bone::LeftHand];
const LEG: [Bone; 3] = [Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot];

#[test]
fn twist_leaves_every_cross_section_as_large_as_it_was() {
    let figure = bare_mannequin().unwrap();
    let mut arm = tube(&figure, ARM);
    let rest = areas(&skin_positions(&arm, &Palette::REST));
    spread_twist(&mut arm, &figure.skeleton);
    for (bone, twist) in [(ARM[1], -160.0), (ARM[1], -80.0), (ARM[0], 90.0), (ARM[0], -90.0), (ARM[0], 45.0)]
    {
        let palette = posed(&figure, bone, Angles { twist, ..Angles::REST });
        let now = areas(&skin_positions(&arm, &palette));
        for (i, (now, rest)) in now.iter().zip(&rest).enumerate() {
            assert!((now / rest - 1.0).abs() < 0.002, "ring {i}, {bone} twisted by {twist}: {}", now / rest);
        }
    }
    let thinnest = areas(&linear(&arm, &posed(&figure, ARM[1], Angles { twist: -160.0, ..Angles::REST })));
    assert!(
        thinnest.iter().zip(&rest).any(|(now, rest)| now / rest < 0.1),
        "the linear blend is a candy wrapper"
    );
}

#[test]
fn twist_grows_evenly_along_the_segment_and_both_ends_keep_what_is_theirs() {
    let figure = bare_mannequin().unwrap();
    let mut arm = tube(&figure, ARM);
    spread_twist(&mut arm, &figure.skeleton);
    let [_, elbow, wrist] = ARM.map(|bone| figure.skeleton.rest_position(bone));
    let skin = skin_positions(&arm, &posed(&figure, ARM[1], Angles { twist: -160.0, ..Angles::REST }));
    let mut before = 0.0;
    for (ring, first) in skin.iter().step_by(AROUND as usize).enumerate() {
        let rest = DVec3::from(arm.positions[ring * AROUND as usize].map(f64::from));
        let along = (rest - elbow).dot(wrist - elbow) / (wrist - elbow).length_squared();
        let (a, b) = (rest - elbow, first.as_dvec3() - elbow);
        let turned = (a.cross(b).x).atan2(a.y * b.y + a.z * b.z).to_degrees();
        let turned = if turned > 90.0 { turned - 360.0 } else { turned };
        let expected = -160.0 * ((along - 0.1) / 0.8).clamp(0.0, 1.0);
        assert!((turned - expected).abs() < 8.0, "at {along}: {turned} instead of {expected}");
        assert!(turned <= before + 1e-3, "at {along}: {turned} after {before}");
        before = turned;
    }
}

#[test]
fn a_turned_foot_turns_the_lower_shin_and_not_the_knee() {
    let figure = bare_mannequin().unwrap();
    let mut leg = tube(&figure, LEG);
    spread_twist(&mut leg, &figure.skeleton);
    let skin = skin_positions(&leg, &posed(&figure, LEG[2], Angles { abduction: 20.0, ..Angles::REST }));
    let rest = skin_positions(&leg, &Palette::REST);
    let moved = |ring: u32| skin[(ring * AROUND) as usize].distance(rest[(ring * AROUND) as usize]);
    assert_eq!(moved(ALONG / 2), 0.0, "about the knee");
    let whole = 2.0 * RADIUS_M * 10.0_f64.to_radians().sin();
    assert!((f64::from(moved(ALONG)) - whole).abs() < 1e-4, "at the ankle: {}", moved(ALONG));
}

#[test]
fn bent_elbows_and_knees_keep_more_volume_than_a_linear_blend_would() {
    let figure = bare_mannequin().unwrap();
    for (bones, bends) in [(ARM, [60.0, 120.0, 150.0]), (LEG, [60.0, 110.0, 150.0])] {
        let mut limb = tube(&figure, bones);
        let rest = volume(&limb, &skin_positions(&limb, &Palette::REST));
        spread_twist(&mut limb, &figure.skeleton);
        for flexion in bends {
            let palette = posed(&figure, bones[1], Angles { flexion, ..Angles::REST });
            let off = |positions: &[Vec3]| (volume(&limb, positions) / rest - 1.0).abs();
            let (dual, plain) = (off(&skin_positions(&limb, &palette)), off(&linear(&limb, &palette)));
            assert!(dual < 0.5 * plain, "{} at {flexion}: {dual} against {plain}", bones[1]);
        }
    }
}

#[test]
fn at_rest_the_skin_lies_where_it_was_modelled() {
    let figure = mannequin().unwrap();
    let mesh = figure.skin.as_ref().unwrap();
    let palette = palette(&figure, &figure.rest_pose());
    for (now, rest) in skin_positions(mesh, &palette).iter().zip(&mesh.positions) {
        assert!(now.distance(Vec3::from_array(*rest)) < 1e-6);
    }
    for (now, rest) in skin_normals(mesh, &palette).iter().zip(&mesh.normals) {
        assert!(now.distance(Vec3::from_array(*rest)) < 1e-6);
    }
}

/// Farther than any vertex goes when a joint turns by a degree: the whole body about the hips moves by 18 mm.
const STEP_M: f32 = 0.025;

#[test]
fn no_vertex_jumps_as_a_joint_goes_through_its_range() {
    let figure = mannequin().unwrap();
    let mesh = figure.skin.as_ref().unwrap();
    for joint in figure.skeleton.joints() {
        for dof in joint.dofs() {
            let range = rig::live_range(joint, Angles::REST, dof, true);
            let mut before: Option<Vec<Vec3>> = None;
            for step in 0..=(range.max - range.min).min(360.0) as usize {
                let mut angles = Angles::REST;
                angles.set(dof, range.min.max(-180.0) + step as f64);
                let skin = skin_positions(mesh, &posed(&figure, joint.bone, angles));
                let far = before.iter().flatten().zip(&skin).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
                assert!(far < STEP_M, "{} {dof:?} at {}: {far} m", joint.bone, angles.get(dof));
                before = Some(skin);
            }
        }
    }
}

#[test]
fn no_vertex_jumps_as_limbs_swing_about_their_roots_with_any_twist() {
    let figure = mannequin().unwrap();
    let mesh = figure.skin.as_ref().unwrap();
    for bone in [ARM[0], LEG[0]] {
        for twist in [-90.0, -40.0, 0.0, 90.0] {
            for swing in [60.0, 120.0, 150.0, 176.0_f64] {
                let mut before: Option<Vec<Vec3>> = None;
                // A degree of angle each, all round, outside the cone as well.
                for degrees in 0..=360 {
                    let (abduction, flexion) = f64::from(degrees).to_radians().sin_cos();
                    let (step, angles) = (
                        STEP_M * (swing / 57.0) as f32,
                        Angles { flexion: swing * flexion, abduction: swing * abduction, twist },
                    );
                    let skin = skin_positions(mesh, &posed(&figure, bone, angles));
                    let far =
                        before.iter().flatten().zip(&skin).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max);
                    assert!(far < step, "{bone} {angles:?}: {far} m");
                    before = Some(skin);
                }
            }
        }
    }
}

/// Every joint somewhere within a share of its range.
fn random_pose(figure: &Figure, seeded: &mut Seeded, share: f64) -> Pose {
    let mut pose = figure.rest_pose();
    for joint in figure.skeleton.joints() {
        for dof in joint.dofs() {
            let range = rig::live_range(joint, pose.angles(joint.bone), dof, true);
            let (min, max) = (range.min.max(-180.0), range.max.min(180.0));
            pose.angles[joint.bone.index()].set(dof, seeded.between(min, max) * share);
        }
    }
    pose
}

#[test]
fn the_boxes_hold_the_skin_in_any_pose_and_are_not_much_larger() {
    let figure = mannequin().unwrap();
    let mesh = figure.skin.as_ref().unwrap();
    let (bounds, mut seeded) = (SkinBounds::new(mesh), Seeded(11));
    let pieces: Vec<SkinBounds> =
        (0..8).map(|k| SkinBounds::of(mesh, (k..mesh.vertex_count()).step_by(977))).collect();
    for (share, larger) in [(0.4, 0.17), (1.0, 0.5), (1.3, f32::INFINITY)] {
        let mut excess = 0.0;
        for i in 0..100 {
            let palette = palette(&figure, &random_pose(&figure, &mut seeded, share));
            let skin = skin_positions(mesh, &palette);
            let (tight, loose) = (Bounds::of(skin.iter().copied()), bounds.posed(&palette));
            for larger in [loose, Bounds::of(bounds.corners(&palette))] {
                let held = larger.min.cmple(tight.min).all() && larger.max.cmpge(tight.max).all();
                assert!(held, "pose {i}: {tight:?} in {larger:?}");
            }
            excess += (loose.max - loose.min - tight.max + tight.min).max_element();
            for (k, piece) in pieces.iter().enumerate() {
                let (held, piece) = (skin.iter().skip(k).step_by(977), piece.posed(&palette));
                for p in held {
                    assert!(
                        piece.min.cmple(*p).all() && piece.max.cmpge(*p).all(),
                        "pose {i}, piece {k}: {p}"
                    );
                }
            }
        }
        assert!(excess / 100.0 < larger, "{} m larger on average", excess / 100.0);
    }
}
