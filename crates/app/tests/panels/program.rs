//! The program around the figure: actions, keys, settings, looks, sizes, and names for assistive technology.

use std::path::Path;

use app::{Acting as _, Action, ConfigFolder, Look, Section, Session, load};
use edit::{By, Command, Editor, Request};
use egui::accesskit::Role;
use egui::{Event, Key, Modifiers, OutputCommand, vec2};
use egui_kittest::Node;
use egui_kittest::kittest::{NodeT as _, Queryable as _};
use rig::{Bone, Dof, Limb};

use crate::files::name_file;
use crate::hand::{ELBOW, Hand, LEFT_ARM, at, click, drag, pose, set, set_number, shown, steps};

/// A window of that size that keeps its settings in a folder.
fn configured(folder: &Path, size: egui::Vec2) -> Hand {
    let mut session = Session::new(Editor::new(load::figure(None).unwrap()), None);
    session.configure_from(ConfigFolder::at(folder));
    shown(session, size)
}

fn press(hand: &mut Hand, modifiers: Modifiers, key: Key) {
    hand.key_press_modifiers(modifiers, key);
    hand.run();
}

fn kept(folder: &Path, file: &str) -> String {
    std::fs::read_to_string(folder.join(file)).unwrap_or_default()
}

const WINDOW: egui::Vec2 = vec2(1280.0, 800.0);

#[test]
fn settings_take_effect_and_come_back_in_the_next_window() {
    let folder = tempfile::tempdir().unwrap();
    let mut hand = configured(folder.path(), WINDOW);
    press(&mut hand, Modifiers::COMMAND, Key::Comma);
    hand.get_by_role_and_label(Role::RadioButton, "Light").click();
    hand.run();
    assert!(!hand.ctx.global_style().visuals.dark_mode, "at once");
    hand.get_by_role_and_label(Role::CheckBox, "Second view").click();
    hand.run();
    click(&mut hand, "Navigation");
    click(&mut hand, "Maya");
    click(&mut hand, "Close");
    press(&mut hand, Modifiers::NONE, Key::M);
    let text = kept(folder.path(), "settings.ron");
    for word in ["version: 1", "look: Light", "\"Maya\"", "marks: false", "second_view: true"] {
        assert!(text.contains(word), "{word}: {text}");
    }
    let next = configured(folder.path(), WINDOW);
    let session = next.state();
    assert_eq!(session.settings().look, Look::Light);
    assert_eq!(session.viewport.preset, edit::Preset::Maya);
    assert!(session.viewport.side_view && !session.viewport.marks);
}

#[test]
fn files_at_fault_are_told_with_their_place_and_the_defaults_hold() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("keys.ron"), "(version: 1, keys: {\n  \"Save\": [\"Ctrl+O\"],\n})")
        .unwrap();
    let mut hand = configured(folder.path(), WINDOW);
    let status = hand.state().status().clone();
    assert!(status.fault && status.message.contains("keys.ron:2:3: Ctrl+O asks for"), "{status:?}");
    press(&mut hand, Modifiers::COMMAND, Key::S);
    hand.get_by_label("Save the pose");
}

#[test]
fn a_key_is_given_to_another_action_after_asking() {
    let folder = tempfile::tempdir().unwrap();
    let mut hand = configured(folder.path(), WINDOW);
    press(&mut hand, Modifiers::COMMAND, Key::Comma);
    click(&mut hand, "Keys");
    hand.get_by_label("Search the keys").click();
    hand.run();
    hand.event(Event::Text("undo".to_owned()));
    hand.run();
    click(&mut hand, "Ctrl+Z for Undo");
    press(&mut hand, Modifiers::NONE, Key::Escape);
    hand.get_by_label("Ctrl+Z for Undo");
    click(&mut hand, "Ctrl+Z for Undo");
    press(&mut hand, Modifiers::NONE, Key::Tab);
    hand.get_by_label_contains("Tab does “Next joint” already");
    click(&mut hand, "Leave it");
    assert_eq!(hand.state().keymap().shown(Action::Undo), "Ctrl+Z");
    click(&mut hand, "Ctrl+Z for Undo");
    press(&mut hand, Modifiers::NONE, Key::Tab);
    click(&mut hand, "Take it");
    assert_eq!(hand.state().keymap().shown(Action::Undo), "Tab");
    assert!(hand.state().keymap().chords(Action::NextJoint).is_empty());
    click(&mut hand, "Close");
    let text = kept(folder.path(), "keys.ron");
    assert!(text.contains("\"Undo\": [\"Tab\"]") && text.contains("\"NextJoint\": []"), "{text}");
    let mut next = configured(folder.path(), WINDOW);
    let turn = Command::Turn { joint: Bone::LeftLowerArm, dof: Dof::Flexion, degrees: 30.0, by: By::To };
    next.state_mut().submit(Request::Do(turn));
    press(&mut next, Modifiers::COMMAND, Key::Z);
    assert_eq!(steps(&next), 1, "its former key does nothing");
    press(&mut next, Modifiers::NONE, Key::Tab);
    assert_eq!(steps(&next), 0);
    press(&mut next, Modifiers::COMMAND, Key::Comma);
    click(&mut next, "Keys");
    click(&mut next, "All as by default");
    assert_eq!(*next.state().keymap(), app::Keymap::default());
    assert!(!kept(folder.path(), "keys.ron").contains("Undo"));
}

#[test]
fn the_chosen_joints_go_over_the_clipboard_and_come_back_mirrored() {
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 70.0);
    set(&mut hand, "Left collar · abduction", 8.0);
    hand.state_mut().panels.select(Some(Bone::LeftLowerArm));
    hand.run();
    hand.event(Event::Copy);
    hand.step();
    let copied = hand.output().platform_output.commands.iter().find_map(|command| match command {
        OutputCommand::CopyText(text) => Some(text.clone()),
        _ => None,
    });
    let text = copied.expect("text on the clipboard");
    assert!(text.contains("leftLowerArm") && !text.contains("leftShoulder"), "{text}");
    hand.run();
    press(&mut hand, Modifiers::COMMAND, Key::Z);
    press(&mut hand, Modifiers::COMMAND, Key::Z);
    assert_eq!(pose(&hand).angles(Bone::LeftLowerArm).flexion, 0.0);
    hand.event(Event::Paste(text.clone()));
    hand.run();
    assert_eq!(pose(&hand).angles(Bone::LeftLowerArm).flexion, 70.0);
    // The key for the mirror image asks the window for the clipboard, which answers with an event.
    press(&mut hand, Modifiers::COMMAND | Modifiers::SHIFT, Key::V);
    assert_eq!(pose(&hand).angles(Bone::RightLowerArm).flexion, 0.0);
    hand.event(Event::Paste(text));
    hand.run();
    assert_eq!(pose(&hand).angles(Bone::RightLowerArm).flexion, 70.0);
    hand.event(Event::Paste("no pose".to_owned()));
    hand.run();
    assert!(hand.state().status().fault);
    assert_eq!(pose(&hand).angles(Bone::RightLowerArm).flexion, 70.0);
}

#[test]
fn keys_look_from_every_side_and_typing_asks_for_nothing() {
    let mut hand = at(LEFT_ARM);
    let views = [
        (Modifiers::NONE, Key::Num1, rig::View::Front),
        (Modifiers::COMMAND, Key::Num1, rig::View::Back),
        (Modifiers::NONE, Key::Num3, rig::View::Left),
        (Modifiers::COMMAND, Key::Num3, rig::View::Right),
        (Modifiers::NONE, Key::Num7, rig::View::Top),
        (Modifiers::COMMAND, Key::Num7, rig::View::Bottom),
        (Modifiers::ALT, Key::Num1, rig::View::ThreeQuarter),
        (Modifiers::NONE, Key::Num1, rig::View::Front),
    ];
    for (modifiers, key, view) in views {
        press(&mut hand, modifiers, key);
        assert!(hand.state().viewport.camera.is_at(view), "{view:?}");
    }
    press(&mut hand, Modifiers::NONE, Key::Num9);
    assert!(hand.state().viewport.camera.is_at(rig::View::Back));
    press(&mut hand, Modifiers::NONE, Key::Num6);
    assert!(!hand.state().viewport.camera.is_at(rig::View::Back));
    let camera = hand.state().viewport.camera;
    press(&mut hand, Modifiers::NONE, Key::F1);
    hand.event(Event::Text("17".to_owned()));
    press(&mut hand, Modifiers::NONE, Key::Num7);
    assert_eq!(hand.state().viewport.camera, camera);
    hand.get_by_label("Nothing has these words.");
}

#[test]
fn menus_do_what_keys_do_and_say_which() {
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 40.0);
    click(&mut hand, "Edit");
    hand.get_by_role_and_label(Role::Button, "Settings…");
    // The bar has a button of the same name before the menu's row.
    hand.get_all_by_label("Undo").last().unwrap().click();
    hand.run();
    assert_eq!(steps(&hand), 0);
    click(&mut hand, "Pose");
    let symmetry = hand.get_all_by_label("Symmetry").last().unwrap();
    assert_eq!(symmetry.accesskit_node().role(), Role::CheckBox);
    symmetry.click();
    hand.run();
    assert!(hand.state().document().symmetry);
    set(&mut hand, ELBOW, 40.0);
    assert_eq!(pose(&hand).angles(Bone::RightLowerArm).flexion, 40.0);
}

#[test]
fn the_bar_and_the_status_line_fit_small_windows_and_large_controls() {
    let folder = tempfile::tempdir().unwrap();
    for (size, scale) in [(vec2(1024.0, 700.0), 1.0), (vec2(1024.0, 700.0), 1.5), (vec2(960.0, 560.0), 1.0)] {
        std::fs::write(folder.path().join("settings.ron"), format!("(version: 1, ui_scale: {scale:?})"))
            .unwrap();
        let hand = configured(folder.path(), size);
        assert_eq!(hand.ctx.zoom_factor(), scale);
        for name in ["File", "View", "Undo", "Redo", "Ranges", "Library", "Help"] {
            let rect = hand.get_by_label(name).rect();
            let window = hand.ctx.content_rect();
            assert!(window.contains_rect(rect), "{name} at {rect:?} in {window:?} at {scale}");
        }
        let picture = hand.state().viewport.rect();
        assert!(picture.width() > 200.0 && picture.height() > 300.0, "{picture:?} at {scale}");
    }
}

#[test]
fn at_half_as_large_again_the_pointer_still_meets_what_it_is_on() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("settings.ron"), "(version: 1, ui_scale: 1.5, panel: false)").unwrap();
    let mut hand = configured(folder.path(), WINDOW);
    assert_eq!(hand.ctx.pixels_per_point(), 1.5);
    press(&mut hand, Modifiers::NONE, Key::Num1);
    let shin = hand.state().editor().evaluation().frames[Bone::LeftLowerLeg].position;
    let on_shin = hand.state().viewport.window_of(shin - glam::DVec3::Y * 0.18).unwrap();
    hand.hover_at(on_shin);
    hand.run();
    assert_eq!(hand.state().viewport.hovered(), Some(Bone::LeftLowerLeg));
    let target = hand.state().editor().evaluation().limbs[Limb::LeftArm.index()].target;
    let from = hand.state().viewport.window_of(target).unwrap();
    let to = from + vec2(-30.0, 20.0);
    drag(&mut hand, from, &[from + vec2(-10.0, 5.0), to]);
    let target = hand.state().editor().evaluation().limbs[Limb::LeftArm.index()].articulator;
    let place = hand.state().viewport.window_of(target).unwrap();
    assert!((place - to).length() < 1.0, "{place} for {to}");
    press(&mut hand, Modifiers::COMMAND, Key::Num0);
    assert_eq!(hand.ctx.zoom_factor(), 1.0);
    press(&mut hand, Modifiers::COMMAND, Key::Plus);
    assert!((hand.ctx.zoom_factor() - 1.1).abs() < 1e-6);
}

#[test]
fn a_fault_is_told_by_a_sign_and_words_and_not_by_a_colour_alone() {
    let mut hand = at(LEFT_ARM);
    assert!(hand.query_by_label("Fault").is_none());
    hand.state_mut().open_asking("/nowhere/at/all.pose.ron".into());
    hand.run();
    hand.get_by_role_and_label(Role::Image, "Fault");
    hand.get_by_label_contains("all.pose.ron");
}

#[test]
fn the_line_below_says_what_pointer_and_keys_do_now() {
    let mut hand = at(LEFT_ARM);
    let beside = hand.state().viewport.rect().min + vec2(60.0, 60.0);
    hand.hover_at(beside);
    hand.run();
    hand.get_by_label("turn the view");
    hand.hover_at(beside - vec2(200.0, 0.0));
    hand.run();
    hand.get_by_label("a slider turns");
    let knee = hand.state().editor().evaluation().frames[Bone::RightLowerLeg].position;
    let shin = hand.state().viewport.window_of(knee - glam::DVec3::Y * 0.18).unwrap();
    hand.hover_at(shin);
    hand.run();
    hand.get_by_label("right leg reaches");
    hand.drag_at(shin);
    hand.step();
    hand.hover_at(shin + vec2(12.0, -6.0));
    hand.step();
    hand.step();
    hand.get_by_label_contains("Right leg reaches");
    hand.get_by_label("Esc");
    hand.drop_at(shin + vec2(12.0, -6.0));
    hand.run();
}

#[test]
fn a_new_pose_is_asked_about_and_has_no_file() {
    let mut hand = at(LEFT_ARM);
    set(&mut hand, ELBOW, 42.0);
    press(&mut hand, Modifiers::COMMAND, Key::N);
    click(&mut hand, "Don't save");
    assert_eq!(pose(&hand), load::standing(hand.state().editor().figure()));
    assert!(!hand.state().is_modified() && hand.state().path().is_none());
    press(&mut hand, Modifiers::COMMAND, Key::Z);
    assert_eq!(pose(&hand).angles(Bone::LeftLowerArm).flexion, 42.0, "it is a step as any other");
}

#[test]
fn what_the_view_shows_is_saved_as_a_picture() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("view.png");
    let mut hand = at(LEFT_ARM);
    press(&mut hand, Modifiers::NONE, Key::F12);
    press(&mut hand, Modifiers::COMMAND, Key::A);
    hand.event(Event::Text(path.display().to_string()));
    hand.run();
    set_number(&mut hand, "Width of the picture", 160.0);
    set_number(&mut hand, "Height of the picture", 100.0);
    click(&mut hand, "Save the picture now");
    saved(&mut hand);
    let picture = image::open(&path).unwrap().into_rgba8();
    assert_eq!(picture.dimensions(), (160, 100), "{:?}", hand.state().status());
    let (middle, corner) = (picture.get_pixel(80, 40), picture.get_pixel(4, 4));
    assert_ne!(middle, corner, "there is a figure in it");
    assert!(!hand.state().status().fault);
}

/// Waits until the picture that is being saved is there.
fn saved(hand: &mut Hand) {
    for _ in 0..1200 {
        if !hand.state().is_saving() {
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(25));
        hand.step();
    }
    panic!("still saving: {:?}", hand.state().status());
}

/// Opens the dialog for pictures with that path.
fn ask_for_picture(hand: &mut Hand, path: &Path) {
    press(hand, Modifiers::NONE, Key::F12);
    name_file(hand, path);
}

#[test]
fn pass_background_turn_and_keypoints_are_chosen_in_the_dialog_and_remembered() {
    let folder = tempfile::tempdir().unwrap();
    let mut hand = configured(folder.path(), WINDOW);
    ask_for_picture(&mut hand, &folder.path().join("round"));
    set_number(&mut hand, "Width of the picture", 64.0);
    set_number(&mut hand, "Height of the picture", 48.0);
    click(&mut hand, "Clay");
    click(&mut hand, "Clear background");
    click(&mut hand, "Turn once around the figure");
    set_number(&mut hand, "Frames of the turn", 3.0);
    click(&mut hand, "Keypoints beside it (OpenPose JSON)");
    click(&mut hand, "Save the picture now");
    saved(&mut hand);
    assert!(hand.state().status().message.contains("3 frames"), "{:?}", hand.state().status());
    let film = std::fs::read(folder.path().join("round.webp")).unwrap();
    assert!(film.windows(4).filter(|window| window == b"ANMF").count() == 3, "a film of three frames");
    for i in 1..=3 {
        assert!(folder.path().join(format!("round-000{i}.json")).exists(), "keypoints of frame {i}");
    }
    let text = kept(folder.path(), "settings.ron");
    for word in ["style: \"clay\"", "transparent: true", "turntable: true", "frames: 3", "keypoints: true"] {
        assert!(text.contains(word), "{word}: {text}");
    }
    let next = configured(folder.path(), WINDOW);
    assert_eq!(next.state().settings().picture.size, [64, 48]);
    assert_eq!(next.state().viewport.picture_size, [64, 48], "the frame of the picture camera follows");
}

#[test]
fn saving_goes_on_beside_the_window_and_can_be_stopped() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("long.webp");
    let mut hand = at(LEFT_ARM);
    ask_for_picture(&mut hand, &path);
    click(&mut hand, "Full HD");
    click(&mut hand, "Turn once around the figure");
    set_number(&mut hand, "Frames of the turn", 1000.0);
    click(&mut hand, "Save the picture now");
    assert!(hand.state().is_saving());
    hand.get_by_label("Saving long.webp");
    set(&mut hand, ELBOW, 33.0);
    assert_eq!(pose(&hand).angles(Bone::LeftLowerArm).flexion, 33.0, "the window goes on");
    ask_for_picture(&mut hand, &folder.path().join("second.webp"));
    click(&mut hand, "Save the picture now");
    assert!(hand.state().status().fault && hand.state().status().message.contains("still being saved"));
    // The dialog is back for whoever wants to wait.
    click(&mut hand, "Cancel");
    click(&mut hand, "Stop saving");
    saved(&mut hand);
    assert!(hand.state().status().message.contains("stopped"), "{:?}", hand.state().status());
    assert_eq!(folder.path().read_dir().unwrap().count(), 0, "nothing half is left");
}

#[test]
fn a_picture_that_can_t_be_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let mut hand = at(LEFT_ARM);
    for (name, words) in [("a.bmp", ".webp"), ("missing/a.png", "no such file or folder")] {
        ask_for_picture(&mut hand, &folder.path().join(name));
        click(&mut hand, "Save the picture now");
        saved(&mut hand);
        let status = hand.state().status();
        assert!(status.fault && status.message.contains(words), "{name}: {status:?}");
    }
}

#[test]
fn the_look_of_the_figure_is_chosen_in_the_menu_and_by_keys_and_remembered() {
    let folder = tempfile::tempdir().unwrap();
    let mut hand = configured(folder.path(), WINDOW);
    click(&mut hand, "View");
    click(&mut hand, "Line drawing");
    click(&mut hand, "View");
    click(&mut hand, "Joint planes");
    click(&mut hand, "View");
    click(&mut hand, "Ambient occlusion");
    assert!(kept(folder.path(), "settings.ron").contains("style: \"line\""));
    let next = configured(folder.path(), WINDOW);
    let finish = next.state().settings().finish;
    assert_eq!((finish.joint_planes, finish.ambient_occlusion), (true, false));
    assert_eq!(next.state().is_on(Action::LineLook), Some(true));
    assert_eq!(next.state().is_on(Action::ClayLook), Some(false));
    press(&mut hand, Modifiers::NONE, Key::K);
    assert_eq!(hand.state().is_on(Action::StudioLook), Some(true), "after the last comes the first");
    press(&mut hand, Modifiers::SHIFT, Key::K);
    assert_eq!(hand.state().is_on(Action::JointPlanes), Some(false));
    assert_eq!(hand.state().viewport.finish, hand.state().settings().finish);
}

#[test]
fn places_and_locks_are_cleared_and_set_by_keys() {
    let mut hand = at(Section::Figure);
    hand.state_mut().submit(Request::Do(Command::Place { by: glam::DVec3::X, turn: 40.0 }));
    press(&mut hand, Modifiers::ALT, Key::G);
    assert_eq!(pose(&hand).place, hand.state().editor().figure().rest_pose().place);
    hand.state_mut().panels.select(Some(Bone::LeftLowerArm));
    press(&mut hand, Modifiers::NONE, Key::L);
    assert!(hand.state().document().locks.contains(Bone::LeftLowerArm));
    press(&mut hand, Modifiers::NONE, Key::L);
    assert!(!hand.state().document().locks.contains(Bone::LeftLowerArm));
    press(&mut hand, Modifiers::ALT, Key::A);
    assert_eq!(hand.state().panels.selected(), None);
    let before = pose(&hand);
    press(&mut hand, Modifiers::NONE, Key::P);
    assert!(hand.state().status().message.contains("choose an arm or a leg"));
    assert_eq!(pose(&hand), before);
}

#[test]
fn the_keyboard_goes_to_the_controls_and_comes_back() {
    let mut hand = at(LEFT_ARM);
    let focused = |hand: &Hand| hand.ctx.memory(|memory| memory.focused());
    press(&mut hand, Modifiers::NONE, Key::Tab);
    assert_eq!(focused(&hand), None, "Tab goes through the joints");
    let chosen = hand.state().panels.selected();
    assert!(chosen.is_some());
    press(&mut hand, Modifiers::NONE, Key::F6);
    let first = focused(&hand);
    assert!(first.is_some());
    press(&mut hand, Modifiers::NONE, Key::Tab);
    assert!(focused(&hand).is_some() && focused(&hand) != first);
    assert_eq!(hand.state().panels.selected(), chosen);
    press(&mut hand, Modifiers::NONE, Key::Escape);
    assert_eq!(focused(&hand), None);
    press(&mut hand, Modifiers::NONE, Key::Tab);
    assert_ne!(hand.state().panels.selected(), chosen);
}

/// Roles of what a hand or a key acts on.
fn acts(role: Role) -> bool {
    use Role::*;
    matches!(
        role,
        Button
            | CheckBox
            | RadioButton
            | Switch
            | Slider
            | SpinButton
            | TextInput
            | ComboBox
            | Link
            | MenuItem
            | ListBoxOption
            | Tab
            | TreeItem
            | ColorWell
            | Canvas
    )
}

/// Controls without a name, as their roles and places.
pub fn unnamed(hand: &Hand) -> Vec<String> {
    let bare = |node: &Node<'_>| {
        let node = node.accesskit_node();
        acts(node.role()) && node.label().is_none_or(|label| label.trim().is_empty())
    };
    let all = hand.root().children_recursive();
    all.filter(bare).map(|node| format!("{:?} at {:?}", node.accesskit_node().role(), node.rect())).collect()
}

#[test]
fn every_control_has_a_name_in_every_part_of_the_window() {
    let mut hand = at(LEFT_ARM);
    let check = |hand: &Hand, what: &str| {
        let controls = hand.root().children_recursive().filter(|n| acts(n.accesskit_node().role())).count();
        assert!(controls > 5, "{what}: only {controls} controls are seen");
        let bare = unnamed(hand);
        assert!(bare.is_empty(), "{what}: {bare:?}");
    };
    for section in Section::ALL {
        hand.state_mut().panels.set_open(section, true);
    }
    hand.run();
    check(&hand, "all sections");
    let overviews = [app::Overview::Map, app::Overview::Tree];
    for overview in overviews {
        hand.state_mut().panels.set_overview(overview);
        hand.run();
        check(&hand, "the overview of the body");
    }
    hand.state_mut().viewport.side_view = true;
    // Portraits are drawn beside, which repaints whenever one is done.
    hand.key_press(Key::N);
    hand.run_steps(4);
    check(&hand, "library and second view");
    hand.key_press(Key::N);
    hand.run_steps(20);
    for menu in ["File", "Edit", "View", "Pose", "Walk"] {
        click(&mut hand, menu);
        check(&hand, menu);
        press(&mut hand, Modifiers::NONE, Key::Escape);
    }
    for (modifiers, key, what) in [
        (Modifiers::NONE, Key::F1, "the sheet of keys"),
        (Modifiers::COMMAND, Key::O, "opening"),
        (Modifiers::COMMAND | Modifiers::SHIFT, Key::S, "saving"),
        (Modifiers::NONE, Key::F12, "saving a picture"),
        (Modifiers::COMMAND, Key::Comma, "settings"),
    ] {
        press(&mut hand, modifiers, key);
        check(&hand, what);
        if what == "settings" {
            for page in ["Navigation", "Keys"] {
                click(&mut hand, page);
                check(&hand, page);
            }
        }
        press(&mut hand, Modifiers::NONE, Key::Escape);
    }
    set(&mut hand, ELBOW, 50.0);
    hand.state_mut().quit_asking();
    hand.run();
    check(&hand, "unsaved changes");
}

#[test]
fn the_menu_changes_between_light_and_dark() {
    let mut hand = at(LEFT_ARM);
    for light in [true, false] {
        let wanted = if light { egui::Theme::Light } else { egui::Theme::Dark };
        click(&mut hand, "View");
        click(&mut hand, "Light or dark");
        hand.run();
        assert_eq!(hand.ctx.theme(), wanted);
    }
}
