//! A row for a share of something, in per cent.

use edit::{Command, Request};
use egui::Ui;
use kin::Interval;

use super::Sheet;
use super::row::{self, Ink};
use crate::number::Number;
use crate::rail::{Change, Rail};

/// A share as the panel shows it.
#[derive(Clone, Copy, Debug)]
pub struct Percent<'a> {
    /// What the row is called.
    pub title: &'a str,
    /// Its accessible name.
    pub name: &'a str,
    /// What it does.
    pub tip: &'a str,
    /// 0 is nothing, 1 all; may be beyond.
    pub share: f64,
}

impl Percent<'_> {
    /// Shows the row: whether it is being dragged, and the share that is asked for, from 0 to 1.
    pub fn show(&self, ui: &mut Ui) -> (bool, Option<Change>) {
        let columns = row::next(ui);
        row::text(ui, columns.joint, self.title, Ink::Plain).on_hover_text(self.tip);
        let (name, value) = (self.name, self.share * 100.0);
        let live = Interval::new(0.0, 100.0);
        let span = live.reaching(value.clamp(-50.0, 150.0));
        let rail = Rail { name, value, span, live: Some(live), wraps: false, rest: 0.0 };
        let wide = egui::Rect::from_min_max(columns.angle.min, columns.rail.max);
        let (of_rail, by_rail) = rail.show(ui, wide);
        let number = Number { suffix: " %", decimals: 0, ..Number::degrees(name, value) };
        let (of_number, by_number) = number.show(ui, columns.number);
        let share = |percent: f64| live.clamp(percent) / 100.0;
        let change = by_rail.or(by_number).map(|change| match change {
            Change::Preview(percent) => Change::Preview(share(percent)),
            Change::Set(percent) => Change::Set(share(percent)),
        });
        (of_rail.dragged() || of_number.dragged(), change)
    }
}

impl Sheet<'_> {
    /// Asks for the commands of a changed value as one step. They must start from the editor's first document.
    pub(super) fn ask_all(&mut self, change: Option<Change>, commands: impl FnOnce(f64) -> Vec<Command>) {
        match change {
            Some(Change::Preview(value)) => self.requests.push(Request::PreviewAll(commands(value))),
            Some(Change::Set(value)) => {
                self.requests.extend([Request::PreviewAll(commands(value)), Request::Commit]);
            }
            None => {}
        }
    }
}
