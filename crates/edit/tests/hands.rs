//! The pointer on the figure: (state, events, state) for every kind of gesture.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod stage;

use edit::{At, Axis, Command, Constraint, Event, Hold, Knob, Mark, Modifiers, Request};
use glam::{DVec3, Vec2, vec2};
use rig::{Bone, Contact, Dof, Limb, Pose, Reacher, Space, View};
use stage::{Table, figure, words};

fn table() -> Table {
    Table::new(figure())
}

/// Bones whose angles differ between two poses.
fn turned(before: &Pose, after: &Pose) -> Vec<Bone> {
    Bone::ALL.into_iter().filter(|bone| before.angles(*bone) != after.angles(*bone)).collect()
}

fn keep(table: &mut Table, limb: Limb, contact: Hold) {
    assert!(table.submit(Request::Do(Command::Keep { limb, contact, space: Space::World })));
}

fn articulator(table: &Table, limb: Limb) -> DVec3 {
    table.editor.evaluation().limbs[limb.index()].articulator
}

#[test]
fn a_click_chooses_and_moves_nothing() {
    let mut table = table();
    let before = table.pose();
    let at = table.skin_of(Bone::LeftUpperArm);
    let reaction = table.click(at);
    assert_eq!(reaction.chosen, Some(Some(Bone::LeftUpperArm)));
    assert!(reaction.requests.is_empty());
    let knee = table.pixel(table.editor.evaluation().frames[Bone::RightLowerLeg].position);
    assert_eq!(table.click(knee).chosen, Some(Some(Bone::RightLowerLeg)), "a joint's disc");
    assert_eq!(table.click(vec2(3.0, 3.0)).chosen, Some(None), "beside the figure");
    assert_eq!((table.pose(), table.editor.undo_depth()), (before, 0));
}

#[test]
fn handles_are_found_before_targets_and_these_before_joints_and_skin() {
    let mut table = table();
    let target = table.pixel(table.editor.evaluation().limbs[Limb::LeftArm.index()].target);
    table.tell(Event::Moved(target));
    assert_eq!(table.hands.under().mark, Some(Mark::Target(Limb::LeftArm)));
    assert_eq!(table.hands.hovered(), None);
    table.selected = Some(Bone::LeftUpperArm);
    let ring = table.knob(Knob::Turn(Bone::LeftUpperArm, Dof::Twist));
    table.tell(Event::Moved(ring));
    assert_eq!(table.hands.knob(), Some(Knob::Turn(Bone::LeftUpperArm, Dof::Twist)));
    table.marks = false;
    table.tell(Event::Moved(target));
    assert_eq!(table.hands.under().mark, None);
    assert!(table.hands.hovered().is_some(), "without marks there is only skin");
}

#[test]
fn a_click_on_a_ring_means_the_skin_seen_through_it() {
    let mut table = table();
    table.selected = Some(Bone::LeftFoot);
    table.sight.camera = table.sight.camera.seen_from(View::Left);
    let knobs = table.hands.knobs(&table.stage());
    let mut through = 0;
    for placed in knobs.iter().filter(|placed| matches!(placed.knob, Knob::Turn(Bone::LeftFoot, _))) {
        let edit::Shape::Ring(circle) = placed.shape else { panic!("{placed:?}") };
        for i in 0..90 {
            let at = table.stage().sight.pixel_of(circle.point(f64::from(i) * 0.07)).unwrap();
            table.tell(Event::Moved(at));
            if !matches!(table.hands.knob(), Some(Knob::Turn(..))) {
                continue;
            }
            let ray = table.sight.ray(at);
            let seen = table.hands.skin(&table.editor).hit(&table.editor, ray).map(|hit| hit.bone);
            assert_eq!(table.click(at).chosen, seen.map(Some), "a ring alone leaves the choice as it was");
            table.selected = Some(Bone::LeftFoot);
            through += usize::from(seen == Some(Bone::RightFoot));
        }
    }
    assert!(through > 0, "the other foot is seen through a ring");
}

#[test]
fn a_target_s_middle_comes_before_a_ring_that_passes_over_it() {
    let mut table = table();
    keep(&mut table, Limb::LeftLeg, Hold::Planted);
    table.selected = Some(Bone::LeftFoot);
    table.sight.camera = table.sight.camera.seen_from(View::Front);
    let target = table.pixel(table.editor.evaluation().limbs[Limb::LeftLeg.index()].target);
    table.tell(Event::Moved(target));
    assert_eq!(table.hands.under().mark, Some(Mark::Target(Limb::LeftLeg)));
}

#[test]
fn rings_turn_their_joint_and_nothing_else() {
    for (bone, dof) in [
        (Bone::LeftUpperArm, Dof::Flexion),
        (Bone::LeftUpperArm, Dof::Abduction),
        (Bone::LeftUpperArm, Dof::Twist),
        (Bone::LeftLowerArm, Dof::Flexion),
        (Bone::RightHand, Dof::Abduction),
        (Bone::RightUpperLeg, Dof::Flexion),
        (Bone::LeftFoot, Dof::Flexion),
        (Bone::Chest, Dof::Twist),
        (Bone::Hips, Dof::Twist),
        (Bone::Head, Dof::Flexion),
    ] {
        let mut table = table();
        table.selected = Some(bone);
        let before = table.pose();
        let at = table.knob(Knob::Turn(bone, dof));
        table.drag(at, vec2(17.0, -23.0));
        assert_eq!(turned(&before, &table.pose()), [bone], "{bone} {dof:?}");
        assert_eq!(table.editor.undo_depth(), 1);
        assert_eq!(table.selected, Some(bone), "a ring is no click");
        table.submit(Request::Undo);
        assert_eq!(table.pose(), before);
    }
}

#[test]
fn a_number_typed_on_a_ring_is_degrees_and_enter_keeps_it() {
    let mut table = table();
    table.selected = Some(Bone::LeftLowerArm);
    let at = table.knob(Knob::Turn(Bone::LeftLowerArm, Dof::Flexion));
    table.hold(at, vec2(20.0, 10.0));
    for letter in "12.5-".chars() {
        table.tell(Event::Typed(letter));
    }
    let flexion = |table: &Table| table.pose().angles(Bone::LeftLowerArm).flexion;
    assert!((flexion(&table) - 67.5).abs() < 1e-9, "{}", flexion(&table));
    let telling = table.hands.telling(&words()).unwrap();
    assert!(telling.contains("by -12.5°"), "{telling}");
    for _ in 0..3 {
        table.tell(Event::Backspace);
    }
    assert!((flexion(&table) - 79.0).abs() < 1e-9, "-1 is left: {}", flexion(&table));
    table.tell(Event::Commit);
    table.tell(Event::Moved(at));
    table.tell(Event::Released);
    assert!((flexion(&table) - 79.0).abs() < 1e-9);
    assert_eq!(table.editor.undo_depth(), 1);
}

#[test]
fn control_turns_by_five_degrees_and_shift_by_a_tenth() {
    let mut table = table();
    table.selected = Some(Bone::LeftLowerArm);
    let at = table.knob(Knob::Turn(Bone::LeftLowerArm, Dof::Flexion));
    table.modified(Modifiers { snap: true, ..Modifiers::default() });
    table.drag(at, vec2(31.0, 26.0));
    let snapped = table.pose().angles(Bone::LeftLowerArm).flexion - 80.0;
    assert!(snapped != 0.0 && (snapped / 5.0 - (snapped / 5.0).round()).abs() < 1e-9, "{snapped}");
    table.submit(Request::Undo);
    table.modified(Modifiers::default());
    table.drag(at, vec2(10.0, 8.0));
    let whole = table.pose().angles(Bone::LeftLowerArm).flexion - 80.0;
    table.submit(Request::Undo);
    table.modified(Modifiers { slow: true, ..Modifiers::default() });
    table.drag(at, vec2(10.0, 8.0));
    let slow = table.pose().angles(Bone::LeftLowerArm).flexion - 80.0;
    assert!((slow / whole - 0.1).abs() < 1e-6, "{slow} of {whole}");
}

#[test]
fn with_the_key_held_the_rings_turn_about_the_contact() {
    for (bone, limb, dof) in [
        (Bone::LeftHand, Limb::LeftArm, Dof::Flexion),
        (Bone::LeftLowerArm, Limb::LeftArm, Dof::Twist),
        (Bone::RightFoot, Limb::RightLeg, Dof::Flexion),
    ] {
        let mut table = table();
        if !limb.is_arm() {
            let at = At::Named("ball".to_owned());
            assert!(table.submit(Request::Do(Command::Articulate { limb, at })));
        }
        keep(&mut table, limb, Hold::Point);
        table.selected = Some(bone);
        table.modified(Modifiers { in_contact: true, ..Modifiers::default() });
        let (before, place) = (table.pose(), articulator(&table, limb));
        let at = table.knob(Knob::InContact(limb, dof));
        table.drag(at, vec2(12.0, -14.0));
        assert!(articulator(&table, limb).distance(place) < 1e-6, "{bone}: the articulator stays");
        let parts = limb.parts();
        let after = turned(&before, &table.pose());
        assert!(after.contains(&parts.root), "{bone}: the limb follows: {after:?}");
        assert!(after.iter().all(|b| [parts.root, parts.hinge, parts.end].contains(b)), "{after:?}");
        assert_eq!(table.editor.undo_name(), Some("Turn in contact"));
    }
    let mut table = table();
    table.selected = Some(Bone::LeftUpperArm);
    table.modified(Modifiers { in_contact: true, ..Modifiers::default() });
    let knobs = table.hands.knobs(&table.stage());
    assert!(
        knobs.iter().any(|p| matches!(p.knob, Knob::Turn(Bone::LeftUpperArm, _))),
        "not for the shoulder"
    );
}

#[test]
fn the_disc_inside_the_rings_turns_every_way() {
    let mut table = table();
    table.selected = Some(Bone::Head);
    let before = table.pose();
    let at = table.knob(Knob::Trackball(Bone::Head));
    table.hold(at, vec2(25.0, 20.0));
    let free = table.pose().angles(Bone::Head);
    assert!(free.flexion.abs() > 1.0 && free.twist.abs() > 1.0, "{free:?}");
    table.tell(Event::Constrain(Constraint::Along(Axis::Y)));
    let about = table.pose().angles(Bone::Head);
    assert!(about.flexion.abs() < 1e-6 && about.abduction.abs() < 1e-6 && about.twist > 1.0, "{about:?}");
    table.tell(Event::Cancel);
    table.tell(Event::Released);
    assert_eq!(table.pose(), before);
    table.selected = Some(Bone::LeftHand);
    let knobs = table.hands.knobs(&table.stage());
    assert!(knobs.iter().all(|p| !matches!(p.knob, Knob::Trackball(_))), "a wrist is no ball");
}

#[test]
fn the_arc_at_the_elbow_elevates_and_the_palm_stays() {
    for bone in [Bone::LeftLowerArm, Bone::LeftIndexDistal, Bone::LeftUpperArm] {
        let mut table = table();
        keep(&mut table, Limb::LeftArm, Hold::Point);
        table.selected = Some(bone);
        let place = articulator(&table, Limb::LeftArm);
        let elevation = |table: &Table| table.editor.evaluation().limbs[0].elevation.unwrap();
        let before = elevation(&table);
        let at = table.knob(Knob::Elevation(Limb::LeftArm));
        let elbow = table.editor.evaluation().frames[Bone::LeftLowerArm].position;
        table.hold(at, vec2(8.0, -22.0));
        let risen = table.editor.evaluation().frames[Bone::LeftLowerArm].position.y - elbow.y;
        assert!(risen > 0.01, "the elbow goes up with the pointer: {risen}");
        assert!(articulator(&table, Limb::LeftArm).distance(place) < 1e-9);
        table.tell(Event::Typed('5'));
        assert!((elevation(&table) - before - 5.0).abs() < 1e-6, "+ is outward");
        table.tell(Event::Released);
        assert_eq!(table.editor.undo_name(), Some("Elevate"));
    }
}

#[test]
fn handles_move_collar_spine_hips_and_the_whole_figure() {
    for (knob, name, bones) in [
        (Knob::Collar(Bone::LeftShoulder), "Turn", &[Bone::LeftShoulder][..]),
        (Knob::Spine, "Aim spine", &[Bone::Spine, Bone::Chest, Bone::UpperChest]),
        (Knob::Hips, "Move hips", &[]),
        (Knob::Place, "Place", &[]),
        (Knob::TurnFigure, "Place", &[]),
    ] {
        let mut table = table();
        table.sight.camera.pitch_rad = 0.4;
        let before = table.pose();
        let at = table.knob(knob);
        table.drag(at, vec2(14.0, -9.0));
        let after = table.pose();
        assert_eq!(turned(&before, &after), bones, "{}", knob.name());
        assert_eq!(table.editor.undo_name(), Some(name));
        assert_eq!(after.hips != before.hips, knob == Knob::Hips);
        assert_eq!(after.place != before.place, name == "Place");
        assert_eq!(after.place.position.y, 0.0, "over the ground");
        table.submit(Request::Undo);
        assert_eq!(table.pose(), before);
    }
}

#[test]
fn the_ring_on_the_ground_turns_the_figure_where_it_stands() {
    let mut table = table();
    table.submit(Request::Do(Command::MoveHips { by: DVec3::new(0.2, 0.0, 0.1) }));
    table.sight.camera.pitch_rad = 0.5;
    let hips = table.editor.evaluation().frames[Bone::Hips].position;
    let at = table.knob(Knob::TurnFigure);
    table.hold(at, vec2(20.0, 10.0));
    table.tell(Event::Typed('9'));
    table.tell(Event::Typed('0'));
    table.tell(Event::Released);
    assert_eq!(table.pose().place.turn, 90.0);
    assert!(table.editor.evaluation().frames[Bone::Hips].position.distance(hips) < 1e-12);
}

#[test]
fn the_ring_of_a_locked_joint_has_no_way_to_go() {
    let mut table = table();
    table.submit(Request::Lock(Bone::LeftLowerArm.into(), true));
    table.selected = Some(Bone::LeftLowerArm);
    let before = table.pose();
    let ring = table.knob(Knob::Turn(Bone::LeftLowerArm, Dof::Flexion));
    table.hold(ring, vec2(30.0, 20.0));
    assert_eq!(table.hands.turned().unwrap().range_rad, Some([0.0; 2]));
    assert_eq!(table.pose(), before);
    table.tell(Event::Released);
    assert_eq!(table.pose(), before);
}

#[test]
fn a_number_may_be_typed_before_the_pointer_has_moved() {
    let mut table = table();
    table.selected = Some(Bone::LeftLowerArm);
    let before = table.pose().angles(Bone::LeftLowerArm).flexion;
    let ring = table.knob(Knob::Turn(Bone::LeftLowerArm, Dof::Flexion));
    table.tell(Event::Pressed(ring));
    for letter in ['x', '1', '0'] {
        table.tell(Event::Typed(letter));
        assert_eq!(table.hands.is_dragging(), letter != 'x', "{letter}");
    }
    assert!((table.pose().angles(Bone::LeftLowerArm).flexion - before - 10.0).abs() < 1e-9);
    table.tell(Event::Cancel);
    table.tell(Event::Released);
    let at = table.skin_of(Bone::LeftHand);
    table.tell(Event::Pressed(at));
    table.tell(Event::Typed('4'));
    let Reacher::Point(bone, point) = table.pose().limb(Limb::LeftArm).reacher else { panic!("not grabbed") };
    let place = |table: &Table| table.editor.evaluation().frames[bone].point(point);
    let first = place(&table);
    table.tell(Event::Moved(at + vec2(0.0, -12.0)));
    assert!(((place(&table) - first).length() - 0.04).abs() < 1e-9, "as soon as there is a way to go");
}

#[test]
fn a_typed_distance_goes_along_the_axis_or_the_way_that_was_begun() {
    let mut table = table();
    let at = table.skin_of(Bone::LeftHand);
    table.hold(at, vec2(0.0, -12.0));
    let Reacher::Point(bone, point) = table.pose().limb(Limb::LeftArm).reacher else { panic!("not grabbed") };
    let place = |table: &Table| table.editor.evaluation().frames[bone].point(point);
    table.tell(Event::Cancel);
    table.tell(Event::Released);
    let first = place(&table);
    table.hold(at, vec2(0.0, -12.0));
    table.tell(Event::Typed('3'));
    let moved = place(&table) - first;
    assert!((moved.length() - 0.03).abs() < 1e-9, "3 cm: {moved}");
    assert!(moved.y > 0.028, "the way that was begun: {moved}");
    table.tell(Event::Constrain(Constraint::Along(Axis::X)));
    let moved = place(&table) - first;
    assert!((moved - DVec3::X * 0.03).length() < 1e-9, "{moved}");
    table.tell(Event::Typed('-'));
    assert!((place(&table) - first + DVec3::X * 0.03).length() < 1e-9);
    let telling = table.hands.telling(&words()).unwrap();
    assert!(telling.starts_with("Left arm reaches -3 cm along X"), "{telling}");
    table.tell(Event::Moved(at + vec2(40.0, 40.0)));
    assert!((place(&table) - first + DVec3::X * 0.03).length() < 1e-9, "the number rules");
}

#[test]
fn a_drag_names_the_keys_that_the_user_has() {
    let mut table = table();
    let at = table.skin_of(Bone::LeftHand);
    table.hold(at, vec2(0.0, -12.0));
    assert!(table.hands.telling(&words()).unwrap().contains("X Y Z: along an axis, with Shift across it"));
    let only_up = |constraint| match constraint {
        Constraint::Along(Axis::Y) => "U".to_owned(),
        _ => String::new(),
    };
    let own = edit::Words { key: &only_up, in_contact: "", ..words() };
    assert!(table.hands.telling(&own).unwrap().contains(" · U: along an axis · "));
    table.tell(Event::Constrain(Constraint::Along(Axis::Y)));
    assert!(table.hands.telling(&own).unwrap().contains(" · U again: freely · "));
    table.tell(Event::Constrain(Constraint::Along(Axis::X)));
    assert!(!table.hands.telling(&own).unwrap().contains("freely"), "no key, no hint");
    table.tell(Event::Cancel);
    table.tell(Event::Released);
    table.selected = Some(Bone::LeftLowerArm);
    let ring = table.knob(Knob::Turn(Bone::LeftLowerArm, Dof::Flexion));
    table.tell(Event::Moved(ring));
    let offered = |words: edit::Words| table.hands.offering(&table.stage(), &words).unwrap();
    assert!(offered(words()).contains("C: about the contact"));
    assert!(!offered(own).contains("about the contact"));
}

#[test]
fn a_target_comes_to_lie_on_the_body_and_holds_on_to_it() {
    let mut table = table();
    table.sight.camera = table.sight.camera.seen_from(View::Front);
    let from = table.pixel(table.editor.evaluation().limbs[Limb::LeftArm.index()].target);
    let chest = table.pixel(table.editor.evaluation().frames[Bone::Chest].position) + vec2(10.0, 6.0);
    table.hold(from, chest - from);
    let snap = *table.hands.snap().expect("the chest is within reach");
    let Space::Body(bone) = snap.space else { panic!("{snap:?}") };
    assert!(Limb::of(bone).is_none(), "{bone}");
    table.tell(Event::Released);
    let contact = table.pose().limb(Limb::LeftArm).contact;
    assert!(matches!(contact, Contact::Point { space: Space::Body(b), .. } if b == bone), "{contact:?}");
    assert_eq!(table.editor.undo_depth(), 1);
    table.submit(Request::Undo);
    table.modified(Modifiers { snap: true, ..Modifiers::default() });
    table.drag(from, chest - from);
    assert_eq!(table.pose().limb(Limb::LeftArm).contact, Contact::Free, "Ctrl suspends it");
}

#[test]
fn cancelling_any_gesture_brings_back_the_very_bits() {
    let knobs = |bone: Bone, dof: Dof| Some((bone, Knob::Turn(bone, dof)));
    for case in [
        None,
        knobs(Bone::LeftUpperArm, Dof::Abduction),
        Some((Bone::LeftUpperArm, Knob::Trackball(Bone::LeftUpperArm))),
        Some((Bone::LeftHand, Knob::Elevation(Limb::LeftArm))),
        Some((Bone::Hips, Knob::Hips)),
        Some((Bone::Hips, Knob::Place)),
        Some((Bone::Hips, Knob::TurnFigure)),
    ] {
        let mut table = table();
        table.sight.camera.pitch_rad = 0.4;
        keep(&mut table, Limb::LeftLeg, Hold::Planted);
        let (before, depth) = (table.pose(), table.editor.undo_depth());
        let at = match case {
            Some((bone, knob)) => {
                table.selected = Some(bone);
                table.knob(knob)
            }
            None => table.skin_of(Bone::RightHand),
        };
        table.hold(at, vec2(25.0, -30.0));
        assert_ne!(table.pose(), before, "{case:?}");
        table.tell(Event::Cancel);
        assert_eq!(table.pose(), before, "{case:?}");
        assert!(table.hands.holds() && !table.hands.is_dragging(), "the button is still down");
        table.tell(Event::Moved(at + Vec2::splat(40.0)));
        table.tell(Event::Released);
        assert_eq!((table.pose(), table.editor.undo_depth()), (before, depth));
        assert!(!table.hands.holds());
    }
}

#[test]
fn a_drag_ends_with_its_gesture() {
    let mut table = table();
    let at = table.skin_of(Bone::RightHand);
    let before = table.pose();
    table.hold(at, vec2(20.0, 0.0));
    table.submit(Request::Undo);
    table.tell(Event::Moved(at + vec2(30.0, 0.0)));
    table.tell(Event::Moved(at + vec2(35.0, 0.0)));
    table.tell(Event::Released);
    assert_eq!((table.pose(), table.editor.undo_depth()), (before, 0));
}

#[test]
fn the_camera_may_move_and_the_drag_keeps_its_sight() {
    let (mut still, mut moving) = (table(), table());
    let at = still.skin_of(Bone::LeftHand);
    moving.skin_of(Bone::LeftHand);
    for table in [&mut still, &mut moving] {
        table.hold(at, vec2(20.0, 5.0));
    }
    moving.sight.camera.orbit(0.7, 0.2);
    for table in [&mut still, &mut moving] {
        table.tell(Event::Moved(at + vec2(-20.0, 30.0)));
        table.tell(Event::Released);
    }
    assert_eq!(still.pose(), moving.pose());
}

#[test]
fn the_way_of_the_pointer_does_not_matter() {
    let knobs = [Knob::Turn(Bone::LeftUpperArm, Dof::Flexion), Knob::Trackball(Bone::LeftUpperArm)];
    for knob in knobs.map(Some).into_iter().chain([None]) {
        let (mut one, mut many) = (table(), table());
        for table in [&mut one, &mut many] {
            table.selected = Some(Bone::LeftUpperArm);
        }
        let at = match knob {
            Some(knob) => one.knob(knob),
            None => one.skin_of(Bone::LeftHand),
        };
        one.tell(Event::Pressed(at));
        one.tell(Event::Moved(at + vec2(12.0, -15.0)));
        many.hold(at, vec2(-9.0, 14.0));
        many.tell(Event::Moved(at + vec2(12.0, -15.0)));
        assert_eq!(one.pose(), many.pose(), "{knob:?}");
    }
}
