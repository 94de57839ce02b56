//! The pose library: found, applied, blended, mirrored, added to and changed, with its portraits drawn beside.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use app::library::Folders;
use app::{Session, apply_theme, load};
use edit::Editor;
use egui::{Key, Modifiers, Pos2, vec2};
use egui_kittest::Harness;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use rig::{Bone, Part, Pose, PosePatch};

use crate::hand::{Hand, click, drag, pose, set_number, steps, undo};

const THINKER: &str = "Pose Thinker";
/// Longer than anything takes on a slow machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// The portraits of the shipped poses, drawn once for all of these tests.
fn portraits() -> PathBuf {
    static DRAWN: OnceLock<tempfile::TempDir> = OnceLock::new();
    let drawn = DRAWN.get_or_init(|| {
        let folder = home();
        let mut hand = window(Folders { own: None, cache: Some(folder.path().to_owned()) });
        wait(&mut hand, "the portraits", |hand| hand.state().library().is_settled());
        folder
    });
    drawn.path().to_owned()
}

/// A window with the library open on the user's folder in `home`.
fn library(home: &Path) -> Hand {
    let mut hand = window(Folders { own: Some(home.join("poses")), cache: Some(portraits()) });
    wait(&mut hand, "the portraits", |hand| hand.state().library().is_settled());
    hand
}

fn window(folders: Folders) -> Hand {
    let mut session = Session::new(Editor::new(load::figure(None).unwrap()), None);
    session.use_library(folders);
    let mut hand = Harness::builder()
        .with_size(vec2(1400.0, 3800.0))
        .with_pixels_per_point(1.0)
        .with_step_dt(0.05)
        // Each portrait that is ready asks for a frame.
        .with_max_steps(200)
        .with_context_setup(apply_theme)
        .build_ui_state(|ui, session: &mut Session| session.ui(ui), session);
    hand.run();
    hand.key_press(Key::N);
    hand.run();
    hand
}

fn home() -> tempfile::TempDir {
    tempfile::tempdir().unwrap()
}

/// Runs frames until something holds.
fn wait(hand: &mut Hand, what: &str, holds: impl Fn(&Hand) -> bool) {
    let begun = Instant::now();
    while !holds(hand) {
        assert!(begun.elapsed() < PATIENCE, "{what} took longer than {PATIENCE:?}");
        std::thread::sleep(Duration::from_millis(20));
        hand.step();
    }
}

fn shipped(name: &str) -> PosePatch {
    rig::parse_pose(app::library::shipped::text(&format!("{name}.pose.ron")).unwrap()).unwrap()
}

/// The titles of the poses that are shown.
fn titles(hand: &Hand) -> Vec<String> {
    let labels = hand.query_all_by_label_contains("Pose ").filter_map(|node| node.accesskit_node().label());
    labels.filter_map(|label| label.strip_prefix("Pose ").map(str::to_owned)).collect()
}

fn type_text(hand: &mut Hand, text: &str) {
    hand.event(egui::Event::Text(text.to_owned()));
    hand.run();
}

fn enter(hand: &mut Hand) {
    hand.key_press(Key::Enter);
    hand.run();
}

fn center(hand: &Hand, label: &str) -> Pos2 {
    hand.get_by_label(label).rect().center()
}

/// Presses on a tile and moves sideways, without letting go.
fn blend_by(hand: &mut Hand, label: &str, points: f32) {
    let from = center(hand, label);
    hand.hover_at(from);
    hand.step();
    hand.drag_at(from);
    hand.step();
    for part in [0.25, 0.5, 0.75, 1.0] {
        hand.hover_at(from + vec2(points * part, 2.0));
        hand.step();
    }
    hand.step();
}

fn let_go(hand: &mut Hand) {
    let at = hand.ctx.input(|i| i.pointer.latest_pos()).unwrap();
    hand.drop_at(at);
    hand.run();
}

fn differ(a: &Pose, b: &Pose) -> Vec<Bone> {
    Bone::ALL.into_iter().filter(|bone| a.angles(*bone) != b.angles(*bone)).collect()
}

#[test]
fn a_search_looks_in_names_and_tags_and_tags_narrow_it() {
    let home = home();
    let mut hand = library(home.path());
    let all = titles(&hand);
    assert!(all.len() >= 8, "{all:?}");
    hand.get_by_label("Search poses").focus();
    hand.run();
    type_text(&mut hand, "think");
    assert_eq!(titles(&hand), ["Thinker"]);
    click(&mut hand, "Clear the search");
    assert_eq!(titles(&hand), all);
    type_text(&mut hand, "seated");
    let seated = titles(&hand);
    assert!(seated.contains(&"Thinker".to_owned()) && !seated.contains(&"Running".to_owned()), "{seated:?}");
    click(&mut hand, "Clear the search");
    click(&mut hand, "Tag seated");
    assert_eq!(titles(&hand), seated);
    click(&mut hand, "Tag seated");
    assert_eq!(titles(&hand), all);
}

#[test]
fn a_click_applies_a_pose_as_one_step() {
    let home = home();
    let mut hand = library(home.path());
    let before = pose(&hand);
    click(&mut hand, THINKER);
    let thinker = shipped("thinker");
    for (bone, angles) in &thinker.joints {
        assert_eq!(pose(&hand).angles(*bone), *angles, "{bone:?}");
    }
    assert_eq!(steps(&hand), 1);
    undo(&mut hand);
    assert_eq!(pose(&hand), before);
}

#[test]
fn a_pose_is_applied_to_the_parts_that_are_ticked_or_selected() {
    let home = home();
    let mut hand = library(home.path());
    let before = pose(&hand);
    click(&mut hand, "Apply to parts");
    click(&mut hand, THINKER);
    assert_eq!((pose(&hand), steps(&hand)), (before.clone(), 0), "no part is ticked");
    click(&mut hand, "Apply to left arm");
    click(&mut hand, THINKER);
    let moved = differ(&before, &pose(&hand));
    assert!(moved.contains(&Bone::LeftLowerArm), "{moved:?}");
    assert!(moved.iter().all(|bone| bone.part() == Part::LeftArm), "{moved:?}");
    undo(&mut hand);
    click(&mut hand, "Apply to the selection");
    click(&mut hand, THINKER);
    assert_eq!(pose(&hand), before, "nothing is selected");
    hand.state_mut().panels.select(Some(Bone::Head));
    hand.run();
    click(&mut hand, THINKER);
    let moved = differ(&before, &pose(&hand));
    assert!(!moved.is_empty() && moved.iter().all(|bone| bone.part() == Part::Head), "{moved:?}");
}

#[test]
fn a_drag_sideways_blends_past_a_hundred_per_cent_as_one_step() {
    let home = home();
    let mut hand = library(home.path());
    let elbow = |hand: &Hand| pose(hand).angles(Bone::LeftLowerArm).flexion;
    let whole = shipped("thinker").joints[&Bone::LeftLowerArm].flexion;
    blend_by(&mut hand, THINKER, 100.0);
    assert!((elbow(&hand) - whole * 0.5).abs() < 1e-9, "{} of {whole}", elbow(&hand));
    assert_eq!(hand.get_by_label(THINKER).accesskit_node().value().as_deref(), Some("50 %"));
    let from = center(&hand, THINKER);
    hand.hover_at(from + vec2(240.0, 0.0));
    hand.run();
    let range =
        hand.state().editor().figure().skeleton.joint(Bone::LeftLowerArm).unwrap().range(rig::Dof::Flexion);
    let expected = (whole * 1.2).min(range.unwrap().max);
    assert!((elbow(&hand) - expected).abs() < 1e-9 && expected > whole, "{} of {expected}", elbow(&hand));
    hand.hover_at(from + vec2(900.0, 0.0));
    hand.run();
    assert_eq!(hand.get_by_label(THINKER).accesskit_node().value().as_deref(), Some("150 %"));
    hand.hover_at(from + vec2(-900.0, 0.0));
    hand.run();
    assert_eq!(hand.get_by_label(THINKER).accesskit_node().value().as_deref(), Some("-50 %"));
    hand.hover_at(from + vec2(200.0, 0.0));
    hand.run();
    let_go(&mut hand);
    assert_eq!(elbow(&hand), whole, "a hundred is the pose itself");
    assert_eq!(steps(&hand), 1);
    assert!(!hand.state().editor().in_gesture());
    undo(&mut hand);
    assert_eq!(elbow(&hand), 0.0);
}

#[test]
fn escape_takes_a_blend_back() {
    let home = home();
    let mut hand = library(home.path());
    let before = pose(&hand);
    blend_by(&mut hand, THINKER, 120.0);
    assert_ne!(pose(&hand), before);
    hand.key_press(Key::Escape);
    hand.step();
    assert_eq!(pose(&hand), before);
    hand.hover_at(center(&hand, THINKER) + vec2(60.0, 0.0));
    hand.run();
    let_go(&mut hand);
    assert_eq!((pose(&hand), steps(&hand)), (before, 0));
}

#[test]
fn the_amount_of_a_click_can_be_set_by_keys_alone() {
    let home = home();
    let mut hand = library(home.path());
    set_number(&mut hand, "Amount", 50.0);
    hand.get_by_label(THINKER).focus();
    hand.run();
    enter(&mut hand);
    let whole = shipped("thinker").joints[&Bone::LeftLowerArm].flexion;
    assert!((pose(&hand).angles(Bone::LeftLowerArm).flexion - whole * 0.5).abs() < 1e-9);
    assert_eq!(steps(&hand), 1);
}

#[test]
fn mirrored_changes_sides() {
    let home = home();
    let mut hand = library(home.path());
    let thinker = shipped("thinker");
    let (left, right) = (thinker.joints[&Bone::LeftLowerArm], thinker.joints[&Bone::RightLowerArm]);
    assert_ne!(left, right);
    click(&mut hand, "Mirrored");
    click(&mut hand, THINKER);
    assert_eq!(pose(&hand).angles(Bone::LeftLowerArm), right);
    assert_eq!(pose(&hand).angles(Bone::RightLowerArm), left);
    // The key held turns it round once more.
    let at = center(&hand, THINKER);
    hand.hover_at(at);
    hand.step();
    for pressed in [true, false] {
        let button = egui::PointerButton::Primary;
        hand.event_modifiers(
            egui::Event::PointerButton { pos: at, button, pressed, modifiers: Modifiers::ALT },
            Modifiers::ALT,
        );
        hand.step();
    }
    hand.run();
    assert_eq!(pose(&hand).angles(Bone::LeftLowerArm), left);
}

#[test]
fn the_pose_is_added_renamed_and_put_aside() {
    let home = home();
    let mut hand = library(home.path());
    click(&mut hand, THINKER);
    click(&mut hand, "Save current pose to the library…");
    type_text(&mut hand, "Curtsy");
    enter(&mut hand);
    assert!(titles(&hand).contains(&"Curtsy".to_owned()), "{:?}", hand.state().status());
    let file = home.path().join("poses/Curtsy.pose.ron");
    let saved = rig::parse_pose(&std::fs::read_to_string(&file).unwrap()).unwrap();
    assert_eq!(saved.joints[&Bone::Head], pose(&hand).angles(Bone::Head));
    undo(&mut hand);
    click(&mut hand, "Pose Curtsy");
    assert_eq!(pose(&hand).angles(Bone::Head), saved.joints[&Bone::Head]);

    for _ in 0..2 {
        hand.get_by_label("Name Curtsy").click();
        hand.step();
    }
    hand.run();
    hand.get_by_label("New name");
    type_text(&mut hand, "Deep curtsy");
    enter(&mut hand);
    let shown = titles(&hand);
    assert!(shown.contains(&"Deep curtsy".to_owned()) && !shown.contains(&"Curtsy".to_owned()), "{shown:?}");
    assert!(!file.exists() && home.path().join("poses/Deep curtsy.pose.ron").exists());

    hand.get_by_label("Pose Deep curtsy").focus();
    hand.run();
    hand.key_press(Key::Delete);
    hand.run();
    click(&mut hand, "Keep Deep curtsy");
    assert!(titles(&hand).contains(&"Deep curtsy".to_owned()));
    hand.get_by_label("Pose Deep curtsy").focus();
    hand.run();
    hand.key_press(Key::Delete);
    hand.run();
    click(&mut hand, "Delete Deep curtsy");
    assert!(!titles(&hand).contains(&"Deep curtsy".to_owned()));
    assert!(home.path().join("poses/trash/Deep curtsy.pose.ron").exists(), "nothing is lost");
}

#[test]
fn a_name_that_is_taken_is_told_and_nothing_is_overwritten() {
    let home = home();
    let poses = home.path().join("poses");
    std::fs::create_dir(&poses).unwrap();
    std::fs::write(poses.join("Curtsy.pose.ron"), "(version: 1)").unwrap();
    let mut hand = library(home.path());
    for taken in ["curtsy", "THINKER", "a/b"] {
        click(&mut hand, "Save current pose to the library…");
        type_text(&mut hand, taken);
        enter(&mut hand);
        assert!(hand.state().status().fault, "{taken}: {:?}", hand.state().status());
        click(&mut hand, "Add no pose");
    }
    assert_eq!(std::fs::read_to_string(poses.join("Curtsy.pose.ron")).unwrap(), "(version: 1)");
    assert_eq!(std::fs::read_dir(&poses).unwrap().count(), 1);
}

#[test]
fn only_the_chosen_parts_are_saved() {
    let home = home();
    let mut hand = library(home.path());
    click(&mut hand, "Apply to parts");
    click(&mut hand, "Apply to head");
    click(&mut hand, "Save current pose to the library…");
    type_text(&mut hand, "Nod");
    enter(&mut hand);
    let text = std::fs::read_to_string(home.path().join("poses/Nod.pose.ron")).unwrap();
    let saved = rig::parse_pose(&text).unwrap();
    assert!(saved.joints.keys().all(|bone| bone.part() == Part::Head) && !saved.joints.is_empty());
    assert!(saved.hips.is_none() && saved.limbs.is_empty());
}

#[test]
fn a_broken_file_is_told_on_its_tile_and_the_others_stay() {
    let home = home();
    let poses = home.path().join("poses");
    std::fs::create_dir(&poses).unwrap();
    std::fs::write(poses.join("bad.pose.ron"), "(version: 1,\n joints: { \"leftArm\": () })").unwrap();
    let mut hand = library(home.path());
    let told = |hand: &Hand| hand.get_by_label("Pose bad").accesskit_node().description().unwrap_or_default();
    wait(&mut hand, "the broken file", |hand| told(hand).contains("bad.pose.ron:2:"));
    let before = pose(&hand);
    click(&mut hand, "Pose bad");
    assert!(hand.state().status().fault && hand.state().status().message.contains("bad.pose.ron:2:"));
    assert_eq!(pose(&hand), before);
    click(&mut hand, THINKER);
    assert_ne!(pose(&hand), before);
    // Mended by hand, in another program: seen within a few seconds.
    std::fs::write(poses.join("bad.pose.ron"), "(version: 1, joints: { \"leftHand\": (flexion: 20.0) })")
        .unwrap();
    wait(&mut hand, "the mended file", |hand| !told(hand).contains("broken"));
}

#[test]
fn portraits_are_drawn_beside_with_progress_and_kept() {
    let home = home();
    let folders = || Folders { own: None, cache: Some(home.path().join("portraits")) };
    let mut hand = window(folders());
    let all = titles(&hand).len();
    wait(&mut hand, "the first portraits", |hand| hand.query_by_label_contains("Drawing:").is_some());
    hand.get_by_label_contains(&format!(" of {all}"));
    wait(&mut hand, "the portraits", |hand| hand.state().library().is_settled());
    hand.run();
    assert!(hand.query_by_label_contains("Drawing:").is_none());
    hand.get_by_label(&format!("{all} poses"));
    let drawn = || {
        let files = std::fs::read_dir(home.path().join("portraits")).unwrap();
        let mut dates: Vec<_> =
            files.map(|file| file.unwrap().metadata().unwrap().modified().unwrap()).collect();
        dates.sort();
        dates
    };
    let first = drawn();
    assert_eq!(first.len(), all);
    drop(hand);
    let mut again = window(folders());
    wait(&mut again, "the kept portraits", |hand| hand.state().library().is_settled());
    assert_eq!(drawn(), first, "they are not drawn again");
}

#[test]
fn thousands_of_poses_cost_what_is_seen_of_them() {
    let home = home();
    let poses = home.path().join("poses");
    std::fs::create_dir(&poses).unwrap();
    for n in 0..3000 {
        std::fs::write(poses.join(format!("pose {n}.pose.ron")), "(version: 1)").unwrap();
    }
    let mut hand = window(Folders { own: Some(poses), cache: Some(portraits()) });
    assert!(titles(&hand).len() < 60, "only rows in sight are laid out");
    hand.get_by_label("Search poses").focus();
    hand.run();
    type_text(&mut hand, "pose 2999");
    assert_eq!(titles(&hand), ["pose 2999"]);
}

#[test]
fn a_drag_on_a_tile_leaves_the_view_and_other_tiles_alone() {
    let home = home();
    let mut hand = library(home.path());
    let camera = hand.state().viewport.camera;
    let from = center(&hand, THINKER);
    drag(&mut hand, from, &[from + vec2(-300.0, 0.0), from + vec2(-40.0, 200.0)]);
    assert_eq!(hand.state().viewport.camera, camera);
    assert_eq!(steps(&hand), 1);
}
