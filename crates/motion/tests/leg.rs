//! A leg holds its foot where it should be, keeps its ranges, and comes back from what was read off it.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::sync::OnceLock;

use glam::{DQuat, DVec3};
use motion::{FootGoal, Legs};
use proptest::prelude::*;
use rig::{Angles, Bone, Dof, Figure, Frame, Limb, frames};

fn figure() -> &'static (Figure, Legs) {
    static FIGURE: OnceLock<(Figure, Legs)> = OnceLock::new();
    FIGURE.get_or_init(|| {
        let figure = interchange::figure::bare_mannequin().unwrap();
        let legs = Legs::of(&figure).unwrap();
        (figure, legs)
    })
}

fn leg_angles(side: usize, hip: [f64; 3], knee: f64, foot: [f64; 3]) -> [Angles; Bone::COUNT] {
    let parts = [Limb::LeftLeg, Limb::RightLeg][side].parts();
    let mut angles = [Angles::REST; Bone::COUNT];
    let of = |[flexion, abduction, twist]: [f64; 3]| Angles { flexion, abduction, twist };
    angles[parts.root.index()] = of(hip);
    angles[parts.hinge.index()].flexion = knee;
    angles[parts.end.index()] = of(foot);
    angles
}

fn hips() -> Frame {
    Frame::new(DQuat::from_rotation_y(0.2) * DQuat::from_rotation_x(-0.1), DVec3::new(0.1, 0.9, -0.2))
}

prop_compose! {
    fn any_leg()(
        side in 0..2usize,
        hip in [-10.0..80.0, -15.0..30.0, -20.0..20.0],
        knee in 0.0..120.0,
        foot in [-40.0..20.0, -15.0..15.0, -20.0..15.0],
    ) -> (usize, [Angles; Bone::COUNT]) {
        (side, leg_angles(side, hip, knee, foot))
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(500))]

    #[test]
    fn solving_what_was_read_keeps_every_angle((side, angles) in any_leg(), softness in 0.0..0.05) {
        let leg = &figure().1.sides[side];
        let held = leg.ankle_and_foot(hips(), &angles);
        let goal = FootGoal { ankle: held.position, rotation: held.rotation };
        let mut solved = angles;
        let miss = leg.solve(hips(), &goal, &leg.bend(&angles), softness, &mut solved);
        prop_assert!(miss.ankle_m < 1e-9 && miss.foot_degrees < 1e-6, "{miss:?}");
        for bone in Bone::ALL {
            for dof in Dof::ALL {
                let (a, b) = (angles[bone.index()].get(dof), solved[bone.index()].get(dof));
                prop_assert!((a - b).abs() < 2e-5, "{bone} {dof:?}: {a} {b}");
            }
        }
    }

    #[test]
    fn the_foot_is_held_where_it_should_be_and_ranges_are_kept(
        (side, angles) in any_leg(),
        shift in [-0.1..0.1, -0.1..0.1, -0.1..0.1],
        turn in [-0.3..0.3, -0.3..0.3, -0.3..0.3],
    ) {
        let (figure, legs) = figure();
        let leg = &legs.sides[side];
        let held = leg.ankle_and_foot(hips(), &angles);
        let goal = FootGoal {
            ankle: held.position + DVec3::from_array(shift),
            rotation: DQuat::from_scaled_axis(DVec3::from_array(turn)) * held.rotation,
        };
        let mut solved = angles;
        let miss = leg.solve(hips(), &goal, &leg.bend(&angles), 0.0, &mut solved);
        let now = leg.ankle_and_foot(hips(), &solved);
        prop_assert!((now.position.distance(goal.ankle) - miss.ankle_m).abs() < 1e-9);
        let hip = leg.hip(hips());
        let reachable = hip.distance(goal.ankle) < leg.full_reach() - 1e-6;
        prop_assert!(!reachable || miss.leg_stopped || miss.ankle_m < 1e-8, "{miss:?}");
        let turned = now.rotation.angle_between(goal.rotation).to_degrees();
        prop_assert!((turned - miss.foot_degrees).abs() < 1e-5, "{turned} {miss:?}");
        let parts = leg.limb().parts();
        for bone in [parts.hinge, parts.end] {
            let joint = figure.skeleton.joint(bone).unwrap();
            for dof in joint.dofs() {
                let (range, was) = (joint.range(dof).unwrap(), angles[bone.index()].get(dof));
                let angle = solved[bone.index()].get(dof);
                prop_assert!(range.reaching(was).excess(angle) < 1e-9, "{bone} {dof:?} {angle}");
            }
        }
    }

    #[test]
    fn no_number_makes_a_nan(
        side in 0..2usize,
        bad in prop_oneof![Just(f64::NAN), Just(f64::INFINITY), Just(1e200), Just(0.0), Just(-1e-300)],
        which in 0..9usize,
    ) {
        let leg = &figure().1.sides[side];
        let mut angles = leg_angles(side, [20.0, 0.0, 0.0], 30.0, [0.0; 3]);
        let mut goal = FootGoal { ankle: DVec3::new(0.1, 0.1, 0.0), rotation: DQuat::IDENTITY };
        let mut frame = hips();
        let parts = leg.limb().parts();
        match which {
            0 => goal.ankle.y = bad,
            1 => goal.rotation.w = bad,
            2 => angles[parts.root.index()].flexion = bad,
            3 => angles[parts.hinge.index()].flexion = bad,
            4 => angles[parts.end.index()].twist = bad,
            5 => frame.position.x = bad,
            6 => goal.ankle = leg.hip(frame) + DVec3::splat(if bad.is_finite() { bad } else { 0.0 }),
            7 => goal.rotation = DQuat::from_xyzw(bad, bad, bad, bad),
            _ => frame.rotation.z = bad,
        }
        let before = angles;
        let bend = leg.bend(&angles);
        leg.solve(frame, &goal, &bend, 0.01, &mut angles);
        for bone in Bone::ALL {
            for dof in Dof::ALL {
                let (was, is) = (before[bone.index()].get(dof), angles[bone.index()].get(dof));
                prop_assert!(is.is_finite() || is.to_bits() == was.to_bits(), "{bone} {dof:?} {is}");
            }
        }
    }
}

#[test]
fn the_way_forward_is_that_of_the_rig() {
    let (figure, legs) = figure();
    for side in 0..2 {
        let mut pose = figure.rest_pose();
        pose.angles = leg_angles(side, [25.0, 12.0, -9.0], 40.0, [-12.0, 5.0, 8.0]);
        pose.angles[Bone::Hips.index()].twist = 30.0;
        let all = frames(figure, &pose);
        let leg = &legs.sides[side];
        let parts = leg.limb().parts();
        let held = leg.ankle_and_foot(all[Bone::Hips], &pose.angles);
        assert!(held.position.distance(all[parts.end].position) < 1e-12);
        assert!(held.rotation.angle_between(all[parts.end].rotation) < 1e-7);
        assert!(leg.knee(all[Bone::Hips], &pose.angles).distance(all[parts.hinge].position) < 1e-12);
        assert!(leg.hip(all[Bone::Hips]).distance(all[parts.root].position) < 1e-12);
    }
}

#[test]
fn a_leg_that_stretches_slows_down_and_never_snaps() {
    let leg = &figure().1.sides[0];
    let angles = leg_angles(0, [20.0, 0.0, 0.0], 40.0, [0.0; 3]);
    let bend = leg.bend(&angles);
    let hip = leg.hip(hips());
    let (mut knee, mut fastest, mut last) = (40.0, 0.0f64, f64::INFINITY);
    for step in 0..400 {
        let away = 0.75 + 0.0005 * f64::from(step);
        let goal = FootGoal { ankle: hip - DVec3::Y * away, rotation: DQuat::IDENTITY };
        let mut solved = angles;
        let miss = leg.solve(hips(), &goal, &bend, 0.02, &mut solved);
        let now = solved[Bone::LeftLowerLeg.index()].flexion;
        if step > 0 {
            fastest = fastest.max(knee - now);
        }
        assert!(now > 0.0 && miss.ankle_m.is_finite());
        (knee, last) = (now, last.min(now));
    }
    // Without softness the last half millimetre alone takes four degrees.
    assert!(fastest < 0.5 && last < 4.0, "{fastest} degrees in half a millimetre, {last} left");
}
