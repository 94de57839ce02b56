//! Figures that lack bones, or a skin: whatever pointer, keys and panels do to them, numbers stay finite and undo
//! gives back the very bits.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod stage;

use std::sync::Arc;

use edit::{
    Axis, Choose, Command, Constraint, Event, Finger, Modifiers, Request, Selection, clear_place, eye_point,
    eyes, gaze_point, marked_joints, set_curl, set_eyes, set_spread, to_rest,
};
use glam::{DVec3, Vec2};
use rig::{Bone, Dof, Figure, Joint, Limb, LimbRigs, Locks, Mechanics, Part, Side, Skeleton};
use stage::{Table, figure, words};

/// The mannequin without a bone and all that hangs on it.
fn without(bone: Bone, skin: bool) -> Arc<Figure> {
    let whole = figure();
    let carrier = |bone: &Bone| whole.skeleton.joint(*bone).and_then(|joint| joint.carrier);
    let gone = |joint: &&Joint| std::iter::successors(Some(joint.bone), carrier).any(|above| above == bone);
    let joints = whole.skeleton.joints().filter(|joint| !gone(joint)).cloned().collect();
    let skeleton = Skeleton::new(joints).unwrap();
    let bases = Limb::ALL.map(|limb| whole.limbs.swing_base(limb));
    let limbs = LimbRigs::new(&skeleton, bases);
    let skin = whole.skin.clone().filter(|_| skin);
    Arc::new(Figure { skeleton, limbs, skin, ..Figure::clone(&whole) })
}

fn poor() -> Vec<(Bone, Arc<Figure>)> {
    use Bone::*;
    let lacking = [
        Spine,
        Chest,
        UpperChest,
        Neck,
        Head,
        LeftEye,
        Jaw,
        LeftShoulder,
        RightUpperArm,
        LeftLowerArm,
        LeftHand,
        RightThumbMetacarpal,
        LeftUpperLeg,
        RightLowerLeg,
        LeftFoot,
        RightToes,
    ];
    lacking.into_iter().enumerate().map(|(i, bone)| (bone, without(bone, i % 3 != 0))).collect()
}

fn check(table: &Table, lacks: Bone) {
    let evaluation = table.editor.evaluation();
    let finite = evaluation.frames.0.iter().all(|f| f.position.is_finite() && f.rotation.is_finite());
    assert!(finite, "without {lacks}");
}

/// A drag there with all that keys can do to one, and what a click does.
fn handle(table: &mut Table, at: Vec2, lacks: Bone) {
    for modifiers in [
        Modifiers::default(),
        Modifiers { snap: true, ..Modifiers::default() },
        Modifiers { in_contact: true, ..Modifiers::default() },
    ] {
        table.modified(modifiers);
        table.hold(at, Vec2::new(60.0, -45.0));
        table.hands.telling(&words());
        table.tell(Event::Constrain(Constraint::Along(Axis::X)));
        table.tell(Event::Typed('9'));
        check(table, lacks);
        table.tell(Event::Released);
        table.click(at);
        table.hands.offering(&table.stage(), &words());
        check(table, lacks);
    }
    table.modified(Modifiers::default());
}

#[test]
fn pointer_and_keys_work_on_what_is_there() {
    for (lacks, figure) in poor() {
        let mut table = Table::new(figure);
        let before = table.pose();
        for bone in
            [Bone::Hips, Bone::LeftHand, Bone::RightLowerArm, Bone::LeftLowerLeg, Bone::Neck, Bone::LeftEye]
        {
            table.selected = Some(bone);
            table.hands.skin(&table.editor);
            let stage = table.stage();
            let knobs = table.hands.knobs(&stage);
            let places: Vec<Vec2> = knobs.iter().filter_map(|k| table.hands.place_of(&stage, k)).collect();
            for at in places {
                handle(&mut table, at, lacks);
            }
        }
        for bone in Bone::ALL.into_iter().step_by(3) {
            let at = table.pixel(table.editor.evaluation().frames[bone].position);
            handle(&mut table, at + Vec2::splat(2.0), lacks);
        }
        assert!(table.editor.undo_depth() > 20, "without {lacks}");
        while table.editor.undo_depth() > 0 {
            table.submit(Request::Undo);
        }
        assert_eq!(table.pose(), before, "without {lacks}");
    }
}

#[test]
fn panels_ask_for_what_is_there() {
    for (lacks, figure) in poor() {
        let mut table = Table::new(figure.clone());
        table.submit(Request::Symmetry(true));
        table.submit(Request::Mechanics(Mechanics { collar_rhythm: true, torso_follow: 1.0 }));
        let mut asked: Vec<Command> = Vec::new();
        let pose = table.pose();
        for side in [Side::Left, Side::Right] {
            for finger in Finger::ALL.map(Some).into_iter().chain([None]) {
                asked.extend(set_curl(&figure, &pose, side, finger, 0.7, Locks::NONE));
            }
            asked.extend(set_spread(&figure, &pose, side, 0.4, Locks::NONE));
        }
        for dof in Dof::ALL {
            assert!(eyes(&figure, &pose, dof).is_none_or(f64::is_finite));
            asked.extend(set_eyes(&figure, &pose, dof, 9.0));
        }
        assert!(eye_point(table.editor.evaluation()).is_finite());
        assert!(gaze_point(table.editor.evaluation(), 1.0).is_finite());
        for limb in Limb::ALL {
            for at in [DVec3::new(0.3, 1.1, 0.4), DVec3::ZERO, DVec3::splat(9.0)] {
                asked.push(Command::Reach { limb, to: edit::Goal::World(at) });
            }
            asked.push(Command::Flip { limb });
        }
        asked.push(Command::LookAt { at: DVec3::ONE });
        asked.push(Command::Balance { amount: 1.0 });
        asked.push(Command::Mirror { parts: vec![Part::LeftArm, Part::Torso] });
        for bone in Bone::ALL {
            asked.extend(to_rest(&table.editor, bone));
            asked.extend(clear_place(&table.editor, bone));
        }
        for command in asked {
            // Some can't be done, and say so.
            table.submit(Request::Do(command));
            check(&table, lacks);
        }
        for bone in Bone::ALL {
            let locked = table.submit(Request::Lock(bone.into(), true));
            assert_eq!(locked, figure.skeleton.joint(bone).is_some());
        }
        let shown = marked_joints(&table.editor, &table.sight, &Bone::ALL);
        assert!(shown.iter().all(|bone| figure.skeleton.joint(*bone).is_some()));
        choose(&figure);
    }
}

fn choose(figure: &Figure) {
    for bone in Bone::ALL {
        let mut selection = Selection::default();
        for how in [
            Choose::Only(bone),
            Choose::NextOfLevel,
            Choose::Parent,
            Choose::Child,
            Choose::Next,
            Choose::Previous,
        ] {
            selection.choose(&figure.skeleton, how);
            assert!(selection.bones().iter().all(|bone| figure.skeleton.joint(*bone).is_some()));
        }
    }
}
