//! The excavator on a real display, driven by real keys through a dig cycle.

use std::path::Path;
use std::thread::sleep;
use std::time::Duration;

use serde_json::Value;

use crate::program::{Window, center, control, display, xdotool};

const EXCAVATOR: &str = "library:excavator.chain.ron";
/// From one look at the window to the next while a key is held.
const LOOK: Duration = Duration::from_millis(15);

/// A joint's value, degrees or metres.
fn value(map: &Value, joint: &str) -> f64 {
    let part = if joint == "base" { "slide" } else { "turn" };
    map["values"][format!("{joint} {part}")].as_f64().unwrap_or(f64::NAN)
}

/// Chooses a joint by as many presses of Space as it takes.
fn choose(window: &Window, joint: &str) {
    for _ in 0..5 {
        if window.at_rest()["chosen"] == joint {
            return;
        }
        window.keys("space");
    }
    panic!("Space never comes to {joint}");
}

/// Holds a key until a value is reached or for as long as one may have patience, then lets the joint come to rest. What the
/// joint was in every frame that was seen.
fn hold(window: &Window, key: &str, joint: &str, reached: impl Fn(f64) -> bool) -> Vec<f64> {
    xdotool(&["keydown", key]);
    let mut seen = Vec::new();
    for _ in 0..600 {
        let now = window.map().map_or(f64::NAN, |map| value(&map, joint));
        if seen.last() != Some(&now) && now.is_finite() {
            seen.push(now);
        }
        if reached(now) {
            break;
        }
        sleep(LOOK);
    }
    xdotool(&["keyup", key]);
    seen.push(value(&window.at_rest(), joint));
    seen
}

fn within(seen: &[f64], low: f64, high: f64) {
    assert!(seen.iter().all(|value| *value >= low - 1e-6 && *value <= high + 1e-6), "{seen:?}");
}

#[test]
fn the_excavator_digs_by_keys_alone() {
    let Some(_display) = display() else { return };
    let folder = tempfile::tempdir().unwrap();
    let window = Window::open(folder.path(), &[Path::new(EXCAVATOR)]);
    let start = window.at_rest();
    assert_eq!(start["chosen"], "base", "the walk begins at the root: {start}");

    // Aside: the base slides, the arms keep their angles.
    let aside = hold(&window, "Right", "base", |base| base > 0.8);
    assert!(*aside.last().unwrap() > 0.8, "{aside:?}");
    within(&aside, -4.0, 4.0);
    let map = window.at_rest();
    for joint in ["boom", "stick", "bucket"] {
        assert_eq!(value(&map, joint), value(&start, joint), "{joint}");
    }

    // Boom down, against the end of its range, where the drive stops although the key is still down.
    choose(&window, "boom");
    let down = hold(&window, "Up", "boom", |boom| boom >= 45.0 - 1e-9);
    within(&down, -45.0, 45.0);
    assert!((down.last().unwrap() - 45.0).abs() < 1e-6, "{down:?}");
    assert!(window.at_rest()["status"].as_str().unwrap().contains("the end of its range"));

    // Stick in, bucket curled.
    choose(&window, "stick");
    let stick = hold(&window, "Up", "stick", |stick| stick > 80.0);
    within(&stick, 0.0, 90.0);
    assert!(*stick.last().unwrap() > 80.0, "{stick:?}");
    choose(&window, "bucket");
    let curled = hold(&window, "Up", "bucket", |bucket| bucket > 125.0);
    within(&curled, 45.0, 135.0);
    assert!(*curled.last().unwrap() > 125.0, "{curled:?}");

    // Boom up: back through the walk, and the speed grows while the key is down.
    choose(&window, "boom");
    let up = hold(&window, "Down", "boom", |boom| boom < -20.0);
    within(&up, -45.0, 45.0);
    assert!(*up.last().unwrap() < -20.0, "{up:?}");
    let map = window.at_rest();
    assert!(value(&map, "bucket") > 125.0 && value(&map, "stick") > 80.0, "what was done stays");

    // Each press is a step, and the whole cycle can be taken back.
    let steps = map["steps"].as_u64().unwrap();
    assert_eq!(steps, 5, "base, boom, stick, bucket, boom");
    (0..steps).for_each(|_| window.keys("ctrl+z"));
    let back = window.at_rest();
    for joint in ["base", "boom", "stick", "bucket"] {
        assert_eq!(value(&back, joint), value(&start, joint), "{joint}");
    }

    // At rest nothing is drawn.
    let frame = back["frame"].clone();
    sleep(Duration::from_secs(2));
    assert_eq!(window.map().unwrap()["frame"], frame, "an idle window draws nothing");
}

#[test]
fn a_chain_and_the_figure_open_in_the_same_window() {
    let Some(_display) = display() else { return };
    let folder = tempfile::tempdir().unwrap();
    let window = Window::open(folder.path(), &[]);
    for (entry, title) in [
        ("Open Excavator", "excavator.chain.ron – Posewright"),
        ("Open Mannequin", "Unnamed pose – Posewright"),
    ] {
        let map = window.at_rest();
        window.click(center(&map, "Button", "File"));
        let map = window.until("the menu", |map| control(map, "Button", entry).is_some());
        window.click(center(&map, "Button", entry));
        window.until("the other window", |map| map["title"] == title);
    }
}
