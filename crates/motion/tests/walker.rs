//! A walker goes where it is steered, and nothing that is switched while it walks makes it jump.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod figures;
mod gaits;

use std::sync::{Arc, LazyLock};

use motion::{Ground, GroundKind, Steering, Walker, read_tree};
use rig::{Bone, Figure, Place};

static FIGURE: LazyLock<Arc<Figure>> = LazyLock::new(|| Arc::new(figures::shipped("mannequin")));

const TREE: &str = r#"(version: 1, root: FootPlacement(node: Blend(by: [Forward, Sideways, Turn], points: [
    ((0, 0, 0), Clip(name: "idle")), ((1.4, 0, 0), Clip(name: "walk")), ((2.8, 0, 0), Clip(name: "jog")),
    ((0, 1, 0), Clip(name: "left")), ((0, -1, 0), Mirror(node: Clip(name: "left"))),
    ((0, 0, 60), Clip(name: "turn")), ((0, 0, -60), Clip(name: "turn", mirrored: true)),
])))"#;

fn walker(text: &str) -> Walker {
    let tree = read_tree(text, &gaits::clips(&FIGURE, &FIGURE)).unwrap();
    Walker::new(FIGURE.clone(), Arc::new(tree))
}

fn go(walker: &mut Walker, steering: &Steering, secs: f64) {
    (0..(secs * 100.0) as usize).for_each(|_| walker.step(&Ground::Flat, steering, 0.01));
}

fn near(place: Place, x: f64, z: f64, turn: f64) {
    let off = (place.position.x - x).hypot(place.position.z - z);
    assert!(off < 2e-3 && (place.turn - turn).abs() < 0.1, "{place:?}");
}

#[test]
fn it_goes_ahead_to_its_left_and_around() {
    let mut walker = walker(TREE);
    go(&mut walker, &Steering::ahead(1.4), 2.0);
    near(walker.place(), 0.0, 2.8, 0.0);
    let left = Steering { speed: 1.0, sideways: 1.0, ..Steering::default() };
    go(&mut walker, &left, 1.0);
    near(walker.place(), 1.0, 2.8, 0.0);
    let turn = Steering { turn: 60.0, ..Steering::default() };
    go(&mut walker, &turn, 1.5);
    near(walker.place(), 1.0, 2.8, 90.0);
    // Facing +X now.
    go(&mut walker, &Steering::ahead(1.4), 1.0);
    near(walker.place(), 2.4, 2.8, 90.0);
    let right = Steering { speed: 1.0, sideways: -1.0, ..Steering::default() };
    go(&mut walker, &right, 1.0);
    near(walker.place(), 2.4, 3.8, 90.0);
}

#[test]
fn a_walk_that_turns_besides_goes_around_a_circle() {
    let mut walker = walker("(version: 1, root: Clip(name: \"walk\", turn: 36))");
    go(&mut walker, &Steering::default(), 10.0);
    near(walker.place(), 0.0, 0.0, 0.0);
    go(&mut walker, &Steering::default(), 5.0);
    // Half of it, to the left: the diameter is 1.4 m/s · 10 s / π.
    let place = walker.place();
    assert!((place.position.x - 14.0 / std::f64::consts::PI).abs() < 0.01, "{place:?}");
}

#[test]
fn hostile_numbers_leave_it_finite() {
    let mut walker = walker(TREE);
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300] {
        let steering =
            Steering { speed: value, forward: value, sideways: value, turn: value, slope: value, sit: true };
        for dt_secs in [f64::NAN, -1.0, 1e300, 0.01] {
            walker.step(&Ground::Flat, &steering, dt_secs);
            assert!(walker.place().position.is_finite() && walker.pose().hips.is_finite());
        }
    }
    walker.set_place(Place { position: glam::DVec3::NAN, turn: f64::INFINITY });
    assert_eq!(walker.place(), Place::default());
}

/// The farthest that a joint's angle goes in a step.
fn farthest(before: &Walker, after: &Walker) -> f64 {
    let pairs = before.pose().angles.iter().zip(&after.pose().angles);
    pairs
        .map(|(a, b)| (a.flexion - b.flexion).abs().max((a.abduction - b.abduction).abs()))
        .fold(0.0, f64::max)
}

#[test]
fn switching_the_feet_s_placement_makes_no_jump() {
    let slope = GroundKind::Slope.ground(0);
    let mut walker = walker(TREE);
    // Somewhere up the slope, and standing for a while.
    (0..140).for_each(|_| walker.step(&slope, &Steering::ahead(1.4), 0.01));
    (0..200).for_each(|_| walker.step(&slope, &Steering::default(), 0.01));
    let mut greatest: f64 = 0.0;
    for i in 0..1200 {
        walker.feet_on_ground = (i / 170) % 2 == 0;
        let before = walker.clone();
        walker.step(&slope, &Steering::default(), 0.005);
        greatest = greatest.max(farthest(&before, &walker));
        let rise = (walker.pose().hips.y - before.pose().hips.y).abs();
        assert!(rise < 0.005, "{i}: {rise} m");
    }
    assert!((0.05..2.5).contains(&greatest), "{greatest} degrees in 5 ms");
    walker.feet_on_ground = false;
    go(&mut walker, &Steering::default(), 0.5);
    walker.step(&slope, &Steering::default(), 0.01);
    let Place { position, .. } = walker.place();
    let over_ground = walker.pose().hips.y - slope.under(position.x, position.z).height;
    assert!((over_ground - walker.flat().hips.y).abs() < 1e-12, "it rides on the ground under it");
}

#[test]
fn a_reload_while_walking_makes_no_jump() {
    let mut walker = walker(TREE);
    go(&mut walker, &Steering::ahead(1.2), 1.3);
    let before = walker.clone();
    let tree = read_tree(TREE, &gaits::clips(&FIGURE, &FIGURE)).unwrap();
    walker.replace_tree(Arc::new(tree));
    assert_eq!(walker.pose(), before.pose());
    assert_eq!(walker.state().phase(), before.state().phase());
    let mut unchanged = before.clone();
    walker.step(&Ground::Flat, &Steering::ahead(1.2), 0.01);
    unchanged.step(&Ground::Flat, &Steering::ahead(1.2), 0.01);
    assert_eq!(walker.pose(), unchanged.pose());
    assert_ne!(walker.pose().angles(Bone::LeftUpperLeg), before.pose().angles(Bone::LeftUpperLeg));
}
