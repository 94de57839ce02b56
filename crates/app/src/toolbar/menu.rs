//! The menus: every action with its key.

use egui::{Button, Ui};

use crate::action::Action;
use crate::session::Session;
use crate::{sign, theme};

/// One entry of a menu.
enum Entry {
    Do(Action),
    Line,
    /// A line of words over what follows.
    Title(&'static str),
}

use Entry::{Do, Line, Title};

const FILE: &[Entry] = &[
    Do(Action::New),
    Do(Action::Open),
    Line,
    Do(Action::Save),
    Do(Action::SaveAs),
    Do(Action::SavePicture),
    Line,
    Do(Action::Quit),
];

const EDIT: &[Entry] = &[
    Do(Action::Undo),
    Do(Action::Redo),
    Line,
    Do(Action::Copy),
    Do(Action::Paste),
    Do(Action::PasteMirrored),
    Line,
    Title("Choose"),
    Do(Action::Parent),
    Do(Action::Child),
    Do(Action::NextJoint),
    Do(Action::PreviousJoint),
    Do(Action::NextOfLevel),
    Do(Action::PreviousOfLevel),
    Do(Action::SelectNone),
    Line,
    Do(Action::Settings),
];

const VIEW: &[Entry] = &[
    Title("Seen from"),
    Do(Action::Front),
    Do(Action::Back),
    Do(Action::Left),
    Do(Action::Right),
    Do(Action::Top),
    Do(Action::Bottom),
    Do(Action::ThreeQuarter),
    Do(Action::Opposite),
    Line,
    Do(Action::Projection),
    Do(Action::FrameSelection),
    Do(Action::FrameAll),
    Line,
    Title("Look of the figure"),
    Do(Action::StudioLook),
    Do(Action::ClayLook),
    Do(Action::MatcapLook),
    Do(Action::FlatLook),
    Do(Action::LineLook),
    Do(Action::NextLook),
    Do(Action::JointPlanes),
    Do(Action::AmbientOcclusion),
    Line,
    Do(Action::LookThroughPictureCamera),
    Do(Action::SetPictureCamera),
    Line,
    Do(Action::SecondView),
    Do(Action::Marks),
    Do(Action::Panel),
    Do(Action::Library),
    Line,
    Do(Action::Theme),
    Do(Action::LargerUi),
    Do(Action::SmallerUi),
    Do(Action::ResetUi),
];

const POSE: &[Entry] = &[
    Do(Action::CycleContact),
    Do(Action::Flip),
    Do(Action::Lock),
    Line,
    Do(Action::ClearRotation),
    Do(Action::ClearPlace),
    Do(Action::Reset),
    Line,
    Do(Action::Mirror),
    Do(Action::Symmetry),
    Do(Action::Balance),
    Do(Action::Ranges),
];

const WIDTH: f32 = 250.0;

/// Shows the menus' buttons, and the menu that is open.
pub fn show(ui: &mut Ui, session: &Session, asked: &mut Vec<Action>) {
    for (name, entries) in [("File", FILE), ("Edit", EDIT), ("View", VIEW), ("Pose", POSE)] {
        let button = Button::new(name).frame_when_inactive(false);
        egui::containers::menu::MenuButton::from_button(button).ui(ui, |ui| {
            ui.set_width(WIDTH);
            let room = ui.ctx().content_rect().height() - 80.0;
            let scroll = egui::ScrollArea::vertical().max_height(room).min_scrolled_height(room);
            scroll.show(ui, |ui| {
                for entry in entries {
                    show_entry(ui, session, entry, asked);
                }
            });
        });
    }
}

fn show_entry(ui: &mut Ui, session: &Session, entry: &Entry, asked: &mut Vec<Action>) {
    match entry {
        Line => {
            ui.separator();
        }
        Title(words) => {
            ui.weak(*words);
        }
        Do(action) => {
            if item(ui, session, *action).clicked() {
                asked.push(*action);
                ui.close();
            }
        }
    }
}

/// A row of a menu: what it does, whether it is on, its key.
fn item(ui: &mut Ui, session: &Session, action: Action) -> egui::Response {
    let indented = format!("      {}", action.words());
    let button = Button::new(indented)
        .shortcut_text(session.keymap().shown(action))
        .frame_when_inactive(false)
        .min_size(egui::vec2(ui.available_width(), 0.0));
    let response = ui.add_enabled(session.can(action), button);
    if session.is_on(action) == Some(true) {
        sign::check(ui, response.rect.left_center() + egui::vec2(11.0, 0.0), theme::of(ui).text);
    }
    response.widget_info(|| match session.is_on(action) {
        Some(on) => egui::WidgetInfo::selected(egui::Role::CheckBox, true, on, action.words()),
        None => egui::WidgetInfo::labeled(egui::Role::Button, true, action.words()),
    });
    response.on_hover_text(action.explained())
}
