//! The tree that comes with the program, with its clips: every figure goes as it is steered.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod figures;

use std::path::PathBuf;
use std::sync::{Arc, LazyLock};

use motion::{
    FittedClip, Ground, GroundKind, Steering, Survey, Tree, TreeState, Walker, parse_clip, read_tree,
};
use rig::Figure;

type Bound = (&'static str, Arc<Figure>, Arc<Tree>);

/// Every shipped figure with the tree for it, the mannequin first.
static ALL: LazyLock<Vec<Bound>> = LazyLock::new(|| {
    let all = figures::all_shipped();
    let mannequin = all[0].1.clone();
    let bound = |(name, figure): (&'static str, Figure)| {
        let tree = shipped_tree(&figure, &mannequin);
        (name, Arc::new(figure), Arc::new(tree))
    };
    all.into_iter().map(bound).collect()
});

fn assets() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../assets")
}

fn shipped_tree(figure: &Figure, made_with: &Figure) -> Tree {
    let text = std::fs::read_to_string(assets().join("blend/walk.blend.ron")).unwrap();
    let plan = motion::parse_plan(&text).unwrap();
    let clip = |name: &&str| {
        let text = std::fs::read_to_string(assets().join(format!("clips/{name}.clip.ron"))).unwrap();
        Arc::new(FittedClip::new(&parse_clip(&text).unwrap(), made_with, figure).unwrap())
    };
    let clips: Vec<Arc<FittedClip>> = plan.clip_names().iter().map(clip).collect();
    read_tree(&text, &clips).unwrap()
}

fn steered(speed: f64, toward_degrees: f64, turn: f64) -> Steering {
    let (sideways, forward) = toward_degrees.to_radians().sin_cos();
    Steering { speed, forward: speed * forward, sideways: speed * sideways, turn, ..Steering::default() }
}

#[test]
fn every_figure_goes_as_fast_as_it_is_steered() {
    for (name, _, tree) in ALL.iter() {
        let pace = tree.clips()[0].pace();
        let mut state = TreeState::new(tree);
        // Speeds, directions and turns that are within the tree's points.
        let all = [
            (0.3, 0.0, 0.0),
            (1.0, 0.0, 20.0),
            (1.4, 0.0, 0.0),
            (1.6, 0.0, 0.0),
            (2.5, 0.0, -20.0),
            (2.8, 0.0, 0.0),
        ];
        let around = [
            (0.4, 90.0, 0.0),
            (0.4, -60.0, 10.0),
            (0.4, 180.0, 0.0),
            (0.0, 0.0, 60.0),
            (0.0, 0.0, -60.0),
            (0.3, 150.0, 20.0),
        ];
        for (speed, toward, turn) in all.into_iter().chain(around) {
            let asked = steered(speed * pace, toward, turn / pace);
            tree.step(&mut state, &asked, 0.01);
            let travel = state.travel();
            let off = (travel.velocity.x - asked.sideways).hypot(travel.velocity.y - asked.forward);
            assert!(off < 0.03 * pace, "{name}: {travel:?} for {asked:?}");
            assert!((travel.turn_rate - asked.turn).abs() < 2.0, "{name}: {travel:?} for {asked:?}");
        }
    }
}

#[test]
fn straight_ahead_at_walking_speed_it_is_the_walk_alone() {
    let (_, _, tree) = &ALL[0];
    let mut state = TreeState::new(tree);
    tree.step(&mut state, &Steering::ahead(1.4), 0.01);
    assert_eq!(state.samplings(), 1);
    let walk = state.named_weights(tree).find(|(name, _)| *name == "walk").unwrap();
    assert_eq!(walk.1, 1.0);
    tree.step(&mut state, &Steering::default(), 0.01);
    let idle = state.named_weights(tree).find(|(name, _)| *name == "idle").unwrap();
    assert_eq!(idle.1, 1.0);
}

#[test]
fn it_sits_down_and_rises_again() {
    let (_, mannequin, tree) = &ALL[0];
    let mut walker = Walker::new(mannequin.clone(), tree.clone());
    let mut go = |steering: &Steering, secs: f64| {
        (0..(secs * 60.0) as usize).for_each(|_| walker.step(&Ground::Flat, steering, 1.0 / 60.0));
        walker.pose().hips.y
    };
    let stood = go(&Steering::default(), 1.0);
    let sat = go(&Steering { sit: true, ..Steering::default() }, 5.0);
    assert!(sat < stood - 0.25, "{sat} after {stood}");
    let rose = go(&Steering::default(), 5.0);
    assert!((rose - stood).abs() < 0.02, "{rose} after {stood}");
}

#[test]
fn a_rough_ride_stays_finite_and_in_range() {
    for (name, figure, tree) in ALL.iter() {
        let mut walker = Walker::new(figure.clone(), tree.clone());
        let hills = GroundKind::Hills.ground(3);
        for i in 0..1200 {
            let t = f64::from(i) / 60.0;
            let mut steering =
                steered(1.5 + 1.5 * (0.9 * t).sin(), 60.0 * (0.4 * t).sin(), 90.0 * (0.7 * t).sin());
            steering.sit = (i / 150) % 4 == 3;
            walker.step(&hills, &steering, 1.0 / 60.0);
            let sum: f64 = walker.weights().map(|(_, weight)| weight).sum();
            assert!((sum - 1.0).abs() < 1e-12, "{name}: {sum}");
            for joint in figure.skeleton.joints() {
                for dof in joint.dofs() {
                    let angle = walker.pose().angles(joint.bone).get(dof);
                    let kept = joint
                        .range(dof)
                        .is_none_or(|range| (range.min - 1e-6..=range.max + 1e-6).contains(&angle));
                    assert!(kept, "{name} {i}: {} {dof:?} {angle}", joint.bone);
                }
            }
        }
    }
}

#[test]
fn between_its_points_feet_neither_sink_nor_slide_on_flat_ground() {
    let (_, figure, tree) = &ALL[0];
    // Between standing and walking, walking and jogging, ahead and aside, turning and not.
    for (speed, toward, turn) in
        [(0.3, 0.0, 0.0), (2.0, 0.0, 0.0), (0.6, 40.0, 0.0), (0.0, 0.0, 30.0), (1.3, 0.0, 20.0)]
    {
        let (mut walker, mut survey) = (Walker::new(figure.clone(), tree.clone()), Survey::new());
        for i in 0..600 {
            walker.step(&Ground::Flat, &steered(speed, toward, turn), 1.0 / 60.0);
            if i > 30 {
                survey.add(figure, walker.pose(), &walker.feet(&Ground::Flat));
            }
        }
        let summary = survey.summary(None);
        let sunk = summary.penetration_mm.max(summary.swing_penetration_mm);
        assert!(sunk < 1.0, "{speed} {toward} {turn}: {sunk} mm");
        assert!(summary.slide_mm < 2.0, "{speed} {toward} {turn}: {} mm", summary.slide_mm);
        assert!(summary.float_mm < 8.0, "{speed} {toward} {turn}: {} mm", summary.float_mm);
        assert!(summary.stance_share > 0.01, "{speed} {toward} {turn}: never stands");
    }
}
