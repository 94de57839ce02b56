//! What is asked in the middle of the window: a path, what to do with unsaved changes, and the help.

mod listing;

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use egui::{Context, Id, Key, Modal, RichText, TextEdit, Ui};

use crate::theme;
use listing::{Listing, Pick};

/// What is to be done once unsaved changes are dealt with.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Intent {
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
    /// Asks what becomes of unsaved changes.
    Unsaved(Intent),
    /// Asks whether another file may be replaced, and what comes after.
    Replace(PathBuf, Option<Intent>),
    /// Offers a pose that was lost when the program did not end by itself.
    Recover,
    /// Explains.
    Help,
}

/// What a dialog came to.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Answer {
    /// A file to open.
    Open(PathBuf),
    /// A file to save to, and what comes after.
    Save(PathBuf, Option<Intent>),
    /// The same, and the file that is there may go.
    Replace(PathBuf, Option<Intent>),
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
    now: Option<Dialog>,
    path: String,
    fresh: bool,
    listing: Listing,
    chooser: Option<Receiver<Option<PathBuf>>>,
    /// Whether the desktop's chooser gave nothing: it was cancelled, or there is none.
    unchosen: bool,
}

const SUFFIX: &str = ".pose.ron";

impl Dialogs {
    /// Whether a dialog is up.
    pub fn is_open(&self) -> bool {
        self.now.is_some()
    }

    /// Puts a dialog up in place of the one before.
    pub fn ask(&mut self, dialog: Dialog) {
        self.now = Some(dialog);
        self.fresh = true;
        self.unchosen = false;
        self.listing.forget();
    }

    /// Asks which file to open, beginning in the folder of the present one.
    pub fn open(&mut self, present: Option<&Path>) {
        let folder = present.and_then(Path::parent).filter(|p| !p.as_os_str().is_empty());
        self.path = folder.map_or_else(String::new, |p| format!("{}/", p.display()));
        self.ask(Dialog::OpenPath);
    }

    /// Asks where to save, beginning with the present file.
    pub fn save(&mut self, present: Option<&Path>, then: Option<Intent>) {
        self.path = present.map_or_else(|| format!("unnamed{SUFFIX}"), |path| path.display().to_string());
        self.ask(Dialog::SavePath(then));
    }

    /// Shows what is up; returns what it came to, once.
    pub fn show(&mut self, ctx: &Context) -> Option<Answer> {
        let dialog = self.now.clone()?;
        let mut answer = None;
        let mut close = false;
        let frame = egui::Frame::popup(&ctx.global_style()).inner_margin(16);
        let modal = Modal::new(Id::unique("dialog")).frame(frame).show(ctx, |ui| {
            ui.set_width(if dialog == Dialog::Help { 560.0 } else { 460.0 });
            match &dialog {
                Dialog::OpenPath | Dialog::SavePath(_) => (answer, close) = self.path(ui, &dialog),
                Dialog::Unsaved(intent) => (answer, close) = unsaved(ui, intent),
                Dialog::Replace(path, then) => (answer, close) = replace(ui, path, then.as_ref()),
                Dialog::Recover => answer = recover(ui),
                Dialog::Help => close = help(ui),
            }
        });
        answer = answer.or_else(|| self.chosen(&dialog));
        if answer.is_some() || close || modal.should_close() {
            self.now = None;
            self.chooser = None;
        }
        answer
    }

    fn path(&mut self, ui: &mut Ui, dialog: &Dialog) -> (Option<Answer>, bool) {
        let (title, verb) = match dialog {
            Dialog::OpenPath => ("Open a pose", "Open"),
            _ => ("Save the pose", "Save"),
        };
        ui.heading(title);
        ui.add_space(6.0);
        let field =
            TextEdit::singleline(&mut self.path).desired_width(f32::INFINITY).hint_text("pose.pose.ron");
        let response = ui.add(field).accessible_name("File path");
        if std::mem::take(&mut self.fresh) {
            response.request_focus();
            select_name(ui, response.id, &self.path);
        }
        let mut entered = response.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        if self.unchosen {
            ui.label(RichText::new("The desktop offered no file: type its path.").color(theme::WARNING));
        }
        if *dialog == Dialog::OpenPath {
            entered |= self.list(ui);
        }
        ui.add_space(8.0);
        let mut clicked = [false; 3];
        ui.horizontal(|ui| {
            let ready = !self.path.trim().is_empty();
            let main = egui::Button::new(verb).fill(ui.visuals().selection.bg_fill);
            // The bar has a button of the same name.
            let name = format!("{verb} the pose now");
            clicked[0] = ui.add_enabled(ready, main).accessible_name(name).clicked();
            clicked[1] = ui.button("Cancel").clicked();
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let busy = self.chooser.is_some();
                let tip = "The desktop's own file chooser";
                clicked[2] = ui.add_enabled(!busy, egui::Button::new("Browse…")).on_hover_text(tip).clicked();
            });
        });
        if clicked[2] {
            self.chooser = Some(browse(ui.ctx(), dialog, &self.path));
        }
        let answer = (entered || clicked[0]).then(|| self.answer(dialog)).flatten();
        (answer, clicked[1])
    }

    /// Lists the folder's poses; whether one was taken.
    fn list(&mut self, ui: &mut Ui) -> bool {
        self.listing.follow(&self.path);
        match self.listing.show(ui) {
            Some(Pick::Chosen(name)) => {
                self.path = self.listing.path(&name);
                false
            }
            Some(Pick::Taken(name)) => {
                self.path = self.listing.path(&name);
                true
            }
            None => false,
        }
    }

    fn answer(&self, dialog: &Dialog) -> Option<Answer> {
        let words = self.path.trim();
        (!words.is_empty()).then(|| answer_of(dialog, from_home(words)))
    }

    /// What the desktop's chooser came to, if it is done.
    fn chosen(&mut self, dialog: &Dialog) -> Option<Answer> {
        let chosen = match self.chooser.as_ref()?.try_recv() {
            Err(TryRecvError::Empty) => return None,
            Ok(chosen) => chosen,
            Err(TryRecvError::Disconnected) => None,
        };
        self.chooser = None;
        self.unchosen = chosen.is_none();
        self.fresh = self.unchosen;
        chosen.map(|path| answer_of(dialog, path))
    }
}

fn answer_of(dialog: &Dialog, path: PathBuf) -> Answer {
    match dialog {
        Dialog::SavePath(then) => Answer::Save(with_suffix(path), then.clone()),
        _ => Answer::Open(path),
    }
}

/// A path that begins with `~/` begins at home.
fn from_home(path: &str) -> PathBuf {
    let home = directories::BaseDirs::new().map(|dirs| dirs.home_dir().to_owned());
    match (path.strip_prefix("~/"), home) {
        (Some(rest), Some(home)) => home.join(rest),
        _ => PathBuf::from(path),
    }
}

/// A name without an extension gets that of poses.
fn with_suffix(path: PathBuf) -> PathBuf {
    if path.extension().is_some() {
        return path;
    }
    let mut name = path.into_os_string();
    name.push(SUFFIX);
    PathBuf::from(name)
}

/// Selects the file's name without its folder and its suffix, so that typing replaces just that.
fn select_name(ui: &Ui, id: Id, path: &str) {
    use egui::text::{CCursor, CCursorRange};
    let start = path.rfind(['/', '\\']).map_or(0, |i| i + 1);
    let end = path.strip_suffix(SUFFIX).map_or(path.len(), str::len).max(start);
    let chars = |bytes: usize| CCursor::new(path[..bytes].chars().count());
    let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
    state.cursor.set_char_range(Some(CCursorRange::two(chars(start), chars(end))));
    state.store(ui.ctx(), id);
}

/// Asks the desktop for a file on a thread of its own; the window is woken when it is done.
fn browse(ctx: &Context, dialog: &Dialog, path: &str) -> Receiver<Option<PathBuf>> {
    let (sender, receiver) = channel();
    let (ctx, saving) = (ctx.clone(), matches!(dialog, Dialog::SavePath(_)));
    let path = PathBuf::from(path);
    let mut chooser = rfd::FileDialog::new().add_filter("Poses", &["ron"]);
    if let Some(folder) = path.parent().filter(|p| !p.as_os_str().is_empty()) {
        chooser = chooser.set_directory(folder);
    }
    if let Some(name) = path.file_name().filter(|_| saving) {
        chooser = chooser.set_file_name(name.to_string_lossy());
    }
    std::thread::spawn(move || {
        let chosen = if saving { chooser.save_file() } else { chooser.pick_file() };
        // Nobody listens if the dialog was closed in the meantime.
        let _ = sender.send(chosen);
        ctx.request_repaint();
    });
    receiver
}

fn unsaved(ui: &mut Ui, intent: &Intent) -> (Option<Answer>, bool) {
    ui.heading("The pose is not saved");
    ui.add_space(4.0);
    let next = match intent {
        Intent::Open(_) => "before another one is opened",
        Intent::Quit => "before Posewright closes",
    };
    ui.label(format!("Save it {next}?"));
    ui.add_space(8.0);
    let mut answer = None;
    let mut close = false;
    ui.horizontal(|ui| {
        let save = egui::Button::new("Save").fill(ui.visuals().selection.bg_fill);
        if ui.add(save).clicked() {
            answer = Some(Answer::SaveFirst(intent.clone()));
        }
        if ui.button("Don't save").clicked() {
            answer = Some(Answer::Discard(intent.clone()));
        }
        close = ui.button("Cancel").clicked();
    });
    (answer, close)
}

fn recover(ui: &mut Ui) -> Option<Answer> {
    ui.heading("A pose was kept");
    ui.add_space(4.0);
    ui.label(
        "Posewright did not end by itself the last time. The pose as it was after the last gesture is here.",
    );
    ui.add_space(8.0);
    let mut answer = None;
    ui.horizontal(|ui| {
        let open = egui::Button::new("Open it").fill(ui.visuals().selection.bg_fill);
        if ui.add(open).clicked() {
            answer = Some(Answer::Recover(true));
        }
        if ui.button("Throw it away").clicked() {
            answer = Some(Answer::Recover(false));
        }
    });
    answer
}

fn replace(ui: &mut Ui, path: &Path, then: Option<&Intent>) -> (Option<Answer>, bool) {
    ui.heading("There is such a file");
    ui.add_space(4.0);
    ui.label(format!("Replace {}?", path.display()));
    ui.add_space(8.0);
    let (mut replace, mut close) = (false, false);
    ui.horizontal(|ui| {
        replace = ui.add(egui::Button::new("Replace").fill(ui.visuals().selection.bg_fill)).clicked();
        close = ui.button("Cancel").clicked();
    });
    (replace.then(|| Answer::Replace(path.to_owned(), then.cloned())), close)
}

const HELP: [(&str, &[(&str, &str)]); 5] = [
    (
        "In the panel",
        &[
            ("Drag a rail", "turn; Shift turns a tenth as far"),
            ("Double-click a rail", "back to 0"),
            ("Arrow keys", "one degree, on the rail last touched; with Shift a tenth"),
            ("Click a number", "type it; dragging it works as well"),
            ("Click a joint's name", "choose it"),
            ("Esc while dragging", "as if the drag had never been"),
        ],
    ),
    (
        "In the picture",
        &[
            ("Drag the figure", "what you grab follows the pointer"),
            ("Drag a limb's target", "reach: shoulder and elbow, or hip and knee, follow"),
            ("X, Y, Z while dragging", "along that axis; with Shift in the plane across it; again: freely"),
            ("Shift, Ctrl while dragging", "a tenth as far; by whole centimetres"),
            ("Esc or right click while dragging", "as if the drag had never been"),
            ("Click the figure or a joint", "choose it"),
            ("Drag empty space", "turn the view; with the other buttons anywhere"),
            ("Shift + drag", "slide the view"),
            ("Wheel", "nearer and farther, to the pointer"),
        ],
    ),
    (
        "The chosen joint",
        &[
            ("P", "its limb: free, then a point, then planted"),
            ("[ and ]", "the joint that carries it; the one that it carries"),
            ("Alt+R", "back to 0"),
        ],
    ),
    (
        "Views",
        &[
            ("1, 3, 7", "front, left, top; with Ctrl from the other side"),
            ("Home", "the whole figure"),
            ("F", "the chosen joint"),
        ],
    ),
    (
        "Files and steps",
        &[
            ("Ctrl+O, Ctrl+S, Ctrl+Shift+S", "open, save, save as"),
            ("Ctrl+Z, Ctrl+Shift+Z", "undo, redo"),
            ("Drop a .pose.ron", "open it"),
        ],
    ),
];

/// What the help takes besides its rows, points: heading, button, margins.
const HELP_FRAME: f32 = 130.0;

fn help(ui: &mut Ui) -> bool {
    ui.heading("Gestures and shortcuts");
    let room = ui.ctx().content_rect().height() - HELP_FRAME;
    egui::ScrollArea::vertical().max_height(room).min_scrolled_height(room).show(ui, |ui| {
        for (title, rows) in HELP {
            ui.add_space(8.0);
            ui.label(RichText::new(title).color(theme::ACCENT));
            egui::Grid::new(title).num_columns(2).min_col_width(190.0).spacing([16.0, 3.0]).show(ui, |ui| {
                for (what, does) in rows {
                    ui.label(RichText::new(*what).strong());
                    ui.label(*does);
                    ui.end_row();
                }
            });
        }
    });
    ui.add_space(10.0);
    ui.button("Close").clicked()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_without_extension_becomes_a_pose() {
        assert_eq!(with_suffix("a/b".into()), PathBuf::from("a/b.pose.ron"));
        assert_eq!(with_suffix("b.pose.ron".into()), PathBuf::from("b.pose.ron"));
        assert_eq!(with_suffix("b.ron".into()), PathBuf::from("b.ron"));
    }
}
