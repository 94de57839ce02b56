//! What each part of the body offers besides its sliders.

use app::{Section, labels};
use edit::{By, Command, Hold, Request};
use egui::accesskit::Role;
use egui::vec2;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use glam::DVec3;
use rig::{Bone, Contact, Dof, Limb, Part, Reacher, Side, Space};

use crate::hand::{
    ELBOW, Hand, LEFT_ARM, at, click, drag, pose, set, set_number, slider_center, steps, view,
};

#[test]
fn contacts_are_chosen_and_let_go() {
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 50.0);
    let angles = pose(&hand).angles;
    click(&mut hand, "Left arm contact · Planted");
    let contact = pose(&hand).limb(Limb::LeftArm).contact;
    assert!(matches!(contact, Contact::Planted { space: Space::World, .. }), "{contact:?}");
    click(&mut hand, "Left arm space");
    hand.get_by_role_and_label(Role::Button, "Head").click();
    hand.run();
    let contact = pose(&hand).limb(Limb::LeftArm).contact;
    assert!(matches!(contact, Contact::Planted { space: Space::Body(Bone::Head), .. }), "{contact:?}");
    click(&mut hand, "Left arm contact · Point");
    let contact = pose(&hand).limb(Limb::LeftArm).contact;
    assert!(matches!(contact, Contact::Point { space: Space::Body(Bone::Head), .. }), "{contact:?}");
    assert_eq!(pose(&hand).angles, angles, "holding on moves nothing");
    click(&mut hand, "Left arm contact · Free");
    assert_eq!(pose(&hand).limb(Limb::LeftArm).contact, Contact::Free);
    assert!(hand.query_by_label("Left arm space").is_none());
}

#[test]
fn another_articulator_moves_nothing() {
    let mut hand = at(LEFT_ARM);
    let before = pose(&hand);
    click(&mut hand, "Left arm articulator");
    click(&mut hand, "index tip");
    let after = pose(&hand);
    assert_eq!(after.limb(Limb::LeftArm).reacher, Reacher::Named("indexTip".to_owned()));
    assert_eq!(after.angles, before.angles);
}

#[test]
fn elevation_turns_the_elbow_and_keeps_the_palm() {
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 80.0);
    let before = view(&hand, Limb::LeftArm);
    let [least, most] = before.elevation_range.unwrap();
    let goal = (before.elevation.unwrap() + 15.0).clamp(least, most);
    set(&mut hand, "Left arm elevation", goal);
    let after = view(&hand, Limb::LeftArm);
    assert!((after.elevation.unwrap() - goal).abs() < 1e-6, "{after:?}");
    assert!(after.articulator.distance(before.articulator) < 1e-9);
}

#[test]
fn a_target_is_reached_or_the_panel_says_how_far_off_it_is() {
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 60.0);
    click(&mut hand, "Left arm contact · Point");
    let goal = view(&hand, Limb::LeftArm).target.y + 0.1;
    set_number(&mut hand, "Left arm target y", goal);
    let near = view(&hand, Limb::LeftArm);
    assert!((near.articulator.y - goal).abs() < 1e-9 && near.residual < 1e-9, "{near:?}");
    set_number(&mut hand, "Left arm target x", 2.0);
    let far = view(&hand, Limb::LeftArm);
    assert!(far.residual > 0.5 && far.target.x == 2.0, "{far:?}");
    assert!(hand.query_all_by_label_contains("mm short").count() >= 1);
}

#[test]
fn a_target_on_a_body_stays_on_it_when_it_is_moved() {
    let mut hand = at(LEFT_ARM);
    for command in [
        Command::Keep { limb: Limb::LeftArm, contact: Hold::Point, space: Space::Body(Bone::Head) },
        Command::Turn { joint: Bone::Head, dof: Dof::Twist, degrees: 20.0, by: By::To },
    ] {
        hand.state_mut().submit(Request::Do(command));
    }
    hand.run();
    let goal = view(&hand, Limb::LeftArm).target.x - 0.1;
    set_number(&mut hand, "Left arm target x", goal);
    let after = view(&hand, Limb::LeftArm);
    assert!((after.articulator.x - goal).abs() < 1e-9, "{after:?}");
    let contact = pose(&hand).limb(Limb::LeftArm).contact;
    assert!(matches!(contact, Contact::Point { space: Space::Body(Bone::Head), .. }), "{contact:?}");
}

#[test]
fn the_wrist_turns_in_contact() {
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 80.0);
    click(&mut hand, "Left arm contact · Point");
    let before = view(&hand, Limb::LeftArm);
    set(&mut hand, "Left wrist · flexion in contact", 25.0);
    let after = view(&hand, Limb::LeftArm);
    assert!((pose(&hand).angles(Bone::LeftHand).flexion - 25.0).abs() < 1e-6);
    assert!(after.articulator.distance(before.articulator) < 1e-9, "{after:?}");
    assert_ne!(pose(&hand).angles(Bone::LeftLowerArm).flexion, 80.0);
}

#[test]
fn flip_takes_the_other_bend_or_says_why_not() {
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 80.0);
    let before = pose(&hand);
    click(&mut hand, "Left arm flip");
    let status = hand.state().status().clone();
    assert!(status.fault != (pose(&hand) != before), "{status:?}");
    assert!(!status.message.is_empty());
}

#[test]
fn the_ankle_turns_in_contact_and_the_leg_reaches() {
    let mut hand = at(Section::Body(Part::LeftLeg));
    set(&mut hand, "Left knee · flexion", 60.0);
    let before = view(&hand, Limb::LeftLeg);
    set_number(&mut hand, "Left leg target z", before.target.z + 0.1);
    let after = view(&hand, Limb::LeftLeg);
    assert!((after.articulator.z - before.target.z - 0.1).abs() < 1e-6, "{after:?}");
    set(&mut hand, "Left ankle · flexion in contact", 10.0);
    assert!((pose(&hand).angles(Bone::LeftFoot).flexion - 10.0).abs() < 1e-6);
}

#[test]
fn a_handshape_is_taken_on_in_part_or_whole() {
    let mut hand = at(Section::Body(Part::RightHand));
    let shape = hand.state().editor().figure().handshapes["fist"].clone();
    let curl = shape[&Bone::LeftIndexProximal].flexion;
    set(&mut hand, "Right handshape amount", 50.0);
    click(&mut hand, "Right handshape · fist");
    let half = pose(&hand).angles(Bone::RightIndexProximal).flexion;
    assert!((half - curl * 0.5).abs() < 1e-9, "{half}");
    set_number(&mut hand, "Right handshape amount", 100.0);
    click(&mut hand, "Right handshape · fist");
    let whole = pose(&hand).angles(Bone::RightIndexProximal).flexion;
    assert!((whole - curl).abs() < 1e-9, "{whole}");
    assert_eq!(pose(&hand).angles(Bone::LeftIndexProximal).flexion, 0.0);
    assert_eq!(steps(&hand), 2);
}

#[test]
fn a_part_is_reset_and_mirrored() {
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 70.0);
    set(&mut hand, "Left collar · abduction", 10.0);
    hand.state_mut().panels.set_open(Section::Body(Part::RightArm), true);
    hand.run();
    click(&mut hand, "Mirror right arm");
    let mirrored = pose(&hand);
    assert_eq!(mirrored.angles(Bone::RightLowerArm).flexion, 70.0);
    assert_eq!(mirrored.angles(Bone::LeftLowerArm).flexion, 70.0);
    click(&mut hand, "Reset left arm");
    assert_eq!(pose(&hand).angles(Bone::LeftLowerArm).flexion, 0.0);
    assert_eq!(pose(&hand).angles(Bone::RightLowerArm).flexion, 70.0);
    hand.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::M);
    hand.run();
    assert_eq!(pose(&hand).angles(Bone::LeftLowerArm).flexion, 70.0);
    assert_eq!(pose(&hand).angles(Bone::RightLowerArm).flexion, 0.0);
    hand.key_press_modifiers(egui::Modifiers::COMMAND | egui::Modifiers::ALT, egui::Key::R);
    hand.run();
    assert_eq!(pose(&hand).angles, hand.state().editor().figure().rest_pose().angles);
}

#[test]
fn the_figure_is_placed_turned_and_its_hips_moved() {
    let mut hand = at(Section::Figure);
    let hips = pose(&hand).hips;
    set_number(&mut hand, "Hips y", hips.y - 0.1);
    assert!((pose(&hand).hips.y - hips.y + 0.1).abs() < 1e-9);
    set_number(&mut hand, "Figure place x", 0.5);
    assert!((pose(&hand).place.position.x - 0.5).abs() < 1e-9);
    set(&mut hand, "Figure turn", 30.0);
    set_number(&mut hand, "Figure turn", 45.0);
    assert!((pose(&hand).place.turn - 45.0).abs() < 1e-9, "{:?}", pose(&hand).place);
    let from = slider_center(&hand, "Figure turn");
    let over = [from + vec2(10.0, 0.0), from + vec2(20.0, 0.0), from + vec2(30.0, 0.0)];
    let width = hand.get_by_role_and_label(Role::Slider, "Figure turn").rect().width();
    drag(&mut hand, from, &over);
    let turned = 45.0 + 360.0 * 30.0 / f64::from(width);
    assert!((pose(&hand).place.turn - turned).abs() < 0.06, "{:?} {turned}", pose(&hand).place);
}

#[test]
fn balance_needs_a_foot_on_the_ground_and_then_works() {
    let mut hand = at(Section::Figure);
    click(&mut hand, "Balance over the feet");
    assert!(hand.state().status().fault);
    let keep = Command::Keep { limb: Limb::LeftLeg, contact: Hold::Planted, space: Space::World };
    hand.state_mut().submit(Request::Do(keep));
    click(&mut hand, "Balance over the feet");
    assert!(!hand.state().status().fault, "{:?}", hand.state().status());
}

#[test]
fn the_spine_aims_and_the_eyes_look() {
    let mut hand = at(Section::Body(Part::Torso));
    let top = |hand: &Hand| hand.state().editor().evaluation().frames[Bone::Neck].position;
    let before = top(&hand);
    set_number(&mut hand, "Spine aim z", before.z + 0.15);
    assert!(top(&hand).z > before.z + 0.1, "{}", top(&hand));
    set(&mut hand, "Spine twist", 20.0);
    let shown = hand.get_by_role_and_label(Role::Slider, "Spine twist").accesskit_node().numeric_value();
    assert!((shown.unwrap() - 20.0).abs() < 1e-6, "{shown:?}");
    assert!(pose(&hand).angles(Bone::Chest).twist > 1.0);
    let mut hand = at(Section::Body(Part::Head));
    let eye = |hand: &Hand| hand.state().editor().evaluation().frames[Bone::LeftEye];
    set_number(&mut hand, "Look at x", 0.5);
    let ahead = eye(&hand).rotation * DVec3::Z;
    assert!(ahead.x > 0.3, "{ahead}");
}

#[test]
fn both_sides_have_handshapes() {
    for (side, part) in [(Side::Left, Part::LeftHand), (Side::Right, Part::RightHand)] {
        let hand = at(Section::Body(part));
        for name in hand.state().editor().figure().handshapes.keys() {
            hand.get_by_label(&format!("{} handshape · {name}", labels::side(side)));
        }
    }
}
