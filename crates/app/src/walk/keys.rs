//! Held keys as wishes of a walk.

use egui::{InputState, Ui};

use super::steer::Wish;
use crate::action::Action;
use crate::keymap::Keymap;

/// What the keys that are held wish for. Arrows mean it only where no control has the keyboard.
pub fn wish(ui: &Ui, keymap: &Keymap, arrows: bool) -> Wish {
    let held = |action| ui.input(|input| is_held(input, keymap, action, arrows));
    let way = |plus, minus| f64::from(u8::from(held(plus))) - f64::from(u8::from(held(minus)));
    Wish {
        ahead: way(Action::SteerAhead, Action::SteerBack),
        turn: way(Action::SteerLeft, Action::SteerRight),
        aside: way(Action::StrafeLeft, Action::StrafeRight),
    }
}

/// Whether a key of an action is down, with Shift where its chord has it; Ctrl and Alt are for other things.
fn is_held(input: &InputState, keymap: &Keymap, action: Action, arrows: bool) -> bool {
    use egui::Key::{ArrowDown, ArrowLeft, ArrowRight, ArrowUp};
    if input.modifiers.command || input.modifiers.ctrl || input.modifiers.alt {
        return false;
    }
    let shift = input.modifiers.shift;
    keymap.chords(action).iter().any(|chord| {
        let arrow = matches!(chord.key, ArrowDown | ArrowLeft | ArrowRight | ArrowUp);
        let exactly = chord.shift == shift && !chord.ctrl && !chord.alt;
        exactly && (arrows || !arrow) && input.key_down(chord.key)
    })
}

#[cfg(test)]
mod tests {
    use egui::{Context, Event, Key, Modifiers, RawInput};

    use super::*;

    fn with(keys: &[Key], modifiers: Modifiers, arrows: bool) -> Wish {
        let ctx = Context::default();
        let event =
            |key: &Key| Event::Key { key: *key, physical_key: None, pressed: true, repeat: false, modifiers };
        let held = [Event::ModifiersChanged(modifiers)].into_iter();
        let input = RawInput { events: held.chain(keys.iter().map(event)).collect(), ..RawInput::default() };
        let mut found = Wish::default();
        let mut output = ctx.run_ui(input, |ui| found = wish(ui, &Keymap::default(), arrows));
        output.textures_delta.clear();
        found
    }

    #[test]
    fn letters_and_arrows_steer() {
        let none = Modifiers::NONE;
        let ahead = Wish { ahead: 1.0, ..Wish::default() };
        assert_eq!(with(&[Key::W], none, true), ahead);
        assert_eq!(with(&[Key::ArrowUp], none, true), ahead);
        assert_eq!(with(&[Key::ArrowUp], none, false), Wish::default(), "a slider has the keyboard");
        assert_eq!(with(&[Key::W, Key::A], none, true), Wish { ahead: 1.0, turn: 1.0, aside: 0.0 });
        assert_eq!(with(&[Key::W, Key::S], none, true), Wish::default(), "one against the other");
        assert_eq!(with(&[Key::E], none, false), Wish { aside: -1.0, ..Wish::default() });
    }

    #[test]
    fn with_shift_arrows_step_aside_and_with_ctrl_nothing_does() {
        assert_eq!(with(&[Key::ArrowLeft], Modifiers::SHIFT, true), Wish { aside: 1.0, ..Wish::default() });
        assert_eq!(with(&[Key::S], Modifiers::COMMAND, true), Wish::default());
    }
}
