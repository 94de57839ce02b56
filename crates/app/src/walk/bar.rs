//! What stands in the window's bar: the switch between posing and walking, and, while walking, what time does.

use egui::{Button, RichText, Ui};

use super::Walk;
use super::clock::Motion;
use crate::action::Action;
use crate::keymap::Keymap;
use crate::toolbar::Wish;

/// The switch `Pose | Walk`.
pub fn switch(ui: &mut Ui, walks: bool, keymap: &Keymap, asked: &mut Vec<Wish>) {
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.x = 1.0;
        let keys = keymap.all_shown(Action::Walk);
        for (words, walk, tip) in [
            ("Pose", false, "Poses the figure: by its skin, by handles, by sliders"),
            ("Walk", true, "Lets the figure walk over a ground; its pose stays as it is"),
        ] {
            let button = Button::selectable(walks == walk, RichText::new(words));
            let tip = if keys.is_empty() { tip.to_owned() } else { format!("{tip} ({keys})") };
            let response = ui.add(button).accessible_name(format!("Mode: {words}")).on_hover_text(tip);
            if response.clicked() && walks != walk {
                asked.push(Wish::Do(Action::Walk));
            }
        }
    });
}

/// Play, step, slow motion, restart, and the way of the pose into the document.
pub fn time(ui: &mut Ui, walk: &Walk, keymap: &Keymap, asked: &mut Vec<Wish>) {
    let mut button = |ui: &mut Ui, action: Action, words: &str| {
        let button = Button::new(RichText::new(words))
            .min_size(egui::vec2(if words.len() > 4 { 0.0 } else { 44.0 }, 22.0));
        if ui.add(button).on_hover_text(tip(keymap, action)).clicked() {
            asked.push(Wish::Do(action));
        }
    };
    button(ui, Action::WalkPlay, if walk.clock.playing { "Pause" } else { "Play" });
    button(ui, Action::WalkStep, "Step");
    button(ui, Action::WalkRestart, "Restart");
    ui.add_space(6.0);
    ui.scope(|ui| {
        ui.spacing_mut().item_spacing.x = 1.0;
        for motion in Motion::ALL {
            let button = Button::selectable(walk.clock.motion == motion, motion.words());
            let response = ui.add(button.min_size(egui::vec2(26.0, 22.0))).accessible_name(motion.name());
            if response.on_hover_text(tip(keymap, Action::WalkSlower)).clicked() {
                asked.push(Wish::Time(motion));
            }
        }
    });
    ui.add_space(6.0);
    let take = Button::new(Action::TakePose.words()).fill(ui.visuals().selection.bg_fill);
    if ui.add(take).on_hover_text(tip(keymap, Action::TakePose)).clicked() {
        asked.push(Wish::Do(Action::TakePose));
    }
}

fn tip(keymap: &Keymap, action: Action) -> String {
    let keys = keymap.all_shown(action);
    if keys.is_empty() {
        return action.explained().to_owned();
    }
    format!("{} ({keys})", action.explained())
}
