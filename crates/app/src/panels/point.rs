//! Three numbers for a place in the world.

use egui::{Rect, Ui, pos2};
use glam::DVec3;

use super::row::Ink;
use super::{Sheet, row};
use crate::number::Number;
use crate::rail::Change;

/// A place that was typed or is being dragged.
#[derive(Clone, Copy, Debug)]
pub struct Moved {
    /// Where it was when the gesture began, metres.
    pub first: DVec3,
    /// Where it should be, metres.
    pub goal: DVec3,
    /// Whether the gesture goes on.
    pub preview: bool,
}

impl Moved {
    /// From the first place to the goal.
    pub fn shift(&self) -> DVec3 {
        self.goal - self.first
    }
}

impl Sheet<'_> {
    /// A row with a place in metres; `part` names it: `Left arm target`.
    pub(super) fn point(&self, ui: &mut Ui, title: &str, part: &str, tip: &str, at: DVec3) -> Option<Moved> {
        let columns = row::next(ui);
        row::text(ui, columns.joint, title, Ink::Plain).on_hover_text(tip);
        let cells = columns.rest();
        let width = (cells.width() - 8.0) / 3.0;
        let held = egui::Id::unique(("held", part));
        let mut moved = None;
        let mut dragged = false;
        for (i, axis) in ["x ", "y ", "z "].into_iter().enumerate() {
            let left = cells.left() + i as f32 * (width + 4.0);
            let cell = Rect::from_min_max(pos2(left, cells.top()), pos2(left + width, cells.bottom()));
            let name = format!("{part} {}", axis.trim());
            let (response, change) = Number::metres(&name, at[i], axis).show(ui, cell);
            dragged |= response.dragged();
            let goal = |first: DVec3, value: f64| {
                let mut goal = first;
                goal[i] = value;
                goal
            };
            match change {
                Some(Change::Preview(value)) => {
                    // The other two stay as they were: where the figure only comes near, `at` has moved.
                    let first = ui.data_mut(|data| *data.get_temp_mut_or(held, at));
                    moved = Some(Moved { first, goal: goal(first, value), preview: true });
                }
                Some(Change::Set(value)) => {
                    moved = Some(Moved { first: at, goal: goal(at, value), preview: false });
                }
                None => {}
            }
        }
        if !dragged {
            ui.data_mut(|data| data.remove::<DVec3>(held));
        }
        moved
    }

    /// Asks for the command that moves a place.
    pub(super) fn ask_moved(&mut self, moved: Option<Moved>, command: impl FnOnce(Moved) -> edit::Command) {
        self.requests.extend(moved.map(|moved| {
            let command = command(moved);
            if moved.preview { edit::Request::Preview(command) } else { edit::Request::Do(command) }
        }));
    }
}
