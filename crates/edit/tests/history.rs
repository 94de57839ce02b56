//! History and gestures under way: one step a gesture, cancel and undo bit for bit.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::sync::Arc;

use edit::{By, Command, Editor, Goal, NoFiles, Outcome, Rejected, Request};
use glam::DVec3;
use rig::{Bone, Dof, Limb};

fn editor() -> Editor {
    Editor::new(Arc::new(interchange::figure::bare_mannequin().expect("the shipped figure loads")))
}

fn ask(editor: &mut Editor, request: Request) -> Result<Outcome, Rejected> {
    editor.submit(request, &mut NoFiles)
}

fn turn(degrees: f64) -> Command {
    Command::Turn { joint: Bone::LeftLowerArm, dof: Dof::Flexion, degrees, by: By::To }
}

fn drag(by: f64) -> Command {
    Command::Reach { limb: Limb::LeftArm, to: Goal::Offset(DVec3::new(-by, -by, by)) }
}

#[test]
fn a_gesture_is_one_step_and_starts_each_time_from_its_first_state() {
    let mut once = editor();
    ask(&mut once, Request::Do(turn(40.0))).unwrap();
    ask(&mut once, Request::Do(drag(0.1))).unwrap();
    let mut dragged = editor();
    ask(&mut dragged, Request::Do(turn(40.0))).unwrap();
    for step in 1..=100 {
        ask(&mut dragged, Request::Preview(drag(f64::from(step) * 1e-3))).unwrap();
    }
    assert!(dragged.in_gesture());
    ask(&mut dragged, Request::Commit).unwrap();
    assert_eq!(dragged.pose(), once.pose(), "many events or one: the same bits");
    assert_eq!(dragged.undo_depth(), 2);
}

#[test]
fn cancel_and_undo_restore_bit_for_bit() {
    let mut editor = editor();
    ask(&mut editor, Request::Do(turn(33.3))).unwrap();
    let before = editor.pose().clone();
    ask(&mut editor, Request::Preview(drag(0.2))).unwrap();
    assert_ne!(*editor.pose(), before);
    ask(&mut editor, Request::Cancel).unwrap();
    assert_eq!(*editor.pose(), before);
    assert_eq!(editor.undo_depth(), 1, "a cancelled gesture leaves no step");
    ask(&mut editor, Request::Preview(drag(0.2))).unwrap();
    ask(&mut editor, Request::Undo).unwrap();
    assert_eq!(*editor.pose(), before, "undo during a gesture cancels it");
    assert_eq!(editor.undo_depth(), 1);
}

#[test]
fn a_gesture_that_changes_nothing_leaves_no_step() {
    let mut editor = editor();
    ask(&mut editor, Request::Preview(drag(0.1))).unwrap();
    ask(&mut editor, Request::Preview(drag(0.0))).unwrap();
    ask(&mut editor, Request::Commit).unwrap();
    assert_eq!(editor.undo_depth(), 0);
}

#[test]
fn a_command_during_a_gesture_commits_it_first() {
    let mut editor = editor();
    ask(&mut editor, Request::Preview(turn(20.0))).unwrap();
    ask(&mut editor, Request::Do(turn(50.0))).unwrap();
    assert_eq!(editor.undo_depth(), 2);
    ask(&mut editor, Request::Undo).unwrap();
    assert_eq!(editor.pose().angles(Bone::LeftLowerArm).flexion, 20.0);
}

#[test]
fn redo_is_lost_by_a_new_step_only() {
    let mut editor = editor();
    for degrees in [10.0, 20.0, 30.0] {
        ask(&mut editor, Request::Do(turn(degrees))).unwrap();
    }
    ask(&mut editor, Request::Undo).unwrap();
    ask(&mut editor, Request::Undo).unwrap();
    ask(&mut editor, Request::Preview(turn(90.0))).unwrap();
    ask(&mut editor, Request::Cancel).unwrap();
    ask(&mut editor, Request::Redo).unwrap();
    assert_eq!(editor.pose().angles(Bone::LeftLowerArm).flexion, 20.0);
    ask(&mut editor, Request::Do(turn(5.0))).unwrap();
    assert_eq!(editor.redo_name(), None);
    assert_eq!(ask(&mut editor, Request::Redo).unwrap().message, "Nothing to redo");
}

#[test]
fn a_rejected_request_leaves_gesture_history_and_pose() {
    let mut editor = editor();
    ask(&mut editor, Request::Preview(turn(20.0))).unwrap();
    let (pose, revision) = (editor.pose().clone(), editor.revision());
    let wrong = Command::Turn { joint: Bone::LeftLowerArm, dof: Dof::Abduction, degrees: 1.0, by: By::Delta };
    let Rejected(message) = ask(&mut editor, Request::Preview(wrong.clone())).unwrap_err();
    assert!(message.contains("no abduction") && message.contains("flexion, twist"), "{message}");
    ask(&mut editor, Request::Do(wrong)).unwrap_err();
    assert!(editor.in_gesture());
    assert_eq!((editor.pose(), editor.revision(), editor.undo_depth()), (&pose, revision, 0));
}

#[test]
fn ranges_are_undone_like_anything_else() {
    let mut editor = editor();
    ask(&mut editor, Request::Do(Command::Ranges { on: false })).unwrap();
    ask(&mut editor, Request::Do(turn(-30.0))).unwrap();
    assert_eq!(editor.pose().angles(Bone::LeftLowerArm).flexion, -30.0);
    ask(&mut editor, Request::Undo).unwrap();
    ask(&mut editor, Request::Undo).unwrap();
    assert!(editor.document().ranges);
    let outcome = ask(&mut editor, Request::Do(turn(-30.0))).unwrap();
    assert!(outcome.clamped);
    assert_eq!(editor.pose().angles(Bone::LeftLowerArm).flexion, 0.0);
    // It tells where the joint is, not where it was to go.
    assert_eq!(outcome.message, "Turned left lower arm flexion to 0.0°");
}
