//! The pose library: poses that come with the program and the user's own, seen, searched, applied, blended and added.
//!
//! It reads the editor and asks for commands like any other panel. A shipped pose is `library:thinker.pose.ron` in a
//! command, so that a script means the same on every machine; the user's own are named by their real path.

mod cache;
pub mod chains;
pub mod clips;
pub mod entry;
mod folder;
mod index;
mod making;
mod portrait;
mod portraits;
pub mod scope;
mod search;
pub mod shipped;
mod tile;
mod worker;

use std::path::{Path, PathBuf};
use std::sync::Arc;

use edit::{Command, Editor, Request};
use egui::{RichText, ScrollArea, Ui};
use rig::Part;

use cache::Cache;
use entry::Entry;
use making::Making;
use portrait::Opener;
use portraits::Portraits;
use scope::Scope;
use search::Search;
use tile::{Blend, Deed};

use crate::picture::open_gpu;

/// What was asked for in the panel.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Asked {
    /// For the editor.
    pub requests: Vec<Request>,
    /// For the status line: what was done to the folder, or why it couldn't be.
    pub told: Option<Result<String, String>>,
}

/// The folders of a library. Without one, what would be in it isn't kept.
#[derive(Clone, PartialEq, Eq, Debug, Default)]
pub struct Folders {
    /// The user's own poses.
    pub own: Option<PathBuf>,
    /// Portraits, so that they are drawn once.
    pub cache: Option<PathBuf>,
}

impl Folders {
    /// The user's, in the data and the cache folder for Posewright.
    pub fn of_user() -> Folders {
        Folders { own: folder::of_user(), cache: cache::of_user() }
    }
}

/// The state of the panel. Nothing of the pose is in it.
pub struct Library {
    shown: bool,
    /// Where the user's own poses are unless another folder is chosen.
    data_folder: Option<PathBuf>,
    /// Where they are.
    own_folder: Option<PathBuf>,
    entries: Arc<Vec<Entry>>,
    read: bool,
    portraits: Portraits,
    search: Search,
    scope: Scope,
    mirrored: bool,
    /// How much of a pose a click applies, per cent.
    percent: f64,
    blend: Option<Blend>,
    making: Making,
    /// Which rows were shown last.
    rows: std::ops::Range<usize>,
}

impl Default for Library {
    fn default() -> Library {
        Library::new(Folders::default())
    }
}

impl Library {
    /// The library of these folders. Nothing is read before it is shown.
    pub fn new(folders: Folders) -> Library {
        Library::drawn_by(folders, open_gpu)
    }

    fn drawn_by(folders: Folders, opener: Opener) -> Library {
        Library {
            shown: false,
            own_folder: folders.own.clone(),
            data_folder: folders.own,
            entries: Arc::default(),
            read: false,
            portraits: Portraits::new(opener, folders.cache.map(Cache::new)),
            search: Search::default(),
            scope: Scope::default(),
            mirrored: false,
            percent: 100.0,
            blend: None,
            making: Making::default(),
            rows: 0..0,
        }
    }

    /// Reads the user's folder again.
    fn read(&mut self) {
        let own = self.own_folder.as_deref().map(folder::scan).unwrap_or_default();
        self.take(own);
    }

    /// The user's own poses first: there are fewer, and they are looked for more.
    fn take(&mut self, own: Vec<Entry>) {
        let shipped = shipped::titled().iter().map(Entry::shipped);
        self.entries = Arc::new(own.into_iter().chain(shipped).collect());
        self.read = true;
    }

    /// Whether every portrait in sight has been seen to, so that a picture of the window is whole.
    pub fn is_settled(&self) -> bool {
        let shown = self.search.found(&self.entries);
        let drawable = self.shown && self.portraits.no_adapter.is_none();
        !drawable || self.portraits.count(&shown) >= shown.len().min(portraits::MOST)
    }

    /// Shows the library at the window's right if it is `open`; `selected` are the parts of what is selected.
    pub fn panel(&mut self, ui: &mut Ui, open: bool, editor: &Editor, selected: &[Part]) -> Asked {
        self.shown = open;
        if !open {
            // Nothing is drawn or watched until it is shown again.
            self.portraits.rest();
            return Asked::default();
        }
        let frame = egui::Frame::new().fill(ui.visuals().panel_fill).inner_margin(egui::Margin::same(8));
        let panel = egui::Panel::right("library").default_size(268.0).size_range(220.0..=640.0);
        panel.frame(frame).show(ui, |ui| self.show(ui, editor, selected)).inner
    }

    /// Takes the user's own poses from a folder that is chosen, or from the one in the user's data.
    pub fn follow(&mut self, chosen: Option<&Path>) {
        let wanted = chosen.or(self.data_folder.as_deref());
        if wanted != self.own_folder.as_deref() {
            self.own_folder = wanted.map(Path::to_owned);
            self.read = false;
        }
    }

    fn show(&mut self, ui: &mut Ui, editor: &Editor, selected: &[Part]) -> Asked {
        if !self.read {
            self.read();
        }
        // A figure whose body is being changed is drawn once it stays.
        let figure = (!editor.in_gesture()).then(|| editor.figure());
        if let Some(own) = self.portraits.receive(ui.ctx(), figure) {
            self.take(own);
        }
        self.portraits.watch(ui.ctx(), self.own_folder.clone());
        let mut asked = Asked::default();
        let entries = self.entries.clone();
        self.search.show(ui, &entries);
        let found = self.search.found(&entries);
        ui.add_space(2.0);
        self.scope.show(ui, selected);
        self.manner(ui);
        let parts = self.scope.parts(selected);
        let count = self.count(&found);
        self.add(ui, &count, editor, parts.as_deref(), &mut asked);
        self.progress(ui, &found);
        self.grid(ui, &found, parts.as_deref(), &mut asked);
        // The hand comes first: while it moves something, nothing is drawn beside.
        let busy = editor.in_gesture() || ui.input(|i| i.pointer.any_down());
        self.want(ui, &found, busy);
        asked
    }

    /// How a pose is applied: mirrored, and how much of it.
    fn manner(&mut self, ui: &mut Ui) {
        ui.horizontal(|ui| {
            let tip = "Apply the mirror image; Alt held does the same for once";
            ui.checkbox(&mut self.mirrored, "Mirrored").on_hover_text(tip);
            ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
                let amount = egui::DragValue::new(&mut self.percent)
                    .range(tile::LEAST..=tile::MOST)
                    .speed(1.0)
                    .max_decimals(1)
                    .suffix(" %");
                let tip =
                    "How much of a pose a click applies: 0 is the pose as it is now, beyond 100 goes farther";
                ui.add(amount).on_hover_text(tip).accessible_name("Amount");
                ui.label(RichText::new("Amount").weak());
            });
        });
    }

    /// How many poses there are, or how many portraits are drawn; a line grows with them.
    fn progress(&self, ui: &mut Ui, found: &[&Entry]) {
        if let Some(cure) = &self.portraits.no_adapter {
            ui.colored_label(ui.visuals().warn_fg_color, format!("No portraits: {cure}"));
            return;
        }
        let all = found.len().min(portraits::MOST);
        let made = self.portraits.count(found).min(all);
        let (_, line) = ui.allocate_space(egui::vec2(ui.available_width(), 2.0));
        if made < all {
            let done = line.width() * made as f32 / all as f32;
            let done = egui::Rect::from_min_size(line.min, egui::vec2(done, line.height()));
            ui.painter().rect_filled(line, 1.0, ui.visuals().extreme_bg_color);
            ui.painter().rect_filled(done, 1.0, ui.visuals().hyperlink_color);
        }
    }

    fn count(&self, found: &[&Entry]) -> String {
        let all = found.len().min(portraits::MOST);
        let made = self.portraits.count(found).min(all);
        match found.len() {
            0 => "No pose is found".to_owned(),
            _ if made < all && self.portraits.no_adapter.is_none() => format!("Drawing: {made} of {all}"),
            1 => "1 pose".to_owned(),
            n => format!("{n} poses"),
        }
    }

    fn grid(&mut self, ui: &mut Ui, found: &[&Entry], parts: Option<&[Part]>, asked: &mut Asked) {
        let columns = tile::columns(ui.available_width());
        let rows = found.len().div_ceil(columns);
        ui.spacing_mut().item_spacing = egui::Vec2::splat(tile::GAP);
        let flip = self.mirrored != ui.input(|i| i.modifiers.alt);
        ScrollArea::vertical().auto_shrink(false).show_rows(ui, tile::HEIGHT, rows, |ui, range| {
            self.rows = range.start * columns..range.end * columns;
            let width = tile::width(ui.available_width(), columns);
            for row in range {
                ui.horizontal(|ui| {
                    for entry in found.iter().skip(row * columns).take(columns) {
                        let portrait = self.portraits.of(entry);
                        let drawable = self.portraits.no_adapter.is_none();
                        let shown = tile::Shown { entry, portrait, drawable, flip, enabled: parts.is_some() };
                        let deed = shown.show(ui, width, &mut self.making, &mut self.blend);
                        self.answer(deed, entry, parts, flip, asked);
                    }
                });
            }
        });
    }

    /// From what was done to a tile to what is asked for.
    fn answer(
        &mut self,
        deed: Option<Deed>,
        entry: &Entry,
        parts: Option<&[Part]>,
        mirrored: bool,
        asked: &mut Asked,
    ) {
        let command = |amount: f64, parts: &[Part]| Command::ApplyPose {
            path: entry.path.clone(),
            parts: parts.to_vec(),
            amount,
            mirrored,
        };
        match (deed, parts) {
            (Some(Deed::Apply), Some(parts)) => {
                asked.requests.push(Request::Do(command(self.percent / 100.0, parts)));
            }
            (Some(Deed::Blend(percent)), Some(parts)) => {
                asked.requests.push(Request::Preview(command(percent / 100.0, parts)));
            }
            (Some(Deed::Rename(name)), _) => self.rename(entry, &name, asked),
            (Some(Deed::Remove), _) => self.remove(entry, asked),
            _ => {}
        }
    }

    fn rename(&mut self, entry: &Entry, name: &str, asked: &mut Asked) {
        let entries = self.entries.clone();
        let taken = entries.iter().filter(|e| e.path != entry.path).map(|e| e.title.as_str());
        let Some(file) = &entry.file else { return };
        let renamed = folder::checked(name, taken).and_then(|name| {
            folder::rename(file, &name).map(|_| format!("{} is now called {name}", entry.title))
        });
        self.making.fault = renamed.as_ref().err().cloned();
        if renamed.is_ok() {
            self.making.end();
        }
        asked.told = Some(renamed);
        self.read();
    }

    fn remove(&mut self, entry: &Entry, asked: &mut Asked) {
        let Some(file) = &entry.file else { return };
        let moved = folder::put_aside(file);
        asked.told = Some(moved.map(|to| format!("{} is now in {}", entry.title, to.display())));
        self.making.end();
        self.read();
    }

    /// The pose as it is now, into the user's folder.
    fn add(&mut self, ui: &mut Ui, count: &str, editor: &Editor, parts: Option<&[Part]>, asked: &mut Asked) {
        let Some(name) = self.making.add(ui, self.own_folder.is_some(), count, parts) else { return };
        let (Some(own), Some(parts)) = (&self.own_folder, parts) else { return };
        let text = rig::write_parts(editor.figure(), editor.pose(), parts);
        let taken = self.entries.iter().map(|e| e.title.as_str());
        let added = folder::checked(&name, taken)
            .and_then(|name| folder::add(own, &name, &text).map(|_| format!("{name} is in the library")));
        self.making.fault = added.as_ref().err().cloned();
        if added.is_ok() {
            self.making.end();
        }
        asked.told = Some(added);
        self.read();
    }

    /// Portraits in sight first, then the others.
    fn want(&mut self, ui: &Ui, found: &[&Entry], busy: bool) {
        let end = self.rows.end.min(found.len());
        let start = self.rows.start.min(end);
        let order = found[start..end].iter().chain(&found[end..]).chain(&found[..start]);
        self.portraits.want(ui.ctx(), order.copied().take(portraits::MOST), busy);
    }
}

#[cfg(test)]
mod tests {
    use egui_kittest::Harness;
    use egui_kittest::kittest::Queryable as _;

    use super::*;
    use crate::failure::Failure;

    fn no_gpu() -> Result<render::Gpu, Failure> {
        Err(Failure::NoScreen("no graphics adapter found: install a driver".to_owned()))
    }

    #[test]
    fn a_folder_that_is_chosen_no_longer_gives_way_to_the_user_s_data() {
        let of_user = Some(PathBuf::from("data"));
        let mut library = Library::new(Folders { own: of_user.clone(), cache: None });
        library.follow(Some(Path::new("elsewhere")));
        assert_eq!(library.own_folder, Some(PathBuf::from("elsewhere")));
        library.follow(None);
        assert_eq!(library.own_folder, of_user);
    }

    #[test]
    fn without_an_adapter_poses_are_told_and_applied_by_name() {
        let editor = Editor::new(crate::load::figure(None).unwrap());
        let library = Library::drawn_by(Folders::default(), no_gpu);
        let mut hand = Harness::builder().with_size(egui::vec2(300.0, 700.0)).build_ui_state(
            move |ui, (library, asked): &mut (Library, Vec<Request>)| {
                asked.extend(library.show(ui, &editor, &[]).requests);
            },
            (library, Vec::new()),
        );
        for _ in 0..200 {
            hand.run();
            if hand.state().0.portraits.no_adapter.is_some() {
                break;
            }
            std::thread::sleep(std::time::Duration::from_millis(10));
        }
        hand.run();
        hand.get_by_label_contains("No portraits: no graphics adapter found: install a driver");
        hand.get_by_label("Pose Thinker").click();
        hand.run();
        assert_eq!(hand.state().1.len(), 1, "{:?}", hand.state().1);
    }
}
