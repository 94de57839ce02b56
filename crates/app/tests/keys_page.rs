//! The guide's page of keys holds the keys as they are by default. `UPDATE_SNAPSHOTS=1` writes them anew.
#![allow(clippy::unwrap_used)]

use std::fmt::Write as _;
use std::path::Path;

use app::{Action, Group, Keymap};

const FROM: &str = "<!-- keys -->\n";
const TO: &str = "<!-- end of keys -->";

/// A table for each group: keys, what they do, and the name in `keys.ron`.
fn tables() -> String {
    let keymap = Keymap::default();
    let mut text = String::new();
    for group in Group::ALL {
        write!(text, "\n### {}\n\n| keys | what | name |\n|---|---|---|\n", group.words()).unwrap();
        for action in Action::of_group(group) {
            let keys = keymap.chords(action).iter().map(|chord| format!("`{chord}`"));
            let keys: Vec<String> = keys.collect();
            let keys = if keys.is_empty() { "–".to_owned() } else { keys.join(", ") };
            let (words, explained) = (action.words(), action.explained());
            writeln!(text, "| {keys} | **{words}**: {explained} | `{}` |", action.name()).unwrap();
        }
    }
    text.push('\n');
    text
}

#[test]
fn the_page_holds_every_key() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/guide/keys.md");
    let page = std::fs::read_to_string(&path).unwrap();
    let (before, rest) = page.split_once(FROM).unwrap();
    let (found, after) = rest.split_once(TO).unwrap();
    if std::env::var_os("UPDATE_SNAPSHOTS").is_some() {
        std::fs::write(path, format!("{before}{FROM}{}{TO}{after}", tables())).unwrap();
        return;
    }
    assert_eq!(found, tables(), "run this test with UPDATE_SNAPSHOTS=1");
}
