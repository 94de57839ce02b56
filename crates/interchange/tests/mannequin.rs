//! The shipped figure: whole, symmetric, and as tall and heavy as it says.

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};
use interchange::figure;
use rig::{Angles, Articulation, Bone, Dof, Figure, Joint, Limb, Part, Side};

const STATURE: f64 = 1.72;

fn mannequin() -> Figure {
    figure::bare_mannequin().expect("the shipped figure is whole")
}

fn joint(figure: &Figure, bone: Bone) -> &Joint {
    figure.skeleton.joint(bone).expect("the mannequin has every bone")
}

fn mirrored(v: DVec3) -> DVec3 {
    DVec3::new(-v.x, v.y, v.z)
}

/// Positions and rotations of all joints with those angles, by the definition: no solver involved.
fn posed(figure: &Figure, angles: &BTreeMap<Bone, Angles>) -> BTreeMap<Bone, (DVec3, DQuat)> {
    let mut frames = BTreeMap::new();
    for joint in figure.skeleton.joints() {
        let (origin, turn) = joint.carrier.map_or((DVec3::ZERO, DQuat::IDENTITY), |carrier| frames[&carrier]);
        let angles = angles.get(&joint.bone).copied().unwrap_or(Angles::REST);
        frames.insert(joint.bone, (origin + turn * joint.offset, turn * joint.rotation(angles)));
    }
    frames
}

fn center_of_mass(figure: &Figure, angles: &BTreeMap<Bone, Angles>) -> DVec3 {
    let frames = posed(figure, angles);
    let total: f64 = figure.skeleton.joints().map(|j| j.mass).sum();
    let moment: DVec3 = figure
        .skeleton
        .joints()
        .map(|j| {
            let (origin, turn) = frames[&j.bone];
            j.mass * (origin + turn * j.center_of_mass)
        })
        .sum();
    moment / total
}

fn angles(dof: Dof, degrees: f64) -> Angles {
    let mut angles = Angles::REST;
    angles.set(dof, degrees);
    angles
}

/// Where a limb's articulator is.
fn reached(figure: &Figure, limb: Limb, name: &str, angles: &BTreeMap<Bone, Angles>) -> DVec3 {
    let a = figure.articulators[limb.index()][name];
    let (origin, turn) = posed(figure, angles)[&a.bone];
    origin + turn * a.at
}

#[test]
fn has_every_bone_and_no_warnings() {
    let read = |name: &str| {
        let path = format!("{}/../../assets/figures/{name}", env!("CARGO_MANIFEST_DIR"));
        std::fs::read(path).map_err(|e| e.to_string())
    };
    let text = String::from_utf8(read("mannequin.figure.ron").unwrap()).unwrap();
    let (figure, warnings) = figure::load(&text, &mut |name| read(name)).unwrap();
    assert_eq!(figure, figure::mannequin().unwrap(), "the built-in files are those of the folder");
    assert_eq!(Figure { skin: None, ..figure.clone() }, mannequin());
    let skin = figure.skin.as_ref().expect("the mannequin has a skin");
    assert_eq!(skin.fault(), None);
    let top = skin.positions.iter().map(|p| p[1]).fold(f32::MIN, f32::max);
    let bottom = skin.positions.iter().map(|p| p[1]).fold(f32::MAX, f32::min);
    assert!((f64::from(top - bottom) - STATURE).abs() < 0.01, "from {bottom} to {top}");
    assert_eq!(warnings, Vec::<String>::new());
    for bone in Bone::ALL {
        let joint = joint(&figure, bone);
        assert_eq!(joint.carrier, (bone != Bone::Hips).then(|| bone.carrier()), "{bone}");
        let masses = figure.skeleton.joints().filter(|j| j.mass > 0.0).count();
        assert_eq!(masses, Bone::COUNT);
    }
}

#[test]
fn the_right_side_mirrors_the_left() {
    let figure = mannequin();
    for left in figure.skeleton.joints().filter(|j| j.bone.side() != Some(Side::Right)) {
        let right = joint(&figure, left.bone.mirrored());
        let name = left.bone;
        assert!((right.offset - mirrored(left.offset)).length() < 1e-12, "{name} offset");
        assert!((right.center_of_mass - mirrored(left.center_of_mass)).length() < 1e-12, "{name} mass");
        assert_eq!(right.mass, left.mass, "{name}");
        assert!(left.dofs().eq(right.dofs()), "{name}");
        for dof in left.dofs() {
            assert_eq!(left.range(dof), right.range(dof), "{name}");
            let (l, r) = (left.rotation(angles(dof, 20.0)), right.rotation(angles(dof, 20.0)));
            if name.side().is_some() {
                assert!((r * DVec3::Y - mirrored(l * DVec3::Y)).length() < 1e-12, "{name} {dof:?}");
                assert!((r * DVec3::Z - mirrored(l * DVec3::Z)).length() < 1e-12, "{name} {dof:?}");
            }
        }
    }
    for (left, right) in [(Limb::LeftArm, Limb::RightArm), (Limb::LeftLeg, Limb::RightLeg)] {
        let base = |limb: Limb| figure.limbs.swing_base(limb);
        assert!((base(right) - mirrored(base(left))).length() < 1e-12);
        for (name, a) in &figure.articulators[left.index()] {
            let b = figure.articulators[right.index()][name];
            assert_eq!((b.bone, b.at), (a.bone.mirrored(), mirrored(a.at)), "{name}");
        }
        let cone = |limb: Limb| match joint(&figure, limb.parts().root).articulation {
            Articulation::Ball { cone: Some(cone), .. } => cone,
            _ => panic!("{limb:?} has no cone"),
        };
        assert_eq!(cone(right).axis, mirrored(cone(left).axis));
        assert_eq!(cone(right).half_angle, cone(left).half_angle);
    }
}

#[test]
fn stands_in_the_t_pose_at_its_stature() {
    let figure = mannequin();
    let at = |bone| figure.skeleton.rest_position(bone);
    for bone in [Bone::LeftUpperArm, Bone::LeftLowerArm, Bone::LeftHand] {
        assert!((at(bone).y - at(Bone::LeftUpperArm).y).abs() < 1e-12, "{bone} is level");
        assert!((at(bone).z - at(Bone::LeftUpperArm).z).abs() < 1e-12, "{bone} is straight");
    }
    for bone in [Bone::LeftLowerLeg, Bone::LeftFoot] {
        assert!((at(bone).x - at(Bone::LeftUpperLeg).x).abs() < 1e-12, "{bone} is below the hip");
        assert!((at(bone).z - at(Bone::LeftUpperLeg).z).abs() < 1e-12, "{bone} is straight");
    }
    let column = [Bone::Hips, Bone::Spine, Bone::Chest, Bone::UpperChest, Bone::Neck, Bone::Head].map(at);
    assert!(column.iter().all(|p| p.x == 0.0 && p.z == 0.0));
    let steps: Vec<f64> = column.windows(2).map(|w| w[1].y - w[0].y).collect();
    assert!((steps[1] - steps[2]).abs() < 1e-12 && (steps[2] - steps[3]).abs() < 1e-12, "{steps:?}");
    // Landmarks as fractions of stature: Drillis and Contini.
    assert!((at(Bone::LeftEye).y / STATURE - 0.936).abs() < 1e-3);
    assert!((at(Bone::LeftUpperLeg).y / STATURE - 0.530).abs() < 1e-3);
    assert!((at(Bone::LeftLowerLeg).y / STATURE - 0.285).abs() < 1e-3);
    assert!((at(Bone::LeftFoot).y / STATURE - 0.039).abs() < 1e-3);
    let rest = BTreeMap::new();
    let span = 2.0 * reached(&figure, Limb::LeftArm, "middleTip", &rest).x;
    assert!((1.0..1.05).contains(&(span / STATURE)), "span {span}");
    for sole in ["heel", "ball"] {
        assert!(reached(&figure, Limb::LeftLeg, sole, &rest).y.abs() < 1e-12, "{sole} is on the floor");
    }
    let foot =
        reached(&figure, Limb::LeftLeg, "toeTip", &rest) - reached(&figure, Limb::LeftLeg, "heel", &rest);
    assert!((0.12..0.152).contains(&(foot.z / STATURE)), "{foot}");
}

#[test]
fn weighs_what_it_should_where_it_should() {
    let figure = mannequin();
    let total: f64 = figure.skeleton.joints().map(|j| j.mass).sum();
    assert!((total - 68.0).abs() < 1e-9, "{total}");
    let arms_down: BTreeMap<_, _> =
        [Bone::LeftUpperArm, Bone::RightUpperArm].map(|b| (b, angles(Dof::Abduction, -90.0))).into();
    let standing = center_of_mass(&figure, &arms_down);
    assert!((0.55..0.57).contains(&(standing.y / STATURE)), "{standing}");
    let t_pose = center_of_mass(&figure, &BTreeMap::new());
    assert!(t_pose.y > standing.y + 0.01 && t_pose.y / STATURE < 0.59, "{t_pose}");
    let (heel, ball) = (-0.03, 0.126);
    assert!(standing.x.abs() < 1e-12 && standing.z > heel && standing.z < ball, "{standing}");
}

#[test]
fn positive_angles_do_what_the_table_says() {
    use Bone as B;
    use Dof::{Abduction, Flexion, Twist};
    let figure = mannequin();
    // A joint, what it turns, a direction fixed in it at rest, and where that goes.
    let rows = [
        (B::Spine, Flexion, DVec3::Y, DVec3::Z),
        (B::Head, Abduction, DVec3::Y, DVec3::X),
        (B::Hips, Twist, DVec3::Z, DVec3::X),
        (B::LeftShoulder, Flexion, DVec3::X, DVec3::Z),
        (B::LeftShoulder, Abduction, DVec3::X, DVec3::Y),
        (B::LeftShoulder, Twist, DVec3::Y, DVec3::Z),
        (B::LeftUpperArm, Flexion, DVec3::X, DVec3::Z),
        (B::LeftUpperArm, Abduction, DVec3::X, DVec3::Y),
        (B::LeftUpperArm, Twist, DVec3::Z, DVec3::NEG_Y),
        (B::LeftLowerArm, Flexion, DVec3::X, DVec3::Z),
        (B::LeftLowerArm, Twist, DVec3::Z, DVec3::NEG_Y),
        (B::LeftHand, Flexion, DVec3::X, DVec3::NEG_Y),
        (B::LeftHand, Abduction, DVec3::X, DVec3::Z),
        (B::LeftIndexProximal, Flexion, DVec3::X, DVec3::NEG_Y),
        (B::LeftIndexProximal, Abduction, DVec3::X, DVec3::Z),
        (B::LeftRingProximal, Abduction, DVec3::X, DVec3::NEG_Z),
        (B::LeftLittleProximal, Abduction, DVec3::X, DVec3::NEG_Z),
        (B::LeftUpperLeg, Flexion, DVec3::NEG_Y, DVec3::Z),
        (B::LeftUpperLeg, Abduction, DVec3::NEG_Y, DVec3::X),
        (B::LeftUpperLeg, Twist, DVec3::Z, DVec3::NEG_X),
        (B::LeftLowerLeg, Flexion, DVec3::NEG_Y, DVec3::NEG_Z),
        (B::LeftFoot, Flexion, DVec3::Z, DVec3::Y),
        (B::LeftFoot, Abduction, DVec3::Z, DVec3::X),
        (B::LeftFoot, Twist, DVec3::NEG_Y, DVec3::X),
        (B::LeftToes, Flexion, DVec3::Z, DVec3::NEG_Y),
        (B::Jaw, Flexion, DVec3::Z, DVec3::NEG_Y),
        (B::LeftEye, Flexion, DVec3::Z, DVec3::NEG_Y),
        (B::LeftEye, Twist, DVec3::Z, DVec3::X),
        (B::RightEye, Twist, DVec3::Z, DVec3::NEG_X),
    ];
    for (bone, dof, from, to) in rows {
        let turned = joint(&figure, bone).rotation(angles(dof, 90.0)) * from;
        assert!((turned - to).length() < 1e-12, "{bone} {dof:?}: {from} goes to {turned}");
    }
}

#[test]
fn ranges_are_round_degrees() {
    let figure = mannequin();
    let range = |bone, dof| joint(&figure, bone).range(dof).map(|r| (r.min, r.max));
    assert_eq!(range(Bone::LeftLowerArm, Dof::Flexion), Some((0.0, 150.0)));
    assert_eq!(range(Bone::LeftLowerArm, Dof::Twist), Some((-160.0, 0.0)));
    assert_eq!(range(Bone::LeftLowerArm, Dof::Abduction), None);
    assert_eq!(range(Bone::RightHand, Dof::Abduction), Some((-30.0, 20.0)));
    assert_eq!(range(Bone::LeftFoot, Dof::Twist), Some((-30.0, 20.0)));
    for joint in figure.skeleton.joints().filter(|j| j.bone != Bone::Hips) {
        for dof in joint.dofs() {
            let range = joint.range(dof).unwrap();
            assert!(range.contains(0.0), "{}: rest is in range", joint.bone);
            assert_eq!((range.min * 2.0).fract(), 0.0, "{}", joint.bone);
            assert_eq!((range.max * 2.0).fract(), 0.0, "{}", joint.bone);
        }
    }
}

#[test]
fn cones_let_limbs_go_where_people_go() {
    let figure = mannequin();
    let cone = |bone| match joint(&figure, bone).articulation {
        Articulation::Ball { cone: Some(cone), .. } => cone,
        _ => panic!("{bone} has no cone"),
    };
    let leg = |forward: f64, out: f64| {
        let (f, o) = (forward.to_radians(), out.to_radians());
        DVec3::new(o.sin(), -f.cos() * o.cos(), f.sin() * o.cos())
    };
    let arm = |x, y, z| DVec3::new(x, y, z).normalize();
    let inside = [(118.0, 0.0), (0.0, 45.0), (-17.0, 0.0), (0.0, -30.0), (90.0, 40.0)];
    let outside = [(125.0, 0.0), (-25.0, 0.0), (0.0, 90.0), (-10.0, -40.0)];
    for (forward, out) in inside {
        assert!(cone(Bone::LeftUpperLeg).contains(leg(forward, out), 0.0), "{forward} {out}");
    }
    for (forward, out) in outside {
        assert!(!cone(Bone::LeftUpperLeg).contains(leg(forward, out), 0.0), "{forward} {out}");
    }
    let reachable = [
        arm(1.0, 0.0, 0.0),
        arm(0.0, -1.0, 0.0),
        arm(0.0, 1.0, 0.0),
        arm(-0.5, 0.0, 1.0),
        arm(0.2, -1.0, -0.5),
    ];
    for direction in reachable {
        assert!(cone(Bone::LeftUpperArm).contains(direction, 0.0), "{direction}");
    }
    for direction in [arm(-1.0, 0.0, -0.2), arm(0.0, 0.0, -1.0)] {
        assert!(!cone(Bone::LeftUpperArm).contains(direction, 0.0), "{direction}");
    }
}

#[test]
fn names_the_articulators_and_handshapes_of_the_manual() {
    let figure = mannequin();
    let names = |limb: Limb| figure.articulators[limb.index()].keys().cloned().collect::<Vec<_>>();
    assert_eq!(names(Limb::RightLeg), ["ankle", "ball", "heel", "toeTip"]);
    assert_eq!(names(Limb::RightArm).len(), 12);
    for name in ["relaxed", "fist", "flat", "point", "open5", "i", "flatO"] {
        assert_eq!(figure.handshapes[name].len(), 15, "{name} is complete");
    }
    assert!(figure.handshapes.len() >= 14);
    let fingers = figure.skeleton.joints().filter(|j| j.bone.part() == Part::LeftHand).count();
    assert_eq!(fingers, 15);
}

#[test]
fn articulators_lie_on_the_skin() {
    let figure = figure::mannequin().expect("the shipped figure is whole");
    let skin = figure.skin.as_ref().expect("the mannequin has a skin");
    for limb in [Limb::LeftArm, Limb::LeftLeg] {
        // The centres of wrist and ankle lie inside, all others on the surface.
        for name in figure.articulators[limb.index()].keys().filter(|n| *n != "wrist" && *n != "ankle") {
            let at = reached(&figure, limb, name, &BTreeMap::new());
            let distances = skin.positions.iter().map(|p| (DVec3::from(p.map(f64::from)) - at).length());
            let nearest = distances.fold(f64::MAX, f64::min);
            assert!(nearest < 0.005, "{name} is {nearest} m from the skin");
        }
    }
}

#[test]
fn handshapes_look_like_their_names() {
    let figure = mannequin();
    let tip = |shape: &str, finger: &str| {
        let angles = figure.handshapes[shape].clone();
        reached(&figure, Limb::LeftArm, &format!("{finger}Tip"), &angles)
            - figure.skeleton.rest_position(Bone::LeftHand)
    };
    let fingers = ["index", "middle", "ring", "little"];
    for finger in fingers {
        let fist = tip("fist", finger);
        assert!(fist.x < 0.085 && fist.y > -0.05 && fist.y < -0.01, "{finger} folds into the palm: {fist}");
    }
    let thumb = tip("fist", "thumb");
    let middle = tip("flat", "middle").z;
    assert!(thumb.y < -0.05 && thumb.z < middle + 0.02, "the thumb lies across the fingers: {thumb}");
    for finger in ["index", "middle"] {
        let gap = (tip("flatO", "thumb") - tip("flatO", finger)).length();
        assert!(gap < 0.013, "flatO: thumb and {finger} meet, {gap} m between their ends");
    }
    assert!((tip("pinch", "thumb") - tip("pinch", "index")).length() < 0.018);
    assert!(tip("i", "little").x > 0.14 && tip("i", "ring").x < 0.085);
    let spread = tip("open5", "index").z - tip("open5", "little").z;
    assert!(spread > 0.09 && spread > tip("flat", "index").z - tip("flat", "little").z + 0.03, "{spread}");
}

#[test]
fn distal_joints_follow_the_middle_ones() {
    let figure = mannequin();
    for (name, shape) in &figure.handshapes {
        for finger in ["Index", "Middle", "Ring", "Little"] {
            let flexion = |segment: &str| {
                let bone = Bone::from_name(&format!("left{finger}{segment}")).unwrap();
                shape[&bone].flexion
            };
            let (middle, distal) = (flexion("Intermediate"), flexion("Distal"));
            assert!((distal - middle * 2.0 / 3.0).abs() <= 5.0, "{name} {finger}: {middle} and {distal}");
        }
    }
}
