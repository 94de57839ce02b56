//! Fingers, joint by joint, and whole handshapes.

use edit::{Command, Finger, Request};
use egui::Ui;
use kin::Interval;
use rig::{Bone, Part, Side};

use super::percent::Percent;
use super::row::Ink;
use super::{Sheet, row};
use crate::labels;
use crate::number::Number;
use crate::rail::{Change, Rail};

/// The fingers as rows name them.
const TITLES: [&str; 5] = ["Thumb", "Index", "Middle", "Ring", "Little"];

impl Sheet<'_> {
    pub(super) fn hand(&mut self, ui: &mut Ui, side: Side) {
        self.curls(ui, side);
        row::subtitle(ui, "Handshape");
        self.handshapes(ui, side);
        self.amount(ui, side);
        row::subtitle(ui, "Fingers");
        let part = match side {
            Side::Left => Part::LeftHand,
            Side::Right => Part::RightHand,
        };
        let fingers: Vec<Bone> = Bone::ALL.into_iter().filter(|bone| bone.part() == part).collect();
        self.joints(ui, &fingers);
    }

    /// The whole hand's curl and spread, and each finger's curl.
    fn curls(&mut self, ui: &mut Ui, side: Side) {
        let word = labels::side(side);
        let editor = self.editor;
        let (figure, first) = (editor.figure(), editor.first());
        let now = edit::curl(figure, editor.pose(), side, None);
        let tip = "All fingers: 0 % straight, 100 % a fist";
        self.curl_row(ui, ("Curl", &format!("{word} hand curl"), tip), now, |to| {
            edit::set_curl(figure, &first.pose, side, None, to, first.locks)
        });
        let now = edit::spread(figure, editor.pose(), side);
        let tip = "0 % side by side, 100 % as far apart as the fingers go";
        self.curl_row(ui, ("Spread", &format!("{word} hand spread"), tip), now, |to| {
            edit::set_spread(figure, &first.pose, side, to, first.locks)
        });
        for (finger, title) in Finger::ALL.into_iter().zip(TITLES) {
            let now = edit::curl(figure, editor.pose(), side, Some(finger));
            let name = format!("{word} {} curl", finger.name());
            let tip = "This finger: 0 % straight, 100 % as in a fist";
            self.curl_row(ui, (title, &name, tip), now, |to| {
                edit::set_curl(figure, &first.pose, side, Some(finger), to, first.locks)
            });
        }
    }

    /// A row of a share that is read off the pose; none for a hand that lacks it.
    fn curl_row(
        &mut self,
        ui: &mut Ui,
        (title, name, tip): (&str, &str, &str),
        share: Option<f64>,
        commands: impl FnOnce(f64) -> Vec<Command>,
    ) {
        let Some(share) = share else { return };
        let (_, change) = Percent { title, name, tip, share }.show(ui);
        self.ask_all(change, commands);
    }

    fn handshapes(&mut self, ui: &mut Ui, side: Side) {
        let amount = *self.panels.amount(side);
        let editor = self.editor;
        ui.scope(|ui| {
            ui.spacing_mut().item_spacing = egui::vec2(4.0, 4.0);
            ui.horizontal_wrapped(|ui| {
                // Words, then the letters of fingerspelling.
                let mut names: Vec<&String> = editor.figure().handshapes.keys().collect();
                names.sort_by_key(|name| name.chars().count() == 1);
                for name in names {
                    let button = egui::Button::new(egui::RichText::new(labels::articulator(name)).size(12.0));
                    let called = format!("{} handshape · {name}", labels::side(side));
                    if ui.add(button).accessible_name(called).clicked() {
                        let command = Command::Handshape { side, name: name.clone(), amount };
                        self.requests.push(Request::Do(command));
                    }
                }
            });
        });
    }

    fn amount(&mut self, ui: &mut Ui, side: Side) {
        let name = format!("{} handshape amount", labels::side(side));
        let columns = row::next(ui);
        let tip = "How far a click goes from the hand as it is to the shape";
        row::text(ui, columns.joint, "Amount", Ink::Plain).on_hover_text(tip);
        let value = *self.panels.amount(side) * 100.0;
        let span = Interval::new(0.0, 100.0);
        let rail = Rail { name: &name, value, span, live: Some(span), wraps: false, rest: 0.0 };
        let wide = egui::Rect::from_min_max(columns.angle.min, columns.rail.max);
        let (_, by_rail) = rail.show(ui, wide);
        let number = Number { suffix: " %", decimals: 0, ..Number::degrees(&name, value) };
        let (_, by_number) = number.show(ui, columns.number);
        if let Some(Change::Preview(percent) | Change::Set(percent)) = by_rail.or(by_number) {
            *self.panels.amount(side) = percent.clamp(0.0, 100.0) / 100.0;
        }
    }
}
