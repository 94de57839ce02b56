//! The figure's own file: what its body is made of, and where the body is saved.

use std::path::{Path, PathBuf};

use interchange::figure::LIBRARY;
use rig::{Body, BodySlider};

use super::{Session, Status};
use crate::failure::Failure;
use crate::{disk, load};

/// The figure file that the mannequin is, as paths name it.
pub const MANNEQUIN: &str = "library:mannequin.figure.ron";

/// Where a session's figure came from.
#[derive(Clone, PartialEq, Debug, Default)]
pub(super) struct Source {
    /// The figure file; `None` if it is not known.
    file: Option<PathBuf>,
    /// The body that the file gives.
    body: Body,
}

impl Session {
    /// Tells which file the figure came from, so that its body can be changed and saved.
    pub fn figure_from(&mut self, file: PathBuf) {
        self.source.file = Some(file);
    }

    /// Reads what the figure is made of, once its sliders show.
    pub(super) fn take_clay(&mut self) {
        if self.editor.clay().is_some() || !self.panels.wants_clay() {
            return;
        }
        let unknown = || Failure::Input("it is not known which file this figure came from".to_owned());
        let read = self.source.file.as_deref().ok_or_else(unknown).and_then(load::clay);
        match read {
            Ok((clay, body)) => {
                self.source.body = body;
                self.editor.give_clay(clay, body);
            }
            Err(fault) => self.panels.refuse_clay(fault.to_string()),
        }
    }

    /// Asks where to save the figure, if that was wanted.
    pub(super) fn save_figure_if_asked(&mut self) {
        if self.panels.take_save_figure() {
            let folder = self.source.file.as_deref().filter(|file| !is_shipped(file)).and_then(Path::parent);
            self.dialogs.save_figure(folder);
        }
    }

    /// Writes a figure file that makes the body of the figure.
    ///
    /// # Errors
    /// The file can't be written.
    pub(super) fn save_figure(&mut self, path: &Path) -> Result<(), Failure> {
        disk::write_atomic(path, self.figure_text(path).as_bytes())?;
        self.status = Status { message: format!("Saved {}", path.display()), ..Status::default() };
        Ok(())
    }

    fn figure_text(&self, path: &Path) -> String {
        let mut body = self.document().body;
        let name = path.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
        let name = name.split(".figure").next().unwrap_or_default();
        let base = match self.source.file.as_deref().filter(|file| !is_shipped(file)) {
            None => MANNEQUIN.to_owned(),
            Some(file) => {
                // What the base's own body gives has to be taken back where this one is as made.
                for slider in BodySlider::ALL {
                    let own = self.editor.clay().and_then(|clay| clay.neutral(slider));
                    if let (None, Some(_), Some(own)) =
                        (body.given(slider), self.source.body.given(slider), own)
                    {
                        body = body.with(slider, own);
                    }
                }
                seen_from(file, path)
            }
        };
        interchange::figure::write_based(name, &base, &body)
    }
}

fn is_shipped(file: &Path) -> bool {
    file.to_string_lossy().starts_with(LIBRARY)
}

/// The name of a file as another one beside it or elsewhere would give it.
fn seen_from(file: &Path, other: &Path) -> String {
    let whole = |path: &Path| std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
    let (file, other) = (whole(file), whole(other));
    match file.file_name().filter(|_| file.parent() == other.parent()) {
        Some(name) => name.to_string_lossy().into_owned(),
        None => file.to_string_lossy().into_owned(),
    }
}
