//! Egui's input in the words of the hands and the navigator.

use edit::{ChainSpot, Modifiers, ViewEvent};
use egui::{CursorIcon, Event, PointerButton, Pos2, Response, Ui};
use glam::Vec2;

use super::picture::{Asked, ChainPicture, Shown};
use crate::keymap::Pressed;
use crate::viewport::navigation::{self, WHEEL_REST_SECS};
use crate::viewport::pointer::constraint;

impl ChainPicture {
    /// Passes on what pointer and keys did in this frame.
    pub(super) fn point(&mut self, ui: &Ui, response: &Response, shown: &Shown) -> Asked {
        // A dragged point is where the pointer is only as long as the camera stays.
        if let Some(sight) = self.hands.sight() {
            self.camera = sight.camera;
        }
        let told = (self.hands.under(), self.hands.is_dragging());
        let mut asked = Asked::default();
        let ours = response.is_pointer_button_down_on()
            || response.clicked_by(PointerButton::Primary)
            || response.drag_stopped()
            || (response.contains_pointer() && !ui.input(|i| i.pointer.any_down()));
        for event in ui.input(|i| i.events.clone()) {
            self.event(ui, &event, ours, shown, &mut asked);
        }
        self.look_around(ui, response);
        if !self.hands.holds() {
            let seen = response.hover_pos().filter(|_| self.navigator.motion().is_none());
            let at = seen.map(|at| self.inside(at));
            self.with_hands(shown, |hands, stage| hands.hover(stage, at));
        }
        self.show_cursor(ui);
        if told != (self.hands.under(), self.hands.is_dragging()) {
            // The status line has been drawn already.
            ui.ctx().request_repaint();
        }
        asked
    }

    fn event(&mut self, ui: &Ui, event: &Event, ours: bool, shown: &Shown, asked: &mut Asked) {
        match event {
            Event::PointerMoved(at) if self.hands.holds() => self.drag(ui, *at, shown, asked),
            Event::PointerButton { pos, button: PointerButton::Primary, pressed: true, .. } if ours => {
                let at = self.inside(*pos);
                let taken = self.with_hands(shown, |hands, stage| hands.press(stage, at));
                if self.take_view(ui, PointerButton::Primary, at, taken) && taken {
                    self.hands.let_go();
                }
            }
            Event::PointerButton { button: PointerButton::Primary, pressed: false, .. } => {
                let chosen = self.with_hands(shown, |hands, stage| hands.release(stage));
                asked.chosen = chosen.or(asked.chosen);
            }
            Event::PointerButton { button: PointerButton::Secondary, pressed: true, .. }
                if self.hands.holds() =>
            {
                self.hands.let_go();
                asked.requests.push(edit::ChainRequest::Cancel);
            }
            Event::PointerButton { pos, button, pressed: true, .. } if ours && !self.hands.holds() => {
                let at = self.inside(*pos);
                let on_chain = self.hands.under() != ChainSpot::Nothing;
                self.take_view(ui, *button, at, on_chain);
            }
            event if self.hands.holds() && !ui.ctx().text_edit_focused() => {
                let pressed = Pressed::of(event).filter(|pressed| !pressed.repeat);
                let action = pressed.and_then(|pressed| shown.keymap.action(pressed.chord, true));
                if let Some(held) = action.and_then(constraint) {
                    self.hands.constrain(held);
                    if let Some(at) = ui.input(|i| i.pointer.latest_pos()) {
                        self.drag(ui, at, shown, asked);
                    }
                }
            }
            _ => {}
        }
    }

    fn drag(&mut self, ui: &Ui, at: Pos2, shown: &Shown, asked: &mut Asked) {
        let at = self.inside(at);
        let held = ui.input(|i| i.modifiers);
        let modifiers = Modifiers { slow: held.shift, snap: held.command, in_contact: false };
        if let Some(request) = self.with_hands(shown, |hands, stage| hands.drag(stage, at, modifiers)) {
            // Of moves that follow each other the last counts: each starts from the first state.
            asked.requests.retain(|request| !matches!(request, edit::ChainRequest::Preview(_)));
            asked.requests.push(request);
        }
    }

    /// Lets the hands act on the stage, of which they are no part.
    fn with_hands<T>(
        &mut self,
        shown: &Shown,
        act: impl FnOnce(&mut edit::ChainHands, &edit::ChainStage) -> T,
    ) -> T {
        let mut hands = std::mem::take(&mut self.hands);
        let result = act(&mut hands, &self.stage(shown));
        self.hands = hands;
        result
    }

    fn take_view(&mut self, ui: &Ui, button: PointerButton, at: Vec2, on_chain: bool) -> bool {
        self.navigate(navigation::pressed(ui, button, at, on_chain))
    }

    /// Drags of the view, and the wheel.
    fn look_around(&mut self, ui: &Ui, response: &Response) {
        if self.hands.holds() {
            return;
        }
        if let Some(motion) = self.navigator.motion().filter(|_| response.dragged()) {
            ui.ctx().set_cursor_icon(navigation::cursor(motion));
            let by = response.drag_delta();
            if by != egui::Vec2::ZERO {
                self.navigate(ViewEvent::Moved { by: Vec2::new(by.x, by.y) });
            }
        }
        if !ui.input(|i| i.pointer.any_down()) {
            self.navigate(ViewEvent::Released);
        }
        if let Some(at) = response.hover_pos().filter(|_| response.contains_pointer()) {
            for event in navigation::scrolled(ui, self.preset, self.inside(at)) {
                self.navigate(event);
                self.wheeled_at = ui.input(|i| i.time);
                let rest = std::time::Duration::from_secs_f64(WHEEL_REST_SECS + 0.02);
                ui.ctx().request_repaint_after(rest);
            }
        }
    }

    /// Whether the wheel moved the view just now.
    pub(super) fn is_wheeling(&self, ui: &Ui) -> bool {
        ui.input(|i| i.time) - self.wheeled_at < WHEEL_REST_SECS
    }

    fn navigate(&mut self, event: ViewEvent) -> bool {
        let size = self.sight().size_px;
        self.navigator.take(event, self.preset, &mut self.camera, size)
    }

    fn inside(&self, at: Pos2) -> Vec2 {
        Vec2::new(at.x - self.rect.min.x, at.y - self.rect.min.y)
    }

    fn show_cursor(&self, ui: &Ui) {
        let icon = match self.hands.under() {
            _ if self.hands.is_dragging() => CursorIcon::Grabbing,
            ChainSpot::Handle(_) | ChainSpot::Link(_) => CursorIcon::Grab,
            ChainSpot::Nothing => return,
        };
        ui.ctx().set_cursor_icon(icon);
    }
}
