//! Random events over hands and editor, as a window would pass them on: whatever they are, the promises hold after
//! each, and undoing everything gives back the very bits.
//!
//! `POSEWRIGHT_RANDOM_SECONDS=600 cargo test -p edit --test random_hands -- --nocapture` goes on for ten minutes, with
//! seeds that it prints.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod bits;
#[path = "../../kin/tests/seeded/mod.rs"]
mod seeded;
mod stage;

use std::sync::Arc;
use std::time::{Duration, Instant, SystemTime, UNIX_EPOCH};

use bits::bits;
use edit::{Axis, Command, Constraint, Event, Hold, Modifiers, Request};
use glam::{DVec3, Vec2};
use rig::{
    Articulation, Bone, Camera, Contact, Dof, Figure, Joint, Limb, Mechanics, Pose, Projection, Space, View,
};
use seeded::Seeded;
use stage::{Table, figure};

/// What happens next.
#[derive(Clone, Debug)]
enum Happens {
    Told(Event),
    Asked(Request),
    Chosen(Option<Bone>),
    Seen(Camera),
    Marked(bool),
}

fn pick<'a, T>(seeded: &mut Seeded, from: &'a [T]) -> &'a T {
    &from[(seeded.unit() * from.len() as f64) as usize]
}

/// A place of the picture: mostly one at which there is something.
fn place(seeded: &mut Seeded, table: &Table) -> Vec2 {
    let size = table.sight.size_px.as_dvec2();
    let anywhere = |s: &mut Seeded| {
        Vec2::new(s.between(-50.0, size.x + 50.0) as f32, s.between(-50.0, size.y + 50.0) as f32)
    };
    let frames = &table.editor.evaluation().frames;
    let near = |s: &mut Seeded, point: DVec3, far: f64| {
        let shift = Vec2::new(s.between(-far, far) as f32, s.between(-far, far) as f32);
        table.sight.pixel_of(point).map(|at| at + shift)
    };
    let found = match (seeded.unit() * 20.0) as usize {
        0..=6 => {
            let bone = *pick(seeded, &Bone::ALL);
            near(seeded, frames[bone].position, 12.0)
        }
        7..=9 => {
            let limb = *pick(seeded, &Limb::ALL);
            near(seeded, table.editor.evaluation().limbs[limb.index()].target, 6.0)
        }
        10..=15 => {
            let stage = table.stage();
            let knobs = table.hands.knobs(&stage);
            let knob = (!knobs.is_empty()).then(|| *pick(seeded, &knobs));
            knob.and_then(|knob| table.hands.place_of(&stage, &knob))
        }
        16 if seeded.unit() < 0.05 => Some(Vec2::new(f32::NAN, f32::INFINITY)),
        _ => None,
    };
    found.unwrap_or_else(|| anywhere(seeded))
}

fn event(seeded: &mut Seeded, table: &Table, at: &mut Vec2) -> Event {
    let dragging = table.hands.holds();
    match (seeded.unit() * 100.0) as usize {
        0..=44 if dragging || at.is_nan() => {
            let far = if seeded.unit() < 0.2 { 400.0 } else { 40.0 };
            let step = Vec2::new(seeded.between(-far, far) as f32, seeded.between(-far, far) as f32);
            *at = if at.is_finite() { *at + step } else { place(seeded, table) };
            Event::Moved(*at)
        }
        0..=54 => {
            *at = place(seeded, table);
            Event::Moved(*at)
        }
        55..=69 => Event::Pressed(*at),
        70..=77 => Event::Released,
        78..=80 => Event::Cancel,
        81 => Event::Commit,
        82..=87 => {
            let on = |s: &mut Seeded| s.unit() < 0.25;
            Event::Modified(Modifiers { slow: on(seeded), snap: on(seeded), in_contact: on(seeded) })
        }
        88..=91 => {
            let axis = *pick(seeded, &Axis::ALL);
            let ways = [Constraint::View, Constraint::Along(axis), Constraint::Across(axis)];
            Event::Constrain(*pick(seeded, &ways))
        }
        92..=96 => Event::Typed(*pick(seeded, &['0', '1', '2', '5', '9', '.', '-', 'x', ','])),
        97..=98 => Event::Backspace,
        _ => Event::Left,
    }
}

fn camera(seeded: &mut Seeded) -> Camera {
    let mut camera = Camera::default().seen_from(*pick(seeded, &View::ALL));
    if seeded.unit() < 0.5 {
        camera.orbit(seeded.between(-3.0, 3.0) as f32, seeded.between(-1.5, 1.5) as f32);
    }
    camera.distance = seeded.between(0.5, 6.0) as f32;
    camera.target.y = seeded.between(0.1, 1.6) as f32;
    if seeded.unit() < 0.3 {
        camera.projection = Projection::Orthographic;
    }
    camera
}

fn request(seeded: &mut Seeded) -> Request {
    match (seeded.unit() * 9.0) as usize {
        0 | 1 => Request::Undo,
        2 => Request::Redo,
        3 => Request::Symmetry(seeded.unit() < 0.5),
        4 => Request::Lock((*pick(seeded, &Bone::ALL)).into(), seeded.unit() < 0.3),
        5 => Request::Mechanics(Mechanics {
            collar_rhythm: seeded.unit() < 0.5,
            torso_follow: if seeded.unit() < 0.5 { 0.0 } else { seeded.unit() },
        }),
        _ => {
            let limb = *pick(seeded, &Limb::ALL);
            let contact = *pick(seeded, &[Hold::Free, Hold::Point, Hold::Planted]);
            let spaces = [Space::World, Space::Body(Bone::Head), Space::Body(Bone::Hips)];
            Request::Do(Command::Keep { limb, contact, space: *pick(seeded, &spaces) })
        }
    }
}

fn happening(seeded: &mut Seeded, table: &Table, at: &mut Vec2) -> Happens {
    match (seeded.unit() * 100.0) as usize {
        0..=2 => {
            let bone = *pick(seeded, &Bone::ALL);
            Happens::Chosen((seeded.unit() < 0.9).then_some(bone))
        }
        3..=5 => Happens::Asked(request(seeded)),
        6 => Happens::Seen(camera(seeded)),
        7 if seeded.unit() < 0.2 => Happens::Marked(!table.marks),
        _ => Happens::Told(event(seeded, table, at)),
    }
}

/// How far the angles of a joint are outside its range, degrees.
fn excess(joint: &Joint, pose: &Pose) -> f64 {
    let angles = pose.angles(joint.bone);
    let interval = |dof: Dof| joint.range(dof).map_or(0.0, |range| range.excess(angles.get(dof)));
    match &joint.articulation {
        Articulation::Ball { cone: Some(cone), .. } => {
            let bone = joint.rotation(angles) * joint.bone_direction().unwrap();
            (cone.angle(bone) - cone.half_angle).to_degrees().max(interval(Dof::Twist))
        }
        _ => Dof::ALL.map(interval).into_iter().fold(0.0, f64::max),
    }
}

fn check(table: &Table, outside: &[f64]) {
    let (figure, pose): (&Figure, &Pose) = (table.editor.figure(), table.editor.pose());
    assert!(bits(pose).iter().all(|bits| f64::from_bits(*bits).is_finite()), "{pose:?}");
    let evaluation = table.editor.evaluation();
    assert!(evaluation.frames.0.iter().all(|f| f.position.is_finite() && f.rotation.is_finite()));
    for (joint, first) in figure.skeleton.joints().zip(outside) {
        let now = excess(joint, pose);
        assert!(now <= first.max(0.0) + 1e-5, "{} is {now}° outside of its range", joint.bone);
    }
    for limb in Limb::ALL {
        check_contact(table, limb);
    }
    assert!(!table.editor.in_gesture() || table.hands.is_dragging(), "a gesture without a hand");
}

/// A point that is missed is out of reach, or the ranges are in the way: without them it is met.
fn check_contact(table: &Table, limb: Limb) {
    let (figure, pose) = (table.editor.figure(), table.editor.pose());
    let view = &table.editor.evaluation().limbs[limb.index()];
    let Contact::Point { space, target } = pose.limb(limb).contact else { return };
    if view.residual < 1e-5 {
        return;
    }
    let limits = rig::reach_limits(figure, pose, &table.editor.evaluation().frames, limb, true);
    let far = limits.map(|limits| limits.root_in_world.distance(view.target));
    let within = limits.zip(far).is_some_and(|(l, far)| far > l.inner_m + 1e-4 && far < l.outer_m - 1e-4);
    if within {
        let goal = rig::Target { space, point: target };
        let free = rig::reach(figure, pose, limb, goal, false).unwrap().pose;
        let here = rig::articulator_in(figure, &free, limb, Space::World);
        assert!(here.distance(view.target) < 1e-5, "{limb:?} misses what it can reach");
    }
}

/// What one event may do to gesture and history.
fn check_history(before: &Table, table: &Table, happens: &Happens, begun: &mut Option<Pose>) {
    let (was, is) = (before.editor.undo_depth(), table.editor.undo_depth());
    match happens {
        Happens::Told(Event::Released | Event::Commit | Event::Pressed(_)) => {
            assert!(is == was || is == was + 1, "{was} steps became {is}");
            assert!(!table.editor.in_gesture() || !matches!(happens, Happens::Told(Event::Released)));
        }
        Happens::Told(event) => {
            assert_eq!(was, is, "{event:?} is no step");
            if *event == Event::Cancel
                && let Some(pose) = begun.as_ref()
            {
                assert_eq!(bits(table.editor.pose()), bits(pose), "cancelled");
                assert_eq!(table.editor.pose(), pose, "cancelled");
            }
        }
        Happens::Asked(_) => {}
        _ => assert_eq!(before.editor.pose(), table.editor.pose(), "{happens:?} moves nothing"),
    }
    if before.hands.is_dragging() && table.hands.is_dragging() {
        assert_eq!(before.hands.sight(), table.hands.sight(), "the sight of a drag stays");
    }
    if !table.editor.in_gesture() {
        *begun = None;
    } else if !before.editor.in_gesture() {
        *begun = Some(before.editor.pose().clone());
    }
}

fn run(seed: u64, events: usize, figure: &Arc<Figure>) -> usize {
    let mut seeded = Seeded(seed);
    let mut table = Table::new(figure.clone());
    let first = table.pose();
    let outside: Vec<f64> = figure.skeleton.joints().map(|joint| excess(joint, &first)).collect();
    let (mut at, mut begun, mut steps) = (Vec2::splat(400.0), None, 0);
    for _ in 0..events {
        let happens = happening(&mut seeded, &table, &mut at);
        let before = Table {
            editor: table.editor.clone(),
            hands: table.hands.clone(),
            sight: table.sight,
            selected: table.selected,
            marks: table.marks,
        };
        match happens.clone() {
            Happens::Told(event) => {
                table.tell(event);
            }
            Happens::Asked(request) => {
                table.submit(request);
            }
            Happens::Chosen(bone) => table.selected = bone,
            Happens::Seen(camera) => table.sight.camera = camera,
            Happens::Marked(marks) => table.marks = marks,
        }
        table.look();
        check_history(&before, &table, &happens, &mut begun);
        check(&table, &outside);
        steps = steps.max(table.editor.undo_depth());
    }
    table.tell(Event::Cancel);
    table.tell(Event::Released);
    while table.editor.undo_depth() > 0 {
        table.submit(Request::Undo);
    }
    assert_eq!(bits(table.editor.pose()), bits(&first), "undoing everything");
    assert_eq!(*table.editor.pose(), first, "undoing everything");
    steps
}

#[test]
fn twenty_thousand_random_events_keep_the_promises() {
    let figure = figure();
    let steps: usize = (0..10).map(|seed| run(seed, 2_000, &figure)).sum();
    assert!(steps > 400, "{steps} steps: the events do something");
}

#[test]
fn as_many_as_there_is_time_for_when_asked() {
    let Ok(asked) = std::env::var("POSEWRIGHT_RANDOM_SECONDS") else { return };
    let seconds: u64 = asked.parse().expect("POSEWRIGHT_RANDOM_SECONDS is a number of seconds");
    let (figure, begun) = (figure(), Instant::now());
    let mut seed = SystemTime::now().duration_since(UNIX_EPOCH).unwrap().as_micros() as u64;
    while begun.elapsed() < Duration::from_secs(seconds) {
        println!("seed {seed}");
        run(seed, 2_000, &figure);
        seed += 1;
    }
}
