//! What the figure's body is: presets and sliders.

use edit::{Clay, Request};
use egui::{CollapsingHeader, Ui};
use kin::Interval;
use rig::{Body, BodySlider};

use super::Sheet;
use super::limb::choice;
use super::row::{self, Ink};
use crate::labels;
use crate::number::Number;
use crate::rail::{Change, Rail};

/// How a slider is shown.
struct Shown {
    title: &'static str,
    tip: &'static str,
    /// From the body's unit to the panel's.
    scale: f64,
    suffix: &'static str,
    decimals: usize,
    /// The ends of the rail, in the panel's unit.
    span: Interval,
}

impl Shown {
    fn of(slider: BodySlider) -> Shown {
        let both = |title, tip| (title, tip, 100.0, " %", 0, -100.0, 100.0);
        let factor = |title, tip, min, max| (title, tip, 100.0, " %", 0, min, max);
        let (title, tip, scale, suffix, decimals, min, max) = match slider {
            BodySlider::Stature => ("Stature", "Sole to crown", 100.0, " cm", 0, 80.0, 220.0),
            BodySlider::Sex => both("Sex", "Sex characteristics: male to the left, female to the right"),
            BodySlider::Build => both("Build", "Slender to the left, heavy to the right"),
            BodySlider::Muscle => both("Muscle", "Slight to the left, athletic to the right"),
            BodySlider::Age => both("Age", "A child's soft forms to the left, an old person's to the right"),
            BodySlider::Heads => {
                ("Heads", "How many heads tall: stature over chin to crown", 1.0, "", 2, 4.0, 9.0)
            }
            BodySlider::Arms => factor("Arms", "Length of upper arms and forearms", 70.0, 130.0),
            BodySlider::Legs => {
                factor("Legs", "Length of thighs and shins; the stature is kept", 70.0, 130.0)
            }
            BodySlider::Shoulders => factor("Shoulders", "Breadth of the shoulders", 80.0, 120.0),
            BodySlider::Hips => factor("Hips", "Breadth of the hips", 80.0, 120.0),
            BodySlider::Flexibility => factor("Flexibility", "Ranges of the joints", 50.0, 130.0),
        };
        Shown { title, tip, scale, suffix, decimals, span: Interval::new(min, max) }
    }
}

impl Sheet<'_> {
    /// The section of the body, closed at first: what it is made of is read when it opens.
    pub(super) fn body(&mut self, ui: &mut Ui) {
        ui.add_space(4.0);
        let header = CollapsingHeader::new("Body").id_salt("body of the figure");
        let shown = header.show_unindented(ui, |ui| match self.editor.clay() {
            Some(clay) => {
                self.preset(ui);
                let now = self.editor.document().body;
                for slider in BodySlider::ALL {
                    self.body_slider(ui, clay, &now, slider);
                }
                ui.add_space(4.0);
                self.body_buttons(ui, &now);
            }
            None => {
                ui.label(self.panels.body_fault.clone().unwrap_or_default());
            }
        });
        // While it opens, too: then what it is made of is there once it is open.
        self.panels.body_open = shown.body_response.is_some();
    }

    fn preset(&mut self, ui: &mut Ui) {
        let columns = row::next(ui);
        row::text(ui, columns.joint, "Preset", Ink::Plain);
        let now = self.editor.document().body;
        let presets = presets();
        let chosen = presets.iter().find(|(_, body)| *body == now);
        let title = chosen.map_or("Own", |(title, _)| title.as_str());
        let taken = choice(ui, columns.rest(), "Body preset", title, |ui| {
            let of_list = |(title, body): &(String, Body)| {
                ui.selectable_label(*body == now, title.as_str()).clicked().then_some(*body)
            };
            presets.iter().filter_map(of_list).last()
        });
        self.requests.extend(taken.flatten().map(Request::Body));
    }

    fn body_slider(&mut self, ui: &mut Ui, clay: &Clay, now: &Body, slider: BodySlider) {
        let Some(neutral) = clay.neutral(slider) else { return };
        let shown = Shown::of(slider);
        let name = format!("Body {}", slider.name());
        let columns = row::next(ui);
        let (tip, ink) = if clay.has_shapes(slider) {
            (shown.tip.to_owned(), Ink::Plain)
        } else {
            (
                format!("{}; the skin has no shapes for it, so it changes masses and joints only", shown.tip),
                Ink::Faint,
            )
        };
        row::text(ui, columns.joint, shown.title, ink).on_hover_text(tip);
        let value = now.given(slider).unwrap_or(neutral) * shown.scale;
        let live = slider.range().scaled(shown.scale);
        let rest = neutral * shown.scale;
        let span = shown.span.reaching(value);
        let rail = Rail { name: &name, value, span, live: Some(live), wraps: false, rest };
        let wide = egui::Rect::from_min_max(columns.angle.min, columns.rail.max);
        let (_, by_rail) = rail.show(ui, wide);
        let number =
            Number { suffix: shown.suffix, decimals: shown.decimals, ..Number::degrees(&name, value) };
        let (_, by_number) = number.show(ui, columns.number);
        let first = self.editor.first().body;
        let body = |value: f64| {
            // Back where it was: as if it had never been moved.
            let at_rest = (value - rest).abs() < 1e-9;
            first.with(slider, if at_rest { f64::NAN } else { value / shown.scale })
        };
        self.requests.extend(by_rail.or(by_number).map(|change| match change {
            Change::Preview(value) => Request::PreviewBody(body(value)),
            Change::Set(value) => Request::Body(body(value)),
        }));
    }

    fn body_buttons(&mut self, ui: &mut Ui, now: &Body) {
        ui.horizontal(|ui| {
            let tip = "Every slider back to where the figure is as it was made";
            if ui
                .add_enabled(!now.is_as_is(), egui::Button::new("Reset the body"))
                .on_hover_text(tip)
                .clicked()
            {
                self.requests.push(Request::Body(Body::AS_IS));
            }
            let tip = "Writes a figure file that makes this body of the figure";
            if ui.button("Save figure as…").on_hover_text(tip).clicked() {
                self.panels.save_figure = true;
            }
        });
    }
}

/// Titles and bodies of the shipped figures.
fn presets() -> &'static [(String, Body)] {
    static PRESETS: std::sync::OnceLock<Vec<(String, Body)>> = std::sync::OnceLock::new();
    PRESETS.get_or_init(|| {
        let shipped = interchange::figure::shipped_bodies().into_iter();
        shipped.map(|(file, body)| (labels::shipped_figure(file), body)).collect()
    })
}
