//! The program at work on a real display, and what it says of its controls.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread::sleep;
use std::time::{Duration, Instant};

use serde_json::Value;

/// Nothing here takes longer.
pub const PATIENCE: Duration = Duration::from_secs(40);

/// The program at work, and what it says of its controls. It ends with this value.
pub struct Window {
    pub child: Child,
    id: String,
    pub map_path: PathBuf,
}

impl Drop for Window {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

pub fn xdotool(arguments: &[&str]) -> String {
    let output = Command::new("xdotool").args(arguments).output().expect("xdotool");
    assert!(output.status.success(), "xdotool {arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap().trim().to_owned()
}

impl Window {
    pub fn open(folder: &Path, files: &[&Path]) -> Window {
        let map_path = folder.join("map.json");
        let child = Command::new(env!("CARGO_BIN_EXE_posewright"))
            .arg("--ui-map")
            .arg(&map_path)
            .args(files)
            .env("XDG_DATA_HOME", folder.join("data"))
            .env("XDG_CONFIG_HOME", folder.join("config"))
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

    pub fn map(&self) -> Option<Value> {
        serde_json::from_str(&std::fs::read_to_string(&self.map_path).ok()?).ok()
    }

    /// Waits until the map says so.
    pub fn until(&self, what: &str, holds: impl Fn(&Value) -> bool) -> Value {
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
    pub fn at_rest(&self) -> Value {
        self.still_for(Duration::from_millis(700))
    }

    /// Waits until no frame has come for so long.
    pub fn still_for(&self, pause: Duration) -> Value {
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
            sleep(pause);
        }
    }

    pub fn to(&self, [x, y]: [f64; 2]) {
        xdotool(&["mousemove", "--window", &self.id, &x.round().to_string(), &y.round().to_string()]);
        sleep(Duration::from_millis(120));
    }

    pub fn click(&self, at: [f64; 2]) {
        self.to(at);
        xdotool(&["click", "1"]);
        sleep(Duration::from_millis(150));
    }

    pub fn drag(&self, from: [f64; 2], by: [f64; 2]) {
        self.to(from);
        xdotool(&["mousedown", "1"]);
        for i in 1..=5 {
            let t = f64::from(i) / 5.0;
            self.to([from[0] + by[0] * t, from[1] + by[1] * t]);
        }
        xdotool(&["mouseup", "1"]);
        sleep(Duration::from_millis(150));
    }

    pub fn keys(&self, keys: &str) {
        xdotool(&["key", keys]);
        sleep(Duration::from_millis(200));
    }

    pub fn type_in(&self, words: &str) {
        xdotool(&["type", "--delay", "15", "--", words]);
        sleep(Duration::from_millis(200));
    }

    /// The picture of the figure as it is on the screen: RGB, row by row. The pointer is out of the way, where nothing
    /// has a tooltip.
    pub fn picture(&self) -> Vec<u8> {
        self.to([700.0, 60.0]);
        let map = self.at_rest();
        let [left, top, right, bottom] = rect(&map, "Canvas", "Figure").map(f64::round);
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

pub fn control<'a>(map: &'a Value, role: &str, label: &str) -> Option<&'a Value> {
    map["controls"].as_array()?.iter().find(|c| c["role"] == role && c["label"] == label)
}

pub fn rect(map: &Value, role: &str, label: &str) -> [f64; 4] {
    let found = control(map, role, label).unwrap_or_else(|| panic!("no {role} \"{label}\""));
    std::array::from_fn(|i| found["rect"][i].as_f64().unwrap())
}

pub fn center(map: &Value, role: &str, label: &str) -> [f64; 2] {
    let [left, top, right, bottom] = rect(map, role, label);
    [(left + right) * 0.5, (top + bottom) * 0.5]
}

/// The display's one pointer, for one test at a time; `None` if it is not for tests.
pub fn display() -> Option<MutexGuard<'static, ()>> {
    static POINTER: Mutex<()> = Mutex::new(());
    if std::env::var_os("POSEWRIGHT_WINDOW_TEST").is_none() {
        eprintln!("left out: it drives a real pointer. `cargo xtask test` runs it on a display of its own.");
        return None;
    }
    Some(POINTER.lock().unwrap_or_else(PoisonError::into_inner))
}
