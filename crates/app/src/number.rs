//! A number that is typed or dragged, with an accessible name.

use egui::{DragValue, Rect, Response, Ui};

use crate::rail::Change;

/// A number field.
#[derive(Clone, Copy, Debug)]
pub struct Number<'a> {
    /// Its accessible name.
    pub name: &'a str,
    /// The value that it shows.
    pub value: f64,
    /// What one point of a drag is worth.
    pub speed: f64,
    /// Decimals shown.
    pub decimals: usize,
    /// Shown before it.
    pub prefix: &'a str,
    /// Shown behind it.
    pub suffix: &'a str,
}

impl<'a> Number<'a> {
    /// An angle in degrees.
    pub fn degrees(name: &'a str, value: f64) -> Number<'a> {
        Number { name, value, speed: 0.5, decimals: 1, prefix: "", suffix: "°" }
    }

    /// A coordinate in metres.
    pub fn metres(name: &'a str, value: f64, axis: &'a str) -> Number<'a> {
        Number { name, value, speed: 0.002, decimals: 3, prefix: axis, suffix: "" }
    }

    /// Shows the field in a rectangle.
    pub fn show(&self, ui: &mut Ui, rect: Rect) -> (Response, Option<Change>) {
        let mut value = if self.value.is_finite() { self.value } else { 0.0 };
        // Minus zero is still zero to the reader.
        let shown = 0.5 * 10_f64.powi(-(self.decimals as i32));
        if value.abs() < shown {
            value = 0.0;
        }
        let field = DragValue::new(&mut value)
            .speed(self.speed)
            .fixed_decimals(self.decimals)
            .prefix(self.prefix)
            .suffix(self.suffix)
            .update_while_editing(false)
            .custom_parser(typed)
            .min_size(rect.size());
        // Named, not counted: a row that comes or goes above must not end a drag.
        let place = egui::UiBuilder::new().scope_id(egui::Id::unique(("number", self.name))).max_rect(rect);
        let response = ui.scope_builder(place, |ui| ui.add_sized(rect.size(), field)).inner;
        let response = response.accessible_name(self.name);
        let change = match (response.changed(), response.dragged()) {
            (false, _) => None,
            (true, true) => Some(Change::Preview(value)),
            (true, false) => Some(Change::Set(value)),
        };
        (response, change)
    }
}

/// The number that a text means: with a decimal comma as well, and with or without its unit.
fn typed(text: &str) -> Option<f64> {
    let text = text.trim().replace(',', ".").replace('\u{2212}', "-");
    let bare = ["°", "deg", "m"].iter().find_map(|unit| text.strip_suffix(unit)).unwrap_or(&text);
    bare.trim_end().parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_people_write_them() {
        for text in ["-12.5", "-12,5", " \u{2212}12,5 ", "-12.5°", "-12.5 deg", "-12.5m"] {
            assert_eq!(typed(text), Some(-12.5), "{text}");
        }
        for text in ["", "abc", "90*2", "1,2,3", "°"] {
            assert_eq!(typed(text), None, "{text}");
        }
    }
}
