//! Saving pictures: drawn on a thread with a device of its own, so that the window goes on meanwhile.

use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, TryRecvError, channel};
use std::thread::JoinHandle;

use egui::{Align2, Area, Context, Frame, Id, ProgressBar, Ui, vec2};
use render::Look;
use rig::Camera;

use crate::failure::Failure;
use crate::finish::Finish;
use crate::picture::{Choices, Darkroom, Format, Moment, Naming, Order, Subject, Work, around, title_of};

/// So long the window waits before it looks again how far the work is, seconds.
const LOOK_AGAIN_SECS: f32 = 0.1;

/// What a picture of a window's view shows.
#[derive(Debug)]
pub struct Seen<'a> {
    /// The figure or the chain.
    pub subject: Subject,
    /// From where.
    pub camera: Camera,
    /// What it is made of and drawn with.
    pub finish: Finish,
    /// The file that it came from.
    pub file: Option<&'a Path>,
}

impl Seen<'_> {
    /// The order of pictures as they were chosen in the dialog.
    fn order(self, path: &Path, choices: &Choices) -> Result<Order, Failure> {
        let frames = if choices.turntable { choices.frames as usize } else { 1 };
        let mut naming = Naming::of(path)?;
        if frames > 1 && naming.format == Format::Png && !naming.tells_frames() {
            naming = Naming::of(&numbered(path, "png"))?;
        }
        let keys = if frames > 1 { numbered(path, "json") } else { path.with_extension("json") };
        let order = Order {
            title: self.file.map_or_else(|| "unnamed".to_owned(), title_of),
            moments: Moment::from_all(&self.subject, around(self.camera, frames)),
            size: choices.size,
            passes: vec![choices.pass],
            look: choices.on(self.finish.on(Look::default())),
            naming,
            fps: choices.fps,
            keypoints: choices.keypoints.then(|| Naming::beside(&keys)),
        };
        order.check().map(|()| order)
    }
}

/// Pictures being made.
pub struct Saving {
    work: Work,
    news: Receiver<Result<(), Failure>>,
    thread: Option<JoinHandle<()>>,
    path: PathBuf,
    /// What is told when it is done.
    done: String,
}

impl Saving {
    /// Begins to write what a session's view shows, without marks, as was chosen in the dialog: what is to be told.
    ///
    /// # Errors
    /// Pictures of that session are still being made; an order that can't be carried out: what is wrong with it.
    pub fn begin(
        of: &mut Option<Saving>,
        ctx: &Context,
        path: &Path,
        seen: Seen,
        choices: &Choices,
    ) -> Result<String, Failure> {
        if of.is_some() {
            return Err(Failure::Usage("another picture is still being saved".to_owned()));
        }
        let order = seen.order(path, choices)?;
        let (work, (tell, news)) = (Work::default(), channel());
        let [width, height] = order.size;
        let frames = match order.moments.len() {
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
        *of = Some(Saving { work, news, thread: Some(thread), path: path.to_owned(), done });
        Ok(format!("Saving {}", path.display()))
    }

    /// Shows how far the pictures of a session are, stops them when asked; what is to be told once they are done.
    pub fn show(of: &mut Option<Saving>, ui: &Ui) -> Option<Result<String, Failure>> {
        let saving = of.as_ref()?;
        if let Some(result) = saving.result() {
            let done = saving.done.clone();
            *of = None;
            return Some(match result {
                Ok(()) => Ok(done),
                Err(Failure::Stopped) => Ok("Saving was stopped; nothing half is left".to_owned()),
                Err(failure) => Err(failure),
            });
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
        None
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

/// The same file with a number for each frame.
fn numbered(path: &Path, ending: &str) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}-%04d.{ending}"))
}
