//! Locked joints keep their angles bit for bit, whatever the gesture.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::sync::{Arc, OnceLock};

use edit::{At, By, Command, Editor, Files, Goal, Hold, Outcome, Rejected, Request};
use glam::DVec3;
use proptest::prelude::*;
use rig::{Bone, Dof, Figure, Limb, Mechanics, Part, Side, Space};

/// A library of one pose.
struct Memory(String);

impl Files for Memory {
    fn read(&mut self, _: &str) -> Result<String, String> {
        Ok(self.0.clone())
    }
}

fn figure() -> Arc<Figure> {
    static FIGURE: OnceLock<Arc<Figure>> = OnceLock::new();
    let load = || Arc::new(interchange::figure::bare_mannequin().unwrap());
    FIGURE.get_or_init(load).clone()
}

fn ask(editor: &mut Editor, request: Request) -> Result<Outcome, Rejected> {
    static TEXT: OnceLock<String> = OnceLock::new();
    let text = TEXT.get_or_init(|| edit::copy_parts(editor.figure(), bent().pose(), &[]));
    editor.submit(request, &mut Memory(text.clone()))
}

fn turn(joint: Bone, dof: Dof, degrees: f64) -> Command {
    Command::Turn { joint, dof, degrees, by: By::To }
}

/// A pose in which no joint that the tests lock is at 0.
fn bent() -> Editor {
    let mut editor = Editor::new(figure());
    let turns = [
        (Bone::LeftUpperArm, Dof::Abduction, -50.3),
        (Bone::LeftUpperArm, Dof::Flexion, 21.7),
        (Bone::LeftLowerArm, Dof::Flexion, 61.9),
        (Bone::LeftLowerArm, Dof::Twist, -31.1),
        (Bone::LeftHand, Dof::Flexion, 11.3),
        (Bone::LeftShoulder, Dof::Abduction, 7.7),
        (Bone::Chest, Dof::Flexion, 9.1),
        (Bone::Spine, Dof::Abduction, 4.3),
        (Bone::Neck, Dof::Twist, 12.9),
        (Bone::LeftIndexProximal, Dof::Flexion, 33.3),
        (Bone::LeftUpperLeg, Dof::Flexion, 30.7),
        (Bone::LeftLowerLeg, Dof::Flexion, 40.1),
        (Bone::Hips, Dof::Twist, 5.7),
    ];
    for (joint, dof, degrees) in turns {
        editor.submit(Request::Do(turn(joint, dof, degrees)), &mut edit::NoFiles).unwrap();
    }
    editor
}

fn locked(bones: &[Bone]) -> Editor {
    let mut editor = bent();
    for bone in bones {
        ask(&mut editor, Request::Lock((*bone).into(), true)).unwrap();
    }
    editor
}

fn hand(editor: &Editor) -> DVec3 {
    editor.evaluation().limbs[Limb::LeftArm.index()].articulator
}

fn reach(point: DVec3) -> Command {
    Command::Reach { limb: Limb::LeftArm, to: Goal::World(point) }
}

#[test]
fn a_locked_joint_is_not_turned_and_the_refusal_names_it() {
    for ranges in [true, false] {
        let mut editor = locked(&[Bone::LeftLowerArm]);
        ask(&mut editor, Request::Do(Command::Ranges { on: ranges })).unwrap();
        let before = editor.document().clone();
        let Rejected(why) =
            ask(&mut editor, Request::Do(turn(Bone::LeftLowerArm, Dof::Flexion, 10.0))).unwrap_err();
        assert!(why.contains("leftLowerArm") && why.contains("locked"), "{why}");
        assert_eq!(*editor.document(), before);
        ask(&mut editor, Request::Lock(Bone::LeftLowerArm.into(), false)).unwrap();
        ask(&mut editor, Request::Do(turn(Bone::LeftLowerArm, Dof::Flexion, 10.0))).unwrap();
        assert_eq!(editor.pose().angles(Bone::LeftLowerArm).flexion, 10.0);
    }
}

#[test]
fn with_a_locked_elbow_the_root_alone_points_the_arm() {
    let mut editor = locked(&[Bone::LeftLowerArm]);
    let elbow = editor.pose().angles(Bone::LeftLowerArm);
    let shoulder = editor.evaluation().frames[Bone::LeftUpperArm].position;
    let length = hand(&editor).distance(shoulder);
    let on_sphere = shoulder + DVec3::new(0.5, 0.2, 0.6).normalize() * length;
    ask(&mut editor, Request::Do(reach(on_sphere))).unwrap();
    assert!(hand(&editor).distance(on_sphere) < 1e-9);
    let beyond = shoulder + DVec3::new(0.4, -0.1, 0.6).normalize() * (length + 0.1);
    ask(&mut editor, Request::Do(reach(beyond))).unwrap();
    assert!((hand(&editor).distance(beyond) - 0.1).abs() < 1e-6, "as near as the arm so bent can be");
    assert_eq!(editor.pose().angles(Bone::LeftLowerArm), elbow);
}

#[test]
fn with_a_locked_root_the_hinge_alone_comes_nearest() {
    let mut editor = locked(&[Bone::LeftUpperArm]);
    let root = editor.pose().angles(Bone::LeftUpperArm);
    let goal = hand(&editor) + DVec3::new(-0.1, 0.15, 0.2);
    let elbow = editor.pose().angles(Bone::LeftLowerArm).flexion;
    ask(&mut editor, Request::Do(reach(goal))).unwrap();
    let (found, missed) = (editor.pose().angles(Bone::LeftLowerArm).flexion, hand(&editor).distance(goal));
    assert_eq!(editor.pose().angles(Bone::LeftUpperArm), root);
    assert!((found - elbow).abs() > 1.0);
    // No other angle of the elbow comes nearer.
    for tenth in (0..1500).step_by(3) {
        let mut other = editor.clone();
        let command = turn(Bone::LeftLowerArm, Dof::Flexion, f64::from(tenth) * 0.1);
        ask(&mut other, Request::Do(command)).unwrap();
        assert!(hand(&other).distance(goal) >= missed - 1e-9, "{} for {found}", f64::from(tenth) * 0.1);
    }
    let view = &editor.evaluation().limbs[Limb::LeftArm.index()];
    assert_eq!(view.elevation_range, view.elevation.map(|now| [now, now]));
    for command in [
        Command::Elevate { limb: Limb::LeftArm, degrees: 10.0, by: By::Delta },
        Command::Flip { limb: Limb::LeftArm },
    ] {
        ask(&mut editor, Request::Do(command)).unwrap_err();
    }
}

#[test]
fn a_limb_with_nothing_left_to_move_says_so() {
    let mut editor = locked(&[Bone::LeftUpperArm, Bone::LeftLowerArm]);
    let before = editor.pose().clone();
    let Rejected(why) = ask(&mut editor, Request::Do(reach(DVec3::new(0.4, 1.2, 0.4)))).unwrap_err();
    assert!(why.contains("locked"), "{why}");
    assert_eq!(*editor.pose(), before);
}

#[test]
fn locks_hold_under_every_gesture() {
    let sets: [&[Bone]; 7] = [
        &[Bone::LeftUpperArm],
        &[Bone::LeftLowerArm],
        &[Bone::LeftHand, Bone::LeftIndexProximal],
        &[Bone::LeftShoulder, Bone::Chest],
        &[Bone::Spine, Bone::Neck, Bone::LeftUpperLeg],
        &[Bone::LeftLowerLeg, Bone::LeftUpperArm, Bone::LeftHand],
        &[Bone::Hips, Bone::UpperChest, Bone::Head],
    ];
    for bones in sets {
        for ranges in [true, false] {
            let mut editor = locked(bones);
            ask(&mut editor, Request::Do(Command::Ranges { on: ranges })).unwrap();
            let mechanics = Mechanics { collar_rhythm: true, torso_follow: 1.0 };
            ask(&mut editor, Request::Mechanics(mechanics)).unwrap();
            let kept: Vec<_> = bones.iter().map(|bone| editor.pose().angles(*bone)).collect();
            let hips = editor.pose().hips;
            let mut done = 0;
            for command in gestures() {
                done += usize::from(ask(&mut editor, Request::Do(command.clone())).is_ok());
                let now: Vec<_> = bones.iter().map(|bone| editor.pose().angles(*bone)).collect();
                assert_eq!(now, kept, "{bones:?} under {}", command.text());
                assert!(!bones.contains(&Bone::Hips) || editor.pose().hips == hips);
            }
            assert!(done > gestures().len() / 2, "{bones:?}: {done} of {}", gestures().len());
            let text = edit::copy_parts(editor.figure(), &editor.figure().rest_pose(), &[]);
            ask(&mut editor, Request::Paste { text, mirrored: true }).unwrap();
            let now: Vec<_> = bones.iter().map(|bone| editor.pose().angles(*bone)).collect();
            assert_eq!(now, kept, "{bones:?} under paste");
        }
    }
}

fn gestures() -> Vec<Command> {
    let limb = Limb::LeftArm;
    let pose = |amount| Command::ApplyPose { path: "a".into(), parts: Vec::new(), amount, mirrored: true };
    vec![
        Command::Keep { limb: Limb::LeftLeg, contact: Hold::Planted, space: Space::World },
        reach(DVec3::new(0.5, 1.3, 0.9)),
        Command::Keep { limb, contact: Hold::Planted, space: Space::World },
        Command::AimSpine { at: DVec3::new(0.2, 2.0, 0.3), twist: 10.0 },
        Command::LookAt { at: DVec3::new(1.0, 1.4, 1.0) },
        Command::MoveHips { by: DVec3::new(0.03, -0.05, 0.02) },
        turn(Bone::Hips, Dof::Flexion, 8.0),
        turn(Bone::LeftShoulder, Dof::Flexion, 5.0),
        Command::Elevate { limb, degrees: 15.0, by: By::Delta },
        Command::TurnInContact { limb, dof: Dof::Flexion, degrees: 10.0, by: By::Delta },
        Command::TurnInContact { limb, dof: Dof::Twist, degrees: 10.0, by: By::Delta },
        Command::Articulate { limb, at: At::Named("indexTip".into()) },
        Command::Keep { limb, contact: Hold::Point, space: Space::Body(Bone::Head) },
        Command::Handshape { side: Side::Left, name: "fist".into(), amount: 1.0 },
        Command::Place { by: DVec3::new(0.2, 0.0, 0.1), turn: 20.0 },
        Command::Balance { amount: 1.0 },
        pose(1.0),
        pose(0.4),
        Command::Mirror { parts: vec![Part::LeftArm] },
        Command::Mirror { parts: Vec::new() },
        turn(Bone::LeftUpperArm, Dof::Flexion, 30.0),
        Command::Flip { limb },
        Command::Reset { parts: vec![Part::Torso] },
        Command::Reset { parts: Vec::new() },
    ]
}

#[test]
fn locking_is_undone_and_unknown_bones_are_refused() {
    let mut editor = bent();
    let before = editor.document().clone();
    ask(&mut editor, Request::Lock(Bone::Chest.into(), true)).unwrap();
    assert!(editor.document().locks.contains(Bone::Chest));
    assert_eq!(editor.undo_name(), Some("Lock"));
    ask(&mut editor, Request::Undo).unwrap();
    assert_eq!(*editor.document(), before);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]

    /// A hand that is dragged slowly with a locked root bends the elbow slowly.
    #[test]
    fn a_locked_root_makes_no_jumps(x in -0.2f64..0.4, y in -0.3f64..0.3, z in 0.0f64..0.5) {
        let mut editor = locked(&[Bone::LeftUpperArm]);
        let first = hand(&editor);
        let by = DVec3::new(x, y, z);
        let mut former = editor.pose().angles(Bone::LeftLowerArm).flexion;
        for step in 1..=100 {
            ask(&mut editor, Request::Preview(reach(first + by * f64::from(step) / 100.0))).unwrap();
            let now = editor.pose().angles(Bone::LeftLowerArm).flexion;
            prop_assert!((now - former).abs() < 12.0, "{former} to {now}");
            former = now;
        }
    }
}

#[test]
fn several_joints_are_locked_in_one_step_with_their_twins() {
    let mut editor = bent();
    ask(&mut editor, Request::Symmetry(true)).unwrap();
    let depth = editor.undo_depth();
    let both = [Bone::LeftLowerArm, Bone::RightLowerArm, Bone::LeftHand, Bone::Head];
    let told = ask(&mut editor, Request::Lock(both.into_iter().collect(), true)).unwrap().message;
    assert_eq!((told.as_str(), editor.undo_depth()), ("Locked 4 joints and their twins", depth + 1));
    assert!(editor.document().locks.contains(Bone::RightHand));
    ask(&mut editor, Request::Undo).unwrap();
    assert!(editor.document().locks.is_empty());
}
