//! Contacts from the keyboard, why one is missed, and the buttons of the guides.

use app::Guide;
use edit::{At, Command, Goal, Request};
use egui::Key;
use egui_kittest::kittest::Queryable as _;
use glam::DVec3;
use rig::{Bone, Contact, Limb, Space};

use crate::hand::{Hand, LEFT_ARM, at, click, pose};

fn contact(hand: &Hand, limb: Limb) -> Contact {
    pose(hand).limb(limb).contact
}

fn ask(hand: &mut Hand, command: Command) {
    hand.state_mut().submit(Request::Do(command));
    hand.run();
}

fn press_p(hand: &mut Hand) {
    hand.key_press(Key::P);
    hand.run();
}

#[test]
fn p_goes_from_free_to_point_to_planted_and_back() {
    let mut hand = at(LEFT_ARM);
    hand.state_mut().panels.select(Some(Bone::LeftLowerArm));
    assert_eq!(contact(&hand, Limb::LeftArm), Contact::Free);
    press_p(&mut hand);
    assert!(matches!(contact(&hand, Limb::LeftArm), Contact::Point { space: Space::World, .. }));
    press_p(&mut hand);
    assert!(matches!(contact(&hand, Limb::LeftArm), Contact::Planted { space: Space::World, .. }));
    press_p(&mut hand);
    assert_eq!(contact(&hand, Limb::LeftArm), Contact::Free);
}

#[test]
fn p_with_a_fingertip_on_the_face_holds_on_to_the_head() {
    let mut hand = at(LEFT_ARM);
    ask(&mut hand, Command::Articulate { limb: Limb::LeftArm, at: At::Named("indexTip".to_owned()) });
    let bend = |joint, dof, degrees| Command::Turn { joint, dof, degrees, by: edit::By::To };
    ask(&mut hand, bend(Bone::LeftUpperArm, rig::Dof::Flexion, 40.0));
    ask(&mut hand, bend(Bone::LeftLowerArm, rig::Dof::Flexion, 90.0));
    // The tip of the nose, a few millimetres before the skin.
    let ahead = DVec3::new(0.0, 0.06, 0.0);
    let head = hand.state().editor().evaluation().frames[Bone::Head];
    let skin = hand.state().editor().figure().skin.clone().unwrap();
    let nose = skin.positions.iter().filter(|p| (f64::from(p[1]) - head.point(ahead).y).abs() < 0.02);
    let nose = nose.filter(|p| p[0].abs() < 0.01).map(|p| f64::from(p[2])).fold(0.0, f64::max);
    let to = DVec3::new(0.0, head.point(ahead).y, nose + 0.003);
    ask(&mut hand, Command::Reach { limb: Limb::LeftArm, to: Goal::World(to) });
    hand.state_mut().panels.select(Some(Bone::LeftHand));
    press_p(&mut hand);
    let space = contact(&hand, Limb::LeftArm).target().map(|(space, _)| space);
    assert!(matches!(space, Some(Space::Body(Bone::Head | Bone::Jaw))), "{space:?}");
    // The button does the same as the key.
    ask(&mut hand, Command::Keep { limb: Limb::LeftArm, contact: edit::Hold::Free, space: Space::World });
    click(&mut hand, "Left arm contact · Planted");
    assert_eq!(contact(&hand, Limb::LeftArm).target().map(|(space, _)| space), space);
    // A foot that stands holds on to the ground.
    hand.state_mut().panels.select(Some(Bone::RightFoot));
    press_p(&mut hand);
    assert!(matches!(contact(&hand, Limb::RightLeg), Contact::Point { space: Space::World, .. }));
}

#[test]
fn a_missed_contact_says_why() {
    let mut hand = at(LEFT_ARM);
    click(&mut hand, "Left arm contact · Point");
    for (to, why) in [
        (DVec3::new(1.2, 1.4, 0.0), "out of reach"),
        (DVec3::new(-0.1, 1.3, -0.3), "the shoulder's range stops it"),
    ] {
        ask(&mut hand, Command::Reach { limb: Limb::LeftArm, to: Goal::World(to) });
        let written = hand.query_all_by(|node| {
            let words = node.label().or(node.value()).unwrap_or_default();
            words.contains("mm short") && words.contains(why)
        });
        assert!(written.count() >= 1, "{why}");
    }
}

#[test]
fn every_guide_has_a_button_with_a_name() {
    let mut hand = at(LEFT_ARM);
    for guide in Guide::ALL {
        let name = format!("Left arm guide: {}", guide.name());
        let has = |hand: &Hand| hand.state().panels.guides().has(Limb::LeftArm, guide);
        assert!(!has(&hand));
        click(&mut hand, &name);
        assert!(has(&hand), "{name}");
    }
    assert_eq!(hand.state().viewport.guides, hand.state().panels.guides());
    assert_eq!(pose(&hand), pose(&at(LEFT_ARM)), "a guide changes no pose");
    click(&mut hand, "Left arm guide: grids");
    assert!(!hand.state().panels.guides().has(Limb::LeftArm, Guide::Planes));
}
