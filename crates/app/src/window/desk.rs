//! What a window works on: a figure, or a chain.

use std::path::Path;

use egui::Ui;

use crate::chains::ChainSession;
use crate::failure::Failure;
use crate::keepsafe::Keepsafe;
use crate::library::Folders;
use crate::load;
use crate::session::Session;
use crate::settings::ConfigFolder;
use crate::viewport::Body;
use crate::viewport::pace::Quality;

/// The session of a window.
pub enum Desk {
    /// A figure's.
    Figure(Box<Session>),
    /// A chain's.
    Chain(Box<ChainSession>),
}

impl Desk {
    /// A desk with the user's own folders.
    pub fn of_user(self) -> Desk {
        let folder = ConfigFolder::of_user();
        match self {
            Desk::Figure(mut session) => {
                session.use_library(Folders::of_user());
                if let Some(folder) = folder {
                    session.configure_from(folder);
                }
                if let Some(folder) = Keepsafe::folder() {
                    session.keep_in(&folder);
                }
                Desk::Figure(session)
            }
            Desk::Chain(mut session) => {
                if let Some(folder) = folder {
                    session.configure_from(folder);
                }
                Desk::Chain(session)
            }
        }
    }

    /// A desk on what a file shows.
    ///
    /// # Errors
    /// A file at fault, or one of a kind that can't be opened.
    pub fn open(path: &Path) -> Result<Desk, Failure> {
        super::desk(&[path.to_owned()])
    }

    /// Draws everything and does what was asked for.
    pub fn ui(&mut self, ui: &mut Ui) {
        match self {
            Desk::Figure(session) => session.ui(ui),
            Desk::Chain(session) => session.ui(ui),
        }
    }

    /// The window's title.
    pub fn title(&self) -> String {
        match self {
            Desk::Figure(session) => session.title(),
            Desk::Chain(session) => session.title(),
        }
    }

    /// What the status line says.
    pub fn status(&self) -> &str {
        match self {
            Desk::Figure(session) => &session.status().message,
            Desk::Chain(session) => &session.status().message,
        }
    }

    /// What is drawn.
    pub fn body(&self) -> Body {
        match self {
            Desk::Figure(session) => Body::Figure(session.editor().figure().clone()),
            Desk::Chain(session) => session.picture.body(),
        }
    }

    /// How well the last frame drew it.
    pub fn drawn_in(&self) -> Quality {
        match self {
            Desk::Figure(session) if session.is_walking() => session.walk().picture.drawn_in(),
            Desk::Figure(session) => session.viewport.drawn_in(),
            Desk::Chain(session) => session.picture.drawn_in(),
        }
    }

    /// A frame in which it was drawn anew took so long.
    pub fn took(&mut self, now: f64, secs: f32) {
        match self {
            Desk::Figure(session) if session.is_walking() => session.walk_mut().picture.took(now, secs),
            Desk::Figure(session) => session.viewport.took(now, secs),
            Desk::Chain(session) => session.picture.took(now, secs),
        }
    }

    /// Whether the processor draws.
    pub fn set_software(&mut self, on: bool) {
        match self {
            Desk::Figure(session) => session.software = on,
            Desk::Chain(session) => session.software = on,
        }
    }

    /// Whether the session has ended.
    pub fn has_quit(&self) -> bool {
        match self {
            Desk::Figure(session) => session.has_quit(),
            Desk::Chain(session) => session.has_quit(),
        }
    }

    /// Ends the session, after asking about unsaved changes.
    pub fn quit_asking(&mut self) {
        match self {
            Desk::Figure(session) => session.quit_asking(),
            Desk::Chain(session) => session.quit_asking(),
        }
    }

    /// The session has ended by itself: nothing is to be offered again.
    pub fn end(&mut self) {
        if let Desk::Figure(session) = self {
            session.end();
        }
    }

    /// Opens what the session wanted to have opened in a window of another kind, in place of it; whether it did. What fails is
    /// told in the status line, and the session stays.
    pub fn change(&mut self, software: bool) -> bool {
        let wanted = match self {
            Desk::Figure(session) => session.take_elsewhere(),
            Desk::Chain(session) => session.take_elsewhere(),
        };
        let Some(path) = wanted else { return false };
        match Desk::open(&path) {
            Ok(desk) => {
                self.end();
                *self = desk.of_user();
                self.set_software(software);
                true
            }
            Err(failure) => {
                match self {
                    Desk::Figure(session) => session.tell_failure(failure),
                    Desk::Chain(session) => session.tell_failure(failure),
                }
                true
            }
        }
    }

    /// A desk on a chain.
    ///
    /// # Errors
    /// A file at fault.
    pub fn of_chain(path: &Path) -> Result<Option<Desk>, Failure> {
        match load::shows_chain(path)? {
            true => ChainSession::open(path).map(|session| Some(Desk::Chain(Box::new(session)))),
            false => Ok(None),
        }
    }
}
