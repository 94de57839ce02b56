//! Opening, saving, closing, and what is asked on the way.

use std::path::Path;

use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

use crate::hand::{ELBOW, Hand, LEFT_ARM, at, click, pose, set};

/// Names a file in the dialog that is up.
pub fn name_file(hand: &mut Hand, path: &Path) {
    hand.key_press_modifiers(Modifiers::COMMAND, Key::A);
    hand.event(egui::Event::Text(path.display().to_string()));
    hand.run();
}

/// The same, and presses Enter.
fn enter(hand: &mut Hand, path: &Path) {
    name_file(hand, path);
    hand.key_press(Key::Enter);
    hand.run();
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
    enter(&mut hand, &path);
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(text.contains("leftLowerArm") && text.contains("42"), "{text}");
    assert_eq!(hand.state().title(), "bent.pose.ron – Posewright");
    let saved = pose(&hand);
    set(&mut hand, ELBOW, 90.0);
    assert!(hand.state().is_modified());
    hand.key_press_modifiers(Modifiers::COMMAND, Key::O);
    hand.run();
    click(&mut hand, "Don't save");
    click(&mut hand, "bent.pose.ron");
    click(&mut hand, "Open the pose now");
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
fn a_file_that_cannot_be_written_is_asked_for_again_with_the_reason() {
    let folder = tempfile::tempdir().unwrap();
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 42.0);
    hand.key_press_modifiers(Modifiers::COMMAND | Modifiers::SHIFT, Key::S);
    hand.run();
    for (name, why) in [("nowhere/a.pose.ron", "no such file or folder"), ("a.txt", "is saved as .pose.ron")]
    {
        enter(&mut hand, &folder.path().join(name));
        assert!(hand.state().is_modified() && !folder.path().join(name).exists());
        // In the dialog and in the status line.
        assert_eq!(hand.get_all_by_label_contains(why).count(), 2, "{name}");
    }
    // The dialog has the keyboard still: what is typed is a path and no shortcut.
    enter(&mut hand, &folder.path().join("a.pose.ron"));
    assert_eq!(hand.state().title(), "a.pose.ron – Posewright");
    assert!(hand.query_by_label("File path").is_none());
}

#[test]
fn a_file_that_cannot_be_opened_is_asked_for_again_with_its_fault() {
    let folder = tempfile::tempdir().unwrap();
    let [good, cut] = ["good", "cut"].map(|name| folder.path().join(format!("{name}.pose.ron")));
    std::fs::write(&good, "(version: 1, joints: {})").unwrap();
    std::fs::write(&cut, "(version: 1, joi").unwrap();
    let mut hand = at(LEFT_ARM);
    let before = pose(&hand);
    hand.key_press_modifiers(Modifiers::COMMAND, Key::O);
    hand.run();
    enter(&mut hand, &cut);
    assert_eq!(hand.get_all_by_label_contains("cut.pose.ron:1:").count(), 2);
    assert_eq!(pose(&hand), before);
    enter(&mut hand, &good);
    assert_eq!(hand.state().title(), "good.pose.ron – Posewright");
    assert!(hand.query_by_label("File path").is_none());
}

#[test]
fn another_file_is_replaced_only_after_asking() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("there.pose.ron");
    std::fs::write(&path, "former").unwrap();
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 42.0);
    for (answer, replaced) in [("Cancel", false), ("Replace", true)] {
        hand.key_press_modifiers(Modifiers::COMMAND, Key::S);
        hand.run();
        name_file(&mut hand, &path);
        click(&mut hand, "Save the pose now");
        assert_eq!(std::fs::read_to_string(&path).unwrap(), "former");
        click(&mut hand, answer);
        assert_eq!(std::fs::read_to_string(&path).unwrap() != "former", replaced);
    }
    assert!(!hand.state().is_modified());
}

#[test]
fn a_picture_takes_no_other_file_s_place_without_asking() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("there.pose.ron");
    std::fs::write(&path, "former").unwrap();
    let mut hand = at(LEFT_ARM);
    hand.key_press(Key::F12);
    hand.run();
    name_file(&mut hand, &path);
    click(&mut hand, "Save the picture now");
    hand.get_by_label_contains("there.pose.ron?");
    click(&mut hand, "Cancel");
    assert_eq!(std::fs::read_to_string(&path).unwrap(), "former");
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
