//! Rings, arcs and handles in the picture, with the pointer and keys of a window.

use app::Section;
use edit::Request;
use egui::{Event, Key, Modifiers, Pos2, vec2};
use rig::{Bone, Contact, Limb, View, parse_pose};

use crate::hand::{Hand, at, drag, pose, steps, undo, view};

const READY: &str = r#"(version: 1, joints: {
    "leftUpperArm": (flexion: 35.0, abduction: -30.0), "leftLowerArm": (flexion: 70.0, twist: -70.0),
    "rightUpperArm": (flexion: 35.0, abduction: -50.0), "rightLowerArm": (flexion: 80.0, twist: -70.0),
})"#;

/// The figure with bent arms and a chosen joint, seen from the front left.
fn choosing(bone: Bone) -> Hand {
    let mut hand = at(Section::Figure);
    let patch = parse_pose(READY).unwrap();
    let session = hand.state_mut();
    let pose = patch.onto(session.editor().pose());
    session.submit(Request::Open(Box::new(pose)));
    session.viewport.view(View::ThreeQuarter);
    session.panels.select(Some(bone));
    hand.run();
    hand
}

fn handles(hand: &Hand) -> Vec<(String, Pos2)> {
    let session = hand.state();
    session.viewport.handle_places(session.editor(), session.panels.selected())
}

fn place_of(hand: &Hand, name: &str) -> Pos2 {
    let all = handles(hand);
    let found = all.iter().find(|(other, _)| other == name);
    found.unwrap_or_else(|| panic!("no handle \"{name}\" among {all:?}")).1
}

fn key(hand: &mut Hand, key: Key, pressed: bool) {
    let modifiers = Modifiers::NONE;
    hand.event(Event::Key { key, physical_key: None, pressed, repeat: false, modifiers });
    hand.step();
}

fn hold(hand: &mut Hand, from: Pos2, to: Pos2) {
    hand.hover_at(from);
    hand.step();
    hand.drag_at(from);
    hand.step();
    for share in [0.3, 0.6, 1.0] {
        hand.hover_at(from + (to - from) * share);
        hand.step();
    }
}

#[test]
fn a_ring_turns_its_joint_in_one_step_and_keeps_the_choice() {
    let mut hand = choosing(Bone::LeftLowerArm);
    let (before, depth) = (pose(&hand), steps(&hand));
    let ring = place_of(&hand, "turn leftLowerArm flexion");
    drag(&mut hand, ring, &[ring + vec2(12.0, -9.0), ring + vec2(25.0, -18.0)]);
    let after = pose(&hand);
    assert_ne!(after.angles(Bone::LeftLowerArm).flexion, before.angles(Bone::LeftLowerArm).flexion);
    assert_eq!(after.angles(Bone::LeftUpperArm), before.angles(Bone::LeftUpperArm));
    assert_eq!(steps(&hand), depth + 1);
    assert_eq!(hand.state().panels.selected(), Some(Bone::LeftLowerArm));
    undo(&mut hand);
    assert_eq!(pose(&hand), before);
}

#[test]
fn numbers_typed_on_a_ring_are_degrees_and_change_no_view() {
    let mut hand = choosing(Bone::LeftLowerArm);
    let camera = hand.state().viewport.camera;
    let ring = place_of(&hand, "turn leftLowerArm flexion");
    hold(&mut hand, ring, ring + vec2(14.0, -10.0));
    for (letter, pressed) in [("1", Key::Num1), ("3", Key::Num3)] {
        hand.event(Event::Text(letter.to_owned()));
        key(&mut hand, pressed, true);
        key(&mut hand, pressed, false);
    }
    let flexion = pose(&hand).angles(Bone::LeftLowerArm).flexion;
    assert!((flexion - 83.0).abs() < 1e-9, "{flexion}");
    assert!(hand.state().viewport.telling().unwrap().contains("by 13°"));
    assert_eq!(hand.state().viewport.camera, camera);
    key(&mut hand, Key::Backspace, true);
    key(&mut hand, Key::Enter, true);
    hand.drop_at(ring);
    hand.run();
    assert!((pose(&hand).angles(Bone::LeftLowerArm).flexion - 71.0).abs() < 1e-9);
}

#[test]
fn the_wheel_and_views_leave_the_camera_while_the_figure_is_held() {
    let mut hand = choosing(Bone::LeftLowerArm);
    let ring = place_of(&hand, "turn leftLowerArm flexion");
    hold(&mut hand, ring, ring + vec2(14.0, -10.0));
    let (camera, held) = (hand.state().viewport.camera, pose(&hand));
    hand.state_mut().viewport.view(View::Back);
    hand.step();
    hand.step();
    assert_eq!(hand.state().viewport.camera, camera);
    assert_eq!(pose(&hand), held);
    key(&mut hand, Key::Escape, true);
    hand.drop_at(ring);
    hand.run();
    assert_eq!(pose(&hand).angles(Bone::LeftLowerArm).flexion, 70.0);
}

#[test]
fn with_c_held_a_ring_of_the_hand_turns_about_the_palm() {
    let mut hand = choosing(Bone::LeftHand);
    assert!(handles(&hand).iter().any(|(name, _)| name == "turn leftHand flexion"));
    key(&mut hand, Key::C, true);
    let ring = place_of(&hand, "turn leftArm in contact flexion");
    let (palm, before) = (view(&hand, Limb::LeftArm).articulator, pose(&hand));
    hold(&mut hand, ring, ring + vec2(10.0, -12.0));
    assert!(view(&hand, Limb::LeftArm).articulator.distance(palm) < 1e-9);
    assert_ne!(pose(&hand).angles(Bone::LeftHand), before.angles(Bone::LeftHand));
    assert_ne!(pose(&hand).angles(Bone::LeftUpperArm), before.angles(Bone::LeftUpperArm));
    hand.drop_at(ring + vec2(10.0, -12.0));
    key(&mut hand, Key::C, false);
    hand.run();
    assert!(handles(&hand).iter().any(|(name, _)| name == "turn leftHand flexion"));
}

#[test]
fn the_ground_handle_places_the_figure_and_a_target_holds_on_to_what_it_is_dropped_on() {
    let mut hand = choosing(Bone::Head);
    let place = place_of(&hand, "place");
    drag(&mut hand, place, &[place + vec2(20.0, 4.0), place + vec2(60.0, 10.0)]);
    let placed = pose(&hand).place;
    assert!(placed.position.length() > 0.05 && placed.position.y == 0.0, "{placed:?}");
    undo(&mut hand);
    hand.state_mut().viewport.view(View::Front);
    hand.run();
    let frames = hand.state().editor().evaluation().frames;
    let window = |hand: &Hand, point| hand.state().viewport.window_of(point).unwrap();
    let target = window(&hand, view(&hand, Limb::LeftArm).target);
    let chest = window(&hand, frames[Bone::Chest].position) + vec2(8.0, 5.0);
    drag(&mut hand, target, &[target + (chest - target) * 0.5, chest]);
    let contact = pose(&hand).limb(Limb::LeftArm).contact;
    assert!(matches!(contact, Contact::Point { space: rig::Space::Body(_), .. }), "{contact:?}");
}

#[test]
fn a_key_that_comes_with_the_end_of_a_drag_is_not_lost() {
    let mut hand = choosing(Bone::LeftLowerArm);
    let ring = place_of(&hand, "turn leftLowerArm flexion");
    let end = ring + vec2(14.0, 10.0);
    hold(&mut hand, ring, end);
    let (turned, depth) = (pose(&hand), steps(&hand));
    let modifiers = Modifiers::NONE;
    let up =
        Event::PointerButton { pos: end, button: egui::PointerButton::Primary, pressed: false, modifiers };
    let tab = Event::Key { key: Key::Tab, physical_key: None, pressed: true, repeat: false, modifiers };
    hand.input_mut().events.extend([up, tab]);
    hand.step();
    hand.run();
    assert_eq!(hand.state().panels.selected(), Some(Bone::LeftHand));
    assert_eq!((pose(&hand), steps(&hand)), (turned, depth + 1), "the drag is kept as one step");
}

#[test]
fn a_digit_while_the_button_is_down_on_the_figure_is_for_the_drag_and_not_for_the_view() {
    let mut hand = choosing(Bone::LeftLowerArm);
    let camera = hand.state().viewport.camera;
    let ring = place_of(&hand, "turn leftLowerArm flexion");
    hand.hover_at(ring);
    hand.step();
    hand.drag_at(ring);
    hand.step();
    let before = pose(&hand).angles(Bone::LeftLowerArm).flexion;
    key(&mut hand, Key::Num1, true);
    key(&mut hand, Key::Num1, false);
    assert_eq!(hand.state().viewport.camera, camera, "1 is the view from the front otherwise");
    hand.event(Event::Text("1".to_owned()));
    hand.step();
    assert!((pose(&hand).angles(Bone::LeftLowerArm).flexion - before - 1.0).abs() < 1e-6);
    key(&mut hand, Key::Escape, true);
    key(&mut hand, Key::Num1, true);
    key(&mut hand, Key::Num1, false);
    assert_eq!(hand.state().viewport.camera, camera, "the button is still down");
    hand.drop_at(ring);
    hand.run();
    key(&mut hand, Key::Num1, true);
    key(&mut hand, Key::Num1, false);
    assert_ne!(hand.state().viewport.camera, camera);
}

#[test]
fn a_whole_drag_within_one_frame_is_done_in_its_order() {
    let mut hand = choosing(Bone::LeftLowerArm);
    let depth = steps(&hand);
    let ring = place_of(&hand, "turn leftLowerArm flexion");
    hand.hover_at(ring);
    hand.run();
    let modifiers = Modifiers::NONE;
    let button =
        |pos, pressed| Event::PointerButton { pos, button: egui::PointerButton::Primary, pressed, modifiers };
    let drag = |from: Pos2, typed: &str| {
        let to = from + vec2(14.0, 10.0);
        let text = Event::Text(typed.to_owned());
        [button(from, true), Event::PointerMoved(to), text, button(to, false), Event::PointerMoved(from)]
    };
    // The second begins where the first has brought the arm.
    let both = [drag(ring, "-10"), drag(ring, "-20")].concat();
    hand.input_mut().events.extend(both);
    hand.step();
    hand.run();
    assert_eq!(steps(&hand), depth + 2);
    let flexion = |hand: &Hand| pose(hand).angles(Bone::LeftLowerArm).flexion.round();
    assert_eq!(flexion(&hand), 40.0);
    undo(&mut hand);
    assert_eq!(flexion(&hand), 60.0);
}
