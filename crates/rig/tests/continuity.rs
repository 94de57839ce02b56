//! The mannequin's arms follow a target in millimetre steps and turn no joint fast.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use glam::{DQuat, DVec3};
use rig::{Dof, Figure, Limb, Pose, Space, Target, articulator_in, frames, reach};

fn turn_between(a: DQuat, b: DQuat) -> f64 {
    let d = a.conjugate() * b;
    (2.0 * DVec3::new(d.x, d.y, d.z).length().atan2(d.w.abs())).to_degrees()
}

/// Root and hinge as local rotations.
fn joints(figure: &Figure, pose: &Pose, limb: Limb) -> [DQuat; 2] {
    let parts = limb.parts();
    [parts.root, parts.hinge]
        .map(|bone| figure.skeleton.joint(bone).expect("a joint").rotation(pose.angles(bone)))
}

/// A natural bent arm with the palm at a place before the body.
fn ready(figure: &Figure, limb: Limb) -> Pose {
    let mut pose = figure.rest_pose();
    let parts = limb.parts();
    for (bone, dof, degrees) in [
        (parts.root, Dof::Abduction, -55.0),
        (parts.root, Dof::Flexion, 45.0),
        (parts.hinge, Dof::Flexion, 75.0),
        (parts.hinge, Dof::Twist, -70.0),
    ] {
        pose = rig::turn(figure, &pose, bone, dof, degrees, true).expect("a turn").pose;
    }
    pose
}

fn walk(figure: &Figure, limb: Limb, from: DVec3, to: DVec3) -> (f64, usize) {
    let mut pose = ready(figure, limb);
    let steps = (from.distance(to) / 1e-3).ceil() as usize;
    let (mut worst, mut counted) = (0.0f64, 0);
    let mut before = None;
    for step in 0..=steps {
        let point = from.lerp(to, step as f64 / steps as f64);
        let moved = reach(figure, &pose, limb, Target { space: Space::World, point }, true).expect("a reach");
        let missed = articulator_in(figure, &moved.pose, limb, Space::World).distance(point);
        assert!(missed < 1e-9, "{} missed {point} by {missed}", limb.name());
        let now = joints(figure, &moved.pose, limb);
        // The first reach goes from the ready pose to the path and may be long.
        if let Some(before) = before.replace(now) {
            worst = worst.max(turn_between(before[0], now[0])).max(turn_between(before[1], now[1]));
            counted += 1;
        }
        pose = moved.pose;
    }
    (worst, counted)
}

#[test]
fn no_joint_turns_fast_through_down_ahead_across_and_overhead() {
    let figure = interchange::figure::bare_mannequin().expect("the shipped figure loads");
    for limb in [Limb::LeftArm, Limb::RightArm] {
        let rest = frames(&figure, &figure.rest_pose());
        let shoulder = rest[limb.parts().root].position;
        let out = if limb == Limb::LeftArm { 1.0 } else { -1.0 };
        let at = |x: f64, y: f64, z: f64| shoulder + DVec3::new(out * x, y, z);
        let paths = [
            ("through straight down, side to side", at(0.25, -0.45, 0.0), at(-0.12, -0.45, 0.0)),
            ("through straight down, front to back", at(0.0, -0.45, 0.25), at(0.0, -0.45, -0.12)),
            ("through straight ahead", at(0.2, 0.1, 0.4), at(-0.2, -0.1, 0.4)),
            ("across the chest", at(0.15, -0.1, 0.38), at(-0.3, -0.12, 0.3)),
            ("overhead", at(0.15, 0.42, 0.2), at(-0.1, 0.44, 0.05)),
        ];
        for (name, from, to) in paths {
            let (worst, counted) = walk(&figure, limb, from, to);
            println!("{} {name}: {worst:.3} degrees a millimetre over {counted}", limb.name());
            assert!(counted > 100 && worst < 0.5, "{} {name}: {worst}", limb.name());
        }
    }
}
