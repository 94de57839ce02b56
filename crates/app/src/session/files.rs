//! Opening, saving and ending, with what is asked on the way.

use std::path::{Path, PathBuf};

use edit::Request;
use egui::Ui;

use super::{Session, Status};
use crate::dialogs::{Answer, Dialog, Intent, Writing};
use crate::disk;
use crate::failure::Failure;
use crate::load::{self, Kind};
use crate::viewport::backdrop::Backdrop;

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
    /// The file can't be written, or isn't called like a pose.
    pub fn save(&mut self, path: &Path) -> Result<(), Failure> {
        if Kind::of(path) != Ok(Kind::Pose) {
            return Err(Failure::Input(format!("{}: a pose is saved as .pose.ron", path.display())));
        }
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
        match self.walks_on(&path) {
            Some(opened) => self.tell(opened),
            None => self.intend(Intent::Open(Some(path))),
        }
    }

    /// Ends the session, after asking about unsaved changes.
    pub fn quit_asking(&mut self) {
        self.intend(Intent::Quit);
    }

    /// The file of a chain that a window on it should be opened with, if there is one: asked for once.
    pub fn take_elsewhere(&mut self) -> Option<PathBuf> {
        self.elsewhere.take()
    }

    /// Tells why a file could not be opened: in the dialog that asked for it, and in the status line.
    pub fn tell_failure(&mut self, failure: Failure) {
        let done = Err(failure);
        self.dialogs.came_of(&done);
        self.tell(done);
    }

    /// Does what is wanted, or asks first if the pose isn't saved.
    pub(super) fn intend(&mut self, intent: Intent) {
        if self.is_modified() {
            self.dialogs.ask(Dialog::Unsaved(intent));
        } else {
            let done = self.proceed(intent);
            self.tell(done);
        }
    }

    fn proceed(&mut self, intent: Intent) -> Result<(), Failure> {
        match intent {
            Intent::Quit => self.quit = true,
            Intent::New => self.begin_anew(),
            Intent::Open(None) => self.dialogs.open(self.path.as_deref()),
            Intent::Open(Some(path)) if load::shows_chain(&path).unwrap_or(false) => {
                self.elsewhere = Some(path);
            }
            Intent::Open(Some(path)) => return self.open(&path),
        }
        Ok(())
    }

    /// Saves to the file if there is one, or asks where; then goes on with what was wanted.
    ///
    /// # Errors
    /// The file can't be written.
    pub(super) fn save_or_ask(&mut self, then: Option<Intent>) -> Result<(), Failure> {
        let Some(path) = self.path.clone() else {
            self.dialogs.save(None, then);
            return Ok(());
        };
        self.save_then(&path, then)
    }

    fn save_then(&mut self, path: &Path, then: Option<Intent>) -> Result<(), Failure> {
        self.save(path)?;
        then.map_or(Ok(()), |intent| self.proceed(intent))
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

    /// Does what a dialog came to; a file that is at fault is asked for again.
    pub(super) fn answered(&mut self, ui: &Ui, answer: Answer) {
        let done = self.carry_out(ui, answer);
        // Of another kind of file the window that opens it tells what came of it.
        if self.elsewhere.is_none() {
            self.dialogs.came_of(&done);
        }
        self.tell(done);
    }

    fn carry_out(&mut self, ui: &Ui, answer: Answer) -> Result<(), Failure> {
        match answer {
            Answer::Open(path) => match self.walks_on(&path) {
                Some(opened) => opened,
                None => self.proceed(Intent::Open(Some(path))),
            },
            Answer::Write(writing) if self.would_replace(&writing) => {
                self.dialogs.ask(Dialog::Replace(writing));
                ui.ctx().request_repaint();
                Ok(())
            }
            Answer::Write(writing) | Answer::Replace(writing) => match writing {
                Writing::Pose(path, then) => self.save_then(&path, then),
                Writing::Picture(path) => self.save_picture(ui.ctx(), &path),
                Writing::Figure(path) => self.save_figure(&path),
            },
            Answer::SaveFirst(intent) => self.save_or_ask(Some(intent)),
            Answer::Discard(intent) => self.proceed(intent),
            Answer::Recover(wanted) => {
                self.recover(wanted);
                Ok(())
            }
        }
    }
}
