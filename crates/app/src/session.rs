//! One window's work: the editor, the file that it came from, and how it is looked at. Drawn by [`Session::ui`] in the
//! window, in tests and in pictures alike.

use std::path::{Path, PathBuf};

use edit::{Document, Editor, Request};
use egui::{Key, Modifiers, Ui};
use rig::Pose;

use crate::dialogs::{Dialog, Dialogs, Intent};
use crate::disk::{self, Disk};
use crate::failure::Failure;
use crate::keepsafe::{Keepsafe, Lost};
use crate::panels::Panels;
use crate::shortcuts::{self, Wish};
use crate::viewport::{self, Viewport};
use crate::{load, status_line, theme, toolbar};

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
    keepsafe: Option<Keepsafe>,
    /// The revision that the keepsafe holds.
    kept: u64,
    /// What another window lost, while it is offered.
    lost: Option<Lost>,
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
            keepsafe: None,
            kept: 0,
            lost: None,
        }
    }

    /// Keeps every committed pose in a folder, and offers what was lost there the last time.
    ///
    /// A folder that can't be written is told in the status line; the session goes on without.
    pub fn keep_in(&mut self, folder: &Path) {
        self.kept = self.editor.revision();
        match Keepsafe::begin(folder) {
            Ok((keepsafe, lost)) => {
                self.keepsafe = Some(keepsafe);
                self.lost = lost.into_iter().next();
                if self.lost.is_some() {
                    self.dialogs.ask(Dialog::Recover);
                }
            }
            Err(error) => {
                let message = format!("{}: poses can't be kept here: {error}", folder.display());
                self.tell(Err(Failure::Input(message)));
            }
        }
    }

    /// The session has ended by itself: nothing is to be offered again.
    pub fn end(&mut self) {
        if let Some(keepsafe) = self.keepsafe.take() {
            keepsafe.done();
        }
    }

    /// Hands a pose that has changed to the keepsafe, gestures when they are committed.
    fn keep(&mut self) {
        let revision = self.editor.revision();
        if let Some(keepsafe) =
            self.keepsafe.as_ref().filter(|_| !self.editor.in_gesture() && revision != self.kept)
        {
            keepsafe.keep(rig::write_pose(self.editor.figure(), self.editor.pose()));
            self.kept = revision;
        }
    }

    /// Takes up the lost pose or forgets it.
    fn recover(&mut self, wanted: bool) {
        let Some(lost) = self.lost.take() else { return };
        if wanted {
            let figure = self.editor.figure().clone();
            match rig::parse_pose(&lost.text) {
                Ok(patch) if rig::check_patch(&figure, &patch).is_ok() => {
                    self.submit(Request::Open(Box::new(patch.onto(&figure.rest_pose()))));
                    self.status =
                        Status { message: "Opened the pose that was kept".to_owned(), ..Status::default() };
                }
                _ => {
                    let message = "the pose that was kept is not of this figure; it stays on disk".to_owned();
                    self.tell(Err(Failure::Input(message)));
                    return;
                }
            }
        }
        lost.forget();
    }

    /// The editor.
    pub fn editor(&self) -> &Editor {
        &self.editor
    }

    /// What the status line says.
    pub fn status(&self) -> &Status {
        &self.status
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

    /// Opens a pose file, now; what it doesn't name is at rest.
    ///
    /// # Errors
    /// The file can't be read, or is no pose for this figure: file, line and column.
    pub fn open(&mut self, path: &Path) -> Result<(), Failure> {
        let pose = load::pose(self.editor.figure(), path)?;
        self.submit(Request::Open(Box::new(pose)));
        self.settle(path, "Opened");
        Ok(())
    }

    /// Saves the pose to a file.
    ///
    /// # Errors
    /// The file can't be written.
    pub fn save(&mut self, path: &Path) -> Result<(), Failure> {
        self.submit(Request::Commit);
        disk::write_atomic(path, rig::write_pose(self.editor.figure(), self.editor.pose()).as_bytes())?;
        self.settle(path, "Saved");
        Ok(())
    }

    /// The pose is now the file's.
    fn settle(&mut self, path: &Path, done: &str) {
        self.saved = self.editor.pose().clone();
        self.path = Some(path.to_owned());
        self.status = Status { message: format!("{done} {}", path.display()), ..Status::default() };
    }

    /// Opens a dropped or named file, after asking about unsaved changes.
    pub fn open_asking(&mut self, path: PathBuf) {
        self.intend(Intent::Open(Some(path)));
    }

    /// Ends the session, after asking about unsaved changes.
    pub fn quit_asking(&mut self) {
        self.intend(Intent::Quit);
    }

    /// Does what is wanted, or asks first if the pose isn't saved.
    fn intend(&mut self, intent: Intent) {
        if self.is_modified() {
            self.dialogs.ask(Dialog::Unsaved(intent));
        } else {
            self.proceed(intent);
        }
    }

    fn proceed(&mut self, intent: Intent) {
        match intent {
            Intent::Quit => self.quit = true,
            Intent::Open(None) => self.dialogs.open(self.path.as_deref()),
            Intent::Open(Some(path)) => {
                let opened = self.open(&path);
                self.tell(opened);
            }
        }
    }

    fn tell(&mut self, result: Result<(), Failure>) {
        if let Err(error) = result {
            self.status = Status { message: error.to_string(), fault: true, clamped: false };
        }
    }

    /// Saves to the file if there is one, or asks where; then goes on with what was wanted.
    fn save_or_ask(&mut self, then: Option<Intent>) {
        match self.path.clone() {
            Some(path) => self.save_then(&path, then),
            None => self.dialogs.save(None, then),
        }
    }

    fn save_then(&mut self, path: &Path, then: Option<Intent>) {
        match self.save(path) {
            Ok(()) => {
                if let Some(intent) = then {
                    self.proceed(intent);
                }
            }
            Err(error) => self.tell(Err(error)),
        }
    }

    /// Draws everything and does what was asked for.
    pub fn ui(&mut self, ui: &mut Ui) {
        self.take_dropped(ui);
        let modal = self.dialogs.is_open();
        if !modal {
            self.keys(ui);
        }
        let asked = toolbar::show(ui, self);
        for action in asked {
            self.act(action);
        }
        status_line::show(ui, self);
        let panel = egui::Panel::left("panel").default_size(396.0).size_range(340.0..=560.0);
        let frame = egui::Frame::new().fill(theme::PANEL).inner_margin(egui::Margin::symmetric(6, 6));
        self.panels.light(self.viewport.hovered());
        let requests = panel.frame(frame).show(ui, |ui| self.panels.show(ui, &self.editor)).inner;
        self.submit_all(requests);
        self.picture(ui);
        self.end_gesture(ui);
        self.dialogs(ui);
        self.keep();
    }

    fn picture(&mut self, ui: &mut Ui) {
        self.viewport.hint(self.panels.hinted());
        let asked = egui::CentralPanel::no_frame()
            .show(ui, |ui| self.viewport.show(ui, &self.editor, self.panels.selection(), self.software))
            .inner;
        if let Some(how) = asked.chosen {
            self.panels.choose(&self.editor.figure().skeleton, how);
            ui.ctx().request_repaint();
        }
        self.submit_all(asked.requests);
    }

    fn submit_all(&mut self, requests: Vec<Request>) {
        for request in requests {
            self.submit(request);
        }
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

    fn take_dropped(&mut self, ui: &Ui) {
        let dropped = ui.input(|i| i.raw.dropped_files.first().map(|file| file.path().to_owned()));
        if let Some(path) = dropped {
            self.open_asking(path);
        }
    }

    fn keys(&mut self, ui: &Ui) {
        use toolbar::Action;
        let shift = Modifiers::COMMAND | Modifiers::SHIFT;
        let shortcuts = [
            (shift, Key::S, Action::SaveAs),
            (Modifiers::COMMAND, Key::S, Action::Save),
            (Modifiers::COMMAND, Key::O, Action::Open),
            (shift, Key::Z, Action::Redo),
            (Modifiers::COMMAND, Key::Z, Action::Undo),
            (Modifiers::COMMAND, Key::Y, Action::Redo),
            (Modifiers::COMMAND, Key::Q, Action::Quit),
            (Modifiers::NONE, Key::F1, Action::Help),
        ];
        for (modifiers, key, action) in shortcuts {
            if ui.input_mut(|i| i.consume_key(modifiers, key)) {
                self.act(action);
            }
        }
        let selected = self.panels.selected();
        viewport::keys(ui, &mut self.viewport, &self.editor, selected);
        match shortcuts::wish(ui, &self.editor, selected) {
            Some(Wish::Ask(commands)) => {
                self.submit(Request::PreviewAll(commands));
                self.submit(Request::Commit);
            }
            Some(Wish::Choose(bone)) => self.panels.select(Some(bone)),
            None => {}
        }
    }

    fn act(&mut self, action: toolbar::Action) {
        use toolbar::Action;
        match action {
            Action::Ask(request) => self.submit(*request),
            Action::Undo => self.submit(Request::Undo),
            Action::Redo => self.submit(Request::Redo),
            Action::Open => self.intend(Intent::Open(None)),
            Action::Save => self.save_or_ask(None),
            Action::SaveAs => self.dialogs.save(self.path.as_deref(), None),
            Action::Quit => self.quit_asking(),
            Action::View(view) => self.viewport.view(view),
            Action::Projection(projection) => self.viewport.set_projection(projection),
            Action::FrameAll => self.viewport.frame_all(&self.editor),
            Action::Marks(on) => self.viewport.marks = on,
            Action::Help => self.dialogs.ask(Dialog::Help),
        }
    }

    fn dialogs(&mut self, ui: &Ui) {
        use crate::dialogs::Answer;
        match self.dialogs.show(ui.ctx()) {
            Some(Answer::Open(path)) => self.proceed(Intent::Open(Some(path))),
            Some(Answer::Save(path, then)) if path.exists() && self.path.as_ref() != Some(&path) => {
                self.dialogs.ask(Dialog::Replace(path, then));
                ui.ctx().request_repaint();
            }
            Some(Answer::Save(path, then) | Answer::Replace(path, then)) => self.save_then(&path, then),
            Some(Answer::SaveFirst(intent)) => self.save_or_ask(Some(intent)),
            Some(Answer::Discard(intent)) => self.proceed(intent),
            Some(Answer::Recover(wanted)) => self.recover(wanted),
            None => {}
        }
    }

    /// The document as it shows now.
    pub fn document(&self) -> &Document {
        self.editor.document()
    }
}
