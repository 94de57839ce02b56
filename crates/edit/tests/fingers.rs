//! Curl, spread and gaze: what is read off the pose is what was set, ends are exact, contacts hold.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::sync::{Arc, OnceLock};

use edit::{
    At, By, Command, Editor, Finger, Goal, Hold, NoFiles, Outcome, Request, clear_place, curl, eyes,
    gaze_point, set_curl, set_eyes, set_spread, spread, to_rest,
};
use glam::DVec3;
use rig::{Bone, Contact, Dof, Figure, Limb, Locks, Pose, Side, Space};

fn figure() -> Arc<Figure> {
    static FIGURE: OnceLock<Arc<Figure>> = OnceLock::new();
    let load = || Arc::new(interchange::figure::bare_mannequin().unwrap());
    FIGURE.get_or_init(load).clone()
}

fn ask(editor: &mut Editor, request: Request) -> Outcome {
    editor.submit(request, &mut NoFiles).unwrap()
}

fn editor() -> Editor {
    Editor::new(figure())
}

fn shape(editor: &mut Editor, side: Side, name: &str) {
    ask(editor, Request::Do(Command::Handshape { side, name: name.into(), amount: 1.0 }));
}

fn curled(editor: &Editor, side: Side, finger: Option<Finger>, to: f64) -> Vec<Command> {
    let first = editor.first();
    set_curl(editor.figure(), &first.pose, side, finger, to, first.locks)
}

fn read(editor: &Editor, side: Side, finger: Option<Finger>) -> f64 {
    curl(editor.figure(), editor.pose(), side, finger).unwrap()
}

fn fingers(pose: &Pose, side: Side) -> Vec<rig::Angles> {
    Finger::ALL.into_iter().flat_map(|finger| finger.bones(side)).map(|bone| pose.angles(bone)).collect()
}

#[test]
fn a_fist_is_curl_one_and_a_straight_hand_curl_nought() {
    for side in [Side::Left, Side::Right] {
        let mut editor = editor();
        assert_eq!(read(&editor, side, None), 0.0);
        let mut fist = editor.clone();
        shape(&mut fist, side, "fist");
        assert!((read(&fist, side, None) - 1.0).abs() < 1e-12);
        let commands = curled(&editor, side, None, 1.0);
        let told = ask(&mut editor, Request::PreviewAll(commands)).message;
        assert_eq!(told, "Turned 15 joints");
        ask(&mut editor, Request::Commit);
        // How far apart the fingers are is the spread's.
        let apart = fingers(fist.pose(), side).into_iter().enumerate().map(|(i, angles)| {
            let is_thumb = i < Finger::Thumb.bones(side).len();
            rig::Angles { abduction: if is_thumb { angles.abduction } else { 0.0 }, ..angles }
        });
        assert_eq!(fingers(editor.pose(), side), apart.collect::<Vec<_>>());
        let commands = curled(&editor, side, None, 0.0);
        ask(&mut editor, Request::PreviewAll(commands));
        assert_eq!(editor.pose().angles, editor.figure().rest_pose().angles);
    }
}

#[test]
fn what_is_set_is_what_is_read_and_setting_what_is_read_moves_nothing() {
    for name in ["relaxed", "point", "open5", "flat"] {
        for finger in [None].into_iter().chain(Finger::ALL.map(Some)) {
            let mut editor = editor();
            shape(&mut editor, Side::Left, name);
            let now = read(&editor, Side::Left, finger);
            let still = curled(&editor, Side::Left, finger, now);
            for command in still {
                let Command::Turn { joint, dof, degrees, .. } = command else { panic!("{command:?}") };
                assert!((editor.pose().angles(joint).get(dof) - degrees).abs() < 1e-9, "{name} {joint}");
            }
            for tenth in 0..=10 {
                let to = f64::from(tenth) / 10.0;
                let commands = curled(&editor, Side::Left, finger, to);
                ask(&mut editor, Request::PreviewAll(commands));
                let found = read(&editor, Side::Left, finger);
                assert!((found - to).abs() < 1e-9, "{name} {finger:?}: {found} for {to}");
            }
            // Only the fingers of that hand, and of them only the one.
            for bone in Bone::ALL {
                let of = finger.is_none_or(|finger| finger.bones(Side::Left).contains(&bone));
                let hand = bone.part() == rig::Part::LeftHand && of;
                assert!(hand || editor.pose().angles(bone) == editor.first().pose.angles(bone), "{bone}");
            }
        }
    }
}

#[test]
fn locked_fingers_stay_behind() {
    let editor = editor();
    let locks: Locks = Finger::Index.bones(Side::Left).into_iter().collect();
    let commands = set_curl(editor.figure(), editor.pose(), Side::Left, None, 1.0, locks);
    assert!(!commands.is_empty());
    for command in commands {
        let Command::Turn { joint, .. } = command else { panic!("{command:?}") };
        assert!(!locks.contains(joint));
    }
}

#[test]
fn spread_goes_from_side_by_side_to_wide() {
    let mut editor = editor();
    let of = |editor: &Editor| spread(editor.figure(), editor.pose(), Side::Right).unwrap();
    assert_eq!(of(&editor), 0.0);
    for to in [0.3, 1.0, 0.0] {
        let commands = set_spread(editor.figure(), &editor.first().pose, Side::Right, to, Locks::NONE);
        if commands.is_empty() {
            continue;
        }
        ask(&mut editor, Request::PreviewAll(commands));
        assert!((of(&editor) - to).abs() < 1e-12);
    }
    assert_eq!(editor.pose().angles(Bone::LeftIndexProximal).abduction, 0.0);
}

#[test]
fn a_fingertip_in_contact_stays_while_its_finger_curls() {
    let mut editor = editor();
    let limb = Limb::LeftArm;
    ask(&mut editor, Request::Do(Command::Articulate { limb, at: At::Named("indexTip".into()) }));
    let to = Goal::World(DVec3::new(0.2, 1.3, 0.35));
    ask(&mut editor, Request::Do(Command::Reach { limb, to }));
    ask(&mut editor, Request::Do(Command::Keep { limb, contact: Hold::Point, space: Space::World }));
    let before = editor.pose().angles(Bone::LeftLowerArm);
    for finger in [Some(Finger::Index), None] {
        let commands = curled(&editor, Side::Left, finger, 0.5);
        ask(&mut editor, Request::PreviewAll(commands));
        ask(&mut editor, Request::Commit);
        assert!(editor.evaluation().limbs[limb.index()].residual < 1e-9);
    }
    assert_ne!(editor.pose().angles(Bone::LeftLowerArm), before, "the arm follows");
}

#[test]
fn bad_numbers_curl_nothing() {
    let editor = editor();
    for to in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(curled(&editor, Side::Left, None, to).is_empty());
        assert!(set_spread(editor.figure(), editor.pose(), Side::Left, to, Locks::NONE).is_empty());
    }
}

#[test]
fn both_eyes_turn_as_one_and_keep_their_squint() {
    let mut editor = editor();
    let turn = Command::Turn { joint: Bone::LeftEye, dof: Dof::Twist, degrees: 6.0, by: By::To };
    ask(&mut editor, Request::Do(turn));
    assert_eq!(eyes(editor.figure(), editor.pose(), Dof::Twist), Some(3.0));
    let commands = set_eyes(editor.figure(), editor.pose(), Dof::Twist, 13.0);
    ask(&mut editor, Request::PreviewAll(commands));
    let angles = |bone| editor.pose().angles(bone).twist;
    assert_eq!((angles(Bone::LeftEye), angles(Bone::RightEye)), (16.0, -10.0));
    assert_eq!(eyes(editor.figure(), editor.pose(), Dof::Twist), Some(13.0));
    // To the figure's left is +x.
    let seen = gaze_point(editor.evaluation(), 2.0);
    let straight = gaze_point(self::editor().evaluation(), 2.0);
    assert!(seen.x > straight.x + 0.3 && (seen.y - straight.y).abs() < 1e-9);
    assert_eq!(eyes(editor.figure(), editor.pose(), Dof::Abduction), None);
}

#[test]
fn looking_where_the_gaze_is_moves_nothing() {
    let mut editor = editor();
    ask(&mut editor, Request::Do(Command::LookAt { at: DVec3::new(0.4, 1.3, 1.5) }));
    let before = editor.pose().clone();
    let at = gaze_point(editor.evaluation(), 3.0);
    ask(&mut editor, Request::Do(Command::LookAt { at }));
    for bone in [Bone::Neck, Bone::Head] {
        for dof in Dof::ALL {
            let by = (editor.pose().angles(bone).get(dof) - before.angles(bone).get(dof)).abs();
            assert!(by < 1.0, "{bone} {by}");
        }
    }
}

#[test]
fn clearing_brings_back_angles_hips_and_freedom() {
    let mut editor = editor();
    ask(&mut editor, Request::Do(Command::Place { by: DVec3::new(0.3, 0.0, 0.2), turn: 50.0 }));
    ask(&mut editor, Request::Do(Command::MoveHips { by: DVec3::new(0.1, -0.2, 0.05) }));
    for command in clear_place(&editor, Bone::Hips) {
        ask(&mut editor, Request::Do(command));
    }
    assert!(editor.pose().hips.distance(editor.figure().rest_pose().hips) < 1e-12);
    assert_eq!(editor.pose().place.turn, 50.0);
    assert!(clear_place(&editor, Bone::Hips).is_empty() && clear_place(&editor, Bone::Head).is_empty());
    let limb = Limb::RightArm;
    ask(&mut editor, Request::Do(Command::Keep { limb, contact: Hold::Point, space: Space::World }));
    for command in clear_place(&editor, Bone::RightHand) {
        ask(&mut editor, Request::Do(command));
    }
    assert_eq!(editor.pose().limb(limb).contact, Contact::Free);
    assert_eq!(to_rest(&editor, Bone::LeftUpperArm).len(), 3);
    ask(&mut editor, Request::Lock(Bone::LeftUpperArm.into(), true));
    assert!(to_rest(&editor, Bone::LeftUpperArm).is_empty());
}
