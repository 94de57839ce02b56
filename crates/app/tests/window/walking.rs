//! The walk on a real display: real keys walk the figure, halt it and take its pose.

use serde_json::Value;

use crate::program::{Window, display, xdotool};

fn ahead(map: &Value) -> f64 {
    map["walk"]["place"][2].as_f64().unwrap_or(f64::NAN)
}

#[test]
fn real_keys_walk_the_figure_and_its_pose_is_taken() {
    let Some(_display) = display() else { return };
    let folder = tempfile::tempdir().unwrap();
    let window = Window::open(folder.path(), &[]);
    let before = window.at_rest()["pose"].clone();
    window.keys("F5");
    window.until("a walk by itself", |map| ahead(map) > 0.5);
    // H: no longer by itself; it comes to stand.
    window.keys("h");
    window.keys("space");
    let halted = window.at_rest();
    assert_eq!(halted["walk"]["playing"], false);
    assert_eq!(halted["pose"], before, "the pose stays as it is");
    window.keys("shift+space");
    let step = window.at_rest();
    assert_eq!(step["walk"]["steps"].as_u64(), halted["walk"]["steps"].as_u64().map(|steps| steps + 1));

    window.keys("space");
    let start = ahead(&window.map().unwrap());
    xdotool(&["keydown", "w"]);
    window.until("steps ahead by a held key", |map| ahead(map) > start + 1.0);
    xdotool(&["keyup", "w"]);
    let turn = window.map().unwrap()["walk"]["turn"].as_f64().unwrap();
    xdotool(&["keydown", "Left"]);
    let turned = |map: &Value| map["walk"]["turn"].as_f64().is_some_and(|now| now > turn + 20.0);
    window.until("a turn to the left", turned);
    xdotool(&["keyup", "Left"]);

    window.keys("Return");
    let taken = window.at_rest();
    assert!(taken["walk"].is_null() && taken["pose"] != before);
    window.keys("ctrl+z");
    assert_eq!(window.at_rest()["pose"], before, "one step of undo");
}
