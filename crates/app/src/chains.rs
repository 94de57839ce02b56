//! One window's work on a chain or a robot: its editor, the file that it came from, what is chosen, and how it is looked at.
//! Drawn by [`ChainSession::ui`] in the window, in tests and in pictures alike.

mod act;
mod ask;
mod bar;
mod brackets;
mod driving;
mod editing;
mod files;
mod guides;
mod joints;
mod keys;
mod marks;
pub mod panel;
mod picture;
mod pointer;
mod reaching;
mod status;
mod value;

use std::path::{Path, PathBuf};

use edit::{ChainDocument, ChainEditor, ChainNode, ChainReach, ChainRequest};
use egui::{Key, Ui};

use crate::dialogs::{Dialogs, Paper};
use crate::failure::Failure;
use crate::keymap::Keymap;
use crate::library::shipped;
use crate::saving::Saving;
use crate::session::Status;
use crate::settings::{Keeper, Settings};
use crate::theme;
use crate::toolbar::Wish;
use crate::viewport::Guide;
pub use act::{knows, words};
use driving::Driving;
use panel::ChainPanel;
pub use picture::ChainPicture;
use picture::Shown;

/// The left panel's rows need as much, points.
const PANEL_LEAST: f32 = 340.0;
/// What the left panel leaves to the picture, points.
const PICTURE_LEAST: f32 = 320.0;

/// The state of a window on a chain.
pub struct ChainSession {
    editor: ChainEditor,
    /// The document as it was opened or saved.
    saved: ChainDocument,
    path: Option<PathBuf>,
    status: Status,
    /// How the last reach went.
    reach: Option<ChainReach>,
    node: ChainNode,
    panel: ChainPanel,
    /// How the chain is looked at.
    pub picture: ChainPicture,
    driving: Driving,
    dialogs: Dialogs,
    /// Whether the processor draws: then movement is drawn with fewer samples.
    pub software: bool,
    moving: bool,
    quit: bool,
    /// A file that is to be opened in another kind of window.
    elsewhere: Option<PathBuf>,
    /// The pictures that are being made.
    saving: Option<Saving>,
    keymap: Keymap,
    settings: Settings,
    keeper: Keeper,
}

impl ChainSession {
    /// A session with an editor and the file that its chain came from.
    pub fn new(editor: ChainEditor, path: Option<PathBuf>) -> ChainSession {
        ChainSession {
            saved: editor.document().clone(),
            node: ChainNode::first(editor.document()),
            picture: ChainPicture::of(&editor),
            editor,
            path,
            status: Status::default(),
            reach: None,
            panel: ChainPanel::default(),
            driving: Driving::default(),
            dialogs: Dialogs::of(Paper::Chain),
            software: false,
            moving: false,
            quit: false,
            elsewhere: None,
            saving: None,
            keymap: Keymap::default(),
            settings: Settings::default(),
            keeper: Keeper::default(),
        }
    }

    /// The editor.
    pub fn editor(&self) -> &ChainEditor {
        &self.editor
    }

    /// What is chosen.
    pub fn node(&self) -> ChainNode {
        self.node
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

    /// The file that the chain came from or went to.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// How the last reach went, if there was one.
    pub fn last_reach(&self) -> Option<&ChainReach> {
        self.reach.as_ref()
    }

    /// The speed at which keys drive what is chosen, degrees or metres a second.
    pub fn driven_per_sec(&self) -> f64 {
        self.driving.per_sec(&self.editor)
    }

    /// Whether the chain differs from the file's.
    pub fn is_modified(&self) -> bool {
        *self.editor.document() != self.saved
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

    /// The file's name without its folder, or else the chain's own name.
    pub fn file_name(&self) -> String {
        let name = self.path.as_ref().and_then(|path| path.file_name()).map(|name| name.to_string_lossy());
        let bare = name.map(|name| name.strip_prefix(shipped::PREFIX).unwrap_or(&name).to_owned());
        bare.unwrap_or_else(|| self.editor.robot().name().to_owned())
    }

    /// Chooses a node; what keys were driving is done.
    pub fn choose(&mut self, node: ChainNode) {
        if self.driving.is_under_way() {
            self.driving.stop();
            self.submit(ChainRequest::Commit);
        }
        self.node = node;
        self.keep_choice();
        self.panel.reveal();
    }

    /// Shows one of the guides to what the chosen line of links reaches.
    pub fn show_guide(&mut self, guide: Guide) {
        self.panel.show_guide(guide);
    }

    /// Asks the editor, and remembers what came of it for the status line.
    pub fn submit(&mut self, request: ChainRequest) {
        let stands = matches!(request, ChainRequest::Commit);
        match self.editor.submit(request) {
            Ok(_) if stands => {}
            Ok(outcome) => {
                if outcome.reach.is_some() {
                    self.reach.clone_from(&outcome.reach);
                }
                self.status = Status { message: outcome.message, fault: false, clamped: outcome.clamped };
            }
            Err(rejected) => {
                self.status = Status { message: rejected.to_string(), fault: true, clamped: false };
            }
        }
        self.keep_choice();
    }

    /// A chain that was edited may no longer have what was chosen.
    fn keep_choice(&mut self) {
        if self.node != ChainNode::Root && self.node.dof(self.editor.robot()).is_none() {
            self.node = ChainNode::first(self.editor.document());
        }
    }

    fn say(&mut self, message: String) {
        self.status = Status { message, ..Status::default() };
    }

    /// Tells of a failure in the status line.
    fn tell(&mut self, result: Result<(), Failure>) {
        if let Err(error) = result {
            self.status = Status { message: error.to_string(), fault: true, clamped: false };
        }
    }

    /// Draws everything and does what was asked for.
    pub fn ui(&mut self, ui: &mut Ui) {
        theme::follow(ui.ctx(), self.settings.look);
        ui.ctx().set_zoom_factor(self.settings.ui_scale);
        self.take_dropped(ui);
        if !self.dialogs.is_open() {
            self.keys(ui);
        }
        self.drive(ui);
        let asked = bar::show(ui, self);
        for wish in asked {
            match wish {
                Wish::Do(action) => self.act(ui.ctx(), action),
                Wish::Open(path) => self.open_asking(path.into()),
                Wish::Time(_) => {}
            }
        }
        status::show(ui, self);
        if self.settings.panel {
            self.show_panel(ui);
        }
        self.show_picture(ui);
        self.end_gesture(ui);
        self.show_dialogs(ui);
        self.show_saving(ui);
        self.keep_settings(ui);
    }

    fn show_panel(&mut self, ui: &mut Ui) {
        let most = (ui.available_width() - PICTURE_LEAST).clamp(PANEL_LEAST, 560.0);
        let panel = egui::Panel::left("panel").default_size(most.min(396.0)).size_range(PANEL_LEAST..=most);
        let frame = egui::Frame::new().fill(theme::of(ui).panel).inner_margin(egui::Margin::symmetric(6, 6));
        let panel_state = &mut self.panel;
        let (editor, node, reach) = (&self.editor, self.node, self.reach.as_ref());
        let lit = self.picture.hovered();
        let asked = panel.frame(frame).show(ui, |ui| panel_state.show(ui, editor, node, lit, reach)).inner;
        if let Some(node) = asked.chosen {
            self.choose(node);
        }
        self.picture.hint(asked.hinted);
        self.submit_all(asked.requests);
    }

    fn show_picture(&mut self, ui: &mut Ui) {
        self.picture.finish = self.settings.finish;
        self.picture.preset = self.settings.navigation;
        let hovered = self.picture.hovered();
        let shown = Shown {
            editor: &self.editor,
            node: self.node,
            how: self.panel.reaching(),
            guides: self.panel.guides(),
            reach: self.reach.as_ref(),
            keymap: &self.keymap,
            slow: self.software,
            driven: self.driving.is_under_way(),
        };
        let picture = &mut self.picture;
        let asked = egui::CentralPanel::no_frame().show(ui, |ui| picture.show(ui, &shown)).inner;
        if let Some(node) = asked.chosen {
            self.choose(node);
            ui.ctx().request_repaint();
        }
        if self.picture.hovered() != hovered {
            // The panel, which marks it as well, has been drawn already.
            ui.ctx().request_repaint();
        }
        self.submit_all(asked.requests);
    }

    fn submit_all(&mut self, requests: Vec<ChainRequest>) {
        if !requests.is_empty() && self.driving.is_under_way() {
            // The pointer takes over from the keys.
            self.driving.stop();
            self.submit(ChainRequest::Commit);
        }
        for request in requests {
            self.submit(request);
        }
    }

    /// A gesture ends where the pointer lets go or what keys drove has come to rest, and is undone by Escape.
    fn end_gesture(&mut self, ui: &Ui) {
        let (down, escape) = ui.input(|i| (i.pointer.any_down(), i.key_pressed(Key::Escape)));
        let driven = self.driving.is_under_way();
        if self.editor.in_gesture() && escape {
            self.driving.stopped_short();
            self.picture.let_go();
            self.submit(ChainRequest::Cancel);
        } else if self.editor.in_gesture() && !down && !driven {
            self.submit(ChainRequest::Commit);
        }
        // One more picture, in full quality, when movement ends.
        let moving = down || self.editor.in_gesture();
        if self.moving && !moving {
            ui.ctx().request_repaint();
        }
        self.moving = moving;
    }

    fn show_dialogs(&mut self, ui: &Ui) {
        let keys = self.keymap.clone();
        let answer = self.dialogs.show(ui.ctx(), &mut self.settings, None, &mut self.keymap);
        if keys != self.keymap {
            let saved = self.keeper.keep_keys(&self.keymap);
            self.tell(saved);
        }
        if let Some(answer) = answer {
            self.answered(ui, answer);
        }
    }
}
