//! The figure walks: the mode of the window, keys that steer, time, marks, the blend tree's file, and the pose that is taken.

use std::path::Path;

use app::{Action, GroundSource, Section, Session, load};
use edit::Editor;
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable as _;
use glam::DVec3;
use motion::{GroundKind, Sole, Soles};
use rig::Bone;

use crate::grabbing::{look_at, skin_of};
use crate::hand::{Hand, LEFT_ARM, at, click, drag, pose, set, set_number, steps, undo};

/// A window that walks, at so many frames a second. It repaints without end, so tests go frame by frame.
fn walking(rate: f32) -> Hand {
    let mut session = Session::new(Editor::new(load::figure(None).unwrap()), None);
    session.walk_mut().steer.alone = false;
    session.walk_mut().terrain.choice.source = GroundKind::Flat.into();
    let mut hand = Harness::builder()
        .with_size(vec2(1280.0, 1200.0))
        .with_pixels_per_point(1.0)
        .with_step_dt(1.0 / rate)
        .with_context_setup(app::apply_theme)
        .build_ui_state(|ui, session: &mut Session| session.ui(ui), session);
    hand.run();
    press(&mut hand, Modifiers::NONE, Key::F5);
    assert!(hand.state().is_walking() && hand.state().walk().fault().is_none());
    hand
}

/// A figure that walks by itself over the hills.
fn on_hills() -> Hand {
    let mut hand = walking(30.0);
    let walk = hand.state_mut().walk_mut();
    walk.terrain.choice.source = GroundKind::Hills.into();
    walk.steer.alone = true;
    hand
}

fn key(hand: &mut Hand, modifiers: Modifiers, key: Key, pressed: bool) {
    hand.event_modifiers(
        Event::Key { key, physical_key: None, pressed, repeat: false, modifiers },
        modifiers,
    );
    hand.step();
}

fn press(hand: &mut Hand, modifiers: Modifiers, which: Key) {
    key(hand, modifiers, which, true);
    key(hand, modifiers, which, false);
}

fn frames(hand: &mut Hand, count: usize) {
    (0..count).for_each(|_| hand.step());
}

fn act(hand: &mut Hand, action: Action) {
    let ctx = hand.ctx.clone();
    hand.state_mut().act(&ctx, action);
}

fn place(hand: &Hand) -> DVec3 {
    hand.state().walk().place().unwrap().position
}

#[test]
fn a_held_key_walks_the_figure_ahead_and_the_pose_stays_as_it_is() {
    let mut hand = walking(60.0);
    let before = pose(&hand);
    let start = place(&hand);
    key(&mut hand, Modifiers::NONE, Key::W, true);
    frames(&mut hand, 120);
    let ahead = place(&hand) - start;
    assert!(ahead.z > 1.0 && ahead.x.abs() < 0.1, "{ahead}");
    key(&mut hand, Modifiers::NONE, Key::W, false);
    frames(&mut hand, 120);
    let there = place(&hand);
    frames(&mut hand, 60);
    assert!(place(&hand).distance(there) < 0.01, "without a key it stands");
    assert_eq!((pose(&hand), steps(&hand)), (before, 0));
    let turn = hand.state().walk().place().unwrap().turn;
    key(&mut hand, Modifiers::NONE, Key::ArrowLeft, true);
    frames(&mut hand, 60);
    key(&mut hand, Modifiers::NONE, Key::ArrowLeft, false);
    let _ = turn;
    press(&mut hand, Modifiers::NONE, Key::F5);
    assert!(!hand.state().is_walking());
    hand.run();
    hand.get_by_role_and_label(Role::Canvas, "Figure");
}

#[test]
fn time_halts_goes_by_steps_and_slowly_and_begins_anew() {
    let mut hand = walking(60.0);
    click_now(&mut hand, "Walks by itself");
    frames(&mut hand, 60);
    assert!(place(&hand).z > 0.1, "it shows life at once");
    press(&mut hand, Modifiers::NONE, Key::Space);
    // Halted, the window comes to rest.
    hand.run();
    let before = hand.state().walk().clock.steps();
    press(&mut hand, Modifiers::SHIFT, Key::Space);
    assert_eq!(hand.state().walk().clock.steps(), before + 1);
    click_now(&mut hand, "Time at a tenth");
    click_now(&mut hand, "Play");
    let before = hand.state().walk().clock.steps();
    frames(&mut hand, 60);
    let slow = hand.state().walk().clock.steps() - before;
    assert!((11..=13).contains(&slow), "{slow}");
    click_now(&mut hand, "Restart");
    assert!(place(&hand).length() < 0.02);
}

fn click_now(hand: &mut Hand, label: &str) {
    hand.get_by_label(label).click();
    frames(hand, 2);
}

#[test]
fn the_rate_of_frames_does_not_matter() {
    let run = |rate: f32, count: usize| {
        let mut hand = walking(rate);
        press(&mut hand, Modifiers::NONE, Key::Space);
        act(&mut hand, Action::WalkRestart);
        hand.state_mut().walk_mut().steer.alone = true;
        hand.state_mut().walk_mut().clock.playing = true;
        let from = hand.state().walk().clock.steps();
        frames(&mut hand, count);
        (hand.state().walk().clock.steps() - from, hand.state().walk().place().unwrap())
    };
    let first = run(30.0, 60);
    for (rate, count) in [(60.0, 120), (20.0, 40)] {
        let other = run(rate, count);
        // A frame's length is a number of single precision.
        assert!(other.0.abs_diff(first.0) <= 1, "{rate}: {} {}", other.0, first.0);
        let steps_apart = other.0.abs_diff(first.0) as f64;
        assert!(other.1.position.distance(first.1.position) <= 0.02 * steps_apart + 1e-12, "{rate}");
    }
}

#[test]
fn the_pose_is_taken_as_one_step_and_undo_brings_the_former_back() {
    let mut hand = walking(60.0);
    let before = pose(&hand);
    hand.state_mut().walk_mut().steer.alone = true;
    frames(&mut hand, 100);
    click_now(&mut hand, "Take this pose");
    hand.run();
    assert!(!hand.state().is_walking());
    let taken = pose(&hand);
    assert!(taken.angles != before.angles && steps(&hand) == 1);
    assert_eq!(taken.place, before.place, "on level ground the figure stays where it stands");
    hand.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    hand.run();
    assert_eq!(pose(&hand), before, "to the very bits");
}

#[test]
fn side_by_side_shows_two_pictures_and_marks_are_switched() {
    let mut hand = on_hills();
    frames(&mut hand, 2);
    click_now(&mut hand, "Side by side");
    for mark in app::Mark::ALL {
        if !hand.state().walk().marks.has(mark) {
            click_now(&mut hand, mark.words());
        }
        assert!(hand.state().walk().marks.has(mark));
    }
    frames(&mut hand, 60);
    assert!(hand.state().walk().beside);
    click_now(&mut hand, "Side by side");
    press(&mut hand, Modifiers::NONE, Key::O);
    assert!(!hand.state().walk().is_placed());
}

#[test]
fn another_ground_and_another_seed_are_chosen_in_the_panel() {
    let mut hand = walking(30.0);
    let flat = hand.state().walk().ground().clone();
    click_now(&mut hand, "Ground");
    click_now(&mut hand, "Hills");
    frames(&mut hand, 2);
    let hills = hand.state().walk().ground().clone();
    assert_ne!(hills, flat);
    click_now(&mut hand, "Another");
    frames(&mut hand, 2);
    assert_ne!(*hand.state().walk().ground(), hills);
    hand.get_by_role_and_label(Role::Slider, "Steepest place of the hills").set_value_accesskit(10.0);
    frames(&mut hand, 2);
    assert_eq!(hand.state().walk().terrain.choice.steepest_deg, 10.0);
    hand.get_by_role_and_label(Role::Slider, "Walking speed").set_value_accesskit(2.0);
    frames(&mut hand, 2);
    assert_eq!(hand.state().walk().steer.speed, 2.0);
}

fn save(path: &Path, text: &str, later: u64) {
    std::fs::write(path, text).unwrap();
    let time = std::time::SystemTime::now() + std::time::Duration::from_secs(later);
    std::fs::File::options().write(true).open(path).unwrap().set_modified(time).unwrap();
}

#[test]
fn a_tree_is_taken_on_when_it_is_saved_and_a_broken_one_is_told_and_left() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("own.blend.ron");
    let tree = |name: &str| format!("(version: 1, root: FootPlacement(node: Clip(name: \"{name}\")))\n");
    save(&path, &tree("walk"), 0);
    let mut hand = walking(30.0);
    hand.state_mut().open_asking(path.clone());
    frames(&mut hand, 2);
    hand.get_by_label_contains("walk 100 %");
    save(&path, "(version: 1,\n  root: Clip(nome: \"walk\"))", 10);
    frames(&mut hand, 70);
    hand.get_by_label_contains("own.blend.ron:2:");
    hand.get_by_label_contains("walk 100 %");
    save(&path, &tree("idle"), 20);
    frames(&mut hand, 70);
    assert!(hand.query_by_label_contains("own.blend.ron:2:").is_none());
    hand.get_by_label_contains("idle 100 %");
    click_now(&mut hand, "As shipped");
    frames(&mut hand, 2);
    assert!(hand.query_by_label_contains("idle 100 %").is_none() || place(&hand).is_finite());
}

#[test]
fn the_posed_figure_stands_on_the_ground_and_its_feet_follow_as_the_hips_are_moved() {
    let mut hand = at(Section::Figure);
    hand.state_mut().walk_mut().terrain.choice.source = GroundKind::Slope.into();
    let before = pose(&hand);
    click(&mut hand, "Stand on the ground");
    let stood = pose(&hand);
    assert!(stood.angles != before.angles && steps(&hand) == 1);
    assert!(hand.state().viewport.ground.is_some(), "the ground shows from now on");
    act(&mut hand, Action::StandOnGround);
    hand.run();
    assert_eq!(pose(&hand), stood, "who stands stays");
    // Moved over the slope, feet and hips go along on it, in one step.
    set_number(&mut hand, "Figure place z", 1.5);
    let moved = pose(&hand);
    let rise = moved.hips.y - stood.hips.y;
    let slope = hand.state().walk().terrain.choice.slope_deg.to_radians().tan() * 1.5;
    assert!((rise - slope).abs() < 0.05, "{rise} for {slope}");
    assert_eq!(steps(&hand), 2, "standing again was none");
    (0..2).for_each(|_| {
        hand.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        hand.run();
    });
    assert_eq!(pose(&hand), before, "to the very bits");
}

/// How far each point of the posed figure's soles is above the ground, metres.
fn over_ground(hand: &Hand) -> [[f64; Sole::COUNT]; 2] {
    let (editor, ground) = (hand.state().editor(), hand.state().walk().ground());
    let frames = &editor.evaluation().frames;
    let soles = Soles::of(editor.figure()).unwrap();
    soles.feet.map(|sole| sole.points(frames).map(|p| p.y - ground.height(p.x, p.z)))
}

#[test]
fn hips_that_the_pointer_drags_over_the_ground_leave_the_soles_on_it() {
    let mut hand = at(Section::Figure);
    hand.state_mut().walk_mut().terrain.choice.source = GroundKind::Slope.into();
    click(&mut hand, "Stand on the ground");
    let stood = pose(&hand);
    look_at(&mut hand, Bone::Hips, 2.5);
    let hips = skin_of(&mut hand, Bone::Hips);
    let over = [(4.0, 6.0), (16.0, 30.0), (30.0, 70.0)].map(|(x, y)| hips + vec2(x, y));
    drag(&mut hand, hips, &over);
    let dragged = pose(&hand);
    let moved = dragged.hips - stood.hips;
    assert!(moved.y < -0.03 && moved.x.hypot(moved.z) > 0.01, "the hips went with the pointer: {moved}");
    assert!(dragged.angles(Bone::LeftLowerLeg).flexion > stood.angles(Bone::LeftLowerLeg).flexion + 10.0);
    for sole in over_ground(&hand) {
        // Heels come up where ankles don't bend so far.
        assert!(sole.iter().all(|off| (-0.01..0.06).contains(off)), "{sole:?}");
        assert!(sole[Sole::BALL] < 0.01, "{sole:?}");
    }
    assert_eq!(steps(&hand), 2, "a drag is one step");
    undo(&mut hand);
    assert_eq!(pose(&hand), stood, "to the very bits");
}

#[test]
fn a_pose_that_was_taken_on_the_hills_stands_there_when_it_is_stood_on_the_ground() {
    let mut hand = on_hills();
    frames(&mut hand, 290);
    act(&mut hand, Action::TakePose);
    hand.run();
    let lowest = |hand: &Hand| over_ground(hand).into_iter().flatten().fold(f64::INFINITY, f64::min);
    let (taken, off) = (pose(&hand), lowest(&hand));
    let [hips, ground] = [taken.hips.y, hand.state().walk().ground().height(place(&hand).x, place(&hand).z)];
    assert!(off.abs() < 0.02 && (hips - ground - 0.9).abs() < 0.15 && ground.abs() > 0.1, "{off} {ground}");
    act(&mut hand, Action::StandOnGround);
    hand.run();
    assert!(lowest(&hand).abs() < 0.02, "{} m above the ground", lowest(&hand));
    assert!((pose(&hand).hips.y - taken.hips.y).abs() < 0.03, "{} {}", pose(&hand).hips.y, taken.hips.y);
}

#[test]
fn keys_of_the_walk_mean_nothing_while_the_window_poses() {
    let mut hand = at(LEFT_ARM);
    let before = pose(&hand);
    for which in [Key::W, Key::Space, Key::Enter, Key::H, Key::C, Key::R] {
        hand.key_press(which);
        hand.run();
    }
    assert_eq!((pose(&hand), steps(&hand)), (before, 0));
    set(&mut hand, crate::hand::ELBOW, 30.0);
    assert_eq!(steps(&hand), 1);
}

#[test]
fn every_control_has_a_name_on_every_ground() {
    let mut hand = walking(30.0);
    for source in GroundSource::all() {
        hand.state_mut().walk_mut().terrain.choice.source = source;
        frames(&mut hand, 2);
        let bare = crate::program::unnamed(&hand);
        assert!(bare.is_empty(), "{source:?}: {bare:?}");
    }
}

#[test]
fn a_child_walks_the_same_ground_and_its_pose_is_fitted_to_the_figure() {
    let mut hand = on_hills();
    hand.state_mut().walk_mut().let_walk(Some("child")).unwrap();
    frames(&mut hand, 90);
    assert!(place(&hand).z > 0.5);
    let hips = hand.state().walk().hips().unwrap();
    let ground = hand.state().walk().ground().under(hips.x, hips.z).height;
    assert!(hips.y - ground < 0.75, "a child's hips are low: {}", hips.y - ground);
    act(&mut hand, Action::TakePose);
    hand.run();
    let editor = hand.state().editor();
    let hips = editor.evaluation().frames[Bone::Hips].position;
    let ground = hand.state().walk().ground().under(hips.x, hips.z).height;
    assert!(
        (0.75..1.1).contains(&(hips.y - ground)),
        "and those of the figure are its own: {}",
        hips.y - ground
    );
    assert!(hand.state().viewport.ground.is_some());
}
