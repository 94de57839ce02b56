//! The user's keys as text: only what differs from the defaults.

use std::fmt::Write as _;

use rig::{TextFault, check_version, from_ron};
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer};

use super::{Chord, Keymap, defaults};
use crate::action::Action;

/// The newest version of files of keys.
const KEYS_VERSION: u32 = 1;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct KeysText {
    #[serde(rename = "version")]
    _version: u32,
    keys: Overrides,
}

/// In the order of the file.
struct Overrides(Vec<(Action, Vec<Chord>)>);

impl<'de> Deserialize<'de> for Action {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Action, D::Error> {
        let name = String::deserialize(from)?;
        Action::of_name(&name).ok_or_else(|| D::Error::custom(format!("no action \"{name}\"")))
    }
}

impl<'de> Deserialize<'de> for Overrides {
    fn deserialize<D: Deserializer<'de>>(from: D) -> Result<Overrides, D::Error> {
        from.deserialize_map(Entries)
    }
}

struct Entries;

impl<'de> Visitor<'de> for Entries {
    type Value = Overrides;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a map from actions to lists of keys")
    }

    fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Overrides, M::Error> {
        let mut entries: Vec<(Action, Vec<Chord>)> = Vec::new();
        while let Some(action) = map.next_key::<Action>()? {
            if entries.iter().any(|(other, _)| *other == action) {
                return Err(M::Error::custom(format!("\"{}\" is there twice", action.name())));
            }
            entries.push((action, map.next_value()?));
        }
        Ok(Overrides(entries))
    }
}

/// Reads the user's keys over the defaults.
///
/// # Errors
/// Malformed text, unknown actions or keys, and a key that would ask for two actions: what and where.
pub fn parse_keys(text: &str) -> Result<Keymap, TextFault> {
    check_version(text, KEYS_VERSION)?;
    let file: KeysText = from_ron(text)?;
    let mut keymap = Keymap::default();
    for (action, chords) in &file.keys.0 {
        keymap.set(*action, chords.clone());
    }
    for (action, chords) in &file.keys.0 {
        if let Some((chord, other)) = chords.iter().find_map(|c| Some((*c, keymap.clash(*action, *c)?))) {
            let (line, column) = place(text, *action);
            let message = format!(
                "{chord} asks for \"{}\" and for \"{}\": give one of them other keys, or [] for none",
                action.name(),
                other.name()
            );
            return Err(TextFault { line, column, message });
        }
    }
    Ok(keymap)
}

/// Line and column, from 1, at which an action's entry begins.
fn place(text: &str, action: Action) -> (usize, usize) {
    let at = text.find(&format!("\"{}\"", action.name())).unwrap_or(0);
    let before = &text[..at];
    let column = before.rsplit('\n').next().unwrap_or("").chars().count() + 1;
    (before.matches('\n').count() + 1, column)
}

impl Keymap {
    /// The text of the file: what differs from the defaults.
    pub fn to_text(&self) -> String {
        let mut text = format!("(\n    version: {KEYS_VERSION},\n    keys: {{\n");
        for action in Action::ALL.iter().copied().filter(|a| self.chords(*a) != defaults(*a)) {
            let quoted = |chord: &Chord| {
                let escaped = chord.to_string().replace('\\', "\\\\").replace('"', "\\\"");
                format!("\"{escaped}\"")
            };
            let chords: Vec<String> = self.chords(action).iter().map(quoted).collect();
            // Writing to a string can't fail.
            let _ = writeln!(text, "        \"{}\": [{}],", action.name(), chords.join(", "));
        }
        text.push_str("    },\n)\n");
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(keys: &str) -> String {
        parse_keys(&format!("(version: 1, keys: {{\n    {keys}\n}})")).unwrap_err().to_string()
    }

    #[test]
    fn what_is_given_takes_the_place_of_the_defaults() {
        let text = "(version: 1, keys: {\"Save\": [\"Ctrl+K\", \"F5\"], \"Balance\": []})";
        let keymap = parse_keys(text).unwrap();
        let save = ["Ctrl+K", "F5"].map(|text| text.parse().unwrap());
        assert_eq!(keymap.chords(Action::Save), save);
        assert!(keymap.chords(Action::Balance).is_empty());
        assert_eq!(keymap.chords(Action::Open), Keymap::default().chords(Action::Open));
        assert_eq!(parse_keys(&keymap.to_text()), Ok(keymap));
    }

    #[test]
    fn keys_may_change_places() {
        let keymap = parse_keys("(version: 1, keys: {\"Front\": [\"3\"], \"Left\": [\"1\"]})").unwrap();
        assert_eq!(keymap.action("1".parse().unwrap(), false), Some(Action::Left));
    }

    #[test]
    fn every_sign_is_written_so_that_it_reads_back() {
        for key in egui::Key::ALL {
            let chord = Chord { ctrl: true, shift: true, alt: true, key: *key };
            if chord.objection().is_none() {
                let mut keymap = Keymap::default();
                keymap.set(Action::Theme, vec![chord]);
                assert_eq!(parse_keys(&keymap.to_text()), Ok(keymap), "{chord}");
            }
        }
    }

    #[test]
    fn faults_say_where() {
        assert!(fault("\"Safe\": [\"Ctrl+S\"]").starts_with("2:"), "{}", fault("\"Safe\": []"));
        assert!(fault("\"Safe\": []").contains("no action \"Safe\""));
        assert!(fault("\"Save\": [\"Strg+S\"]").contains("no key \"Strg+S\""));
        assert!(fault("\"Save\": [\"Escape\"]").contains("always takes back"));
        assert!(fault("\"Save\": [],\n    \"Save\": []").contains("twice"));
        let clash = fault("\"Balance\": [],\n    \"Flip\": [\"Ctrl+S\"]");
        assert!(clash.starts_with("3:5:") && clash.contains("\"Save\""), "{clash}");
        assert!(parse_keys("(version: 2, keys: {})").is_err());
        assert!(parse_keys("(version: 1, key: {})").unwrap_err().to_string().contains("key"));
    }

    #[test]
    fn a_key_of_a_drag_does_not_clash_with_others() {
        assert!(parse_keys("(version: 1, keys: {\"Flip\": [\"X\"]})").is_ok());
        assert!(parse_keys("(version: 1, keys: {\"AlongZ\": [\"X\"]})").is_err());
    }
}
