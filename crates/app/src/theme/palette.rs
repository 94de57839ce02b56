//! The colours of the dark and of the light look, and how well they can be told apart.

use egui::Color32;
use rig::Side;

/// The colours of one look. No state is told by a colour alone.
#[derive(Clone, PartialEq, Debug)]
pub struct Palette {
    /// What is chosen or under the hand.
    pub accent: Color32,
    /// What the figure can't do, and what went wrong.
    pub warning: Color32,
    /// The left side of the body.
    pub left: Color32,
    /// Its right side.
    pub right: Color32,
    /// Panels.
    pub panel: Color32,
    /// Bars above and below.
    pub bar: Color32,
    /// Dialogs, menus and tips.
    pub window: Color32,
    /// Headers of sections, and rows that are chosen.
    pub header: Color32,
    /// A header with the pointer on it.
    pub header_hovered: Color32,
    /// Text fields and lists.
    pub well: Color32,
    /// The rails of sliders.
    pub rail: Color32,
    /// The part of a rail that a slider can reach now.
    pub live: Color32,
    /// Lines between things, and around dialogs.
    pub line: Color32,
    /// Text.
    pub text: Color32,
    /// Text that explains.
    pub faint_text: Color32,
    /// Headings and what the pointer is on.
    pub strong_text: Color32,
    /// Buttons at rest, under the pointer, pressed, and with an open menu.
    pub button: [Color32; 4],
    /// The button that does what a dialog is for, and what is chosen in a list.
    pub selection: Color32,
    /// Text on that.
    pub selection_text: Color32,
}

const fn gray(level: u8) -> Color32 {
    Color32::from_gray(level)
}

/// Light text on dark grey.
pub const DARK: Palette = Palette {
    accent: Color32::from_rgb(245, 166, 66),
    warning: Color32::from_rgb(255, 124, 124),
    left: Color32::from_rgb(236, 92, 84),
    right: Color32::from_rgb(72, 164, 236),
    panel: gray(34),
    bar: gray(28),
    window: gray(38),
    header: gray(44),
    header_hovered: gray(52),
    well: gray(22),
    rail: gray(22),
    live: gray(104),
    line: gray(64),
    text: gray(212),
    faint_text: gray(160),
    strong_text: gray(240),
    button: [gray(54), gray(68), gray(82), gray(62)],
    selection: Color32::from_rgb(116, 78, 30),
    selection_text: Color32::from_rgb(255, 224, 192),
};

/// Dark text on light grey.
pub const LIGHT: Palette = Palette {
    accent: Color32::from_rgb(146, 68, 0),
    warning: Color32::from_rgb(172, 16, 24),
    left: Color32::from_rgb(192, 44, 38),
    right: Color32::from_rgb(16, 98, 176),
    panel: gray(244),
    bar: gray(230),
    window: gray(250),
    header: gray(224),
    header_hovered: gray(214),
    well: gray(255),
    rail: gray(204),
    live: gray(108),
    line: gray(176),
    text: gray(36),
    faint_text: gray(84),
    strong_text: gray(8),
    button: [gray(218), gray(206), gray(188), gray(208)],
    selection: Color32::from_rgb(255, 214, 168),
    selection_text: Color32::from_rgb(60, 28, 0),
};

impl Palette {
    /// The colour of a side.
    pub const fn side(&self, side: Side) -> Color32 {
        match side {
            Side::Left => self.left,
            Side::Right => self.right,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance by WCAG 2, of a colour without transparency.
    fn luminance(color: Color32) -> f64 {
        let linear = |c: u8| {
            let c = f64::from(c) / 255.0;
            if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        };
        0.2126 * linear(color.r()) + 0.7152 * linear(color.g()) + 0.0722 * linear(color.b())
    }

    fn contrast(a: Color32, b: Color32) -> f64 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn black_on_white_is_twenty_one() {
        assert!((contrast(Color32::BLACK, Color32::WHITE) - 21.0).abs() < 1e-9);
    }

    #[test]
    fn text_is_read_and_marks_are_seen_in_both_looks() {
        for (look, p) in [("dark", &DARK), ("light", &LIGHT)] {
            let grounds = [
                ("panel", p.panel),
                ("bar", p.bar),
                ("window", p.window),
                ("header", p.header),
                ("well", p.well),
            ];
            let words = [
                ("text", p.text),
                ("faint text", p.faint_text),
                ("strong text", p.strong_text),
                ("accent", p.accent),
                ("warning", p.warning),
            ];
            let check = |what: (&str, Color32), on: (&str, Color32), least: f64| {
                let found = contrast(what.1, on.1);
                assert!(found >= least, "{look}: {} on {} has {found:.2}, not {least}", what.0, on.0);
            };
            for ground in grounds {
                words.iter().for_each(|word| check(*word, ground, 4.5));
                check(("left", p.left), ground, 3.0);
                check(("right", p.right), ground, 3.0);
            }
            for button in p.button {
                check(("text", p.text), ("a button", button), 4.5);
            }
            check(("strong text", p.strong_text), ("a hovered header", p.header_hovered), 4.5);
            check(("selected text", p.selection_text), ("the selection", p.selection), 4.5);
            for mark in [("accent", p.accent), ("live", p.live), ("warning", p.warning)] {
                check(mark, ("a rail", p.rail), 3.0);
            }
        }
    }
}
