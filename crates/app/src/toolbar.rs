//! The bar at the top: menus with everything, and buttons for what is used most.

mod menu;

use egui::{Button, Response, RichText, Ui};

use crate::action::Action;
use crate::keymap::Keymap;
use crate::session::Session;
use crate::theme;
use crate::walk::{self, Motion};
pub use menu::{CHAIN, Menu};

/// What a bar asks for.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Wish {
    /// An action.
    Do(Action),
    /// A file that comes with the program.
    Open(&'static str),
    /// How fast time runs while the figure walks.
    Time(Motion),
}

/// What a bar acts on: a window's session.
pub trait Acting {
    /// Which keys ask for what.
    fn keymap(&self) -> &Keymap;
    /// Whether a switch is on; `None` for actions that switch nothing.
    fn is_on(&self, action: Action) -> Option<bool>;
    /// Whether an action can do something now.
    fn can(&self, action: Action) -> bool;
    /// The step that undo would take back.
    fn undo_name(&self) -> Option<&str>;
    /// The step that redo would do again.
    fn redo_name(&self) -> Option<&str>;
    /// The words of an action here.
    fn words(&self, action: Action) -> &'static str {
        action.words()
    }
    /// One sentence more about it here.
    fn explained(&self, action: Action) -> &'static str {
        action.explained()
    }
}

/// Shows the bar of a figure's window; returns what was asked for.
pub fn show(ui: &mut Ui, session: &Session) -> Vec<Wish> {
    let switches = [Action::Ranges, Action::Symmetry, Action::Marks, Action::Library];
    bar(ui, session, menu::FIGURE, |ui, asked| {
        walk::bar::switch(ui, session.is_walking(), session.keymap(), asked);
        gap(ui);
        if session.is_walking() {
            return walk::bar::time(ui, session.walk(), session.keymap(), asked);
        }
        for action in switches {
            switch(ui, session, action, asked);
            ui.add_space(6.0);
        }
    })
}

/// Shows a bar: menus, undo and redo, what is given, help.
pub fn bar(
    ui: &mut Ui,
    on: &dyn Acting,
    menus: &[Menu],
    given: impl FnOnce(&mut Ui, &mut Vec<Wish>),
) -> Vec<Wish> {
    let mut asked = Vec::new();
    let frame = egui::Frame::new().fill(theme::of(ui).bar).inner_margin(egui::Margin::symmetric(8, 5));
    egui::Panel::top("toolbar").frame(frame).resizable(false).show(ui, |ui| {
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            menu::show(ui, on, menus, &mut asked);
            gap(ui);
            history(ui, on, &mut asked);
            gap(ui);
            given(ui, &mut asked);
            gap(ui);
            if button(ui, on, Action::Help, true, "Help").clicked() {
                asked.push(Wish::Do(Action::Help));
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
fn tip(on: &dyn Acting, action: Action) -> String {
    let keys = on.keymap().all_shown(action);
    if keys.is_empty() {
        on.explained(action).to_owned()
    } else {
        format!("{} ({keys})", on.explained(action))
    }
}

fn button(ui: &mut Ui, on: &dyn Acting, action: Action, enabled: bool, words: &str) -> Response {
    let tip = tip(on, action);
    let button = Button::new(RichText::new(words)).frame_when_inactive(false);
    ui.add_enabled(enabled, button).on_hover_text(&tip).on_disabled_hover_text(&tip)
}

fn history(ui: &mut Ui, on: &dyn Acting, asked: &mut Vec<Wish>) {
    for (action, name) in [(Action::Undo, on.undo_name()), (Action::Redo, on.redo_name())] {
        let what = name.map_or_else(
            || format!("Nothing to {}", action.words().to_lowercase()),
            |name| format!("{} {name}", action.words()),
        );
        let keys = on.keymap().all_shown(action);
        let button = Button::new(action.words()).frame_when_inactive(false);
        let response = ui.add_enabled(name.is_some(), button);
        let tip = if keys.is_empty() { what } else { format!("{what} ({keys})") };
        if response.on_hover_text(&tip).on_disabled_hover_text(&tip).clicked() {
            asked.push(Wish::Do(action));
        }
    }
}

/// A check box for an action that switches something.
pub fn switch(ui: &mut Ui, on: &dyn Acting, action: Action, asked: &mut Vec<Wish>) {
    let Some(mut is_on) = on.is_on(action) else { return };
    if ui.checkbox(&mut is_on, on.words(action)).on_hover_text(tip(on, action)).changed() {
        asked.push(Wish::Do(action));
    }
}
