//! The pointer in the picture of the figure.

use app::Section;
use egui::accesskit::Role;
use egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::Queryable as _;
use rig::{Bone, Contact, Limb};

use crate::hand::{ELBOW, LEFT_ARM, at, click, drag, pose, set, steps, view};

#[test]
fn dragging_empty_space_turns_the_view_and_not_the_figure() {
    let mut hand = at(LEFT_ARM);
    let (before, camera) = (pose(&hand), hand.state().viewport.camera);
    let empty = hand.state().viewport.rect().min + vec2(60.0, 60.0);
    drag(&mut hand, empty, &[empty + vec2(20.0, 5.0), empty + vec2(60.0, 10.0)]);
    let turned = hand.state().viewport.camera;
    assert!(turned.yaw_rad < camera.yaw_rad && turned.pitch_rad > camera.pitch_rad);
    assert_eq!(turned.target, camera.target);
    hand.key_press(Key::Num1);
    hand.run();
    assert_eq!(hand.state().viewport.camera.yaw_rad, 0.0);
    click(&mut hand, "View");
    click(&mut hand, "Right");
    assert!(hand.state().viewport.camera.eye().x < -1.0);
    assert_eq!(pose(&hand), before);
    assert_eq!(steps(&hand), 0);
}

#[test]
fn the_wheel_comes_nearer_to_what_is_under_the_pointer() {
    let mut hand = at(LEFT_ARM);
    let before = hand.state().viewport.camera.distance;
    let chest = hand.state().viewport.camera.target;
    let place = hand.state().viewport.window_of(chest.as_dvec3()).unwrap();
    hand.hover_at(place);
    hand.step();
    hand.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Line,
        delta: vec2(0.0, 4.0),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Wheel,
        modifiers: Modifiers::NONE,
    });
    hand.run_steps(20);
    let after = hand.state().viewport.camera.distance;
    assert!(after < before * 0.9, "{before} {after}");
    let moved = hand.state().viewport.window_of(chest.as_dvec3()).unwrap() - place;
    assert!(moved.length() < 0.5, "{moved}");
}

#[test]
fn a_click_on_a_joint_chooses_it_and_opens_its_section() {
    let mut hand = at(Section::Figure);
    let knee = hand.state().editor().evaluation().frames[Bone::RightLowerLeg].position;
    let place = hand.state().viewport.window_of(knee).unwrap();
    drag(&mut hand, place, &[]);
    assert_eq!(hand.state().panels.selected(), Some(Bone::RightLowerLeg));
    hand.get_by_role_and_label(Role::Slider, "Right knee · flexion");
    let empty = hand.state().viewport.rect().min + vec2(30.0, 30.0);
    drag(&mut hand, empty, &[]);
    assert_eq!(hand.state().panels.selected(), None);
}

#[test]
fn a_dragged_target_moves_in_the_plane_of_the_view() {
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 60.0);
    hand.key_press(Key::Num1);
    hand.run();
    let before = view(&hand, Limb::LeftArm);
    let depth = steps(&hand);
    let place = hand.state().viewport.window_of(before.target).unwrap();
    drag(&mut hand, place, &[place + vec2(-12.0, 4.0), place + vec2(-30.0, 12.0)]);
    let after = view(&hand, Limb::LeftArm);
    assert!(after.residual < 1e-9, "{after:?}");
    let place = hand.state().viewport.window_of(after.articulator).unwrap() - place;
    assert!((place - vec2(-30.0, 12.0)).length() < 1.0, "{place}");
    assert!((after.articulator.z - before.articulator.z).abs() < 1e-6);
    assert_eq!(steps(&hand), depth + 1);
    assert_eq!(pose(&hand).limb(Limb::LeftArm).contact, Contact::Free);
}

#[test]
fn keys_act_on_the_chosen_joint() {
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 40.0);
    hand.state_mut().panels.select(Some(Bone::LeftLowerArm));
    hand.run();
    let contact = |hand: &crate::hand::Hand| hand.state().editor().pose().limb(Limb::LeftArm).contact;
    let before = pose(&hand);
    let depth = steps(&hand);
    hand.key_press(Key::P);
    hand.run();
    assert!(matches!(contact(&hand), Contact::Point { .. }));
    hand.key_press(Key::P);
    hand.run();
    assert!(matches!(contact(&hand), Contact::Planted { .. }));
    assert_eq!(pose(&hand).angles, before.angles, "a contact moves nothing");
    hand.key_press(Key::P);
    hand.run();
    assert_eq!(contact(&hand), Contact::Free);
    assert_eq!(steps(&hand), depth + 3);
    hand.key_press_modifiers(Modifiers::ALT, Key::R);
    hand.run();
    assert_eq!(pose(&hand).angles(Bone::LeftLowerArm), rig::Angles::REST);
    assert_eq!(steps(&hand), depth + 4, "one step for all angles of the joint");
    hand.key_press(Key::OpenBracket);
    hand.run();
    assert_eq!(hand.state().panels.selected(), Some(Bone::LeftUpperArm));
    hand.key_press(Key::CloseBracket);
    hand.run();
    hand.key_press(Key::CloseBracket);
    hand.run();
    assert_eq!(hand.state().panels.selected(), Some(Bone::LeftHand));
}
