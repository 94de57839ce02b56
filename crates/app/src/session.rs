//! One window's work: the editor, the file that it came from, and how it is looked at. Drawn by [`Session::ui`] in the
//! window, in tests and in pictures alike.

mod act;
mod body;
mod clipboard;
mod configure;
mod files;
mod keys;
mod recovery;
mod saving;
mod walking;

use std::path::{Path, PathBuf};

use edit::{Command, Document, Editor, Request};
use egui::{Key, Ui};
use rig::Pose;

use crate::dialogs::Dialogs;
use crate::disk::Disk;
use crate::failure::Failure;
use crate::keymap::Keymap;
use crate::library::{Folders, Library};
use crate::panels::Panels;
use crate::saving::Saving;
use crate::settings::{Keeper, Settings};
use crate::toolbar::Wish;
use crate::viewport::Viewport;
use crate::walk::Walk;
use crate::{status_line, theme, toolbar};
pub use act::style_of;
pub use body::MANNEQUIN;
use recovery::Recovery;

/// The left panel's rows need as much, points.
const PANEL_LEAST: f32 = 340.0;
/// What the left panel leaves to the picture, points.
const PICTURE_LEAST: f32 = 320.0;

/// What the status line says.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub struct Status {
    /// One sentence; empty if there is nothing to say.
    pub message: String,
    /// Whether it tells of something that went wrong.
    pub fault: bool,
    /// Whether a range, reach or contact stopped the last command short.
    pub clamped: bool,
}

/// The state of a window.
pub struct Session {
    editor: Editor,
    disk: Disk,
    /// The pose as it was opened or saved.
    saved: Pose,
    path: Option<PathBuf>,
    status: Status,
    /// What is open and chosen in the panel.
    pub panels: Panels,
    /// How the figure is looked at.
    pub viewport: Viewport,
    dialogs: Dialogs,
    /// Whether the processor draws: then movement is drawn with fewer samples.
    pub software: bool,
    moving: bool,
    quit: bool,
    recovery: Recovery,
    keymap: Keymap,
    settings: Settings,
    keeper: Keeper,
    /// Text that came with the key for pasting.
    paste_text: Option<String>,
    /// Whether the clipboard was asked for to be pasted mirrored.
    paste_mirrored: bool,
    library: Library,
    /// The pictures that are being made.
    saving: Option<Saving>,
    /// Where the figure came from.
    source: body::Source,
    /// A file that is to be opened in another kind of window.
    elsewhere: Option<PathBuf>,
    /// The figure's walk.
    walk: Walk,
}

impl Session {
    /// A session with an editor and the file that its pose came from.
    pub fn new(editor: Editor, path: Option<PathBuf>) -> Session {
        Session {
            saved: editor.pose().clone(),
            editor,
            disk: Disk::default(),
            path,
            status: Status::default(),
            panels: Panels::default(),
            viewport: Viewport::default(),
            dialogs: Dialogs::default(),
            software: false,
            moving: false,
            quit: false,
            recovery: Recovery::default(),
            keymap: Keymap::default(),
            settings: Settings::default(),
            keeper: Keeper::default(),
            paste_text: None,
            paste_mirrored: false,
            library: Library::default(),
            saving: None,
            source: body::Source::default(),
            elsewhere: None,
            walk: Walk::default(),
        }
    }

    /// The editor.
    pub fn editor(&self) -> &Editor {
        &self.editor
    }

    /// The document as it shows now.
    pub fn document(&self) -> &Document {
        self.editor.document()
    }

    /// What the status line says.
    pub fn status(&self) -> &Status {
        &self.status
    }

    /// Which keys ask for what.
    pub fn keymap(&self) -> &Keymap {
        &self.keymap
    }

    /// What the user chose about the program.
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The file that the pose came from or went to.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// Whether the pose differs from the file's.
    pub fn is_modified(&self) -> bool {
        *self.editor.pose() != self.saved
    }

    /// Whether the session has ended.
    pub fn has_quit(&self) -> bool {
        self.quit
    }

    /// The window's title: the file's name, marked when it isn't saved.
    pub fn title(&self) -> String {
        let mark = if self.is_modified() { "• " } else { "" };
        format!("{mark}{} – Posewright", self.file_name())
    }

    /// The file's name without its folder.
    pub fn file_name(&self) -> String {
        let name = self.path.as_ref().and_then(|path| path.file_name());
        name.map_or_else(|| "Unnamed pose".to_owned(), |name| name.to_string_lossy().into_owned())
    }

    /// The library of poses.
    pub fn library(&self) -> &Library {
        &self.library
    }

    /// Takes the library's poses and portraits from folders.
    pub fn use_library(&mut self, folders: Folders) {
        self.library = Library::new(folders);
    }

    /// Asks the editor, and remembers what came of it for the status line.
    pub fn submit(&mut self, request: Request) {
        match self.editor.submit(request, &mut self.disk) {
            Ok(outcome) if outcome == edit::Outcome::default() => {}
            Ok(outcome) => {
                self.status = Status { message: outcome.message, fault: false, clamped: outcome.clamped };
            }
            Err(rejected) => {
                self.status = Status { message: rejected.to_string(), fault: true, clamped: false };
            }
        }
    }

    fn submit_all(&mut self, requests: Vec<Request>) {
        for request in requests {
            match request {
                Request::Do(command @ (Command::MoveHips { .. } | Command::Place { .. }))
                    if self.viewport.ground.is_some() =>
                {
                    // Feet that stand on the ground go along within the same step.
                    self.submit(Request::Preview(command));
                    self.keep_standing();
                    self.submit(Request::Commit);
                }
                request => self.submit(request),
            }
        }
    }

    fn say(&mut self, message: String) {
        self.status = Status { message, ..Status::default() };
    }

    fn tell(&mut self, result: Result<(), Failure>) {
        if let Err(error) = result {
            self.status = Status { message: error.to_string(), fault: true, clamped: false };
        }
    }

    /// Draws everything and does what was asked for.
    pub fn ui(&mut self, ui: &mut Ui) {
        self.show_as_chosen(ui.ctx());
        self.take_dropped(ui);
        if !self.dialogs.is_open() {
            self.keys(ui);
        }
        let asked = toolbar::show(ui, self);
        for wish in asked {
            match wish {
                Wish::Do(action) => self.act(ui.ctx(), action),
                Wish::Open(path) => self.open_asking(path.into()),
                Wish::Time(motion) => self.walk.clock.motion = motion,
            }
        }
        status_line::show(ui, self);
        match self.walk.is_open() {
            true => self.show_walk(ui),
            false => self.show_pose(ui),
        }
        self.dialogs(ui);
        self.show_saving(ui);
        self.settings.marks = self.viewport.marks;
        self.settings.second_view = self.viewport.side_view;
        self.settings.navigation = self.viewport.preset;
        self.keep();
        self.keep_settings(ui);
    }

    fn show_pose(&mut self, ui: &mut Ui) {
        if self.settings.panel {
            self.panel(ui);
        }
        self.show_library(ui);
        self.picture(ui);
        self.end_gesture(ui);
    }

    fn panel(&mut self, ui: &mut Ui) {
        // Where controls are large, the figure keeps some room.
        let most = (ui.available_width() - PICTURE_LEAST).clamp(PANEL_LEAST, 560.0);
        let panel = egui::Panel::left("panel").default_size(most.min(396.0)).size_range(PANEL_LEAST..=most);
        let fill = theme::of(ui).panel;
        let frame = egui::Frame::new().fill(fill).inner_margin(egui::Margin::symmetric(6, 6));
        self.panels.light(self.viewport.hovered());
        if !self.editor.in_gesture() {
            self.panels.touch(self.viewport.nearest_spaces(&self.editor));
        }
        self.tell_of_ground();
        let requests = panel.frame(frame).show(ui, |ui| self.panels.show(ui, &self.editor)).inner;
        self.submit_all(requests);
        self.take_ground_row();
        self.take_clay();
        self.save_figure_if_asked();
    }

    fn show_library(&mut self, ui: &mut Ui) {
        self.library.follow(self.settings.library_folder.as_deref());
        let parts = self.chosen_parts();
        let asked = self.library.panel(ui, self.settings.library, &self.editor, &parts);
        self.submit_all(asked.requests);
        match asked.told {
            Some(Ok(words)) => self.say(words),
            Some(Err(fault)) => self.tell(Err(Failure::Input(fault))),
            None => {}
        }
    }

    fn picture(&mut self, ui: &mut Ui) {
        self.viewport.hint(self.panels.hinted());
        self.viewport.finish = self.settings.finish;
        self.viewport.picture_size = self.settings.picture.size;
        self.viewport.guides = self.panels.guides();
        self.viewport.balance = self.panels.balance_marks();
        self.lay_ground(ui);
        let hovered = self.viewport.hovered();
        let asked = egui::CentralPanel::no_frame()
            .show(ui, |ui| self.viewport.show(ui, &self.editor, self.panels.selection(), self.software))
            .inner;
        if let Some(how) = asked.chosen {
            self.panels.choose(&self.editor.figure().skeleton, how);
            ui.ctx().request_repaint();
        }
        if self.viewport.hovered() != hovered {
            // The panel, which marks it as well, has been drawn already.
            ui.ctx().request_repaint();
        }
        self.submit_all(asked.requests);
        self.keep_standing();
    }

    /// A gesture ends where the pointer lets go, and is undone by Escape, whatever was under the pointer.
    fn end_gesture(&mut self, ui: &Ui) {
        let (down, escape) = ui.input(|i| (i.pointer.any_down(), i.key_pressed(Key::Escape)));
        if self.editor.in_gesture() && escape {
            self.submit(Request::Cancel);
        } else if self.editor.in_gesture() && !down {
            self.submit(Request::Commit);
        }
        // One more picture, in full quality, when movement ends.
        let moving = down || self.editor.in_gesture();
        if self.moving && !moving {
            ui.ctx().request_repaint();
        }
        self.moving = moving;
    }

    fn dialogs(&mut self, ui: &Ui) {
        let keys = self.keymap.clone();
        let answer =
            self.dialogs.show(ui.ctx(), &mut self.settings, Some(&mut self.viewport), &mut self.keymap);
        if keys != self.keymap {
            self.viewport.keymap = self.keymap.clone();
            self.keep_keys();
        }
        if let Some(answer) = answer {
            self.answered(ui, answer);
        }
    }
}
