//! The laws of blend trees.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod figures;
mod gaits;
#[path = "../../kin/tests/seeded/mod.rs"]
mod seeded;

use std::sync::{Arc, LazyLock};

use motion::{FittedClip, Sample, Steering, Tree, TreeState, parse_plan, read_tree};
use rig::{Bone, Figure, Pose};
use seeded::Seeded;

static FIGURE: LazyLock<Figure> = LazyLock::new(|| figures::shipped("mannequin"));
static CLIPS: LazyLock<Vec<Arc<FittedClip>>> = LazyLock::new(|| gaits::clips(&FIGURE, &FIGURE));

fn tree(root: &str) -> Tree {
    read_tree(&format!("(version: 1, root: {root})"), &CLIPS).unwrap()
}

fn clip(name: &str) -> &'static FittedClip {
    CLIPS.iter().find(|clip| clip.name() == name).unwrap()
}

fn sampled(name: &str, phase: f64) -> Sample {
    let mut sample = Sample::at_rest(&FIGURE);
    clip(name).sample(phase, &mut sample);
    sample
}

/// A little of everything.
const WHOLE: &str = r#"States(
    initial: "moving",
    states: [
        ("moving", Additive(
            base: Blend(by: [Forward, Sideways, Turn], points: [
                ((0, 0, 0), Clip(name: "idle")),
                ((1.4, 0, 0), Clip(name: "walk")),
                ((2.8, 0, 0), Clip(name: "jog")),
                ((0, 1, 0), Clip(name: "left")),
                ((0, -1, 0), Mirror(node: Clip(name: "left"))),
                ((0, 0, 60), Clip(name: "turn")),
                ((0, 0, -60), Clip(name: "turn", mirrored: true)),
                ((1.4, 0, 60), Clip(name: "walk", turn: 60)),
                ((1.4, 0, -60), Clip(name: "walk", turn: -60)),
            ]),
            layer: Clip(name: "wave"), less: Clip(name: "idle"), amount: 0.4, by: (Slope, 20),
        )),
        ("sitting", Crossfade(by: Slope, over: (-5, 5), from: Clip(name: "sit"), to: Clip(name: "sit", mirrored: true))),
        ("rising", Mask(base: Clip(name: "sit", pace: -1.0), layer: Clip(name: "wave"), parts: ["leftArm"], amount: 0.5)),
    ],
    transitions: [
        (from: "moving", to: "sitting", when: [Sit], secs: 0.4),
        (from: "sitting", to: "rising", when: [Stand], secs: 0.2),
        (from: "rising", to: "moving", when: [EndsWithin(0.3)], secs: 0.3, feather: Smoother),
        (from: "rising", to: "sitting", when: [Sit], secs: 0.2),
    ],
)"#;

fn any_number(seeded: &mut Seeded) -> f64 {
    match (seeded.unit() * 12.0) as usize {
        0 => f64::NAN,
        1 => f64::INFINITY,
        2 => f64::NEG_INFINITY,
        3 => 1e300,
        4 => 0.0,
        _ => seeded.between(-4.0, 4.0),
    }
}

fn any_steering(seeded: &mut Seeded) -> Steering {
    Steering {
        speed: any_number(seeded),
        forward: any_number(seeded),
        sideways: any_number(seeded),
        turn: any_number(seeded) * 20.0,
        slope: any_number(seeded) * 5.0,
        sit: seeded.unit() < 0.5,
    }
}

fn is_finite(sample: &Sample) -> bool {
    let angles = sample.angles.iter().flat_map(|a| [a.flexion, a.abduction, a.twist]);
    sample.hips.is_finite() && angles.into_iter().all(f64::is_finite)
}

#[test]
fn weights_are_parts_of_one_for_any_parameters() {
    let tree = tree(WHOLE);
    let mut state = TreeState::new(&tree);
    let mut seeded = Seeded(5);
    for _ in 0..20_000 {
        let dt_secs = if seeded.unit() < 0.1 { any_number(&mut seeded) } else { 0.02 };
        tree.step(&mut state, &any_steering(&mut seeded), dt_secs);
        let sum: f64 = state.weights().iter().sum();
        assert!((sum - 1.0).abs() < 1e-12, "{sum}");
        assert!(state.weights().iter().all(|w| (0.0..=1.0 + 1e-12).contains(w)), "{:?}", state.weights());
        assert!(is_finite(state.sample()) && state.travel().velocity.is_finite());
        assert!((0.0..1.0).contains(&state.phase()));
    }
}

#[test]
fn numbers_that_are_none_count_as_nothing() {
    let tree = tree(WHOLE);
    let (mut lost, mut still) = (TreeState::new(&tree), TreeState::new(&tree));
    let nan = Steering {
        speed: f64::NAN,
        forward: f64::NAN,
        sideways: f64::NAN,
        turn: f64::NAN,
        slope: f64::NAN,
        sit: false,
    };
    for _ in 0..10 {
        tree.step(&mut lost, &nan, 0.01);
        tree.step(&mut still, &Steering::default(), 0.01);
        assert_eq!(lost, still);
    }
    tree.step(&mut lost, &nan, f64::NAN);
    assert_eq!(lost.sample(), still.sample());
}

#[test]
fn weights_of_0_and_1_give_the_ends_bit_for_bit() {
    let blend = "Blend(by: [Speed], points: [(0, Clip(name: \"idle\")), (1.4, Clip(name: \"walk\")), (2.8, Clip(name: \"jog\"))])";
    let fade = "Crossfade(by: Speed, over: (0.5, 1.2), from: Clip(name: \"turn\"), to: Clip(name: \"walk\"))";
    let mask = "Mask(base: Clip(name: \"walk\"), layer: Clip(name: \"wave\"), parts: [\"head\"], amount: 0)";
    let added = "Additive(base: Clip(name: \"walk\"), layer: Clip(name: \"wave\"), by: (Turn, 90))";
    let given = "Blend(by: [Forward, Turn], points: [((0, 0), Clip(name: \"idle\")), ((1.4, 0), Clip(name: \"walk\")), ((0, 60), Clip(name: \"turn\"))], cells: [[2, 1, 0]])";
    for root in [blend, fade, mask, added, given] {
        let tree = tree(root);
        let mut state = TreeState::new(&tree);
        for _ in 0..100 {
            tree.step(&mut state, &Steering::ahead(1.4), 1.0 / 60.0);
            assert_eq!(state.sample(), &sampled("walk", state.phase()), "{root}");
        }
    }
    let tree = tree("Mask(base: Clip(name: \"idle\"), layer: Clip(name: \"walk\"), parts: [\"leftLeg\"])");
    let mut state = TreeState::new(&tree);
    for i in 1..50 {
        tree.step(&mut state, &Steering::default(), 0.1);
        let leg = Bone::LeftUpperLeg.index();
        assert_eq!(state.sample().angles[leg], sampled("walk", state.phase()).angles[leg]);
        let idle = sampled("idle", (f64::from(i) * 0.1 / 3.0).fract());
        assert_eq!(
            state.sample().angles[Bone::RightUpperLeg.index()],
            idle.angles[Bone::RightUpperLeg.index()]
        );
    }
}

#[test]
fn what_has_no_weight_is_never_visited() {
    let points = (0..24).map(|i| {
        let name = ["idle", "walk", "jog", "left"][i % 4];
        format!("(({}, {}), Crossfade(by: Slope, over: (0, 9), from: Clip(name: \"{name}\"), to: Clip(name: \"turn\")))", i % 6, i / 6)
    });
    let points: Vec<String> = points.collect();
    let tree = tree(&format!("Blend(by: [Forward, Sideways], points: [{}])", points.join(", ")));
    let mut state = TreeState::new(&tree);
    let at = |forward, sideways, slope| Steering { forward, sideways, slope, ..Steering::default() };
    // The blend, one crossfade, one clip.
    tree.step(&mut state, &at(2.0, 1.0, 0.0), 0.01);
    assert_eq!((state.visits(), state.samplings()), (3, 1));
    // Two crossfades on an edge, with both clips each.
    tree.step(&mut state, &at(2.5, 1.0, 4.0), 0.01);
    assert_eq!((state.visits(), state.samplings()), (7, 4));
    // Three within a cell.
    tree.step(&mut state, &at(2.3, 1.2, 0.0), 0.01);
    assert_eq!((state.visits(), state.samplings()), (7, 3));
    assert_eq!(tree.outline(&state).filter(|node| node.weight > 0.0).count(), 7);
}

#[test]
fn states_and_layers_without_weight_are_never_visited() {
    let tree = tree(WHOLE);
    let mut state = TreeState::new(&tree);
    tree.step(&mut state, &Steering::ahead(1.4), 0.01);
    assert_eq!((state.visits(), state.samplings()), (4, 1), "states, additive, blend, clip");
    tree.step(&mut state, &Steering { slope: 10.0, ..Steering::ahead(1.4) }, 0.01);
    assert_eq!((state.visits(), state.samplings()), (6, 3), "and both layers");
}

/// The greatest changes of an angle and of its rate from step to step.
struct Smoothness {
    before: Option<(f64, Option<f64>)>,
    value: f64,
    rate: f64,
}

impl Smoothness {
    fn new() -> Smoothness {
        Smoothness { before: None, value: 0.0, rate: 0.0 }
    }

    fn take(&mut self, value: f64, dt_secs: f64) {
        let rate = self.before.map(|(before, _)| (value - before) / dt_secs);
        if let Some((before, rate_before)) = self.before {
            self.value = self.value.max((value - before).abs());
            if let Some((rate, rate_before)) = rate.zip(rate_before) {
                self.rate = self.rate.max((rate - rate_before).abs());
            }
        }
        self.before = Some((value, rate));
    }
}

/// Three states that differ by up to 90 degrees of the left thigh: sat down, stood, half a stride.
fn three_states(feather: &str) -> Tree {
    tree(&format!(
        r#"States(
            initial: "stand",
            states: [("stand", Clip(name: "idle")), ("sat", Clip(name: "sit", pace: -0.05)), ("third", Clip(name: "wave"))],
            transitions: [
                (from: "stand", to: "sat", when: [Sit], secs: 0.3, feather: {feather}),
                (from: "sat", to: "stand", when: [Stand, Above(Speed, 1)], secs: 0.4, feather: {feather}),
                (from: "sat", to: "third", when: [Stand, Below(Speed, 1)], secs: 0.25, feather: {feather}),
                (from: "third", to: "sat", when: [Sit], secs: 0.35, feather: {feather}),
                (from: "third", to: "stand", when: [Above(Speed, 1)], secs: 0.5, feather: {feather}),
            ],
        )"#
    ))
}

#[test]
fn transitions_go_on_in_value_and_rate_also_when_interrupted() {
    const DT: f64 = 1e-4;
    for feather in ["Smooth", "Smoother"] {
        let tree = three_states(feather);
        for seed in 0..20 {
            let mut seeded = Seeded(seed);
            let mut state = TreeState::new(&tree);
            let mut steering = Steering::default();
            let (mut smoothness, mut interrupted, mut left) = (Smoothness::new(), 0, 0);
            for _ in 0..40_000 {
                if left == 0 {
                    steering.sit = seeded.unit() < 0.5;
                    steering.speed = seeded.between(0.0, 2.0);
                    left = seeded.between(1.0, 6000.0) as usize;
                    interrupted += usize::from(state.weights().iter().filter(|w| **w > 0.0).count() > 1);
                }
                left -= 1;
                tree.step(&mut state, &steering, DT);
                let degrees = state.sample().angles[Bone::LeftUpperLeg.index()].flexion;
                smoothness.take(degrees, DT);
                let sum: f64 = state.weights().iter().sum();
                assert!((sum - 1.0).abs() < 1e-12);
            }
            // 90 degrees in 0.25 s: at most 680 a second, and as 90 · 12 / 0.25² = 17280 a second squared when interrupted.
            assert!(smoothness.value < 0.15, "{feather} {seed}: {} degrees in a step", smoothness.value);
            assert!(smoothness.rate < 4.0, "{feather} {seed}: {} degrees a second", smoothness.rate);
            assert!(smoothness.value > 0.01 && interrupted > 0, "{feather} {seed}: nothing happened");
        }
    }
}

#[test]
fn crossfades_by_a_parameter_go_on_in_value_and_rate() {
    let tree = tree(
        "Crossfade(by: Slope, over: (-4, 6), from: Clip(name: \"idle\"), to: Clip(name: \"sit\", pace: -0.05))",
    );
    let (mut state, mut smoothness) = (TreeState::new(&tree), Smoothness::new());
    tree.step(&mut state, &Steering { slope: 9.0, ..Steering::default() }, 0.0);
    for i in 0..40_000 {
        let slope = -10.0 + f64::from(i) * 5e-4;
        tree.step(&mut state, &Steering { slope, ..Steering::default() }, 0.0);
        smoothness.take(state.sample().angles[Bone::LeftUpperLeg.index()].flexion, 5e-4);
    }
    assert!(smoothness.value < 0.01 && smoothness.rate < 0.01, "{} {}", smoothness.value, smoothness.rate);
    assert!(smoothness.value > 1e-3);
}

#[test]
fn a_state_that_is_entered_begins_its_clips_and_ends_them() {
    let tree = tree(WHOLE);
    let mut state = TreeState::new(&tree);
    let step = |state: &mut TreeState, sit: bool| {
        tree.step(state, &Steering { sit, slope: -9.0, ..Steering::default() }, 0.1);
        state.current_states(&tree).next().unwrap().to_owned()
    };
    let thigh = |state: &TreeState| state.sample().angles[Bone::LeftUpperLeg.index()].flexion;
    assert_eq!(step(&mut state, false), "moving");
    assert_eq!(step(&mut state, true), "sitting");
    for _ in 0..30 {
        step(&mut state, true);
    }
    assert_eq!(thigh(&state), 90.0, "at its end");
    assert_eq!(step(&mut state, false), "rising");
    assert!(thigh(&state) > 80.0, "backward, from its end");
    let steps = (0..40).take_while(|_| step(&mut state, false) == "rising").count();
    assert!((15..=17).contains(&steps), "2 s without the last 0.3: {steps}");
    for _ in 0..10 {
        step(&mut state, false);
    }
    step(&mut state, true);
    step(&mut state, true);
    assert!(thigh(&state) < 30.0, "sits down anew");
}

#[test]
fn strides_keep_step_and_go_as_far_as_they_step() {
    let tree = tree("Blend(by: [Speed], points: [(1.4, Clip(name: \"walk\")), (2.8, Clip(name: \"jog\"))])");
    let mut state = TreeState::new(&tree);
    let step = Steering { speed: 2.1, ..Steering::default() };
    tree.step(&mut state, &step, 0.0);
    let before = state.phase();
    tree.step(&mut state, &step, 0.01);
    let frequency = (state.phase() - before) / 0.01;
    // Half of each: strides of (1.54 + 2.1) / 2 metres, at (1.4 + 2.8) / 2 metres a second.
    assert!((state.travel().velocity.y - 2.1).abs() < 1e-9, "{:?}", state.travel());
    assert!((frequency - 2.1 / 1.82).abs() < 1e-9, "{frequency}");
    let mut sum = Sample::at_rest(&FIGURE);
    sum.set_between(&sampled("walk", state.phase()), &sampled("jog", state.phase()), 0.5);
    let knee = |sample: &Sample| sample.angles[Bone::LeftLowerLeg.index()].flexion;
    assert!((knee(&sum) - knee(state.sample())).abs() < 1e-9);
}

#[test]
fn mirrors_are_mirror_images_and_two_are_none() {
    let once = "Mirror(node: Mask(base: Clip(name: \"left\"), layer: Clip(name: \"wave\"), parts: [\"leftArm\"], bones: [\"head\"]))";
    let plain = tree(&once["Mirror(node: ".len()..once.len() - 1]);
    let (once, twice) = (tree(once), tree(&format!("Mirror(node: {once})")));
    let mut states = [&plain, &once, &twice].map(TreeState::new);
    for _ in 0..200 {
        plain.step(&mut states[0], &Steering::default(), 0.013);
        once.step(&mut states[1], &Steering::default(), 0.013);
        twice.step(&mut states[2], &Steering::default(), 0.013);
        assert_eq!(states[2].sample(), states[0].sample());
        assert_eq!(states[2].travel(), states[0].travel());
        assert_eq!(states[1].travel().velocity.x, -states[0].travel().velocity.x);
        let mut ahead = states[0].clone();
        ahead.set_phase(states[0].phase() + 0.5);
        plain.step(&mut ahead, &Steering::default(), 0.0);
        let pose = |sample: &Sample| Pose { hips: sample.hips, angles: sample.angles, ..FIGURE.rest_pose() };
        let image = rig::mirrored_pose(&pose(ahead.sample()));
        // Half a stride on, phases differ in their last digit.
        let pairs = image.angles.iter().zip(&states[1].sample().angles);
        let off = pairs.map(|(a, b)| {
            (a.flexion - b.flexion).abs() + (a.abduction - b.abduction).abs() + (a.twist - b.twist).abs()
        });
        assert!(off.fold(0.0, f64::max) < 1e-10);
        assert!(image.hips.distance(states[1].sample().hips) < 1e-12);
    }
}

#[test]
fn layers_are_added_by_how_they_differ() {
    let tree = tree(
        "Additive(base: Clip(name: \"walk\"), layer: Clip(name: \"wave\"), less: Clip(name: \"idle\"), amount: 0.5, by: (Turn, 90))",
    );
    for (turn, part) in [(0.0, 0.0), (45.0, 0.25), (90.0, 0.5), (900.0, 0.5), (-45.0, -0.25)] {
        let mut state = TreeState::new(&tree);
        let steering = Steering { turn, ..Steering::default() };
        (0..30).for_each(|_| tree.step(&mut state, &steering, 0.01));
        // Layers' clocks stand while they have no weight.
        let (walk, wave, idle) = (sampled("walk", state.phase()), sampled("wave", 0.3), sampled("idle", 0.1));
        let arm = Bone::LeftUpperArm.index();
        let expected =
            walk.angles[arm].flexion + part * (wave.angles[arm].flexion - idle.angles[arm].flexion);
        assert!((state.sample().angles[arm].flexion - expected).abs() < 1e-9, "{turn}");
        assert_eq!(state.weights().iter().sum::<f64>(), 1.0);
        assert_eq!(state.sample().bearing, walk.bearing);
    }
}

#[test]
fn a_reload_keeps_phase_clocks_and_states() {
    let before = tree(WHOLE);
    let mut state = TreeState::new(&before);
    for i in 0..97 {
        before.step(&mut state, &Steering { sit: i > 82, slope: 7.0, ..Steering::ahead(1.0) }, 1.0 / 60.0);
    }
    assert!(state.weights().iter().filter(|w| **w > 0.0).count() > 2, "in the midst of a transition");
    let mut same = state.carried_over(&before, &tree(WHOLE));
    assert_eq!((same.sample(), same.phase()), (state.sample(), state.phase()));
    // Another pace of the walk, a state more at the beginning: the rest goes on as it did.
    let edited = WHOLE
        .replace("((1.4, 0, 0), Clip(name: \"walk\"))", "((1.5, 0, 0), Clip(name: \"walk\", pace: 1.1))")
        .replace("states: [\n", "states: [(\"new\", Clip(name: \"wave\")),\n");
    let edited = tree(&edited);
    let other = state.carried_over(&before, &edited);
    assert_eq!(other.phase(), state.phase());
    assert_eq!(other.current_states(&edited).collect::<Vec<_>>(), ["sitting"]);
    let sit = |tree: &Tree, state: &TreeState| {
        state.named_weights(tree).find(|(name, _)| *name == "sit").unwrap().1
    };
    assert_eq!(sit(&edited, &other), sit(&before, &state));
    // And from the same state on, both go on alike.
    for _ in 0..60 {
        before.step(&mut state, &Steering::ahead(1.0), 0.01);
        let now = tree(WHOLE);
        same = same.carried_over(&now, &now);
        now.step(&mut same, &Steering::ahead(1.0), 0.01);
        assert_eq!(same.sample(), state.sample());
    }
}

#[test]
fn a_state_that_is_gone_starts_over() {
    let before = three_states("Smooth");
    let mut state = TreeState::new(&before);
    (0..9).for_each(|_| before.step(&mut state, &Steering { sit: true, ..Steering::default() }, 0.02));
    let after = tree("States(initial: \"a\", states: [(\"a\", Clip(name: \"idle\"))])");
    let state = state.carried_over(&before, &after);
    assert_eq!(state.current_states(&after).collect::<Vec<_>>(), ["a"]);
    assert_eq!(state.weights(), [1.0]);
}

#[test]
fn a_child_walks_at_its_own_speed() {
    let child = figures::shipped("child");
    let clips = gaits::clips(&child, &FIGURE);
    let pace = clips[0].pace();
    assert!((0.6..0.95).contains(&pace), "{pace}");
    let text = "(version: 1, root: Blend(by: [Speed, Turn], points: [((0, 0), Clip(name: \"idle\")), ((1.4, 0), Clip(name: \"walk\")), ((0, 60), Clip(name: \"turn\"))]))";
    let tree = read_tree(text, &clips).unwrap();
    let mut state = TreeState::new(&tree);
    tree.step(&mut state, &Steering::ahead(1.4 * pace), 0.01);
    assert_eq!(state.weights(), [0.0, 1.0, 0.0]);
    assert!((state.travel().velocity.y - 1.4 * pace).abs() < 1e-3, "{:?}", state.travel());
    tree.step(&mut state, &Steering { turn: 60.0 / pace, ..Steering::default() }, 0.01);
    assert_eq!(state.weights(), [0.0, 0.0, 1.0]);
    assert!((state.travel().turn_rate - 60.0 / pace).abs() < 0.1, "{:?}", state.travel());
}

#[test]
fn the_same_steps_give_the_same_bits() {
    let run = || {
        let tree = tree(WHOLE);
        let (mut state, mut seeded) = (TreeState::new(&tree), Seeded(99));
        (0..3000).for_each(|_| tree.step(&mut state, &any_steering(&mut seeded), 1.0 / 60.0));
        state
    };
    assert_eq!(run(), run());
}

#[test]
fn plans_that_name_no_clip_of_a_figure_are_told_without_a_text_too() {
    let plan = parse_plan("(version: 1, root: Mirror(node: Clip(name: \"hop\")))").unwrap();
    let fault = Tree::new(&plan, &CLIPS).unwrap_err();
    let expected = "root.node.name: unknown clip \"hop\", expected idle, sit, wave, walk, jog, left, turn";
    assert_eq!(fault.to_string(), expected);
}

#[test]
fn a_foot_that_is_to_step_does_not_stand_however_little_it_steps() {
    let tree = tree("Blend(by: [Speed], points: [(0, Clip(name: \"idle\")), (1.4, Clip(name: \"walk\"))])");
    let mut state = TreeState::new(&tree);
    let mut stepped = false;
    for _ in 0..200 {
        tree.step(&mut state, &Steering::ahead(0.2), 0.01);
        let walk = sampled("walk", state.phase());
        for (bears, walks) in state.sample().bearing.iter().zip(&walk.bearing) {
            assert!((bears.heel - walks.heel).abs() < 1e-12 && (bears.ball - walks.ball).abs() < 1e-12);
            stepped |= bears.heel < 0.1;
        }
    }
    assert!(stepped);
    tree.step(&mut state, &Steering::default(), 0.01);
    assert_eq!(state.sample().bearing[0].heel, 1.0, "and without a step it stands");
}
