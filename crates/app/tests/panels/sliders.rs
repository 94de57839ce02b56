//! Sliders and numbers, one a degree of freedom.

use app::{Section, labels};
use egui::accesskit::Role;
use egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::Queryable as _;
use rig::{Bone, Part};

use crate::hand::{ELBOW, LEFT_ARM, at, click, drag, pose, set, slider_center, steps, undo};

#[test]
fn every_angle_of_every_bone_has_a_slider_and_a_number() {
    let mut hand = at(Section::Figure);
    for section in Section::ALL {
        hand.state_mut().panels.set_open(section, true);
    }
    hand.run();
    let figure = hand.state().editor().figure().clone();
    let mut count = 0;
    for joint in figure.skeleton.joints() {
        for dof in joint.dofs() {
            let label = labels::slider(joint.bone, dof);
            hand.get_by_role_and_label(Role::Slider, &label);
            hand.get_by_role_and_label(Role::SpinButton, &label);
            count += 1;
        }
    }
    assert_eq!(figure.skeleton.joints().count(), Bone::COUNT);
    assert!(count > 90, "{count}");
}

/// Every slider of a section, to a value within its range and back by undo.
fn sliders_turn_and_undo(part: Part) {
    let mut hand = at(Section::Body(part));
    let figure = hand.state().editor().figure().clone();
    let rest = pose(&hand);
    for joint in figure.skeleton.joints().filter(|joint| joint.bone.part() == part) {
        for slider in rig::sliders(&figure, &rest, joint.bone, true) {
            let (min, max) = (slider.range.min, slider.range.max);
            let goal = if max >= -min { max * 0.25 } else { min * 0.25 };
            let label = labels::slider(joint.bone, slider.dof);
            set(&mut hand, &label, goal);
            let turned = pose(&hand);
            let is = turned.angles(joint.bone).get(slider.dof);
            assert!((is - goal).abs() < 1e-9 && goal != 0.0, "{label}: {is} instead of {goal}");
            assert_eq!(steps(&hand), 1, "{label}");
            undo(&mut hand);
            assert_eq!(pose(&hand), rest, "{label}");
        }
    }
}

#[test]
fn sliders_of_torso_and_head_turn_and_undo() {
    sliders_turn_and_undo(Part::Torso);
    sliders_turn_and_undo(Part::Head);
}

#[test]
fn sliders_of_arms_turn_and_undo() {
    sliders_turn_and_undo(Part::LeftArm);
    sliders_turn_and_undo(Part::RightArm);
}

#[test]
fn sliders_of_hands_turn_and_undo() {
    sliders_turn_and_undo(Part::LeftHand);
    sliders_turn_and_undo(Part::RightHand);
}

#[test]
fn sliders_of_legs_turn_and_undo() {
    sliders_turn_and_undo(Part::LeftLeg);
    sliders_turn_and_undo(Part::RightLeg);
}

#[test]
fn a_drag_of_a_slider_is_one_step() {
    let mut hand = at(LEFT_ARM);
    let from = slider_center(&hand, ELBOW);
    drag(&mut hand, from, &[from + vec2(10.0, 0.0), from + vec2(30.0, 0.0), from + vec2(50.0, 3.0)]);
    let elbow = pose(&hand).angles(Bone::LeftLowerArm).flexion;
    assert!(elbow > 20.0, "{elbow}");
    assert_eq!(steps(&hand), 1);
    assert!(!hand.state().editor().in_gesture());
    undo(&mut hand);
    assert_eq!(pose(&hand).angles(Bone::LeftLowerArm).flexion, 0.0);
    hand.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::Z);
    hand.run();
    assert_eq!(pose(&hand).angles(Bone::LeftLowerArm).flexion, elbow);
}

#[test]
fn touching_a_slider_moves_nothing() {
    let mut hand = at(LEFT_ARM);
    let before = pose(&hand);
    let from = slider_center(&hand, ELBOW);
    drag(&mut hand, from, &[from + vec2(1.0, 0.0)]);
    assert_eq!(pose(&hand), before);
    assert_eq!(steps(&hand), 0);
}

#[test]
fn shift_drags_a_tenth_as_far() {
    let far = |modifiers: Modifiers| {
        let mut hand = at(LEFT_ARM);
        let from = slider_center(&hand, ELBOW);
        hand.hover_at(from);
        hand.step();
        hand.drag_at(from);
        hand.step();
        hand.event_modifiers(egui::Event::PointerMoved(from + vec2(50.0, 0.0)), modifiers);
        hand.step();
        pose(&hand).angles(Bone::LeftLowerArm).flexion
    };
    let ratio = far(Modifiers::NONE) / far(Modifiers::SHIFT);
    assert!((ratio - 10.0).abs() < 0.02, "{ratio}");
}

#[test]
fn escape_takes_a_drag_back_and_the_pointer_lets_go() {
    let mut hand = at(LEFT_ARM);
    let before = pose(&hand);
    let from = slider_center(&hand, ELBOW);
    hand.hover_at(from);
    hand.step();
    hand.drag_at(from);
    hand.step();
    hand.hover_at(from + vec2(40.0, 0.0));
    hand.step();
    assert_ne!(pose(&hand), before);
    hand.key_press(Key::Escape);
    hand.step();
    assert_eq!(pose(&hand), before);
    hand.hover_at(from + vec2(60.0, 0.0));
    hand.run();
    hand.drop_at(from + vec2(60.0, 0.0));
    hand.run();
    assert_eq!(pose(&hand), before);
    assert_eq!(steps(&hand), 0);
}

#[test]
fn a_double_click_sets_an_angle_to_zero() {
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 60.0);
    for _ in 0..2 {
        hand.get_by_role_and_label(Role::Slider, ELBOW).click();
        hand.step();
    }
    hand.run();
    assert_eq!(pose(&hand).angles(Bone::LeftLowerArm).flexion, 0.0);
    assert_eq!(steps(&hand), 2);
}

#[test]
fn a_typed_number_turns_a_joint_and_its_range_holds() {
    let mut hand = at(LEFT_ARM);
    for (typed, expected) in [("37.5", 37.5), ("-400", 0.0)] {
        hand.get_by_role_and_label(Role::SpinButton, ELBOW).click();
        hand.run();
        hand.event(egui::Event::Text(typed.to_owned()));
        hand.run();
        hand.key_press(Key::Enter);
        hand.run();
        assert_eq!(pose(&hand).angles(Bone::LeftLowerArm).flexion, expected, "{typed}");
    }
    assert!(hand.state().status().clamped);
    click(&mut hand, "Ranges");
    set(&mut hand, ELBOW, -20.0);
    assert_eq!(pose(&hand).angles(Bone::LeftLowerArm).flexion, -20.0);
}

#[test]
fn arrow_keys_go_on_where_the_hand_left_off() {
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 50.0);
    hand.get_by_role_and_label(Role::Slider, ELBOW).click();
    hand.run();
    hand.key_press(Key::ArrowRight);
    hand.run();
    hand.key_press_modifiers(Modifiers::SHIFT, Key::ArrowLeft);
    hand.run();
    assert_eq!(pose(&hand).angles(Bone::LeftLowerArm).flexion, 50.9);
}
