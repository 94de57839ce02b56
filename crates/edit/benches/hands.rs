//! From an event of the pointer to the finished command, on the mannequin with its skin; and picking alone.

#![allow(clippy::unwrap_used)] // helpers of benchmarks may unwrap too

#[path = "../../kin/benches/sampling/mod.rs"]
mod sampling;
#[path = "../../kin/tests/seeded/mod.rs"]
mod seeded;
#[path = "../tests/stage/mod.rs"]
mod stage;

use std::cell::RefCell;

use criterion::{Criterion, criterion_group, criterion_main};
use edit::{Command, Event, Hold, Knob, PosedSkin, Request, Sight};
use glam::Vec2;
use rig::{Bone, Camera, Dof, Limb, Space, View};
use sampling::each;
use seeded::Seeded;
use stage::{Table, figure};

/// Places of the picture, all of them on the figure.
fn places(table: &Table, seeded: &mut Seeded) -> Vec<Vec2> {
    let skin = PosedSkin::new(&table.editor);
    let size = table.sight.size_px.as_dvec2();
    let any = || Vec2::new(seeded.between(0.0, size.x) as f32, seeded.between(0.0, size.y) as f32);
    let on_skin = |at: &Vec2| skin.hit(&table.editor, table.sight.ray(*at)).is_some();
    std::iter::repeat_with(any).filter(on_skin).take(512).collect()
}

fn table() -> Table {
    let mut table = Table::new(figure());
    for limb in [Limb::LeftLeg, Limb::RightLeg] {
        table.submit(Request::Do(Command::Keep { limb, contact: Hold::Planted, space: Space::World }));
    }
    table
}

fn picking(c: &mut Criterion) {
    let mut seeded = Seeded(1);
    let mut table = table();
    let vertices = table.editor.figure().skin.as_ref().unwrap().vertex_count();
    assert!(vertices >= 20_000, "{vertices} vertices");
    for (name, distance) in [("the whole figure in sight", 3.6), ("from near", 1.0)] {
        let camera = Camera { distance, ..Camera::default().seen_from(View::ThreeQuarter) };
        table.sight = Sight { camera, ..table.sight };
        let (skin, all) = (PosedSkin::new(&table.editor), places(&table, &mut seeded));
        let mut next = all.iter().cycle();
        let ray = || table.sight.ray(*next.next().unwrap());
        each(c, &format!("pick, {vertices} vertices, {name}"), ray, |ray| skin.hit(&table.editor, *ray));
    }
}

fn hovering(c: &mut Criterion) {
    let mut table = table();
    let all = places(&table, &mut Seeded(2));
    table.selected = Some(Bone::LeftUpperArm);
    let mut next = all.into_iter().cycle();
    let table = RefCell::new(table);
    let place = || next.next().unwrap();
    each(c, "hover: rings, targets, joints, skin", place, |at| table.borrow_mut().tell(Event::Moved(*at)));
}

/// A drag that is under way, an event at a time, each submitted.
fn dragging(c: &mut Criterion, name: &str, mut table: Table, from: Vec2) {
    let mut seeded = Seeded(3);
    let shift = || Vec2::new(seeded.between(-60.0, 60.0) as f32, seeded.between(-60.0, 60.0) as f32);
    let all: Vec<Vec2> = std::iter::repeat_with(shift).map(|by| from + by).take(512).collect();
    table.hold(from, Vec2::new(20.0, 10.0));
    let mut next = all.into_iter().cycle();
    let table = RefCell::new(table);
    let place = || next.next().unwrap();
    each(c, name, place, |at| table.borrow_mut().tell(Event::Moved(*at)));
}

fn drags(c: &mut Criterion) {
    let mut hand = table();
    let at = hand.skin_of(Bone::LeftHand);
    dragging(c, "drag the hand's skin", hand, at);
    let target = table();
    let at = target.pixel(target.editor.evaluation().limbs[Limb::LeftArm.index()].target);
    dragging(c, "drag a target over surfaces", target, at);
    let mut hips = table();
    let at = hips.knob(Knob::Hips);
    dragging(c, "drag the hips over planted feet", hips, at);
    let mut ring = table();
    ring.selected = Some(Bone::LeftUpperArm);
    let at = ring.knob(Knob::Turn(Bone::LeftUpperArm, Dof::Flexion));
    dragging(c, "drag a ring of the shoulder", ring, at);
    let mut contact = table();
    let keep = Command::Keep { limb: Limb::LeftArm, contact: Hold::Point, space: Space::World };
    contact.submit(Request::Do(keep));
    contact.selected = Some(Bone::LeftHand);
    contact.modified(edit::Modifiers { in_contact: true, ..edit::Modifiers::default() });
    let at = contact.knob(Knob::InContact(Limb::LeftArm, Dof::Flexion));
    dragging(c, "drag a ring in contact", contact, at);
}

criterion_group! {
    name = hands;
    config = sampling::many_short();
    targets = picking, hovering, drags
}
criterion_main!(hands);
