//! The window's controls, found by their labels and driven as a hand would, without a display.
#![allow(clippy::unwrap_used)]

use app::{Section, Session, apply_theme, labels, load};
use edit::{Command, Editor, Hold, Request};
use egui::accesskit::Role;
use egui::{Key, Modifiers, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use glam::DVec3;
use rig::{Bone, Contact, Dof, Limb, Part, Pose, Reacher, Side, Space};

type Hand = Harness<'static, Session>;

/// A tall window on the figure at rest in which just one section is open.
fn at(section: Section) -> Hand {
    let figure = load::figure(None).unwrap();
    let mut session = Session::new(Editor::new(figure), None);
    for each in Section::ALL {
        session.panels.set_open(each, each == section);
    }
    let mut hand = Harness::builder()
        .with_size(vec2(1280.0, 1400.0))
        .with_pixels_per_point(1.0)
        .with_step_dt(0.05)
        .with_context_setup(apply_theme)
        .build_ui_state(|ui, session: &mut Session| session.ui(ui), session);
    hand.run();
    hand
}

fn pose(hand: &Hand) -> Pose {
    hand.state().editor().pose().clone()
}

fn steps(hand: &Hand) -> usize {
    hand.state().editor().undo_depth()
}

fn view(hand: &Hand, limb: Limb) -> rig::LimbView {
    hand.state().editor().evaluation().limbs[limb.index()]
}

fn set(hand: &mut Hand, label: &str, value: f64) {
    hand.get_by_role_and_label(Role::Slider, label).set_value_accesskit(value);
    hand.run();
}

fn set_number(hand: &mut Hand, label: &str, value: f64) {
    hand.get_by_role_and_label(Role::SpinButton, label).set_value_accesskit(value);
    hand.run();
}

fn click(hand: &mut Hand, label: &str) {
    hand.get_by_label(label).click();
    hand.run();
}

fn undo(hand: &mut Hand) {
    hand.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    hand.run();
}

/// Presses at a place, moves over others and lets go at the last, a frame each.
fn drag(hand: &mut Hand, from: Pos2, over: &[Pos2]) {
    hand.hover_at(from);
    hand.step();
    hand.drag_at(from);
    hand.step();
    for place in over {
        hand.hover_at(*place);
        hand.step();
    }
    hand.drop_at(over.last().copied().unwrap_or(from));
    hand.run();
}

fn slider_center(hand: &Hand, label: &str) -> Pos2 {
    hand.get_by_role_and_label(Role::Slider, label).rect().center()
}

const ELBOW: &str = "Left elbow · flexion";
const LEFT_ARM: Section = Section::Body(Part::LeftArm);

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
    click(&mut hand, "Mirror");
    assert_eq!(pose(&hand).angles(Bone::LeftLowerArm).flexion, 70.0);
    assert_eq!(pose(&hand).angles(Bone::RightLowerArm).flexion, 0.0);
    click(&mut hand, "Reset");
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
    click(&mut hand, "View right");
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
fn a_pose_is_saved_and_opened_by_path_and_changes_are_asked_about() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bent.pose.ron");
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 42.0);
    assert!(hand.state().title().starts_with("• Unnamed pose"));
    hand.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    hand.run();
    hand.key_press_modifiers(Modifiers::COMMAND, Key::A);
    hand.event(egui::Event::Text(path.display().to_string()));
    hand.run();
    hand.key_press(Key::Enter);
    hand.run();
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains("leftLowerArm") && text.contains("42"), "{text}");
    assert_eq!(hand.state().title(), "bent.pose.ron – Posewright");
    let saved = pose(&hand);
    set(&mut hand, ELBOW, 90.0);
    assert!(hand.state().is_modified());
    hand.key_press_modifiers(Modifiers::COMMAND, Key::O);
    hand.run();
    click(&mut hand, "Don't save");
    hand.event(egui::Event::Text("bent.pose.ron".to_owned()));
    hand.run();
    hand.key_press(Key::Enter);
    hand.run();
    assert_eq!(pose(&hand), saved, "{:?}", hand.state().status());
    assert!(!hand.state().is_modified());
}

#[test]
fn a_file_that_is_no_pose_changes_nothing_and_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("bad.pose.ron");
    std::fs::write(&path, "(version: 1, joints: {\"leftKnee\": ()})").unwrap();
    let mut hand = at(LEFT_ARM);
    let before = pose(&hand);
    hand.state_mut().open_asking(path);
    hand.run();
    let status = hand.state().status();
    assert!(status.fault && status.message.contains("bad.pose.ron:1:"), "{status:?}");
    assert_eq!(pose(&hand), before);
}

#[test]
fn closing_asks_about_unsaved_changes() {
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 42.0);
    hand.state_mut().quit_asking();
    hand.run();
    assert!(!hand.state().has_quit());
    click(&mut hand, "Cancel");
    assert!(!hand.state().has_quit());
    hand.state_mut().quit_asking();
    hand.run();
    click(&mut hand, "Don't save");
    assert!(hand.state().has_quit());
}

#[test]
fn help_opens_and_closes() {
    let mut hand = at(LEFT_ARM);
    hand.key_press(Key::F1);
    hand.run();
    hand.get_by_label("Gestures and shortcuts");
    hand.key_press(Key::Escape);
    hand.run();
    assert!(hand.query_by_label("Gestures and shortcuts").is_none());
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

/// A bent and held arm, with its elbow chosen.
fn bent() -> Session {
    let mut session = Session::new(Editor::new(load::figure(None).unwrap()), None);
    let turn = |joint, dof, degrees| Command::Turn { joint, dof, degrees, by: edit::By::To };
    for command in [
        turn(Bone::LeftUpperArm, Dof::Abduction, -50.0),
        turn(Bone::LeftLowerArm, Dof::Flexion, 70.0),
        Command::Keep { limb: Limb::LeftArm, contact: Hold::Point, space: Space::World },
    ] {
        session.submit(Request::Do(command));
    }
    session.panels.select(Some(Bone::LeftLowerArm));
    session
}

/// A window of 1280 by 800 with a device; the figure is drawn if `figure`.
fn drawn(session: Session, figure: bool) -> Hand {
    use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};
    let state = create_render_state(default_wgpu_setup(), egui_wgpu::RendererOptions::PREDICTABLE);
    if figure {
        let gpu = render::Gpu::of_device(state.device.clone(), state.queue.clone(), state.adapter.get_info());
        let figure = session.editor().figure().clone();
        app::install_picture(&mut state.renderer.write(), &gpu, state.target_format, &figure).unwrap();
    }
    let mut hand = Harness::builder()
        .with_size(vec2(1280.0, 800.0))
        .with_pixels_per_point(1.0)
        .with_context_setup(apply_theme)
        .renderer(WgpuTestRenderer::from_render_state(state))
        .build_ui_state(|ui, session: &mut Session| session.ui(ui), session);
    hand.run();
    hand
}

/// The controls as a picture, without the figure, whose skin has pictures of its own.
#[test]
fn the_controls_look_as_they_did() {
    drawn(bent(), false).snapshot("controls");
}

#[test]
fn the_picture_follows_the_pose_and_comes_back_with_it() {
    let mut hand = drawn(bent(), true);
    let first = hand.render().unwrap();
    let place = hand.state().viewport.rect();
    let seen = |image: &image::RgbaImage, at: Pos2| *image.get_pixel(at.x as u32, at.y as u32);
    let chest = hand.state().editor().evaluation().frames[Bone::UpperChest].position;
    let on_chest = hand.state().viewport.window_of(chest - DVec3::Y * 0.07).unwrap();
    let (skin, air) = (seen(&first, on_chest), seen(&first, place.min + vec2(20.0, 20.0)));
    assert!(skin[0] > skin[2] + 20, "skin is warm: {skin:?}");
    assert_ne!(skin, air);
    set(&mut hand, ELBOW, 20.0);
    assert_ne!(first, hand.render().unwrap());
    undo(&mut hand);
    let again = hand.render().unwrap();
    let differ = |rect: egui::Rect| {
        let inside = |x: u32, y: u32| rect.contains(Pos2::new(x as f32 + 0.5, y as f32 + 0.5));
        first.enumerate_pixels().any(|(x, y, pixel)| inside(x, y) && pixel != again.get_pixel(x, y))
    };
    assert!(!differ(place), "undo brings the same picture back");
}

#[test]
fn a_software_adapter_draws_movement_lean_and_rest_in_full() {
    let mut session = bent();
    session.software = true;
    let mut hand = drawn(session, true);
    let empty = hand.state().viewport.rect().min + vec2(60.0, 60.0);
    hand.hover_at(empty);
    hand.step();
    hand.drag_at(empty);
    hand.step();
    hand.hover_at(empty + vec2(30.0, 0.0));
    hand.step();
    let moving = hand.render().unwrap();
    hand.drop_at(empty + vec2(30.0, 0.0));
    hand.run();
    let still = hand.render().unwrap();
    assert_ne!(moving, still, "the view is the same, the quality is not");
    hand.state_mut().software = false;
    hand.run();
    assert_eq!(hand.render().unwrap(), still);
}
