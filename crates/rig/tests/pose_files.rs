//! Pose files: the same bits after a round trip, and damage answered with its place.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::sync::OnceLock;

use glam::{DQuat, DVec3};
use proptest::prelude::*;
use rig::{
    Bone, Contact, Dof, Figure, Limb, LimbState, Part, Pose, Reacher, Space, TextFault, parse_pose,
    write_parts, write_pose,
};

fn figure() -> &'static Figure {
    static FIGURE: OnceLock<Figure> = OnceLock::new();
    FIGURE.get_or_init(|| interchange::figure::bare_mannequin().expect("the shipped figure loads"))
}

fn busy_pose(figure: &Figure, numbers: &[f64]) -> Pose {
    let mut pose = figure.rest_pose();
    let mut next = numbers.iter().copied().cycle();
    let mut number = || next.next().unwrap_or(0.0);
    for joint in figure.skeleton.joints() {
        for dof in joint.dofs() {
            pose.angles[joint.bone.index()].set(dof, number() * 40.0);
        }
    }
    pose.hips = DVec3::new(number(), number(), number());
    pose.place.position = DVec3::new(number(), number(), number());
    pose.place.turn = number() * 100.0;
    let target = DVec3::new(number(), number(), number());
    pose.limbs[0].contact = Contact::Point { space: Space::Body(Bone::Head), target };
    pose.limbs[1].reacher = Reacher::Point(Bone::RightHand, target);
    let rotation = DQuat::from_scaled_axis(target);
    pose.limbs[2].contact = Contact::Planted { space: Space::World, target, rotation };
    pose
}

fn bits(pose: &Pose) -> String {
    // Shortest text that gives the same number back, so equal text is equal bits.
    format!("{pose:?}")
}

proptest! {
    #[test]
    fn a_round_trip_changes_no_bit(numbers in prop::collection::vec(-3.0f64..3.0, 7..80)) {
        let figure = figure();
        let pose = busy_pose(figure, &numbers);
        let text = write_pose(figure, &pose);
        let back = parse_pose(&text).unwrap().onto(&figure.rest_pose());
        prop_assert_eq!(bits(&back), bits(&pose));
        prop_assert_eq!(write_pose(figure, &back), text);
    }

    #[test]
    fn damage_is_answered_and_never_panics(cut in 0usize..6000, at in 0usize..6000, byte in 32u8..127) {
        let figure = figure();
        let text = write_pose(figure, &busy_pose(figure, &[0.3, -0.7, 1.1]));
        let cut = &text[..cut.min(text.len())];
        if cut.trim_end().len() < text.trim_end().len() {
            let fault = parse_pose(cut).expect_err("a cut file is not whole");
            prop_assert!(fault.line >= 1 && fault.column >= 1);
        }
        let mut bytes = text.into_bytes();
        let at = at % bytes.len();
        bytes[at] = byte;
        let _ = parse_pose(&String::from_utf8(bytes).unwrap());
    }
}

fn fault(text: &str) -> TextFault {
    parse_pose(text).expect_err(text)
}

#[test]
fn a_partial_pose_names_only_some_bones() {
    let figure = figure();
    let patch = parse_pose("(version: 1, joints: {\"leftLowerArm\": (flexion: 40)})").unwrap();
    let mut before = figure.rest_pose();
    before.angles[Bone::Head.index()].set(Dof::Twist, 12.0);
    let after = patch.onto(&before);
    assert_eq!(after.angles(Bone::LeftLowerArm).flexion, 40.0);
    assert_eq!(after.angles(Bone::Head).twist, 12.0);
}

#[test]
fn an_unknown_bone_is_named_with_its_place_and_the_nearest_name() {
    let fault =
        fault("(\n    version: 1,\n    joints: {\n        \"leftUperArm\": (flexion: 1.0),\n    },\n)\n");
    assert_eq!(fault.line, 4);
    assert!(fault.message.contains("leftUperArm") && fault.message.contains("\"leftUpperArm\""), "{fault}");
}

#[test]
fn an_unknown_field_is_named_with_its_place() {
    let fault = fault("(\n    version: 1,\n    colour: 3,\n)\n");
    assert_eq!(fault.line, 3);
    assert!(fault.message.contains("colour"), "{fault}");
}

#[test]
fn a_newer_version_is_named_with_its_place() {
    let fault = fault("(\n    version: 7,\n    joints: {},\n    novelty: Some(3),\n)\n");
    assert_eq!((fault.line, fault.column), (2, 5));
    assert!(fault.message.contains('7') && fault.message.contains("expected 1"), "{fault}");
}

#[test]
fn a_missing_version_is_named() {
    assert!(fault("(joints: {})").message.contains("version"));
}

#[test]
fn numbers_that_are_not_finite_are_turned_down() {
    for number in ["NaN", "inf", "-inf", "1e300"] {
        let text = format!("(version: 1,\n joints: {{\"head\": (flexion: {number})}})");
        let fault = fault(&text);
        assert_eq!(fault.line, 2, "{fault}");
        assert!(fault.message.contains("expected"), "{fault}");
    }
}

#[test]
fn brackets_without_end_are_turned_down_at_once() {
    for bracket in ["(", "[", "{", "Some("] {
        let text = bracket.repeat(2_000_000);
        assert!(parse_pose(&text).is_err());
        let inside = format!("(version: 1, joints: {}", bracket.repeat(1_000_000));
        assert!(parse_pose(&inside).is_err());
    }
}

#[test]
fn a_rotation_that_is_none_is_turned_down() {
    let text = "(version: 1, limbs: {\"leftLeg\": (articulator: Named(\"ankle\"), contact: Planted(space: World, target: (0, 0, 0), rotation: (0, 0, 0, 0)))})";
    assert!(fault(text).message.contains("length 1"));
}

#[test]
fn what_the_figure_lacks_is_named() {
    let figure = figure();
    let patch = parse_pose("(version: 1, joints: {\"leftLowerLeg\": (abduction: 4.0)})").unwrap();
    let fault = rig::check_patch(figure, &patch).unwrap_err().to_string();
    assert!(fault.contains("leftLowerLeg") && fault.contains("abduction"), "{fault}");
    let text = "(version: 1, limbs: {\"leftArm\": (articulator: Named(\"nose\"), contact: Free)})";
    let fault = rig::check_patch(figure, &parse_pose(text).unwrap()).unwrap_err().to_string();
    assert!(fault.contains("nose") && fault.contains("palm"), "{fault}");
}

#[test]
fn contacts_in_a_circle_are_named() {
    let figure = figure();
    let mut pose = figure.rest_pose();
    let on = |bone| Contact::Point { space: Space::Body(bone), target: DVec3::ZERO };
    pose.limbs[Limb::LeftArm.index()] =
        LimbState { contact: on(Bone::RightHand), ..LimbState::rest(Limb::LeftArm) };
    pose.limbs[Limb::RightArm.index()] =
        LimbState { contact: on(Bone::LeftIndexDistal), ..LimbState::rest(Limb::RightArm) };
    let fault = rig::contact_order(&pose).unwrap_err().to_string();
    assert!(fault.contains("leftArm -> rightArm -> leftArm"), "{fault}");
    let patch = parse_pose(&write_pose(figure, &pose)).unwrap();
    assert!(rig::check_patch(figure, &patch).is_err());
}

#[test]
fn parts_of_a_pose_are_written_alone() {
    let figure = figure();
    let pose = busy_pose(figure, &[0.3, -0.7, 0.2]);
    let some = [Part::LeftArm, Part::LeftHand];
    let patch = parse_pose(&write_parts(figure, &pose, &some)).unwrap();
    assert!(patch.place.is_none() && patch.hips.is_none());
    assert!(patch.joints.keys().all(|bone| some.contains(&bone.part())) && patch.joints.len() > 15);
    assert_eq!(patch.limbs.keys().copied().collect::<Vec<_>>(), [Limb::LeftArm]);
    let torso = parse_pose(&write_parts(figure, &pose, &[Part::Torso])).unwrap();
    assert!(torso.hips == Some(pose.hips) && torso.limbs.is_empty() && torso.place.is_none());
    assert_eq!(write_parts(figure, &pose, &[]), write_pose(figure, &pose));
}

#[test]
fn a_pose_tells_the_size_of_its_figure() {
    let text = write_pose(figure(), &figure().rest_pose());
    let size = parse_pose(&text).unwrap().size.unwrap();
    assert_eq!(size, rig::Size::of(&figure().skeleton));
    assert_eq!((size.hips, size.ankle), (0.94, 0.067));
}
