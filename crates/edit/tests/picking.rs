//! Picking agrees with a ray cast on every triangle of the skinned mesh.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

#[path = "../../kin/tests/seeded/mod.rs"]
mod seeded;

use edit::{Hit, SkinPicker};
use glam::{Vec2, Vec3};
use rig::{Bone, Camera, Figure, Mesh, Palette, Ray, View, evaluate, parse_pose, skin_positions};
use seeded::Seeded;

fn posed(figure: &Figure, text: &str) -> (rig::Evaluation, Palette) {
    let pose = parse_pose(text).unwrap().onto(&figure.rest_pose());
    let evaluation = evaluate(figure, &pose, true);
    let rest = Bone::ALL.map(|bone| figure.skeleton.rest_position(bone));
    let palette = Palette::new(&evaluation.frames, &rest);
    (evaluation, palette)
}

/// The nearest front face by brute force over vertices that are skinned already, in f64.
fn cast(mesh: &Mesh, skin: &[Vec3], ray: Ray) -> Option<f64> {
    let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
    let mut nearest: Option<f64> = None;
    for triangle in mesh.indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|i| skin[triangle[i] as usize].as_dvec3());
        let (p, normal) = (direction.cross(c - a), (b - a).cross(c - a));
        let det = (b - a).dot(p);
        if normal.dot(direction) >= 0.0 || det == 0.0 {
            continue;
        }
        let (from, u) = (origin - a, (origin - a).dot(p) / det);
        let q = from.cross(b - a);
        let (v, t) = (direction.dot(q) / det, (c - a).dot(q) / det);
        if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t >= 0.0 && nearest.is_none_or(|n| t < n) {
            nearest = Some(t);
        }
    }
    nearest
}

const CROUCH: &str = r#"(version: 1, joints: {
    "spine": (flexion: 20.0, twist: 10.0), "leftUpperArm": (flexion: 40.0, abduction: -50.0),
    "leftLowerArm": (flexion: 100.0, twist: -70.0), "rightUpperArm": (flexion: 20.0, abduction: -75.0),
    "leftUpperLeg": (flexion: 80.0), "leftLowerLeg": (flexion: 100.0), "rightUpperLeg": (flexion: 30.0),
    "rightLowerLeg": (flexion: 60.0), "leftIndexProximal": (flexion: 60.0), "head": (twist: 30.0),
})"#;

#[test]
fn ten_thousand_random_pixels() {
    let figure = interchange::figure::mannequin().unwrap();
    let mesh = figure.skin.as_ref().unwrap();
    let picker = SkinPicker::new(mesh);
    let size = Vec2::new(640.0, 480.0);
    let mut seeded = Seeded(7);
    let (mut hits, mut grazes) = (0, 0);
    for text in ["(version: 1)", CROUCH] {
        let (evaluation, palette) = posed(&figure, text);
        let skin = skin_positions(mesh, &palette);
        let bounds = rig::Bounds::of(skin.iter().copied());
        for view in [View::Front, View::Left, View::ThreeQuarter, View::Top] {
            let camera = Camera::view(view, bounds, size.x / size.y);
            for _ in 0..1_250 {
                let pixel =
                    Vec2::new(seeded.between(150.0, 490.0) as f32, seeded.between(40.0, 440.0) as f32);
                let ray = camera.ray(pixel, size);
                let picked: Option<Hit> = picker.pick(mesh, &palette, &evaluation.frames, ray);
                match (picked, cast(mesh, &skin, ray)) {
                    (Some(hit), Some(distance)) if (hit.distance - distance).abs() < 1e-5 => {
                        hits += 1;
                        let back = evaluation.frames[hit.bone].point(hit.point_in_bone);
                        assert!(back.distance(hit.point_in_world) < 1e-9);
                        assert!(hit.normal_in_world.dot(ray.direction.as_dvec3()) < 0.0);
                    }
                    (None, None) => {}
                    // A ray along the very edge of a triangle may fall on either side in f32.
                    other => {
                        grazes += 1;
                        assert!(grazes <= 10, "{view:?} {pixel}: {other:?}");
                    }
                }
            }
        }
    }
    assert!(hits > 1_500, "{hits} of 10,000 rays met the figure");
}

#[test]
fn parts_are_named_by_the_skin_that_is_met() {
    let figure = interchange::figure::mannequin().unwrap();
    let mesh = figure.skin.as_ref().unwrap();
    let picker = SkinPicker::new(mesh);
    let (evaluation, palette) = posed(&figure, "(version: 1)");
    let at = |x: f32, y: f32| {
        let ray = Ray { origin: Vec3::new(x, y, 5.0), direction: -Vec3::Z };
        picker.pick(mesh, &palette, &evaluation.frames, ray).map(|hit| hit.bone)
    };
    assert_eq!(at(0.0, 1.63), Some(Bone::Head));
    assert_eq!(at(0.3, 1.388), Some(Bone::LeftUpperArm));
    assert_eq!(at(-0.57, 1.388), Some(Bone::RightLowerArm));
    assert_eq!(at(0.09, 0.7), Some(Bone::LeftUpperLeg));
    assert_eq!(at(-0.09, 0.3), Some(Bone::RightLowerLeg));
    assert_eq!(at(0.4, 0.5), None);
}

#[test]
fn broken_meshes_and_odd_rays_meet_nothing() {
    let figure = interchange::figure::mannequin().unwrap();
    let mut broken = figure.skin.clone().unwrap();
    broken.indices[0] = u32::MAX;
    let (evaluation, palette) = posed(&figure, "(version: 1)");
    let ray = Ray { origin: Vec3::new(0.0, 1.6, 5.0), direction: -Vec3::Z };
    assert_eq!(SkinPicker::new(&broken).pick(&broken, &palette, &evaluation.frames, ray), None);
    let mesh = figure.skin.as_ref().unwrap();
    let picker = SkinPicker::new(mesh);
    for direction in [Vec3::ZERO, Vec3::NAN, Vec3::Z] {
        let ray = Ray { origin: Vec3::new(0.0, 1.6, 5.0), direction };
        assert_eq!(picker.pick(mesh, &palette, &evaluation.frames, ray), None);
    }
}

/// The distance from a point to the posed skin: every corner, and a grid over the triangles about it.
fn distance(mesh: &Mesh, skin: &[Vec3], point: glam::DVec3) -> f64 {
    let mut nearest = f64::INFINITY;
    for triangle in mesh.indices.chunks_exact(3) {
        let [a, b, c] = [0, 1, 2].map(|i| skin[triangle[i] as usize].as_dvec3());
        if a.distance(point) > nearest + 0.1 {
            continue;
        }
        for (i, j) in (0..=12).flat_map(|i| (0..=12 - i).map(move |j| (i, j))) {
            let place = a + (b - a) * (f64::from(i) / 12.0) + (c - a) * (f64::from(j) / 12.0);
            nearest = nearest.min(place.distance(point));
        }
    }
    nearest
}

#[test]
fn the_nearest_place_of_the_skin_is_the_nearest_of_all_triangles() {
    let figure = interchange::figure::mannequin().unwrap();
    let mesh = figure.skin.as_ref().unwrap();
    let picker = SkinPicker::new(mesh);
    let (_, palette) = posed(&figure, CROUCH);
    let skin = skin_positions(mesh, &palette);
    let mut seeded = Seeded(3);
    let mut inside = 0;
    for _ in 0..25 {
        let mut at = |low, high| seeded.between(low, high);
        let point = glam::DVec3::new(at(-0.4, 0.4), at(0.2, 1.7), at(-0.2, 0.3));
        let near = picker.nearest_of(mesh, &palette, point, 9.0, |_| true).unwrap();
        let (found, brute) = (near.height_m.abs(), distance(mesh, &skin, point));
        assert!(found < brute + 1e-5 && brute < found + 2e-3, "{point}: {found} {brute}");
        assert!((near.point_in_world.distance(point) - found).abs() < 1e-6);
        inside += usize::from(near.height_m < 0.0);
        assert_eq!(picker.nearest_of(mesh, &palette, point, 0.9 * found, |_| true), None);
        let own = picker.nearest_of(mesh, &palette, point, 9.0, |bone| bone == near.bone).unwrap();
        assert!((own.height_m.abs() - found).abs() < 1e-6);
        let other = picker.nearest_of(mesh, &palette, point, 9.0, |bone| bone != near.bone).unwrap();
        assert!(other.bone != near.bone && other.height_m.abs() >= found - 1e-6);
    }
    assert!((2..20).contains(&inside), "{inside}");
}

#[test]
fn what_does_not_count_lets_the_ray_through() {
    let figure = interchange::figure::mannequin().unwrap();
    let mesh = figure.skin.as_ref().unwrap();
    let picker = SkinPicker::new(mesh);
    let across = r#"(version: 1, joints: {
        "leftUpperArm": (flexion: 45.0, abduction: -60.0), "leftLowerArm": (flexion: 90.0),
    })"#;
    let (evaluation, palette) = posed(&figure, across);
    let wrist = evaluation.frames[Bone::LeftHand].position;
    let ray = Ray { origin: (wrist + glam::DVec3::Z * 3.0).as_vec3(), direction: -Vec3::Z };
    let pick = |counts: fn(Bone) -> bool| picker.pick_of(mesh, &palette, &evaluation.frames, ray, counts);
    let arm = |bone: Bone| rig::Limb::of(bone) == Some(rig::Limb::LeftArm);
    let first = pick(|_| true).unwrap();
    assert!(arm(first.bone) && first.bone > Bone::LeftUpperArm, "{first:?}");
    let body = pick(|bone| rig::Limb::of(bone).is_none()).unwrap();
    assert!(!arm(body.bone) && body.distance > first.distance + 0.05, "{body:?}");
    assert_eq!(pick(|_| false), None);
}
