//! Where the figure stands, and its hips.

use edit::{Command, Request};
use egui::Ui;
use glam::DVec3;
use kin::Interval;
use rig::Bone;

use super::row::Ink;
use super::{Sheet, row};
use crate::number::Number;
use crate::rail::{Change, Rail};

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
        ui.add_space(4.0);
        let balance = ui
            .button("Balance over the feet")
            .on_hover_text("Shifts the hips so that the centre of mass comes over the feet in contact");
        if balance.clicked() {
            self.requests.push(Request::Do(Command::Balance { amount: 1.0 }));
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
