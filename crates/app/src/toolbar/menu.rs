//! The menus: every action with its key.

use egui::{Button, Ui};

use super::{Acting, Wish};
use crate::action::Action;
use crate::library::chains::CHAINS;
use crate::session::MANNEQUIN;
use crate::{sign, theme};

/// A menu: its name and what is in it, in blocks, some of which stand in both kinds of window.
pub struct Menu(&'static str, &'static [&'static [Entry]]);

/// One entry of a menu.
enum Entry {
    Do(Action),
    Line,
    /// A line of words over what follows.
    Title(&'static str),
    /// The chains that come with the program.
    Chains,
    /// The figure that comes with it.
    Mannequin,
}

use Entry::{Chains, Do, Line, Mannequin, Title};

const FILE: &[Entry] = &[
    Do(Action::New),
    Do(Action::Open),
    Line,
    Do(Action::Save),
    Do(Action::SaveAs),
    Do(Action::SavePicture),
    Line,
    Title("Robots and chains"),
    Chains,
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

/// From where, and how near.
const SEEN_FROM: &[Entry] = &[
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
];

const LOOKS: &[Entry] = &[
    Do(Action::StudioLook),
    Do(Action::ClayLook),
    Do(Action::MatcapLook),
    Do(Action::FlatLook),
    Do(Action::LineLook),
];

const THEME: &[Entry] =
    &[Line, Do(Action::Theme), Do(Action::LargerUi), Do(Action::SmallerUi), Do(Action::ResetUi)];

const FINISH: &[Entry] = &[Do(Action::NextLook), Do(Action::JointPlanes), Do(Action::AmbientOcclusion), Line];

const FIGURE_VIEWS: &[Entry] = &[
    Do(Action::Walk),
    Line,
    Do(Action::LookThroughPictureCamera),
    Do(Action::SetPictureCamera),
    Line,
    Do(Action::SecondView),
    Do(Action::Marks),
    Do(Action::Panel),
    Do(Action::Library),
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
    Do(Action::StandOnGround),
    Do(Action::Ranges),
];

const WALK: &[Entry] = &[
    Do(Action::Walk),
    Line,
    Do(Action::WalkPlay),
    Do(Action::WalkStep),
    Do(Action::WalkSlower),
    Do(Action::WalkRestart),
    Line,
    Do(Action::WalkAlone),
    Do(Action::WalkSit),
    Line,
    Do(Action::WalkPlacement),
    Do(Action::WalkBeside),
    Do(Action::WalkFollow),
    Line,
    Do(Action::TakePose),
];

/// The menus of a figure's window.
pub const FIGURE: &[Menu] = &[
    Menu("File", &[FILE]),
    Menu("Edit", &[EDIT]),
    Menu("View", &[SEEN_FROM, &[Title("Look of the figure")], LOOKS, FINISH, FIGURE_VIEWS, THEME]),
    Menu("Pose", &[POSE]),
    Menu("Walk", &[WALK]),
];

/// The menus of a chain's window.
pub const CHAIN: &[Menu] = &[
    Menu(
        "File",
        &[&[
            Do(Action::Open),
            Line,
            Do(Action::Save),
            Do(Action::SaveAs),
            Do(Action::SavePicture),
            Line,
            Title("Robots and chains"),
            Chains,
            Line,
            Title("Figures"),
            Mannequin,
            Line,
            Do(Action::Quit),
        ]],
    ),
    Menu(
        "Edit",
        &[&[
            Do(Action::Undo),
            Do(Action::Redo),
            Line,
            Title("Choose"),
            Do(Action::Parent),
            Do(Action::Child),
            Do(Action::NextJoint),
            Do(Action::PreviousJoint),
            Line,
            Do(Action::Settings),
        ]],
    ),
    Menu(
        "View",
        &[
            SEEN_FROM,
            &[Title("Look")],
            LOOKS,
            &[Do(Action::AmbientOcclusion), Line, Do(Action::Panel)],
            THEME,
        ],
    ),
    Menu("Pose", &[&[Do(Action::ClearRotation), Do(Action::Reset), Line, Do(Action::Ranges)]]),
];

const WIDTH: f32 = 250.0;

/// Shows the menus' buttons, and the menu that is open.
pub fn show(ui: &mut Ui, on: &dyn Acting, menus: &[Menu], asked: &mut Vec<Wish>) {
    for Menu(name, entries) in menus {
        let button = Button::new(*name).frame_when_inactive(false);
        egui::containers::menu::MenuButton::from_button(button).ui(ui, |ui| {
            ui.set_width(WIDTH);
            let room = ui.ctx().content_rect().height() - 80.0;
            let scroll = egui::ScrollArea::vertical().max_height(room).min_scrolled_height(room);
            scroll.show(ui, |ui| {
                for entry in entries.iter().copied().flatten() {
                    show_entry(ui, on, entry, asked);
                }
            });
        });
    }
}

fn show_entry(ui: &mut Ui, on: &dyn Acting, entry: &Entry, asked: &mut Vec<Wish>) {
    match entry {
        Line => {
            ui.separator();
        }
        Title(words) => {
            ui.weak(*words);
        }
        Chains => CHAINS.iter().for_each(|(title, path)| file(ui, title, path, asked)),
        Mannequin => file(ui, "Mannequin", MANNEQUIN, asked),
        Do(action) => {
            if item(ui, on, *action).clicked() {
                asked.push(Wish::Do(*action));
                ui.close();
            }
        }
    }
}

/// A row of a menu: what it does, whether it is on, its key.
fn item(ui: &mut Ui, on: &dyn Acting, action: Action) -> egui::Response {
    let indented = format!("      {}", on.words(action));
    let button = Button::new(indented)
        .shortcut_text(on.keymap().shown(action))
        .frame_when_inactive(false)
        .min_size(egui::vec2(ui.available_width(), 0.0));
    let response = ui.add_enabled(on.can(action), button);
    if on.is_on(action) == Some(true) {
        sign::check(ui, response.rect.left_center() + egui::vec2(11.0, 0.0), theme::of(ui).text);
    }
    response.widget_info(|| match on.is_on(action) {
        Some(is_on) => egui::WidgetInfo::selected(egui::Role::CheckBox, true, is_on, on.words(action)),
        None => egui::WidgetInfo::labeled(egui::Role::Button, true, on.words(action)),
    });
    response.on_hover_text(on.explained(action))
}

/// A row that opens a file that comes with the program.
fn file(ui: &mut Ui, title: &str, path: &'static str, asked: &mut Vec<Wish>) {
    let button = Button::new(format!("      {title}"))
        .frame_when_inactive(false)
        .min_size(egui::vec2(ui.available_width(), 0.0));
    let response = ui.add(button).accessible_name(format!("Open {title}"));
    if response.on_hover_text(format!("Opens {title}, which comes with the program")).clicked() {
        asked.push(Wish::Open(path));
        ui.close();
    }
}
