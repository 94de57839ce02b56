//! The bar at the top: menus with everything, and buttons for what is used most.

mod menu;

use egui::{Button, Response, RichText, Ui};

use crate::action::Action;
use crate::session::Session;
use crate::theme;

/// Shows the bar; returns what was asked for.
pub fn show(ui: &mut Ui, session: &mut Session) -> Vec<Action> {
    let mut asked = Vec::new();
    let frame = egui::Frame::new().fill(theme::of(ui).bar).inner_margin(egui::Margin::symmetric(8, 5));
    egui::Panel::top("toolbar").frame(frame).resizable(false).show(ui, |ui| {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            menu::show(ui, session, &mut asked);
            gap(ui);
            history(ui, session, &mut asked);
            gap(ui);
            for action in [Action::Ranges, Action::Symmetry, Action::Marks, Action::Library] {
                switch(ui, session, action, &mut asked);
                ui.add_space(6.0);
            }
            gap(ui);
            let help = button(ui, session, Action::Help, true, "Help");
            if help.clicked() {
                asked.push(Action::Help);
            }
        });
    });
    asked
}

fn gap(ui: &mut Ui) {
    ui.add_space(2.0);
    ui.separator();
    ui.add_space(2.0);
}

/// What an action does, with its keys.
fn tip(session: &Session, action: Action) -> String {
    let keys = session.keymap().all_shown(action);
    if keys.is_empty() { action.explained().to_owned() } else { format!("{} ({keys})", action.explained()) }
}

fn button(ui: &mut Ui, session: &Session, action: Action, enabled: bool, words: &str) -> Response {
    let tip = tip(session, action);
    let button = Button::new(RichText::new(words)).frame_when_inactive(false);
    ui.add_enabled(enabled, button).on_hover_text(&tip).on_disabled_hover_text(&tip)
}

fn history(ui: &mut Ui, session: &Session, asked: &mut Vec<Action>) {
    let editor = session.editor();
    for (action, name) in [(Action::Undo, editor.undo_name()), (Action::Redo, editor.redo_name())] {
        let what = name.map_or_else(
            || format!("Nothing to {}", action.words().to_lowercase()),
            |name| format!("{} {name}", action.words()),
        );
        let keys = session.keymap().all_shown(action);
        let button = Button::new(action.words()).frame_when_inactive(false);
        let response = ui.add_enabled(name.is_some(), button);
        let tip = if keys.is_empty() { what } else { format!("{what} ({keys})") };
        if response.on_hover_text(&tip).on_disabled_hover_text(&tip).clicked() {
            asked.push(action);
        }
    }
}

fn switch(ui: &mut Ui, session: &Session, action: Action, asked: &mut Vec<Action>) {
    let Some(mut on) = session.is_on(action) else { return };
    if ui.checkbox(&mut on, action.words()).on_hover_text(tip(session, action)).changed() {
        asked.push(action);
    }
}
