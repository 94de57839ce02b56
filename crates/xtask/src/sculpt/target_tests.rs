//! What the morph targets of the shipped skin must be, checked on fresh ones.

use std::collections::HashMap;
use std::sync::OnceLock;

use glam::DVec3;
use rig::{Bone, Mesh, MorphTargets, add_targets};

use super::body;
use super::faults::TINY_M2;
use super::field::{Blob, Field, Op};
use super::physique::Physique;
use super::shape::Shape;
use super::targets::{Half, targets};
use super::tests::{sculpt, shipped};

/// One making for all tests: it takes some seconds.
pub(super) fn morphs() -> &'static MorphTargets {
    static TARGETS: OnceLock<MorphTargets> = OnceLock::new();
    TARGETS.get_or_init(|| targets(sculpt(), &shipped()))
}

fn place(mesh: &Mesh, v: u32) -> DVec3 {
    DVec3::from(mesh.positions[v as usize].map(f64::from))
}

/// Places of triangles that have turned over, or have no area left.
fn inverted(shares: &[(&str, f64)]) -> Vec<DVec3> {
    let mut moved = sculpt().clone();
    add_targets(&mut moved, morphs(), shares);
    turned_over(&moved)
}

fn turned_over(moved: &Mesh) -> Vec<DVec3> {
    let face = |mesh: &Mesh, t: &[u32]| {
        (place(mesh, t[1]) - place(mesh, t[0])).cross(place(mesh, t[2]) - place(mesh, t[0]))
    };
    let triangles = sculpt().indices.chunks_exact(3);
    triangles
        // The smallest have no side worth speaking of.
        .filter(|t| 0.5 * face(sculpt(), t).length() >= f64::from(TINY_M2))
        .filter(|t| face(sculpt(), t).dot(face(moved, t)) <= 0.0)
        .map(|t| place(sculpt(), t[0]))
        .collect()
}

#[test]
fn no_target_turns_a_triangle_over() {
    for name in morphs().keys() {
        let bad = inverted(&[(name, 1.0)]);
        assert!(bad.is_empty(), "{name}: {} triangles, {:?}", bad.len(), &bad[..bad.len().min(12)]);
    }
}

#[test]
fn targets_add_up_without_turning_triangles_over() {
    for shares in [
        [("female", 1.0), ("slender", 1.0), ("slight", 0.5)],
        [("female", 1.0), ("heavy", 0.7), ("old", 0.5)],
        [("male", 1.0), ("muscular", 1.0), ("slender", 0.3)],
        [("male", 0.7), ("heavy", 1.0), ("muscular", 0.3)],
        [("child", 1.0), ("slender", 0.5), ("female", 0.3)],
        [("old", 1.0), ("slight", 0.6), ("male", 0.5)],
    ] {
        let bad = inverted(&shares);
        assert!(bad.is_empty(), "{shares:?}: {} triangles, {:?}", bad.len(), &bad[..bad.len().min(12)]);
    }
}

#[test]
fn the_eight_targets_mirror_exactly() {
    let names: Vec<&str> = morphs().keys().map(String::as_str).collect();
    assert_eq!(names, ["child", "female", "heavy", "male", "muscular", "old", "slender", "slight"]);
    let key = |x: f32, p: &[f32; 3]| [(x + 0.0).to_bits(), p[1].to_bits(), p[2].to_bits()];
    let by_place: HashMap<[u32; 3], u32> =
        sculpt().positions.iter().enumerate().map(|(i, p)| (key(p[0], p), i as u32)).collect();
    for (name, target) in morphs() {
        let moved: HashMap<u32, [f32; 3]> = target.iter().copied().collect();
        assert_eq!(moved.len(), target.len(), "{name} moves a vertex twice");
        assert!(target.is_sorted_by_key(|(v, _)| *v));
        for (v, d) in target {
            let p = sculpt().positions[*v as usize];
            let twin = moved.get(&by_place[&key(-p[0], &p)]);
            assert_eq!(twin, Some(&[0.0 - d[0], d[1], d[2]]), "{name}: vertex {v} at {p:?} moves by {d:?}");
        }
    }
}

#[test]
fn made_again_a_target_has_the_same_bits() {
    let skeleton = shipped();
    let heavy = Physique { build: 1.0, ..Physique::NEUTRAL };
    let again = Half::new(sculpt())
        .between(&body::field(&skeleton, &Physique::NEUTRAL), &body::field(&skeleton, &heavy));
    assert_eq!(&again, &morphs()["heavy"]);
}

#[test]
fn vertices_meet_the_other_body_s_surface() {
    let skeleton = shipped();
    let neutral = body::field(&skeleton, &Physique::NEUTRAL);
    let mut parts = neutral.parts().to_vec();
    let belly = Shape::Ellipsoid {
        center: skeleton.rest_position(Bone::Spine) + DVec3::new(0.0, 0.0, 0.06),
        frame: glam::DMat3::IDENTITY,
        radii: DVec3::new(0.17, 0.13, 0.13),
    };
    parts[0].blobs.push(Blob { op: Op::Add, blend: 0.03, crease: 0.0, shape: belly });
    let swollen = Field::new(parts);
    let target = Half::new(sculpt()).between(&neutral, &swollen);
    let (all, was) = (swollen.everything(), neutral.everything());
    let off = |v: u32, d: &[f32; 3]| {
        let p = place(sculpt(), v);
        (swollen.value(&all, p + DVec3::from(d.map(f64::from))) - neutral.value(&was, p)).abs()
    };
    let far = target.iter().filter(|(v, d)| off(*v, d) > 5e-4).count();
    let longest = target.iter().map(|(_, d)| DVec3::from(d.map(f64::from)).length()).fold(0.0, f64::max);
    assert!(longest > 0.04 && target.len() > 800, "{} vertices move up to {longest} m", target.len());
    // A few are held back so that triangles don't fold.
    assert!(far * 25 < target.len(), "{far} of {} vertices miss the surface", target.len());
    let mut moved = sculpt().clone();
    add_targets(&mut moved, &MorphTargets::from([("belly".to_owned(), target)]), &[("belly", 1.0)]);
    assert_eq!(turned_over(&moved), []);
}
