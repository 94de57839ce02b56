//! Asks for a file: a field for its path, a list of the folder's poses, and the desktop's own chooser.

use std::path::PathBuf;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use egui::{Context, Id, Key, RichText, TextEdit, Ui};

use super::listing::Pick;
use super::{Answer, Dialog, Dialogs, FIGURE_SUFFIX, Paper, Writing, picture};
use crate::picture::Format;
use crate::settings::Settings;

impl Dialogs {
    pub(super) fn path(
        &mut self,
        ui: &mut Ui,
        dialog: &Dialog,
        settings: &mut Settings,
    ) -> (Option<Answer>, bool) {
        let (title, verb, what) = match dialog {
            Dialog::OpenPath => ("Open a", "Open", self.opens.noun()),
            Dialog::PicturePath => ("Save the", "Save", "picture"),
            Dialog::FigurePath => ("Save the", "Save", "figure"),
            _ => ("Save the", "Save", self.paper.noun()),
        };
        ui.heading(format!("{title} {what}"));
        ui.add_space(6.0);
        let field = TextEdit::singleline(&mut self.path).desired_width(f32::INFINITY).hint_text("a path");
        let response = ui.add(field).accessible_name("File path");
        if std::mem::take(&mut self.fresh) {
            response.request_focus();
            select_name(ui, response.id, &self.path, self.paper);
        }
        if response.changed() {
            self.trouble = None;
        }
        if let Some(trouble) = &self.trouble {
            ui.label(RichText::new(trouble).color(ui.visuals().error_fg_color));
        }
        let mut entered = response.lost_focus() && ui.input(|i| i.key_pressed(Key::Enter));
        if self.unchosen {
            ui.label(
                RichText::new("The desktop offered no file: type its path.")
                    .color(ui.visuals().warn_fg_color),
            );
        }
        if *dialog == Dialog::OpenPath {
            entered |= self.list(ui);
        }
        if *dialog == Dialog::PicturePath {
            let former = picture::ending(&settings.picture);
            picture::choices(ui, &mut settings.picture, &mut settings.finish);
            self.follow_ending(former, picture::ending(&settings.picture));
        }
        ui.add_space(8.0);
        let mut clicked = [false; 3];
        ui.horizontal(|ui| {
            let ready = !self.path.trim().is_empty();
            let main = egui::Button::new(verb).fill(ui.visuals().selection.bg_fill);
            // The bar has a button of the same name.
            let name = format!("{verb} the {what} now");
            clicked[0] = ui.add_enabled(ready, main).accessible_name(name).clicked();
            clicked[1] = ui.button("Cancel").clicked();
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let busy = self.chooser.is_some();
                let tip = "The desktop's own file chooser";
                clicked[2] = ui.add_enabled(!busy, egui::Button::new("Browse…")).on_hover_text(tip).clicked();
            });
        });
        if clicked[2] {
            let paper = if *dialog == Dialog::OpenPath { self.opens } else { self.paper };
            self.chooser = Some(browse(ui.ctx(), dialog, &self.path, paper));
        }
        let answer = (entered || clicked[0]).then(|| self.answer(dialog)).flatten();
        (answer, clicked[1])
    }

    /// Gives the path the ending of another kind of picture, if it has that of the former kind.
    fn follow_ending(&mut self, former: &'static str, ending: &'static str) {
        self.picture_ending = ending;
        if let Some(bare) = self.path.strip_suffix(former).filter(|_| former != ending) {
            self.path = format!("{bare}{ending}");
        }
    }

    /// Lists the folder's poses or chains; whether one was taken.
    fn list(&mut self, ui: &mut Ui) -> bool {
        self.listing.follow(&self.path, self.opens.opens());
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

    fn answer(&mut self, dialog: &Dialog) -> Option<Answer> {
        let path = Some(self.path.trim()).filter(|words| !words.is_empty()).map(from_home)?;
        Some(self.answer_of(dialog, path))
    }

    /// What the desktop's chooser came to, if it is done.
    pub(super) fn chosen(&mut self, dialog: &Dialog) -> Option<Answer> {
        let chosen = match self.chooser.as_ref()?.try_recv() {
            Err(TryRecvError::Empty) => return None,
            Ok(chosen) => chosen,
            Err(TryRecvError::Disconnected) => None,
        };
        self.chooser = None;
        self.unchosen = chosen.is_none();
        self.fresh = self.unchosen;
        let path = chosen?;
        self.path = path.display().to_string();
        Some(self.answer_of(dialog, path))
    }

    fn answer_of(&mut self, dialog: &Dialog, path: PathBuf) -> Answer {
        self.asked = Some(dialog.clone());
        match dialog {
            Dialog::SavePath(then) => {
                Answer::Write(Writing::Pose(with_suffix(path, self.paper.suffix()), then.clone()))
            }
            Dialog::FigurePath => Answer::Write(Writing::Figure(with_suffix(path, FIGURE_SUFFIX))),
            Dialog::PicturePath => Answer::Write(Writing::Picture(with_suffix(path, self.picture_ending))),
            _ => Answer::Open(path),
        }
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

/// A name without an extension gets one.
fn with_suffix(path: PathBuf, suffix: &str) -> PathBuf {
    if path.extension().is_some() {
        return path;
    }
    let mut name = path.into_os_string();
    name.push(suffix);
    PathBuf::from(name)
}

/// Selects the file's name without its folder and its suffix, so that typing replaces just that.
fn select_name(ui: &Ui, id: Id, path: &str, paper: Paper) {
    use egui::text::{CCursor, CCursorRange};
    let start = path.rfind(['/', '\\']).map_or(0, |i| i + 1);
    let pictures = Format::ALL.map(|format| format!(".{}", format.ending()));
    let mut suffixes = [paper.suffix(), FIGURE_SUFFIX].into_iter().chain(pictures.iter().map(String::as_str));
    let bare = suffixes.find_map(|suffix| path.strip_suffix(suffix));
    let end = bare.map_or(path.len(), str::len).max(start);
    let chars = |bytes: usize| CCursor::new(path[..bytes].chars().count());
    let mut state = TextEdit::load_state(ui.ctx(), id).unwrap_or_default();
    state.cursor.set_char_range(Some(CCursorRange::two(chars(start), chars(end))));
    state.store(ui.ctx(), id);
}

/// Asks the desktop for a file on a thread of its own; the window is woken when it is done.
fn browse(ctx: &Context, dialog: &Dialog, path: &str, paper: Paper) -> Receiver<Option<PathBuf>> {
    let (sender, receiver) = channel();
    let (ctx, saving) = (ctx.clone(), !matches!(dialog, Dialog::OpenPath));
    let path = PathBuf::from(path);
    let mut chooser = match dialog {
        Dialog::PicturePath => {
            rfd::FileDialog::new().add_filter("Pictures", &Format::ALL.map(Format::ending))
        }
        Dialog::FigurePath => rfd::FileDialog::new().add_filter("Figures", &["ron"]),
        _ => match paper {
            Paper::Pose => rfd::FileDialog::new().add_filter("Poses", &["ron"]),
            Paper::Chain => rfd::FileDialog::new().add_filter("Chains and robots", &["ron", "urdf"]),
            Paper::Ground => rfd::FileDialog::new().add_filter("Meshes", &["obj", "stl", "dae", "glb"]),
            Paper::Tree => rfd::FileDialog::new().add_filter("Blend trees", &["ron"]),
        },
    };
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_without_extension_becomes_a_pose() {
        assert_eq!(with_suffix("a/b".into(), Paper::Pose.suffix()), PathBuf::from("a/b.pose.ron"));
        assert_eq!(with_suffix("b.pose.ron".into(), Paper::Pose.suffix()), PathBuf::from("b.pose.ron"));
        assert_eq!(with_suffix("b.ron".into(), Paper::Pose.suffix()), PathBuf::from("b.ron"));
    }
}
