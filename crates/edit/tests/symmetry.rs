//! Live symmetry: what is done on one side is done on the other, in the figure's own middle plane.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

#[path = "../../kin/tests/seeded/mod.rs"]
mod seeded;

use std::sync::{Arc, OnceLock};

use edit::{At, By, Command, Editor, Goal, Hold, NoFiles, Outcome, Request, mirrored};
use glam::DVec3;
use rig::{Bone, Contact, Dof, Figure, Limb, Mechanics, Part, Pose, Side, Space, mirrored_pose};
use seeded::Seeded;

fn figure() -> Arc<Figure> {
    static FIGURE: OnceLock<Arc<Figure>> = OnceLock::new();
    let load = || Arc::new(interchange::figure::bare_mannequin().unwrap());
    FIGURE.get_or_init(load).clone()
}

fn ask(editor: &mut Editor, request: Request) -> Outcome {
    editor.submit(request, &mut NoFiles).unwrap()
}

/// The figure standing somewhere, turned, with symmetry on.
fn editor(turn: f64) -> Editor {
    let mut editor = Editor::new(figure());
    if turn != 0.0 {
        ask(&mut editor, Request::Do(Command::Place { by: DVec3::new(0.4, 0.0, -0.7), turn }));
    }
    ask(&mut editor, Request::Symmetry(true));
    editor
}

/// How far a pose is from its mirror image: degrees and metres alike.
fn lopsided(pose: &Pose) -> f64 {
    let image = mirrored_pose(pose);
    let angles = |bone: Bone| {
        let (a, b) = (pose.angles(bone), image.angles(bone));
        Dof::ALL.map(|dof| (a.get(dof) - b.get(dof)).abs()).into_iter().fold(0.0, f64::max)
    };
    let off = Bone::ALL.into_iter().map(angles).fold(pose.hips.distance(image.hips), f64::max);
    let contact = |limb: Limb| match (pose.limb(limb).contact, image.limb(limb).contact) {
        (Contact::Free, Contact::Free) => 0.0,
        (a, b) => match (a.target(), b.target()) {
            (Some((s, p)), Some((t, q))) if s == t => p.distance(q),
            _ => f64::INFINITY,
        },
    };
    Limb::ALL.into_iter().map(contact).fold(off, f64::max)
}

fn random(seeded: &mut Seeded, editor: &Editor) -> Command {
    let limb = Limb::ALL[(seeded.unit() * 4.0) as usize];
    let arm = if limb.side() == Side::Left { Limb::LeftArm } else { Limb::RightArm };
    let joints = [
        Bone::LeftUpperArm,
        Bone::RightLowerArm,
        Bone::LeftHand,
        Bone::RightShoulder,
        Bone::LeftUpperLeg,
        Bone::RightLowerLeg,
        Bone::LeftFoot,
        Bone::RightIndexProximal,
    ];
    let joint = joints[(seeded.unit() * 8.0) as usize];
    let dofs: Vec<Dof> = editor.figure().skeleton.joint(joint).unwrap().dofs().collect();
    let dof = dofs[(seeded.unit() * dofs.len() as f64) as usize];
    let degrees = seeded.between(-30.0, 30.0);
    let side = limb.side();
    match (seeded.unit() * 10.0) as usize {
        0..=2 => Command::Turn { joint, dof, degrees, by: By::Delta },
        3 => Command::Reach { limb, to: Goal::Offset(seeded.direction() * 0.1) },
        4 => {
            let near = editor.evaluation().limbs[limb.index()].articulator;
            Command::Reach { limb, to: Goal::World(near + seeded.direction() * 0.15) }
        }
        5 => Command::Elevate { limb, degrees, by: By::Delta },
        6 => Command::TurnInContact { limb: arm, dof: Dof::Flexion, degrees, by: By::Delta },
        7 => {
            let contact = [Hold::Free, Hold::Point, Hold::Planted][(seeded.unit() * 3.0) as usize];
            let space = if limb.is_arm() { Space::Body(Bone::Head) } else { Space::World };
            Command::Keep { limb, contact, space }
        }
        8 => Command::Handshape { side, name: "point".into(), amount: seeded.unit() },
        _ => {
            let bone = limb.parts().hinge;
            Command::Articulate { limb, at: At::Point(bone, DVec3::new(0.02, 0.01, -0.03)) }
        }
    }
}

#[test]
fn symmetric_edits_of_a_symmetric_pose_stay_symmetric() {
    for (seed, turn) in (1..=12).map(|seed| (seed, [0.0, 35.0, -110.0][seed as usize % 3])) {
        let mut seeded = Seeded(seed);
        let mut editor = editor(turn);
        let mut done = 0;
        for step in 0..120 {
            let command = random(&mut seeded, &editor);
            let before = editor.clone();
            if editor.submit(Request::Do(command.clone()), &mut NoFiles).is_err() {
                assert_eq!(editor.document(), before.document());
                continue;
            }
            done += 1;
            let off = lopsided(editor.pose());
            assert!(off < 1e-9, "{off} after step {step}, {}", command.text());
        }
        assert!(done > 80, "{done}");
    }
}

#[test]
fn both_sides_are_one_step() {
    let mut editor = editor(0.0);
    let (before, depth) = (editor.pose().clone(), editor.undo_depth());
    let turn = Command::Turn { joint: Bone::LeftUpperArm, dof: Dof::Abduction, degrees: -60.0, by: By::To };
    ask(&mut editor, Request::Do(turn));
    assert_eq!(editor.pose().angles(Bone::RightUpperArm).abduction, -60.0);
    assert_eq!(editor.undo_depth(), depth + 1);
    ask(&mut editor, Request::Undo);
    assert_eq!(*editor.pose(), before);
    for by in [0.05, 0.1, 0.15] {
        let to = Goal::Offset(DVec3::new(-by, -by, by));
        ask(&mut editor, Request::Preview(Command::Reach { limb: Limb::RightArm, to }));
    }
    ask(&mut editor, Request::Commit);
    assert!(lopsided(editor.pose()) < 1e-9);
    assert_eq!(editor.undo_depth(), depth + 1);
}

#[test]
fn what_has_no_side_is_done_once() {
    let editor = editor(20.0);
    let none = [
        Command::MoveHips { by: DVec3::X },
        Command::Place { by: DVec3::X, turn: 3.0 },
        Command::AimSpine { at: DVec3::Y, twist: 1.0 },
        Command::LookAt { at: DVec3::Z },
        Command::Turn { joint: Bone::Chest, dof: Dof::Twist, degrees: 3.0, by: By::Delta },
        Command::Turn { joint: Bone::LeftEye, dof: Dof::Twist, degrees: 3.0, by: By::Delta },
        Command::Balance { amount: 1.0 },
        Command::Ranges { on: false },
        Command::Mirror { parts: vec![Part::LeftArm] },
        Command::Reset { parts: Vec::new() },
        Command::Reset { parts: vec![Part::LeftArm, Part::RightArm] },
    ];
    for command in none {
        assert_eq!(mirrored(editor.figure(), editor.pose(), &command), None, "{}", command.text());
    }
    let one_side = Command::Reset { parts: vec![Part::LeftHand, Part::Torso, Part::LeftLeg] };
    let twin = Command::Reset { parts: vec![Part::RightHand, Part::RightLeg] };
    assert_eq!(mirrored(editor.figure(), editor.pose(), &one_side), Some(twin));
}

#[test]
fn a_twin_of_a_twin_is_the_command_itself() {
    let editor = editor(0.0);
    let mut seeded = Seeded(11);
    for _ in 0..200 {
        let command = random(&mut seeded, &editor);
        let there = mirrored(editor.figure(), editor.pose(), &command).unwrap();
        assert_ne!(there, command);
        assert_eq!(mirrored(editor.figure(), editor.pose(), &there), Some(command));
    }
}

#[test]
fn hands_that_hold_each_other_move_as_one_held_pair() {
    let mut editor = editor(0.0);
    let to = Goal::World(DVec3::new(0.05, 1.15, 0.35));
    ask(&mut editor, Request::Symmetry(false));
    ask(&mut editor, Request::Do(Command::Reach { limb: Limb::LeftArm, to }));
    let to = Goal::Body(Bone::LeftHand, DVec3::new(0.05, -0.03, 0.0));
    ask(&mut editor, Request::Do(Command::Reach { limb: Limb::RightArm, to }));
    ask(&mut editor, Request::Symmetry(true));
    let space = Space::Body(Bone::LeftHand);
    let keep = Command::Keep { limb: Limb::RightArm, contact: Hold::Point, space };
    assert_eq!(mirrored(editor.figure(), editor.pose(), &keep), None, "it would go round in a circle");
    ask(&mut editor, Request::Do(keep));
    let goal = DVec3::new(0.0, 1.25, 0.38);
    ask(&mut editor, Request::Do(Command::Reach { limb: Limb::LeftArm, to: Goal::World(goal) }));
    let limbs = editor.evaluation().limbs;
    assert!(limbs[0].articulator.distance(goal) < 1e-9);
    assert!(limbs[1].residual < 1e-9, "the right hand still holds the left");
    assert!(matches!(editor.pose().limb(Limb::RightArm).contact, Contact::Point { .. }));
    // A reach for the other hand is a reach of one arm.
    ask(&mut editor, Request::Do(Command::Keep { limb: Limb::RightArm, contact: Hold::Free, space }));
    let to = Goal::Body(Bone::RightHand, DVec3::new(-0.05, -0.03, 0.0));
    let right = editor.pose().angles(Bone::RightUpperArm);
    ask(&mut editor, Request::Do(Command::Reach { limb: Limb::LeftArm, to }));
    assert_eq!(editor.pose().angles(Bone::RightUpperArm), right);
}

#[test]
fn a_twin_that_cannot_be_done_is_told_and_left_out() {
    let mut editor = editor(0.0);
    ask(&mut editor, Request::Symmetry(false));
    ask(&mut editor, Request::Lock(Bone::RightUpperArm.into(), true));
    ask(&mut editor, Request::Symmetry(true));
    let turn = Command::Turn { joint: Bone::LeftUpperArm, dof: Dof::Flexion, degrees: 25.0, by: By::To };
    let outcome = ask(&mut editor, Request::Do(turn));
    assert!(outcome.message.contains("not mirrored") && outcome.message.contains("locked"), "{outcome:?}");
    assert_eq!(editor.pose().angles(Bone::LeftUpperArm).flexion, 25.0);
    assert_eq!(editor.pose().angles(Bone::RightUpperArm).flexion, 0.0);
    // Locking itself is symmetric, too.
    ask(&mut editor, Request::Lock(Bone::LeftHand.into(), true));
    assert!(editor.document().locks.contains(Bone::RightHand));
}

#[test]
fn mechanics_stay_symmetric() {
    let mut editor = editor(0.0);
    ask(&mut editor, Request::Mechanics(Mechanics { collar_rhythm: true, torso_follow: 1.0 }));
    for goal in [DVec3::new(0.5, 1.9, 0.2), DVec3::new(0.3, 1.2, 0.9), DVec3::new(0.9, 0.8, 0.0)] {
        ask(&mut editor, Request::Do(Command::Reach { limb: Limb::LeftArm, to: Goal::World(goal) }));
        assert!(lopsided(editor.pose()) < 1e-9);
    }
    assert_ne!(editor.pose().angles(Bone::LeftShoulder).abduction, 0.0);
}
