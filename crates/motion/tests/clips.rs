//! Clips: tracks between their keys, loops and root motion, and their files.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod figures;

use std::collections::BTreeMap;

use figures::shipped;
use glam::DVec3;
use motion::{Clip, Key, Mode, Track, parse_clip, write_clip};
use proptest::prelude::*;
use rig::{Angles, Bone, Place, Size};

const SMALL: &str = include_str!("fixtures/small.clip.ron");

fn flexion(degrees: f64) -> Angles {
    Angles { flexion: degrees, ..Angles::REST }
}

fn track<T>(mode: Mode, keys: impl IntoIterator<Item = (f64, T)>) -> Track<T> {
    Track { mode, keys: keys.into_iter().map(|(at_secs, value)| Key { at_secs, value }).collect() }
}

/// A clip of one joint's track that loops, with a root.
fn looping(keys: Track<Angles>, length_secs: f64, root: Option<Track<Place>>) -> Clip {
    Clip {
        name: "small".into(),
        figure: None,
        size: None,
        length_secs,
        loops: true,
        stride: false,
        root,
        hips: None,
        joints: BTreeMap::from([(Bone::LeftLowerLeg, keys)]),
    }
}

/// Keys at random times with random values.
fn keys() -> impl Strategy<Value = Vec<(f64, DVec3)>> {
    let number = || -100.0..100.0;
    let value = (number(), number(), number()).prop_map(|(x, y, z)| DVec3::new(x, y, z));
    proptest::collection::vec((0.01..0.5, value), 1..8).prop_map(|steps| {
        let mut at = -0.01;
        steps.into_iter().map(|(step, value)| (at += step, (at, value)).1).collect()
    })
}

fn modes() -> impl Strategy<Value = Mode> {
    prop_oneof![Just(Mode::Step), Just(Mode::Linear), Just(Mode::Cubic)]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn keys_are_hit_bit_for_bit(keys in keys(), mode in modes(), looped in any::<bool>()) {
        let around = looped.then(|| keys.last().unwrap().0 + 0.1);
        let track = track(mode, keys.clone());
        for (at, value) in keys {
            prop_assert_eq!(track.at(at, around), value);
        }
    }

    #[test]
    fn a_straight_track_stays_between_its_keys(keys in keys(), u in 0.0..1.0) {
        let track = track(Mode::Linear, keys.clone());
        for pair in keys.windows(2) {
            let [(ta, a), (tb, b)] = [pair[0], pair[1]];
            let v = track.at(ta + (tb - ta) * u, None);
            prop_assert!(v.cmpge(a.min(b)).all() && v.cmple(a.max(b)).all(), "{v} between {a} and {b}");
        }
    }

    #[test]
    fn a_cubic_loop_is_continuous_in_value_and_rate(keys in keys()) {
        prop_assume!(keys.len() > 2);
        let (length, h) = (keys.last().unwrap().0 + 0.2, 1e-6);
        let track = track(Mode::Cubic, keys.clone());
        let at = |t: f64| track.at(t, Some(length));
        for t in keys.iter().map(|k| k.0).chain([0.0, length]) {
            prop_assert!(at(t - 1e-9).distance(at(t + 1e-9)) < 1e-3);
            let (before, after) = ((at(t) - at(t - h)) / h, (at(t + h) - at(t)) / h);
            // Rates reach some ten thousand a second, second derivatives some million.
            prop_assert!(before.distance(after) < 5.0, "{before} then {after} at {t}");
        }
    }

    #[test]
    fn before_and_after_its_keys_a_track_stays_at_their_ends(keys in keys(), mode in modes(), by in 0.0..1e6) {
        let track = track(mode, keys.clone());
        prop_assert_eq!(track.at(keys[0].0 - by, None), keys[0].1);
        prop_assert_eq!(track.at(keys[keys.len() - 1].0 + by, None), keys[keys.len() - 1].1);
    }

    #[test]
    fn written_clips_come_back_bit_for_bit(keys in keys(), mode in modes(), loops in any::<bool>()) {
        let length_secs = keys.last().unwrap().0 + 0.3;
        let angles = keys.iter().map(|(t, v)| (*t, Angles { flexion: v.x, abduction: -0.0, twist: v.z }));
        let root = [(0.0, Place::default()), (length_secs, Place { position: keys[0].1, turn: 1.0 / 3.0 })];
        let mut clip = looping(track(mode, angles), length_secs, Some(track(Mode::Linear, root)));
        clip.hips = Some(track(mode, keys.clone()));
        clip.loops = loops;
        clip.size = Some(Size::of(&shipped_skeleton()));
        let text = write_clip(&clip);
        let back = parse_clip(&text).unwrap();
        // Equal values may have other bits: texts tell -0 from 0.
        prop_assert_eq!(&back, &clip);
        prop_assert_eq!(write_clip(&back), text);
    }

    #[test]
    fn damaged_clips_never_panic(cut in 0..SMALL.len(), at in 0..SMALL.len(), byte in any::<u8>()) {
        let _ = parse_clip(SMALL.get(..cut).unwrap_or(""));
        let mut bytes = SMALL.as_bytes().to_vec();
        bytes[at] = byte;
        if let Ok(clip) = parse_clip(&String::from_utf8_lossy(&bytes)) {
            prop_assert!(clip.length_secs.is_finite() && clip.root_at(1e9).position.is_finite());
        }
    }
}

fn shipped_skeleton() -> rig::Skeleton {
    static SKELETON: std::sync::OnceLock<rig::Skeleton> = std::sync::OnceLock::new();
    SKELETON.get_or_init(|| shipped("mannequin").skeleton).clone()
}

#[test]
fn a_step_stays_until_the_next_key() {
    let track = track(Mode::Step, [(0.0, flexion(1.0)), (1.0, flexion(2.0))]);
    assert_eq!(track.at(0.999_999, None), flexion(1.0));
    assert_eq!(track.at(1.0, None), flexion(2.0));
    assert_eq!(track.at(1.7, Some(2.0)), flexion(2.0));
    assert_eq!(track.at(2.0, Some(2.0)), flexion(1.0));
}

#[test]
fn a_loop_leads_from_its_last_key_to_its_first() {
    let track = track(Mode::Linear, [(0.25, flexion(10.0)), (0.75, flexion(20.0))]);
    for (t, degrees) in [(0.75, 20.0), (1.0, 15.0), (0.0, 15.0), (-0.125, 17.5), (7.125, 12.5)] {
        assert!((track.at(t, Some(1.0)).flexion - degrees).abs() < 1e-12, "{t}");
    }
}

#[test]
fn a_cubic_follows_a_parabola_through_uneven_keys() {
    let keys = [0.0, 0.1, 0.5, 0.6, 1.1, 1.3].map(|t| (t, flexion(3.0 * t * t - t + 2.0)));
    let track = track(Mode::Cubic, keys);
    for i in 0..100 {
        let t = 0.1 + f64::from(i) * 0.01;
        assert!((track.at(t, None).flexion - (3.0 * t * t - t + 2.0)).abs() < 1e-12, "{t}");
    }
}

#[test]
fn a_ball_joint_goes_straight_by_the_shortest_turn_and_a_hinge_by_its_angle() {
    let skeleton = shipped_skeleton();
    let (from, to) = (
        Angles { flexion: 80.0, abduction: 0.0, twist: 0.0 },
        Angles { flexion: 0.0, abduction: 70.0, twist: 30.0 },
    );
    let track = track(Mode::Linear, [(0.0, from), (1.0, to)]);
    let ball = skeleton.joint(Bone::LeftUpperLeg);
    let middle = ball.unwrap().rotation(track.angles_at(0.5, None, ball));
    let (a, b) = (ball.unwrap().rotation(from), ball.unwrap().rotation(to));
    assert!((middle.angle_between(a) - middle.angle_between(b)).abs() < 1e-9);
    assert!((middle.angle_between(a) * 2.0 - a.angle_between(b)).abs() < 1e-9);
    let hinge = skeleton.joint(Bone::LeftLowerLeg);
    assert_eq!(track.angles_at(0.5, None, hinge).flexion, 40.0);
    assert_eq!(track.angles_at(1.0, None, ball), to);
}

#[test]
fn no_number_makes_a_nan() {
    let track = track(Mode::Cubic, [(0.0, flexion(1.0)), (1.0, flexion(2.0))]);
    for secs in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 5e-324] {
        for around in [None, Some(1.5), Some(0.0), Some(f64::NAN)] {
            assert!(track.at(secs, around).flexion.is_finite(), "{secs} {around:?}");
        }
    }
    let empty: Track<Angles> = Track { mode: Mode::Cubic, keys: vec![] };
    assert_eq!(empty.at(0.3, Some(1.0)), Angles::REST);
}

#[test]
fn a_walk_in_a_circle_goes_on_without_a_jump() {
    let arc = |t: f64| {
        let turn = 40.0 * t;
        let radius = 2.0;
        let (sine, cosine) = turn.to_radians().sin_cos();
        Place { position: DVec3::new(radius * (1.0 - cosine), 0.0, radius * sine), turn }
    };
    for mode in [Mode::Linear, Mode::Cubic] {
        let root = track(mode, [0.0, 0.3, 0.5, 1.0].map(|t| (t, arc(t))));
        let clip = looping(track(mode, [(0.0, flexion(0.0))]), 1.0, Some(root));
        for k in [-3.0, -1.0, 0.0, 1.0, 2.0, 9.0] {
            let (at, goal) = (clip.root_at(k), arc(k));
            assert!(at.position.distance(goal.position) < 1e-9, "{k}: {at:?} {goal:?}");
            assert!((at.turn - goal.turn).abs() < 1e-9);
            let (before, after) = (clip.root_at(k - 1e-9), clip.root_at(k + 1e-9));
            assert!(before.position.distance(after.position) < 1e-7);
        }
        if mode == Mode::Cubic {
            for i in 0..300 {
                let t = f64::from(i) * 0.01;
                let (at, goal) = (clip.root_at(t).position, arc(t).position);
                assert!(at.distance(goal) < 0.004, "{t}: {at} {goal}");
                let h = 1e-5;
                let rate = |t: f64| (clip.root_at(t + h).position - clip.root_at(t).position) / h;
                assert!((rate(t - h) - rate(t)).length() < 1e-2, "{t}");
            }
        }
    }
}

#[test]
fn the_small_clip_is_read_as_it_is_written_by_hand() {
    let clip = parse_clip(SMALL).unwrap();
    assert_eq!((clip.name.as_str(), clip.length_secs, clip.loops, clip.stride), ("small", 1.0, true, true));
    let thigh = &clip.joints[&Bone::LeftUpperLeg];
    assert_eq!(thigh.mode, Mode::Cubic);
    assert_eq!(
        thigh.keys[1],
        Key { at_secs: 0.5, value: Angles { flexion: -10.0, abduction: 1.0, twist: 0.0 } }
    );
    assert_eq!(clip.root_travel().position.z, 1.2);
    assert!(
        write_clip(&clip).lines().any(|line| line == "            (0.5, (flexion: -10.0, abduction: 1.0)),")
    );
}

#[test]
fn faults_say_what_and_where() {
    let cases = [
        ("length: 1.0", "length: -1.0", "length -1 s, expected 0.01 to 300"),
        ("(0.5, (flexion: -10.0", "(0.0, (flexion: -10.0", "14:"),
        ("(0.5, (flexion: -10.0", "(0.0, (flexion: -10.0", "key 2 at 0 s, expected a time after 0 s"),
        (
            "(0.5, (flexion: -10.0",
            "(1.5, (flexion: -10.0",
            "leftUpperLeg: key 2 at 1.5 s, beyond the clip's length of 1 s",
        ),
        ("(0.5, (flexion: -10.0", "(0.5, (flexon: -10.0", "flexon"),
        ("(0.5, (flexion: -10.0", "(0.5, (flexion: NaN", "expected a number between"),
        ("loops: true", "loops: false", "a stride that doesn't loop"),
        ("\"leftUpperLeg\"", "\"leftUperLeg\"", "such as \"leftUpperLeg\""),
        (
            "(1.0, (position: (0.0, 0.0, 1.2)",
            "(0.9, (position: (0.0, 0.0, 1.2)",
            "root: keys from 0 to 0.9 s, expected 0 to 1 s",
        ),
        ("(1.0, (0.0, 0.93", "(1.0, (0.0, 0.90", "hips: the last key of the loop is 0.0300 off the first"),
        ("version: 1", "version: 7", "version 7 is not known"),
        ("keys: [(0.0, (twist: 3.0))]", "keys: []", "no keys, expected one at least"),
        ("mode: Step", "mode: Stop", "Stop"),
        ("name: \"small\",", "", "name"),
    ];
    for (from, to, told) in cases {
        assert!(SMALL.contains(from), "{from}");
        let fault = parse_clip(&SMALL.replacen(from, to, 1)).unwrap_err().to_string();
        assert!(fault.contains(told), "{to}: {fault}");
        assert!(fault.split(':').take(2).all(|n| n.parse::<usize>().is_ok_and(|n| n > 0)), "{fault}");
    }
}
