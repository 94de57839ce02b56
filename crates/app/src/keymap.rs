//! Which keys ask for which action: the defaults, and the user's own from `keys.ron`.

mod chord;
mod file;

use std::collections::BTreeMap;

use egui::{Event, InputState};

use crate::action::{Action, Group};
pub use chord::Chord;
pub use file::parse_keys;

/// Chords for actions. No chord asks for two actions at a time.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Keymap {
    keys: BTreeMap<Action, Vec<Chord>>,
}

/// A key that was pressed, and what the clipboard held if the window system says so.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Pressed {
    /// The key with its modifiers.
    pub chord: Chord,
    /// Whether it comes again because it is held.
    pub repeat: bool,
    /// The clipboard's text; the window system sends it with the key for pasting, and only then.
    pub pasted: Option<String>,
}

impl Default for Keymap {
    fn default() -> Keymap {
        let keys = Action::ALL.iter().map(|action| (*action, defaults(*action))).collect();
        Keymap { keys }
    }
}

/// The chords that an action has by default.
pub fn defaults(action: Action) -> Vec<Chord> {
    action.default_keys().iter().filter_map(|text| text.parse().ok()).collect()
}

impl Keymap {
    /// The chords of an action, the one to show first.
    pub fn chords(&self, action: Action) -> &[Chord] {
        self.keys.get(&action).map_or(&[], Vec::as_slice)
    }

    /// Gives an action other chords.
    pub fn set(&mut self, action: Action, chords: Vec<Chord>) {
        self.keys.insert(action, chords);
    }

    /// The first chord of an action as people read it; empty if it has none.
    pub fn shown(&self, action: Action) -> String {
        self.chords(action).first().map_or_else(String::new, |chord| chord.shown())
    }

    /// All chords of an action as people read them.
    pub fn all_shown(&self, action: Action) -> String {
        let chords: Vec<String> = self.chords(action).iter().map(|chord| chord.shown()).collect();
        chords.join(", ")
    }

    /// What a key asks for while nothing is dragged, or while the figure is.
    ///
    /// Shift and Alt count exactly, save for signs such as `?` which need Shift on some keyboards. In a drag, Ctrl and Alt
    /// may be held for snapping.
    pub fn action(&self, pressed: Chord, dragging: bool) -> Option<Action> {
        let bare = Chord { ctrl: false, alt: false, ..pressed };
        let unshifted = Chord { shift: false, ..pressed };
        let tries = [
            Some(pressed),
            Some(bare).filter(|_| dragging),
            Some(unshifted).filter(|_| pressed.shift && pressed.is_sign()),
        ];
        tries.into_iter().flatten().find_map(|chord| self.exactly(chord, dragging))
    }

    fn exactly(&self, chord: Chord, dragging: bool) -> Option<Action> {
        let here = |action: &Action| (action.group() == Group::Drag) == dragging;
        let asks = |(action, chords): (&Action, &Vec<Chord>)| chords.contains(&chord).then_some(*action);
        self.keys.iter().filter_map(asks).find(here)
    }

    /// Another action that has the chord already, at the times at which this one counts.
    pub fn clash(&self, action: Action, chord: Chord) -> Option<Action> {
        self.exactly(chord, action.group() == Group::Drag).filter(|other| *other != action)
    }

    /// Whether a key of the action is down, whatever is held with it.
    pub fn is_held(&self, input: &InputState, action: Action) -> bool {
        self.chords(action).iter().any(|chord| input.key_down(chord.key))
    }
}

impl Pressed {
    /// The key of an event. Copying, cutting and pasting come as events of their own and are told as Ctrl+C, X and V.
    pub fn of(event: &Event) -> Option<Pressed> {
        let command = |key| Chord { ctrl: true, shift: false, alt: false, key };
        let (chord, repeat, pasted) = match event {
            Event::Copy => (command(egui::Key::C), false, None),
            Event::Cut => (command(egui::Key::X), false, None),
            Event::Paste(text) => (command(egui::Key::V), false, Some(text.clone())),
            Event::Key { key, pressed: true, repeat, modifiers, .. } => {
                (Chord::new(*modifiers, *key), *repeat, None)
            }
            _ => return None,
        };
        Some(Pressed { chord, repeat, pasted })
    }
}

#[cfg(test)]
mod tests {
    use egui::{Key, Modifiers};

    use super::*;

    fn chord(text: &str) -> Chord {
        text.parse().unwrap()
    }

    #[test]
    fn every_default_key_is_one_and_asks_for_its_action_alone() {
        let keymap = Keymap::default();
        for action in Action::ALL {
            assert_eq!(keymap.chords(*action).len(), action.default_keys().len(), "{action:?}");
            for chord in keymap.chords(*action) {
                assert_eq!(keymap.clash(*action, *chord), None, "{chord} of {action:?}");
                assert_eq!(keymap.action(*chord, action.group() == Group::Drag), Some(*action));
            }
        }
    }

    #[test]
    fn shift_and_alt_count_exactly_save_for_signs() {
        let keymap = Keymap::default();
        let ask = |text| keymap.action(chord(text), false);
        assert_eq!(ask("Ctrl+S"), Some(Action::Save));
        assert_eq!(ask("Ctrl+Shift+S"), Some(Action::SaveAs));
        assert_eq!(ask("Ctrl+Alt+S"), None);
        assert_eq!(ask("Shift+P"), None);
        assert_eq!(ask("Alt+P"), None);
        assert_eq!(ask("Shift+?"), Some(Action::Help));
        assert_eq!(ask("Ctrl+Shift+="), Some(Action::LargerUi));
        assert_eq!(ask("Shift+["), Some(Action::Parent));
    }

    #[test]
    fn in_a_drag_other_keys_count_and_ctrl_may_be_held() {
        let keymap = Keymap::default();
        let ask = |text| keymap.action(chord(text), true);
        assert_eq!(ask("X"), Some(Action::AlongX));
        assert_eq!(ask("Ctrl+Shift+X"), Some(Action::AcrossX));
        assert_eq!(ask("1"), None);
        let cut = Pressed::of(&Event::Cut).unwrap().chord;
        assert_eq!(keymap.action(cut, true), Some(Action::AlongX), "Ctrl+X comes as an event of its own");
        assert_eq!(keymap.action(chord("X"), false), None);
    }

    #[test]
    fn the_clipboards_events_are_keys() {
        let paste = Pressed::of(&Event::Paste("text".to_owned())).unwrap();
        assert_eq!(Keymap::default().action(paste.chord, false), Some(Action::Paste));
        assert_eq!(paste.pasted.as_deref(), Some("text"));
        let up = Event::Key {
            key: Key::S,
            physical_key: None,
            pressed: false,
            repeat: false,
            modifiers: Modifiers::COMMAND,
        };
        assert_eq!(Pressed::of(&up), None);
    }
}
