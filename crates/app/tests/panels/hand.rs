//! What the tests do with a window: find by label, set, click, drag.

use app::{Section, Session, apply_theme, load};
use edit::Editor;
use egui::accesskit::Role;
use egui::{Key, Modifiers, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use rig::{Limb, Part, Pose};

pub type Hand = Harness<'static, Session>;

/// A tall window on the figure at rest in which just one section is open.
pub fn at(section: Section) -> Hand {
    let figure = load::figure(None).unwrap();
    let mut session = Session::new(Editor::new(figure), None);
    for each in Section::ALL {
        session.panels.set_open(each, each == section);
    }
    shown(session, vec2(1280.0, 1400.0))
}

/// A window of that size on a session.
pub fn shown(session: Session, size: egui::Vec2) -> Hand {
    let mut hand = Harness::builder()
        .with_size(size)
        .with_pixels_per_point(1.0)
        .with_step_dt(0.05)
        .with_context_setup(apply_theme)
        .build_ui_state(|ui, session: &mut Session| session.ui(ui), session);
    hand.run();
    hand
}

pub fn pose(hand: &Hand) -> Pose {
    hand.state().editor().pose().clone()
}

pub fn steps(hand: &Hand) -> usize {
    hand.state().editor().undo_depth()
}

pub fn view(hand: &Hand, limb: Limb) -> rig::LimbView {
    hand.state().editor().evaluation().limbs[limb.index()]
}

pub fn set(hand: &mut Hand, label: &str, value: f64) {
    hand.get_by_role_and_label(Role::Slider, label).set_value_accesskit(value);
    hand.run();
}

pub fn set_number(hand: &mut Hand, label: &str, value: f64) {
    hand.get_by_role_and_label(Role::SpinButton, label).set_value_accesskit(value);
    hand.run();
}

pub fn click(hand: &mut Hand, label: &str) {
    hand.get_by_label(label).click();
    hand.run();
}

pub fn undo(hand: &mut Hand) {
    hand.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    hand.run();
}

/// Presses at a place, moves over others and lets go at the last, a frame each.
pub fn drag(hand: &mut Hand, from: Pos2, over: &[Pos2]) {
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

pub fn slider_center(hand: &Hand, label: &str) -> Pos2 {
    hand.get_by_role_and_label(Role::Slider, label).rect().center()
}

pub const ELBOW: &str = "Left elbow · flexion";

pub const LEFT_ARM: Section = Section::Body(Part::LeftArm);
