//! Clips mirrored, shifted, resampled, reversed, cut, and made differences.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod figures;
mod footing;
mod stepping;

use std::sync::OnceLock;

use figures::shipped;
use footing::feet;
use glam::DVec3;
use motion::{Clip, FittedClip, Mode, Sample, parse_clip, write_clip};
use rig::{Bone, Figure, frames, mirrored_pose};
use stepping::walk;

const SMALL: &str = include_str!("fixtures/small.clip.ron");

fn mannequin() -> &'static Figure {
    static FIGURE: OnceLock<Figure> = OnceLock::new();
    FIGURE.get_or_init(|| shipped("mannequin"))
}

/// The small clip with a root that turns.
fn turning() -> Clip {
    let text = SMALL.replace("turn: 0.0", "turn: 60.0").replace("(0.0, 0.0, 1.2)", "(0.2, 0.0, 1.2)");
    parse_clip(&text).unwrap()
}

fn pose(clip: &Clip, secs: f64) -> rig::Pose {
    let mut sample = Sample::at_rest(mannequin());
    clip.sample(mannequin(), secs, &mut sample);
    let mut pose = mannequin().rest_pose();
    sample.write_to(&mut pose);
    pose.place = clip.root_at(secs);
    pose
}

/// How far any joint of two poses is apart, metres.
fn apart(a: &rig::Pose, b: &rig::Pose) -> f64 {
    let (a, b) = (frames(mannequin(), a), frames(mannequin(), b));
    Bone::ALL.iter().map(|bone| a[*bone].position.distance(b[*bone].position)).fold(0.0, f64::max)
}

#[test]
fn a_mirrored_clip_is_the_mirror_image_at_every_time() {
    let clip = turning();
    let image = clip.mirrored();
    for i in -10..30 {
        let secs = f64::from(i) * 0.073;
        let (own, of) = (pose(&image, secs), pose(&clip, secs));
        let mut goal = mirrored_pose(&of);
        goal.place = own.place;
        assert!(apart(&own, &goal) < 1e-12, "{secs}");
        let flipped = DVec3::new(-of.place.position.x, of.place.position.y, of.place.position.z);
        assert!(own.place.position.distance(flipped) < 1e-12, "{secs}");
        assert_eq!(own.place.turn, -of.place.turn);
    }
    assert_eq!(image.mirrored(), clip);
    assert_eq!(write_clip(&image.mirrored()), write_clip(&clip));
}

#[test]
fn a_stride_mirrored_in_step_begins_with_the_left_heel_again() {
    let figure = mannequin();
    let clip = walk(figure);
    let begins = |clip: &Clip| {
        let fitted = FittedClip::new(clip, figure, figure).unwrap();
        let mut sample = Sample::at_rest(figure);
        fitted.sample(0.06, &mut sample);
        sample.bearing.map(|foot| foot.heel > 0.5)
    };
    assert_eq!(begins(&clip), [true, false]);
    assert_eq!(begins(&clip.mirrored()), [false, true]);
    assert_eq!(begins(&clip.mirrored_in_step()), [true, false]);
    let fitted = FittedClip::new(&clip.mirrored_in_step(), figure, figure).unwrap();
    let found = feet(&fitted, figure);
    assert!(found.sink_m < 0.001 && found.slide_m < 0.003, "{found:?}");
}

#[test]
fn a_shifted_loop_is_the_same_motion_begun_later() {
    let clip = turning();
    for by in [0.0, 0.3, 0.5, -0.2, 7.9] {
        let shifted = clip.shifted(by);
        assert!(parse_clip(&write_clip(&shifted)).is_ok(), "{by}");
        let by = f64::rem_euclid(by, 1.0);
        for i in 0..40 {
            let secs = f64::from(i) * 0.051;
            let (own, mut goal) = (pose(&shifted, secs), pose(&clip, secs + by));
            let start = clip.root_at(by).world_from_figure();
            goal.place.position = start.inverse().point(goal.place.position);
            goal.place.turn -= clip.root_at(by).turn;
            assert!(apart(&own, &goal) < 1e-9, "{by} {secs}");
        }
    }
    let once = Clip { loops: false, ..clip };
    assert_eq!(once.shifted(0.3), once);
}

#[test]
fn a_resampled_clip_meets_the_original_at_its_keys_and_is_near_between() {
    let clip = turning();
    let dense = clip.resampled(mannequin(), 60.0);
    assert_eq!(dense.joints[&Bone::LeftUpperLeg].keys.len(), 60);
    for i in 0..=120 {
        let secs = f64::from(i) / 120.0;
        let bound = if i % 2 == 0 { 1e-12 } else { 0.002 };
        assert!(apart(&pose(&dense, secs), &pose(&clip, secs)) < bound, "{secs}");
    }
    assert!(parse_clip(&write_clip(&dense)).is_ok());
    for rate in [f64::NAN, 0.0, -5.0, f64::INFINITY, 1e9] {
        let keys = clip.resampled(mannequin(), rate).joints[&Bone::Neck].keys.len();
        assert!((1..=1000).contains(&keys), "{rate}: {keys}");
    }
}

#[test]
fn backward_and_backward_again_is_forward() {
    let mut clip = turning();
    clip.stride = false;
    clip.joints.get_mut(&Bone::Neck).unwrap().mode = Mode::Linear;
    let back = clip.reversed();
    for i in 0..=20 {
        let secs = f64::from(i) / 20.0;
        let (own, mut goal) = (pose(&back, secs), pose(&clip, 1.0 - secs));
        let end = clip.root_travel();
        goal.place.position = end.world_from_figure().inverse().point(clip.root_at(1.0 - secs).position);
        goal.place.turn -= end.turn;
        assert!(apart(&own, &goal) < 1e-9, "{secs}");
        assert!(apart(&pose(&back.reversed(), secs), &pose(&clip, secs)) < 1e-9, "{secs}");
    }
}

#[test]
fn a_part_goes_straight_through_what_was_there() {
    let clip = turning().resampled(mannequin(), 100.0);
    let part = clip.cut(mannequin(), 0.255, 0.745);
    assert!(!part.loops && (part.length_secs - 0.49).abs() < 1e-12);
    assert!(parse_clip(&write_clip(&part)).is_ok());
    let start = clip.root_at(0.255).world_from_figure().inverse();
    for i in 0..=49 {
        let secs = f64::from(i) * 0.01;
        let (own, mut goal) = (pose(&part, secs), pose(&clip, secs + 0.255));
        goal.place.position = start.point(goal.place.position);
        goal.place.turn -= clip.root_at(0.255).turn;
        assert!(apart(&own, &goal) < 1e-9, "{secs}");
    }
    for (from, to) in [(f64::NAN, f64::NAN), (2.0, 1.0), (-1.0, 9.0)] {
        assert!(parse_clip(&write_clip(&clip.cut(mannequin(), from, to))).is_ok(), "{from} {to}");
    }
}

#[test]
fn a_difference_added_to_its_reference_is_the_clip() {
    let clip = turning();
    let mut reference = Sample::at_rest(mannequin());
    reference.hips += DVec3::new(0.0, -0.1, 0.02);
    reference.angles[Bone::Spine.index()].flexion = 12.0;
    reference.angles[Bone::LeftLowerLeg.index()].flexion = 30.0;
    reference.angles[Bone::LeftUpperLeg.index()].abduction = -3.0;
    let difference = clip.less(mannequin(), &reference);
    assert!(difference.root.is_none());
    let (mut sample, mut beyond) = (Sample::at_rest(mannequin()), Sample::at_rest(mannequin()));
    for i in 0..20 {
        let secs = f64::from(i) * 0.05;
        difference.sample(mannequin(), secs, &mut beyond);
        let mut sum = reference.clone();
        sum.add(&beyond, 1.0);
        clip.sample(mannequin(), secs, &mut sample);
        assert!(sum.hips.distance(sample.hips) < 1e-12);
        for (bone, (a, b)) in Bone::ALL.iter().zip(sum.angles.iter().zip(&sample.angles)) {
            let off = [a.flexion - b.flexion, a.abduction - b.abduction, a.twist - b.twist];
            assert!(off.iter().all(|d| d.abs() < 0.05), "{secs} {bone}: {a:?} {b:?}");
        }
        let mut none = reference.clone();
        none.add(&beyond, 0.0);
        assert_eq!(none, reference);
    }
}
