//! Which action a pressed key asks for, now.

use egui::{Event, FocusDirection, Key, Ui};

use super::Session;
use crate::action::{Action, Group};
use crate::keymap::Pressed;

impl Session {
    /// Does what the keys of this frame ask for, and takes them from the input. Typing in a field asks for nothing.
    pub(super) fn keys(&mut self, ui: &Ui) {
        if ui.ctx().text_edit_focused() {
            return;
        }
        let mut dragging = self.editor.in_gesture() || self.viewport.holds();
        for event in ui.input(|i| i.events.clone()) {
            // A slow frame may bring the end of a drag together with the key that came after it.
            dragging &= !matches!(event, Event::PointerButton { pressed: false, .. });
            let Some(pressed) = Pressed::of(&event) else { continue };
            let Some(action) = self.asked(ui, &pressed, dragging) else { continue };
            take(ui, &event);
            if !pressed.repeat || repeats(action) {
                self.paste_text = pressed.pasted;
                self.act(ui.ctx(), action);
            }
        }
    }

    /// The action of a key, if it is the time for it.
    fn asked(&self, ui: &Ui, pressed: &Pressed, dragging: bool) -> Option<Action> {
        // Pasting mirrored had to ask the window system for the clipboard; here it comes.
        if pressed.pasted.is_some() && self.paste_mirrored {
            return Some(Action::PasteMirrored);
        }
        let action = self.keymap.action(pressed.chord, false)?;
        if self.is_walking() {
            return self.asked_of_walk(ui, pressed, action);
        }
        if action.group() == Group::Walk {
            return None;
        }
        if dragging && !matches!(action.group(), Group::File | Group::Edit) {
            return None;
        }
        // Tab goes through the controls while one of them has the keyboard, and through the joints otherwise.
        let tab = pressed.chord.key == Key::Tab;
        (!tab || self.is_on_picture(ui)).then_some(action)
    }

    /// While the figure walks: keys of the pose's joints mean nothing, held keys are read by the walk itself, and what a
    /// control takes for itself is the control's while it has the keyboard.
    fn asked_of_walk(&self, ui: &Ui, pressed: &Pressed, action: Action) -> Option<Action> {
        use Action::*;
        let held =
            matches!(action, SteerAhead | SteerBack | SteerLeft | SteerRight | StrafeLeft | StrafeRight);
        let control = matches!(pressed.chord.key, Key::Space | Key::Enter | Key::Tab);
        let posing = matches!(action.group(), Group::Selection | Group::Pose);
        (!held && !posing && (!control || self.means_walk(ui))).then_some(action)
    }

    /// Whether keys mean the figure: no control has the keyboard, or the pointer is on the picture, or joints are chosen
    /// by clicks in the panel.
    fn is_on_picture(&self, ui: &Ui) -> bool {
        let on_picture =
            ui.input(|i| i.pointer.hover_pos()).is_some_and(|at| self.viewport.rect().contains(at));
        on_picture || self.panels.is_clicked_on(ui.ctx()) || ui.memory(|m| m.focused().is_none())
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

/// Whether an action is done again while its key is held.
fn repeats(action: Action) -> bool {
    use Action::*;
    matches!(action, Undo | Redo | NextJoint | PreviousJoint | NextOfLevel | PreviousOfLevel)
        || matches!(action, OrbitLeft | OrbitRight | OrbitUp | OrbitDown | ZoomIn | ZoomOut)
}
