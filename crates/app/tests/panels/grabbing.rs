//! The pointer on the figure's skin: lighting up, grabbing, holding to an axis, taking back.

use app::Section;
use edit::Request;
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2, vec2};
use glam::DVec3;
use rig::{Bone, Contact, Limb, Projection, Reacher, View, parse_pose};

use crate::hand::{Hand, at, drag, pose, steps, undo, view};

const READY: &str = r#"(version: 1, joints: {
    "leftUpperArm": (flexion: 35.0, abduction: -30.0), "leftLowerArm": (flexion: 70.0, twist: -70.0),
    "rightUpperArm": (flexion: 35.0, abduction: -50.0), "rightLowerArm": (flexion: 80.0, twist: -70.0),
})"#;

/// The figure with bent arms, from near enough that a hand is larger than its marks.
fn ready() -> Hand {
    let mut hand = at(Section::Figure);
    let patch = parse_pose(READY).unwrap();
    let session = hand.state_mut();
    let pose = patch.onto(session.editor().pose());
    session.submit(Request::Open(Box::new(pose)));
    look_at(&mut hand, Bone::LeftHand, 1.2);
    hand
}

pub fn look_at(hand: &mut Hand, bone: Bone, distance: f32) {
    let place = hand.state().editor().evaluation().frames[bone].position;
    let camera = &mut hand.state_mut().viewport.camera;
    camera.target = place.as_vec3();
    camera.distance = distance;
    hand.run();
}

fn hover(hand: &mut Hand, place: Pos2) -> Option<Bone> {
    hand.hover_at(place);
    hand.step();
    hand.state().viewport.hovered()
}

/// Where a bone's skin is in the window, away from every target: found by moving the pointer about its joint.
pub fn skin_of(hand: &mut Hand, bone: Bone) -> Pos2 {
    let viewport = &hand.state().viewport;
    let place = |point| viewport.window_of(point).unwrap();
    let joint = place(hand.state().editor().evaluation().frames[bone].position);
    let targets = Limb::ALL.map(|limb| place(view(hand, limb).target));
    let around = (1..7).flat_map(|ring| (0..16).map(move |i| (ring as f32 * 13.0, i as f32 / 16.0)));
    let spots = around.map(|(radius, turn)| joint + radius * Vec2::angled(turn * std::f32::consts::TAU));
    let far: Vec<Pos2> = spots.filter(|spot| targets.iter().all(|t| t.distance(*spot) > 14.0)).collect();
    let found = far.into_iter().find(|spot| hover(hand, *spot) == Some(bone));
    found.unwrap_or_else(|| panic!("no skin of {bone} about {joint}"))
}

/// The point of the left hand that was grabbed, world: it is what the arm reaches with.
fn grabbed(hand: &Hand) -> DVec3 {
    let Reacher::Point(bone, point) = pose(hand).limb(Limb::LeftArm).reacher else {
        panic!("the arm reaches with {:?}", pose(hand).limb(Limb::LeftArm).reacher);
    };
    hand.state().editor().evaluation().frames[bone].point(point)
}

/// Presses on the left hand's skin and moves without letting go.
fn hold(hand: &mut Hand, by: &[Vec2]) -> Pos2 {
    let start = skin_of(hand, Bone::LeftHand);
    hand.drag_at(start);
    hand.step();
    for shift in by {
        hover(hand, start + *shift);
    }
    start
}

fn let_go(hand: &mut Hand, place: Pos2) {
    hand.drop_at(place);
    hand.run();
}

fn button(hand: &mut Hand, pos: Pos2, button: PointerButton, pressed: bool) {
    hand.event(Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE });
    hand.step();
}

#[test]
fn the_skin_under_the_pointer_lights_up() {
    let mut hand = ready();
    let on_hand = skin_of(&mut hand, Bone::LeftHand);
    let on_forearm = skin_of(&mut hand, Bone::LeftLowerArm);
    assert_eq!(hover(&mut hand, on_hand), Some(Bone::LeftHand));
    assert_eq!(hover(&mut hand, on_forearm), Some(Bone::LeftLowerArm));
    let empty = hand.state().viewport.rect().min + vec2(10.0, 10.0);
    assert_eq!(hover(&mut hand, empty), None);
    let target = hand.state().viewport.window_of(view(&hand, Limb::LeftArm).target).unwrap();
    assert_eq!(hover(&mut hand, target), None, "a drag from here takes the target");
    hand.state_mut().viewport.marks = false;
    assert!(hover(&mut hand, target + vec2(1.0, 0.0)).is_some(), "targets that don't show take nothing");
    assert_eq!(steps(&hand), 1, "nothing but the opened pose");
}

#[test]
fn a_grabbed_hand_stays_under_the_pointer() {
    for projection in [Projection::Perspective, Projection::Orthographic] {
        let mut hand = ready();
        hand.state_mut().viewport.set_projection(projection);
        hand.run();
        let (before, depth) = (pose(&hand), steps(&hand));
        let start = hold(&mut hand, &[]);
        for shift in [vec2(-20.0, 8.0), vec2(-50.0, 35.0), vec2(30.0, -60.0), vec2(-40.0, -20.0)] {
            hover(&mut hand, start + shift);
            let place = hand.state().viewport.window_of(grabbed(&hand)).unwrap();
            let off = place - start - shift;
            assert!(off.length() < 1.0, "{projection:?}: off by {off} at {shift}");
            assert_eq!(hand.state().viewport.hovered(), Some(Bone::LeftHand), "it stays lit");
        }
        assert!(hand.state().viewport.telling().unwrap().starts_with("Left arm reaches"));
        let_go(&mut hand, start + vec2(-40.0, -20.0));
        assert_eq!(steps(&hand), depth + 1, "one drag, one step");
        assert_eq!(pose(&hand).limb(Limb::LeftArm).contact, Contact::Free);
        assert_eq!(hand.state().viewport.telling(), None);
        undo(&mut hand);
        assert_eq!(pose(&hand), before);
    }
}

#[test]
fn escape_and_the_right_button_take_a_grab_back_bit_for_bit() {
    for escape in [true, false] {
        let mut hand = ready();
        let (before, depth) = (pose(&hand), steps(&hand));
        let start = hold(&mut hand, &[vec2(-20.0, 8.0), vec2(-40.0, 30.0)]);
        assert_ne!(pose(&hand), before);
        let place = start + vec2(-40.0, 30.0);
        if escape {
            hand.key_press(Key::Escape);
            hand.step();
        } else {
            button(&mut hand, place, PointerButton::Secondary, true);
        }
        assert_eq!(pose(&hand), before, "escape: {escape}");
        hover(&mut hand, start + vec2(-60.0, 40.0));
        if !escape {
            button(&mut hand, place, PointerButton::Secondary, false);
            hover(&mut hand, start + vec2(-30.0, 40.0));
        }
        assert_eq!(pose(&hand), before, "the drag is over though the button is down");
        let_go(&mut hand, start + vec2(-60.0, 40.0));
        assert_eq!((pose(&hand), steps(&hand)), (before, depth));
    }
}

#[test]
fn undo_amid_a_grab_takes_it_back_and_ends_it() {
    let mut hand = ready();
    let (before, depth) = (pose(&hand), steps(&hand));
    let start = hold(&mut hand, &[vec2(-20.0, 8.0), vec2(-40.0, 30.0)]);
    hand.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    hand.step();
    hover(&mut hand, start + vec2(-60.0, 40.0));
    hover(&mut hand, start + vec2(-62.0, 40.0));
    let_go(&mut hand, start + vec2(-62.0, 40.0));
    assert_eq!((pose(&hand), steps(&hand)), (before, depth));
}

#[test]
fn an_axis_key_keeps_the_other_two_and_a_second_press_frees() {
    let mut hand = ready();
    let start = hold(&mut hand, &[vec2(-1.0, 0.0), vec2(-20.0, 8.0)]);
    let telling = |hand: &Hand| hand.state().viewport.telling().unwrap();
    hand.key_press(Key::X);
    hand.step();
    assert!(telling(&hand).starts_with("Left arm reaches along X"), "{}", telling(&hand));
    let first = grabbed(&hand);
    hover(&mut hand, start + vec2(-50.0, 30.0));
    let moved = grabbed(&hand) - first;
    assert!(moved.x.abs() > 0.01 && moved.y.abs() < 1e-9 && moved.z.abs() < 1e-9, "{moved}");
    hand.key_press_modifiers(Modifiers::SHIFT, Key::Y);
    hand.step();
    assert!(telling(&hand).contains("in the plane across Y"), "{}", telling(&hand));
    hover(&mut hand, start + vec2(-40.0, 6.0));
    let moved = grabbed(&hand) - first;
    assert!(moved.y.abs() < 1e-9 && moved.length() > 0.01, "{moved}");
    hand.key_press_modifiers(Modifiers::SHIFT, Key::Y);
    hand.step();
    hover(&mut hand, start + vec2(-40.0, 30.0));
    assert!((grabbed(&hand) - first).y.abs() > 0.005);
    assert!(telling(&hand).starts_with("Left arm reaches · X Y Z"), "{}", telling(&hand));
    let_go(&mut hand, start + vec2(-40.0, 30.0));
}

#[test]
fn shift_slows_and_control_steps() {
    let mut hand = ready();
    let start = hold(&mut hand, &[vec2(-20.0, 0.0)]);
    let place = |hand: &Hand| hand.state().viewport.window_of(grabbed(hand)).unwrap();
    let before = place(&hand);
    hand.event_modifiers(Event::PointerMoved(start + vec2(-20.0, 50.0)), Modifiers::SHIFT);
    hand.step();
    let moved = place(&hand) - before;
    assert!((moved - vec2(0.0, 5.0)).length() < 0.1, "a tenth of the way: {moved}");
    hover(&mut hand, start + vec2(-20.0, 40.0));
    let moved = place(&hand) - before;
    assert!((moved - vec2(0.0, -5.0)).length() < 0.1, "it goes on from there: {moved}");
    let_go(&mut hand, start + vec2(-20.0, 40.0));

    let mut hand = ready();
    let start = skin_of(&mut hand, Bone::LeftHand);
    hand.drag_at(start);
    hand.step();
    hover(&mut hand, start + vec2(-20.0, 0.0));
    let Reacher::Point(bone, point) = pose(&hand).limb(Limb::LeftArm).reacher else { panic!("not grabbed") };
    hover(&mut hand, start);
    let first = hand.state().editor().evaluation().frames[bone].point(point);
    // Along an axis there is no surface to come to lie on.
    hand.key_press(Key::X);
    hand.event(Event::ModifiersChanged(Modifiers::COMMAND));
    hover(&mut hand, start + vec2(-43.0, 31.0));
    let steps = (grabbed(&hand) - first) * 100.0;
    assert!((steps - steps.round()).length() < 1e-3 && steps.length() >= 1.0, "{steps}");
    let_go(&mut hand, start + vec2(-43.0, 31.0));
}

#[test]
fn a_click_on_the_skin_chooses_its_bone_and_moves_nothing() {
    let mut hand = ready();
    look_at(&mut hand, Bone::LeftLowerArm, 0.8);
    let (before, place) = (pose(&hand), skin_of(&mut hand, Bone::LeftUpperArm));
    hand.state_mut().viewport.marks = false;
    drag(&mut hand, place, &[]);
    assert_eq!(hand.state().panels.selected(), Some(Bone::LeftUpperArm));
    assert_eq!((pose(&hand), steps(&hand)), (before, 1));
}

#[test]
fn a_drag_from_a_joint_s_disc_takes_the_skin_and_one_beside_the_figure_the_view() {
    let mut hand = ready();
    hand.state_mut().viewport.view(View::Front);
    look_at(&mut hand, Bone::Chest, 3.0);
    let chest =
        hand.state().viewport.window_of(hand.state().editor().evaluation().frames[Bone::Chest].position);
    let (chest, camera, depth) = (chest.unwrap(), hand.state().viewport.camera, steps(&hand));
    drag(&mut hand, chest, &[chest + vec2(12.0, 0.0), chest + vec2(25.0, 3.0)]);
    assert_eq!(steps(&hand), depth + 1);
    assert_eq!(hand.state().editor().undo_name(), Some("Aim spine"));
    assert_eq!(hand.state().viewport.camera, camera);
    let space = hand.state().viewport.rect().min + vec2(40.0, 40.0);
    let before = pose(&hand);
    drag(&mut hand, space, &[space + vec2(30.0, 10.0)]);
    assert_eq!(pose(&hand), before);
    assert_ne!(hand.state().viewport.camera, camera);
}
