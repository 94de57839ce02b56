//! Every committed pose is kept on disk, and what was lost is offered again.

use std::path::Path;

use edit::Request;

use super::{Session, Status};
use crate::dialogs::Dialog;
use crate::failure::Failure;
use crate::keepsafe::{Keepsafe, Lost};

/// What a session knows of its kept pose.
#[derive(Default)]
pub(super) struct Recovery {
    keepsafe: Option<Keepsafe>,
    /// The revision that the keepsafe holds.
    kept: u64,
    /// What another window lost, while it is offered.
    lost: Option<Lost>,
}

impl Session {
    /// Keeps every committed pose in a folder, and offers what was lost there the last time.
    ///
    /// A folder that can't be written is told in the status line; the session goes on without.
    pub fn keep_in(&mut self, folder: &Path) {
        self.recovery.kept = self.editor.revision();
        match Keepsafe::begin(folder) {
            Ok((keepsafe, lost)) => {
                self.recovery.keepsafe = Some(keepsafe);
                self.recovery.lost = lost.into_iter().next();
                if self.recovery.lost.is_some() {
                    self.dialogs.ask(Dialog::Recover);
                }
            }
            Err(error) => {
                let message = format!("{}: poses can't be kept here: {error}", folder.display());
                self.tell(Err(Failure::Input(message)));
            }
        }
    }

    /// The text of the pose that is offered, if one was lost.
    pub fn offered(&self) -> Option<&str> {
        self.recovery.lost.as_ref().map(|lost| lost.text.as_str())
    }

    /// The session has ended by itself: nothing is to be offered again.
    pub fn end(&mut self) {
        if let Some(keepsafe) = self.recovery.keepsafe.take() {
            keepsafe.done();
        }
    }

    /// Hands a pose that has changed to the keepsafe, gestures when they are committed.
    pub(super) fn keep(&mut self) {
        let revision = self.editor.revision();
        let changed = !self.editor.in_gesture() && revision != self.recovery.kept;
        if let Some(keepsafe) = self.recovery.keepsafe.as_ref().filter(|_| changed) {
            keepsafe.keep(rig::write_pose(self.editor.figure(), self.editor.pose()));
            self.recovery.kept = revision;
        }
    }

    /// Takes up the lost pose or forgets it.
    pub(super) fn recover(&mut self, wanted: bool) {
        let Some(lost) = self.recovery.lost.take() else { return };
        if wanted {
            let figure = self.editor.figure().clone();
            match rig::read_pose(&figure, &lost.text) {
                Ok(patch) => {
                    self.submit(Request::Open(Box::new(patch.onto(&figure.rest_pose()))));
                    self.status =
                        Status { message: "Opened the pose that was kept".to_owned(), ..Status::default() };
                }
                _ => {
                    let message = "the pose that was kept is not of this figure; it stays on disk".to_owned();
                    self.tell(Err(Failure::Input(message)));
                    return;
                }
            }
        }
        lost.forget();
    }
}
