//! The blend tree that the figure walks by: the one that comes with the program, or a file's, which is taken on anew whenever
//! it is saved.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::SystemTime;

use egui::Context;
use motion::Tree;
use rig::Figure;

use crate::failure::Failure;
use crate::load;

/// A file is looked at so often, seconds.
const LOOK_SECS: f64 = 1.0;

/// Whether a file is a blend tree, by its name.
pub fn is_tree(path: &Path) -> bool {
    path.to_string_lossy().to_lowercase().ends_with(".blend.ron")
}

/// Which blend tree is open, and what is wrong with its file.
#[derive(Clone, Debug, Default)]
pub struct TreeFile {
    /// `None`: the one that comes with the program.
    path: Option<PathBuf>,
    /// When the file was written that was read last.
    written: Option<SystemTime>,
    /// When it was last looked at, seconds of the context's clock.
    looked_at: f64,
    fault: Option<String>,
}

impl TreeFile {
    /// The file, if it isn't the tree that comes with the program.
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }

    /// The file's name.
    pub fn name(&self) -> String {
        let name = self.path.as_deref().and_then(Path::file_name);
        name.map_or_else(|| "walk.blend.ron".to_owned(), |name| name.to_string_lossy().into_owned())
    }

    /// Whether it is the tree that comes with the program.
    pub fn is_shipped(&self) -> bool {
        self.path.is_none()
    }

    /// What is wrong with the file as it was last saved.
    pub fn fault(&self) -> Option<&str> {
        self.fault.as_deref()
    }

    /// Reads the tree for a figure.
    ///
    /// # Errors
    /// A file at fault: which, where and why. It is kept as the [`TreeFile::fault`].
    pub fn read(&mut self, figure: &Arc<Figure>) -> Result<Arc<Tree>, Failure> {
        // The time comes first: what is saved while it is read is read again.
        self.written = self.path.as_deref().and_then(written);
        let tree = load::tree(figure, self.path.as_deref());
        self.fault = tree.as_ref().err().map(ToString::to_string);
        tree
    }

    /// Reads the tree for a figure that has none yet: of a file at fault, which is told, the tree that comes with the program
    /// takes the place.
    ///
    /// # Errors
    /// That tree doesn't fit the figure either.
    pub fn read_for(&mut self, figure: &Arc<Figure>) -> Result<Arc<Tree>, Failure> {
        match self.read(figure) {
            Err(_) if !self.is_shipped() => load::tree(figure, None),
            tree => tree,
        }
    }

    /// Opens a file.
    ///
    /// # Errors
    /// A file at fault; the one of before stays open.
    pub fn open(&mut self, figure: &Arc<Figure>, path: &Path) -> Result<Arc<Tree>, Failure> {
        let mut other =
            TreeFile { path: Some(path.to_owned()), looked_at: self.looked_at, ..TreeFile::default() };
        let tree = other.read(figure)?;
        *self = other;
        Ok(tree)
    }

    /// Goes back to the tree that comes with the program.
    pub fn reset(&mut self) {
        *self = TreeFile { looked_at: self.looked_at, ..TreeFile::default() };
    }

    /// Whether the file has been saved since it was read; looked up once a second.
    pub fn is_saved_anew(&mut self, now: f64) -> bool {
        let Some(path) = self.path.as_deref().filter(|_| (now - self.looked_at).abs() >= LOOK_SECS) else {
            return false;
        };
        self.looked_at = now;
        let saved = written(path);
        saved.is_some() && saved != self.written
    }

    /// Asks for a frame in which the file is looked at again, if there is one.
    pub fn wake(&self, ctx: &Context) {
        if self.path.is_some() {
            ctx.request_repaint_after_secs(LOOK_SECS as f32 + 0.05);
        }
    }
}

fn written(path: &Path) -> Option<SystemTime> {
    std::fs::metadata(path).and_then(|meta| meta.modified()).ok()
}
