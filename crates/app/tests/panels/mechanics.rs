//! Rows that act on several joints or on how gestures work: curl, eyes, balance, body mechanics.

use app::Section;
use edit::{Command, Hold, Request};
use egui::accesskit::Role;
use egui::vec2;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use glam::DVec3;
use rig::{Bone, Dof, Limb, Mechanics, Part, Side, Space};

use crate::hand::{
    ELBOW, Hand, LEFT_ARM, at, click, drag, pose, set, set_number, slider_center, steps, undo,
};

/// The curl that the pose shows.
fn curl(hand: &Hand, finger: Option<edit::Finger>) -> f64 {
    let editor = hand.state().editor();
    edit::curl(editor.figure(), editor.pose(), Side::Left, finger).unwrap()
}

/// Both feet planted, knees bent.
fn planted(hand: &mut Hand) {
    for limb in [Limb::LeftLeg, Limb::RightLeg] {
        let command = Command::Keep { limb, contact: Hold::Planted, space: Space::World };
        hand.state_mut().submit(Request::Do(command));
    }
    let by = DVec3::new(0.0, -0.15, 0.0);
    hand.state_mut().submit(Request::Do(Command::MoveHips { by }));
    hand.run();
}

#[test]
fn a_hand_curls_and_spreads_as_one_and_finger_by_finger() {
    let mut hand = at(Section::Body(Part::LeftHand));
    set(&mut hand, "Left hand curl", 40.0);
    assert!((curl(&hand, None) - 0.4).abs() < 1e-9);
    set(&mut hand, "Left index curl", 90.0);
    assert!((curl(&hand, Some(edit::Finger::Index)) - 0.9).abs() < 1e-9);
    assert!((curl(&hand, Some(edit::Finger::Ring)) - 0.4).abs() < 1e-9);
    set_number(&mut hand, "Left hand spread", 100.0);
    assert_eq!(pose(&hand).angles(Bone::LeftIndexProximal).abduction, 20.0);
    assert_eq!(steps(&hand), 3);
    for _ in 0..3 {
        undo(&mut hand);
    }
    assert_eq!(curl(&hand, None), 0.0);
}

#[test]
fn a_drag_of_a_curl_is_one_step_and_leads_back_to_where_it_began() {
    let mut hand = at(Section::Body(Part::LeftHand));
    let shape = Command::Handshape { side: Side::Left, name: "point".into(), amount: 1.0 };
    hand.state_mut().submit(Request::Do(shape));
    hand.run();
    let before = pose(&hand);
    let from = slider_center(&hand, "Left hand curl");
    drag(&mut hand, from, &[from + vec2(60.0, 0.0), from + vec2(-90.0, 0.0), from + vec2(40.0, 0.0)]);
    assert_eq!(steps(&hand), 2);
    assert_ne!(pose(&hand), before);
    undo(&mut hand);
    // All fingers were in a fist on the way, and straight: they differ again as they did.
    drag(&mut hand, from, &[from + vec2(300.0, 0.0), from + vec2(-300.0, 0.0), from + vec2(0.5, 0.0)]);
    for finger in edit::Finger::ALL {
        for bone in finger.bones(Side::Left) {
            let by = pose(&hand).angles(bone).flexion - before.angles(bone).flexion;
            assert!(by.abs() < 3.0, "{bone} by {by}");
        }
    }
}

#[test]
fn both_eyes_turn_without_the_head() {
    let mut hand = at(Section::Body(Part::Head));
    set(&mut hand, "Eyes aside", 15.0);
    set(&mut hand, "Eyes down", 8.0);
    let found = pose(&hand);
    assert_eq!((found.angles(Bone::LeftEye).twist, found.angles(Bone::RightEye).twist), (15.0, -15.0));
    assert_eq!((found.angles(Bone::LeftEye).flexion, found.angles(Bone::RightEye).flexion), (8.0, 8.0));
    assert_eq!(found.angles(Bone::Head), rig::Angles::REST);
    assert_eq!(steps(&hand), 2);
}

#[test]
fn mechanics_are_switched_each_as_one_step() {
    let mut hand = at(Section::Figure);
    click(&mut hand, "Collar rises with the arm");
    let from = slider_center(&hand, "Torso follows");
    drag(&mut hand, from, &[from + vec2(10.0, 0.0), from + vec2(30.0, 0.0), from + vec2(60.0, 0.0)]);
    let Mechanics { collar_rhythm, torso_follow } = hand.state().document().mechanics;
    assert!(collar_rhythm && torso_follow > 0.05, "{torso_follow}");
    assert_eq!(steps(&hand), 2);
    let shown =
        hand.get_by_role_and_label(Role::Slider, "Torso follows").accesskit_node().numeric_value().unwrap();
    assert!((shown - torso_follow * 100.0).abs() < 1e-9);
    undo(&mut hand);
    undo(&mut hand);
    assert_eq!(hand.state().document().mechanics, Mechanics::default());
    set_number(&mut hand, "Torso follows", 50.0);
    assert_eq!(hand.state().document().mechanics.torso_follow, 0.5);
}

#[test]
fn balance_is_dragged_and_told() {
    let mut hand = at(Section::Figure);
    planted(&mut hand);
    let by = DVec3::new(0.0, 0.0, -0.15);
    hand.state_mut().submit(Request::Do(Command::MoveHips { by }));
    hand.run();
    let (before, depth) = (pose(&hand), steps(&hand));
    let from = slider_center(&hand, "Balance amount");
    drag(&mut hand, from, &[from + vec2(20.0, 0.0), from + vec2(120.0, 0.0)]);
    assert_eq!(steps(&hand), depth + 1);
    assert!(pose(&hand).hips.z > before.hips.z + 0.02);
    let evaluation = hand.state().editor().evaluation();
    assert!(evaluation.limbs[Limb::LeftLeg.index()].residual < 1e-9);
    let rest = hand.get_by_role_and_label(Role::Slider, "Balance amount").accesskit_node().numeric_value();
    assert_eq!(rest, Some(0.0), "the slider is ready for the next drag");
    click(&mut hand, "Show in the picture");
    assert!(hand.state().panels.balance_marks());
}

#[test]
fn with_symmetry_a_row_of_one_hand_acts_on_both() {
    let mut hand = at(Section::Body(Part::LeftHand));
    hand.state_mut().submit(Request::Symmetry(true));
    hand.run();
    set(&mut hand, "Left thumb curl", 70.0);
    let found = pose(&hand);
    for dof in Dof::ALL {
        let thumb = Bone::LeftThumbProximal;
        assert_eq!(found.angles(thumb).get(dof), found.angles(thumb.mirrored()).get(dof));
    }
    assert!(found.angles(Bone::RightThumbProximal).flexion > 20.0);
    assert_eq!(steps(&hand), 2);
}

#[test]
fn the_row_of_a_locked_joint_says_so() {
    let mut hand = at(LEFT_ARM);
    hand.state_mut().submit(Request::Lock(Bone::LeftLowerArm.into(), true));
    hand.run();
    hand.hover_at(slider_center(&hand, ELBOW));
    for _ in 0..20 {
        hand.step();
    }
    hand.get_by_label_contains("locked where it is");
}
