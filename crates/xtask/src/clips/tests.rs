//! What the shipped clips promise.

use std::sync::LazyLock;

use ::motion::{Clip, Sample, Soles, parse_clip, write_clip};
use glam::{DQuat, DVec3};
use rig::{Bone, Dof, Figure, Frames, Place, Pose, center_of_mass, frames};

use super::motions;

static FIGURE: LazyLock<Figure> = LazyLock::new(|| interchange::figure::bare_mannequin().unwrap());
static CLIPS: LazyLock<Vec<Clip>> = LazyLock::new(|| {
    let folder = crate::root().join("assets/clips");
    let mut paths: Vec<_> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.to_string_lossy().ends_with(".clip.ron"));
    paths.sort();
    paths.iter().map(|path| parse_clip(&std::fs::read_to_string(path).unwrap()).unwrap()).collect()
});

fn clip(name: &str) -> &'static Clip {
    CLIPS.iter().find(|clip| clip.name == name).unwrap()
}

fn strides() -> impl Iterator<Item = &'static Clip> {
    CLIPS.iter().filter(|clip| clip.stride)
}

/// The figure at a time, where the root motion has brought it.
fn pose(clip: &Clip, secs: f64) -> Pose {
    let rest = FIGURE.rest_pose();
    let mut sample = Sample { hips: rest.hips, angles: rest.angles, bearing: Default::default() };
    clip.sample(&FIGURE, secs, &mut sample);
    Pose { place: clip.root_at(secs), hips: sample.hips, angles: sample.angles, ..rest }
}

/// Frames at even times of a clip, from its start over a number of lengths.
fn run(clip: &Clip, per_length: usize, lengths: usize) -> Vec<(Pose, Frames)> {
    let at = |i: usize| pose(clip, i as f64 / per_length as f64 * clip.length_secs);
    let poses = (0..=per_length * lengths).map(at);
    poses.map(|pose| (pose.clone(), frames(&FIGURE, &pose))).collect()
}

fn degrees(clip: &Clip, phase: f64, bone: Bone, dof: Dof) -> f64 {
    pose(clip, phase * clip.length_secs).angles(bone).get(dof)
}

#[test]
fn the_stored_clips_are_those_that_are_made() {
    let made = motions(&FIGURE).unwrap();
    assert_eq!(CLIPS.len(), made.len());
    for motion in made {
        let path = crate::root().join(format!("assets/clips/{}.clip.ron", motion.name));
        let text = write_clip(&motion.clip(&FIGURE).unwrap());
        assert!(std::fs::read_to_string(path).unwrap() == text, "{}: run `cargo xtask clips`", motion.name);
    }
}

/// Farther from where it was when it came down than this, a point has slid.
fn slide(points: &[Vec<DVec3>], down: impl Fn(&[DVec3]) -> bool, of: std::ops::Range<usize>) -> f64 {
    let (mut most, mut from): (f64, Option<&Vec<DVec3>>) = (0.0, None);
    for now in points {
        from = if down(now) { from.or(Some(now)) } else { None };
        if let Some(from) = from {
            let way = |i: usize| (now[i] - from[i]).with_y(0.0).length();
            most = of.clone().map(way).fold(most, f64::max);
        }
    }
    most
}

#[test]
fn feet_never_sink_and_stand_still_while_they_stand() {
    let soles = Soles::of(&FIGURE).unwrap();
    for clip in CLIPS.iter() {
        let run = run(clip, 240, if clip.loops { 2 } else { 1 });
        for sole in &soles.feet {
            let points: Vec<Vec<DVec3>> =
                run.iter().map(|(_, frames)| sole.points(frames).to_vec()).collect();
            let low = points.iter().flatten().map(|point| point.y).fold(f64::INFINITY, f64::min);
            let flat = slide(&points, |now| now.iter().all(|point| point.y < 0.002), 0..9);
            let toes = slide(&points, |now| now[6..9].iter().all(|point| point.y < 0.0005), 6..9);
            let heel = slide(&points, |now| now[0].y < 0.0005, 0..1);
            println!(
                "{:16} lowest {:6.2} mm, slides: flat {:.2}, toes {:.2}, heel {:.2}",
                clip.name,
                low * 1e3,
                flat * 1e3,
                toes * 1e3,
                heel * 1e3
            );
            let at = points.iter().position(|now| now.iter().any(|point| point.y == low)).unwrap() % 240;
            assert!(low > -0.001, "{}: {low} m at {at} of 240", clip.name);
            assert!(flat < 0.001 && toes.max(heel) < 0.003, "{}: {flat} {toes} {heel} m", clip.name);
        }
    }
}

#[test]
fn loops_close_in_value_and_rate() {
    for clip in CLIPS.iter().filter(|clip| clip.loops) {
        let tick = 1e-4;
        let [before, end, start, after] =
            [clip.length_secs - tick, clip.length_secs, 0.0, tick].map(|secs| pose(clip, secs));
        for bone in Bone::ALL {
            for dof in Dof::ALL {
                let value = |pose: &Pose| pose.angles(bone).get(dof);
                let (out, into) =
                    ((value(&end) - value(&before)) / tick, (value(&after) - value(&start)) / tick);
                assert!((value(&end) - value(&start)).abs() < 1e-6, "{} {bone:?} {dof:?}", clip.name);
                assert!((out - into).abs() < 4.0, "{} {bone:?} {dof:?}: {out} {into} degrees/s", clip.name);
            }
        }
        let rates = [(end.hips - before.hips) / tick, (after.hips - start.hips) / tick];
        assert!(end.hips.distance(start.hips) < 1e-9 && rates[0].distance(rates[1]) < 0.02, "{}", clip.name);
    }
}

#[test]
fn joints_stay_in_range_and_knees_never_lock() {
    for clip in CLIPS.iter() {
        for (pose, _) in run(clip, 240, 1) {
            for joint in FIGURE.skeleton.joints() {
                for dof in joint.dofs() {
                    let (range, angle) = (joint.range(dof).unwrap(), pose.angles(joint.bone).get(dof));
                    let off = angle - range.clamp(angle);
                    assert!(off == 0.0, "{} {:?} {dof:?}: {angle} degrees", clip.name, joint.bone);
                }
            }
            for side in [Bone::LeftLowerLeg, Bone::RightLowerLeg] {
                assert!(pose.angles(side).flexion > 4.5, "{}: {:?}", clip.name, pose.angles(side));
            }
        }
    }
}

/// Turns of a joint from frame to frame at 60 a second, degrees: the most, and the most that one differs from the next.
fn turns(clip: &Clip, bone: Bone) -> (f64, f64) {
    let joint = FIGURE.skeleton.joint(bone).unwrap();
    let count = (clip.length_secs * 60.0).floor() as usize;
    let turn = |i: usize| joint.rotation(pose(clip, i as f64 / 60.0).angles(bone));
    let steps: Vec<DVec3> = (0..count)
        .map(|i| (turn(i).conjugate() * turn(i + 1)).to_scaled_axis().map(f64::to_degrees))
        .collect();
    let most = steps.iter().map(|step| step.length()).fold(0.0, f64::max);
    (most, steps.windows(2).map(|pair| pair[0].distance(pair[1])).fold(0.0, f64::max))
}

#[test]
fn no_joint_jerks() {
    for clip in CLIPS.iter() {
        let (turned, jerked) = match clip.name.as_str() {
            "jog" => (11.5, 9.0),
            "idle" => (0.3, 0.05),
            "sit-to-stand" => (2.5, 0.5),
            _ => (8.5, 7.6),
        };
        let mut worst = ((0.0, Bone::Hips), (0.0, Bone::Hips));
        for joint in FIGURE.skeleton.joints() {
            let (most, change) = turns(clip, joint.bone);
            worst.0 = if most > worst.0.0 { (most, joint.bone) } else { worst.0 };
            worst.1 = if change > worst.1.0 { (change, joint.bone) } else { worst.1 };
        }
        println!("{:16} {worst:.2?}", clip.name);
        assert!(worst.0.0 < turned && worst.1.0 < jerked, "{}: {worst:?}", clip.name);
    }
}

#[test]
fn strides_travel_as_fast_as_they_say() {
    let expected = [
        ("walk", [0.0, 1.40], 0.0),
        ("walk-back", [0.0, -0.90], 0.0),
        ("jog", [0.0, 2.80], 0.0),
        ("strafe-left", [0.80, 0.0], 0.0),
        ("strafe-right", [-0.80, 0.0], 0.0),
        ("turn-left", [0.0, 0.0], 70.0),
        ("turn-right", [0.0, 0.0], -70.0),
    ];
    for (name, [left, ahead], turn) in expected {
        let clip = clip(name);
        let Place { position, turn: turned } = clip.root_travel();
        let speed = position / clip.length_secs;
        assert!(speed.distance(DVec3::new(left, 0.0, ahead)) < 1e-3, "{name}: {speed}");
        assert!((turned / clip.length_secs - turn).abs() < 1e-3, "{name}: {turned}");
    }
}

/// The pose of the other side: twins exchanged, lists and turns of the middle negated.
fn mirrored(pose: &Pose) -> Pose {
    let mut other = pose.clone();
    other.hips.x = -pose.hips.x;
    for bone in Bone::ALL {
        let mut angles = pose.angles(bone.mirrored());
        if bone.mirrored() == bone {
            (angles.abduction, angles.twist) = (-angles.abduction, -angles.twist);
        }
        other.angles[bone.index()] = angles;
    }
    other
}

#[test]
fn the_right_half_of_a_stride_mirrors_the_left() {
    let pairs = [
        ("walk", "walk"),
        ("walk-back", "walk-back"),
        ("jog", "jog"),
        ("strafe-left", "strafe-right"),
        ("turn-left", "turn-right"),
        ("walk-turn-left", "walk-turn-right"),
    ];
    for (one, other) in pairs {
        for i in 0..50 {
            let phase = i as f64 / 50.0;
            let (one, other) = (clip(one), clip(other));
            let here = mirrored(&pose(one, phase * one.length_secs));
            let there = pose(other, (phase + 0.5).fract() * other.length_secs);
            assert!(here.hips.distance(there.hips) < 1e-4, "{} at {phase}", one.name);
            for bone in Bone::ALL {
                for dof in Dof::ALL {
                    let off = here.angles(bone).get(dof) - there.angles(bone).get(dof);
                    assert!(off.abs() < 0.02, "{} at {phase}: {bone:?} {dof:?} by {off}", one.name);
                }
            }
        }
    }
}

/// Thigh from the vertical, knee and ankle by 5 % of the stride. Source: `winter`, table A.1, subject WM22.
const MEASURED: [[f64; 3]; 20] = [
    [20.0, 0.0, 0.0],
    [18.0, 6.0, -8.0],
    [18.0, 14.0, -6.0],
    [14.0, 16.0, -1.0],
    [8.0, 13.0, 2.0],
    [2.0, 11.0, 4.0],
    [-2.0, 8.0, 5.0],
    [-7.0, 6.0, 7.0],
    [-12.0, 5.0, 7.0],
    [-16.0, 7.0, 7.0],
    [-17.0, 15.0, 2.0],
    [-15.0, 27.0, -7.0],
    [-9.0, 45.0, -20.0],
    [1.0, 60.0, -19.0],
    [12.0, 67.0, -11.0],
    [20.0, 62.0, -5.0],
    [24.0, 49.0, -2.0],
    [26.0, 31.0, -1.0],
    [24.0, 10.0, 0.0],
    [21.0, -3.0, 2.0],
];

#[test]
fn the_walk_bends_its_legs_as_people_do() {
    let mut squares = [0.0; 3];
    for (i, measured) in MEASURED.iter().enumerate() {
        let pose = pose(clip("walk"), i as f64 / 20.0 * clip("walk").length_secs);
        let frames = frames(&FIGURE, &pose);
        let thigh = frames[Bone::LeftLowerLeg].position - frames[Bone::LeftUpperLeg].position;
        let angles = [
            thigh.z.atan2(-thigh.y).to_degrees(),
            pose.angles(Bone::LeftLowerLeg).flexion,
            pose.angles(Bone::LeftFoot).flexion,
        ];
        for j in 0..3 {
            squares[j] += (angles[j] - measured[j]).powi(2) / MEASURED.len() as f64;
        }
    }
    let rms = squares.map(f64::sqrt);
    println!("thigh, knee, ankle: {rms:.1?} degrees");
    assert!(rms.iter().all(|rms| *rms < 8.0), "{rms:?}");
}

#[test]
fn the_walk_carries_its_toes_and_its_weight_as_people_do() {
    let walk = run(clip("walk"), 400, 1);
    let soles = Soles::of(&FIGURE).unwrap();
    let toes = |i: usize| soles.feet[0].points(&walk[i].1)[3..].iter().map(|p| p.y).fold(1.0, f64::min);
    let lowest = (270..390).min_by(|a, b| toes(*a).total_cmp(&toes(*b))).unwrap();
    println!("toes clear the ground by {:.1} mm at {} %", toes(lowest) * 1e3, lowest as f64 / 4.0);
    assert!((0.0129..0.020).contains(&toes(lowest)) && (312..344).contains(&lowest), "{lowest}");
    let mass: Vec<DVec3> =
        walk.iter().map(|(pose, frames)| center_of_mass(&FIGURE, frames) - pose.place.position).collect();
    let span = |axis: usize| {
        let values = mass.iter().map(|at| at[axis]);
        values.clone().fold(f64::MIN, f64::max) - values.fold(f64::MAX, f64::min)
    };
    println!("the mass goes {:.1} mm up and down, {:.1} mm aside", span(1) * 1e3, span(0) * 1e3);
    assert!((0.02..0.05).contains(&span(1)) && (0.02..0.045).contains(&span(0)));
}

#[test]
fn a_jog_leaves_the_ground() {
    let soles = Soles::of(&FIGURE).unwrap();
    let jog = run(clip("jog"), 100, 1);
    let air = jog.iter().filter(|(_, frames)| soles.lowest(frames) > 0.004).count();
    assert!((12..40).contains(&air), "{air} % of the stride");
}

#[test]
fn heads_stay_level_and_look_ahead_while_walking() {
    for (pose, frames) in run(clip("walk"), 60, 1) {
        let up = frames[Bone::Head].rotation * DVec3::Y;
        let ahead =
            DQuat::from_rotation_y(-pose.place.turn.to_radians()) * (frames[Bone::Head].rotation * DVec3::Z);
        assert!(up.y > 4.0_f64.to_radians().cos() && ahead.z > 4.0_f64.to_radians().cos());
    }
}

#[test]
fn rising_leans_first_and_ends_at_ease() {
    let clip = clip("sit-to-stand");
    let [seated, still, lean, end] = [0.0, 0.01, 0.36, 1.0].map(|phase| pose(clip, phase * clip.length_secs));
    assert!(seated.hips.distance(still.hips) < 1e-4);
    // The hips' joint is 10 cm over a seat of 45 cm.
    assert!((seated.hips.y - 0.55).abs() < 0.01, "{}", seated.hips);
    let trunk = |pose: &Pose| {
        let up = frames(&FIGURE, pose)[Bone::UpperChest].rotation * DVec3::Y;
        up.z.atan2(up.y).to_degrees()
    };
    assert!(lean.hips.y - seated.hips.y < 0.02 && trunk(&lean) - trunk(&seated) > 30.0);
    let idle = pose(self::clip("idle"), 0.0);
    assert!(end.hips.distance(idle.hips) < 2e-3, "{} {}", end.hips, idle.hips);
    for bone in Bone::ALL {
        for dof in Dof::ALL {
            let off = end.angles(bone).get(dof) - idle.angles(bone).get(dof);
            assert!(off.abs() < 1.0, "{bone:?} {dof:?}: {off}");
        }
    }
}

#[test]
fn every_stride_begins_as_the_left_foot_comes_down() {
    let soles = Soles::of(&FIGURE).unwrap();
    for clip in strides() {
        let low = |phase: f64| {
            let pose = pose(clip, phase * clip.length_secs);
            soles.feet[0].lowest(&frames(&FIGURE, &pose))
        };
        assert!(low(0.0) < 0.003 && low(0.9) > 0.004, "{}: {} {}", clip.name, low(0.0), low(0.9));
        assert!(degrees(clip, 0.0, Bone::LeftLowerLeg, Dof::Flexion) < 60.0);
    }
}
