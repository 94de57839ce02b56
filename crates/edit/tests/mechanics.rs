//! Collar rhythm, torso follow and balance: nothing unless asked for, never worse, and smooth.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

#[path = "../../kin/tests/seeded/mod.rs"]
mod seeded;

use std::sync::{Arc, OnceLock};

use edit::{By, Command, Editor, Goal, Hold, NoFiles, Outcome, Request};
use glam::DVec3;
use rig::{Bone, Contact, Dof, Figure, Limb, Mechanics, Pose, Space};
use seeded::Seeded;

const RHYTHM: Mechanics = Mechanics { collar_rhythm: true, torso_follow: 0.0 };
const BOTH: Mechanics = Mechanics { collar_rhythm: true, torso_follow: 1.0 };

fn figure() -> Arc<Figure> {
    static FIGURE: OnceLock<Arc<Figure>> = OnceLock::new();
    let load = || Arc::new(interchange::figure::bare_mannequin().unwrap());
    FIGURE.get_or_init(load).clone()
}

fn ask(editor: &mut Editor, request: Request) -> Outcome {
    editor.submit(request, &mut NoFiles).unwrap()
}

fn turn(joint: Bone, dof: Dof, degrees: f64) -> Command {
    Command::Turn { joint, dof, degrees, by: By::To }
}

fn to(limb: Limb, point: DVec3) -> Command {
    Command::Reach { limb, to: Goal::World(point) }
}

/// Arms down and a little bent, feet planted.
fn standing(mechanics: Mechanics) -> Editor {
    let mut editor = Editor::new(figure());
    for (arm, elbow) in [(Bone::LeftUpperArm, Bone::LeftLowerArm), (Bone::RightUpperArm, Bone::RightLowerArm)]
    {
        ask(&mut editor, Request::Do(turn(arm, Dof::Abduction, -70.0)));
        ask(&mut editor, Request::Do(turn(elbow, Dof::Flexion, 30.0)));
    }
    for limb in [Limb::LeftLeg, Limb::RightLeg] {
        ask(&mut editor, Request::Do(Command::Keep { limb, contact: Hold::Planted, space: Space::World }));
    }
    ask(&mut editor, Request::Mechanics(mechanics));
    editor
}

fn residual(editor: &Editor, limb: Limb, target: DVec3) -> f64 {
    editor.evaluation().limbs[limb.index()].articulator.distance(target)
}

/// The largest change of any angle, degrees.
fn change(a: &Pose, b: &Pose) -> f64 {
    let of =
        |bone: Bone| Dof::ALL.into_iter().map(move |d| (a.angles(bone).get(d) - b.angles(bone).get(d)).abs());
    Bone::ALL.into_iter().flat_map(of).fold(0.0, f64::max)
}

#[test]
fn without_mechanics_a_reach_moves_only_the_joints_of_its_row() {
    let mut editor = standing(Mechanics::default());
    let before = editor.pose().clone();
    ask(&mut editor, Request::Do(to(Limb::LeftArm, DVec3::new(0.6, 1.6, 0.9))));
    for bone in [Bone::Spine, Bone::Chest, Bone::UpperChest, Bone::LeftShoulder] {
        assert_eq!(editor.pose().angles(bone), before.angles(bone));
    }
    // Mechanics that are off give the very same bits as a reach that knows of none.
    let target = rig::Target { space: Space::World, point: DVec3::new(0.6, 1.6, 0.9) };
    let plain = rig::reach(editor.figure(), &before, Limb::LeftArm, target, true).unwrap();
    assert_eq!(plain.pose, *editor.pose());
}

#[test]
fn switching_on_moves_nothing_and_undo_switches_back() {
    let mut editor = standing(Mechanics::default());
    let before = editor.pose().clone();
    ask(&mut editor, Request::Mechanics(BOTH));
    assert_eq!((editor.pose(), editor.document().mechanics), (&before, BOTH));
    for limb in [Limb::LeftArm, Limb::RightArm] {
        let here = editor.evaluation().limbs[limb.index()].articulator;
        ask(&mut editor, Request::Do(to(limb, here)));
        assert!(change(editor.pose(), &before) < 1e-9, "{limb:?}");
    }
    ask(&mut editor, Request::Undo);
    ask(&mut editor, Request::Undo);
    ask(&mut editor, Request::Undo);
    assert_eq!((editor.pose(), editor.document().mechanics), (&before, Mechanics::default()));
}

#[test]
fn the_collar_rises_with_the_arm_and_comes_back_with_it() {
    let mut editor = standing(RHYTHM);
    let collar = |editor: &Editor| editor.pose().angles(Bone::LeftShoulder).abduction;
    let (start, hand) = (collar(&editor), editor.evaluation().limbs[0].articulator);
    let high = editor.evaluation().frames[Bone::LeftUpperArm].position + DVec3::new(0.1, 0.5, 0.1);
    ask(&mut editor, Request::Do(to(Limb::LeftArm, high)));
    assert!(collar(&editor) > start + 20.0, "{}", collar(&editor));
    assert!(residual(&editor, Limb::LeftArm, high) < 1e-9);
    ask(&mut editor, Request::Do(to(Limb::LeftArm, hand)));
    assert!((collar(&editor) - start).abs() < 1e-9, "another gesture brings it back");
    // A turn of the upper arm does the same, and a collar set by hand keeps its distance from the rhythm.
    ask(&mut editor, Request::Do(turn(Bone::LeftShoulder, Dof::Abduction, 6.0)));
    ask(&mut editor, Request::Do(turn(Bone::LeftUpperArm, Dof::Abduction, 40.0)));
    assert!(collar(&editor) > 20.0);
    assert_eq!(editor.pose().angles(Bone::LeftUpperArm).abduction, 40.0);
    ask(&mut editor, Request::Do(turn(Bone::LeftUpperArm, Dof::Abduction, -70.0)));
    assert!((collar(&editor) - 6.0).abs() < 1.0);
}

#[test]
fn the_torso_follows_a_far_reach_by_its_share() {
    let far = DVec3::new(0.25, 1.15, 1.1);
    let mut missed = Vec::new();
    for torso_follow in [0.0, 0.5, 1.0] {
        let mut editor = standing(Mechanics { collar_rhythm: false, torso_follow });
        let (hips, feet) = (editor.pose().hips, editor.evaluation().frames[Bone::LeftFoot]);
        ask(&mut editor, Request::Do(to(Limb::LeftArm, far)));
        missed.push(residual(&editor, Limb::LeftArm, far));
        assert_eq!((editor.pose().hips, editor.evaluation().frames[Bone::LeftFoot]), (hips, feet));
    }
    assert!(missed[0] > 0.05 && missed[0] > missed[1] + 0.03 && missed[1] > missed[2] + 0.01, "{missed:?}");
    // What the torso carries can't be approached by leaning.
    let mut editor = standing(BOTH);
    let spine = editor.pose().angles(Bone::Spine);
    let to = Goal::Body(Bone::Head, DVec3::new(0.0, 0.3, 0.9));
    ask(&mut editor, Request::Do(Command::Reach { limb: Limb::LeftArm, to }));
    assert_eq!(editor.pose().angles(Bone::Spine), spine);
}

#[test]
fn never_farther_off_than_without_and_other_contacts_hold() {
    let mut seeded = Seeded(7);
    let mut worst: f64 = 0.0;
    for round in 0..120 {
        let mut plain = standing(Mechanics::default());
        let limb = if round % 2 == 0 { Limb::LeftArm } else { Limb::RightArm };
        let hold = Command::Keep { limb: limb.mirrored(), contact: Hold::Point, space: Space::World };
        if round % 3 == 0 {
            ask(&mut plain, Request::Do(hold));
        }
        let mut with = plain.clone();
        ask(&mut with, Request::Mechanics(if round % 4 < 2 { BOTH } else { RHYTHM }));
        let chest = plain.evaluation().frames[Bone::UpperChest].position;
        let target = chest + seeded.direction() * seeded.between(0.2, 1.3);
        ask(&mut plain, Request::Do(to(limb, target)));
        ask(&mut with, Request::Do(to(limb, target)));
        let worse = residual(&with, limb, target) - residual(&plain, limb, target);
        assert!(worse < 2.0 * rig::MECHANICS_TOLERANCE_M, "round {round}: {worse}");
        for other in Limb::ALL.into_iter().filter(|other| with.pose().limb(*other).contact != Contact::Free) {
            worst = worst.max(with.evaluation().limbs[other.index()].residual);
        }
    }
    assert!(worst < 2.0 * rig::MECHANICS_TOLERANCE_M, "{worst}");
}

#[test]
fn slow_hands_bring_torso_and_collar_along_slowly() {
    let start = standing(BOTH);
    let hand = start.evaluation().limbs[0].articulator;
    // Up and forward, out to the side, far ahead, across the body, and anywhere before it: there and beyond reach.
    let named = [
        DVec3::new(0.3, 1.9, 0.4),
        DVec3::new(1.2, 1.2, 0.2),
        DVec3::new(0.2, 1.1, 1.2),
        DVec3::new(-0.5, 1.3, 0.8),
    ];
    let mut seeded = Seeded(5);
    let chest = DVec3::new(0.15, 1.3, 0.0);
    let mut any = || {
        let way = seeded.direction();
        chest + DVec3::new(way.x, way.y, way.z.abs()) * seeded.between(0.3, 1.1)
    };
    let goals: Vec<DVec3> = named.into_iter().chain((0..8).map(|_| any())).collect();
    for goal in goals {
        let steps = (goal.distance(hand) * 1000.0).ceil();
        let mut editor = start.clone();
        let mut former = editor.pose().clone();
        for step in 1..=steps as u32 {
            let point = hand.lerp(goal, f64::from(step) / steps);
            ask(&mut editor, Request::Preview(to(Limb::LeftArm, point)));
            let torso = [Bone::Spine, Bone::Chest, Bone::UpperChest, Bone::LeftShoulder];
            for (bone, dof) in torso.into_iter().flat_map(|bone| Dof::ALL.map(|dof| (bone, dof))) {
                let by = (editor.pose().angles(bone).get(dof) - former.angles(bone).get(dof)).abs();
                assert!(by < 1.0, "{bone} {} by {by} at step {step} to {goal}", dof.name());
            }
            former = editor.pose().clone();
        }
        // Where the pointer ends counts, not how it went there.
        let mut once = start.clone();
        ask(&mut once, Request::Do(to(Limb::LeftArm, goal)));
        assert_eq!(once.pose(), editor.pose());
        ask(&mut editor, Request::Cancel);
        assert_eq!(editor.pose(), start.pose());
    }
}

#[test]
fn bad_numbers_of_mechanics_do_no_harm() {
    for torso_follow in [f64::NAN, f64::INFINITY, -3.0, 1e300] {
        let mut editor = standing(Mechanics { collar_rhythm: true, torso_follow });
        for limb in Limb::ALL {
            ask(&mut editor, Request::Do(to(limb, DVec3::new(0.3, 1.4, 0.9))));
        }
        assert!(editor.evaluation().frames.0.iter().all(|frame| frame.position.is_finite()));
    }
}

#[test]
fn balance_keeps_contacts_and_ends_inside_the_soles() {
    let mut editor = standing(Mechanics::default());
    ask(&mut editor, Request::Do(Command::MoveHips { by: DVec3::new(0.0, -0.12, 0.0) }));
    ask(&mut editor, Request::Do(Command::MoveHips { by: DVec3::new(0.02, 0.0, -0.18) }));
    let support = |editor: &Editor| {
        let evaluation = editor.evaluation();
        rig::support(editor.figure(), &evaluation.frames, evaluation.center_of_mass).unwrap()
    };
    let before = support(&editor);
    assert!(!before.is_balanced(), "{before:?}");
    assert_eq!(before.falls(editor.pose()), Some(rig::Falls::Backward));
    ask(&mut editor, Request::Do(Command::Balance { amount: 1.0 }));
    let after = support(&editor);
    assert!(after.is_balanced() && after.margin_m > 0.05, "{after:?}");
    assert_eq!(after.falls(editor.pose()), None);
    for leg in [Limb::LeftLeg, Limb::RightLeg] {
        let view = &editor.evaluation().limbs[leg.index()];
        assert!(view.residual < 1e-9, "{leg:?}: {view:?}");
    }
}

#[test]
fn a_figure_in_the_air_has_no_support() {
    let mut editor = standing(Mechanics::default());
    let of = |editor: &Editor| {
        let evaluation = editor.evaluation();
        rig::support(editor.figure(), &evaluation.frames, evaluation.center_of_mass)
    };
    let standing = of(&editor).unwrap();
    assert!(standing.outline.len() >= 6 && standing.outline.iter().all(|p| p.y == 0.0));
    ask(&mut editor, Request::Do(Command::Place { by: DVec3::Y * 0.5, turn: 0.0 }));
    assert_eq!(of(&editor), None);
}
