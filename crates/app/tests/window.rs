//! The real window on a real display: pointer and keys come from outside, pictures are taken of the screen.
//!
//! `cargo xtask test` starts a display in memory and sets `POSEWRIGHT_WINDOW_TEST=1`; without it the test says so and
//! passes, since it would take over the developer's own pointer.
#![allow(clippy::unwrap_used, clippy::print_stderr)]

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::sleep;
use std::time::{Duration, Instant};

use rig::{Bone, Figure};
use serde_json::Value;

const PATIENCE: Duration = Duration::from_secs(40);
const ELBOW: &str = "Left elbow · flexion";

/// The program at work, and what it says of its controls. It ends with this value.
struct Window {
    child: Child,
    id: String,
    map_path: PathBuf,
}

impl Drop for Window {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn xdotool(arguments: &[&str]) -> String {
    let output = Command::new("xdotool").args(arguments).output().expect("xdotool");
    assert!(output.status.success(), "xdotool {arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap().trim().to_owned()
}

impl Window {
    fn open(folder: &Path) -> Window {
        let map_path = folder.join("map.json");
        let child = Command::new(env!("CARGO_BIN_EXE_posewright"))
            .arg("--ui-map")
            .arg(&map_path)
            .env("XDG_DATA_HOME", folder.join("data"))
            .stdin(Stdio::null())
            .spawn()
            .unwrap();
        let pid = child.id().to_string();
        let mut window = Window { child, id: String::new(), map_path };
        window.until("a first frame", |map| map["frame"].as_u64() >= Some(1));
        let found = xdotool(&["search", "--onlyvisible", "--pid", &pid]);
        window.id = found.lines().last().expect("a window").to_owned();
        xdotool(&["windowfocus", "--sync", &window.id]);
        window.at_rest();
        window
    }

    fn map(&self) -> Option<Value> {
        serde_json::from_str(&std::fs::read_to_string(&self.map_path).ok()?).ok()
    }

    /// Waits until the map says so.
    fn until(&self, what: &str, holds: impl Fn(&Value) -> bool) -> Value {
        let start = Instant::now();
        loop {
            if let Some(map) = self.map().filter(|map| holds(map)) {
                return map;
            }
            assert!(start.elapsed() < PATIENCE, "waited in vain for {what}: {:?}", self.map());
            sleep(Duration::from_millis(30));
        }
    }

    /// Waits until no more frames come: what was asked for is drawn, in full quality.
    fn at_rest(&self) -> Value {
        let start = Instant::now();
        let mut former = None;
        loop {
            let map = self.map();
            let frame = map.as_ref().and_then(|map| map["frame"].as_u64());
            if let Some(map) = map.filter(|_| frame == former) {
                return map;
            }
            assert!(start.elapsed() < PATIENCE, "the window never comes to rest");
            former = frame;
            sleep(Duration::from_millis(700));
        }
    }

    fn to(&self, [x, y]: [f64; 2]) {
        xdotool(&["mousemove", "--window", &self.id, &x.round().to_string(), &y.round().to_string()]);
        sleep(Duration::from_millis(120));
    }

    fn click(&self, at: [f64; 2]) {
        self.to(at);
        xdotool(&["click", "1"]);
        sleep(Duration::from_millis(150));
    }

    fn drag(&self, from: [f64; 2], by: [f64; 2]) {
        self.to(from);
        xdotool(&["mousedown", "1"]);
        for i in 1..=5 {
            let t = f64::from(i) / 5.0;
            self.to([from[0] + by[0] * t, from[1] + by[1] * t]);
        }
        xdotool(&["mouseup", "1"]);
        sleep(Duration::from_millis(150));
    }

    fn keys(&self, keys: &str) {
        xdotool(&["key", keys]);
        sleep(Duration::from_millis(200));
    }

    fn type_in(&self, words: &str) {
        xdotool(&["type", "--delay", "15", words]);
        sleep(Duration::from_millis(200));
    }

    /// The picture of the figure as it is on the screen: RGB, row by row. The pointer is out of the way, where nothing
    /// has a tooltip.
    fn picture(&self) -> Vec<u8> {
        self.to([700.0, 60.0]);
        let map = self.at_rest();
        let [left, top, right, bottom] = rect(&map, "Canvas", "Figure");
        let crop = format!("{}x{}+{left}+{top}", right - left, bottom - top);
        let output = Command::new("import")
            .args(["-window", &self.id, "-crop", &crop, "-depth", "8", "rgb:-"])
            .output()
            .expect("import, of ImageMagick");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        assert_eq!(output.stdout.len() as f64, 3.0 * (right - left) * (bottom - top));
        output.stdout
    }
}

fn control<'a>(map: &'a Value, role: &str, label: &str) -> Option<&'a Value> {
    map["controls"].as_array()?.iter().find(|c| c["role"] == role && c["label"] == label)
}

fn rect(map: &Value, role: &str, label: &str) -> [f64; 4] {
    let found = control(map, role, label).unwrap_or_else(|| panic!("no {role} \"{label}\""));
    std::array::from_fn(|i| found["rect"][i].as_f64().unwrap())
}

fn center(map: &Value, role: &str, label: &str) -> [f64; 2] {
    let [left, top, right, bottom] = rect(map, role, label);
    [(left + right) * 0.5, (top + bottom) * 0.5]
}

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

/// The display's one pointer, for one test at a time; `None` if it is not for tests.
fn display() -> Option<MutexGuard<'static, ()>> {
    static POINTER: Mutex<()> = Mutex::new(());
    if std::env::var_os("POSEWRIGHT_WINDOW_TEST").is_none() {
        eprintln!("left out: it drives a real pointer. `cargo xtask test` runs it on a display of its own.");
        return None;
    }
    Some(POINTER.lock().unwrap_or_else(PoisonError::into_inner))
}

#[test]
fn a_pose_is_made_by_hand_saved_and_opened_again() {
    let Some(_display) = display() else { return };
    let folder = tempfile::tempdir().unwrap();
    let window = Window::open(folder.path());
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
        let mut window = Window::open(folder.path());
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
    let window = Window::open(folder.path());
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
