//! The poses, or chains, in the folder that a path field names.

use std::path::{Path, PathBuf};

use egui::{ScrollArea, Ui};

use crate::theme;

/// The names of a folder's files of some kinds, read once for each folder.
#[derive(Clone, PartialEq, Eq, Default, Debug)]
pub struct Listing {
    folder: Option<PathBuf>,
    names: Vec<String>,
}

/// As many names are listed; a folder with more is better searched elsewhere.
const MOST: usize = 500;

/// What was done to a name.
#[derive(Clone, PartialEq, Eq, Debug)]
pub enum Pick {
    /// It was clicked.
    Chosen(String),
    /// It was clicked twice.
    Taken(String),
}

impl Listing {
    /// Reads the folder of a path, if it is another one than before.
    pub fn follow(&mut self, path: &str, endings: &[&str]) {
        let path = Path::new(path);
        let named = if path.as_os_str().to_string_lossy().ends_with(['/', '\\']) {
            Some(path)
        } else {
            path.parent()
        };
        let folder = named.filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
        if self.folder.as_deref() != Some(folder) {
            self.names = files(folder, endings);
            self.folder = Some(folder.to_owned());
        }
    }

    /// Forgets what it has read, so that it is read again.
    pub fn forget(&mut self) {
        self.folder = None;
    }

    /// Shows the names.
    pub fn show(&self, ui: &mut Ui) -> Option<Pick> {
        if self.names.is_empty() {
            return None;
        }
        let mut pick = None;
        egui::Frame::new().fill(theme::of(ui).well).corner_radius(3.0).inner_margin(4).show(ui, |ui| {
            ScrollArea::vertical().max_height(180.0).auto_shrink([false, true]).show(ui, |ui| {
                for name in &self.names {
                    let row =
                        egui::Button::selectable(false, name).min_size(egui::vec2(ui.available_width(), 0.0));
                    let response = ui.add(row);
                    if response.double_clicked() {
                        pick = Some(Pick::Taken(name.clone()));
                    } else if response.clicked() {
                        pick = Some(Pick::Chosen(name.clone()));
                    }
                }
            });
        });
        pick
    }

    /// The path of a name.
    pub fn path(&self, name: &str) -> String {
        match self.folder.as_deref() {
            Some(folder) if folder != Path::new(".") => folder.join(name).display().to_string(),
            _ => name.to_owned(),
        }
    }
}

/// The files in a folder with such an ending, by name; none if it can't be read.
fn files(folder: &Path, endings: &[&str]) -> Vec<String> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Vec::new() };
    let names = entries.flatten().filter_map(|entry| entry.file_name().into_string().ok());
    let mut names: Vec<String> =
        names.filter(|name| endings.iter().any(|ending| name.ends_with(ending))).take(MOST).collect();
    names.sort();
    names
}
