//! Opening, saving and ending, with what is asked on the way; settings and keys from their folder.

use std::path::{Path, PathBuf};

use edit::{ChainDocument, ChainEditor, ChainRequest};
use egui::{Context, Ui};

use super::ChainSession;
use crate::dialogs::{Answer, Dialog, Intent, Writing};
use crate::failure::Failure;
use crate::finish::Finish;
use crate::library::chains;
use crate::load::{self, Kind};
use crate::picture::Subject;
use crate::saving::{Saving, Seen};
use crate::settings::{ConfigFolder, Keeper};

impl ChainSession {
    /// A session on the chain that a file shows: a URDF, a chain file, or what a script makes of one. Joints of a URDF whose range
    /// leaves out 0 stand at its nearer end. What is odd but does no harm is told in the status line.
    ///
    /// # Errors
    /// A file at fault: where and why; one that shows no chain.
    pub fn open(path: &Path) -> Result<ChainSession, Failure> {
        let kind = Kind::of(path)?;
        if kind == Kind::Script {
            let (editor, _) = load::chain_editor(path)?;
            return Ok(ChainSession::new(editor, None));
        }
        let (editor, warnings) = load::open_chain(path)?;
        let editor = match kind {
            Kind::Urdf => {
                let document = editor.document().clone();
                let pose = document.robot.clamped(&document.pose);
                ChainEditor::of(ChainDocument { pose, ..document }.on_the_ground())
            }
            _ => editor,
        };
        let mut session = ChainSession::new(editor, Some(path.to_owned()));
        session.warn(&warnings);
        Ok(session)
    }

    /// Takes settings and keys from a folder and keeps them there from now on.
    ///
    /// A file at fault is told in the status line with its place; its defaults stay in force.
    pub fn configure_from(&mut self, folder: ConfigFolder) {
        let (keeper, settings, keymap, fault) = Keeper::open(folder);
        (self.keeper, self.settings, self.keymap) = (keeper, settings, keymap);
        self.tell(fault.map_or(Ok(()), Err));
    }

    /// Gives the chain another look.
    pub fn set_finish(&mut self, finish: Finish) {
        self.settings.finish = finish;
    }

    /// Writes what has changed, once the pointer lets go.
    pub(super) fn keep_settings(&mut self, ui: &Ui) {
        if ui.input(|i| i.pointer.any_down()) {
            return;
        }
        let saved = self.keeper.keep(&self.settings);
        self.tell(saved);
    }

    /// Tells in the status line what was odd about the file.
    fn warn(&mut self, warnings: &[String]) {
        match warnings {
            [] => {}
            [only] => self.say(only.clone()),
            [first, ..] => self.say(format!("{} warnings, the first: {first}", warnings.len())),
        }
    }

    /// Saves the chain to a file.
    ///
    /// # Errors
    /// The file can't be written, or a chain can't be saved as such a file.
    pub fn save(&mut self, path: &Path) -> Result<(), Failure> {
        self.driving.stop();
        self.submit(ChainRequest::Commit);
        load::save_chain(self.editor.document(), self.path.as_deref(), path)?;
        self.saved = self.editor.document().clone();
        self.path = Some(path.to_owned());
        self.say(format!("Saved {}", path.display()));
        Ok(())
    }

    /// Opens a dropped or named file, after asking about unsaved changes.
    pub fn open_asking(&mut self, path: PathBuf) {
        self.intend(Intent::Open(Some(path)));
    }

    /// Ends the session, after asking about unsaved changes.
    pub fn quit_asking(&mut self) {
        self.intend(Intent::Quit);
    }

    /// The file that a window on it should be opened with, if there is one: asked for once.
    pub fn take_elsewhere(&mut self) -> Option<PathBuf> {
        self.elsewhere.take()
    }

    /// Tells why a file could not be opened: in the dialog that asked for it, and in the status line.
    pub fn tell_failure(&mut self, failure: Failure) {
        let done = Err(failure);
        self.dialogs.came_of(&done);
        self.tell(done);
    }

    /// Does what is wanted, or asks first if the chain isn't saved.
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
            Intent::Open(None) => self.dialogs.open(self.path.as_deref()),
            Intent::Open(Some(path)) => self.elsewhere = Some(path),
            Intent::New => {}
        }
    }

    /// Saves to the file if there is one that can hold it, or asks where; then goes on with what was wanted.
    ///
    /// # Errors
    /// The file can't be written.
    pub(super) fn save_or_ask(&mut self, then: Option<Intent>) -> Result<(), Failure> {
        let own = self.path.clone().filter(|path| Kind::of(path) == Ok(Kind::Chain) && !is_shipped(path));
        match own {
            Some(path) => self.save_then(&path, then),
            None => {
                self.ask_where(then);
                Ok(())
            }
        }
    }

    /// Asks where to save, beginning with the present file, or the name of a shipped one.
    pub(super) fn ask_where(&mut self, then: Option<Intent>) {
        self.dialogs.save(self.named().as_deref(), then);
    }

    /// The present file, or the bare name of a shipped one.
    pub(super) fn named(&self) -> Option<PathBuf> {
        match self.path.as_deref().is_some_and(is_shipped) {
            true => Some(PathBuf::from(self.file_name())),
            false => self.path.clone(),
        }
    }

    fn save_then(&mut self, path: &Path, then: Option<Intent>) -> Result<(), Failure> {
        self.save(path)?;
        if let Some(intent) = then {
            self.proceed(intent);
        }
        Ok(())
    }

    /// Begins to write what the view shows, without marks, as was chosen in the dialog.
    fn save_picture(&mut self, ctx: &Context, path: &Path) -> Result<(), Failure> {
        let seen = Seen {
            subject: Subject::of_chain(self.editor.document()),
            camera: self.picture.camera,
            finish: self.settings.finish,
            file: self.path.as_deref(),
        };
        let begun = Saving::begin(&mut self.saving, ctx, path, seen, &self.settings.picture)?;
        self.say(begun);
        Ok(())
    }

    fn told(&mut self, words: Result<String, Failure>) {
        match words {
            Ok(words) => self.say(words),
            Err(failure) => self.tell(Err(failure)),
        }
    }

    /// Shows how far the pictures are, stops them when asked, and tells when they are done.
    pub(super) fn show_saving(&mut self, ui: &Ui) {
        if let Some(words) = Saving::show(&mut self.saving, ui) {
            self.told(words);
        }
    }

    /// Whether a picture is being saved.
    pub fn is_saving(&self) -> bool {
        self.saving.is_some()
    }

    pub(super) fn take_dropped(&mut self, ui: &Ui) {
        let dropped = ui.input(|i| i.raw.dropped_files.first().map(|file| file.path().to_owned()));
        if let Some(path) = dropped {
            self.open_asking(path);
        }
    }

    /// Does what a dialog came to; a file that is at fault is asked for again.
    pub(super) fn answered(&mut self, ui: &Ui, answer: Answer) {
        let done = self.carry_out(ui, answer);
        // Of a file to be opened the window that opens it tells what came of it.
        if self.elsewhere.is_none() {
            self.dialogs.came_of(&done);
        }
        self.tell(done);
    }

    fn carry_out(&mut self, ui: &Ui, answer: Answer) -> Result<(), Failure> {
        match answer {
            Answer::Open(path) => self.proceed(Intent::Open(Some(path))),
            Answer::Write(writing)
                if self.path.as_deref() != Some(writing.path()) && writing.path().exists() =>
            {
                self.dialogs.ask(Dialog::Replace(writing));
                ui.ctx().request_repaint();
            }
            Answer::Write(Writing::Pose(path, then)) | Answer::Replace(Writing::Pose(path, then)) => {
                return self.save_then(&path, then);
            }
            Answer::SaveFirst(intent) => return self.save_or_ask(Some(intent)),
            Answer::Discard(intent) => self.proceed(intent),
            Answer::Write(Writing::Picture(path)) | Answer::Replace(Writing::Picture(path)) => {
                return self.save_picture(ui.ctx(), &path);
            }
            // A window on a chain asks for no figures, and keeps nothing for a next start.
            Answer::Write(_) | Answer::Replace(_) | Answer::Recover(_) => {}
        }
        Ok(())
    }
}

/// Whether a path means a chain that comes with the program.
fn is_shipped(path: &Path) -> bool {
    path.to_str().is_some_and(chains::is_shipped)
}
