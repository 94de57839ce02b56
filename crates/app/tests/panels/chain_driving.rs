//! Keys drive a chain: the walk of Space, the speed profile at several rates of frames, ranges, steps of undo.

use egui::{Event, Key, Modifiers};
use egui_kittest::kittest::Queryable as _;

use crate::chain::{ChainHand, EXCAVATOR, chosen, steps, value, window_at};

fn key(hand: &mut ChainHand, key: Key, pressed: bool) {
    let modifiers = Modifiers::NONE;
    hand.event(Event::Key { key, physical_key: None, pressed, repeat: false, modifiers });
    hand.step();
}

/// A window whose chosen joint is reached by so many presses of Space.
fn on_joint(name: &str, spaces: usize, rate: u32) -> ChainHand {
    let mut hand = window_at(name, 1.0 / rate as f32);
    for _ in 0..spaces {
        hand.key_press(Key::Space);
        hand.step();
    }
    hand
}

fn rest(hand: &mut ChainHand) {
    for _ in 0..2000 {
        if hand.state().driven_per_sec() == 0.0 && !hand.state().editor().in_gesture() {
            return;
        }
        hand.step();
    }
    panic!("it never comes to rest");
}

#[test]
fn space_walks_from_root_to_tip_and_round_again() {
    let mut hand = window_at(EXCAVATOR, 0.05);
    let mut seen = vec![chosen(&hand)];
    for _ in 0..4 {
        hand.key_press(Key::Space);
        hand.run();
        seen.push(chosen(&hand));
    }
    assert_eq!(seen, ["base", "boom", "stick", "bucket", "base"]);
    hand.key_press_modifiers(Modifiers::SHIFT, Key::Space);
    hand.run();
    assert_eq!(chosen(&hand), "bucket");
}

/// Speed, degrees a second, and angle of a free joint after so many seconds up and so many let go.
fn driven(rate: u32, up_secs: f64, free_secs: f64) -> (f64, f64) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wheel.urdf");
    let text = "<robot name=\"wheel\"><link name=\"stand\"/><link name=\"wheel\"/>\
                <joint name=\"axle\" type=\"continuous\"><parent link=\"stand\"/><child link=\"wheel\"/>\
                <axis xyz=\"0 1 0\"/></joint></robot>";
    std::fs::write(&path, text).unwrap();
    let mut hand = on_joint(path.to_str().unwrap(), 1, rate);
    assert_eq!(chosen(&hand), "axle");
    key(&mut hand, Key::ArrowUp, true);
    assert_eq!((hand.state().driven_per_sec(), value(&hand, "axle")), (0.0, 0.0), "it begins at rest");
    let frames = |secs: f64| (secs * f64::from(rate)).round() as u32;
    // The frame in which a key goes up still belongs to the time in which it was down.
    (1..frames(up_secs)).for_each(|_| hand.step());
    key(&mut hand, Key::ArrowUp, false);
    (0..frames(free_secs)).for_each(|_| hand.step());
    (hand.state().driven_per_sec(), value(&hand, "axle"))
}

#[test]
fn the_speed_grows_is_capped_and_fades_the_same_at_30_60_and_144_frames_a_second() {
    for rate in [30, 60, 144] {
        // 0.2 degrees more a thirtieth of a second, 30 of them a second.
        let (speed, angle) = driven(rate, 0.5, 0.0);
        assert!((speed - 15.0 * 0.2 * 30.0).abs() < 1e-3, "{rate}: {speed}");
        assert!((angle - 0.5 * 0.2 * 15.0 * 15.0).abs() < 1e-3, "{rate}: {angle}");
        let (speed, angle) = driven(rate, 1.5, 0.0);
        assert!((speed - 5.0 * 30.0).abs() < 1e-9, "{rate}: the cap is 5 degrees a thirtieth, {speed}");
        // 25 thirtieths to the cap, then 20 at the cap.
        assert!((angle - (25.0 * 2.5 + 20.0 * 5.0)).abs() < 1e-3, "{rate}: {angle}");
        let (speed, _) = driven(rate, 1.5, 0.5);
        let faded = 150.0 * 0.8f64.powi(15);
        assert!((speed - faded).abs() < 1e-3, "{rate}: a fifth less a thirtieth, {speed} not {faded}");
        let (speed, angle) = driven(rate, 1.5, 3.0);
        assert_eq!(speed, 0.0, "{rate}: it comes to rest");
        let same = driven(30, 1.5, 3.0).1;
        assert!((angle - same).abs() < 1e-3, "{rate}: {angle} not {same}");
    }
}

#[test]
fn up_and_down_drive_until_the_range_ends_and_a_press_is_one_step() {
    let mut hand = on_joint(EXCAVATOR, 1, 60);
    key(&mut hand, Key::ArrowUp, true);
    (0..30).for_each(|_| hand.step());
    let halfway = value(&hand, "boom");
    assert!(halfway > 10.0 && halfway < 45.0, "{halfway}");
    (0..90).for_each(|_| hand.step());
    assert!((value(&hand, "boom") - 45.0).abs() < 1e-9, "the range stops it");
    assert_eq!(hand.state().driven_per_sec(), 0.0);
    key(&mut hand, Key::ArrowUp, false);
    rest(&mut hand);
    assert_eq!(steps(&hand), 1);
    key(&mut hand, Key::ArrowDown, true);
    (0..24).for_each(|_| hand.step());
    key(&mut hand, Key::ArrowDown, false);
    let let_go = value(&hand, "boom");
    rest(&mut hand);
    assert!(value(&hand, "boom") < let_go - 1.0, "it fades and doesn't stop dead");
    assert_eq!(steps(&hand), 2);
    hand.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    hand.run();
    assert!((value(&hand, "boom") - 45.0).abs() < 1e-9);
    hand.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    hand.run();
    assert_eq!(value(&hand, "boom"), 0.0);
}

#[test]
fn a_key_that_goes_down_and_up_between_two_frames_is_not_lost() {
    let mut hand = on_joint(EXCAVATOR, 1, 10);
    let modifiers = Modifiers::NONE;
    let both = [true, false].map(|pressed| Event::Key {
        key: Key::ArrowUp,
        physical_key: None,
        pressed,
        repeat: false,
        modifiers,
    });
    hand.input_mut().events.extend(both);
    hand.step();
    rest(&mut hand);
    let nudged = value(&hand, "boom");
    assert!(nudged > 0.1 && nudged < 1.5, "{nudged}");
    assert_eq!(steps(&hand), 1);
}

#[test]
fn at_rest_no_frames_are_asked_for_and_escape_takes_a_drive_back() {
    let mut hand = on_joint(EXCAVATOR, 2, 60);
    key(&mut hand, Key::ArrowUp, true);
    (0..20).for_each(|_| hand.step());
    assert!(value(&hand, "stick") > 3.0);
    hand.key_press(Key::Escape);
    hand.step();
    key(&mut hand, Key::ArrowUp, false);
    rest(&mut hand);
    assert_eq!(steps(&hand), 0);
    assert!(value(&hand, "stick") < 1.0, "{}", value(&hand, "stick"));
    // Panics where it doesn't come to rest.
    hand.run();
}

#[test]
fn arrows_slide_the_base_and_move_a_chain_that_has_none() {
    let mut hand = on_joint(EXCAVATOR, 0, 60);
    for (arrow, toward) in [(Key::ArrowRight, 1.0), (Key::ArrowLeft, -1.0), (Key::ArrowUp, 1.0)] {
        let before = value(&hand, "base");
        key(&mut hand, arrow, true);
        (0..30).for_each(|_| hand.step());
        key(&mut hand, arrow, false);
        rest(&mut hand);
        assert!((value(&hand, "base") - before) * toward > 0.05, "{arrow:?}: {}", value(&hand, "base"));
    }
    let mut hand = on_joint("library:snake.chain.ron", 0, 60);
    assert_eq!(chosen(&hand), "root");
    let place = |hand: &ChainHand| hand.state().editor().document().world_from_root.position;
    let (before, depth) = (place(&hand), steps(&hand));
    key(&mut hand, Key::ArrowRight, true);
    (0..30).for_each(|_| hand.step());
    key(&mut hand, Key::ArrowRight, false);
    rest(&mut hand);
    let moved = place(&hand) - before;
    assert!(moved.length() > 0.02 && moved.y == 0.0 && steps(&hand) == depth + 1, "{moved}");
}

#[test]
fn another_joint_chosen_on_the_way_ends_the_drive_as_a_step() {
    let mut hand = on_joint(EXCAVATOR, 1, 60);
    key(&mut hand, Key::ArrowUp, true);
    (0..20).for_each(|_| hand.step());
    key(&mut hand, Key::Space, true);
    assert_eq!((chosen(&hand).as_str(), steps(&hand)), ("stick", 1));
    let boom = value(&hand, "boom");
    (0..20).for_each(|_| hand.step());
    assert_eq!(value(&hand, "boom"), boom);
    assert!(value(&hand, "stick") > 3.0, "the key that is still down drives the next one");
    key(&mut hand, Key::ArrowUp, false);
    rest(&mut hand);
    assert_eq!(steps(&hand), 2);
}

const ARROWS: [Key; 4] = [Key::ArrowUp, Key::ArrowDown, Key::ArrowLeft, Key::ArrowRight];

/// Numbers that look random and are the same each time.
struct Dice(u64);

impl Dice {
    fn below(&mut self, count: u64) -> u64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) % count
    }
}

/// One thing that a hand may do.
fn anything(hand: &mut ChainHand, dice: &mut Dice) {
    let at = egui::pos2(400.0 + dice.below(860) as f32, 60.0 + dice.below(700) as f32);
    let arrow = ARROWS[dice.below(4) as usize];
    match dice.below(14) {
        0..4 => hand.hover_at(at),
        4 => hand.drag_at(at),
        5 | 6 => hand.drop_at(at),
        7 => key(hand, arrow, true),
        8 => key(hand, arrow, false),
        9 => key(hand, Key::Space, true),
        10 => key(hand, Key::Escape, true),
        11 => hand.key_press_modifiers(Modifiers::COMMAND, Key::Z),
        12 => hand.key_press_modifiers(Modifiers::COMMAND, Key::Y),
        _ => {
            let label = ["Append", "Remove", "Root follows", "Root held"][dice.below(4) as usize];
            hand.get_by_label(label).click();
        }
    }
    hand.step();
}

#[test]
fn whatever_pointer_and_keys_do_values_stay_in_range_and_undo_leads_back() {
    let mut hand = window_at(EXCAVATOR, 1.0 / 30.0);
    let start = hand.state().editor().document().clone();
    let mut dice = Dice(7);
    for i in 0..700 {
        anything(&mut hand, &mut dice);
        let document = hand.state().editor().document();
        for (value, dof) in document.pose.0.iter().zip(document.robot.dofs()) {
            let off = dof.range.excess(*value);
            assert!(value.is_finite() && off < 1e-9, "step {i}: {value} in {:?}", dof.range);
        }
    }
    hand.drop_at(egui::pos2(5.0, 300.0));
    for arrow in ARROWS {
        key(&mut hand, arrow, false);
    }
    rest(&mut hand);
    for _ in 0..steps(&hand) {
        hand.key_press_modifiers(Modifiers::COMMAND, Key::Z);
        hand.step();
    }
    assert_eq!(*hand.state().editor().document(), start, "to the very bits");
}
