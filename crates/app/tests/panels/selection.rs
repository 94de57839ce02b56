//! Choosing joints on the body map, in the tree, by rows and by keys.

use app::Section;
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use rig::{Bone, Bone::*, Part};

use crate::hand::{Hand, LEFT_ARM, at, click, drag, steps};

fn chosen(hand: &Hand) -> Vec<Bone> {
    hand.state().panels.selection().bones().to_vec()
}

fn with_tree() -> Hand {
    let mut hand = at(LEFT_ARM);
    click(&mut hand, "Part tree shown");
    hand
}

fn press(hand: &mut Hand, key: Key) {
    hand.key_press(key);
    hand.run();
}

/// Clicks with the left button while a key is held.
fn click_with(hand: &mut Hand, label: &str, modifiers: Modifiers) {
    let at = hand.get_by_label(label).rect().center();
    hand.hover_at(at);
    hand.step();
    for pressed in [true, false] {
        let button = egui::PointerButton::Primary;
        hand.event_modifiers(egui::Event::PointerButton { pos: at, button, pressed, modifiers }, modifiers);
    }
    hand.run();
}

#[test]
fn a_click_on_the_map_chooses_and_opens_the_section() {
    let mut hand = at(LEFT_ARM);
    assert!(hand.query_by_label("Left handshape · fist").is_none());
    click(&mut hand, "Left wrist on the map");
    assert_eq!(chosen(&hand), [LeftHand]);
    click(&mut hand, "Left index tip on the map");
    assert_eq!(chosen(&hand), [LeftIndexDistal]);
    hand.get_by_label("Left handshape · fist");
    assert_eq!(steps(&hand), 0, "choosing is no step");
}

#[test]
fn every_joint_is_on_the_map_by_name_and_its_middle_chooses_it() {
    let mut hand = at(Section::Figure);
    let figure = hand.state().editor().figure().clone();
    for joint in figure.skeleton.joints() {
        let name = format!("{} on the map", app::labels::full(joint.bone));
        click(&mut hand, &name);
        assert_eq!(chosen(&hand), [joint.bone], "{name}");
        // Two clicks at once would choose the part.
        hand.run_steps(8);
    }
}

#[test]
fn assistive_technology_chooses_on_the_map_and_reads_what_is_chosen() {
    let mut hand = at(LEFT_ARM);
    hand.get_by_label("Right knee on the map").click_accesskit();
    hand.run();
    assert_eq!(chosen(&hand), [RightLowerLeg]);
    let knee = hand.get_by_label("Right knee on the map");
    assert_eq!(knee.accesskit_node().toggled(), Some(egui::accesskit::Toggled::True));
    let left = hand.get_by_label("Left knee on the map");
    assert_eq!(left.accesskit_node().toggled(), Some(egui::accesskit::Toggled::False));
}

#[test]
fn control_and_shift_add_and_let_go() {
    let mut hand = at(LEFT_ARM);
    click(&mut hand, "Head on the map");
    click_with(&mut hand, "Left elbow on the map", Modifiers::COMMAND);
    assert_eq!(chosen(&hand), [Head, LeftLowerArm]);
    click_with(&mut hand, "Right knee on the map", Modifiers::SHIFT);
    assert_eq!(chosen(&hand), [Head, LeftLowerArm, RightLowerLeg]);
    assert_eq!(hand.state().panels.selection().parts(), [Part::Head, Part::LeftArm, Part::RightLeg]);
    click_with(&mut hand, "Left elbow on the map", Modifiers::COMMAND);
    assert_eq!(chosen(&hand), [Head, RightLowerLeg]);
}

#[test]
fn rows_of_sliders_choose_as_well() {
    let mut hand = at(LEFT_ARM);
    click(&mut hand, "Choose left shoulder");
    click_with(&mut hand, "Choose left elbow", Modifiers::COMMAND);
    assert_eq!(chosen(&hand), [LeftUpperArm, LeftLowerArm]);
    click(&mut hand, "Choose left collar");
    assert_eq!(chosen(&hand), [LeftShoulder]);
    click(&mut hand, "Choose left collar");
    assert_eq!(chosen(&hand), [], "once more lets go");
}

#[test]
fn a_double_click_on_the_map_chooses_the_part() {
    let mut hand = at(LEFT_ARM);
    let knee = hand.get_by_label("Left knee on the map");
    knee.click();
    knee.click();
    hand.run();
    assert_eq!(chosen(&hand), [LeftUpperLeg, LeftLowerLeg, LeftFoot, LeftToes]);
}

#[test]
fn a_click_beside_the_figure_chooses_nothing() {
    let mut hand = at(LEFT_ARM);
    click(&mut hand, "Head on the map");
    let corner = hand.get_by_label("Body map").rect().left_top() + egui::vec2(6.0, 6.0);
    hand.hover_at(corner);
    hand.drag_at(corner);
    hand.drop_at(corner);
    hand.run();
    assert_eq!(chosen(&hand), []);
}

#[test]
fn arrows_walk_the_focused_map() {
    let mut hand = at(LEFT_ARM);
    click(&mut hand, "Left index mid on the map");
    press(&mut hand, Key::ArrowRight);
    assert_eq!(chosen(&hand), [LeftMiddleIntermediate]);
    press(&mut hand, Key::ArrowUp);
    press(&mut hand, Key::ArrowUp);
    assert_eq!(chosen(&hand), [LeftHand]);
    press(&mut hand, Key::ArrowDown);
    assert_eq!(chosen(&hand), [LeftMiddleProximal]);
}

#[test]
fn brackets_go_to_the_carrier_and_come_back_the_same_way() {
    let mut hand = at(LEFT_ARM);
    click(&mut hand, "Left ring base on the map");
    press(&mut hand, Key::OpenBracket);
    assert_eq!(chosen(&hand), [LeftHand]);
    press(&mut hand, Key::CloseBracket);
    assert_eq!(chosen(&hand), [LeftRingProximal]);
}

#[test]
fn tab_walks_the_skeleton() {
    let mut hand = at(LEFT_ARM);
    hand.state_mut().panels.select(Some(LeftUpperArm));
    hand.run();
    press(&mut hand, Key::Tab);
    assert_eq!(chosen(&hand), [LeftLowerArm]);
    hand.key_press_modifiers(Modifiers::SHIFT, Key::Tab);
    hand.run();
    assert_eq!(chosen(&hand), [LeftUpperArm]);
}

#[test]
fn tab_after_a_click_on_the_map_is_the_next_joint_and_goes_through_a_map_that_tab_reached() {
    let mut hand = at(LEFT_ARM);
    click(&mut hand, "Left shoulder on the map");
    press(&mut hand, Key::Tab);
    assert_eq!(chosen(&hand), [LeftLowerArm]);
    hand.get_by_label("Neither map nor tree").focus();
    hand.run();
    press(&mut hand, Key::Tab);
    assert!(!hand.get_by_label("Neither map nor tree").is_focused());
    for _ in 0..3 {
        press(&mut hand, Key::Tab);
    }
    assert_eq!(chosen(&hand), [LeftLowerArm], "Tab goes from control to control");
}

#[test]
fn pointing_at_the_figure_marks_its_shape_at_once() {
    let mut hand = at(LEFT_ARM);
    let chest = hand.state().editor().evaluation().frames[UpperChest].position;
    let on_chest = hand.state().viewport.window_of(chest).unwrap() + egui::vec2(6.0, 14.0);
    hand.hover_at(on_chest);
    hand.run();
    let lit = hand.state().viewport.hovered();
    assert!(lit.is_some() && hand.state().panels.lit() == lit, "{lit:?}");
}

#[test]
fn the_tree_lists_unfolds_and_searches() {
    let mut hand = with_tree();
    assert!(hand.query_by_label("Body map").is_none());
    hand.get_by_label("Pelvis in the tree");
    assert!(hand.query_by_label("Left ring tip in the tree").is_none());
    hand.state_mut().panels.select(Some(LeftHand));
    hand.run();
    click(&mut hand, "Unfold left wrist");
    hand.get_by_label("Left ring tip in the tree");
    hand.get_by_label("Find a joint").focus();
    hand.run();
    hand.get_by_label("Find a joint").type_text("knee");
    hand.run();
    hand.get_by_label("Left knee in the tree");
    hand.get_by_label("Right knee in the tree");
    assert!(hand.query_by_label("Pelvis in the tree").is_none());
    click(&mut hand, "Right knee in the tree");
    assert_eq!(chosen(&hand), [RightLowerLeg]);
}

#[test]
fn rows_of_the_tree_choose_and_arrows_walk_them() {
    let mut hand = with_tree();
    click(&mut hand, "Neck in the tree");
    click_with(&mut hand, "Chest in the tree", Modifiers::COMMAND);
    assert_eq!(chosen(&hand), [Neck, Chest]);
    press(&mut hand, Key::ArrowDown);
    assert_eq!(chosen(&hand), [UpperChest]);
    press(&mut hand, Key::ArrowUp);
    assert_eq!(chosen(&hand), [Chest]);
    press(&mut hand, Key::ArrowLeft);
    assert!(hand.query_by_label("Neck in the tree").is_none(), "left folds");
    press(&mut hand, Key::ArrowRight);
    hand.get_by_label("Neck in the tree");
    press(&mut hand, Key::ArrowRight);
    assert_eq!(chosen(&hand), [UpperChest], "right goes on");
}

#[test]
fn a_joint_chosen_elsewhere_is_unfolded_in_the_tree() {
    let mut hand = at(LEFT_ARM);
    click(&mut hand, "Right thumb tip on the map");
    click(&mut hand, "Part tree shown");
    hand.get_by_label("Right thumb tip in the tree");
    assert!(hand.query_by_label("Left thumb tip in the tree").is_none());
}

#[test]
fn a_padlock_locks_and_unlocks_as_a_step() {
    let mut hand = with_tree();
    let locked = |hand: &Hand| hand.state().editor().document().locks.contains(Chest);
    click(&mut hand, "Lock chest");
    assert!(locked(&hand) && steps(&hand) == 1);
    let node = hand.get_by_role_and_label(Role::CheckBox, "Lock chest");
    assert_eq!(node.accesskit_node().toggled(), Some(egui::accesskit::Toggled::True));
    let torso = hand.get_by_label("Torso");
    assert_eq!(torso.accesskit_node().description().as_deref(), Some("1 locked"));
    click(&mut hand, "Lock chest");
    assert!(!locked(&hand));
    click(&mut hand, "Left elbow · lock");
    assert!(hand.state().editor().document().locks.contains(LeftLowerArm));
}

#[test]
fn a_header_tells_that_its_limb_holds_on() {
    let mut hand = at(LEFT_ARM);
    let told = |hand: &Hand| hand.get_by_label("Left arm").accesskit_node().description();
    assert_eq!(told(&hand), None);
    click(&mut hand, "Left arm contact · Planted");
    assert_eq!(told(&hand).as_deref(), Some("planted"));
}

#[test]
fn pointing_at_a_shape_or_row_lights_the_figure_up() {
    let mut hand = at(LEFT_ARM);
    hand.get_by_label("Right ankle on the map").hover();
    hand.run();
    assert_eq!(hand.state().panels.hinted(), Some(RightFoot));
    click(&mut hand, "Part tree shown");
    hand.get_by_label("Neck in the tree").hover();
    hand.run();
    assert_eq!(hand.state().panels.hinted(), Some(Neck));
    click(&mut hand, "Neither map nor tree");
    assert_eq!(hand.state().panels.hinted(), None);
    assert!(hand.query_by_label("Part tree").is_none());
}

#[test]
fn the_narrowest_panel_holds_the_whole_map() {
    let mut hand = at(LEFT_ARM);
    let border = hand.state().viewport.rect().left_center() - egui::vec2(2.0, 0.0);
    drag(&mut hand, border, &[border - egui::vec2(50.0, 0.0), border - egui::vec2(200.0, 0.0)]);
    let map = hand.get_by_label("Body map").rect();
    assert!(map.width() < 328.0, "the panel has been made narrow: {map}");
    for bone in [LeftLittleDistal, RightLittleDistal, Head, LeftToes] {
        let shape = hand.get_by_label(&format!("{} on the map", app::labels::full(bone))).rect();
        assert!(map.contains_rect(shape), "{bone}: {shape} in {map}");
    }
}
