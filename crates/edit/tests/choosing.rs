//! Choosing joints, as (state, events, state).
#![allow(clippy::unwrap_used)]

use edit::{Choose, Selection};
use glam::DVec3;
use rig::{Articulation, Bone, Bone::*, Joint, Part, Skeleton};

/// All bones but the jaw, each a little above its carrier.
fn skeleton() -> Skeleton {
    let joint = |bone: Bone| Joint {
        bone,
        carrier: (bone != Hips).then(|| bone.carrier()),
        offset: DVec3::Y * 0.1,
        articulation: Articulation::Hinges(Vec::new()),
        mass: 1.0,
        center_of_mass: DVec3::ZERO,
    };
    Skeleton::new(Bone::ALL.into_iter().filter(|bone| *bone != Jaw).map(joint).collect()).unwrap()
}

/// What is chosen after these events, beginning with nothing.
fn after(events: &[Choose]) -> Selection {
    let mut selection = Selection::default();
    for event in events {
        selection.choose(&skeleton(), *event);
    }
    selection
}

fn bones(events: &[Choose]) -> Vec<Bone> {
    after(events).bones().to_vec()
}

#[test]
fn the_last_chosen_is_the_active_one() {
    let both = after(&[Choose::Only(Head), Choose::Toggle(LeftHand)]);
    assert_eq!(both.bones(), [Head, LeftHand]);
    assert_eq!(both.active(), Some(LeftHand));
    assert!(both.contains(Head) && !both.contains(Neck) && !both.is_empty());
    assert_eq!(both.parts(), [Part::Head, Part::LeftArm]);
}

#[test]
fn choosing_one_lets_the_others_go_and_toggling_lets_go_of_one() {
    assert_eq!(bones(&[Choose::Only(Head), Choose::Toggle(Neck), Choose::Only(Hips)]), [Hips]);
    assert_eq!(bones(&[Choose::Only(Head), Choose::Toggle(Neck), Choose::Toggle(Head)]), [Neck]);
    assert_eq!(bones(&[Choose::Toggle(Neck), Choose::Toggle(Neck)]), []);
    assert_eq!(bones(&[Choose::Only(Head), Choose::None]), []);
}

#[test]
fn child_goes_back_the_way_that_parent_came() {
    let up = [Choose::Only(LeftRingDistal), Choose::Parent, Choose::Parent, Choose::Parent, Choose::Parent];
    assert_eq!(bones(&up), [LeftLowerArm]);
    let down = |n: usize| [&up[..], &vec![Choose::Child; n]].concat();
    assert_eq!(bones(&down(1)), [LeftHand]);
    assert_eq!(bones(&down(2)), [LeftRingProximal], "and not the thumb, which comes first");
    assert_eq!(bones(&down(4)), [LeftRingDistal]);
    assert_eq!(bones(&down(5)), [LeftRingDistal], "a fingertip carries nothing");
}

#[test]
fn the_way_back_is_forgotten_where_something_else_is_chosen() {
    let begun = [Choose::Only(RightFoot), Choose::Parent, Choose::Parent, Choose::Parent];
    assert_eq!(bones(&begun), [Hips]);
    let other = [&begun[..], &[Choose::Next, Choose::Only(Hips), Choose::Child]].concat();
    assert_eq!(bones(&other), [Spine], "the first that the hips carry");
    let toggled = [&begun[..], &[Choose::Toggle(Neck), Choose::Toggle(Neck), Choose::Child]].concat();
    assert_eq!(bones(&toggled), [Spine]);
}

#[test]
fn the_hips_have_no_parent_and_nothing_has_neither() {
    assert_eq!(bones(&[Choose::Only(Hips), Choose::Parent]), [Hips]);
    assert_eq!(bones(&[Choose::Only(Hips), Choose::Parent, Choose::Child]), [Spine]);
    assert_eq!(bones(&[Choose::Parent]), []);
    assert_eq!(bones(&[Choose::Child]), []);
    assert_eq!(bones(&[Choose::NextOfLevel]), []);
}

#[test]
fn next_and_previous_walk_the_skeleton_round() {
    let all: Vec<Bone> = skeleton().joints().map(|joint| joint.bone).collect();
    let mut selection = Selection::default();
    for bone in &all {
        selection.choose(&skeleton(), Choose::Next);
        assert_eq!(selection.active(), Some(*bone));
    }
    selection.choose(&skeleton(), Choose::Next);
    assert_eq!(selection.bones(), [Hips]);
    selection.choose(&skeleton(), Choose::Previous);
    assert_eq!(selection.bones(), [RightToes]);
    assert_eq!(bones(&[Choose::Previous]), [RightToes]);
    assert_eq!(bones(&[Choose::Only(Head), Choose::Toggle(LeftFoot), Choose::Next]), [LeftToes]);
}

#[test]
fn the_same_level_is_the_other_finger_or_the_other_side() {
    let next = |bone| bones(&[Choose::Only(bone), Choose::NextOfLevel]);
    assert_eq!(next(LeftIndexIntermediate), [LeftMiddleIntermediate]);
    assert_eq!(next(LeftLittleDistal), [LeftThumbDistal]);
    assert_eq!(next(LeftLowerArm), [RightLowerArm]);
    assert_eq!(next(RightLowerArm), [LeftLowerArm]);
    assert_eq!(next(RightToes), [LeftToes]);
    assert_eq!(next(LeftEye), [RightEye]);
    assert_eq!(next(Chest), [Chest], "it is alone on its level");
    assert_eq!(bones(&[Choose::Only(LeftThumbMetacarpal), Choose::PreviousOfLevel]), [LeftLittleProximal]);
}

#[test]
fn a_part_is_chosen_whole() {
    let arm = after(&[Choose::Only(Head), Choose::Part(Part::LeftArm)]);
    assert_eq!(arm.bones(), [LeftShoulder, LeftUpperArm, LeftLowerArm, LeftHand]);
    assert_eq!(arm.parts(), [Part::LeftArm]);
    assert!(Selection::default().parts().is_empty());
}

#[test]
fn a_bone_that_the_skeleton_lacks_is_not_chosen() {
    assert_eq!(bones(&[Choose::Only(Jaw)]), []);
    assert_eq!(bones(&[Choose::Only(Head), Choose::Toggle(Jaw)]), [Head]);
    assert_eq!(bones(&[Choose::Part(Part::Head)]), [Neck, Head, LeftEye, RightEye]);
}
