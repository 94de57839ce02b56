//! The window of a chain: sliders, choosing, rings, dragged links, the structure; all found by label.

use std::path::Path;

use app::{ChainSession, apply_theme};
use edit::{ChainNode, ChainSolver};
use egui::accesskit::Role;
use egui::{Key, Modifiers, Pos2, vec2};
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use egui_kittest::{Harness, Node};

pub type ChainHand = Harness<'static, ChainSession>;

pub const EXCAVATOR: &str = "library:excavator.urdf";

/// A window on a shipped chain whose frames are so far apart.
pub fn window_at(name: &str, secs: f32) -> ChainHand {
    shown(ChainSession::open(Path::new(name)).unwrap(), secs)
}

fn shown(session: ChainSession, secs: f32) -> ChainHand {
    let mut hand = Harness::builder()
        .with_size(vec2(1280.0, 800.0))
        .with_pixels_per_point(1.0)
        .with_step_dt(secs)
        .with_context_setup(apply_theme)
        .build_ui_state(|ui, session: &mut ChainSession| session.ui(ui), session);
    hand.run();
    hand
}

fn window(name: &str) -> ChainHand {
    window_at(name, 0.05)
}

/// A joint's first value, degrees or metres.
pub fn value(hand: &ChainHand, joint: &str) -> f64 {
    let document = hand.state().editor().document();
    let robot = &document.robot;
    let joint = robot.joint(joint).unwrap();
    let value = document.pose.0[robot.slot(joint).start];
    if robot.joints()[joint].kind.parts()[0].is_angle() { value.to_degrees() } else { value }
}

pub fn chosen(hand: &ChainHand) -> String {
    let robot = hand.state().editor().robot();
    let joint = hand.state().node().joint(robot);
    joint.map_or_else(|| "root".to_owned(), |joint| robot.joints()[joint].name.clone())
}

pub fn steps(hand: &ChainHand) -> usize {
    hand.state().editor().undo_depth()
}

fn set(hand: &mut ChainHand, role: Role, label: &str, value: f64) {
    hand.get_by_role_and_label(role, label).set_value_accesskit(value);
    hand.run();
}

fn click(hand: &mut ChainHand, label: &str) {
    hand.get_by_label(label).click();
    hand.run();
}

fn press(hand: &mut ChainHand, modifiers: Modifiers, key: Key) {
    hand.key_press_modifiers(modifiers, key);
    hand.run();
}

fn undo(hand: &mut ChainHand) {
    press(hand, Modifiers::COMMAND, Key::Z);
}

fn drag(hand: &mut ChainHand, from: Pos2, over: &[Pos2]) {
    hand.hover_at(from);
    hand.step();
    hand.drag_at(from);
    hand.step();
    for place in over {
        hand.hover_at(*place);
        hand.step();
    }
    hand.drop_at(over.last().copied().unwrap_or(from));
    hand.run();
}

/// Where the middle between a link's origin and its end is in the window.
fn middle(hand: &ChainHand, link: &str) -> Pos2 {
    let session = hand.state();
    let robot = session.editor().robot();
    let link = robot.link(link).unwrap();
    let frame = session.editor().frames()[link];
    session.picture.window_of(frame.point(robot.tip(link) * 0.5)).unwrap()
}

fn handle(hand: &ChainHand, name: &str) -> Pos2 {
    let session = hand.state();
    let all = session.picture.handle_places(session.editor(), session.node());
    all.iter().find(|(other, _)| other == name).unwrap_or_else(|| panic!("{name} among {all:?}")).1
}

#[test]
fn a_slider_a_joint_in_natural_units_and_a_drag_is_one_step() {
    let mut hand = window(EXCAVATOR);
    for (label, value) in [("base position", 0.0), ("boom angle", 0.0), ("bucket angle", 45.0)] {
        assert_eq!(
            hand.get_by_role_and_label(Role::Slider, label).accesskit_node().numeric_value(),
            Some(value)
        );
    }
    set(&mut hand, Role::Slider, "boom angle", 20.0);
    assert!((value(&hand, "boom") - 20.0).abs() < 1e-9);
    set(&mut hand, Role::SpinButton, "boom angle", 90.0);
    assert!((value(&hand, "boom") - 45.0).abs() < 1e-9, "its range stops it");
    assert_eq!(hand.state().status().message, "boom at 45.0°, the end of its range");
    set(&mut hand, Role::SpinButton, "base position", -1.25);
    assert_eq!(value(&hand, "base"), -1.25);
    let depth = steps(&hand);
    let rail = hand.get_by_role_and_label(Role::Slider, "stick angle").rect().center();
    drag(&mut hand, rail, &[rail + vec2(20.0, 0.0), rail + vec2(45.0, 0.0), rail + vec2(30.0, 0.0)]);
    let dragged = value(&hand, "stick");
    assert!(dragged > 5.0 && steps(&hand) == depth + 1, "{dragged}");
    undo(&mut hand);
    assert_eq!(value(&hand, "stick"), 0.0);
    press(&mut hand, Modifiers::COMMAND, Key::Y);
    assert_eq!(value(&hand, "stick"), dragged);
}

#[test]
fn a_click_chooses_the_joint_of_a_link_in_picture_and_panel() {
    let mut hand = window(EXCAVATOR);
    assert_eq!(chosen(&hand), "base");
    let stick = middle(&hand, "stick");
    drag(&mut hand, stick, &[]);
    assert_eq!((chosen(&hand).as_str(), steps(&hand)), ("stick", 0));
    click(&mut hand, "Choose boom angle");
    assert_eq!(chosen(&hand), "boom");
    press(&mut hand, Modifiers::NONE, Key::CloseBracket);
    assert_eq!(chosen(&hand), "stick", "] is the joint that it carries");
    press(&mut hand, Modifiers::NONE, Key::OpenBracket);
    assert_eq!(chosen(&hand), "boom");
}

#[test]
fn the_ring_of_what_is_chosen_turns_it_within_its_range() {
    let mut hand = window(EXCAVATOR);
    click(&mut hand, "Choose boom angle");
    let ring = handle(&hand, "boom turn");
    drag(&mut hand, ring, &[ring + vec2(0.0, 10.0), ring + vec2(-4.0, 24.0)]);
    let turned = value(&hand, "boom");
    assert!(turned.abs() > 5.0 && turned.abs() <= 45.0, "{turned}");
    assert_eq!(steps(&hand), 1);
    undo(&mut hand);
    assert_eq!(value(&hand, "boom"), 0.0);
    click(&mut hand, "Choose base position");
    let track = handle(&hand, "base slide");
    drag(&mut hand, track, &[track + vec2(40.0, 0.0), track + vec2(80.0, 3.0)]);
    assert!(value(&hand, "base") > 0.2 && steps(&hand) == 1, "{}", value(&hand, "base"));
}

#[test]
fn a_dragged_link_brings_what_was_grabbed_to_the_pointer_and_escape_takes_it_back() {
    let mut hand = window("library:excavator.chain.ron");
    let (from, before) = (middle(&hand, "stick"), hand.state().editor().document().clone());
    let to = from + vec2(8.0, 24.0);
    drag(&mut hand, from, &[from + vec2(-10.0, 20.0), to]);
    let reach = hand.state().last_reach().unwrap().clone();
    assert!(reach.reached && reach.link == "stick", "{reach:?}");
    assert_eq!(steps(&hand), 1);
    let at = middle(&hand, "stick");
    assert!(at.distance(to) < 1.5, "{at:?} {to:?}");
    assert_eq!(value(&hand, "base"), 0.0, "a held root holds its base");
    assert_ne!(hand.state().editor().document().pose, before.pose);
    hand.get_by_label("stick reached");
    undo(&mut hand);
    assert_eq!(*hand.state().editor().document(), before);
    hand.hover_at(from);
    hand.step();
    hand.drag_at(from);
    hand.step();
    hand.hover_at(to);
    hand.step();
    assert_ne!(*hand.state().editor().document(), before);
    hand.key_press(Key::Escape);
    hand.step();
    hand.drop_at(to);
    hand.run();
    assert_eq!((hand.state().editor().document(), steps(&hand)), (&before, 0));
}

#[test]
fn the_solver_of_choice_reaches_and_the_root_follows_when_it_is_told_to() {
    let mut hand = window("library:snake.chain.ron");
    click(&mut hand, "Solver");
    click(&mut hand, "FABRIK");
    click(&mut hand, "Root follows");
    let robot = hand.state().editor().robot().clone();
    let head = robot.links().last().unwrap().name.clone();
    let (from, root) = (middle(&hand, &head), hand.state().editor().frames()[0].position);
    drag(&mut hand, from, &[from + vec2(20.0, 6.0), from + vec2(60.0, 14.0)]);
    let reach = hand.state().last_reach().unwrap();
    assert_eq!(reach.solver, ChainSolver::Fabrik);
    assert!(reach.reached, "{reach:?}");
    let moved = hand.state().editor().frames()[0].position.distance(root);
    assert!(moved > 0.01, "the tail is drawn along: {moved}");
    undo(&mut hand);
    assert_eq!(hand.state().editor().frames()[0].position, root);
}

#[test]
fn links_are_appended_removed_made_longer_and_given_ranges_by_controls() {
    let mut hand = window(EXCAVATOR);
    click(&mut hand, "Choose bucket angle");
    click(&mut hand, "Append");
    let robot = hand.state().editor().robot().clone();
    assert_eq!(robot.links().last().unwrap().name, "bucket2");
    hand.get_by_role_and_label(Role::Slider, "bucket2 angle");
    assert_eq!(steps(&hand), 1);
    click(&mut hand, "Choose bucket2 angle");
    click(&mut hand, "Remove");
    assert_eq!(hand.state().editor().robot().links().len(), 6);
    assert!(hand.query_by_label("bucket2 angle").is_none());
    click(&mut hand, "Choose stick angle");
    set(&mut hand, Role::SpinButton, "Length of stick", 1.5);
    let stick = hand.state().editor().robot().link("stick").unwrap();
    assert!((hand.state().editor().robot().length_of(stick) - 1.5).abs() < 1e-12);
    set(&mut hand, Role::SpinButton, "Highest of stick", 60.0);
    set(&mut hand, Role::Slider, "stick angle", 80.0);
    assert!((value(&hand, "stick") - 60.0).abs() < 1e-9);
    set(&mut hand, Role::SpinButton, "Lowest of stick", 70.0);
    assert!((value(&hand, "stick") - 60.0).abs() < 1e-9, "ends don't pass each other");
    for _ in 0..steps(&hand) {
        undo(&mut hand);
    }
    assert!(!hand.state().is_modified());
}

#[test]
fn ranges_are_switched_and_joints_go_back_to_0() {
    let mut hand = window(EXCAVATOR);
    click(&mut hand, "Ranges");
    set(&mut hand, Role::SpinButton, "boom angle", 120.0);
    assert!((value(&hand, "boom") - 120.0).abs() < 1e-9);
    click(&mut hand, "Ranges");
    click(&mut hand, "Choose boom angle");
    press(&mut hand, Modifiers::ALT, Key::R);
    assert_eq!(value(&hand, "boom"), 0.0);
    set(&mut hand, Role::SpinButton, "stick angle", 50.0);
    click(&mut hand, "Reset all joints");
    assert_eq!(value(&hand, "stick"), 0.0);
    undo(&mut hand);
    assert_eq!(value(&hand, "stick").round(), 50.0);
    click(&mut hand, "Pose");
    click(&mut hand, "All joints to 0");
    assert_eq!((value(&hand, "stick"), value(&hand, "bucket").round()), (0.0, 45.0));
}

#[test]
fn joints_that_follow_are_shown_and_not_moved() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("gripper.urdf");
    let link = |name: &str| format!("<link name=\"{name}\"/>");
    let joint = |name: &str, child: &str, more: &str| {
        format!(
            "<joint name=\"{name}\" type=\"prismatic\"><parent link=\"palm\"/><child link=\"{child}\"/>\
             <axis xyz=\"0 1 0\"/><limit lower=\"0\" upper=\"0.04\" effort=\"1\" velocity=\"1\"/>{more}</joint>"
        )
    };
    let mimic = "<mimic joint=\"left\" multiplier=\"-1\"/>";
    let text = format!(
        "<robot name=\"gripper\">{}{}{}{}{}</robot>",
        link("palm"),
        link("a"),
        link("b"),
        joint("left", "a", ""),
        joint("right", "b", mimic)
    );
    std::fs::write(&path, text).unwrap();
    let mut hand = shown(ChainSession::open(&path).unwrap(), 0.05);
    set(&mut hand, Role::SpinButton, "left position", 30.0);
    assert!((value(&hand, "left") - 0.03).abs() < 1e-12, "short slides are millimetres");
    assert!((value(&hand, "right") + 0.03).abs() < 1e-12);
    let follower = hand.get_by_role_and_label(Role::Slider, "right position");
    assert!(follower.accesskit_node().is_disabled());
    assert!(hand.query_by_role_and_label(Role::SpinButton, "right position").is_none());
    let nodes = ChainNode::all(hand.state().editor().document());
    assert_eq!(nodes, [ChainNode::Root, ChainNode::Value(0)], "a hand can't move what follows");
}

#[test]
fn many_joints_are_found_by_their_letters() {
    let mut hand = window("library:snake.chain.ron");
    hand.get_by_label("Find a joint").click();
    hand.run();
    hand.event(egui::Event::Text("link17".to_owned()));
    hand.run();
    hand.get_by_role_and_label(Role::Slider, "link17 angle");
    assert!(hand.query_by_label("Choose link2 angle").is_none());
    press(&mut hand, Modifiers::NONE, Key::Space);
    assert_eq!(chosen(&hand), "root", "the field keeps the keys");
}

#[test]
fn a_chain_in_one_plane_opens_flat_and_others_from_the_front_and_left() {
    let mut hand = window(EXCAVATOR);
    assert!(hand.state().picture.is_side_view());
    click(&mut hand, "Side view");
    assert_eq!(hand.state().picture.camera.projection, rig::Projection::Perspective);
    let from = hand.state().picture.camera.yaw_rad;
    hand.hover_at(egui::pos2(1100.0, 650.0));
    hand.step();
    drag(&mut hand, egui::pos2(1100.0, 650.0), &[egui::pos2(1150.0, 660.0), egui::pos2(1180.0, 660.0)]);
    assert_ne!(hand.state().picture.camera.yaw_rad, from, "beside the chain a drag turns the view");
    assert_eq!(steps(&hand), 0);
    click(&mut hand, "Side view");
    assert!(hand.state().picture.is_side_view());
    assert!(!window("library:snake.chain.ron").state().picture.is_side_view());
}

#[test]
fn a_chain_is_saved_asked_about_and_opened_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("dig.chain.ron");
    let mut hand = window(EXCAVATOR);
    set(&mut hand, Role::Slider, "boom angle", 33.0);
    assert_eq!(hand.state().title(), "• excavator.urdf – Posewright");
    hand.state_mut().save(&path).unwrap();
    assert_eq!(hand.state().title(), "dig.chain.ron – Posewright");
    let again = window(path.to_str().unwrap());
    assert!((value(&again, "boom") - 33.0).abs() < 1e-9);
    set(&mut hand, Role::Slider, "boom angle", 10.0);
    hand.state_mut().quit_asking();
    hand.run();
    click(&mut hand, "Cancel");
    assert!(!hand.state().has_quit());
    hand.state_mut().open_asking("library:standing.pose.ron".into());
    hand.run();
    assert!(hand.state_mut().take_elsewhere().is_none());
    click(&mut hand, "Don't save");
    assert_eq!(hand.state_mut().take_elsewhere(), Some("library:standing.pose.ron".into()));
    let fault = hand.state_mut().save(&folder.path().join("dig.txt")).unwrap_err().to_string();
    assert!(fault.contains("dig.txt"), "{fault}");
}

#[test]
fn a_base_slides_for_a_dragged_link_when_the_root_follows_and_when_it_is_dragged_itself() {
    let mut hand = window("library:excavator.chain.ron");
    let tracks = middle(&hand, "base") + vec2(0.0, 60.0);
    drag(&mut hand, tracks, &[tracks + vec2(20.0, 0.0), tracks + vec2(50.0, -20.0)]);
    let slid = value(&hand, "base");
    assert!(slid > 0.2 && hand.state().last_reach().is_none(), "{slid}");
    click(&mut hand, "Root follows");
    let stick = middle(&hand, "stick");
    drag(&mut hand, stick, &[stick - vec2(200.0, 0.0), stick - vec2(500.0, 0.0)]);
    let reach = hand.state().last_reach().unwrap();
    assert!(reach.reached, "{reach:?} {:?}", hand.state().editor().document().pose);
    assert!(value(&hand, "base") < slid - 0.1, "{}", value(&hand, "base"));
}

#[test]
fn settings_are_those_of_every_window() {
    let folder = tempfile::tempdir().unwrap();
    let mut session = ChainSession::open(Path::new(EXCAVATOR)).unwrap();
    session.configure_from(app::ConfigFolder::at(folder.path()));
    let mut hand = shown(session, 0.05);
    click(&mut hand, "View");
    click(&mut hand, "Light or dark");
    hand.run();
    assert_eq!(hand.ctx.theme(), egui::Theme::Light);
    let figure = edit::Editor::new(app::load::figure(None).unwrap());
    let mut session = app::Session::new(figure, None);
    session.configure_from(app::ConfigFolder::at(folder.path()));
    assert_eq!(session.settings().look, app::Look::Light);
}

#[test]
fn a_figure_s_window_hands_chains_on() {
    let editor = edit::Editor::new(app::load::figure(None).unwrap());
    let mut session = app::Session::new(editor, None);
    session.open_asking(EXCAVATOR.into());
    assert_eq!(session.take_elsewhere(), Some(EXCAVATOR.into()));
    assert_eq!(session.take_elsewhere(), None, "once");
}

#[test]
fn what_the_view_shows_of_a_chain_is_saved_as_a_picture() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("dig.png");
    let mut hand = window(EXCAVATOR);
    press(&mut hand, Modifiers::NONE, Key::F12);
    press(&mut hand, Modifiers::COMMAND, Key::A);
    hand.event(egui::Event::Text(path.display().to_string()));
    hand.run();
    set(&mut hand, Role::SpinButton, "Width of the picture", 160.0);
    set(&mut hand, Role::SpinButton, "Height of the picture", 100.0);
    click(&mut hand, "Save the picture now");
    for _ in 0..1200 {
        if !hand.state().is_saving() {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(25));
        hand.step();
    }
    let picture = image::open(&path).unwrap_or_else(|e| panic!("{e}: {:?}", hand.state().status()));
    let picture = picture.into_rgba8();
    assert_eq!(picture.dimensions(), (160, 100));
    let colours: std::collections::BTreeSet<[u8; 4]> = picture.pixels().map(|pixel| pixel.0).collect();
    assert!(colours.iter().any(|[r, _, b, _]| r.saturating_sub(*b) > 90), "the excavator is yellow");
}

#[test]
fn each_guide_to_what_is_reached_is_switched_by_itself() {
    let mut hand = window("library:limb-lab.chain.ron");
    let names =
        ["target", "pointer line", "outer limit", "inner limit", "elevation circle", "grids", "joint axes"];
    for name in names {
        let label = format!("Guide: {name}");
        let on = |hand: &ChainHand| hand.get_by_label(&label).accesskit_node().toggled();
        let before = on(&hand);
        click(&mut hand, &label);
        assert_ne!(on(&hand), before, "{name}");
    }
    assert_eq!(steps(&hand), 0, "it is nothing of the chain");
}

/// Roles that a user acts on.
fn acts(role: Role) -> bool {
    use Role::{Button, CheckBox, ComboBox, MenuItem, RadioButton, Slider, SpinButton, TextInput};
    matches!(role, Button | CheckBox | ComboBox | MenuItem | RadioButton | Slider | SpinButton | TextInput)
}

#[test]
fn every_control_has_a_name_of_its_own() {
    let mut hand = window(EXCAVATOR);
    let check = |hand: &ChainHand, what: &str, own: bool| {
        let named = |node: &Node| {
            let role = node.accesskit_node().role();
            acts(role).then(|| (format!("{role:?}"), node.accesskit_node().label().unwrap_or_default()))
        };
        let mut all: Vec<(String, String)> =
            hand.root().children_recursive().filter_map(|n| named(&n)).collect();
        assert!(all.len() > 8, "{what}: {all:?}");
        assert!(all.iter().all(|(_, name)| !name.trim().is_empty()), "{what}: {all:?}");
        let count = all.len();
        all.sort();
        all.dedup();
        assert!(!own || all.len() == count, "{what}: {all:?}");
    };
    check(&hand, "the window", true);
    for menu in ["File", "Edit", "View", "Pose"] {
        click(&mut hand, menu);
        // What is in the bar is in the menus, too.
        check(&hand, menu, false);
        press(&mut hand, Modifiers::NONE, Key::Escape);
    }
    for (modifiers, key, what) in [
        (Modifiers::NONE, Key::F1, "the sheet of keys"),
        (Modifiers::COMMAND, Key::O, "opening"),
        (Modifiers::COMMAND | Modifiers::SHIFT, Key::S, "saving"),
        (Modifiers::COMMAND, Key::Comma, "settings"),
    ] {
        press(&mut hand, modifiers, key);
        check(&hand, what, false);
        press(&mut hand, Modifiers::NONE, Key::Escape);
    }
}
