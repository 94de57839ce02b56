//! Bodies made of the mannequin and of a figure without a skin: stature, heads, lengths, masses, ranges, points.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::sync::OnceLock;

use glam::DVec3;
use interchange::figure;
use rig::{Body, BodySlider, Bone, Dof, Figure, Limb, Mesh, MorphTargets, Shaped, shaped};

fn opened() -> &'static figure::Opened {
    static OPENED: OnceLock<figure::Opened> = OnceLock::new();
    let text = "(version: 1, base: \"library:mannequin.figure.ron\")";
    OPENED.get_or_init(|| figure::open(text, &mut |_| Err("no disk here".to_owned())).unwrap())
}

fn made(figure: &Figure, values: &[(BodySlider, f64)]) -> Shaped {
    let body = values.iter().fold(Body::AS_IS, |body, (slider, value)| body.with(*slider, *value));
    shaped(figure, &opened().targets, &body).unwrap()
}

fn bare() -> Figure {
    Figure { skin: None, ..opened().figure.clone() }
}

/// The figure of a shipped file.
fn shipped(name: &str) -> Figure {
    let text = std::str::from_utf8(figure::shipped(name).unwrap()).unwrap();
    let mut library = |file: &str| figure::shipped(file).map(<[u8]>::to_vec).ok_or_else(|| file.to_owned());
    let (figure, warnings) = figure::load(text, &mut library).unwrap_or_else(|e| panic!("{name}: {e}"));
    assert!(warnings.iter().all(|w| w.contains("morph target")), "{name}: {warnings:?}");
    figure
}

fn heights(mesh: &Mesh) -> (f64, f64) {
    let of = |pick: fn(f32, f32) -> f32, start: f32| mesh.positions.iter().map(|p| p[1]).fold(start, pick);
    (f64::from(of(f32::min, f32::MAX)), f64::from(of(f32::max, f32::MIN)))
}

/// Chin to crown, metres, as a caliper finds it: down the middle of the face from the tip of the nose until the skin
/// turns back under the chin.
fn head_height(mesh: &Mesh) -> f64 {
    let (_, crown) = heights(mesh);
    let middle: Vec<[f64; 3]> =
        mesh.positions.iter().map(|p| p.map(f64::from)).filter(|p| p[0].abs() < 0.006).collect();
    let above = |part: f64| middle.iter().filter(move |p| p[1] > part * crown);
    let Some(tip) = above(0.8).max_by(|a, b| a[2].total_cmp(&b[2])) else { return 0.0 };
    let face = |p: &[f64; 3]| p[2] > 0.62 * tip[2];
    let mut chin = tip[1];
    // A gap of 12 mm without skin in front is the way from the chin to the chest.
    while let Some(next) =
        middle.iter().filter(|p| face(p) && p[1] < chin && p[1] > chin - 0.012).map(|p| p[1]).reduce(f64::min)
    {
        chin = next;
    }
    crown - chin
}

fn length(figure: &Figure, from: Bone, to: Bone) -> f64 {
    figure.skeleton.rest_position(from).distance(figure.skeleton.rest_position(to))
}

const ALL_AT_ONCE: [(BodySlider, f64); 11] = [
    (BodySlider::Stature, 1.31),
    (BodySlider::Sex, 0.6),
    (BodySlider::Build, 0.7),
    (BodySlider::Muscle, -0.4),
    (BodySlider::Age, -0.5),
    (BodySlider::Heads, 5.2),
    (BodySlider::Arms, 1.1),
    (BodySlider::Legs, 0.85),
    (BodySlider::Shoulders, 1.12),
    (BodySlider::Hips, 0.93),
    (BodySlider::Flexibility, 0.9),
];

#[test]
fn a_body_that_changes_nothing_keeps_every_bit() {
    let neutral = BodySlider::ALL.into_iter().filter_map(|s| s.neutral().map(|v| (s, v))).collect::<Vec<_>>();
    assert_eq!(made(&opened().figure, &neutral).figure, opened().figure);
}

#[test]
fn stature_and_heads_come_out_as_asked() {
    for values in [&ALL_AT_ONCE[..], &ALL_AT_ONCE[..1], &ALL_AT_ONCE[5..6]] {
        let body = made(&opened().figure, values);
        let mesh = body.figure.skin.as_ref().unwrap();
        let (low, high) = heights(mesh);
        let asked = |s: BodySlider| values.iter().find(|v| v.0 == s).map(|v| v.1);
        let (stature, own) = (asked(BodySlider::Stature), heights(opened().figure.skin.as_ref().unwrap()));
        assert!((high - low - stature.unwrap_or(own.1 - own.0)).abs() < 1e-4, "{values:?}: {}", high - low);
        assert!(low.abs() < 0.003, "{values:?}: soles at {low}");
        if let Some(heads) = asked(BodySlider::Heads) {
            let found = (high - low) / head_height(mesh);
            assert!((found - heads).abs() < 0.01, "{values:?}: {found} heads");
        }
    }
}

#[test]
fn lengths_go_by_their_factors() {
    let base = &opened().figure;
    let ratio = |values: &[(BodySlider, f64)], from: Bone, to: Bone| {
        let body = made(base, values).figure;
        length(&body, from, to) / length(base, from, to)
    };
    let upper = |values: &[(BodySlider, f64)]| ratio(values, Bone::LeftUpperArm, Bone::LeftLowerArm);
    let spine = |values: &[(BodySlider, f64)]| ratio(values, Bone::Spine, Bone::Chest);
    let legs = [(BodySlider::Legs, 1.1)];
    let thigh = ratio(&legs, Bone::LeftUpperLeg, Bone::LeftLowerLeg);
    assert!((thigh / spine(&legs) - 1.1).abs() < 1e-9, "{thigh}");
    assert!((spine(&legs) - upper(&legs)).abs() < 1e-9 && spine(&legs) < 1.0, "the stature is kept");
    let arms = [(BodySlider::Arms, 0.8)];
    assert!((upper(&arms) - 0.8).abs() < 1e-9);
    assert!((ratio(&arms, Bone::RightLowerArm, Bone::RightHand) - 0.8).abs() < 1e-9);
    let wide = [(BodySlider::Shoulders, 1.2)];
    let breadth = ratio(&wide, Bone::LeftUpperArm, Bone::RightUpperArm);
    assert!((breadth - 1.2).abs() < 1e-9, "{breadth}");
    let hips = ratio(&[(BodySlider::Hips, 0.9)], Bone::LeftUpperLeg, Bone::RightUpperLeg);
    assert!((hips - 0.9).abs() < 1e-9, "{hips}");
}

#[test]
fn the_skin_follows_without_folding() {
    let figure = made(&opened().figure, &ALL_AT_ONCE).figure;
    let mesh = figure.skin.unwrap();
    assert_eq!(mesh.fault(), None);
    let old = opened().figure.skin.as_ref().unwrap();
    assert_eq!((&mesh.weights, &mesh.joints, &mesh.indices), (&old.weights, &old.joints, &old.indices));
    // How a triangle faces to its vertices' normals.
    let facing = |mesh: &Mesh, t: &[u32]| {
        let at = |v: u32| DVec3::from(mesh.positions[v as usize].map(f64::from));
        let normal = |v: u32| DVec3::from(mesh.normals[v as usize].map(f64::from));
        let face = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
        face.normalize_or_zero().dot(normal(t[0]) + normal(t[1]) + normal(t[2])) / 3.0
    };
    for t in mesh.indices.chunks_exact(3) {
        let (was, is) = (facing(old, t), facing(&mesh, t));
        assert!(
            is > 0.0 || is > was - 0.1,
            "a triangle at {:?}: {is}, was {was}",
            old.positions[t[0] as usize]
        );
    }
    assert!(mesh.normals.iter().all(|n| (DVec3::from(n.map(f64::from)).length() - 1.0).abs() < 1e-5));
}

#[test]
fn fingertips_stay_on_the_skin() {
    let from_skin = |figure: &Figure, limb: Limb, name: &str| {
        let point = figure.articulators[limb.index()][name];
        let at = figure.skeleton.rest_position(point.bone) + point.at;
        let near = |p: &[f32; 3]| DVec3::from(p.map(f64::from)).distance(at);
        figure.skin.as_ref().unwrap().positions.iter().map(near).fold(f64::MAX, f64::min)
    };
    let body = made(&opened().figure, &ALL_AT_ONCE).figure;
    for (limb, name) in [(Limb::LeftArm, "indexTip"), (Limb::RightArm, "littleTip"), (Limb::LeftLeg, "heel")]
    {
        let (was, is) = (from_skin(&opened().figure, limb, name), from_skin(&body, limb, name));
        assert!(is < was + 0.001, "{name} is {is} m from the skin, was {was}");
    }
}

#[test]
fn masses_follow_stature_build_and_sex() {
    let total = |figure: &Figure| figure.skeleton.joints().map(|j| j.mass).sum::<f64>();
    let base = &opened().figure;
    let tall = made(base, &[(BodySlider::Stature, 1.892)]).figure;
    let stature = made(base, &[]).stature.unwrap();
    let by_index = (1.892 / stature).powi(2);
    assert!((total(&tall) / total(base) - by_index).abs() < 1e-9);
    let heavy = made(base, &[(BodySlider::Build, 1.0)]).figure;
    assert!((total(&heavy) / total(base) - 1.4).abs() < 1e-9);
    // De Leva: the thighs of women are 0.1478 of the body each, those of men 0.1416, the hands 0.0056 and 0.0061.
    let share = |sex: f64, bone: Bone| {
        let figure = made(base, &[(BodySlider::Sex, sex)]).figure;
        figure.skeleton.joint(bone).unwrap().mass / total(&figure)
    };
    assert!(share(1.0, Bone::LeftUpperLeg) > share(-1.0, Bone::LeftUpperLeg));
    assert!(share(1.0, Bone::LeftHand) < share(-1.0, Bone::LeftHand));
}

#[test]
fn flexibility_widens_ranges_about_the_rest() {
    let base = &opened().figure;
    let stiff = made(base, &[(BodySlider::Flexibility, 0.5)]).figure;
    let range =
        |figure: &Figure, bone: Bone| figure.skeleton.joint(bone).unwrap().range(Dof::Flexion).unwrap();
    let (was, is) = (range(base, Bone::LeftLowerLeg), range(&stiff, Bone::LeftLowerLeg));
    assert_eq!((is.min, is.max), (was.min * 0.875, was.max * 0.875));
    let (was, is) = (range(base, Bone::Neck), range(&stiff, Bone::Neck));
    assert_eq!((is.min, is.max), (was.min * 0.5, was.max * 0.5));
    assert_eq!(range(base, Bone::LeftIndexProximal), range(&stiff, Bone::LeftIndexProximal));
    // Straight ahead the thigh went up to 121 degrees and back to 19.
    let thigh = |figure: &Figure, degrees: f64| {
        let joint = figure.skeleton.joint(Bone::LeftUpperLeg).unwrap();
        let rig::Articulation::Ball { cone: Some(cone), .. } = &joint.articulation else { panic!() };
        let (sin, cos) = degrees.to_radians().sin_cos();
        cone.contains(DVec3::new(0.0, -cos, sin), 0.0)
    };
    assert!(thigh(base, 115.0) && thigh(base, -15.0) && !thigh(base, -25.0));
    assert!(thigh(&stiff, 57.0) && !thigh(&stiff, 64.0) && thigh(&stiff, -7.0) && !thigh(&stiff, -12.0));
    let loose = made(base, &[(BodySlider::Flexibility, 1.3)]).figure;
    for joint in loose.skeleton.joints() {
        for range in joint.dofs().filter_map(|dof| joint.range(dof)).filter(|r| r.min.is_finite()) {
            assert!(range.min >= -180.0 && range.max <= 180.0, "{}: {range:?}", joint.bone);
        }
    }
}

#[test]
fn a_figure_without_a_skin_takes_proportions_too() {
    let body = made(&bare(), &[(BodySlider::Stature, 1.2), (BodySlider::Heads, 6.0), (BodySlider::Sex, 1.0)]);
    assert!((body.stature.unwrap() - 1.2).abs() < 0.02, "{:?}", body.stature);
    let skinned = made(&opened().figure, &[(BodySlider::Stature, 1.2), (BodySlider::Heads, 6.0)]).figure;
    let height = |figure: &Figure| figure.skeleton.rest_position(Bone::Hips).y;
    let ratio = height(&skinned) / height(&body.figure);
    // Joints alone only estimate where crown and chin are.
    assert!((ratio - 1.0).abs() < 0.03, "{ratio}; {:?}", made(&opened().figure, &[]).heads);
}

#[test]
fn sliders_without_morph_targets_say_so() {
    let body = Body::AS_IS.with(BodySlider::Build, 0.5).with(BodySlider::Age, -1.0);
    let made = shaped(&opened().figure, &MorphTargets::new(), &body).unwrap();
    assert_eq!(made.missing, ["heavy", "child"]);
    assert_eq!(
        opened().figure.skin.as_ref().unwrap().positions.len(),
        made.figure.skin.unwrap().positions.len()
    );
}

#[test]
fn damaged_figures_and_extreme_bodies_stay_finite() {
    let mut headless = bare();
    let joints = headless.skeleton.joints().filter(|j| j.bone.part() != rig::Part::Head).cloned().collect();
    headless.skeleton = rig::Skeleton::new(joints).unwrap();
    let made_of = |figure: &Figure| {
        for end in [0.0, 1.0] {
            let body = BodySlider::ALL.into_iter().fold(Body::AS_IS, |body, s| {
                body.with(s, s.range().min + end * (s.range().max - s.range().min))
            });
            let made = shaped(figure, &opened().targets, &body).unwrap();
            assert!(
                made.figure.skeleton.joints().all(|j| j.offset.is_finite() && j.mass > 0.0 || j.mass == 0.0)
            );
        }
    };
    made_of(&headless);
    made_of(&opened().figure);
    let empty = Figure { skin: Some(Mesh::default()), ..bare() };
    made_of(&empty);
}

#[test]
fn presets_are_what_their_names_say() {
    for (name, stature, heads) in [
        ("child.figure.ron", 1.20, Some(6.0)),
        ("heroic.figure.ron", 1.90, Some(8.3)),
        ("elderly.figure.ron", 1.64, Some(7.3)),
        ("woman.figure.ron", 1.62, None),
        ("man.figure.ron", 1.76, None),
    ] {
        let figure = shipped(name);
        assert_eq!(format!("{}.figure.ron", figure.name), name);
        let mesh = figure.skin.as_ref().unwrap();
        let (low, high) = heights(mesh);
        assert!((high - low - stature).abs() < 1e-4, "{name} is {} m tall", high - low);
        if let Some(heads) = heads {
            let found = stature / head_height(mesh);
            assert!((found - heads).abs() < 0.01, "{name} is {found} heads tall");
        }
        assert!(figure.limbs != opened().figure.limbs);
    }
}
