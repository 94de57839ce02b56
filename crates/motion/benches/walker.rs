//! One walker: a step of its tree alone, and the whole step with its feet placed.

#[path = "../tests/gaits/mod.rs"]
mod gaits;
#[allow(dead_code)] // walkers remember, so one goes on and on instead of many inputs
#[path = "../../kin/benches/sampling/mod.rs"]
mod sampling;

use std::hint::black_box;
use std::sync::Arc;

use criterion::{Criterion, SamplingMode, criterion_group, criterion_main};
use interchange::figure::bare_mannequin;
use motion::{
    FittedClip, Ground, GroundKind, Steering, TreeState, Walker, parse_clip, parse_plan, read_tree,
};
use rig::{Bone, Figure, Palette};

/// A three-parameter blend: three clips are live where it is steered to.
const THREE: &str = r#"(version: 1, root: FootPlacement(node: Blend(by: [Forward, Sideways, Turn], points: [
    ((0, 0, 0), Clip(name: "idle")), ((1.4, 0, 0), Clip(name: "walk")), ((2.8, 0, 0), Clip(name: "jog")),
    ((0, 1, 0), Clip(name: "left")), ((0, -1, 0), Mirror(node: Clip(name: "left"))),
    ((0, 0, 60), Clip(name: "turn")), ((0, 0, -60), Clip(name: "turn", mirrored: true)),
])))"#;

const ONE: &str = r#"(version: 1, root: FootPlacement(node: Clip(name: "walk")))"#;

const DT: f64 = 1.0 / 60.0;

fn steering() -> Steering {
    Steering { speed: 0.8, forward: 0.8, turn: 12.0, ..Steering::default() }
}

fn measure(c: &mut Criterion, name: &str, mut step: impl FnMut()) {
    let mut group = c.benchmark_group("motion");
    group.sampling_mode(SamplingMode::Flat);
    group.bench_function(name, |b| b.iter(&mut step));
    group.finish();
}

fn setting() -> (Arc<Figure>, Vec<Arc<FittedClip>>) {
    let figure = Arc::new(bare_mannequin().expect("the mannequin is whole"));
    let clips = gaits::clips(&figure, &figure);
    (figure, clips)
}

fn tree(c: &mut Criterion) {
    let (_, clips) = setting();
    for (name, text, live) in [("tree, one clip", ONE, 1), ("tree, three clips", THREE, 3)] {
        let tree = read_tree(text, &clips).expect("the tree is whole");
        let mut state = TreeState::new(&tree);
        tree.step(&mut state, &steering(), DT);
        assert_eq!(state.samplings(), live);
        measure(c, name, || tree.step(black_box(&mut state), black_box(&steering()), DT));
    }
}

fn walker(c: &mut Criterion) {
    let (figure, clips) = setting();
    let tree = Arc::new(read_tree(THREE, &clips).expect("the tree is whole"));
    for (name, ground) in [("walker, flat", Ground::Flat), ("walker, hills", GroundKind::Hills.ground(1))] {
        let mut walker = Walker::new(figure.clone(), tree.clone());
        measure(c, name, || walker.step(black_box(&ground), black_box(&steering()), DT));
    }
}

/// What a game does for a figure each frame: the shipped tree and clips, feet on hills, every matrix of the skin.
fn figure(c: &mut Criterion) {
    let figure = Arc::new(bare_mannequin().expect("the mannequin is whole"));
    let assets = concat!(env!("CARGO_MANIFEST_DIR"), "/../../assets");
    let read = |name: String| std::fs::read_to_string(format!("{assets}/{name}")).expect("a shipped file");
    let text = read("blend/walk.blend.ron".to_owned());
    let plan = parse_plan(&text).expect("a plan");
    let clips: Vec<Arc<FittedClip>> = plan
        .clip_names()
        .iter()
        .map(|name| parse_clip(&read(format!("clips/{name}.clip.ron"))).expect("a clip"))
        .map(|clip| Arc::new(FittedClip::new(&clip, &figure, &figure).expect("legs")))
        .collect();
    let tree = Arc::new(read_tree(&text, &clips).expect("the tree is whole"));
    let rest = Bone::ALL.map(|bone| figure.skeleton.rest_position(bone));
    let ground = GroundKind::Hills.ground(1);
    for (name, turn) in [("figure, straight", 0.0), ("figure, in an arc", 12.0)] {
        let mut walker = Walker::new(figure.clone(), tree.clone());
        let steering = Steering { speed: 1.3, forward: 1.3, turn, ..Steering::default() };
        let mut palette = Palette::REST;
        measure(c, name, || {
            walker.step(black_box(&ground), black_box(&steering), DT);
            palette = Palette::new(&rig::frames(&figure, walker.pose()), &rest);
            black_box(&mut palette);
        });
    }
}

criterion_group! {
    name = one_walker;
    config = sampling::many_short();
    targets = tree, walker, figure
}
criterion_main!(one_walker);
