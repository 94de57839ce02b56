//! Clips fitted to figures: their own unchanged, others with feet as still and as high.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod figures;
mod footing;
mod stepping;

use std::sync::OnceLock;

use figures::{all_shipped, shipped};
use footing::feet;
use motion::{Clip, FitError, FittedClip, Sample, Travel};
use rig::{Angles, Bone, Dof, Figure, Place};
use stepping::walk;

fn mannequin() -> &'static Figure {
    static FIGURE: OnceLock<Figure> = OnceLock::new();
    FIGURE.get_or_init(|| shipped("mannequin"))
}

fn walking() -> &'static Clip {
    static CLIP: OnceLock<Clip> = OnceLock::new();
    CLIP.get_or_init(|| walk(mannequin()))
}

#[test]
fn a_clip_of_the_figure_itself_is_left_as_it_is() {
    let fitted = FittedClip::new(walking(), mannequin(), mannequin()).unwrap();
    assert_eq!(fitted.length_secs(), walking().length_secs);
    let (mut own, mut given) = (Sample::at_rest(mannequin()), Sample::at_rest(mannequin()));
    for i in 0..132 {
        let phase = f64::from(i) / 132.0;
        fitted.sample(phase, &mut own);
        walking().sample(mannequin(), walking().length_secs * phase, &mut given);
        assert_eq!((own.hips, own.angles), (given.hips, given.angles), "{i}");
    }
}

#[test]
fn feet_are_as_still_and_as_high_on_every_preset() {
    for (name, figure) in all_shipped() {
        let fitted = FittedClip::new(walking(), mannequin(), &figure).unwrap();
        let found = feet(&fitted, &figure);
        assert!(found.sink_m < 0.002 && found.slide_m < 0.005 && found.heel_m < 0.005, "{name}: {found:?}");
        // The foot rolls over its ball, about the toes' joint, which is some 22 mm above.
        assert!(found.ball_m < 0.018 && found.float_m < 0.011, "{name}: {found:?}");
        assert!((0.2..0.4).contains(&found.standing), "{name}: {found:?}");
    }
}

#[test]
fn steps_and_paces_follow_the_legs() {
    let height = |figure: &Figure| figure.skeleton.rest_position(Bone::LeftUpperLeg).y;
    for (name, figure) in all_shipped() {
        let fitted = FittedClip::new(walking(), mannequin(), &figure).unwrap();
        let ratio = height(&figure) / height(mannequin());
        let (own, of) = (fitted.travel().velocity.y, walking().travel().velocity.y);
        assert!((own / of - ratio.sqrt()).abs() < 1e-3, "{name}: {own} and {of}");
        assert!((fitted.length_secs() / walking().length_secs - ratio.sqrt()).abs() < 1e-3, "{name}");
        assert!((fitted.length_secs() * fitted.frequency() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn no_joint_of_a_preset_turns_much_faster_than_the_mannequin_s_and_none_leaves_its_range() {
    let fastest = |fitted: &FittedClip, figure: &Figure, bone: Bone| {
        let (mut a, mut b) = (Sample::at_rest(figure), Sample::at_rest(figure));
        let turn = |i: i32| {
            fitted.sample(f64::from(i) / 132.0, &mut a);
            fitted.sample(f64::from(i + 1) / 132.0, &mut b);
            let angles = [a.angles[bone.index()], b.angles[bone.index()]];
            let joint = figure.skeleton.joint(bone).unwrap();
            for dof in Dof::ALL {
                let range = joint.range(dof);
                let held =
                    range.is_none_or(|r| (r.clamp(angles[0].get(dof)) - angles[0].get(dof)).abs() < 1e-6);
                assert!(held || figure.name == "mannequin", "{} {bone} {dof:?}", figure.name);
            }
            joint.rotation(angles[0]).angle_between(joint.rotation(angles[1])).to_degrees()
        };
        (0..132).map(turn).fold(0.0, f64::max)
    };
    let own = FittedClip::new(walking(), mannequin(), mannequin()).unwrap();
    for (name, figure) in all_shipped() {
        let fitted = FittedClip::new(walking(), mannequin(), &figure).unwrap();
        for bone in [Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::RightFoot, Bone::RightToes] {
            let (turn, of) = (fastest(&fitted, &figure, bone), fastest(&own, mannequin(), bone));
            assert!(turn < 1.35 * of + 0.5, "{name} {bone}: {turn} degrees a sample instead of {of}");
        }
    }
}

#[test]
fn a_loop_is_continuous_over_its_seam_and_others_stay_at_their_ends() {
    let fitted = FittedClip::new(walking(), mannequin(), &shipped("child")).unwrap();
    let (mut a, mut b) = (Sample::at_rest(mannequin()), Sample::at_rest(mannequin()));
    for (p, q) in [(1.0, 0.0), (-0.25, 0.75), (7.5, 0.5), (f64::NAN, 0.0), (1.0 - 1e-15, 0.0)] {
        fitted.sample(p, &mut a);
        fitted.sample(q, &mut b);
        assert_eq!(a, b, "{p} and {q}");
    }
    let once = Clip { loops: false, stride: false, ..walking().clone() };
    let fitted = FittedClip::new(&once, mannequin(), &shipped("heroic")).unwrap();
    for (p, q) in [(-3.0, 0.0), (1.5, 1.0), (f64::INFINITY, 0.0)] {
        fitted.sample(p, &mut a);
        fitted.sample(q, &mut b);
        assert_eq!(a, b, "{p} and {q}");
    }
    fitted.sample(0.5, &mut b);
    assert_ne!(a, b);
}

#[test]
fn a_root_that_is_not_steady_moves_the_hips_instead() {
    let mut clip = walking().clone();
    let root = clip.root.as_mut().unwrap();
    let half = Place { position: glam::DVec3::new(0.02, 0.0, 0.55), turn: 5.0 };
    root.keys.insert(1, motion::Key { at_secs: 0.55, value: half });
    let fitted = FittedClip::new(&clip, mannequin(), mannequin()).unwrap();
    let mut sample = Sample::at_rest(mannequin());
    for i in 0..=20 {
        let phase = f64::from(i) / 20.0 * 0.999;
        fitted.sample(phase, &mut sample);
        let mut pose = mannequin().rest_pose();
        sample.write_to(&mut pose);
        pose.place = fitted.travel().place_after(phase * fitted.length_secs());
        let foot = rig::frames(mannequin(), &pose)[Bone::LeftFoot];
        clip.sample(mannequin(), phase * clip.length_secs, &mut sample);
        sample.write_to(&mut pose);
        pose.place = clip.root_at(phase * clip.length_secs);
        let goal = rig::frames(mannequin(), &pose)[Bone::LeftFoot];
        // Straight between samples where the root has a corner.
        assert!(foot.position.distance(goal.position) < 5e-4, "{phase}: {} {}", foot.position, goal.position);
        assert!(foot.rotation.angle_between(goal.rotation) < 2e-3, "{phase}");
    }
}

#[test]
fn a_travel_along_an_arc_gets_where_it_should() {
    for (x, z, turn) in
        [(0.3, 1.2, 0.0), (0.0, 1.0, 90.0), (-0.4, 0.2, -170.0), (0.1, 0.0, 1e-12), (1.0, 1.0, 360.0)]
    {
        let place = Place { position: glam::DVec3::new(x, 0.0, z), turn };
        let travel = Travel::to_place(place, 2.0);
        let end = travel.place_after(2.0);
        assert!(travel.velocity.is_finite());
        assert!(turn == 360.0 || end.position.distance(place.position) < 1e-9, "{place:?} {end:?}");
        assert_eq!(end.turn, turn);
        // Many small steps, each in the figure's own axes.
        let (mut at, h) = (Place::default(), 2.0 / 2000.0);
        for _ in 0..2000 {
            let step = glam::DVec3::new(travel.velocity.x, 0.0, travel.velocity.y) * h;
            let middle = glam::DQuat::from_rotation_y((at.turn + travel.turn_rate * h * 0.5).to_radians());
            at = Place { position: at.position + middle * step, turn: at.turn + travel.turn_rate * h };
        }
        assert!(at.position.distance(end.position) < 1e-4, "{at:?} {end:?}");
    }
}

#[test]
fn a_figure_without_legs_is_an_error_that_names_it() {
    let legless = Figure {
        skeleton: rig::Skeleton::new(
            mannequin().skeleton.joints().filter(|j| j.bone < Bone::LeftUpperLeg).cloned().collect(),
        )
        .unwrap(),
        name: "bust".into(),
        ..mannequin().clone()
    };
    let error = FittedClip::new(walking(), mannequin(), &legless).unwrap_err();
    assert!(matches!(&error, FitError::NoLegs { figure, .. } if figure == "bust"), "{error}");
    assert!(error.to_string().contains("hand-made"), "{error}");
}

#[test]
fn wild_clips_give_finite_samples() {
    let mut clip = walking().clone();
    let figure = shipped("elderly");
    let wild = [(0.0, 1e6), (0.2, -1e6), (0.21, 12345.6), (1.0, 179.999)];
    for bone in [Bone::LeftUpperLeg, Bone::RightLowerLeg, Bone::LeftFoot, Bone::LeftToes, Bone::Hips] {
        let keys = wild.map(|(at_secs, a)| {
            let value = Angles { flexion: a, abduction: -a, twist: a * 0.5 };
            motion::Key { at_secs, value }
        });
        for mode in [motion::Mode::Step, motion::Mode::Linear, motion::Mode::Cubic] {
            clip.joints.insert(bone, motion::Track { mode, keys: keys.to_vec() });
            clip.hips.as_mut().unwrap().keys[0].value.y = 1e6;
            let fitted = FittedClip::new(&clip, mannequin(), &figure).unwrap();
            let mut sample = Sample::at_rest(&figure);
            for i in 0..50 {
                fitted.sample(f64::from(i) / 50.0, &mut sample);
                let sums = sample.angles.iter().map(|a| a.flexion + a.abduction + a.twist);
                assert!(sample.hips.is_finite() && sums.sum::<f64>().is_finite(), "{bone} {mode:?} {i}");
                let bearing = sample.bearing.map(|b| [b.heel, b.ball]);
                assert!(bearing.iter().flatten().all(|b| (0.0..=1.0).contains(b)), "{bearing:?}");
            }
        }
    }
}
