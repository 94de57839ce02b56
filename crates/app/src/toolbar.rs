//! The bar at the top: files, history, the whole pose, views.

use edit::{Command, Request};
use egui::{Button, Response, RichText, Ui, WidgetText};
use rig::{Projection, View};

use crate::session::Session;
use crate::theme;

/// What the bar or a shortcut asks for.
#[derive(Clone, PartialEq, Debug)]
pub enum Action {
    /// A change of the document.
    Ask(Box<Request>),
    /// Takes the last step back.
    Undo,
    /// Does it again.
    Redo,
    /// Opens a file that is asked for.
    Open,
    /// Saves to the present file.
    Save,
    /// Saves to another file.
    SaveAs,
    /// Ends the program.
    Quit,
    /// Looks from a side.
    View(View),
    /// Perspective or orthographic.
    Projection(Projection),
    /// Brings the whole figure into the picture.
    FrameAll,
    /// Shows or hides joints and targets.
    Marks(bool),
    /// Explains gestures and shortcuts.
    Help,
}

/// Shows the bar; returns what was asked for.
pub fn show(ui: &mut Ui, session: &Session) -> Vec<Action> {
    let mut asked = Vec::new();
    let frame = egui::Frame::new().fill(theme::BAR).inner_margin(egui::Margin::symmetric(8, 5));
    egui::Panel::top("toolbar").frame(frame).resizable(false).show(ui, |ui| {
        ui.horizontal(|ui| {
            ui.spacing_mut().item_spacing.x = 4.0;
            files(ui, &mut asked);
            gap(ui);
            history(ui, session, &mut asked);
            gap(ui);
            pose(ui, session, &mut asked);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                views(ui, session, &mut asked);
            });
        });
    });
    asked
}

fn gap(ui: &mut Ui) {
    ui.add_space(4.0);
    ui.separator();
    ui.add_space(4.0);
}

fn button(ui: &mut Ui, enabled: bool, text: impl Into<WidgetText>, tip: &str) -> Response {
    let button = Button::new(text.into()).frame_when_inactive(false);
    ui.add_enabled(enabled, button).on_hover_text(tip).on_disabled_hover_text(tip)
}

fn files(ui: &mut Ui, asked: &mut Vec<Action>) {
    for (text, tip, action) in [
        ("Open…", "Opens a pose (Ctrl+O)", Action::Open),
        ("Save", "Saves the pose (Ctrl+S)", Action::Save),
        ("Save as…", "Saves the pose to another file (Ctrl+Shift+S)", Action::SaveAs),
    ] {
        if button(ui, true, text, tip).clicked() {
            asked.push(action);
        }
    }
}

fn history(ui: &mut Ui, session: &Session, asked: &mut Vec<Action>) {
    let editor = session.editor();
    let tip = |word: &str, name: Option<&str>, keys: &str| match name {
        Some(name) => format!("{word} {name} ({keys})"),
        None => format!("Nothing to {}", word.to_lowercase()),
    };
    let (undo, redo) = (editor.undo_name(), editor.redo_name());
    if button(ui, undo.is_some(), "Undo", &tip("Undo", undo, "Ctrl+Z")).clicked() {
        asked.push(Action::Undo);
    }
    if button(ui, redo.is_some(), "Redo", &tip("Redo", redo, "Ctrl+Shift+Z")).clicked() {
        asked.push(Action::Redo);
    }
}

fn pose(ui: &mut Ui, session: &Session, asked: &mut Vec<Action>) {
    let mut ask = |command| asked.push(Action::Ask(Box::new(Request::Do(command))));
    if button(ui, true, "Reset", "The whole figure back to rest, every limb free").clicked() {
        ask(Command::Reset { parts: Vec::new() });
    }
    if button(ui, true, "Mirror", "The mirror image of the whole pose").clicked() {
        ask(Command::Mirror { parts: Vec::new() });
    }
    let mut on = session.document().ranges;
    let tip = "Whether joints stop at the ranges of a human body";
    if ui.checkbox(&mut on, "Ranges").on_hover_text(tip).changed() {
        ask(Command::Ranges { on });
    }
}

/// From right to left.
fn views(ui: &mut Ui, session: &Session, asked: &mut Vec<Action>) {
    if button(ui, true, "Help", "Gestures and shortcuts (F1)").clicked() {
        asked.push(Action::Help);
    }
    gap(ui);
    let mut marks = session.viewport.marks;
    if ui
        .checkbox(&mut marks, "Marks")
        .on_hover_text("Joints, articulators and targets over the figure")
        .changed()
    {
        asked.push(Action::Marks(marks));
    }
    let mut ortho = session.viewport.camera.projection == Projection::Orthographic;
    if ui.checkbox(&mut ortho, "Ortho").on_hover_text("No perspective: farther is as large").changed() {
        let projection = if ortho { Projection::Orthographic } else { Projection::Perspective };
        asked.push(Action::Projection(projection));
    }
    gap(ui);
    if button(ui, true, "Frame", "The whole figure into the picture (Home)").clicked() {
        asked.push(Action::FrameAll);
    }
    let camera = &session.viewport.camera;
    for (view, text, keys) in [
        (View::ThreeQuarter, "3/4", ""),
        (View::Top, "Top", " (7)"),
        (View::Right, "Right", " (Ctrl+3)"),
        (View::Left, "Left", " (3)"),
        (View::Back, "Back", " (Ctrl+1)"),
        (View::Front, "Front", " (1)"),
    ] {
        let here = (camera.yaw_rad, camera.pitch_rad) == view.angles_rad();
        let text = if here { RichText::new(text).color(theme::ACCENT) } else { RichText::new(text) };
        let tip = format!("Seen from the {}{keys}", side_words(view));
        let response = button(ui, true, text, &tip).accessible_name(format!("View {}", view.name()));
        if response.clicked() {
            asked.push(Action::View(view));
        }
    }
}

fn side_words(view: View) -> &'static str {
    match view {
        View::Front => "front",
        View::Back => "back",
        View::Left => "figure's left",
        View::Right => "figure's right",
        View::Top => "top",
        View::ThreeQuarter => "front and left, a little above",
    }
}
