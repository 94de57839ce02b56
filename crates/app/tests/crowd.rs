//! Crowds as a shell sees them.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod shell;

use std::fs;
use std::path::Path;

use serde_json::Value;
use shell::{code, posewright, said};

/// Walks the mannequin's crowd on a slope, two small pictures.
fn walk(folder: &Path, name: &str, count: &str) -> Value {
    let output = folder.join(name);
    let arguments = [
        "walk",
        "--crowd",
        count,
        "--ground",
        "slope",
        "--figure",
        "library:mannequin.figure.ron",
        "--seconds",
        "0.2",
        "--rate",
        "10",
        "--fps",
        "10",
        "--size",
        "160x100",
        "--report",
        "-",
        "-o",
    ];
    let done = posewright(&[&arguments[..], &[output.to_str().unwrap()]].concat());
    assert_eq!(code(&done), 0, "{}", said(&done));
    serde_json::from_slice(&done.stdout).expect("JSON")
}

#[test]
fn a_crowd_walks_into_pictures_the_same_each_time_with_as_many_draws_for_more() {
    let folder = tempfile::tempdir().unwrap();
    let few = walk(folder.path(), "few-%d.png", "40");
    assert_eq!(few["walkers"], 40);
    assert_eq!(few["bodies"][0]["vertices"], 6000, "a light skin");
    let bytes = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert_ne!(bytes("few-1.png"), bytes("few-2.png"), "they move");
    assert_eq!(walk(folder.path(), "again-%d.png", "40"), few);
    assert_eq!(bytes("few-2.png"), bytes("again-2.png"));
    let more = walk(folder.path(), "more-%d.png", "80");
    assert_eq!(more["picture"]["draw_calls"], few["picture"]["draw_calls"]);
    let uploaded = |report: &Value| report["picture"]["uploaded_bytes"].as_u64().unwrap();
    // 65 matrices of 48 bytes a figure; blocks of 16 are whole.
    assert_eq!(uploaded(&more) - uploaded(&few), (80 - 48) * 65 * 48);
}

#[test]
fn what_a_crowd_can_t_do_is_said() {
    for (arguments, words) in [
        (&["--crowd", "0"][..], "1..=20000"),
        (&["--crowd", "9", "--tree", "x.blend.ron"], "cannot be used with"),
        (&["--crowd", "9", "--pass", "openpose", "-o", "x.webp", "--seconds", "0.1"], "no keypoints"),
        (&["--crowd", "9", "--seconds", "1", "-o", "x.png"], "several frames need"),
    ] {
        let done = posewright(&[&["walk"], arguments].concat());
        let said = said(&done);
        assert_eq!(code(&done), 2, "{arguments:?}: {said}");
        assert!(said.contains(words), "{arguments:?}: {said}");
    }
}
