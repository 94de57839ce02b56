//! The body's presets and sliders, and the figure saved with them.

use app::Section;
use egui::{Key, Modifiers, vec2};
use egui_kittest::kittest::Queryable as _;
use rig::{Body, BodySlider, Bone, Limb};

use crate::hand::{Hand, at, click, drag, pose, set, set_number, slider_center, steps, undo};

/// A window on the mannequin with the body's sliders open.
fn open() -> Hand {
    let mut hand = at(Section::Figure);
    hand.state_mut().figure_from("library:mannequin.figure.ron".into());
    click(&mut hand, "Body");
    hand
}

fn body(hand: &Hand) -> Body {
    hand.state().document().body
}

fn hips(hand: &Hand) -> f64 {
    hand.state().editor().figure().skeleton.rest_position(Bone::Hips).y
}

#[test]
fn sliders_make_the_body_over_and_undo_brings_it_back() {
    let mut hand = open();
    let (before, height) = (pose(&hand), hips(&hand));
    set(&mut hand, "Body stature", 120.0);
    assert_eq!(body(&hand).given(BodySlider::Stature), Some(1.2));
    assert!((hips(&hand) / height - 1.2 / 1.72).abs() < 0.01, "{}", hips(&hand));
    set_number(&mut hand, "Body heads", 6.0);
    set(&mut hand, "Body legs", 90.0);
    assert_eq!(steps(&hand), 3);
    assert_eq!(body(&hand).given(BodySlider::Legs), Some(0.9));
    for _ in 0..3 {
        undo(&mut hand);
    }
    assert_eq!((pose(&hand), body(&hand), hips(&hand)), (before, Body::AS_IS, height));
}

#[test]
fn a_drag_of_a_body_slider_is_one_step_and_escape_takes_it_back() {
    let mut hand = open();
    let before = pose(&hand);
    let from = slider_center(&hand, "Body arms");
    drag(&mut hand, from, &[from + vec2(10.0, 0.0), from + vec2(25.0, 0.0), from + vec2(-30.0, 0.0)]);
    assert_eq!(steps(&hand), 1);
    assert!(body(&hand).given(BodySlider::Arms).unwrap() < 1.0);
    undo(&mut hand);
    assert_eq!((pose(&hand), body(&hand)), (before, Body::AS_IS));
    hand.drag_at(from);
    hand.step();
    hand.hover_at(from + vec2(40.0, 0.0));
    hand.step();
    assert_ne!(body(&hand), Body::AS_IS);
    hand.key_press(Key::Escape);
    hand.step();
    hand.drop_at(from);
    hand.run();
    assert_eq!((steps(&hand), body(&hand)), (0, Body::AS_IS));
}

#[test]
fn a_preset_sets_every_slider_and_feet_stay_on_the_ground() {
    let mut hand = open();
    click(&mut hand, "Body preset");
    click(&mut hand, "Child");
    assert_eq!(body(&hand).given(BodySlider::Stature), Some(1.2));
    assert!(hand.get_by_label("Body preset").value().is_some_and(|v| v.contains("Child")));
    let editor = hand.state().editor();
    let ankle = editor.evaluation().frames[Bone::LeftFoot].position.y;
    let rest = editor.figure().skeleton.rest_position(Bone::LeftFoot).y;
    assert!((ankle - rest).abs() < 1e-3, "{ankle}");
    assert!(editor.evaluation().limbs[Limb::LeftLeg.index()].residual < 1e-3);
    click(&mut hand, "Reset the body");
    assert_eq!((body(&hand), steps(&hand)), (Body::AS_IS, 2));
}

#[test]
fn the_figure_is_saved_with_its_body() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("tall.figure.ron");
    let mut hand = open();
    set(&mut hand, "Body stature", 195.0);
    set(&mut hand, "Body legs", 104.0);
    click(&mut hand, "Save figure as…");
    hand.key_press_modifiers(Modifiers::COMMAND, Key::A);
    hand.event(egui::Event::Text(path.display().to_string()));
    hand.run();
    click(&mut hand, "Save the figure now");
    let figure = app::load::figure(Some(&path)).unwrap();
    assert_eq!(figure.name, "tall");
    assert_eq!(figure.skeleton, hand.state().editor().figure().skeleton);
    assert!(hand.state().status().message.contains("tall.figure.ron"), "{:?}", hand.state().status());
}

#[test]
fn a_figure_from_nowhere_says_why_its_body_stays() {
    let mut hand = at(Section::Figure);
    click(&mut hand, "Body");
    hand.get_by_label_contains("not known which file");
}

#[test]
fn the_picture_shows_the_new_body() {
    let mut session = app::Session::new(edit::Editor::new(app::load::figure(None).unwrap()), None);
    session.figure_from("library:mannequin.figure.ron".into());
    for each in Section::ALL {
        session.panels.set_open(each, each == Section::Figure);
    }
    let mut hand = crate::looks::drawn(session, true);
    click(&mut hand, "Body");
    let head = hand.state().editor().evaluation().frames[Bone::Head].position;
    let at = hand.state().viewport.window_of(head + glam::DVec3::Y * 0.12).unwrap();
    let seen = |hand: &mut Hand| *hand.render().unwrap().get_pixel(at.x as u32, at.y as u32);
    let skin = seen(&mut hand);
    set(&mut hand, "Body stature", 120.0);
    let air = seen(&mut hand);
    assert!(skin.0[0] > air.0[0].saturating_add(60), "{skin:?} before, {air:?} after");
    undo(&mut hand);
    assert_eq!(seen(&mut hand), skin);
}
