//! The sheet of gestures and keys, in as many columns as there is room for.

use egui::{RichText, ScrollArea, TextEdit, Ui};

use super::{Dialogs, Paper};
use crate::action::{Action, Group};
use crate::keymap::Keymap;
use crate::{keycap, theme};

/// What the pointer does, which no keymap changes.
const GESTURES: [(&str, &[(&str, &str)]); 3] = [
    (
        "On the figure",
        &[
            ("Drag", "what you grab follows the pointer"),
            ("Drag a target", "reach: the limb follows"),
            ("Drag a ring", "turn about that axis"),
            ("Click", "choose; its rings show"),
            ("Shift+Click", "choose one more"),
        ],
    ),
    (
        "The view",
        &[
            ("Drag beside", "turn; other buttons anywhere"),
            ("Shift+Drag beside", "slide"),
            ("Wheel", "nearer and farther, to the pointer"),
        ],
    ),
    (
        "In the panel",
        &[
            ("Drag a rail", "turn; Shift turns a tenth as far"),
            ("Double-click", "back to 0"),
            ("Left Right", "one degree; with Shift a tenth"),
            ("Click a number", "type it; or drag it"),
        ],
    ),
];

/// The same in a window on a chain.
const CHAIN_GESTURES: [(&str, &[(&str, &str)]); 4] = [
    (
        "On the chain",
        &[
            ("Click", "choose the joint of a link"),
            ("Drag a link", "reach: the joints before it follow"),
            ("Drag a ring", "turn about that axis"),
            ("Drag an arrow", "slide along it"),
        ],
    ),
    (
        "Driving by keys",
        &[
            ("Space", "the next joint, round and round"),
            ("Shift+Space", "the joint before"),
            ("Up Down", "turn or slide it; the longer, the faster"),
            ("Left Right", "slide it; on the root, move the chain"),
        ],
    ),
    (GESTURES[1].0, GESTURES[1].1),
    (GESTURES[2].0, GESTURES[2].1),
];

/// What goes with the keys of a drag.
const DRAGGING: [(&str, &str); 5] = [
    ("Shift", "a tenth as far"),
    ("Ctrl", "snaps"),
    ("0–9 . -", "how far"),
    ("Enter", "done"),
    ("Esc Right click", "as if it had never been"),
];

/// What the sheet takes besides its rows, points: heading, search, button, margins.
const FRAME: f32 = 170.0;
/// A column is not narrower.
const COLUMN: f32 = 290.0;
/// The part of a column that keys take at least.
const KEYS: f32 = 104.0;

/// A heading with its rows: keys, and what they do.
struct Block {
    title: &'static str,
    rows: Vec<(Vec<String>, String)>,
}

impl Dialogs {
    /// Shows the sheet; whether it is to close.
    pub(super) fn sheet(&mut self, ui: &mut Ui, keymap: &Keymap) -> bool {
        ui.horizontal(|ui| {
            ui.heading("Gestures and shortcuts");
            ui.add_space(12.0);
            let field = TextEdit::singleline(&mut self.sought).hint_text("Search").desired_width(180.0);
            let response = ui.add(field).accessible_name("Search gestures and shortcuts");
            if std::mem::take(&mut self.fresh) {
                self.sought.clear();
                response.request_focus();
            }
        });
        ui.add_space(4.0);
        let blocks = blocks(self.paper, keymap, &self.sought.to_lowercase());
        let room = (ui.ctx().content_rect().height() - FRAME).max(120.0);
        let count = ((ui.available_width() / COLUMN) as usize).clamp(1, 3);
        let scroll = ScrollArea::vertical().max_height(room).min_scrolled_height(room);
        scroll.auto_shrink([false, true]).show(ui, |ui| {
            if blocks.is_empty() {
                ui.label("Nothing has these words.");
            }
            ui.columns(count, |columns| {
                for (column, blocks) in columns.iter_mut().zip(dealt(&blocks, count)) {
                    blocks.iter().for_each(|block| block.show(column));
                }
            });
        });
        ui.add_space(8.0);
        ui.button("Close").clicked()
    }
}

fn blocks(paper: Paper, keymap: &Keymap, sought: &str) -> Vec<Block> {
    let (gestures, dragging) = match paper {
        // Numbers are not typed into a drag of a chain.
        Paper::Chain => (&CHAIN_GESTURES[..], &[DRAGGING[0], DRAGGING[1], DRAGGING[4]][..]),
        _ => (&GESTURES[..], &DRAGGING[..]),
    };
    let words = |action: &Action| match paper {
        Paper::Chain => crate::chains::words(*action),
        _ => action.words(),
    };
    let known = |action: &Action| paper == Paper::Pose || crate::chains::knows(*action);
    let gestures = gestures.iter().map(|(title, rows)| Block {
        title,
        rows: rows.iter().map(|(what, does)| (vec![(*what).to_owned()], (*does).to_owned())).collect(),
    });
    let fixed = |(what, does): &(&str, &str)| (vec![(*what).to_owned()], (*does).to_owned());
    let keys = Group::ALL.into_iter().map(|group| {
        let bound =
            Action::of_group(group).filter(|action| known(action) && !keymap.chords(*action).is_empty());
        let rows = bound.map(|action| (keys_of(keymap, action), words(&action).to_owned()));
        let besides = if group == Group::Drag { dragging } else { &[] };
        Block { title: group.words(), rows: rows.chain(besides.iter().map(fixed)).collect() }
    });
    let mut blocks: Vec<Block> = gestures.chain(keys).collect();
    for block in &mut blocks {
        let title = block.title.to_lowercase();
        let has = |words: &str| words.to_lowercase().contains(sought);
        block
            .rows
            .retain(|(keys, does)| title.contains(sought) || has(does) || keys.iter().any(|key| has(key)));
    }
    blocks.retain(|block| !block.rows.is_empty());
    blocks
}

fn keys_of(keymap: &Keymap, action: Action) -> Vec<String> {
    keymap.chords(action).iter().map(|chord| chord.shown()).collect()
}

/// Deals blocks to columns in order, each about as long.
fn dealt(blocks: &[Block], count: usize) -> Vec<&[Block]> {
    let length = |blocks: &[Block]| blocks.iter().map(|block| block.rows.len() + 2).sum::<usize>();
    let mut rest = blocks;
    let mut columns = Vec::new();
    for left in (1..=count).rev() {
        let share = length(rest).div_ceil(left);
        let fits = |n: &usize| length(&rest[..*n]) <= share + 2;
        let taken = if left == 1 {
            rest.len()
        } else {
            (1..=rest.len()).filter(fits).max().unwrap_or(rest.len().min(1))
        };
        let (column, others) = rest.split_at(taken);
        columns.push(column);
        rest = others;
    }
    columns
}

impl Block {
    fn show(&self, ui: &mut Ui) {
        ui.add_space(8.0);
        ui.label(RichText::new(self.title).color(theme::of(ui).accent).strong());
        for (keys, does) in &self.rows {
            ui.horizontal_wrapped(|ui| {
                ui.spacing_mut().item_spacing.x = 4.0;
                let left = ui.cursor().left();
                for key in keys {
                    keycap::show(ui, key);
                }
                ui.add_space((KEYS - (ui.cursor().left() - left)).max(2.0));
                ui.add(egui::Label::new(RichText::new(does).size(12.5)).wrap());
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sheet_holds_every_key_and_finds_by_word_and_by_key() {
        let keymap = Keymap::default();
        let rows: usize = blocks(Paper::Pose, &keymap, "").iter().map(|block| block.rows.len()).sum();
        let gestures: usize = GESTURES.iter().map(|(_, rows)| rows.len()).sum();
        let bound = Action::ALL.iter().filter(|action| !keymap.chords(**action).is_empty()).count();
        assert_eq!(rows, gestures + DRAGGING.len() + bound);
        let found = blocks(Paper::Pose, &keymap, "ctrl+shift+z");
        assert_eq!(found.len(), 1);
        assert_eq!(found[0].rows[0].1, Action::Redo.words());
        assert!(blocks(Paper::Pose, &keymap, "xyzzy").is_empty());
    }

    #[test]
    fn columns_hold_every_block_once_in_order() {
        let blocks = blocks(Paper::Pose, &Keymap::default(), "");
        for count in 1..=3 {
            let columns = dealt(&blocks, count);
            assert_eq!(columns.len(), count);
            assert_eq!(columns.iter().map(|column| column.len()).sum::<usize>(), blocks.len());
            assert!(columns.iter().all(|column| !column.is_empty()));
        }
    }
}
