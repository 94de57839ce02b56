//! Steps of trees and walkers allocate nothing after the first.

#![allow(unsafe_code)] // an allocator that counts can't be written without
#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod figures;
mod gaits;

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::sync::Arc;

use motion::{Ground, Steering, TreeState, Walker, read_tree};

thread_local! {
    static ALLOCATIONS: Cell<usize> = const { Cell::new(0) };
}

/// The system's allocator, and how often this thread has asked it for memory.
struct Counting;

// SAFETY: every call is handed on unchanged; the counter is a plain number without a destructor.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, memory: *mut u8, layout: Layout) {
        unsafe { System.dealloc(memory, layout) }
    }

    unsafe fn realloc(&self, memory: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        unsafe { System.realloc(memory, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations(of: impl FnOnce()) -> usize {
    let before = ALLOCATIONS.with(Cell::get);
    of();
    ALLOCATIONS.with(Cell::get) - before
}

const TREE: &str = r#"(version: 1, root: FootPlacement(node: States(
    initial: "moving",
    states: [
        ("moving", Additive(
            base: Blend(by: [Forward, Sideways, Turn], points: [
                ((0, 0, 0), Clip(name: "idle")), ((1.4, 0, 0), Clip(name: "walk")), ((2.8, 0, 0), Clip(name: "jog")),
                ((0, 1, 0), Clip(name: "left")), ((0, -1, 0), Mirror(node: Clip(name: "left"))),
                ((0, 0, 60), Clip(name: "turn")), ((0, 0, -60), Clip(name: "turn", mirrored: true)),
            ]),
            layer: Clip(name: "wave"), less: Clip(name: "idle"), by: (Slope, 5),
        )),
        ("sitting", Mask(
            base: Crossfade(by: Slope, over: (-5, 5), from: Clip(name: "sit"), to: Clip(name: "idle")),
            layer: Clip(name: "wave"), parts: ["leftArm"],
        )),
    ],
    transitions: [
        (from: "moving", to: "sitting", when: [Sit], secs: 0.4),
        (from: "sitting", to: "moving", when: [Stand], secs: 0.2),
    ],
)))"#;

/// Steering that passes through every node, and through transitions that are interrupted.
fn steering(i: usize) -> Steering {
    let t = i as f64 / 60.0;
    Steering {
        speed: 1.5,
        forward: 1.5 + 1.5 * (0.7 * t).sin(),
        sideways: (1.3 * t).sin(),
        turn: 80.0 * (0.9 * t).sin(),
        slope: 8.0 * (2.1 * t).sin(),
        sit: (i / 13) % 3 == 1,
    }
}

#[test]
fn the_counter_counts() {
    assert_eq!(allocations(|| drop(vec![1, 2, 3])), 1);
}

#[test]
fn steps_of_a_tree_allocate_nothing() {
    let figure = figures::shipped("mannequin");
    let tree = read_tree(TREE, &gaits::clips(&figure, &figure)).unwrap();
    let mut state = TreeState::new(&tree);
    let count = allocations(|| (0..600).for_each(|i| tree.step(&mut state, &steering(i), 1.0 / 60.0)));
    assert_eq!(count, 0);
    let mut weight = 0.0;
    assert_eq!(allocations(|| weight = tree.outline(&state).map(|node| node.weight).sum()), 0);
    assert!(weight > 1.0);
}

#[test]
fn steps_of_a_walker_allocate_nothing_after_the_first() {
    let figure = Arc::new(figures::shipped("mannequin"));
    let tree = Arc::new(read_tree(TREE, &gaits::clips(&figure, &figure)).unwrap());
    let mut walker = Walker::new(figure, tree);
    walker.step(&Ground::Flat, &steering(0), 1.0 / 60.0);
    let count = allocations(|| {
        for i in 1..600 {
            walker.feet_on_ground = i % 100 < 70;
            walker.step(&Ground::Flat, &steering(i), 1.0 / 60.0);
        }
    });
    assert_eq!(count, 0);
}
