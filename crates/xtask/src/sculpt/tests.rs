//! What the shipped skin must be, checked on a fresh sculpt.

use std::collections::{BTreeMap, HashMap};
use std::sync::OnceLock;

use glam::DVec3;
use rig::{Bone, Joint, Mesh, Skeleton};

use super::target_tests::morphs;
use super::{body, figures, hand, mesh, skeleton};

pub(super) fn shipped() -> Skeleton {
    skeleton(&figures().join("mannequin.urdf")).unwrap()
}

/// One sculpt for all tests: it takes some seconds.
pub(super) fn sculpt() -> &'static Mesh {
    static MESH: OnceLock<Mesh> = OnceLock::new();
    MESH.get_or_init(|| mesh(&shipped()).unwrap())
}

fn triangles(mesh: &Mesh) -> impl Iterator<Item = [u32; 3]> {
    mesh.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]])
}

fn place(mesh: &Mesh, v: u32) -> DVec3 {
    DVec3::from(mesh.positions[v as usize].map(f64::from))
}

#[test]
fn a_fresh_sculpt_is_the_shipped_file() {
    let fresh = interchange::glb::write_with_targets(sculpt(), morphs(), &shipped(), "mannequin");
    let file = std::fs::read(figures().join("mannequin.glb")).unwrap();
    let first = fresh.iter().zip(&file).position(|(a, b)| a != b);
    assert!(
        fresh.len() == file.len() && first.is_none(),
        "{} bytes fresh, {} in assets, first difference at {first:?}: run `cargo xtask sculpt`",
        fresh.len(),
        file.len()
    );
    assert!(file.len() < 4_000_000);
}

#[test]
fn every_edge_has_two_sides_that_run_opposite_ways() {
    let mut sides: BTreeMap<(u32, u32), u32> = BTreeMap::new();
    for [a, b, c] in triangles(sculpt()) {
        for side in [(a, b), (b, c), (c, a)] {
            *sides.entry(side).or_default() += 1;
        }
    }
    for (&(a, b), &count) in &sides {
        let p = place(sculpt(), a);
        assert_eq!(count, 1, "side {a}-{b} is used {count} times, near {p}");
        assert!(sides.contains_key(&(b, a)), "side {a}-{b} has no other side, near {p}");
    }
}

#[test]
fn sizes_are_within_bounds() {
    let mesh = sculpt();
    assert_eq!(mesh.fault(), None);
    assert!((15_000..30_000).contains(&mesh.vertex_count()), "{} vertices", mesh.vertex_count());
    let low = mesh.positions.iter().map(|p| p[1]).fold(f32::MAX, f32::min);
    let high = mesh.positions.iter().map(|p| p[1]).fold(f32::MIN, f32::max);
    assert!(low.abs() < 0.003, "the soles are at {low} m");
    assert!((high - 1.72).abs() < 0.01, "the figure is {high} m tall");
}

#[test]
fn normals_are_unit_and_agree_with_the_winding() {
    let mesh = sculpt();
    let normal = |v: u32| DVec3::from(mesh.normals[v as usize].map(f64::from));
    assert!((0..mesh.vertex_count() as u32).all(|v| (normal(v).length() - 1.0).abs() < 1e-5));
    let against = triangles(mesh)
        .filter(|&[a, b, c]| {
            let face = (place(mesh, b) - place(mesh, a)).cross(place(mesh, c) - place(mesh, a));
            face.dot(normal(a) + normal(b) + normal(c)) <= 0.0
        })
        .map(|[a, ..]| place(mesh, a))
        .collect::<Vec<_>>();
    assert!(against.is_empty(), "triangles that face away from their normals: {against:?}");
}

#[test]
fn left_and_right_mirror_each_other_bit_for_bit() {
    let mesh = sculpt();
    // -0 and 0 are one place.
    let key = |x: f32, p: &[f32; 3]| [(x + 0.0).to_bits(), p[1].to_bits(), p[2].to_bits()];
    let by_place: HashMap<[u32; 3], usize> =
        mesh.positions.iter().enumerate().map(|(i, p)| (key(p[0], p), i)).collect();
    for (v, p) in mesh.positions.iter().enumerate() {
        let twin = by_place.get(&key(-p[0], p)).copied();
        let twin = twin.unwrap_or_else(|| panic!("vertex {v} at {p:?} has no twin"));
        let shares = |v: usize, mirrored: bool| {
            let mut all = [0u16; Bone::COUNT];
            for (joint, weight) in mesh.joints[v].iter().zip(mesh.weights[v]) {
                let bone = Bone::ALL[usize::from(*joint)];
                all[if mirrored { bone.mirrored() } else { bone }.index()] += weight;
            }
            all
        };
        assert_eq!(mesh.colors[v], mesh.colors[twin]);
        let differ = shares(v, false).iter().zip(shares(twin, true)).any(|(a, b)| a.abs_diff(b) > 1);
        assert!(!differ, "vertex {v} at {p:?} and its twin have other weights");
    }
}

#[test]
fn no_vertex_follows_two_fingers_or_the_other_side() {
    let mesh = sculpt();
    for (v, p) in mesh.positions.iter().enumerate() {
        let bones: Vec<Bone> = mesh.joints[v]
            .iter()
            .zip(mesh.weights[v])
            .filter(|(_, w)| *w > 0)
            .map(|(j, _)| Bone::ALL[usize::from(*j)])
            .collect();
        let mut fingers: Vec<usize> = bones
            .iter()
            .filter_map(|b| hand::FINGERS.iter().position(|f| f.contains(b) || f.contains(&b.mirrored())))
            .collect();
        fingers.dedup();
        assert!(fingers.len() <= 1, "vertex {v} at {p:?} follows {bones:?}");
        if p[0] != 0.0 {
            let own = if p[0] > 0.0 { rig::Side::Left } else { rig::Side::Right };
            assert!(
                bones.iter().all(|b| b.side().is_none_or(|s| s == own)),
                "vertex {v} at {p:?}: {bones:?}"
            );
        }
    }
}

/// Closed outlines where the mesh crosses the plane `p[axis] == at`: how many, among those that `inside` keeps.
fn outlines(mesh: &Mesh, axis: usize, at: f64, inside: impl Fn(DVec3) -> bool) -> usize {
    let mut group: BTreeMap<(u32, u32), (u32, u32)> = BTreeMap::new();
    fn find(group: &mut BTreeMap<(u32, u32), (u32, u32)>, e: (u32, u32)) -> (u32, u32) {
        let up = *group.entry(e).or_insert(e);
        if up == e { e } else { find(group, up) }
    }
    for [a, b, c] in triangles(mesh) {
        let crossed: Vec<(u32, u32)> = [(a, b), (b, c), (c, a)]
            .into_iter()
            .filter(|&(p, q)| (place(mesh, p)[axis] < at) != (place(mesh, q)[axis] < at))
            .map(|(p, q)| (p.min(q), p.max(q)))
            .collect();
        if let [e, f] = crossed[..]
            && inside(place(mesh, e.0))
        {
            let (e, f) = (find(&mut group, e), find(&mut group, f));
            group.insert(e.max(f), e.min(f));
        }
    }
    group.iter().filter(|(e, up)| e == up).count()
}

#[test]
fn ten_fingers_are_separate() {
    let skeleton = shipped();
    let at = |bone: Bone| skeleton.rest_position(bone);
    for side in [1.0, -1.0] {
        let hand = |p: DVec3| p.x * side > at(Bone::LeftHand).x;
        // From just beyond the webs to the little finger's last joint.
        for t in [0.0, 0.25, 0.5, 0.75, 1.0] {
            let from = at(Bone::LeftIndexProximal).x + 0.022;
            let x = from + t * (at(Bone::LeftLittleDistal).x + 0.010 - from);
            let level = at(Bone::LeftHand).y - 0.025;
            let long_fingers = |p: DVec3| hand(p) && p.y > level;
            assert_eq!(outlines(sculpt(), 0, x * side, long_fingers), 4, "fingers at x = {x}");
        }
        let z = at(Bone::LeftThumbProximal).lerp(at(Bone::LeftThumbDistal), 0.5).z;
        assert_eq!(outlines(sculpt(), 2, z, hand), 1, "the thumb at z = {z}");
    }
}

#[test]
fn the_body_follows_another_skeleton() {
    // Longer legs, shorter arms, a slimmer and taller trunk.
    let stretched: Vec<Joint> = shipped()
        .joints()
        .cloned()
        .map(|mut joint| {
            let o = joint.offset;
            joint.offset = match joint.bone {
                Bone::Hips => DVec3::new(o.x, o.y * 1.1, o.z),
                b if b.name().contains("Leg") || b.name().contains("Foot") => {
                    DVec3::new(o.x, o.y * 1.12, o.z)
                }
                b if b.name().contains("Arm") || b.name().ends_with("Hand") => o * 0.9,
                b if b.part() == rig::Part::Torso => o * 1.1,
                _ => o,
            };
            joint
        })
        .collect();
    let other = Skeleton::new(stretched).unwrap();
    for skeleton in [shipped(), other] {
        let field = body::field(&skeleton, &super::Physique::NEUTRAL);
        let all = field.everything();
        for joint in skeleton.joints() {
            // Eyes lie in sockets, joints of the collar may touch the skin.
            if matches!(joint.bone, Bone::LeftEye | Bone::RightEye) {
                continue;
            }
            let depth = -field.value(&all, skeleton.rest_position(joint.bone));
            assert!(depth > 0.004, "{} lies {depth} m under the skin", joint.bone);
        }
    }
}
