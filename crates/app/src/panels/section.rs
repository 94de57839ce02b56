//! The sections of the panel and their headers.

use edit::{Command, Request};
use egui::{Align2, FontId, Pos2, Rect, Role, Sense, Ui, UiBuilder, WidgetInfo, pos2, vec2};
use rig::{Contact, Part, Side};

use super::glyph;
use crate::{labels, theme};

/// A section of the panel.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Section {
    /// Where the figure stands, and its hips.
    Figure,
    /// A part of the body.
    Body(Part),
}

impl Section {
    /// Every section, as they stand from top to bottom.
    pub const ALL: [Section; 9] = [
        Section::Figure,
        Section::Body(Part::Torso),
        Section::Body(Part::Head),
        Section::Body(Part::LeftArm),
        Section::Body(Part::RightArm),
        Section::Body(Part::LeftHand),
        Section::Body(Part::RightHand),
        Section::Body(Part::LeftLeg),
        Section::Body(Part::RightLeg),
    ];

    /// Place in [`Section::ALL`].
    pub fn index(self) -> usize {
        match self {
            Section::Figure => 0,
            Section::Body(part) => 1 + part as usize,
        }
    }

    /// The title.
    pub fn title(self) -> &'static str {
        match self {
            Section::Figure => "Figure",
            Section::Body(part) => labels::part(part),
        }
    }

    fn side(self) -> Option<Side> {
        match self {
            Section::Body(Part::LeftArm | Part::LeftHand | Part::LeftLeg) => Some(Side::Left),
            Section::Body(Part::RightArm | Part::RightHand | Part::RightLeg) => Some(Side::Right),
            _ => None,
        }
    }
}

/// What was done to a header.
pub struct Header {
    pub toggled: bool,
    pub request: Option<Request>,
}

/// What a header tells besides its title.
#[derive(Clone, Copy, PartialEq, Default, Debug)]
pub struct Signs {
    /// The limb's contact, if it holds on to something.
    pub contact: Option<Contact>,
    /// How many joints of the part are locked.
    pub locked: usize,
}

impl Signs {
    /// `planted, 2 locked`; nothing if there is nothing to tell.
    fn words(&self) -> Option<String> {
        let contact = self.contact.as_ref().map(|contact| glyph::contact_word(contact).to_owned());
        let locked = (self.locked > 0).then(|| format!("{} locked", self.locked));
        let words: Vec<String> = contact.into_iter().chain(locked).collect();
        (!words.is_empty()).then(|| words.join(", "))
    }

    fn paint(&self, ui: &Ui, end_of_title: Pos2, side: Option<Side>) {
        let palette = theme::of(ui);
        let mut at = end_of_title + vec2(14.0, 0.0);
        if let Some(contact) = &self.contact {
            let color = side.map_or(palette.text, |side| palette.side(side));
            glyph::contact(ui.painter(), at, 10.0, contact, color);
            at.x += 16.0;
        }
        if self.locked > 0 {
            glyph::lock(ui.painter(), at, 11.0, true, palette.faint_text);
        }
    }
}

const HEIGHT: f32 = 26.0;

/// Shows a header as wide as the panel; an open one offers to reset and to mirror its part.
pub fn header(ui: &mut Ui, section: Section, open: bool, signs: &Signs) -> Header {
    let (_, rect) = ui.allocate_space(vec2(ui.available_width(), HEIGHT));
    let id = egui::Id::unique(("section", section.title()));
    let response = ui.interact(rect, id, Sense::click());
    response.widget_info(|| {
        WidgetInfo::selected(Role::DisclosureTriangle, ui.is_enabled(), open, section.title())
    });
    if let Some(words) = signs.words() {
        ui.ctx().accesskit_node_builder(id, |node| node.set_description(words));
    }
    if ui.is_rect_visible(rect) {
        let end = paint(ui, rect, section, open, response.hovered());
        signs.paint(ui, end, section.side());
    }
    let request = match section {
        Section::Body(part) if open => buttons(ui, rect, part),
        _ => None,
    };
    Header { toggled: response.clicked(), request }
}

/// Paints the header; where its title ends.
fn paint(ui: &Ui, rect: Rect, section: Section, open: bool, hovered: bool) -> Pos2 {
    let (painter, palette) = (ui.painter(), theme::of(ui));
    let fill = if hovered { palette.header_hovered } else { palette.header };
    painter.rect_filled(rect, 3.0, fill);
    if let Some(side) = section.side() {
        let strip = Rect::from_min_size(rect.min, vec2(3.0, rect.height()));
        painter.rect_filled(strip, 1.0, palette.side(side));
    }
    let c = pos2(rect.left() + 16.0, rect.center().y);
    let arrow = if open {
        vec![c + vec2(-4.0, -2.0), c + vec2(4.0, -2.0), c + vec2(0.0, 3.0)]
    } else {
        vec![c + vec2(-2.0, -4.0), c + vec2(3.0, 0.0), c + vec2(-2.0, 4.0)]
    };
    painter.add(egui::Shape::convex_polygon(arrow, palette.faint_text, egui::Stroke::NONE));
    let at = pos2(rect.left() + 28.0, rect.center().y);
    let color = if open { palette.strong_text } else { palette.text };
    let font = FontId::proportional(13.5);
    painter.text(at, Align2::LEFT_CENTER, section.title(), font, color).right_center()
}

fn buttons(ui: &mut Ui, rect: Rect, part: Part) -> Option<Request> {
    let name = labels::part(part);
    let place = UiBuilder::new()
        .scope_id(egui::Id::unique(("section buttons", name)))
        .max_rect(rect.shrink2(vec2(6.0, 3.0)))
        .layout(egui::Layout::right_to_left(egui::Align::Center));
    let mut request = None;
    ui.scope_builder(place, |ui| {
        let mut button = |ui: &mut Ui, text: &str, name: String, tip: String, command: Command| {
            let button = egui::Button::new(egui::RichText::new(text).size(11.5)).frame_when_inactive(false);
            let response = ui.add(button).accessible_name(name).on_hover_text(tip);
            if response.clicked() {
                request = Some(Request::Do(command));
            }
        };
        let parts = vec![part];
        let low = name.to_lowercase();
        let tip = format!("Back to rest, and free: the {low}");
        button(ui, "Reset", format!("Reset {low}"), tip, Command::Reset { parts: parts.clone() });
        let twin = labels::part(part.mirrored()).to_lowercase();
        let (text, tip) = if part == part.mirrored() {
            ("Mirror", format!("Mirror the {low}: its left becomes its right"))
        } else {
            ("Mirror", format!("Take the mirror image of the {twin}"))
        };
        button(ui, text, format!("Mirror {low}"), tip, Command::Mirror { parts });
    });
    request
}
