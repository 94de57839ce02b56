//! Keys of a window on a chain: actions by the keymap, Space through the nodes, arrows that drive.

use edit::ChainRequest;
use egui::{Event, FocusDirection, Id, Key, Modifiers, Ui};

use super::{ChainSession, act, value};
use crate::action::Group;
use crate::keymap::Pressed;

impl ChainSession {
    /// Does what the keys of this frame ask for, and takes them from the input. Typing in a field asks for nothing.
    pub(super) fn keys(&mut self, ui: &Ui) {
        if ui.ctx().text_edit_focused() {
            return;
        }
        let mut dragging = self.picture.holds();
        for event in ui.input(|i| i.events.clone()) {
            dragging &= !matches!(event, Event::PointerButton { pressed: false, .. });
            if !dragging && self.walks(ui, &event) {
                continue;
            }
            let Some(pressed) = Pressed::of(&event) else { continue };
            let Some(action) = self.keymap.action(pressed.chord, false).filter(|a| act::knows(*a)) else {
                continue;
            };
            let tab = pressed.chord.key == Key::Tab;
            let other = dragging && !matches!(action.group(), Group::File | Group::Edit);
            if other || tab && !self.means_chain(ui) {
                continue;
            }
            take(ui, &event);
            if !pressed.repeat || act::repeats(action) {
                self.act(ui.ctx(), action);
            }
        }
    }

    /// Space goes through the nodes; whether it was that.
    fn walks(&mut self, ui: &Ui, event: &Event) -> bool {
        let Event::Key { key: Key::Space, pressed: true, modifiers, .. } = event else { return false };
        let plain = *modifiers == Modifiers::NONE || *modifiers == Modifiers::SHIFT;
        if !plain || !self.means_chain(ui) {
            return false;
        }
        take(ui, event);
        self.choose(self.node.next(self.editor.document(), modifiers.shift));
        true
    }

    /// Drives what is chosen by the arrows. One press, until it has come to rest, is one step.
    pub(super) fn drive(&mut self, ui: &Ui) {
        let free = !self.dialogs.is_open() && !ui.ctx().text_edit_focused() && !self.picture.holds();
        let ours = free && self.means_chain(ui);
        let arrow = |event: &Event| {
            use Key::{ArrowDown, ArrowLeft, ArrowRight, ArrowUp};
            matches!(
                event,
                Event::Key { key: ArrowUp | ArrowDown | ArrowLeft | ArrowRight, pressed: true, .. }
            )
        };
        if ours && ui.input(|i| i.events.iter().any(arrow)) && !self.on_rail(ui) {
            // The toolkit would go to another control.
            ui.memory_mut(|m| m.move_focus(FocusDirection::None));
        }
        let commands = self.driving.asks(ui, &self.editor, self.node, &self.picture.camera, ours);
        for command in commands {
            self.submit(ChainRequest::Drive(command));
            if self.status.clamped || self.status.fault {
                self.driving.stopped_short();
            }
        }
    }

    /// Whether keys mean the chain: no control has the keyboard but a slider, or the pointer is on the picture.
    fn means_chain(&self, ui: &Ui) -> bool {
        let on_picture =
            ui.input(|i| i.pointer.hover_pos()).is_some_and(|at| self.picture.rect().contains(at));
        on_picture || self.on_rail(ui) || ui.memory(|m| m.focused().is_none())
    }

    /// Whether a joint's slider has the keyboard.
    fn on_rail(&self, ui: &Ui) -> bool {
        let Some(focused) = ui.memory(|m| m.focused()) else { return false };
        let robot = self.editor.robot();
        robot.dofs().any(|dof| Id::unique(("rail", value::name(robot, &dof).as_str())) == focused)
    }
}

/// Takes an event from the input, so that no control sees it.
fn take(ui: &Ui, event: &Event) {
    if matches!(event, Event::Key { key: Key::Tab, .. }) {
        // The toolkit has read it before the first control is shown.
        ui.memory_mut(|m| m.move_focus(FocusDirection::None));
    }
    ui.input_mut(|i| i.events.retain(|other| other != event));
}
