//! Nothing lost: a program killed at any moment offers the last committed pose.
//!
//! The parent starts this test binary again as a child that commits one gesture after another in a real session, kills
//! it, and opens a session of its own on what is left.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::io::{BufRead as _, BufReader, Write as _};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use app::{Session, apply_theme, load};
use edit::{By, Editor, Request};
use egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, vec2};
use rig::{Bone, Dof};

const FOLDER: &str = "POSEWRIGHT_KILLED_FOLDER";
const SEED: &str = "POSEWRIGHT_KILLED_SEED";
const KILLS: u64 = 20;
/// Children side by side.
const LANES: u64 = 2;
/// The longest that a child lives after its first commit.
const LONGEST_MS: u64 = 1500;

/// A small generator: the tests need no better one.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % bound
    }
}

fn hash(text: &str) -> u64 {
    let mut hasher = DefaultHasher::new();
    text.hash(&mut hasher);
    hasher.finish()
}

fn session() -> Session {
    Session::new(Editor::new(load::figure(None).unwrap()), None)
}

/// One frame of the window with what happened in it.
fn frame(ctx: &Context, session: &mut Session, events: Vec<Event>) {
    let rect = Rect::from_min_size(Pos2::ZERO, vec2(1000.0, 700.0));
    let input = RawInput { screen_rect: Some(rect), focused: true, events, ..RawInput::default() };
    let mut output = ctx.run_ui(input, |ui| session.ui(ui));
    output.textures_delta.clear();
}

/// A button that does nothing in the status line goes down or up: gestures last as long as it is down.
fn button(pressed: bool) -> Vec<Event> {
    let pos = Pos2::new(500.0, 690.0);
    let button = PointerButton::Secondary;
    vec![Event::PointerMoved(pos), Event::PointerButton { pos, button, pressed, modifiers: Modifiers::NONE }]
}

/// Says a line that is out of the process before anything else happens.
fn say(words: &str) {
    let mut out = std::io::stdout().lock();
    writeln!(out, "\n{words}").unwrap();
    out.flush().unwrap();
}

/// Commits gestures until it is killed: the child of the other test. Without a folder from there, it has nothing to do.
#[test]
fn child() {
    let Some(folder) = std::env::var_os(FOLDER).map(PathBuf::from) else { return };
    let mut random = Random(std::env::var(SEED).unwrap().parse().unwrap());
    let ctx = Context::default();
    apply_theme(&ctx);
    let mut session = session();
    session.keep_in(&folder);
    frame(&ctx, &mut session, Vec::new());
    for number in 0u64.. {
        let joint = [Bone::LeftLowerArm, Bone::RightLowerArm, Bone::LeftLowerLeg][random.below(3) as usize];
        frame(&ctx, &mut session, button(true));
        for _ in 0..=random.below(3) {
            let degrees = random.below(100_000) as f64 / 1000.0;
            let turn = edit::Command::Turn { joint, dof: Dof::Flexion, degrees, by: By::To };
            session.submit(Request::Preview(turn));
            frame(&ctx, &mut session, Vec::new());
        }
        assert!(session.editor().in_gesture());
        let text = rig::write_pose(session.editor().figure(), session.editor().pose());
        say(&format!("commits {number} {}", hash(&text)));
        frame(&ctx, &mut session, button(false));
        assert!(!session.editor().in_gesture());
        say(&format!("committed {number}"));
    }
}

fn spawn(folder: &Path, seed: u64) -> Child {
    Command::new(std::env::current_exe().unwrap())
        .args(["child", "--exact", "--nocapture"])
        .env(FOLDER, folder)
        .env(SEED, seed.to_string())
        .stdin(Stdio::null())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// What a child said: the poses that it was about to commit, and how many commits it had done.
#[derive(Default)]
struct Said {
    poses: Vec<u64>,
    committed: usize,
}

impl Said {
    fn hear(&mut self, line: &str) {
        match line.split(' ').collect::<Vec<_>>()[..] {
            ["commits", number, hash] => {
                assert_eq!(number.parse(), Ok(self.poses.len()));
                self.poses.push(hash.parse().unwrap());
            }
            ["committed", number] => self.committed = number.parse::<usize>().unwrap() + 1,
            _ => {}
        }
    }
}

/// Lets a child work for a while and kills it; what it said until then.
fn killed(folder: &Path, seed: u64, after: Duration) -> Said {
    let mut child = spawn(folder, seed);
    let lines = BufReader::new(child.stdout.take().unwrap()).lines();
    let said = Mutex::new(Said::default());
    std::thread::scope(|scope| {
        let listener = scope.spawn(|| {
            for line in lines.map_while(Result::ok) {
                said.lock().unwrap().hear(&line);
            }
        });
        let start = Instant::now();
        while said.lock().unwrap().committed == 0 {
            assert!(start.elapsed() < Duration::from_secs(60), "the child commits nothing");
            std::thread::sleep(Duration::from_millis(5));
        }
        std::thread::sleep(after);
        child.kill().unwrap();
        child.wait().unwrap();
        listener.join().unwrap();
    });
    said.into_inner().unwrap()
}

fn kill_and_look(seed: u64) {
    let folder = tempfile::tempdir().unwrap();
    let after = Duration::from_micros(Random(seed).below(LONGEST_MS * 1000));
    let said = killed(folder.path(), seed, after);
    let mut next = session();
    next.keep_in(folder.path());
    let offered = next.offered().expect("a pose is offered");
    rig::parse_pose(offered).expect("it is whole");
    let found = said.poses.iter().rposition(|pose| *pose == hash(offered));
    let found = found.expect("it is one that was committed");
    assert!(
        found + 1 >= said.committed,
        "commit {} of {} is offered, after {after:?}",
        found + 1,
        said.committed
    );
    next.end();
}

#[test]
fn a_program_killed_at_twenty_moments_offers_the_last_committed_pose_each_time() {
    std::thread::scope(|scope| {
        for lane in 0..LANES {
            scope.spawn(move || (lane..KILLS).step_by(LANES as usize).for_each(kill_and_look));
        }
    });
}
