//! Recorded sessions pose the figure from rest with the picture alone: in a harness, and on a real display by real
//! events.
//!
//! `UPDATE_SESSIONS=1` writes what comes of them to `docs/guide/poses`, from which the guide's pictures are made.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::{Duration, Instant};

use app::{Session, apply_theme, load};
use edit::Editor;
use egui::{Event, Modifiers, PointerButton, Pos2, vec2};
use egui_kittest::Harness;
use glam::{Vec2, Vec3};
use rig::{Camera, Figure, Pose, Projection};
use serde_json::Value;

use crate::program::{Window, display, xdotool};
use crate::recording::{Driver, Key, Recording, Seen};

const SESSIONS: [&str; 4] = ["arms-crossed", "phone-at-the-ear", "hands-on-hips", "thinker"];
/// Where a joint may be in a window of another size, metres: a pixel is 3 mm of the figure, and elbows swing farther than
/// what they hold on to.
const SAME_M: f64 = 0.015;
/// A window that has drawn nothing for so long has done all that was asked.
const PAUSE: Duration = Duration::from_millis(300);

fn project() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn recording(name: &str) -> Recording {
    let path =
        Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/window/sessions/{name}.session.ron"));
    Recording::parse(&std::fs::read_to_string(path).unwrap())
}

fn shown(name: &str) -> PathBuf {
    project().join(format!("docs/guide/poses/{name}.pose.ron"))
}

/// The pose is the one that the guide shows.
fn is_shown(name: &str, figure: &Figure, pose: &Pose) {
    let patch = rig::parse_pose(&std::fs::read_to_string(shown(name)).unwrap()).unwrap();
    let (kept, now) = (rig::frames(figure, &patch.onto(&figure.rest_pose())), rig::frames(figure, pose));
    for joint in figure.skeleton.joints() {
        let off = kept[joint.bone].position.distance(now[joint.bone].position);
        assert!(off < SAME_M, "{name}: {} is {:.1} mm off the pose in the guide", joint.bone, off * 1000.0);
    }
}

#[test]
fn recorded_sessions_pose_with_the_picture_alone() {
    let figure = load::figure(None).unwrap();
    for name in SESSIONS {
        let recording = recording(name);
        // What is meant does not depend on how large the window is.
        let mut large = HarnessHand::new(vec2(1400.0, 900.0));
        recording.check(name, &figure, &recording.play(&figure, &mut large));
        let mut hand = HarnessHand::new(vec2(1280.0, 800.0));
        let pose = recording.play(&figure, &mut hand);
        if std::env::var_os("UPDATE_SESSIONS").is_some() {
            std::fs::create_dir_all(shown(name).parent().unwrap()).unwrap();
            std::fs::write(shown(name), rig::write_pose(&figure, &pose)).unwrap();
        }
        recording.check(name, &figure, &pose);
        is_shown(name, &figure, &pose);
        hand.undo_all();
        assert_eq!(*hand.0.state().editor().pose(), figure.rest_pose(), "{name}: undo goes back to rest");
    }
}

#[test]
fn recorded_sessions_pose_by_real_events() {
    let Some(_display) = display() else { return };
    let figure = load::figure(None).unwrap();
    for name in SESSIONS {
        let folder = tempfile::tempdir().unwrap();
        let rest = folder.path().join("rest.pose.ron");
        std::fs::write(&rest, rig::write_pose(&figure, &figure.rest_pose())).unwrap();
        let mut hand = WindowHand { window: Window::open(folder.path(), &[&rest]), repeating: false };
        let recording = recording(name);
        recording.play(&figure, &mut hand);
        let path = folder.path().join("done.pose.ron");
        hand.window.keys("ctrl+shift+s");
        hand.window.keys("ctrl+a");
        hand.window.type_in(&path.display().to_string());
        hand.window.keys("Return");
        hand.window.until("a saved file", |map| map["title"] == "done.pose.ron – Posewright");
        let patch = rig::parse_pose(&std::fs::read_to_string(&path).unwrap()).unwrap();
        let pose = patch.onto(&figure.rest_pose());
        recording.check(name, &figure, &pose);
        is_shown(name, &figure, &pose);
    }
}

/// A session without a display.
struct HarnessHand(Harness<'static, Session>, Modifiers, Pos2);

impl HarnessHand {
    fn new(size: egui::Vec2) -> HarnessHand {
        let session = Session::new(Editor::new(load::figure(None).unwrap()), None);
        let mut hand = Harness::builder()
            .with_size(size)
            .with_pixels_per_point(1.0)
            .with_step_dt(0.05)
            .with_context_setup(apply_theme)
            .build_ui_state(|ui, session: &mut Session| session.ui(ui), session);
        hand.run();
        HarnessHand(hand, Modifiers::NONE, Pos2::ZERO)
    }

    fn event(&mut self, event: Event) {
        self.0.event_modifiers(event, self.1);
        self.0.step();
    }

    fn button(&mut self, pressed: bool) {
        let (pos, modifiers) = (self.2, self.1);
        self.event(Event::PointerButton { pos, button: PointerButton::Primary, pressed, modifiers });
        self.0.run();
    }

    fn undo_all(&mut self) {
        for _ in 0..self.0.state().editor().undo_depth() {
            self.0.state_mut().submit(edit::Request::Undo);
        }
    }
}

impl Driver for HarnessHand {
    fn seen(&mut self) -> Seen {
        self.0.run();
        let session = self.0.state();
        let (viewport, editor) = (&session.viewport, session.editor());
        let rect = viewport.rect();
        let handles = viewport.handle_places(editor, session.panels.selected());
        Seen {
            camera: viewport.camera,
            corner: Vec2::new(rect.left(), rect.top()),
            size: Vec2::new(rect.width(), rect.height()),
            pose: editor.pose().clone(),
            handles: handles.into_iter().map(|(name, at)| (name, Vec2::new(at.x, at.y))).collect(),
        }
    }

    fn to(&mut self, at: Vec2) {
        self.2 = Pos2::new(at.x.round(), at.y.round());
        self.event(Event::PointerMoved(self.2));
    }

    fn press(&mut self) {
        self.button(true);
    }

    fn release(&mut self) {
        self.button(false);
    }

    fn key(&mut self, name: &str) {
        let mut parts: Vec<&str> = name.split('+').collect();
        let key = parts
            .pop()
            .and_then(|key| egui::Key::from_name(&key.to_uppercase()).or(egui::Key::from_name(key)));
        let modifiers = parts.iter().fold(Modifiers::NONE, |all, part| {
            all | match *part {
                "ctrl" => Modifiers::COMMAND | Modifiers::CTRL,
                "shift" => Modifiers::SHIFT,
                _ => Modifiers::ALT,
            }
        });
        self.0.key_press_modifiers(modifiers, key.unwrap_or_else(|| panic!("no key {name}")));
        self.0.run();
    }

    fn hold(&mut self, key: Key, down: bool) {
        match key {
            Key::Ctrl => self.1 = if down { Modifiers::COMMAND | Modifiers::CTRL } else { Modifiers::NONE },
            Key::Shift => self.1 = if down { Modifiers::SHIFT } else { Modifiers::NONE },
            Key::C if down => self.0.key_down(egui::Key::C),
            Key::C => self.0.key_up(egui::Key::C),
        }
        let modifiers = self.1;
        self.event(Event::ModifiersChanged(modifiers));
        self.0.run();
    }

    fn type_in(&mut self, text: &str) {
        for letter in text.chars() {
            self.event(Event::Text(letter.to_string()));
        }
    }
}

/// The program on a display.
struct WindowHand {
    window: Window,
    /// A letter is held: it repeats, and frames go on coming.
    repeating: bool,
}

fn number(value: &Value) -> f32 {
    value.as_f64().map_or(f32::NAN, |number| number as f32)
}

fn place(value: &Value) -> Vec2 {
    Vec2::new(number(&value[0]), number(&value[1]))
}

fn camera(value: &Value) -> Camera {
    Camera {
        target: Vec3::from_array(std::array::from_fn(|i| number(&value["target"][i]))),
        yaw_rad: number(&value["yaw"]),
        pitch_rad: number(&value["pitch"]),
        distance: number(&value["distance"]),
        fov_y_rad: number(&value["fov"]),
        projection: match value["perspective"].as_bool() {
            Some(false) => Projection::Orthographic,
            _ => Projection::Perspective,
        },
    }
}

impl WindowHand {
    fn frame(&self) -> Option<u64> {
        self.window.map()?["frame"].as_u64()
    }

    /// Waits until another frame is drawn, as a hand waits for what it sees. Where nothing changes none may come.
    fn is_seen(&self, former: Option<u64>) {
        let start = Instant::now();
        while self.frame() == former && start.elapsed() < Duration::from_secs(1) {
            sleep(Duration::from_millis(20));
        }
        sleep(Duration::from_millis(40));
    }
}

impl Driver for WindowHand {
    fn seen(&mut self) -> Seen {
        let map = if self.repeating {
            sleep(Duration::from_secs(2));
            self.window.map().unwrap()
        } else {
            self.window.still_for(PAUSE)
        };
        let pose = rig::parse_pose(map["pose"].as_str().unwrap()).unwrap();
        let handles = map["handles"].as_object().unwrap();
        Seen {
            camera: camera(&map["camera"]),
            corner: place(&map["picture"]["from"]),
            size: place(&map["picture"]["to"]) - place(&map["picture"]["from"]),
            pose: pose.onto(&load::figure(None).unwrap().rest_pose()),
            handles: handles.iter().map(|(name, at)| (name.clone(), place(at))).collect::<BTreeMap<_, _>>(),
        }
    }

    fn to(&mut self, at: Vec2) {
        let frame = self.frame();
        self.window.to([f64::from(at.x), f64::from(at.y)]);
        self.is_seen(frame);
    }

    fn press(&mut self) {
        let frame = self.frame();
        xdotool(&["mousedown", "1"]);
        self.is_seen(frame);
    }

    fn release(&mut self) {
        let frame = self.frame();
        xdotool(&["mouseup", "1"]);
        self.is_seen(frame);
    }

    fn key(&mut self, name: &str) {
        // What came before must be seen: a key means what is chosen then.
        if !self.repeating {
            self.window.still_for(PAUSE);
        }
        let frame = self.frame();
        self.window.keys(&name.replace(']', "bracketright"));
        self.is_seen(frame);
    }

    fn hold(&mut self, key: Key, down: bool) {
        let name = match key {
            Key::Ctrl => "ctrl",
            Key::Shift => "shift",
            Key::C => "c",
        };
        self.repeating = down && key == Key::C;
        xdotool(&[if down { "keydown" } else { "keyup" }, name]);
        sleep(Duration::from_millis(200));
    }

    fn type_in(&mut self, text: &str) {
        self.window.type_in(text);
    }
}
