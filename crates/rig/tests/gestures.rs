//! Gestures by what they promise: aims met, balance found, mirrors exact, sliders that tell the live interval.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::sync::OnceLock;

use glam::DVec3;
use rig::{
    Bone, Contact, Dof, Figure, GestureError, Limb, Part, Pose, PosePatch, Side, Space, Target, evaluate,
    frames, live_range, mirror, mirrored_pose, sliders, turn,
};

fn figure() -> &'static Figure {
    static FIGURE: OnceLock<Figure> = OnceLock::new();
    FIGURE.get_or_init(|| interchange::figure::bare_mannequin().expect("the shipped figure loads"))
}

fn turned(pose: &Pose, bone: Bone, dof: Dof, degrees: f64) -> Pose {
    turn(figure(), pose, bone, dof, degrees, true).expect("a turn").pose
}

/// Bent knees and both feet planted.
fn standing() -> Pose {
    let mut pose = figure().rest_pose();
    for (hip, knee, foot) in [
        (Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot),
        (Bone::RightUpperLeg, Bone::RightLowerLeg, Bone::RightFoot),
    ] {
        pose = turned(&pose, hip, Dof::Flexion, 20.0);
        pose = turned(&pose, knee, Dof::Flexion, 35.0);
        pose = turned(&pose, foot, Dof::Flexion, 15.0);
    }
    for leg in [Limb::LeftLeg, Limb::RightLeg] {
        let hold =
            Contact::Planted { space: Space::World, target: DVec3::ZERO, rotation: glam::DQuat::IDENTITY };
        pose = rig::keep(figure(), &pose, leg, hold).expect("a contact");
    }
    pose
}

#[test]
fn the_spine_aims_and_feet_stay() {
    let standing = standing();
    let at = DVec3::new(0.3, 1.9, 0.35);
    let moved = rig::aim_spine(figure(), &standing, at, 10.0, true).unwrap();
    assert!(!moved.clamped);
    let frames = frames(figure(), &moved.pose);
    let spine = frames[Bone::Spine].position;
    let off = (frames[Bone::Neck].position - spine).angle_between(at - spine);
    assert!(off < 1e-7, "{off}");
    let again = rig::aim_spine(figure(), &moved.pose, at, 10.0, true).unwrap();
    for bone in [Bone::Spine, Bone::Chest, Bone::UpperChest] {
        let (a, b) = (moved.pose.angles(bone), again.pose.angles(bone));
        assert!(Dof::ALL.iter().all(|d| (a.get(*d) - b.get(*d)).abs() < 1e-9), "aiming twice moves {bone}");
    }
}

#[test]
fn an_aim_beyond_the_spine_stops_at_its_ranges() {
    let moved =
        rig::aim_spine(figure(), &figure().rest_pose(), DVec3::new(0.0, 1.0, -3.0), 0.0, true).unwrap();
    assert!(moved.clamped);
    let joint = figure().skeleton.joint(Bone::Spine).unwrap();
    assert_eq!(moved.pose.angles(Bone::Spine).flexion, joint.range(Dof::Flexion).unwrap().min);
}

#[test]
fn the_eyes_look_at_the_point_and_take_what_the_neck_cannot() {
    for at in [DVec3::new(0.4, 1.7, 2.0), DVec3::new(-1.5, 1.0, 1.2), DVec3::new(2.0, 1.6, -0.6)] {
        let moved = rig::look_at(figure(), &figure().rest_pose(), at, true).unwrap();
        let frames = frames(figure(), &moved.pose);
        for eye in [Bone::LeftEye, Bone::RightEye] {
            let off = (frames[eye].rotation * DVec3::Z).angle_between(at - frames[eye].position);
            assert!(off < 1e-6 || moved.clamped, "{eye} misses {at} by {off}");
        }
        assert!(!moved.clamped, "{at} is in view");
    }
    let behind = rig::look_at(figure(), &figure().rest_pose(), DVec3::new(0.3, 1.6, -3.0), true).unwrap();
    assert!(behind.clamped);
}

#[test]
fn balance_brings_the_centre_of_mass_over_the_feet() {
    let leaning = rig::move_hips(figure(), &standing(), DVec3::new(0.07, 0.0, 0.06), true).unwrap().pose;
    let before = evaluate(figure(), &leaning, true);
    let moved = rig::balance(figure(), &leaning, 1.0, true).unwrap();
    let after = evaluate(figure(), &moved.pose, true);
    for leg in [Limb::LeftLeg, Limb::RightLeg] {
        assert!(
            after.limbs[leg.index()].residual < 1e-9 && after.limbs[leg.index()].rotation_residual < 1e-6
        );
    }
    let half = rig::balance(figure(), &leaning, 0.5, true).unwrap();
    let halfway = evaluate(figure(), &half.pose, true);
    assert!(after.center_of_mass.x.abs() < 1e-6, "{}", after.center_of_mass);
    assert!((halfway.center_of_mass.x - 0.5 * before.center_of_mass.x).abs() < 1e-6);
    assert_eq!(rig::balance(figure(), &figure().rest_pose(), 1.0, true), Err(GestureError::NoSupport));
}

#[test]
fn mirroring_twice_gives_the_same_pose() {
    let mut pose = standing();
    pose = turned(&pose, Bone::Chest, Dof::Twist, 12.0);
    pose = turned(&pose, Bone::LeftUpperArm, Dof::Abduction, -40.0);
    pose = turned(&pose, Bone::RightIndexProximal, Dof::Flexion, 30.0);
    assert_eq!(mirrored_pose(&mirrored_pose(&pose)), pose);
    let image = mirror(figure(), &pose, &[], true).unwrap().pose;
    let (a, b) = (frames(figure(), &pose), frames(figure(), &image));
    for bone in Bone::ALL {
        let flipped = a[bone].position * DVec3::new(-1.0, 1.0, 1.0);
        assert!(flipped.distance(b[bone.mirrored()].position) < 1e-12, "{bone}");
    }
    for leg in [Limb::LeftLeg, Limb::RightLeg] {
        assert!(evaluate(figure(), &image, true).limbs[leg.index()].residual < 1e-9);
    }
}

#[test]
fn a_placed_figure_mirrors_in_its_own_middle_plane() {
    let pose = rig::place(&standing(), DVec3::new(1.0, 0.0, -2.0), 37.0).unwrap();
    let image = mirror(figure(), &pose, &[], true).unwrap().pose;
    let view = evaluate(figure(), &image, true);
    for leg in [Limb::LeftLeg, Limb::RightLeg] {
        assert!(view.limbs[leg.index()].residual < 1e-9 && view.limbs[leg.index()].rotation_residual < 1e-6);
    }
}

#[test]
fn one_part_takes_its_twins_mirror_image() {
    let pose = turned(&figure().rest_pose(), Bone::LeftLowerArm, Dof::Flexion, 70.0);
    let after = mirror(figure(), &pose, &[Part::RightArm], true).unwrap().pose;
    assert_eq!(after.angles(Bone::RightLowerArm).flexion, 70.0);
    assert_eq!(after.angles(Bone::LeftLowerArm).flexion, 70.0);
}

#[test]
fn placing_carries_world_contacts_along() {
    let placed = rig::place(&standing(), DVec3::new(0.5, 0.1, 1.0), 60.0).unwrap();
    let view = evaluate(figure(), &placed, true);
    for leg in [Limb::LeftLeg, Limb::RightLeg] {
        assert!(view.limbs[leg.index()].residual < 1e-12 && view.limbs[leg.index()].rotation_residual < 1e-6);
    }
    assert_eq!(placed.angles, standing().angles);
}

#[test]
fn a_handshape_blends_and_an_arm_follows_its_fingertip() {
    let figure = figure();
    let mut pose = turned(&figure.rest_pose(), Bone::LeftLowerArm, Dof::Flexion, 80.0);
    pose = rig::articulate(figure, &pose, Limb::LeftArm, rig::Reacher::Named("indexTip".to_owned())).unwrap();
    let hold = Contact::Point { space: Space::World, target: DVec3::ZERO };
    pose = rig::keep(figure, &pose, Limb::LeftArm, hold).unwrap();
    let was = evaluate(figure, &pose, true).limbs[0].articulator;
    let moved = rig::handshape(figure, &pose, Side::Left, "fist", 0.5, true).unwrap();
    let shape = figure.handshapes["fist"][&Bone::LeftIndexProximal].flexion;
    assert!((moved.pose.angles(Bone::LeftIndexProximal).flexion - shape * 0.5).abs() < 1e-12);
    assert!(evaluate(figure, &moved.pose, true).limbs[0].articulator.distance(was) < 1e-9);
    let right = rig::handshape(figure, &pose, Side::Right, "fist", 1.0, true).unwrap().pose;
    assert_eq!(right.angles(Bone::RightIndexProximal).flexion, shape);
    assert_eq!(right.angles(Bone::LeftIndexProximal), pose.angles(Bone::LeftIndexProximal));
}

#[test]
fn a_patch_blends_from_none_to_all_and_past() {
    let pose = figure().rest_pose();
    let mut patch = PosePatch::default();
    patch.joints.insert(Bone::Spine, rig::Angles { flexion: 10.0, abduction: 4.0, twist: -6.0 });
    patch.joints.insert(Bone::LeftLowerLeg, rig::Angles { flexion: 40.0, ..rig::Angles::REST });
    let blend = |amount| rig::apply_patch(figure(), &pose, &patch, &[], amount, true).unwrap().pose;
    assert_eq!(blend(0.0).angles, pose.angles);
    assert_eq!(blend(1.0).angles(Bone::Spine), patch.joints[&Bone::Spine]);
    assert!((blend(1.5).angles(Bone::LeftLowerLeg).flexion - 60.0).abs() < 1e-12);
    assert_eq!(blend(9.0).angles(Bone::LeftLowerLeg).flexion, 155.0, "a range stops it");
    let torso = rig::apply_patch(figure(), &pose, &patch, &[Part::Torso], 1.0, true).unwrap().pose;
    assert_eq!(torso.angles(Bone::LeftLowerLeg).flexion, 0.0);
}

#[test]
fn a_cone_joints_sliders_show_the_live_interval() {
    let figure = figure();
    let joint = figure.skeleton.joint(Bone::LeftUpperArm).unwrap();
    let bone = joint.bone_direction().unwrap();
    let rig::Articulation::Ball { cone: Some(cone), .. } = &joint.articulation else { panic!("a cone") };
    for (flexion, abduction) in [(0.0, 0.0), (40.0, -70.0), (-20.0, -60.0), (80.0, 20.0)] {
        let pose = turned(
            &turned(&figure.rest_pose(), Bone::LeftUpperArm, Dof::Abduction, abduction),
            Bone::LeftUpperArm,
            Dof::Flexion,
            flexion,
        );
        for slider in sliders(figure, &pose, Bone::LeftUpperArm, true) {
            assert!(slider.range.contains(slider.value));
            if slider.dof == Dof::Twist {
                continue;
            }
            for end in [slider.range.min, slider.range.max] {
                let mut angles = pose.angles(Bone::LeftUpperArm);
                angles.set(slider.dof, end);
                let at_end = cone.angle(joint.rotation(angles) * bone);
                assert!(at_end <= cone.half_angle + 1e-9);
                let beyond = end + (end - slider.value).signum() * 0.01;
                angles.set(slider.dof, beyond);
                let past = cone.angle(joint.rotation(angles) * bone) > cone.half_angle;
                let fixed = joint.range(slider.dof).unwrap();
                assert!(past || !fixed.contains(beyond) || beyond.abs() > 179.0, "{slider:?} could go on");
            }
        }
    }
}

#[test]
fn a_joint_outside_its_range_moves_inward_only() {
    let mut pose = figure().rest_pose();
    pose.angles[Bone::LeftLowerLeg.index()].flexion = 170.0;
    let joint = figure().skeleton.joint(Bone::LeftLowerLeg).unwrap();
    assert_eq!(live_range(joint, pose.angles(Bone::LeftLowerLeg), Dof::Flexion, true).max, 170.0);
    let held = turn(figure(), &pose, Bone::LeftLowerLeg, Dof::Flexion, 175.0, true).unwrap();
    assert!(held.clamped && held.pose.angles(Bone::LeftLowerLeg).flexion == 170.0);
    let inward = turned(&pose, Bone::LeftLowerLeg, Dof::Flexion, 160.0);
    assert_eq!(inward.angles(Bone::LeftLowerLeg).flexion, 160.0);
}

#[test]
fn contacts_round_in_a_circle_are_turned_down_by_name() {
    let figure = figure();
    let on = |bone| Contact::Point { space: Space::Body(bone), target: DVec3::ZERO };
    let pose = rig::keep(figure, &figure.rest_pose(), Limb::LeftArm, on(Bone::RightHand)).unwrap();
    let fault = rig::keep(figure, &pose, Limb::RightArm, on(Bone::LeftHand)).unwrap_err();
    assert!(matches!(&fault, GestureError::Cycle(limbs) if limbs.len() == 2), "{fault}");
    let own = rig::keep(figure, &pose, Limb::LeftLeg, on(Bone::LeftToes)).unwrap_err();
    assert_eq!(own, GestureError::Cycle(vec![Limb::LeftLeg]));
    let target = Target { space: Space::Body(Bone::LeftHand), point: DVec3::ZERO };
    let free = rig::reach(figure, &pose, Limb::RightArm, target, true);
    assert!(free.is_ok(), "a free limb may reach for a hand that holds on to it");
}

#[test]
fn a_planted_foot_that_its_ankle_cannot_keep_flat_says_by_how_much() {
    let sunk = rig::move_hips(figure(), &standing(), DVec3::new(0.0, -0.35, 0.0), true).unwrap();
    assert!(sunk.clamped);
    let view = evaluate(figure(), &sunk.pose, true);
    let left = &view.limbs[Limb::LeftLeg.index()];
    assert!(left.residual < 1e-9, "the ankle stays on its place: {}", left.residual);
    assert!(left.rotation_residual > 5.0, "and the foot tips: {}", left.rotation_residual);
}
