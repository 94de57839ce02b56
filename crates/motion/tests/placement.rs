//! Feet placed on the ground: still poses, bad numbers, fresh starts, and what stays as it was.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod figures;
mod walking;

use figures::shipped;
use glam::{DQuat, DVec3};
use motion::{
    Bearing, FeetState, Footing, Ground, GroundKind, Placement, PlacementSettings, Sample, Slope, Sole,
    Soles, stand,
};
use rig::{Bone, Dof, Figure, Place, Pose, frames};
use walking::Walk;

/// The heights of all sole points over the ground, metres.
fn heights(figure: &Figure, pose: &Pose, ground: &Ground) -> [[f64; Sole::COUNT]; 2] {
    let (soles, frames) = (Soles::of(figure).unwrap(), frames(figure, pose));
    soles.feet.map(|sole| sole.points(&frames).map(|p| p.y - ground.height(p.x, p.z)))
}

fn kneeling_a_little(figure: &Figure) -> Pose {
    let mut pose = figure.rest_pose();
    for side in [Bone::LeftUpperLeg, Bone::RightUpperLeg] {
        pose.angles[side.index()].flexion = 20.0;
    }
    for (knee, foot) in [(Bone::LeftLowerLeg, Bone::LeftFoot), (Bone::RightLowerLeg, Bone::RightFoot)] {
        pose.angles[knee.index()].flexion = 40.0;
        pose.angles[foot.index()].flexion = 20.0;
    }
    let lowest = heights(figure, &pose, &Ground::Flat).as_flattened().iter().fold(1.0f64, |a, b| a.min(*b));
    pose.hips.y -= lowest;
    pose
}

#[test]
fn a_still_figure_stands_on_every_ground() {
    let figure = shipped("mannequin");
    let footing = Footing::of(&figure).unwrap();
    for seed in 1..20 {
        for ground in [GroundKind::Hills.ground(seed), Ground::Slope(Slope::new(8.0, 40.0 * seed as f64))] {
            let mut pose = figure.rest_pose();
            pose.place =
                Place { position: DVec3::new(1.7 * seed as f64, 0.0, -0.9), turn: 33.0 * seed as f64 };
            let stood = stand(&footing, &ground, &pose);
            let deepest =
                heights(&figure, &stood, &ground).as_flattened().iter().fold(0.0f64, |a, b| a.min(*b));
            assert!(deepest > -0.012, "{seed}: {deepest}");
            // Balls are on the ground, whatever the heels do.
            for foot in heights(&figure, &stood, &ground) {
                assert!(foot[Sole::BALL] < 0.015, "{seed}: {foot:?}");
            }
            assert_eq!(stood.place, pose.place);
        }
    }
}

#[test]
fn on_flat_ground_a_standing_pose_stays_as_it_is() {
    let figure = shipped("mannequin");
    let footing = Footing::of(&figure).unwrap();
    let pose = kneeling_a_little(&figure);
    let stood = stand(&footing, &Ground::Flat, &pose);
    assert!(stood.hips.distance(pose.hips) < 1e-9);
    for bone in Bone::ALL {
        for dof in Dof::ALL {
            let (a, b) = (pose.angles(bone).get(dof), stood.angles(bone).get(dof));
            assert!((a - b).abs() < 1e-4, "{bone} {dof:?}: {a} {b}");
        }
    }
}

#[test]
fn hips_that_are_lowered_bend_the_knees_and_the_soles_stay_on_the_ground() {
    let figure = shipped("mannequin");
    let footing = Footing::of(&figure).unwrap();
    for (lower, heels_may_rise) in [(0.04, 0.02), (0.12, 0.08)] {
        let mut pose = figure.rest_pose();
        pose.hips += DVec3::new(0.03, -lower, 0.02);
        for ground in [Ground::Flat, Ground::Slope(Slope::new(8.0, 40.0))] {
            let stood = stand(&footing, &ground, &pose);
            for foot in heights(&figure, &stood, &ground) {
                assert!(foot.iter().all(|off| (-0.01..heels_may_rise).contains(off)), "{lower}: {foot:?}");
                assert!(foot[Sole::BALL] < 0.015, "{lower}: {foot:?}");
            }
            assert!(stood.angles(Bone::LeftLowerLeg).flexion > 20.0);
        }
    }
}

#[test]
fn a_raised_foot_stays_raised() {
    let figure = shipped("mannequin");
    let footing = Footing::of(&figure).unwrap();
    let mut pose = figure.rest_pose();
    pose.angles[Bone::LeftUpperLeg.index()].flexion = 60.0;
    pose.angles[Bone::LeftLowerLeg.index()].flexion = 70.0;
    let ground = Ground::Slope(Slope::new(10.0, 0.0));
    let raised = heights(&figure, &pose, &Ground::Flat)[0][Sole::BALL];
    let [left, right] = heights(&figure, &stand(&footing, &ground, &pose), &ground);
    assert!((left[Sole::BALL] - raised).abs() < 0.06, "{left:?} {raised}");
    assert!(right.iter().all(|off| off.abs() < 0.01), "{right:?}");
}

#[test]
fn bad_numbers_break_nothing() {
    let figure = shipped("mannequin");
    let footing = Footing::of(&figure).unwrap();
    let ground = GroundKind::Hills.ground(1);
    let rest = figure.rest_pose();
    let sound =
        Sample { hips: rest.hips, angles: rest.angles, bearing: [Bearing { heel: 1.0, ball: 1.0 }; 2] };
    for bad in [f64::NAN, f64::INFINITY, 1e300, -1e300] {
        for which in 0..7 {
            let (mut sample, mut place, mut dt) = (sound.clone(), Place::default(), 1.0 / 60.0);
            match which {
                0 => sample.hips.y = bad,
                1 => sample.angles[Bone::LeftUpperLeg.index()].flexion = bad,
                2 => sample.bearing[0].heel = bad,
                3 => place.position.x = bad,
                4 => place.turn = bad,
                5 => dt = bad,
                _ => sample.angles[Bone::Hips.index()].twist = bad,
            }
            let (mut state, settings) = (FeetState::default(), PlacementSettings::default());
            let placement = Placement { footing: &footing, ground: &ground, settings: &settings };
            placement.step(&Place::default(), &mut sound.clone(), &mut state, 0.0);
            placement.step(&place, &mut sample, &mut state, dt);
            let mut off = f64::INFINITY;
            // What comes after is sound again.
            for _ in 0..200 {
                let mut after = sound.clone();
                let [left, _] = placement.step(&Place::default(), &mut after, &mut state, 0.02);
                let left = left.view(&footing, 0, &ground, &after);
                off = (left.sole_in_world[0].y - left.ground_under_sole[0]).abs();
                let sum: f64 = after.angles.iter().map(|a| a.flexion + a.abduction + a.twist).sum();
                assert!((sum + after.hips.y).is_finite(), "{bad} {which}");
            }
            assert!(off < 0.02, "{bad} {which}: {off}");
        }
    }
}

#[test]
fn a_planted_foot_stays_while_the_figure_turns_on_it() {
    let figure = shipped("mannequin");
    let footing = Footing::of(&figure).unwrap();
    let ground = Ground::Slope(Slope::new(12.0, 70.0));
    let pose = kneeling_a_little(&figure);
    let sample =
        Sample { hips: pose.hips, angles: pose.angles, bearing: [Bearing { heel: 1.0, ball: 1.0 }; 2] };
    let (mut state, settings) = (FeetState::default(), PlacementSettings::default());
    let placement = Placement { footing: &footing, ground: &ground, settings: &settings };
    let mut first: Option<Vec<DVec3>> = None;
    for frame in 0..60 {
        let turn = 0.2 * f64::from(frame);
        let place = Place { position: DQuat::from_rotation_y(0.3) * DVec3::Z * 0.001 * turn, turn };
        let mut placed = sample.clone();
        let [_, right] = placement.step(&place, &mut placed, &mut state, 1.0 / 60.0);
        let right = right.view(&footing, 1, &ground, &placed);
        let start = first.get_or_insert_with(|| right.sole_in_world.clone());
        for (point, start) in right.sole_in_world.iter().zip(start.iter()) {
            assert!(point.distance(*start) < 0.006, "{frame}: {} m", point.distance(*start));
        }
    }
}

#[test]
fn off_it_only_looks() {
    let mut walk = Walk::new("mannequin");
    walk.settings.on = false;
    let ground = GroundKind::Hills.ground(1);
    walk.step(&ground);
    let mut flat = Walk::new("mannequin");
    flat.fitted.sample(walk.phase, &mut flat.sample);
    assert_eq!(walk.sample, flat.sample);
    assert_eq!(walk.feet[0].sole_in_world.len(), Sole::COUNT);
    assert_eq!(walk.feet[0].ankle_in_world, walk.feet[0].animated_ankle_in_world);
}
