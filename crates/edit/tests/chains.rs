//! Commands on chains: what each moves and keeps, what it turns down, and the way back.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::sync::Arc;

use edit::{
    By, ChainCommand, ChainEditor, ChainGoal, ChainOutcome, ChainRequest, ChainRoot, ChainSolver, Rejected,
    parse_chain_script, run_chain_script,
};
use glam::DVec3;
use kin::Interval;
use rig::{Mimic, NewLink, Robot, RobotLink};

/// A line of links along x, each half a metre, that turn about the y of the root's frame by up to 100 degrees.
fn line(count: usize) -> Robot {
    let root = RobotLink { name: "root".to_owned(), tip: Some(DVec3::X * 0.5), ..RobotLink::default() };
    let mut robot = Robot::new("line", vec![root], Vec::new()).unwrap();
    for i in 1..=count {
        let range = Interval::new(-100f64.to_radians(), 100f64.to_radians());
        let new = NewLink { name: format!("link{i}"), length: 0.5, range, axis: DVec3::Y };
        robot = robot.appended(i - 1, new).unwrap();
    }
    robot
}

fn editor(count: usize) -> ChainEditor {
    let robot = Arc::new(line(count));
    let rest = robot.rest();
    ChainEditor::new(robot, &rest)
}

fn turn(joint: &str, degrees: f64, by: By) -> ChainCommand {
    ChainCommand::Turn { joint: joint.to_owned(), degrees, by, part: None }
}

fn reach(link: &str, to: ChainGoal) -> ChainCommand {
    ChainCommand::Reach {
        link: link.to_owned(),
        to,
        point: None,
        rotation: None,
        solver: ChainSolver::Best,
        root: ChainRoot::Held,
    }
}

fn run(editor: &mut ChainEditor, command: ChainCommand) -> ChainOutcome {
    editor.submit(ChainRequest::Do(command)).unwrap()
}

fn fault(editor: &mut ChainEditor, command: ChainCommand) -> String {
    let before = editor.document().clone();
    let Rejected(message) = editor.submit(ChainRequest::Do(command)).unwrap_err();
    assert_eq!(*editor.document(), before);
    message
}

fn angle(editor: &ChainEditor, joint: &str) -> f64 {
    let document = editor.document();
    let joint = document.robot.find_joint(joint).unwrap();
    document.pose.0[document.robot.slot(joint).start].to_degrees()
}

#[test]
fn a_turn_carries_what_is_beyond_and_stops_at_the_range() {
    let mut editor = editor(4);
    let before = editor.frames().to_vec();
    let outcome = run(&mut editor, turn("link2", 30.0, By::Delta));
    assert!(!outcome.clamped);
    let after = editor.frames();
    assert_eq!(after[..2], before[..2]);
    // Positive about the y of a frame whose z stands up: downward.
    assert!(after[3].position.y < -0.2 && after[4].position.y < after[3].position.y);
    let outcome = run(&mut editor, turn("link2", 200.0, By::Delta));
    assert!(outcome.clamped && (angle(&editor, "link2") - 100.0).abs() < 1e-9);
    assert_eq!(outcome.message, "link2 at 100.0°, the end of its range");
    run(&mut editor, ChainCommand::Ranges { on: false });
    run(&mut editor, turn("link2", 150.0, By::To));
    run(&mut editor, ChainCommand::Ranges { on: true });
    let outcome = run(&mut editor, turn("link2", 10.0, By::Delta));
    assert!(
        outcome.clamped && (angle(&editor, "link2") - 150.0).abs() < 1e-9,
        "outside it may only move inward"
    );
    run(&mut editor, turn("link2", -20.0, By::Delta));
    assert!((angle(&editor, "link2") - 130.0).abs() < 1e-9);
}

#[test]
fn a_reach_meets_its_target_and_here_moves_nothing() {
    let mut editor = editor(5);
    let target = DVec3::new(1.2, 0.9, 0.0);
    let outcome = run(&mut editor, reach("link5", ChainGoal::World(target)));
    let told = outcome.reach.unwrap();
    assert!(told.reached && told.residual_m < 3e-4, "{told:?}");
    assert!(editor.document().end_in_world(5).distance(target) < 3e-4);
    let before = editor.document().clone();
    run(&mut editor, reach("link5", ChainGoal::Here));
    assert_eq!(*editor.document(), before);
    let far = run(&mut editor, reach("link5", ChainGoal::World(DVec3::new(9.0, 0.0, 0.0))));
    assert!(far.clamped && !far.reach.unwrap().reached);
    let end = editor.document().end_in_world(5);
    assert!(end.distance(DVec3::new(3.0, 0.0, 0.0)) < 1e-2, "out of reach it points at the target: {end}");
}

#[test]
fn a_drag_is_one_step_from_its_first_state_and_can_be_taken_back() {
    let mut editor = editor(3);
    let first = editor.document().clone();
    for i in 1..=5 {
        let target = DVec3::new(1.5, 0.2 * f64::from(i), 0.0);
        editor.submit(ChainRequest::Preview(reach("link3", ChainGoal::World(target)))).unwrap();
    }
    let dragged = editor.document().clone();
    editor.submit(ChainRequest::Commit).unwrap();
    assert_eq!(editor.undo_depth(), 1);
    editor.submit(ChainRequest::Undo).unwrap();
    assert_eq!(*editor.document(), first);
    editor.submit(ChainRequest::Redo).unwrap();
    assert_eq!(*editor.document(), dragged);
    editor.submit(ChainRequest::Drive(turn("link1", 5.0, By::Delta))).unwrap();
    editor.submit(ChainRequest::Drive(turn("link1", 5.0, By::Delta))).unwrap();
    let driven = angle(&editor, "link1");
    editor.submit(ChainRequest::Cancel).unwrap();
    assert_eq!(*editor.document(), dragged);
    assert!((driven - angle(&editor, "link1") - 10.0).abs() < 1e-9, "each goes on from the one before");
}

#[test]
fn links_come_and_go_and_the_rest_stays() {
    let mut editor = editor(3);
    run(&mut editor, turn("link2", 40.0, By::To));
    run(&mut editor, turn("link3", -25.0, By::To));
    let before = editor.frames().to_vec();
    let more = ChainCommand::Append {
        to: "link3".to_owned(),
        name: "link4".to_owned(),
        length: 0.25,
        range: (-90.0, 90.0),
        axis: None,
    };
    run(&mut editor, more.clone());
    assert_eq!(editor.frames()[..4], before[..]);
    assert!(fault(&mut editor, more).contains("link4"));
    run(&mut editor, ChainCommand::SetLength { link: "link4".to_owned(), metres: 0.75 });
    assert!((editor.robot().length_of(4) - 0.75).abs() < 1e-12);
    run(&mut editor, ChainCommand::Remove { link: "link4".to_owned() });
    assert_eq!(editor.frames(), before);
    run(&mut editor, ChainCommand::Remove { link: "link1".to_owned() });
    assert!((angle(&editor, "link2") - 40.0).abs() < 1e-9 && (angle(&editor, "link3") + 25.0).abs() < 1e-9);
    assert_eq!(editor.frames()[1].position, before[1].position, "what followed joins on");
    let root = fault(&mut editor, ChainCommand::Remove { link: "root".to_owned() });
    assert!(root.contains("root"), "{root}");
    for _ in 0..editor.undo_depth() {
        editor.submit(ChainRequest::Undo).unwrap();
    }
    let rest = editor.robot().rest();
    assert_eq!((&editor.document().pose, editor.robot().links().len()), (&rest, 4));
}

#[test]
fn a_new_range_takes_its_joint_along() {
    let mut editor = editor(2);
    run(&mut editor, turn("link1", 80.0, By::To));
    run(&mut editor, ChainCommand::SetRange { joint: "link1".to_owned(), to: (-30.0, 45.0) });
    assert!((angle(&editor, "link1") - 45.0).abs() < 1e-9);
    let swapped = fault(&mut editor, ChainCommand::SetRange { joint: "link1".to_owned(), to: (45.0, -30.0) });
    assert_eq!(swapped, "a range from 45 to -30: expected the lower end first");
    run(&mut editor, ChainCommand::Reset { joints: vec!["link1".to_owned()] });
    assert_eq!(angle(&editor, "link1"), 0.0);
}

#[test]
fn joints_that_follow_are_not_moved_by_hand_but_go_along() {
    let robot = line(3);
    let mut joints = robot.joints().to_vec();
    joints[2].mimic = Some(Mimic { master: "link1".to_owned(), multiplier: -1.0, offset: 0.0 });
    let robot = Arc::new(Robot::new("follower", robot.links().to_vec(), joints).unwrap());
    let mut editor = ChainEditor::new(robot.clone(), &robot.rest());
    run(&mut editor, turn("link1", 30.0, By::To));
    assert!((angle(&editor, "link3") + 30.0).abs() < 1e-9);
    assert_eq!(fault(&mut editor, turn("link3", 1.0, By::Delta)), "link3 follows link1: move that");
    let target = editor.document().end_in_world(3) + DVec3::new(-0.2, 0.25, 0.0);
    let told = run(&mut editor, reach("link3", ChainGoal::World(target))).reach.unwrap();
    assert!((angle(&editor, "link3") + angle(&editor, "link1")).abs() < 1e-9);
    let off = editor.document().end_in_world(3).distance(target);
    assert!((off - told.residual_m).abs() < 1e-9 && off < 0.32, "no worse than before: {told:?}");
}

#[test]
fn faults_say_what_and_what_was_expected() {
    let mut editor = editor(2);
    assert_eq!(
        fault(&mut editor, turn("lonk1", 1.0, By::Delta)),
        "there is no joint \"lonk1\", did you mean \"link1\"?"
    );
    assert_eq!(fault(&mut editor, turn("link1", f64::NAN, By::To)), "degrees: expected a finite number");
    let slide = ChainCommand::Slide { joint: "link1".to_owned(), metres: 0.1, by: By::Delta, part: None };
    assert_eq!(fault(&mut editor, slide), "link1 is revolute: it can slide not at all");
    let nowhere = reach("link2", ChainGoal::World(DVec3::new(f64::INFINITY, 0.0, 0.0)));
    assert_eq!(fault(&mut editor, nowhere), "target: expected finite numbers");
}

#[test]
fn a_script_reports_each_command_and_names_the_place_of_a_fault() {
    let text = r#"(version: 1, chain: "line.chain.ron", commands: [
    Turn(joint: "link1", degrees: 20.0, by: To),
    Reach(link: "link3", to: Offset((-0.2, 0.3, 0.0))),
    Turn(joint: "link9", degrees: 20.0, by: To),
])"#;
    let script = parse_chain_script(text).unwrap();
    assert_eq!(script.chain, "line.chain.ron");
    let mut all = editor(3);
    let fault = run_chain_script(&mut all, &script).unwrap_err();
    assert_eq!((fault.line, fault.column), (4, 5));
    let shorter = text.replace("link9", "link2");
    let mut all = editor(3);
    let reports = run_chain_script(&mut all, &parse_chain_script(&shorter).unwrap()).unwrap();
    assert_eq!(reports.len(), 4);
    assert!((reports[1].joints["link1"].values["turn"] - 20.0).abs() < 1e-9);
    assert!(reports[2].reach.as_ref().unwrap().reached && reports[3].reach.is_none());
    let unknown = text.replace("degrees: 20.0, by: To),\n    Reach", "angle: 20.0, by: To),\n    Reach");
    assert!(parse_chain_script(&unknown).unwrap_err().message.contains("angle"));
}

#[test]
fn a_snake_s_body_follows_its_head() {
    let mut editor = editor(8);
    let start = editor.frames()[0].position;
    let target = editor.document().end_in_world(8) + DVec3::new(0.8, 0.0, 0.0);
    let drag = ChainCommand::Reach {
        link: "link8".to_owned(),
        to: ChainGoal::World(target),
        point: None,
        rotation: None,
        solver: ChainSolver::Best,
        root: ChainRoot::Follows,
    };
    let told = run(&mut editor, drag).reach.unwrap();
    assert!(told.reached, "{told:?}");
    assert!(editor.frames()[0].position.distance(start + DVec3::new(0.8, 0.0, 0.0)) < 1e-3);
}
