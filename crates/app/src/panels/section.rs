//! The sections of the panel and their headers.

use edit::{Command, Request};
use egui::{Align2, Color32, FontId, Rect, Role, Sense, Ui, UiBuilder, WidgetInfo, pos2, vec2};
use rig::{Part, Side};

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

const HEIGHT: f32 = 26.0;

/// Shows a header as wide as the panel; an open one offers to reset and to mirror its part.
pub fn header(ui: &mut Ui, section: Section, open: bool) -> Header {
    let (_, rect) = ui.allocate_space(vec2(ui.available_width(), HEIGHT));
    let id = egui::Id::unique(("section", section.title()));
    let response = ui.interact(rect, id, Sense::click());
    response.widget_info(|| {
        WidgetInfo::selected(Role::DisclosureTriangle, ui.is_enabled(), open, section.title())
    });
    if ui.is_rect_visible(rect) {
        paint(ui, rect, section, open, response.hovered());
    }
    let request = match section {
        Section::Body(part) if open => buttons(ui, rect, part),
        _ => None,
    };
    Header { toggled: response.clicked(), request }
}

fn paint(ui: &Ui, rect: Rect, section: Section, open: bool, hovered: bool) {
    let painter = ui.painter();
    let fill = if hovered { Color32::from_gray(52) } else { theme::HEADER };
    painter.rect_filled(rect, 3.0, fill);
    if let Some(side) = section.side() {
        let strip = Rect::from_min_size(rect.min, vec2(3.0, rect.height()));
        painter.rect_filled(strip, 1.0, theme::side(side));
    }
    let c = pos2(rect.left() + 16.0, rect.center().y);
    let arrow = if open {
        vec![c + vec2(-4.0, -2.0), c + vec2(4.0, -2.0), c + vec2(0.0, 3.0)]
    } else {
        vec![c + vec2(-2.0, -4.0), c + vec2(3.0, 0.0), c + vec2(-2.0, 4.0)]
    };
    painter.add(egui::Shape::convex_polygon(arrow, theme::FAINT_TEXT, egui::Stroke::NONE));
    let at = pos2(rect.left() + 28.0, rect.center().y);
    let color = if open { Color32::from_gray(240) } else { theme::TEXT };
    painter.text(at, Align2::LEFT_CENTER, section.title(), FontId::proportional(13.5), color);
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
