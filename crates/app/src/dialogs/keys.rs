//! The table of keys: click one and press another.

use egui::{Button, Context, FocusDirection, Key, RichText, ScrollArea, TextEdit, Ui};

use crate::action::{Action, Group};
use crate::keymap::{Chord, Keymap, Pressed, defaults};
use crate::{sign, theme};

/// What the table waits for and tells.
#[derive(Default)]
pub struct KeyTable {
    /// The action that is to get the next key, and which of its keys that takes the place of.
    asking: Option<(Action, usize)>,
    /// A key that another action has: for whom, which place, the key, and whose it is.
    clash: Option<(Action, usize, Chord, Action)>,
    told: String,
    sought: String,
}

impl KeyTable {
    /// Takes the key that is waited for, before any control sees it. Escape leaves things as they are.
    pub fn listen(&mut self, ctx: &Context, keymap: &mut Keymap) {
        let Some((action, index)) = self.asking else { return };
        let pressed = ctx.input(|i| i.events.iter().find_map(Pressed::of));
        let Some(chord) = pressed.map(|pressed| pressed.chord) else { return };
        ctx.input_mut(|i| i.events.retain(|event| Pressed::of(event).is_none()));
        ctx.memory_mut(|m| m.move_focus(FocusDirection::None));
        if chord.key == Key::Escape {
            self.asking = None;
            self.told.clear();
        } else if let Some(why) = chord.objection() {
            // A modifier alone is the beginning of a chord.
            self.told = format!("{}: {why}", chord.shown());
        } else if let Some(other) = keymap.clash(action, chord) {
            self.asking = None;
            self.clash = Some((action, index, chord, other));
        } else {
            self.asking = None;
            self.give(keymap, action, index, chord);
        }
        ctx.request_repaint();
    }

    fn give(&mut self, keymap: &mut Keymap, action: Action, index: usize, chord: Chord) {
        let mut chords = keymap.chords(action).to_vec();
        match chords.get_mut(index) {
            Some(place) => *place = chord,
            None => chords.push(chord),
        }
        keymap.set(action, chords);
        self.told = format!("{} does: {}", chord.shown(), action.words());
    }

    /// Shows the table in so many points of height.
    pub fn show(&mut self, ui: &mut Ui, keymap: &mut Keymap, height: f32) {
        ui.horizontal(|ui| {
            let field = TextEdit::singleline(&mut self.sought).hint_text("Search").desired_width(180.0);
            ui.add(field).accessible_name("Search the keys");
            if ui.button("All as by default").clicked() {
                *keymap = Keymap::default();
                self.told = "All keys are as by default".to_owned();
            }
        });
        self.tell(ui, keymap);
        ui.add_space(2.0);
        ScrollArea::vertical().max_height(height - 64.0).auto_shrink([false, true]).show(ui, |ui| {
            for group in Group::ALL {
                self.group(ui, keymap, group);
            }
        });
    }

    /// What is waited for, or what came of it; one line that is always there, so that the table stays in place.
    fn tell(&mut self, ui: &mut Ui, keymap: &mut Keymap) {
        ui.horizontal(|ui| {
            ui.set_min_height(22.0);
            if let Some((action, index, chord, other)) = self.clash {
                let words = format!("{} does “{}” already.", chord.shown(), other.words());
                sign::fault(ui, theme::of(ui).warning);
                ui.label(RichText::new(words).color(theme::of(ui).warning));
                if ui.button("Take it").clicked() {
                    let left = keymap.chords(other).iter().copied().filter(|c| *c != chord).collect();
                    keymap.set(other, left);
                    self.give(keymap, action, index, chord);
                    self.clash = None;
                }
                if ui.button("Leave it").clicked() {
                    self.clash = None;
                }
            } else if let Some((action, _)) = self.asking {
                ui.strong(format!("Press a key for “{}”. Esc leaves it.", action.words()));
            } else if self.told.is_empty() {
                ui.weak("Click a key and press another.");
            } else {
                ui.label(&self.told);
            }
        });
    }

    fn group(&mut self, ui: &mut Ui, keymap: &mut Keymap, group: Group) {
        let sought = self.sought.to_lowercase();
        let found = |action: &Action| {
            let text = format!("{} {} {}", action.words(), action.name(), keymap.all_shown(*action));
            text.to_lowercase().contains(&sought)
        };
        let actions: Vec<Action> = Action::of_group(group).filter(found).collect();
        if actions.is_empty() {
            return;
        }
        ui.add_space(6.0);
        ui.label(RichText::new(group.words()).color(theme::of(ui).accent));
        egui::Grid::new(group.words()).num_columns(2).min_col_width(190.0).spacing([12.0, 3.0]).show(
            ui,
            |ui| {
                for action in actions {
                    ui.label(action.words()).on_hover_text(action.explained());
                    ui.horizontal(|ui| self.chords(ui, keymap, action));
                    ui.end_row();
                }
            },
        );
    }

    fn chords(&mut self, ui: &mut Ui, keymap: &mut Keymap, action: Action) {
        let chords = keymap.chords(action).to_vec();
        for (index, chord) in chords.iter().enumerate() {
            let asked = self.asking == Some((action, index));
            let words = if asked { "…".to_owned() } else { chord.shown() };
            let name = format!("{} for {}", chord.shown(), action.words());
            if ui.add(Button::new(words).selected(asked)).accessible_name(name).clicked() {
                self.ask(action, index);
            }
            let remove = ui.add(Button::new("×").frame_when_inactive(false).small());
            let name = format!("Remove {} from {}", chord.shown(), action.words());
            if remove.on_hover_text("Takes this key away").accessible_name(name).clicked() {
                keymap.set(action, chords.iter().copied().filter(|other| other != chord).collect());
            }
        }
        let asked = self.asking == Some((action, chords.len()));
        let add =
            ui.add(Button::new(if asked { "…" } else { "+" }).frame_when_inactive(false).selected(asked));
        let name = format!("Another key for {}", action.words());
        if add.on_hover_text("One more key").accessible_name(name).clicked() {
            self.ask(action, chords.len());
        }
        if chords != defaults(action) {
            let name = format!("{} as by default", action.words());
            if ui.small_button("Default").accessible_name(name).clicked() {
                self.give_default(keymap, action);
            }
        }
    }

    fn ask(&mut self, action: Action, index: usize) {
        (self.asking, self.clash) = (Some((action, index)), None);
    }

    /// Back to the keys by default, without those that others have by now.
    fn give_default(&mut self, keymap: &mut Keymap, action: Action) {
        let (free, taken): (Vec<Chord>, Vec<Chord>) =
            defaults(action).into_iter().partition(|chord| keymap.clash(action, *chord).is_none());
        keymap.set(action, free);
        self.told = match taken.first() {
            Some(chord) => format!("{} stays with another action", chord.shown()),
            None => format!("“{}” has its keys by default", action.words()),
        };
    }
}
