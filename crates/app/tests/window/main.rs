//! The real window on a real display: pointer and keys come from outside, pictures are taken of the screen.
//!
//! `cargo xtask test` starts a display in memory and sets `POSEWRIGHT_WINDOW_TEST=1`; without it the test says so and
//! passes, since it would take over the developer's own pointer.
#![allow(clippy::unwrap_used, clippy::print_stderr)]

mod by_hand;
mod excavator;
mod program;
mod recording;
mod walking;

use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use rig::{Bone, Figure};
use serde_json::Value;

use program::{PATIENCE, Window, center, control, display};

const ELBOW: &str = "Left elbow · flexion";

fn value(map: &Value, label: &str) -> f64 {
    control(map, "Slider", label).and_then(|c| c["value"].as_f64()).unwrap_or(f64::NAN)
}

/// Where a joint is seen, pixels of the window.
fn joint(map: &Value, bone: Bone) -> [f64; 2] {
    std::array::from_fn(|i| map["joints"][bone.name()][i].as_f64().unwrap_or(f64::NAN))
}

fn saved_elbow(figure: &Figure, path: &Path) -> f64 {
    let patch = rig::parse_pose(&std::fs::read_to_string(path).unwrap()).unwrap();
    patch.onto(&figure.rest_pose()).angles(Bone::LeftLowerArm).flexion
}

#[test]
fn a_pose_is_made_by_hand_saved_and_opened_again() {
    let Some(_display) = display() else { return };
    let folder = tempfile::tempdir().unwrap();
    let window = Window::open(folder.path(), &[]);
    let first = window.picture();
    let map = window.at_rest();
    let start = value(&map, ELBOW);

    // A slider, by a real drag.
    window.drag(center(&map, "Slider", ELBOW), [35.0, 0.0]);
    let map = window.at_rest();
    let dragged = value(&map, ELBOW);
    assert!(dragged > start + 20.0, "{start} {dragged}");
    let turned = window.picture();
    assert_ne!(first, turned, "a turned elbow is seen");

    // A typed value, and back.
    window.click(center(&map, "SpinButton", ELBOW));
    window.type_in("25");
    window.keys("Return");
    window.until("a typed elbow", |map| value(map, ELBOW) == 25.0);
    window.keys("ctrl+z");
    window.until("the elbow as dragged", |map| value(map, ELBOW) == dragged);
    assert!(window.picture() == turned, "undo brings the same picture back");

    // The forearm, grabbed by its skin halfway to the wrist: the elbow follows, and undo brings the same picture back.
    let map = window.at_rest();
    let (elbow, wrist) = (joint(&map, Bone::LeftLowerArm), joint(&map, Bone::LeftHand));
    let forearm = std::array::from_fn(|i| (elbow[i] + wrist[i]) * 0.5);
    window.drag(forearm, [25.0, -35.0]);
    window.until("a forearm that moved", |map| {
        let now = joint(map, Bone::LeftHand);
        now[0] > wrist[0] + 10.0 && now[1] < wrist[1] - 10.0
    });
    assert!(window.picture() != turned, "a dragged forearm is seen");
    window.keys("ctrl+z");
    assert!(window.picture() == turned, "undo brings the same picture back");

    // The view turns, the figure doesn't.
    window.drag([560.0, 560.0], [120.0, 20.0]);
    let map = window.at_rest();
    assert_eq!(value(&map, ELBOW), dragged);
    let seen = window.picture();
    assert_ne!(seen, turned, "another view is another picture");

    // Nothing is drawn while nothing happens.
    let before = window.at_rest()["frame"].clone();
    sleep(Duration::from_secs(2));
    assert_eq!(window.map().unwrap()["frame"], before, "an idle window draws nothing");

    // Saved by path, changed, and opened again.
    let path = folder.path().join("by-hand.pose.ron");
    window.keys("ctrl+shift+s");
    window.keys("ctrl+a");
    window.type_in(&path.display().to_string());
    window.keys("Return");
    let map = window.until("a saved file", |map| map["title"] == "by-hand.pose.ron – Posewright");
    let figure = app::load::figure(None).unwrap();
    // The map's numbers are rounded in their last digit.
    assert!((saved_elbow(&figure, &path) - dragged).abs() < 1e-9);
    window.drag(center(&map, "Slider", ELBOW), [-25.0, 0.0]);
    window.until("an unsaved change", |map| map["title"] == "• by-hand.pose.ron – Posewright");
    window.keys("ctrl+o");
    let map = window.until("a question", |map| control(map, "Button", "Don't save").is_some());
    window.click(center(&map, "Button", "Don't save"));
    window.until("the path field", |map| control(map, "TextInput", "File path").is_some());
    window.keys("ctrl+a");
    window.type_in(&path.display().to_string());
    window.keys("Return");
    window.until("the saved pose", |map| value(map, ELBOW) == dragged);
    assert!(window.picture() == seen, "the opened pose looks as it was saved");

    // It closes when asked.
    window.keys("ctrl+q");
    let mut window = window;
    let start = Instant::now();
    let status = loop {
        if let Some(status) = window.child.try_wait().unwrap() {
            break status;
        }
        assert!(start.elapsed() < PATIENCE, "the window stays open");
        sleep(Duration::from_millis(50));
    };
    assert!(status.success(), "{status}");
}

#[test]
fn a_killed_program_offers_the_last_committed_pose() {
    let Some(_display) = display() else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut dragged = Vec::new();
    for _ in 0..2 {
        let mut window = Window::open(folder.path(), &[]);
        let map = window.map().unwrap();
        if let Some(last) = dragged.last() {
            window.click(center(&map, "Button", "Open it"));
            window.until("the pose of before", |map| value(map, ELBOW) == *last);
        }
        let map = window.at_rest();
        window.drag(center(&map, "Slider", ELBOW), [20.0, 0.0]);
        dragged.push(value(&window.at_rest(), ELBOW));
        // Every committed gesture is on disk within two seconds.
        sleep(Duration::from_secs(2));
        window.child.kill().unwrap();
        window.child.wait().unwrap();
        std::fs::remove_file(&window.map_path).unwrap();
    }
    assert!(dragged[1] > dragged[0] + 5.0, "{dragged:?}");
    let window = Window::open(folder.path(), &[]);
    window.click(center(&window.map().unwrap(), "Button", "Throw it away"));
    window.until("the standing pose", |map| control(map, "Button", "Open it").is_none());
    assert!(value(&window.at_rest(), ELBOW) < dragged[0]);
    let kept = std::fs::read_dir(folder.path().join("data/posewright/recovery")).unwrap();
    let poses = kept.flatten().filter(|e| e.path().to_string_lossy().ends_with("pose.ron")).count();
    assert_eq!(poses, 0, "what is thrown away is gone");
}

#[test]
fn without_a_display_one_sentence_names_the_cure() {
    let output = Command::new(env!("CARGO_BIN_EXE_posewright"))
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .env_remove("WAYLAND_SOCKET")
        .stdin(Stdio::null())
        .output()
        .unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(3), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
    if cfg!(target_os = "linux") {
        assert!(said.contains("set DISPLAY or WAYLAND_DISPLAY"), "{said}");
    }
}
