//! Egui's input in the words of the hands and the navigator.

use edit::{Axis, Choose, Constraint, Editor, Event as Did, Mark, Reaction, Selection, Words};
use egui::{CursorIcon, Event, Key, Modifiers, PointerButton, Pos2, Response, Ui};

use super::{Asked, Viewport};
use crate::action::{Action, Group};
use crate::choosing::way_of_click;
use crate::keymap::{Keymap, Pressed};
use crate::labels;

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
        tell(self, Did::Modified(modifiers(ui, &self.keymap, ui.input(|i| i.modifiers))));
        self.events(ui, response, &mut tell);
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

    /// Buttons, moves and keys in the order in which they came; of moves that follow each other the last counts. What
    /// comes after the end of a drag waits for the next frame if it takes hold again: by then the figure has moved.
    fn events(&mut self, ui: &Ui, response: &Response, tell: &mut dyn FnMut(&mut Viewport, Did)) {
        let ours = response.is_pointer_button_down_on()
            || response.clicked_by(PointerButton::Primary)
            || response.drag_stopped()
            || (response.contains_pointer() && !ui.input(|i| i.pointer.any_down()));
        let mut events = std::mem::take(&mut self.waiting);
        events.extend(ui.input(|i| i.events.clone()).into_iter().map(|event| (event, ours)));
        let (mut moved, mut ended): (Option<Pos2>, bool) = (None, false);
        while let Some((event, ours)) = events.pop_front() {
            if ended && is_press(&event) {
                events.push_front((event, ours));
                ui.ctx().request_repaint();
                break;
            }
            if let Event::PointerMoved(at) = event {
                moved = Some(at);
                continue;
            }
            self.move_on(moved.take(), tell);
            let held = self.hands.is_dragging();
            match event {
                Event::PointerButton { pos, button, pressed, modifiers: with, .. } => {
                    tell(self, Did::Modified(modifiers(ui, &self.keymap, with)));
                    self.button(ui, pos, (button, pressed), ours, tell);
                }
                event => self.key(ui, &event, tell),
            }
            ended |= held && !self.hands.is_dragging();
        }
        self.waiting = events;
        self.move_on(moved, tell);
    }

    fn button(
        &mut self,
        ui: &Ui,
        at: Pos2,
        did: (PointerButton, bool),
        ours: bool,
        tell: &mut dyn FnMut(&mut Viewport, Did),
    ) {
        match did {
            (PointerButton::Primary, true) if ours => self.press(ui, at, tell),
            (PointerButton::Primary, false) => tell(self, Did::Released),
            (PointerButton::Secondary, true) if self.hands.holds() => tell(self, Did::Cancel),
            (button, true) if ours && !self.hands.holds() => {
                self.take_view(ui, button, at, self.hovered().is_some());
            }
            _ => {}
        }
    }

    /// What a key does to something that is held; one that repeats counts once, except for letters.
    fn key(&mut self, ui: &Ui, event: &Event, tell: &mut dyn FnMut(&mut Viewport, Did)) {
        if !self.hands.holds() || ui.ctx().text_edit_focused() {
            return;
        }
        match event {
            Event::Text(text) => text.chars().for_each(|letter| tell(self, Did::Typed(letter))),
            Event::Key { key: Key::Backspace, pressed: true, .. } => tell(self, Did::Backspace),
            Event::Key { key: Key::Enter, pressed: true, repeat: false, .. } => tell(self, Did::Commit),
            Event::Key { key: Key::Escape, pressed: true, repeat: false, .. } => tell(self, Did::Cancel),
            event => {
                let pressed = Pressed::of(event).filter(|pressed| !pressed.repeat);
                let action = pressed.and_then(|pressed| self.keymap.action(pressed.chord, true));
                if let Some(constraint) = action.and_then(constraint) {
                    tell(self, Did::Constrain(constraint));
                }
            }
        }
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
        if self.take_view(ui, PointerButton::Primary, at, on_figure) && on_figure {
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

fn is_press(event: &Event) -> bool {
    matches!(event, Event::PointerButton { pressed: true, .. })
}

fn modifiers(ui: &Ui, keymap: &Keymap, held: Modifiers) -> edit::Modifiers {
    let Modifiers { shift, command, alt, .. } = held;
    let typing = ui.ctx().text_edit_focused();
    let in_contact = ui.input(|i| keymap.is_held(i, Action::TurnInContact)) && !command && !alt && !typing;
    edit::Modifiers { slow: shift, snap: command, in_contact }
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

/// What an action of a drag holds it to.
pub fn constraint(action: Action) -> Option<Constraint> {
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
