//! Looking around: presets, the ball of axes, the second view, the picture camera, the background image.

use app::{Section, Session, load};
use edit::{Editor, Preset};
use egui::{Event, Key, Modifiers, PointerButton, Pos2, Vec2, vec2};
use rig::{Bone, Camera, Projection, View};

use crate::hand::{Hand, at, click, drag, pose, steps};
use crate::looks::drawn;

fn camera(hand: &Hand) -> Camera {
    hand.state().viewport.camera
}

fn scroll(hand: &mut Hand, place: Pos2, delta: Vec2, modifiers: Modifiers) {
    hand.hover_at(place);
    hand.step();
    hand.event_modifiers(
        Event::MouseWheel {
            unit: egui::MouseWheelUnit::Point,
            delta,
            phase: egui::TouchPhase::Move,
            source: egui::MouseWheelSource::Trackpad,
            modifiers,
        },
        modifiers,
    );
    hand.run_steps(20);
}

/// Drags with a button and keys, a frame each.
fn drag_with(hand: &mut Hand, from: Pos2, by: Vec2, button: PointerButton, modifiers: Modifiers) {
    hand.hover_at(from);
    hand.step();
    let press = |pos, pressed| Event::PointerButton { pos, button, pressed, modifiers };
    hand.event_modifiers(press(from, true), modifiers);
    hand.step();
    for share in [0.5, 1.0] {
        hand.event_modifiers(Event::PointerMoved(from + by * share), modifiers);
        hand.step();
    }
    hand.event_modifiers(press(from + by, false), modifiers);
    hand.run();
}

/// A window whose settings say that preset.
fn with(preset: Preset) -> Hand {
    let mut hand = at(Section::Figure);
    hand.key_press_modifiers(Modifiers::COMMAND, Key::Comma);
    hand.run();
    for label in ["Navigation", preset.name(), "Close"] {
        click(&mut hand, label);
    }
    assert_eq!(hand.state().viewport.preset, preset);
    hand
}

fn chest(hand: &Hand) -> Pos2 {
    let chest = hand.state().editor().evaluation().frames[Bone::UpperChest].position;
    hand.state().viewport.window_of(chest).unwrap()
}

#[test]
fn each_preset_s_drags_move_the_view_over_the_figure_and_not_the_figure() {
    use PointerButton::{Middle, Primary, Secondary};
    let cases = [
        (Preset::Blender, Middle, Modifiers::NONE, [true, false, false]),
        (Preset::Blender, Middle, Modifiers::SHIFT, [false, true, false]),
        (Preset::Blender, Middle, Modifiers::COMMAND, [false, true, true]),
        (Preset::Maya, Primary, Modifiers::ALT, [true, false, false]),
        (Preset::Maya, Middle, Modifiers::ALT, [false, true, false]),
        (Preset::Maya, Secondary, Modifiers::ALT, [false, true, true]),
    ];
    for (preset, button, modifiers, [turns, slides, zooms]) in cases {
        let mut hand = with(preset);
        let (was, before, from) = (camera(&hand), pose(&hand), chest(&hand));
        drag_with(&mut hand, from + vec2(2.0, 9.0), vec2(60.0, -30.0), button, modifiers);
        let is = camera(&hand);
        let case = format!("{preset:?} {button:?} {modifiers:?}");
        assert_eq!((is.yaw_rad, is.pitch_rad) != (was.yaw_rad, was.pitch_rad), turns, "{case}");
        assert_eq!(is.target != was.target, slides, "{case}");
        assert_eq!(is.distance != was.distance, zooms, "{case}");
        assert_eq!((pose(&hand), steps(&hand)), (before, 0), "{case}");
    }
}

#[test]
fn two_fingers_turn_slide_and_zoom() {
    let mut hand = with(Preset::Trackpad);
    let place = chest(&hand);
    let was = camera(&hand);
    scroll(&mut hand, place, vec2(30.0, 20.0), Modifiers::NONE);
    let turned = camera(&hand);
    assert!(turned.yaw_rad < was.yaw_rad && turned.pitch_rad > was.pitch_rad);
    assert_eq!((turned.target, turned.distance), (was.target, was.distance));
    let point = turned.target.as_dvec3();
    let seen = hand.state().viewport.window_of(point).unwrap();
    scroll(&mut hand, place, vec2(30.0, 20.0), Modifiers::SHIFT);
    let slid = hand.state().viewport.window_of(point).unwrap() - seen;
    assert!((slid - vec2(30.0, 20.0)).length() < 0.5, "in both directions: {slid}");
    assert_eq!(camera(&hand).yaw_rad, turned.yaw_rad);
    scroll(&mut hand, place, vec2(0.0, 40.0), Modifiers::COMMAND);
    assert!(camera(&hand).distance < was.distance * 0.95);
    assert_eq!(camera(&hand).yaw_rad, turned.yaw_rad);
}

#[test]
fn an_end_of_the_axis_ball_looks_from_there_and_then_from_the_other_side() {
    let mut hand = at(Section::Figure);
    hand.state_mut().viewport.set_projection(Projection::Perspective);
    for (end, view, opposite) in [
        ("View from +X (left)", View::Left, View::Right),
        ("View from +Y (top)", View::Top, View::Bottom),
        ("View from -Z (back)", View::Back, View::Front),
    ] {
        click(&mut hand, end);
        assert!(camera(&hand).is_at(view), "{end}");
        click(&mut hand, end);
        assert!(camera(&hand).is_at(opposite), "{end}, again");
    }
    assert_eq!(camera(&hand).projection, Projection::Perspective, "a view forces no projection");
    let was = camera(&hand);
    let ball = hand.state().viewport.rect().right_top() + vec2(-56.0, 82.0);
    drag(&mut hand, ball, &[ball + vec2(-12.0, 0.0), ball + vec2(-40.0, 10.0)]);
    let is = camera(&hand);
    assert!(is.yaw_rad > was.yaw_rad && is.pitch_rad > was.pitch_rad && is.target == was.target);
    assert_eq!(steps(&hand), 0);
}

#[test]
fn the_second_view_shows_depth_poses_and_closes() {
    let mut hand = at(Section::Figure);
    hand.state_mut().viewport.view(View::Front);
    hand.state_mut().viewport.side_view = true;
    hand.run();
    let joint = |hand: &Hand| hand.state().editor().evaluation().frames[Bone::LeftHand].position;
    let before = joint(&hand);
    let camera_now = &mut hand.state_mut().viewport.camera;
    (camera_now.target, camera_now.distance) = (before.as_vec3(), 1.5);
    hand.run();
    let seen = hand.state().viewport.second_window_of(before).unwrap();
    let around = (0..48).map(|i| seen + (4.0 + (i / 12) as f32 * 4.0) * Vec2::angled(i as f32 * 0.5));
    let lit = around.into_iter().find(|place| {
        hand.hover_at(*place);
        hand.step();
        hand.state().viewport.hovered() == Some(Bone::LeftHand)
    });
    let (start, was) = (lit.unwrap(), camera(&hand));
    // From the figure's left its front is at the picture's left. An outstretched arm comes round.
    let by = vec2(-40.0, 25.0);
    drag(&mut hand, start, &[start + by * 0.3, start + by]);
    let after = joint(&hand);
    assert!(after.z > before.z + 0.05 && after.y < before.y - 0.03, "{before} {after}");
    assert_eq!((steps(&hand), camera(&hand)), (1, was), "the main view stays");
    let point = was.target.as_dvec3();
    let corner = hand.state().viewport.second_window_of(point).unwrap() + vec2(-60.0, -60.0);
    scroll(&mut hand, corner, vec2(0.0, 60.0), Modifiers::NONE);
    assert!(camera(&hand).distance < was.distance && camera(&hand).yaw_rad == was.yaw_rad);
    click(&mut hand, "Close the second view");
    assert!(!hand.state().viewport.side_view);
    assert_eq!(hand.state().viewport.second_window_of(point), None);
}

#[test]
fn the_picture_camera_stays_while_the_working_one_moves() {
    let mut hand = at(Section::Figure);
    let viewport = &mut hand.state_mut().viewport;
    viewport.view(View::Front);
    viewport.set_picture_camera();
    let taken = viewport.camera;
    viewport.view(View::Top);
    let working = viewport.camera;
    assert_eq!(viewport.camera_for_picture(), taken);
    viewport.toggle_picture_camera();
    hand.run();
    let viewport = &mut hand.state_mut().viewport;
    assert!(viewport.looks_through_picture_camera() && viewport.camera.is_at(View::Front));
    assert!(viewport.camera.fov_y_rad > taken.fov_y_rad, "the view is larger than the picture");
    viewport.toggle_picture_camera();
    assert_eq!((viewport.camera, viewport.looks_through_picture_camera()), (working, false));
    viewport.toggle_picture_camera();
    viewport.step(edit::Step::Right);
    assert!(!viewport.looks_through_picture_camera(), "moving the view leaves it");
    assert_eq!((viewport.camera.eye() - taken.eye()).y, 0.0, "and goes on from there");
    assert_eq!(viewport.camera.fov_y_rad, taken.fov_y_rad);
    assert_eq!(viewport.picture_camera, Some(taken));
}

#[test]
fn a_background_image_is_behind_the_figure_and_the_light_look_is_light() {
    let folder = std::env::temp_dir().join(format!("posewright views {}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("blue.png");
    image::RgbImage::from_pixel(90, 30, image::Rgb([20, 40, 220])).save(&path).unwrap();
    let mut hand = drawn(Session::new(Editor::new(load::figure(None).unwrap()), None), true);
    let seen =
        |hand: &mut Hand, place: Pos2| hand.render().unwrap().get_pixel(place.x as u32, place.y as u32).0;
    let chest = chest(&hand) + vec2(6.0, 12.0);
    let air = hand.state().viewport.rect().min + vec2(40.0, 60.0);
    let (skin, dark) = (seen(&mut hand, chest), seen(&mut hand, air));
    let backdrop = &mut hand.state_mut().viewport.backdrop;
    backdrop.open(&path).unwrap();
    backdrop.opacity = 1.0;
    hand.run();
    assert_eq!((seen(&mut hand, air), seen(&mut hand, chest)), ([20, 40, 220, 255], skin));
    hand.state_mut().viewport.backdrop.clear();
    hand.run();
    assert_eq!(seen(&mut hand, air), dark);
    hand.key_press_modifiers(Modifiers::COMMAND, Key::Comma);
    hand.run();
    for label in ["Light", "Close"] {
        click(&mut hand, label);
    }
    assert!(seen(&mut hand, air)[1] > dark[1] + 80, "{dark:?}");
    std::fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn a_window_without_room_breaks_nothing() {
    let mut hand = at(Section::Figure);
    hand.state_mut().viewport.side_view = true;
    hand.state_mut().viewport.toggle_picture_camera();
    hand.state_mut().panels.select(Some(Bone::LeftLowerArm));
    hand.run();
    let before = pose(&hand);
    for size in [vec2(1.0, 1.0), vec2(0.0, 0.0), vec2(345.0, 30.0), vec2(2000.0, 2.0)] {
        hand.set_size(size);
        hand.run();
        for key in [Key::F, Key::Home, Key::Num1, Key::Num0] {
            hand.key_press(key);
            hand.run();
        }
        let middle = hand.state().viewport.rect().center();
        drag(&mut hand, middle, &[middle + vec2(3.0, 2.0), middle + vec2(40.0, 1.0)]);
        let camera = camera(&hand);
        assert!(camera.target.is_finite() && camera.distance.is_finite() && camera.distance > 0.0, "{size}");
        assert!(camera.yaw_rad.is_finite() && camera.pitch_rad.is_finite(), "{size}: {camera:?}");
    }
    hand.set_size(vec2(1280.0, 1400.0));
    hand.run();
    hand.key_press(Key::Home);
    hand.run();
    let head = hand.state().editor().evaluation().frames[Bone::Head].position;
    let seen = hand.state().viewport.window_of(head).unwrap();
    assert!(hand.state().viewport.rect().contains(seen), "{seen}");
    assert_eq!(pose(&hand), before);
}
