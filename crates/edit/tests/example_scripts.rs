//! The shipped scripts: each shows a gesture sequence, and each is held to what it shows.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::Arc;

use edit::{By, Command, Editor, Hold, LimbReport, NoFiles, Report, Script, parse_script, run_script};
use glam::DVec3;

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../assets/scripts")
}

/// A script and its records: record i + 1 is what command i made.
fn run(name: &str) -> (Script, Vec<Report>) {
    let text = std::fs::read_to_string(folder().join(format!("{name}.script.ron"))).expect(name);
    let script = parse_script(&text).unwrap_or_else(|e| panic!("{name}: {e}"));
    let figure = Arc::new(interchange::figure::bare_mannequin().expect("the shipped figure loads"));
    let reports =
        run_script(&mut Editor::new(figure), &script, &mut NoFiles).unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!(reports.len(), script.commands.len() + 1);
    (script, reports)
}

fn at(report: &Report, joint: &str) -> DVec3 {
    DVec3::from(report.joints[joint].position)
}

fn angles<'a>(report: &'a Report, joint: &str) -> &'a BTreeMap<&'static str, f64> {
    &report.joints[joint].angles
}

fn arm<'a>(report: &'a Report, limb: &str) -> &'a LimbReport {
    &report.limbs[limb]
}

/// The records made by commands that fit, with the record before each.
fn steps(
    script: &Script,
    reports: &[Report],
    fits: impl Fn(&Command) -> bool,
) -> Vec<(Command, Report, Report)> {
    let found: Vec<_> = script
        .commands
        .iter()
        .enumerate()
        .filter(|(_, c)| fits(c))
        .map(|(i, c)| (c.clone(), reports[i].clone(), reports[i + 1].clone()))
        .collect();
    assert!(!found.is_empty(), "the script has lost what it shows");
    found
}

#[test]
fn every_shipped_script_runs_unstopped() {
    let mut count = 0;
    for entry in std::fs::read_dir(folder()).unwrap() {
        let entry = entry.unwrap();
        // Those of chains are run by the program's own tests: chains come from files.
        if edit::chain_of_script(&std::fs::read_to_string(entry.path()).unwrap()).is_some() {
            continue;
        }
        let name = entry.file_name().into_string().unwrap();
        let (_, reports) = run(name.strip_suffix(".script.ron").expect("a script"));
        for report in &reports {
            assert!(!report.clamped, "{name}: {}", report.command);
            for (limb, state) in &report.limbs {
                assert!(
                    state.residual < 1e-9,
                    "{name}: {}: {limb} is {} m off",
                    report.command,
                    state.residual
                );
            }
        }
        count += 1;
    }
    assert!(count >= 6, "{count} scripts");
}

#[test]
fn fingertip_stays_on_the_nose_with_the_elbow_up_down_and_between() {
    let (script, reports) = run("fingertip-to-nose");
    let lifts = steps(&script, &reports, |c| matches!(c, Command::Elevate { .. }));
    assert_eq!(lifts.len(), 3);
    let mut heights = Vec::new();
    for (command, before, after) in &lifts {
        let Command::Elevate { degrees, by: By::To, .. } = command else { panic!("{command:?}") };
        assert!((arm(after, "leftArm").elevation.unwrap() - degrees).abs() < 1e-9);
        let moved = DVec3::from(arm(after, "leftArm").articulator)
            .distance(arm(before, "leftArm").articulator.into());
        assert!(moved < 1e-9, "the fingertip moved by {moved} m");
        for joint in ["leftLowerArm", "leftHand", "leftIndexDistal", "leftShoulder"] {
            assert_eq!(angles(after, joint), angles(before, joint), "{joint}");
        }
        heights.push(at(after, "leftLowerArm").y);
    }
    assert!(heights[1] > heights[0] + 0.1, "the elbow goes up: {heights:?}");
    assert!(heights[0] < heights[2] && heights[2] < heights[1], "and settles between: {heights:?}");
}

#[test]
fn wrist_turns_in_all_three_ways_about_a_still_fingertip() {
    let (script, reports) = run("wrist-about-fingertip");
    let turns = steps(&script, &reports, |c| matches!(c, Command::TurnInContact { .. }));
    let mut dofs = Vec::new();
    for (command, before, after) in &turns {
        let Command::TurnInContact { dof, degrees, .. } = command else { panic!("{command:?}") };
        let (was, is) = (arm(before, "leftArm"), arm(after, "leftArm"));
        let slip = DVec3::from(was.articulator).distance(is.articulator.into());
        assert!(slip < 1e-9, "the fingertip slipped {slip} m");
        assert!((was.elevation.unwrap() - is.elevation.unwrap()).abs() < 1e-7);
        let joint = if dof.name() == "twist" { "leftLowerArm" } else { "leftHand" };
        let turned = angles(after, joint)[dof.name()] - angles(before, joint)[dof.name()];
        assert!((turned - degrees).abs() < 1e-9, "{turned} of {degrees}");
        dofs.push(dof.name());
    }
    for dof in ["flexion", "abduction", "twist"] {
        assert!(dofs.contains(&dof), "{dof}");
    }
}

#[test]
fn a_straightened_arm_carries_on_without_a_jump() {
    let (script, reports) = run("straight-arm-carries-on");
    let reaches = steps(&script, &reports, |c| matches!(c, Command::Reach { .. }));
    let (_, before, stays) = &reaches[0];
    assert_eq!(before.joints, stays.joints, "Here moves nothing, bit for bit");
    assert_eq!(angles(stays, "leftLowerArm")["flexion"], 0.0, "the arm is straight");
    for (command, before, after) in &reaches {
        let goal =
            DVec3::from(arm(after, "leftArm").target).distance(arm(before, "leftArm").articulator.into());
        let elbow = at(after, "leftLowerArm").distance(at(before, "leftLowerArm"));
        // Near full stretch the elbow leaves the line as the square root of what is missing, no faster.
        let most = (2.0 * goal * 0.28).sqrt() + goal;
        assert!(elbow <= most, "{}: the elbow went {elbow} m for {goal} m", command.text());
        assert!(
            (arm(after, "leftArm").elevation.unwrap() - arm(before, "leftArm").elevation.unwrap()).abs()
                < 1e-5
        );
    }
}

#[test]
fn palms_stay_together_while_torso_and_arm_move() {
    let (script, reports) = run("palms-together");
    let moves = steps(&script, &reports, |c| {
        matches!(c, Command::Turn { joint: rig::Bone::Spine | rig::Bone::Chest, .. })
    });
    assert!(moves.len() >= 2);
    for (_, before, after) in &moves {
        let carried = at(after, "leftHand").distance(at(before, "leftHand"));
        assert!(carried > 0.01, "the hands go with the chest");
        for limb in ["leftArm", "rightArm"] {
            assert_eq!(arm(after, limb).contact, "Point");
            assert!(arm(after, limb).residual < 1e-9);
        }
    }
    let last = reports.last().unwrap();
    assert!(at(last, "leftHand").distance(at(last, "rightHand")) < 0.12, "the palms are together");
}

#[test]
fn hands_on_the_body_stay_while_the_torso_bends() {
    let (script, reports) = run("hand-on-hip");
    let bends = steps(&script, &reports, |c| {
        matches!(c, Command::Turn { joint: rig::Bone::Spine | rig::Bone::Chest | rig::Bone::UpperChest, .. })
    });
    for (_, before, after) in &bends {
        let hip = |r: &Report| DVec3::from(arm(r, "leftArm").articulator);
        assert!(
            hip(after).distance(hip(before)) < 1e-9,
            "the hips do not move, so the hand on them does not"
        );
        assert!(arm(after, "rightArm").residual < 1e-9);
        assert!(
            (arm(after, "leftArm").elevation.unwrap() - arm(before, "leftArm").elevation.unwrap()).abs()
                < 1e-7
        );
    }
    let last = reports.last().unwrap();
    assert!(arm(last, "leftArm").articulator[0] < 0.0, "the left hand is on the right side");
}

#[test]
fn a_hand_planted_on_a_table_stays_flat_while_the_hips_move() {
    let (script, reports) = run("hand-on-table");
    let planted =
        script.commands.iter().filter(|c| matches!(c, Command::Keep { contact: Hold::Planted, .. })).count();
    assert_eq!(planted, 3, "both feet and the hand");
    let sways = steps(&script, &reports, |c| matches!(c, Command::MoveHips { .. }));
    for (_, before, after) in &sways {
        assert!(at(after, "hips").distance(at(before, "hips")) > 0.01);
        for (limb, end) in [("leftArm", "leftHand"), ("leftLeg", "leftFoot"), ("rightLeg", "rightFoot")] {
            assert!(arm(after, limb).residual < 1e-9 && arm(after, limb).rotation_residual < 1e-6, "{limb}");
            assert!(at(after, end).distance(at(before, end)) < 1e-9, "{end} stays");
        }
    }
}
