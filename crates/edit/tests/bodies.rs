//! The body's sliders while a figure is posed: one step a gesture, the pose fitted, undo to the very bits.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

use std::sync::{Arc, OnceLock};

use edit::{Clay, Command, Editor, Hold, NoFiles, Request};
use rig::{Body, BodySlider, Bone, Limb, Space};

fn clay() -> &'static Arc<Clay> {
    static CLAY: OnceLock<Arc<Clay>> = OnceLock::new();
    CLAY.get_or_init(|| {
        let text = "(version: 1, base: \"library:mannequin.figure.ron\")";
        let opened = interchange::figure::open(text, &mut |_| Err(String::new())).unwrap();
        Arc::new(Clay::new(opened.figure, opened.targets))
    })
}

/// A figure with bent knees and planted feet.
fn standing() -> Editor {
    let mut editor = Editor::new(Arc::new(interchange::figure::mannequin().unwrap()));
    for limb in [Limb::LeftLeg, Limb::RightLeg] {
        ask(&mut editor, Request::Do(Command::Keep { limb, contact: Hold::Planted, space: Space::World }));
    }
    ask(&mut editor, Request::Do(Command::MoveHips { by: glam::DVec3::new(0.02, -0.1, 0.03) }));
    editor
}

fn ask(editor: &mut Editor, request: Request) {
    editor.submit(request, &mut NoFiles).unwrap();
}

fn with(slider: BodySlider, value: f64) -> Body {
    Body::AS_IS.with(slider, value)
}

fn hips(editor: &Editor) -> f64 {
    editor.figure().skeleton.rest_position(Bone::Hips).y
}

#[test]
fn a_gesture_on_the_body_is_one_step_and_undo_brings_back_the_very_bits() {
    let mut editor = standing();
    editor.give_clay(clay().clone(), Body::AS_IS);
    let (document, figure, depth) = (editor.document().clone(), editor.figure().clone(), editor.undo_depth());
    for stature in [1.6, 1.3, 1.1] {
        ask(&mut editor, Request::PreviewBody(with(BodySlider::Stature, stature)));
    }
    ask(&mut editor, Request::Commit);
    assert_eq!((editor.undo_depth(), editor.undo_name()), (depth + 1, Some("Body")));
    assert!((hips(&editor) / figure.skeleton.rest_position(Bone::Hips).y - 1.1 / 1.72).abs() < 0.01);
    let made = editor.figure().clone();
    ask(&mut editor, Request::Undo);
    assert_eq!(editor.document(), &document);
    assert_eq!(**editor.figure(), *figure);
    ask(&mut editor, Request::Redo);
    assert_eq!(**editor.figure(), *made);
    assert_eq!(editor.document().body, with(BodySlider::Stature, 1.1));
}

#[test]
fn feet_stay_planted_at_every_size() {
    let mut editor = standing();
    editor.give_clay(clay().clone(), Body::AS_IS);
    let sole = |editor: &Editor| {
        editor.evaluation().frames[Bone::LeftFoot].position.y
            - editor.figure().skeleton.rest_position(Bone::LeftFoot).y
    };
    for body in [with(BodySlider::Stature, 1.1), with(BodySlider::Legs, 1.3), with(BodySlider::Heads, 5.0)] {
        ask(&mut editor, Request::Body(body));
        assert!(sole(&editor).abs() < 1e-3, "{body:?}: {}", sole(&editor));
        let residual = editor.evaluation().limbs[Limb::LeftLeg.index()].residual;
        assert!(residual < 1e-3, "{body:?}: {residual}");
    }
}

#[test]
fn a_cancelled_body_and_one_without_clay_change_nothing() {
    let mut editor = standing();
    let before = (editor.document().clone(), editor.figure().clone());
    assert!(editor.submit(Request::Body(with(BodySlider::Legs, 1.2)), &mut NoFiles).is_err());
    assert_eq!(editor.document(), &before.0);
    editor.give_clay(clay().clone(), Body::AS_IS);
    ask(&mut editor, Request::PreviewBody(with(BodySlider::Legs, 1.2)));
    assert_ne!(editor.document(), &before.0);
    ask(&mut editor, Request::Cancel);
    assert_eq!((editor.document(), &**editor.figure()), (&before.0, &*before.1));
    // Poses of the bodies before are not mixed with a turn that follows at once.
    ask(&mut editor, Request::PreviewBody(with(BodySlider::Legs, 1.2)));
    let turn =
        Command::Turn { joint: Bone::Head, dof: rig::Dof::Flexion, degrees: 10.0, by: edit::By::Delta };
    ask(&mut editor, Request::Do(turn));
    assert_eq!(editor.document().body, with(BodySlider::Legs, 1.2));
}
