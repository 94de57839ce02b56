//! The shell in which a limb can hold its articulator, and why a target is missed.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

#[path = "../../kin/tests/seeded/mod.rs"]
mod seeded;

use glam::DVec3;
use rig::{
    Contact, Dof, Figure, Limb, Pose, Reacher, Space, Target, Why, evaluate, frames, keep, reach,
    reach_limits, turn,
};
use seeded::Seeded;

fn figure() -> Figure {
    interchange::figure::bare_mannequin().unwrap()
}

/// A pose with the ends of all limbs turned somehow, and an articulator of each chosen somehow.
fn somehow(figure: &Figure, seeded: &mut Seeded) -> Pose {
    let mut pose = figure.rest_pose();
    for limb in Limb::ALL {
        let parts = limb.parts();
        let between = |seeded: &mut Seeded, range: kin::Interval| seeded.between(range.min, range.max);
        for bone in [parts.root, parts.hinge, parts.end] {
            let joint = figure.skeleton.joint(bone).unwrap();
            for dof in joint.dofs() {
                let degrees = between(seeded, joint.range(dof).unwrap());
                pose = turn(figure, &pose, bone, dof, degrees, true).unwrap().pose;
            }
        }
        let names: Vec<_> = figure.articulators[limb.index()].keys().collect();
        let which = seeded.between(0.0, names.len() as f64 - 0.001) as usize;
        pose.limbs[limb.index()].reacher = Reacher::Named(names[which].clone());
    }
    pose
}

fn distance(figure: &Figure, pose: &Pose, limb: Limb) -> f64 {
    let (at, frames) = (figure.articulator(pose, limb), frames(figure, pose));
    frames[at.bone].point(at.at).distance(frames[limb.parts().root].position)
}

#[test]
fn the_limits_are_the_least_and_the_greatest_of_all_bends_of_the_hinge() {
    let figure = figure();
    let mut seeded = Seeded(11);
    for _ in 0..40 {
        let pose = somehow(&figure, &mut seeded);
        for limb in Limb::ALL {
            let limits = reach_limits(&figure, &pose, &frames(&figure, &pose), limb, true).unwrap();
            let range = figure.skeleton.joint(limb.parts().hinge).unwrap().range(Dof::Flexion).unwrap();
            let (mut least, mut most) = (f64::INFINITY, 0.0f64);
            for step in 0..=2000 {
                let mut bent = pose.clone();
                let degrees = range.min + (range.max - range.min) * f64::from(step) / 2000.0;
                bent.angles[limb.parts().hinge.index()].flexion = degrees;
                let d = distance(&figure, &bent, limb);
                (least, most) = (least.min(d), most.max(d));
            }
            let name = limb.name();
            assert!(
                limits.inner_m <= least + 1e-9 && least - limits.inner_m < 1e-4,
                "{name}: {limits:?} {least}"
            );
            assert!(
                limits.outer_m >= most - 1e-9 && limits.outer_m - most < 1e-4,
                "{name}: {limits:?} {most}"
            );
        }
    }
}

#[test]
fn without_ranges_and_outside_of_them_the_shell_is_wider() {
    let figure = figure();
    let mut pose = figure.rest_pose();
    let limits = |pose: &Pose, ranges| {
        reach_limits(&figure, pose, &frames(&figure, pose), Limb::LeftLeg, ranges).unwrap()
    };
    let (with, without) = (limits(&pose, true), limits(&pose, false));
    assert!(without.inner_m < with.inner_m - 0.01 && without.outer_m == with.outer_m);
    pose.angles[Limb::LeftLeg.parts().hinge.index()].flexion = 178.0;
    assert!(limits(&pose, true).inner_m < with.inner_m - 0.01, "a knee that is out of range may stay so");
}

/// A contact of the left wrist with the world whose target is moved to a place seen from the shoulder.
fn missed(figure: &Figure, from_shoulder: DVec3) -> Option<rig::Miss> {
    let (limb, mut pose) = (Limb::LeftArm, figure.rest_pose());
    pose.limbs[limb.index()].reacher = Reacher::Named("wrist".to_owned());
    pose = turn(figure, &pose, limb.parts().hinge, Dof::Flexion, 60.0, true).unwrap().pose;
    pose = keep(figure, &pose, limb, Contact::Point { space: Space::World, target: DVec3::ZERO }).unwrap();
    let shoulder = frames(figure, &pose)[limb.parts().root].position;
    let target = Target { space: Space::World, point: shoulder + from_shoulder };
    let pose = reach(figure, &pose, limb, target, true).unwrap().pose;
    let evaluation = evaluate(figure, &pose, true);
    let limits = reach_limits(figure, &pose, &evaluation.frames, limb, true).unwrap();
    limits.miss(&evaluation.limbs[limb.index()])
}

#[test]
fn a_miss_is_named_for_what_is_in_the_way() {
    let figure = figure();
    let why = |at| missed(&figure, at).map(|miss| miss.why);
    assert_eq!(why(DVec3::new(0.2, -0.1, 0.3)), None);
    assert_eq!(why(DVec3::new(0.5, -0.2, 0.6)), Some(Why::TooFar));
    assert_eq!(why(DVec3::new(0.01, -0.01, 0.02)), Some(Why::TooNear));
    assert_eq!(why(DVec3::new(-0.1, -0.05, -0.45)), Some(Why::Range), "behind the back and across");
    let far = missed(&figure, DVec3::new(0.0, 0.0, 0.8)).unwrap();
    assert!((far.by_m - 0.25).abs() < 0.1, "{far:?}");
}

#[test]
fn the_gap_is_the_distance_from_the_shell() {
    let figure = figure();
    let pose = figure.rest_pose();
    let limits = reach_limits(&figure, &pose, &frames(&figure, &pose), Limb::RightArm, true).unwrap();
    let at = |metres: f64| limits.gap_m(limits.root_in_world + DVec3::new(0.6, 0.0, 0.8) * metres);
    assert!((at(limits.outer_m + 0.1) - 0.1).abs() < 1e-12);
    assert!((at(limits.inner_m - 0.02) - 0.02).abs() < 1e-12);
    assert_eq!(at(0.5 * (limits.inner_m + limits.outer_m)), 0.0);
}
