//! The panel at the left of a chain's window: a slider a joint, how links reach, and what can be changed of the chain.

use edit::{ChainCommand, ChainEditor, ChainNode, ChainReach, ChainRequest};
use egui::{Align2, Button, FontId, Rect, RichText, TextEdit, Ui, UiBuilder, pos2, vec2};

use super::guides::ChainGuides;
use super::{editing, joints, reaching};
use crate::rail::Change;
use crate::theme;
use crate::viewport::Guide;

pub use reaching::Reaching;

/// What the panel itself remembers: how it is looked at, nothing of the chain.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct ChainPanel {
    /// Joints without these letters are left out.
    filter: String,
    /// The name of the next link.
    new_name: String,
    reaching: Reaching,
    guides: ChainGuides,
    /// Whether the chosen row is to come into view.
    reveal: bool,
}

/// What was done in the panel.
#[derive(Clone, Debug, Default)]
pub struct Asked {
    /// Changes of the chain.
    pub requests: Vec<ChainRequest>,
    /// What was chosen.
    pub chosen: Option<ChainNode>,
    /// The joint whose name the pointer is on.
    pub hinted: Option<usize>,
}

/// One pass over the panel: what it reads, and what it gathers.
pub struct Sheet<'a> {
    /// The chain.
    pub editor: &'a ChainEditor,
    /// What is chosen.
    pub node: ChainNode,
    /// The link that the pointer is on in the picture.
    pub lit: Option<usize>,
    /// How the last reach went.
    pub reach: Option<&'a ChainReach>,
    /// What the panel gathers.
    pub asked: Asked,
}

/// With more joints there is a field to look for one.
const MANY: usize = 12;

impl ChainPanel {
    /// How links that are dragged reach.
    pub fn reaching(&self) -> Reaching {
        self.reaching
    }

    /// What the picture shows of what the chosen line of links reaches.
    pub fn guides(&self) -> ChainGuides {
        self.guides
    }

    /// Switches one of the guides on.
    pub fn show_guide(&mut self, guide: Guide) {
        self.guides.set(guide);
    }

    /// Brings the row of what is chosen into view.
    pub fn reveal(&mut self) {
        self.reveal = true;
    }

    /// Shows the panel.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        editor: &ChainEditor,
        node: ChainNode,
        lit: Option<usize>,
        reach: Option<&ChainReach>,
    ) -> Asked {
        let mut sheet = Sheet { editor, node, lit, reach, asked: Asked::default() };
        let frame = egui::Frame::NONE;
        egui::Panel::bottom("chain tools").frame(frame).resizable(false).show_separator_line(false).show(
            ui,
            |ui| {
                ui.add_space(4.0);
                heading(ui, "Reach", "");
                inset(ui, |ui| {
                    sheet.reaching(ui, &mut self.reaching);
                    self.guides.show(ui);
                });
                heading(ui, "Edit", "");
                inset(ui, |ui| sheet.editing(ui, &mut self.new_name));
            },
        );
        egui::CentralPanel::no_frame().show(ui, |ui| {
            let (all, count) = (editor.robot().dofs().count(), editor.robot().links().len());
            let links = if count == 1 { "link" } else { "links" };
            let head = heading(ui, "Joints", &format!("{} · {count} {links}", editor.robot().name()));
            if reset(ui, head) {
                let command = ChainCommand::Reset { joints: Vec::new() };
                sheet.asked.requests.push(ChainRequest::Do(command));
            }
            ui.add_space(2.0);
            if all > MANY {
                let field = TextEdit::singleline(&mut self.filter)
                    .hint_text("Find a joint")
                    .desired_width(f32::INFINITY);
                ui.add(field).accessible_name("Find a joint");
            } else {
                self.filter.clear();
            }
            sheet.joints(ui, &self.filter, &mut self.reveal);
        });
        sheet.asked
    }
}

/// The head of a part of the panel, with a note behind its title; where it is.
pub fn heading(ui: &mut Ui, title: &str, note: &str) -> Rect {
    let (_, rect) = ui.allocate_space(vec2(ui.available_width(), 26.0));
    let (painter, palette) = (ui.painter(), theme::of(ui));
    painter.rect_filled(rect, 3.0, palette.header);
    let at = pos2(rect.left() + 10.0, rect.center().y);
    let font = FontId::proportional(13.5);
    let written = painter.text(at, Align2::LEFT_CENTER, title, font, palette.strong_text);
    let at = pos2(written.right() + 12.0, rect.center().y + 0.5);
    // What stands at the right keeps its room.
    let room = Rect::from_min_max(pos2(at.x, rect.top()), rect.max - vec2(BUTTON, 0.0));
    let painter = painter.with_clip_rect(room.intersect(ui.clip_rect()));
    painter.text(at, Align2::LEFT_CENTER, note, FontId::proportional(12.0), palette.faint_text);
    rect
}

/// What the button of a heading takes, points.
const BUTTON: f32 = 62.0;

/// A quiet button at the right of a heading; whether it was clicked.
fn reset(ui: &mut Ui, heading: Rect) -> bool {
    let place = UiBuilder::new()
        .scope_id(egui::Id::unique("reset joints"))
        .max_rect(heading.shrink2(vec2(6.0, 3.0)))
        .layout(egui::Layout::right_to_left(egui::Align::Center));
    let button = Button::new(RichText::new("Reset").size(11.5)).frame_when_inactive(false);
    let tip = "All joints back to 0, or as near as their ranges let them";
    let shown = ui.scope_builder(place, |ui| ui.add(button).accessible_name("Reset all joints"));
    shown.inner.on_hover_text(tip).clicked()
}

/// What stands below a heading, with some room around it.
pub fn inset(ui: &mut Ui, show: impl FnOnce(&mut Ui)) {
    let margin = egui::Margin { left: 8, right: 6, top: 4, bottom: 8 };
    egui::Frame::new().inner_margin(margin).show(ui, show);
}

/// A row of the panel's grid: words at the left, what follows them at the right.
pub fn line(ui: &mut Ui, words: &str, show: impl FnOnce(&mut Ui)) {
    ui.horizontal(|ui| {
        ui.set_min_height(24.0);
        let (_, rect) = ui.allocate_space(vec2(WORDS, 22.0));
        let at = pos2(rect.left() + 2.0, rect.center().y);
        let font = FontId::proportional(12.5);
        ui.painter().text(at, Align2::LEFT_CENTER, words, font, theme::of(ui).faint_text);
        show(ui);
    });
}

/// What the words of a [`line`] take, points.
const WORDS: f32 = 64.0;

/// A quiet button.
pub fn button(ui: &mut Ui, enabled: bool, words: &str, name: &str, tip: &str) -> bool {
    let response = ui.add_enabled(enabled, Button::new(RichText::new(words).size(12.5)));
    response.accessible_name(name).on_hover_text(tip).on_disabled_hover_text(tip).clicked()
}

impl Sheet<'_> {
    /// Asks for what a control says: a preview while it is dragged, a step otherwise.
    pub fn ask(&mut self, change: Option<Change>, command: impl FnOnce(f64) -> Option<ChainCommand>) {
        let (value, request): (f64, fn(ChainCommand) -> ChainRequest) = match change {
            Some(Change::Preview(value)) => (value, ChainRequest::Preview),
            Some(Change::Set(value)) => (value, ChainRequest::Do),
            None => return,
        };
        self.asked.requests.extend(command(value).map(request));
    }

    fn joints(&mut self, ui: &mut Ui, filter: &str, reveal: &mut bool) {
        joints::show(self, ui, filter, reveal);
    }

    fn reaching(&mut self, ui: &mut Ui, how: &mut Reaching) {
        reaching::show(self, ui, how);
    }

    fn editing(&mut self, ui: &mut Ui, name: &mut String) {
        editing::show(self, ui, name);
    }
}
