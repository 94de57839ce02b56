//! Opening, saving and ending, with what is asked on the way.

use std::path::{Path, PathBuf};

use edit::Request;
use egui::Ui;

use super::{Session, Status};
use crate::dialogs::{Answer, Dialog, Intent, Writing};
use crate::failure::Failure;
use crate::viewport::backdrop::Backdrop;
use crate::{disk, load};

impl Session {
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

    /// A pose without a file: the figure stands relaxed.
    fn begin_anew(&mut self) {
        let pose = load::standing(self.editor.figure());
        self.submit(Request::Open(Box::new(pose)));
        self.saved = self.editor.pose().clone();
        self.path = None;
        self.status = Status { message: "A new pose".to_owned(), ..Status::default() };
    }

    /// Opens a dropped or named file, after asking about unsaved changes.
    pub fn open_asking(&mut self, path: PathBuf) {
        if self.walks_on(&path) {
            return;
        }
        self.intend(Intent::Open(Some(path)));
    }

    /// Ends the session, after asking about unsaved changes.
    pub fn quit_asking(&mut self) {
        self.intend(Intent::Quit);
    }

    /// The file of a chain that a window on it should be opened with, if there is one: asked for once.
    pub fn take_elsewhere(&mut self) -> Option<PathBuf> {
        self.elsewhere.take()
    }

    /// Tells in the status line why something failed.
    pub fn tell_failure(&mut self, failure: Failure) {
        self.tell(Err(failure));
    }

    /// Does what is wanted, or asks first if the pose isn't saved.
    pub(super) fn intend(&mut self, intent: Intent) {
        if self.is_modified() {
            self.dialogs.ask(Dialog::Unsaved(intent));
        } else {
            self.proceed(intent);
        }
    }

    fn proceed(&mut self, intent: Intent) {
        match intent {
            Intent::Quit => self.quit = true,
            Intent::New => self.begin_anew(),
            Intent::Open(None) => self.dialogs.open(self.path.as_deref()),
            Intent::Open(Some(path)) if load::shows_chain(&path).unwrap_or(false) => {
                self.elsewhere = Some(path);
            }
            Intent::Open(Some(path)) => {
                let opened = self.open(&path);
                self.tell(opened);
            }
        }
    }

    /// Saves to the file if there is one, or asks where; then goes on with what was wanted.
    pub(super) fn save_or_ask(&mut self, then: Option<Intent>) {
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

    pub(super) fn take_dropped(&mut self, ui: &Ui) {
        let dropped = ui.input(|i| i.raw.dropped_files.first().map(|file| file.path().to_owned()));
        match dropped {
            Some(path) if Backdrop::takes(&path) => {
                let opened = self.viewport.backdrop.open(&path);
                self.tell(opened);
            }
            Some(path) => self.open_asking(path),
            None => {}
        }
    }

    /// Whether something else than this pose would be lost.
    fn would_replace(&self, writing: &Writing) -> bool {
        let own = matches!(writing, Writing::Pose(path, _) if self.path.as_ref() == Some(path));
        !own && writing.path().exists()
    }

    /// Does what a dialog came to.
    pub(super) fn answered(&mut self, ui: &Ui, answer: Answer) {
        match answer {
            Answer::Open(path) if self.walks_on(&path) => {}
            Answer::Open(path) => self.proceed(Intent::Open(Some(path))),
            Answer::Write(writing) if self.would_replace(&writing) => {
                self.dialogs.ask(Dialog::Replace(writing));
                ui.ctx().request_repaint();
            }
            Answer::Write(writing) | Answer::Replace(writing) => match writing {
                Writing::Pose(path, then) => self.save_then(&path, then),
                Writing::Picture(path) => self.save_picture(ui.ctx(), &path),
                Writing::Figure(path) => self.save_figure(&path),
            },
            Answer::SaveFirst(intent) => self.save_or_ask(Some(intent)),
            Answer::Discard(intent) => self.proceed(intent),
            Answer::Recover(wanted) => self.recover(wanted),
        }
    }
}
