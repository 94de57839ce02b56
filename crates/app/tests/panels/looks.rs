//! The window as pictures.

use app::{Session, apply_theme, load};
use edit::{Command, Editor, Hold, Request};
use egui::{Pos2, vec2};
use egui_kittest::Harness;
use glam::DVec3;
use rig::{Bone, Dof, Limb, Space};

use crate::hand::{ELBOW, Hand, set, undo};

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
pub fn drawn(session: Session, figure: bool) -> Hand {
    use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};
    let state = create_render_state(default_wgpu_setup(), egui_wgpu::RendererOptions::PREDICTABLE);
    if figure {
        let gpu = render::Gpu::of_device(state.device.clone(), state.queue.clone(), state.adapter.get_info());
        let figure = session.editor().figure().clone();
        app::install_picture(
            &mut state.renderer.write(),
            &gpu,
            state.target_format,
            &app::Body::Figure(figure.clone()),
        )
        .unwrap();
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

#[test]
fn what_is_held_and_stands_still_asks_for_no_frames() {
    let mut session = bent();
    session.software = true;
    let mut hand = drawn(session, true);
    let empty = hand.state().viewport.rect().min + vec2(60.0, 60.0);
    let asked_for_in = |hand: &Hand| hand.output().viewport_output[&egui::ViewportId::ROOT].repaint_delay;
    hand.hover_at(empty);
    hand.step();
    hand.drag_at(empty);
    hand.step();
    hand.hover_at(empty + vec2(30.0, 0.0));
    for _ in 0..20 {
        hand.step();
    }
    assert_eq!(asked_for_in(&hand), std::time::Duration::MAX);
    hand.drop_at(empty + vec2(30.0, 0.0));
    hand.step();
    assert!(asked_for_in(&hand) < std::time::Duration::from_secs(1), "the picture in full follows");
}
