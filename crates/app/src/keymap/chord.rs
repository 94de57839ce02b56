//! A key with what is held beside it, as text: `Ctrl+Shift+S`.

use std::fmt::{Display, Formatter, Result as Written};
use std::str::FromStr;

use egui::{Key, Modifiers};
use serde::{Deserialize, Deserializer};

/// A key with its modifiers. Ctrl is the Command key where there is one.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub struct Chord {
    /// Whether Ctrl is held.
    pub ctrl: bool,
    /// Whether Shift is held.
    pub shift: bool,
    /// Whether Alt is held.
    pub alt: bool,
    /// The key; digits are those of the number row and of the pad.
    pub key: Key,
}

impl Chord {
    /// A key as the window system tells it.
    pub fn new(modifiers: Modifiers, key: Key) -> Chord {
        let Modifiers { alt, shift, ctrl, command, .. } = modifiers;
        Chord { ctrl: ctrl || command, shift, alt, key }
    }

    /// Whether the key is a sign that some keyboards have under Shift.
    pub fn is_sign(self) -> bool {
        let name = self.key.symbol_or_name();
        let mut chars = name.chars();
        let single = chars.next().filter(|_| chars.next().is_none());
        single.is_some_and(|c| !c.is_alphanumeric()) && !is_arrow(self.key)
    }

    /// Why no action can have it; `None` if one can.
    pub fn objection(self) -> Option<&'static str> {
        match self.key {
            Key::Escape => Some("Escape always takes back"),
            key if is_modifier(key) => Some("a modifier needs a key"),
            _ => None,
        }
    }

    /// As people read it: `Ctrl + [` without spaces; keys whose sign the window's font lacks by their names.
    pub fn shown(self) -> String {
        self.to_string()
    }

    fn held(self) -> String {
        let names = [(self.ctrl, "Ctrl+"), (self.alt, "Alt+"), (self.shift, "Shift+")];
        names.into_iter().filter(|(held, _)| *held).map(|(_, name)| name).collect()
    }
}

fn is_arrow(key: Key) -> bool {
    matches!(key, Key::ArrowDown | Key::ArrowLeft | Key::ArrowRight | Key::ArrowUp)
}

fn is_modifier(key: Key) -> bool {
    use Key::*;
    matches!(
        key,
        ShiftLeft | ShiftRight | ControlLeft | ControlRight | AltLeft | AltRight | SuperLeft | SuperRight
    )
}

/// As the file of keys has it; reading gives the same chord.
impl Display for Chord {
    fn fmt(&self, f: &mut Formatter<'_>) -> Written {
        let symbol = self.key.symbol_or_name();
        let name = if symbol.is_ascii() { symbol } else { self.key.name() };
        write!(f, "{}{name}", self.held())
    }
}

impl FromStr for Chord {
    type Err = String;

    fn from_str(text: &str) -> Result<Chord, String> {
        let (mut held, mut rest) = ([false; 3], text);
        while let Some((index, after)) = modifier(rest) {
            held[index] = true;
            rest = after;
        }
        let [ctrl, shift, alt] = held;
        let key = Key::from_name(rest)
            .ok_or_else(|| format!("no key \"{text}\"; keys are written as in \"Ctrl+Shift+S\" or \"F1\""))?;
        let chord = Chord { ctrl, shift, alt, key };
        chord.objection().map_or(Ok(chord), |why| Err(format!("\"{text}\": {why}")))
    }
}

fn modifier(text: &str) -> Option<(usize, &str)> {
    ["Ctrl+", "Shift+", "Alt+"].iter().enumerate().find_map(|(i, name)| Some((i, text.strip_prefix(name)?)))
}

impl<'de> Deserialize<'de> for Chord {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Chord, D::Error> {
        String::deserialize(from)?.parse().map_err(serde::de::Error::custom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_key_reads_back() {
        let sides = [false, true];
        for key in Key::ALL.iter().copied() {
            for (ctrl, shift) in sides.into_iter().flat_map(|c| sides.map(|s| (c, s))) {
                let chord = Chord { ctrl, shift, alt: ctrl, key };
                match chord.objection() {
                    None => assert_eq!(chord.to_string().parse(), Ok(chord), "{chord}"),
                    Some(_) => assert!(chord.to_string().parse::<Chord>().is_err()),
                }
            }
        }
    }

    #[test]
    fn signs_and_numpad_have_names() {
        let ctrl_plus = Chord { ctrl: true, shift: false, alt: false, key: Key::Plus };
        assert_eq!("Ctrl++".parse(), Ok(ctrl_plus));
        assert_eq!("Ctrl+Plus".parse(), Ok(ctrl_plus));
        assert_eq!("Numpad1".parse::<Chord>(), "1".parse::<Chord>());
        assert!("Hyper+S".parse::<Chord>().is_err());
        assert!("Ctrl+".parse::<Chord>().is_err());
        assert!("Escape".parse::<Chord>().unwrap_err().contains("always"));
    }
}
