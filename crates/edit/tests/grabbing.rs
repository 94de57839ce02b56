//! A drag of the skin: which gesture it is, and that the grabbed point goes where the pointer is.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::sync::Arc;

use edit::{At, Command, Editor, Grab, Handle, Hit, Hold, NoFiles, Request};
use glam::DVec3;
use rig::{Bone, Limb, Space, parse_pose};

const READY: &str = r#"(version: 1, hips: (0.0, 0.91, 0.0), joints: {
    "leftUpperArm": (flexion: 35.0, abduction: -50.0), "leftLowerArm": (flexion: 80.0, twist: -70.0),
    "rightUpperArm": (flexion: 35.0, abduction: -50.0), "rightLowerArm": (flexion: 80.0, twist: -70.0),
    "leftUpperLeg": (flexion: 15.0), "leftLowerLeg": (flexion: 30.0), "leftFoot": (flexion: 15.0),
    "rightUpperLeg": (flexion: 15.0), "rightLowerLeg": (flexion: 30.0), "rightFoot": (flexion: 15.0),
})"#;

fn editor() -> Editor {
    let figure = Arc::new(interchange::figure::bare_mannequin().unwrap());
    let pose = parse_pose(READY).unwrap().onto(&figure.rest_pose());
    let mut editor = Editor::new(figure);
    editor.submit(Request::Open(Box::new(pose)), &mut NoFiles).unwrap();
    editor
}

fn keep(editor: &mut Editor, limb: Limb, contact: Hold) {
    let command = Command::Keep { limb, contact, space: Space::World };
    editor.submit(Request::Do(command), &mut NoFiles).unwrap();
}

/// A hit of the skin at a point of a bone.
fn hit(editor: &Editor, bone: Bone, point_in_bone: DVec3) -> Hit {
    let point_in_world = editor.evaluation().frames[bone].point(point_in_bone);
    Hit { bone, point_in_world, point_in_bone, normal_in_world: DVec3::Z, distance: 1.0 }
}

/// Grabs, drags in ten steps, lets go; the grabbed point afterwards and how far it is from the pointer.
fn drag(editor: &mut Editor, bone: Bone, point: DVec3, by: DVec3) -> (Grab, f64) {
    let grab = Grab::begin(editor.figure(), editor.pose(), editor.evaluation(), &hit(editor, bone, point));
    let goal = grab.first_in_world + by;
    for step in 1..=10 {
        let commands = grab.commands(editor.figure(), grab.first_in_world.lerp(goal, f64::from(step) / 10.0));
        editor.submit(Request::PreviewAll(commands), &mut NoFiles).unwrap();
    }
    editor.submit(Request::Commit, &mut NoFiles).unwrap();
    let off = editor.evaluation().frames[bone].point(point).distance(goal);
    (grab, off)
}

#[test]
fn hands_forearms_shins_and_feet_follow_the_pointer_exactly() {
    for (bone, point, limb) in [
        (Bone::LeftHand, DVec3::new(0.06, -0.015, 0.01), Limb::LeftArm),
        (Bone::RightIndexDistal, DVec3::new(-0.015, 0.0, 0.0), Limb::RightArm),
        (Bone::LeftLowerArm, DVec3::new(0.15, 0.03, 0.0), Limb::LeftArm),
        (Bone::RightLowerLeg, DVec3::new(0.0, -0.25, 0.05), Limb::RightLeg),
        (Bone::LeftFoot, DVec3::new(0.0, -0.03, 0.08), Limb::LeftLeg),
        (Bone::LeftToes, DVec3::new(0.0, 0.0, 0.04), Limb::LeftLeg),
    ] {
        let mut editor = editor();
        let depth = editor.undo_depth();
        let (grab, off) = drag(&mut editor, bone, point, DVec3::new(0.03, 0.04, 0.05));
        assert_eq!(grab.handle, Handle::Reach(limb), "{bone}");
        assert!(off < 1e-9, "{bone} is {off} m from the pointer");
        assert_eq!(editor.undo_depth(), depth + 1, "one gesture, one step");
    }
}

#[test]
fn an_upper_arm_swings_its_root_and_leaves_the_rest() {
    for bone in [Bone::LeftUpperArm, Bone::RightUpperArm, Bone::LeftUpperLeg, Bone::RightShoulder] {
        let mut editor = editor();
        let before = editor.pose().clone();
        let joint = editor.figure().skeleton.joint(bone).unwrap();
        let away = if bone == Bone::RightShoulder {
            DVec3::new(-0.1, 0.02, 0.0)
        } else {
            joint.bone_direction().unwrap() * 0.15
        };
        let (grab, off) = drag(&mut editor, bone, away, DVec3::new(0.0, 0.02, 0.03));
        assert_eq!(grab.handle, Handle::Swing(bone));
        assert!(off < 0.012, "{bone} is {off} m from the pointer");
        for other in Bone::ALL.into_iter().filter(|other| *other != bone) {
            assert_eq!(editor.pose().angles(other), before.angles(other), "{other}");
        }
    }
}

#[test]
fn an_elbow_elevates_while_its_hand_holds() {
    for (limb, bone) in [
        (Limb::LeftArm, Bone::LeftLowerArm),
        (Limb::RightArm, Bone::RightLowerArm),
        (Limb::LeftLeg, Bone::LeftLowerLeg),
        (Limb::RightLeg, Bone::RightLowerLeg),
    ] {
        let mut editor = editor();
        let grabbed = DVec3::new(0.0, 0.0, 0.01);
        let free =
            Grab::begin(editor.figure(), editor.pose(), editor.evaluation(), &hit(&editor, bone, grabbed));
        assert_eq!(free.handle, Handle::Swing(limb.parts().root), "free: the root turns");
        keep(&mut editor, limb, Hold::Point);
        let was = editor.evaluation().limbs[limb.index()];
        let out = if limb.side() == rig::Side::Left { 0.06 } else { -0.06 };
        let at = editor.evaluation().frames[bone].position;
        let (grab, _) = drag(&mut editor, bone, grabbed, DVec3::new(out, 0.03, 0.0));
        assert_eq!(grab.handle, Handle::Elevate(limb));
        let is = editor.evaluation().limbs[limb.index()];
        assert!(is.articulator.distance(was.articulator) < 1e-9);
        assert!(is.elevation.unwrap() > was.elevation.unwrap(), "{}: outward is up", limb.name());
        let moved = editor.evaluation().frames[bone].position - at;
        assert!(moved.x * out > 0.0, "{}: the hinge goes with the pointer: {moved}", limb.name());
    }
}

#[test]
fn a_knee_over_a_planted_foot_goes_as_far_round_its_circle_as_the_pointer() {
    let mut editor = editor();
    let toes = Command::Articulate { limb: Limb::LeftLeg, at: At::Named("toeTip".to_owned()) };
    editor.submit(Request::Do(toes), &mut NoFiles).unwrap();
    keep(&mut editor, Limb::LeftLeg, Hold::Planted);
    let (figure, pose) = (editor.figure().clone(), editor.pose().clone());
    let frames = editor.evaluation().frames;
    let (circle, _) = edit::elevation_circle(&figure, &pose, &frames, Limb::LeftLeg).unwrap();
    let grabbed = DVec3::new(0.0, 0.0, 0.05);
    let first = frames[Bone::LeftLowerLeg].point(grabbed);
    let by = DVec3::new(0.015, 0.0, 0.0);
    drag(&mut editor, Bone::LeftLowerLeg, grabbed, by);
    let is = editor.evaluation().frames[Bone::LeftLowerLeg].point(grabbed);
    let off = circle.angle_of(is) - circle.angle_of(first + by);
    assert!(off.abs() < 1e-6, "{} degrees", off.to_degrees());
}

#[test]
fn hips_move_over_planted_feet() {
    let mut editor = editor();
    keep(&mut editor, Limb::LeftLeg, Hold::Planted);
    keep(&mut editor, Limb::RightLeg, Hold::Planted);
    let (grab, off) =
        drag(&mut editor, Bone::Hips, DVec3::new(0.05, 0.0, 0.1), DVec3::new(0.02, -0.03, 0.02));
    assert_eq!(grab.handle, Handle::Hips);
    assert!(off < 1e-12);
    for leg in [Limb::LeftLeg, Limb::RightLeg] {
        assert!(editor.evaluation().limbs[leg.index()].residual < 1e-9);
    }
}

#[test]
fn chest_and_head_turn_with_the_pointer() {
    for (bone, point, handle) in [
        (Bone::UpperChest, DVec3::new(0.0, 0.1, 0.12), Handle::Spine),
        (Bone::Head, DVec3::new(0.0, 0.05, 0.12), Handle::Head),
    ] {
        let mut editor = editor();
        let start = editor.evaluation().frames[bone].point(point);
        let by = DVec3::new(0.03, 0.01, 0.01);
        let (grab, off) = drag(&mut editor, bone, point, by);
        assert_eq!(grab.handle, handle);
        let moved = editor.evaluation().frames[bone].point(point) - start;
        assert!(moved.dot(by) > 0.0 && off < by.length(), "{bone}: moved {moved}, off {off}");
    }
}

#[test]
fn a_grab_that_has_not_moved_changes_nothing_but_the_articulator() {
    let mut editor = editor();
    let before = editor.pose().clone();
    let (_, off) = drag(&mut editor, Bone::LeftHand, DVec3::new(0.06, -0.015, 0.01), DVec3::ZERO);
    assert!(off < 1e-12);
    for bone in Bone::ALL {
        let (a, b) = (editor.pose().angles(bone), before.angles(bone));
        assert!(rig::Dof::ALL.iter().all(|d| (a.get(*d) - b.get(*d)).abs() < 1e-9), "{bone}");
    }
}
