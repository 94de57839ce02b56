//! What is asked in the middle of the window: a path, what to do with unsaved changes, settings, and the sheet of keys.

mod asking;
mod keys;
mod listing;
mod path;
mod picture;
mod settings;
mod sheet;

use std::path::{Path, PathBuf};
use std::sync::mpsc::Receiver;

use egui::{Context, Id, Modal};

use crate::failure::Failure;
use crate::keymap::Keymap;
use crate::picture::Choices;
use crate::settings::Settings;
use crate::viewport::Viewport;
use keys::KeyTable;
use listing::Listing;

/// What a window works on, in the words of its dialogs.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Paper {
    /// Poses of a figure.
    #[default]
    Pose,
    /// Chains and robots.
    Chain,
    /// Ground that a figure walks on; only ever opened.
    Ground,
    /// What blends a walk; only ever opened.
    Tree,
}

impl Paper {
    /// One of them: `pose`.
    const fn noun(self) -> &'static str {
        match self {
            Paper::Pose => "pose",
            Paper::Chain => "chain",
            Paper::Ground => "ground",
            Paper::Tree => "blend tree",
        }
    }

    /// What the name of its files ends with.
    const fn suffix(self) -> &'static str {
        match self {
            Paper::Pose => ".pose.ron",
            Paper::Chain => ".chain.ron",
            Paper::Ground => ".obj",
            Paper::Tree => ".blend.ron",
        }
    }

    /// What the window opens, and so lists.
    const fn opens(self) -> &'static [&'static str] {
        match self {
            Paper::Pose => &[".pose.ron"],
            Paper::Chain => &[".chain.ron", ".urdf"],
            Paper::Ground => &[".obj", ".stl", ".dae", ".glb"],
            Paper::Tree => &[".blend.ron"],
        }
    }
}

/// What is to be done once unsaved changes are dealt with.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Intent {
    /// Begins a new pose.
    New,
    /// Opens that file, or asks for one.
    Open(Option<PathBuf>),
    /// Ends the program.
    Quit,
}

/// A dialog that is up.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Dialog {
    /// Asks which file to open.
    OpenPath,
    /// Asks where to save, and what comes after.
    SavePath(Option<Intent>),
    /// Asks where to save a picture of the view.
    PicturePath,
    /// Asks where to save the figure.
    FigurePath,
    /// Asks what becomes of unsaved changes.
    Unsaved(Intent),
    /// Asks whether another file may be replaced.
    Replace(Writing),
    /// Offers a pose that was lost when the program did not end by itself.
    Recover,
    /// Look, navigation and keys.
    Settings,
    /// Explains.
    Help,
}

/// What is to be written to a file.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Writing {
    /// The pose, and what comes after.
    Pose(PathBuf, Option<Intent>),
    /// A picture of the view.
    Picture(PathBuf),
    /// The figure with its body.
    Figure(PathBuf),
}

impl Writing {
    /// The file.
    pub fn path(&self) -> &Path {
        match self {
            Writing::Pose(path, _) | Writing::Picture(path) | Writing::Figure(path) => path,
        }
    }
}

/// What a dialog came to.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Answer {
    /// A file to open.
    Open(PathBuf),
    /// A file to write.
    Write(Writing),
    /// The same, and the file that is there may go.
    Replace(Writing),
    /// Unsaved changes are saved before this.
    SaveFirst(Intent),
    /// Unsaved changes are given up for this.
    Discard(Intent),
    /// Whether the lost pose is wanted back.
    Recover(bool),
}

/// The dialog that is up, if any, and the desktop's file chooser at work.
#[derive(Default)]
pub struct Dialogs {
    paper: Paper,
    /// What is asked for while a file is to be opened.
    opens: Paper,
    now: Option<Dialog>,
    /// The dialog that asked for the file which is being opened or written.
    asked: Option<Dialog>,
    /// Why the file that was named before could not be opened or written.
    trouble: Option<String>,
    path: String,
    /// What a picture's name gets if it has no ending.
    picture_ending: &'static str,
    fresh: bool,
    listing: Listing,
    chooser: Option<Receiver<Option<PathBuf>>>,
    /// Whether the desktop's chooser gave nothing: it was cancelled, or there is none.
    unchosen: bool,
    /// The section of the settings.
    section: settings::Section,
    key_table: KeyTable,
    /// What is looked for in the sheet of keys.
    sought: String,
}

const FIGURE_SUFFIX: &str = ".figure.ron";

impl Dialogs {
    /// Those of a window on such work.
    pub fn of(paper: Paper) -> Dialogs {
        Dialogs { paper, opens: paper, ..Dialogs::default() }
    }

    /// Whether a dialog is up.
    pub fn is_open(&self) -> bool {
        self.now.is_some()
    }

    /// Puts a dialog up in place of the one before.
    pub fn ask(&mut self, dialog: Dialog) {
        // Whoever says that a file may go still has in mind the path that was named.
        if !matches!(dialog, Dialog::Replace(_)) {
            self.asked = None;
        }
        self.now = Some(dialog);
        self.fresh = true;
        self.unchosen = false;
        self.trouble = None;
        self.listing.forget();
    }

    /// What came of the last answer. Where a file that was asked for could not be opened or written, the dialog is back with the
    /// path as it was named, and tells why.
    pub fn came_of(&mut self, done: &Result<(), Failure>) {
        if self.now.is_some() {
            return;
        }
        if let (Some(dialog), Err(failure)) = (self.asked.take(), done) {
            self.ask(dialog);
            self.trouble = Some(failure.to_string());
        }
    }

    /// Asks which file to open, beginning in the folder of the present one.
    pub fn open(&mut self, present: Option<&Path>) {
        self.open_other(self.paper, present);
    }

    /// Asks which file of another kind to open, beginning in the folder of the present one.
    pub fn open_other(&mut self, paper: Paper, present: Option<&Path>) {
        self.opens = paper;
        let folder = present.and_then(Path::parent).filter(|p| !p.as_os_str().is_empty());
        self.path = folder.map_or_else(String::new, |p| format!("{}/", p.display()));
        self.ask(Dialog::OpenPath);
    }

    /// Asks where to save, beginning with the present file.
    pub fn save(&mut self, present: Option<&Path>, then: Option<Intent>) {
        let suffix = self.paper.suffix();
        self.path = present.map_or_else(|| format!("unnamed{suffix}"), |path| path.display().to_string());
        // What was opened in another format is saved beside it.
        if self.paper == Paper::Chain
            && let Some(bare) = self.path.strip_suffix(".urdf")
        {
            self.path = format!("{bare}{suffix}");
        }
        self.ask(Dialog::SavePath(then));
    }

    /// Asks where to save a picture of the view and what it is to be, beginning beside the pose.
    pub fn save_picture(&mut self, present: Option<&Path>, choices: &Choices) {
        let pose = present.map_or_else(|| "unnamed".to_owned(), |path| path.display().to_string());
        let ending = picture::ending(choices);
        let bare = self.paper.opens().iter().find_map(|suffix| pose.strip_suffix(suffix));
        self.path = format!("{}{ending}", bare.unwrap_or(&pose));
        self.ask(Dialog::PicturePath);
    }

    /// Asks where to save the figure, beginning in a folder.
    pub fn save_figure(&mut self, folder: Option<&Path>) {
        let name = format!("own{FIGURE_SUFFIX}");
        self.path = folder.map_or(name.clone(), |folder| folder.join(&name).display().to_string());
        self.ask(Dialog::FigurePath);
    }

    /// Shows what is up; returns what it came to, once. Settings, keys and what a figure's window shows are changed in place.
    pub fn show(
        &mut self,
        ctx: &Context,
        settings: &mut Settings,
        viewport: Option<&mut Viewport>,
        keymap: &mut Keymap,
    ) -> Option<Answer> {
        let dialog = self.now.clone()?;
        let mut answer = None;
        let mut close = false;
        // A key that is being asked for is not the dialog's.
        self.key_table.listen(ctx, keymap);
        let frame = egui::Frame::popup(&ctx.global_style()).inner_margin(16);
        let modal = Modal::new(Id::unique("dialog")).frame(frame).show(ctx, |ui| {
            ui.set_width(self.width(ctx, &dialog));
            match &dialog {
                Dialog::OpenPath | Dialog::SavePath(_) | Dialog::PicturePath | Dialog::FigurePath => {
                    (answer, close) = self.path(ui, &dialog, settings);
                }
                Dialog::Unsaved(intent) => (answer, close) = asking::unsaved(ui, intent, self.paper),
                Dialog::Replace(writing) => (answer, close) = asking::replace(ui, writing),
                Dialog::Recover => answer = asking::recover(ui),
                Dialog::Settings => close = self.settings(ui, settings, viewport, keymap),
                Dialog::Help => close = self.sheet(ui, keymap),
            }
        });
        answer = answer.or_else(|| self.chosen(&dialog));
        if answer.is_some() || close || modal.should_close() {
            if answer.is_none() {
                self.asked = None;
            }
            self.now = None;
            self.chooser = None;
            self.key_table = KeyTable::default();
        }
        answer
    }

    /// What a dialog takes at most, points.
    fn width(&self, ctx: &Context, dialog: &Dialog) -> f32 {
        let wanted = match dialog {
            Dialog::Help => 940.0,
            Dialog::Settings => 620.0,
            _ => 460.0,
        };
        (ctx.content_rect().width() - 60.0).min(wanted)
    }
}
