//! Saving pictures: drawn on a thread with a device of its own, so that the window goes on meanwhile.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread::JoinHandle;

use egui::{Align2, Area, Context, Frame, Id, ProgressBar, Ui, vec2};
use render::Look;

use super::Session;
use crate::failure::Failure;
use crate::picture::{Darkroom, Format, Naming, Order, Subject, Work, around, title_of};

/// So long the window waits before it looks again how far the work is, seconds.
const LOOK_AGAIN_SECS: f32 = 0.1;

/// Pictures being made.
pub(super) struct Saving {
    work: Work,
    news: Receiver<Result<(), Failure>>,
    thread: Option<JoinHandle<()>>,
    path: PathBuf,
    /// What is told when it is done.
    done: String,
}

impl Saving {
    fn begin(ctx: &Context, path: &Path, order: Order) -> Saving {
        let (work, (tell, news)) = (Work::default(), channel());
        let [width, height] = order.size;
        let frames = match order.cameras.len() {
            1 => String::new(),
            frames => format!(" · {frames} frames"),
        };
        let done = format!("Saved {} · {width} × {height} pixels{frames}", path.display());
        let (own, ctx) = (work.clone(), ctx.clone());
        let thread = std::thread::spawn(move || {
            let made = Darkroom::open().and_then(|mut room| order.carry_out(&mut room, &own));
            // The window may have been closed.
            let _ = tell.send(made);
            ctx.request_repaint();
        });
        Saving { work, news, thread: Some(thread), path: path.to_owned(), done }
    }

    /// What came of it, once it has ended.
    fn result(&self) -> Option<Result<(), Failure>> {
        match self.news.try_recv() {
            Ok(result) => Some(result),
            Err(TryRecvError::Empty) => None,
            Err(TryRecvError::Disconnected) => {
                Some(Err(Failure::Input(format!("{}: drawing failed", self.path.display()))))
            }
        }
    }
}

impl Drop for Saving {
    fn drop(&mut self) {
        self.work.stop();
        if let Some(thread) = self.thread.take() {
            // A device is closed before the program ends, and nothing half is left; at most one frame is waited for.
            let _ = thread.join();
        }
    }
}

impl Session {
    /// Begins to write what the view shows, without marks, as was chosen in the dialog.
    pub(super) fn save_picture(&mut self, ctx: &Context, path: &Path) {
        if self.saving.is_some() {
            self.tell(Err(Failure::Usage("another picture is still being saved".to_owned())));
            return;
        }
        let begun = self.picture_order(path).and_then(|order| order.check().map(|()| order));
        match begun {
            Ok(order) => {
                self.say(format!("Saving {}", path.display()));
                self.saving = Some(Saving::begin(ctx, path, order));
            }
            Err(failure) => self.tell(Err(failure)),
        }
    }

    fn picture_order(&self, path: &Path) -> Result<Order, Failure> {
        let choices = &self.settings.picture;
        let camera = self.viewport.camera_for_picture();
        let frames = if choices.turntable { choices.frames as usize } else { 1 };
        let mut naming = Naming::of(path)?;
        if frames > 1 && naming.format == Format::Png && !naming.tells_frames() {
            naming = Naming::of(&numbered(path, "png"))?;
        }
        let keys = if frames > 1 { numbered(path, "json") } else { path.with_extension("json") };
        Ok(Order {
            subject: Subject::of(&self.editor),
            title: self.path.as_deref().map_or_else(|| "unnamed".to_owned(), title_of),
            cameras: around(camera, frames),
            size: choices.size,
            passes: vec![choices.pass],
            look: choices.on(self.settings.finish.on(Look::default())),
            naming,
            fps: choices.fps,
            keypoints: choices.keypoints.then(|| Naming::beside(&keys)),
        })
    }

    /// Shows how far the pictures are, stops them when asked, and tells when they are done.
    pub(super) fn show_saving(&mut self, ui: &Ui) {
        let Some(saving) = &self.saving else { return };
        if let Some(result) = saving.result() {
            let done = saving.done.clone();
            self.saving = None;
            match result {
                Ok(()) => self.say(done),
                Err(Failure::Stopped) => self.say("Saving was stopped; nothing half is left".to_owned()),
                Err(failure) => self.tell(Err(failure)),
            }
            return;
        }
        let area = Area::new(Id::unique("saving")).anchor(Align2::CENTER_BOTTOM, vec2(0.0, -40.0));
        area.show(ui.ctx(), |ui| {
            Frame::popup(ui.style()).inner_margin(10).show(ui, |ui| {
                let name = saving.path.file_name().unwrap_or_default().to_string_lossy();
                ui.label(format!("Saving {name}"));
                ui.horizontal(|ui| {
                    ui.add(ProgressBar::new(saving.work.share()).desired_width(220.0).show_percentage());
                    if ui.button("Stop saving").clicked() {
                        saving.work.stop();
                    }
                });
            });
        });
        ui.ctx().request_repaint_after_secs(LOOK_AGAIN_SECS);
    }

    /// Whether a picture is being saved.
    pub fn is_saving(&self) -> bool {
        self.saving.is_some()
    }
}

/// The same file with a number for each frame.
fn numbered(path: &Path, ending: &str) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-%04d.{ending}"))
}
