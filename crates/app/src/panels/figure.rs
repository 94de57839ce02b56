//! Where the figure stands, and its hips.

use edit::{Command, Request};
use egui::Ui;
use glam::DVec3;
use kin::Interval;
use rig::{Bone, Mechanics};

use super::percent::Percent;
use super::row::Ink;
use super::{Sheet, row};
use crate::number::Number;
use crate::rail::{Change, Rail};
use crate::viewport::balance;

impl Sheet<'_> {
    pub(super) fn figure(&mut self, ui: &mut Ui) {
        let place = self.editor.pose().place;
        let tip = "Moves the whole figure with what it holds in the world; metres";
        let moved = self.point(ui, "Place", "Figure place", tip, place.position);
        self.ask_moved(moved, |moved| Command::Place { by: moved.shift(), turn: 0.0 });
        self.turn_figure(ui, place.turn);
        let hips = self.editor.evaluation().frames[Bone::Hips].position;
        let tip = "Moves the hips in the world; limbs in contact hold on; metres";
        let moved = self.point(ui, "Hips", "Hips", tip, hips);
        self.ask_moved(moved, |moved| Command::MoveHips { by: moved.shift() });
        self.balance(ui);
        self.ground(ui);
        self.mechanics(ui);
        self.body(ui);
    }

    /// Whether the figure stands, and the gesture that brings it over its feet.
    fn balance(&mut self, ui: &mut Ui) {
        row::subtitle(ui, "Balance");
        let (words, warns) = balance::words(self.editor);
        let columns = row::next(ui);
        row::text(ui, columns.joint, "Standing", Ink::Plain);
        row::text(ui, columns.rest(), &words, if warns { Ink::Warning } else { Ink::Faint });
        let tip = "Drag: shifts the hips so that the centre of mass comes over the feet in contact";
        let held = egui::Id::unique("balance held");
        let share = ui.data(|data| data.get_temp(held)).unwrap_or(0.0);
        let (dragged, change) = Percent { title: "Balance", name: "Balance amount", tip, share }.show(ui);
        if let Some(Change::Preview(share)) = change {
            ui.data_mut(|data| data.insert_temp(held, share));
        } else if !dragged {
            ui.data_mut(|data| data.remove::<f64>(held));
        }
        self.ask(change, |amount| Command::Balance { amount });
        ui.add_space(4.0);
        ui.horizontal(|ui| {
            let tip = "Shifts the hips so that the centre of mass comes over the feet in contact";
            if ui.button("Balance over the feet").on_hover_text(tip).clicked() {
                self.requests.push(Request::Do(Command::Balance { amount: 1.0 }));
            }
            let tip = "Centre of mass, its plumb line and what the soles enclose on the ground";
            ui.checkbox(&mut self.panels.balance_marks, "Show in the picture").on_hover_text(tip);
        });
    }

    /// What gestures bring along.
    fn mechanics(&mut self, ui: &mut Ui) {
        row::subtitle(ui, "Body mechanics");
        let now = self.editor.document().mechanics;
        let mut on = now.collar_rhythm;
        let tip = "A reach or a turn of the upper arm raises the collar along, from 30 degrees on by a third";
        if ui.checkbox(&mut on, "Collar rises with the arm").on_hover_text(tip).changed() {
            self.requests.push(Request::Mechanics(Mechanics { collar_rhythm: on, ..now }));
        }
        let tip = "How much the torso leans and turns after a reach that the arm alone finds far";
        let held = egui::Id::unique("torso follow held");
        let on_the_way: Option<f64> = ui.data(|data| data.get_temp(held));
        let share = on_the_way.unwrap_or(now.torso_follow);
        let row = Percent { title: "Torso follows", name: "Torso follows", tip, share };
        let (dragged, change) = row.show(ui);
        let set = match change {
            Some(Change::Preview(share)) => {
                ui.data_mut(|data| data.insert_temp(held, share));
                None
            }
            Some(Change::Set(share)) => Some(share),
            // Let go: a setting is one step, however long it was dragged.
            None if !dragged => {
                ui.data_mut(|data| data.remove::<f64>(held));
                on_the_way
            }
            None => None,
        };
        if let Some(torso_follow) = set.filter(|share| *share != now.torso_follow) {
            self.requests.push(Request::Mechanics(Mechanics { torso_follow, ..now }));
        }
    }

    fn turn_figure(&mut self, ui: &mut Ui, turn: f64) {
        let name = "Figure turn";
        let columns = row::next(ui);
        row::text(ui, columns.joint, "Turn", Ink::Plain).on_hover_text("+ turns to the figure's left");
        let circle = Interval::new(-180.0, 180.0);
        let rail = Rail { name, value: turn, span: circle, live: None, wraps: true, rest: 0.0 };
        let wide = egui::Rect::from_min_max(columns.angle.min, columns.rail.max);
        let (of_rail, by_rail) = rail.show(ui, wide);
        let (of_number, by_number) = Number::degrees(name, turn).show(ui, columns.number);
        let first = self.first(ui, of_rail.dragged() || of_number.dragged(), turn);
        self.ask(by_rail.or(by_number).map(|change| relative(change, first, turn)), |turn| Command::Place {
            by: DVec3::ZERO,
            turn,
        });
    }

    /// The value at which the drag began.
    fn first(&self, ui: &Ui, dragged: bool, value: f64) -> f64 {
        let held = egui::Id::unique("figure turn held");
        if dragged {
            return ui.data_mut(|data| *data.get_temp_mut_or(held, value));
        }
        ui.data_mut(|data| data.remove::<f64>(held));
        value
    }
}

/// A goal as a change from where the gesture began.
fn relative(change: Change, first: f64, value: f64) -> Change {
    match change {
        Change::Preview(goal) => Change::Preview(goal - first),
        Change::Set(goal) => Change::Set(goal - value),
    }
}
