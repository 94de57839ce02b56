//! Egui's input in the words of the hands and the navigator.

use edit::{Axis, Choose, Constraint, Editor, Event as Did, Mark, Reaction, Selection, Words};
use egui::{CursorIcon, Event, Key, Modifiers, PointerButton, Pos2, Response, Ui};

use super::{Asked, Viewport};
use crate::action::{Action, Group};
use crate::keymap::Keymap;
use crate::labels;
use crate::panels::way_of_click;

impl Viewport {
    /// Passes on what pointer and keys did in this frame.
    pub(super) fn point(
        &mut self,
        ui: &Ui,
        response: &Response,
        editor: &Editor,
        selection: &Selection,
    ) -> Asked {
        // A dragged point is where the pointer is only as long as the camera stays.
        if let Some(sight) = self.hands.sight().filter(|_| !self.in_side) {
            self.camera = sight.camera;
        }
        let told = (self.telling(), self.offering.clone(), self.hands.knob());
        let mut asked = Asked::default();
        let mut tell = |viewport: &mut Viewport, did: Did| {
            let stage = viewport.stage(editor, selection.active());
            let Reaction { requests, chosen } = viewport.hands.event(&stage, did);
            asked.requests.extend(requests);
            if let Some(bone) = chosen {
                asked.chosen = Some(bone.map_or(Choose::None, |bone| way_of_click(ui, bone)));
            }
        };
        tell(self, Did::Modified(modifiers(ui, &self.keymap)));
        for did in keys(ui, self.hands.holds(), &self.keymap) {
            tell(self, did);
        }
        self.buttons(ui, response, &mut tell);
        self.look_around(ui, response);
        if !self.hands.holds() {
            let seen = response.hover_pos().filter(|_| self.navigator.motion().is_none());
            tell(self, seen.map_or(Did::Left, |at| Did::Moved(self.inside(at))));
        }
        let stage = self.stage(editor, selection.active());
        self.offering = told_with(&self.keymap, |words| self.hands.offering(&stage, words));
        self.show_cursor(ui);
        if told != (self.telling(), self.offering.clone(), self.hands.knob()) {
            // The status line has been drawn already.
            ui.ctx().request_repaint();
        }
        asked
    }

    /// Presses, moves and releases in the order in which they came; of moves that follow each other the last counts.
    fn buttons(&mut self, ui: &Ui, response: &Response, tell: &mut dyn FnMut(&mut Viewport, Did)) {
        let ours = response.is_pointer_button_down_on()
            || response.clicked_by(PointerButton::Primary)
            || response.drag_stopped();
        let mut moved: Option<Pos2> = None;
        for event in ui.input(|i| i.events.clone()) {
            match event {
                Event::PointerMoved(at) => moved = Some(at),
                Event::PointerButton { pos, button, pressed, .. } => {
                    self.move_on(moved.take(), tell);
                    match (button, pressed) {
                        (PointerButton::Primary, true) if ours => self.press(ui, pos, tell),
                        (PointerButton::Primary, false) => tell(self, Did::Released),
                        (PointerButton::Secondary, true) if self.hands.holds() => tell(self, Did::Cancel),
                        (_, true) if ours && !self.hands.holds() => {
                            self.take_view(ui, pos, self.hovered().is_some());
                        }
                        _ => {}
                    }
                }
                _ => {}
            }
        }
        self.move_on(moved, tell);
    }

    fn move_on(&mut self, to: Option<Pos2>, tell: &mut dyn FnMut(&mut Viewport, Did)) {
        if let Some(at) = to {
            let at = self.inside(at);
            tell(self, Did::Moved(at));
        }
    }

    /// The figure takes the press, or the view does: beside the figure, and where its preset says so.
    fn press(&mut self, ui: &Ui, at: Pos2, tell: &mut dyn FnMut(&mut Viewport, Did)) {
        tell(self, Did::Pressed(self.inside(at)));
        let on_figure = self.hands.holds();
        if self.take_view(ui, at, on_figure) && on_figure {
            tell(self, Did::Cancel);
            tell(self, Did::Released);
        }
    }

    /// Drags of the view, and the wheel.
    fn look_around(&mut self, ui: &Ui, response: &Response) {
        if self.hands.holds() {
            return;
        }
        if response.dragged() {
            self.drag_view(ui, response.drag_delta());
        }
        if !ui.input(|i| i.pointer.any_down()) {
            self.let_view_go();
        }
        if let Some(at) = response.hover_pos().filter(|_| response.contains_pointer()) {
            self.wheel(ui, at);
        }
    }

    fn show_cursor(&self, ui: &Ui) {
        let icon = if self.hands.is_dragging() {
            CursorIcon::Grabbing
        } else if matches!(self.hands.under().mark, Some(Mark::Joint(_))) {
            CursorIcon::PointingHand
        } else if self.hands.under().is_figure() {
            CursorIcon::Grab
        } else {
            return;
        };
        ui.ctx().set_cursor_icon(icon);
    }
}

fn modifiers(ui: &Ui, keymap: &Keymap) -> edit::Modifiers {
    let typing = ui.ctx().text_edit_focused();
    ui.input(|i| {
        let Modifiers { shift, command, alt, .. } = i.modifiers;
        let in_contact = keymap.is_held(i, Action::TurnInContact) && !command && !alt && !typing;
        edit::Modifiers { slow: shift, snap: command, in_contact }
    })
}

/// What keys do to something that is held; a key that repeats counts once, except for letters.
fn keys(ui: &Ui, holds: bool, keymap: &Keymap) -> Vec<Did> {
    if !holds || ui.ctx().text_edit_focused() {
        return Vec::new();
    }
    let mut all = Vec::new();
    for event in ui.input(|i| i.events.clone()) {
        match event {
            Event::Text(text) => all.extend(text.chars().map(Did::Typed)),
            Event::Key { key: Key::Backspace, pressed: true, .. } => all.push(Did::Backspace),
            Event::Key { key: Key::Enter, pressed: true, repeat: false, .. } => all.push(Did::Commit),
            Event::Key { key: Key::Escape, pressed: true, repeat: false, .. } => all.push(Did::Cancel),
            _ => {}
        }
    }
    let constrained = ui.input(|i| keymap.of_drag(i));
    all.extend(constrained.into_iter().filter_map(constraint).map(Did::Constrain));
    all
}

/// Tells something in the user's words: the panel's names of joints, the keymap's keys.
pub(super) fn told_with<T>(keymap: &Keymap, tell: impl FnOnce(&Words) -> T) -> T {
    let key = |wanted: Constraint| {
        let action = Action::of_group(Group::Drag).find(|action| constraint(*action) == Some(wanted));
        action.map_or_else(String::new, |action| keymap.shown(action))
    };
    let in_contact = keymap.shown(Action::TurnInContact);
    tell(&Words { joint: &labels::full, key: &key, in_contact: &in_contact })
}

fn constraint(action: Action) -> Option<Constraint> {
    Some(match action {
        Action::AlongX => Constraint::Along(Axis::X),
        Action::AlongY => Constraint::Along(Axis::Y),
        Action::AlongZ => Constraint::Along(Axis::Z),
        Action::AcrossX => Constraint::Across(Axis::X),
        Action::AcrossY => Constraint::Across(Axis::Y),
        Action::AcrossZ => Constraint::Across(Axis::Z),
        _ => return None,
    })
}
