//! Copy and paste: the very bits, only what was copied, and faults of a text told with their place.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::sync::{Arc, OnceLock};

use edit::{By, Command, Editor, Goal, Hold, NoFiles, Outcome, Rejected, Request, copy, copy_parts};
use glam::DVec3;
use rig::{Bone, Contact, Dof, Figure, Limb, Part, Side, Space, parse_pose};

fn figure() -> Arc<Figure> {
    static FIGURE: OnceLock<Arc<Figure>> = OnceLock::new();
    let load = || Arc::new(interchange::figure::bare_mannequin().unwrap());
    FIGURE.get_or_init(load).clone()
}

fn ask(editor: &mut Editor, request: Request) -> Result<Outcome, Rejected> {
    editor.submit(request, &mut NoFiles)
}

fn rest() -> Editor {
    Editor::new(figure())
}

/// Angles that no decimal says, a hand on the head, a foot planted.
fn posed() -> Editor {
    let mut editor = rest();
    let reach = |limb, to| Command::Reach { limb, to: Goal::World(to) };
    for command in [
        Command::Turn { joint: Bone::Spine, dof: Dof::Twist, degrees: 10.0 / 3.0, by: By::To },
        reach(Limb::LeftArm, DVec3::new(0.31, 1.41, 0.27)),
        reach(Limb::RightArm, DVec3::new(-0.2, 1.1, 0.4)),
        reach(Limb::LeftLeg, DVec3::new(0.17, 0.2, 0.3)),
        Command::Keep { limb: Limb::LeftArm, contact: Hold::Point, space: Space::Body(Bone::Head) },
        Command::Keep { limb: Limb::LeftLeg, contact: Hold::Planted, space: Space::World },
        Command::Handshape { side: Side::Left, name: "point".into(), amount: 0.7 },
        Command::MoveHips { by: DVec3::new(0.01, -0.03, 0.02) },
    ] {
        ask(&mut editor, Request::Do(command)).unwrap();
    }
    editor
}

fn paste(editor: &mut Editor, text: &str, mirrored: bool) -> Result<Outcome, Rejected> {
    ask(editor, Request::Paste { text: text.to_owned(), mirrored })
}

#[test]
fn what_is_pasted_has_the_very_bits_of_what_was_copied() {
    let from = posed();
    for parts in [vec![Part::LeftArm, Part::LeftHand], vec![Part::Torso], vec![Part::LeftLeg, Part::Head]] {
        let text = copy_parts(from.figure(), from.pose(), &parts);
        let mut to = rest();
        ask(&mut to, Request::Do(Command::Place { by: DVec3::new(1.0, 0.0, 2.0), turn: 70.0 })).unwrap();
        let before = to.document().clone();
        let outcome = paste(&mut to, &text, false).unwrap();
        assert!(outcome.message.starts_with("Pasted"), "{outcome:?}");
        for bone in Bone::ALL {
            let expected = if parts.contains(&bone.part()) { from.pose() } else { &before.pose };
            assert_eq!(to.pose().angles(bone), expected.angles(bone), "{bone} with {parts:?}");
        }
        assert_eq!(to.pose().place, before.pose.place);
        let hips = if parts.contains(&Part::Torso) { from.pose().hips } else { before.pose.hips };
        assert_eq!(to.pose().hips, hips);
        ask(&mut to, Request::Undo).unwrap();
        assert_eq!(*to.document(), before, "one step");
    }
}

#[test]
fn whole_limbs_bring_their_contact_and_hold_where_they_then_are() {
    let from = posed();
    let mut to = rest();
    paste(&mut to, &copy_parts(from.figure(), from.pose(), &[Part::LeftArm, Part::LeftLeg]), false).unwrap();
    let state = to.pose().limb(Limb::LeftArm);
    assert!(matches!(state.contact, Contact::Point { space: Space::Body(Bone::Head), .. }), "{state:?}");
    assert!(matches!(to.pose().limb(Limb::LeftLeg).contact, Contact::Planted { .. }));
    assert!(to.evaluation().limbs.iter().all(|limb| limb.residual < 1e-9));
}

#[test]
fn single_joints_bring_no_contact() {
    let from = posed();
    let text = copy(from.figure(), from.pose(), &[Bone::LeftUpperArm, Bone::LeftHand]);
    let patch = parse_pose(&text).unwrap();
    assert_eq!(patch.joints.len(), 2);
    assert!(patch.limbs.is_empty() && patch.hips.is_none() && patch.place.is_none());
    let mut to = rest();
    paste(&mut to, &text, false).unwrap();
    assert_eq!(to.pose().angles(Bone::LeftUpperArm), from.pose().angles(Bone::LeftUpperArm));
    assert_eq!(to.pose().angles(Bone::LeftLowerArm), rig::Angles::REST);
    assert_eq!(to.pose().limb(Limb::LeftArm).contact, Contact::Free);
    let hips = parse_pose(&copy(from.figure(), from.pose(), &[Bone::Hips])).unwrap();
    assert_eq!(hips.hips, Some(from.pose().hips));
}

#[test]
fn pasted_mirrored_twice_is_the_original() {
    let from = posed();
    let arm = [Part::LeftArm, Part::LeftHand];
    let twin = [Part::RightArm, Part::RightHand];
    let mut once = rest();
    paste(&mut once, &copy_parts(from.figure(), from.pose(), &arm), true).unwrap();
    for bone in Bone::ALL.into_iter().filter(|bone| arm.contains(&bone.part())) {
        assert_eq!(once.pose().angles(bone.mirrored()), from.pose().angles(bone), "{bone}");
        assert_eq!(once.pose().angles(bone), rig::Angles::REST);
    }
    let mut twice = rest();
    paste(&mut twice, &copy_parts(once.figure(), once.pose(), &twin), true).unwrap();
    for bone in Bone::ALL.into_iter().filter(|bone| arm.contains(&bone.part())) {
        assert_eq!(twice.pose().angles(bone), from.pose().angles(bone), "{bone}");
    }
}

#[test]
fn any_pose_file_can_be_pasted() {
    let from = posed();
    let mut to = rest();
    paste(&mut to, &rig::write_pose(from.figure(), from.pose()), false).unwrap();
    assert_eq!(to.pose().angles, from.pose().angles);
    let text = "(version: 1, joints: { \"head\": (twist: -15.0) })";
    let outcome = paste(&mut to, text, false).unwrap();
    assert_eq!((outcome.message.as_str(), to.pose().angles(Bone::Head).twist), ("Pasted 1 joint", -15.0));
}

#[test]
fn what_is_no_pose_is_refused_with_its_place() {
    let mut editor = posed();
    let before = editor.document().clone();
    let cases = [
        ("", "clipboard:1:1"),
        ("hello\nworld", "clipboard:1:"),
        ("(version: 1,\n joints: {\n  \"leftUperArm\": () })", "clipboard:3:"),
        ("(version: 9)", "clipboard:1:2: version 9"),
        ("(version: 1, joints: { \"head\": (flexion: inf) })", "clipboard:1:"),
        ("(version: 1)", "names no joint"),
        ("(version: 1, joints: { \"leftLowerArm\": (abduction: 5.0) })", "no abduction"),
    ];
    for (text, expected) in cases {
        let Rejected(why) = paste(&mut editor, text, false).unwrap_err();
        assert!(why.contains(expected), "{why:?} for {text:?}");
        assert_eq!((editor.document(), editor.in_gesture()), (&before, false));
    }
}
