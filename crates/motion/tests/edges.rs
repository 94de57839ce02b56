//! The shipped walk over edges: no part of a sole goes through ground that the foot doesn't stand on or leave.

#![allow(clippy::unwrap_used, clippy::print_stdout)] // helpers of tests may unwrap, and show what was measured

mod figures;

use std::path::PathBuf;
use std::sync::{Arc, LazyLock};

use glam::DVec3;
use motion::{
    FittedClip, Ground, GroundKind, Sole, Steering, Tree, Walker, parse_clip, parse_plan, read_tree,
};
use rig::{Figure, Place};

const RATE: f64 = 60.0;

static MANNEQUIN: LazyLock<(Arc<Figure>, Arc<Tree>)> = LazyLock::new(|| {
    let figure = figures::shipped("mannequin");
    let read = |name: &str| {
        let assets = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../assets");
        std::fs::read_to_string(assets.join(name)).unwrap()
    };
    let text = read("blend/walk.blend.ron");
    let clip = |name: &&str| {
        let clip = parse_clip(&read(&format!("clips/{name}.clip.ron"))).unwrap();
        Arc::new(FittedClip::new(&clip, &figure, &figure).unwrap())
    };
    let clips: Vec<Arc<FittedClip>> = parse_plan(&text).unwrap().clip_names().iter().map(clip).collect();
    let tree = read_tree(&text, &clips).unwrap();
    (Arc::new(figure), Arc::new(tree))
});

/// Where a part of a foot stands or last stood: a place on the ground and the ground's normal there.
#[derive(Clone, Copy)]
struct Print {
    at: DVec3,
    normal: DVec3,
}

impl Print {
    fn under(ground: &Ground, point: DVec3) -> Print {
        let found = ground.under(point.x, point.z);
        Print { at: DVec3::new(point.x, found.height, point.z), normal: found.normal }
    }

    /// Whether the ground under a point is the same tread or stone.
    fn holds(&self, ground: &Ground, point: DVec3) -> bool {
        let other = Print::under(ground, point);
        (other.at - self.at).dot(self.normal).abs() < 1e-3 && other.normal.distance(self.normal) < 1e-3
    }
}

/// The deepest that a sole was in the ground.
#[derive(Clone, Copy, Debug, Default)]
struct Deepest {
    mm: f64,
    secs: f64,
    side: usize,
    point: usize,
    /// Frames with a point deeper than 10 mm.
    frames: usize,
}

impl std::fmt::Display for Deepest {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Deepest { mm, secs, side, point, frames } = self;
        write!(f, "{mm:.1} mm at {secs:.1} s, side {side} point {point}, {frames} frames beyond 10")
    }
}

impl Deepest {
    fn take(&mut self, now: Deepest) {
        let frames = self.frames + usize::from(now.mm > 10.0);
        *self = if now.mm > self.mm { Deepest { frames, ..now } } else { Deepest { frames, ..*self } };
    }
}

/// The deepest in ground elsewhere, and in the ground that the foot stands on or left.
fn walked(ground: &Ground, start: Place, speed: f64, secs: f64) -> [Deepest; 2] {
    let (figure, tree) = &*MANNEQUIN;
    let mut walker = Walker::new(figure.clone(), tree.clone());
    walker.set_place(start);
    let mut prints: [Vec<Print>; 2] = Default::default();
    let mut deepest = [Deepest::default(); 2];
    for frame in 0..(secs * RATE) as usize {
        walker.step(ground, &Steering::ahead(speed), 1.0 / RATE);
        for (side, foot) in walker.feet(ground).iter().enumerate() {
            let bearing = walker.flat().bearing[side];
            let stands = [(bearing.heel, Sole::HEEL), (bearing.ball, Sole::BALL)];
            let stands: Vec<usize> = stands.into_iter().filter(|(b, _)| *b > 0.5).map(|(_, i)| i).collect();
            if !stands.is_empty() {
                prints[side] =
                    stands.into_iter().map(|i| Print::under(ground, foot.sole_in_world[i])).collect();
            }
            let mut now = [Deepest::default(); 2];
            for (point, (at, height)) in foot.sole_in_world.iter().zip(&foot.ground_under_sole).enumerate() {
                let own = prints[side].iter().any(|print| print.holds(ground, *at));
                let found = &mut now[usize::from(own)];
                let mm = 1e3 * (height - at.y);
                if mm > found.mm {
                    *found = Deepest { mm, secs: frame as f64 / RATE, side, point, frames: 0 };
                }
            }
            (0..2).for_each(|i| deepest[i].take(now[i]));
        }
    }
    deepest
}

/// No edge reaches into a sole, and toes that leave the ground are hardly in it.
fn clears(what: &str, ground: &Ground, start: Place, speed: f64) -> bool {
    let [elsewhere, own] = walked(ground, start, speed, 60.0);
    let clear = elsewhere.mm <= 10.0 && own.mm <= 16.0;
    println!("{what}, {speed} m/s: edges {elsewhere}; own {own}{}", if clear { "" } else { "  <--" });
    clear
}

#[test]
fn on_stairs_soles_clear_every_edge() {
    let ground = GroundKind::Stairs.ground(1);
    let mut clear = true;
    // Steps come down elsewhere on the treads.
    for z in [0.0, 0.11, 0.22] {
        let start = Place { position: DVec3::new(0.0, 0.0, z), turn: 0.0 };
        for speed in [1.0, 1.4] {
            clear &= clears(&format!("stairs from {z}"), &ground, start, speed);
        }
    }
    assert!(clear, "some sole is in an edge or in its own print");
}

#[test]
fn on_stones_soles_clear_every_edge() {
    let mut clear = true;
    for seed in 1..=6 {
        for speed in [1.0, 1.4] {
            let ground = GroundKind::Stones.ground(seed);
            clear &= clears(&format!("stones {seed}"), &ground, Place::default(), speed);
        }
    }
    assert!(clear, "some sole is in an edge or in its own print");
}
