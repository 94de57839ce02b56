//! The window as a picture, without a display: the same session, drawn into a texture.

use std::path::Path;

use edit::Editor;
use egui::{Context, Event, Pos2, RawInput, Rect};
use render::{Gpu, Image};
use rig::View;

use crate::chains::ChainSession;
use crate::failure::Failure;
use crate::finish::Finish;
use crate::painter::Painter;
use crate::picture::open_gpu;
use crate::session::Session;
use crate::theme;
use crate::viewport::Body;

use super::Showing;

/// Draws the whole window, panels included, without a display.
///
/// # Errors
/// No adapter; what is to be shown isn't there.
pub fn ui_picture(
    editor: &Editor,
    file: &Path,
    view: View,
    finish: Finish,
    size: [u32; 2],
    showing: &Showing,
) -> Result<Image, Failure> {
    let mut session = Session::new(editor.clone(), Some(file.to_owned()));
    session.viewport.view(view);
    session.set_finish(finish);
    drawn(&mut session, size, showing)
}

/// Draws the whole window on a chain, as it opens, without a display.
///
/// # Errors
/// No adapter; a file at fault; what is to be shown isn't there.
pub fn chain_ui_picture(
    file: &Path,
    finish: Finish,
    size: [u32; 2],
    showing: &Showing,
) -> Result<Image, Failure> {
    let mut session = ChainSession::open(file)?;
    session.set_finish(finish);
    let mut window = Offscreen::new(&session.picture.body(), size)?;
    window.draw(&mut |ui| session.ui(ui), Vec::new());
    showing.apply_to_chain(&window.ctx, &mut session)?;
    (1..FRAMES).for_each(|_| window.draw(&mut |ui| session.ui(ui), Vec::new()));
    showing.events().into_iter().for_each(|events| window.draw(&mut |ui| session.ui(ui), events));
    window.image()
}

/// Layout settles within as many frames.
const FRAMES: usize = 3;
/// Portraits of the library that are still being drawn are waited for, that many frames of a twentieth of a second.
const WAITS: usize = 400;

/// Draws a session as a window of that many pixels would show it.
///
/// # Errors
/// No adapter; a size that it can't draw.
pub fn session_picture(session: &mut Session, size: [u32; 2]) -> Result<Image, Failure> {
    drawn(session, size, &Showing::default())
}

fn drawn(session: &mut Session, size: [u32; 2], showing: &Showing) -> Result<Image, Failure> {
    let mut window = Offscreen::new(&Body::Figure(session.editor().figure().clone()), size)?;
    let draw = |window: &mut Offscreen, session: &mut Session, events| {
        window.draw(&mut |ui| session.ui(ui), events);
    };
    draw(&mut window, session, Vec::new());
    showing.apply(&window.ctx, session)?;
    (1..FRAMES).for_each(|_| draw(&mut window, session, Vec::new()));
    for _ in 0..WAITS {
        if session.library().is_settled() {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
        draw(&mut window, session, Vec::new());
    }
    showing.events().into_iter().for_each(|events| draw(&mut window, session, events));
    window.image()
}

/// A window that is a texture.
struct Offscreen {
    gpu: Gpu,
    painter: Painter,
    texture: wgpu::Texture,
    ctx: Context,
    size: [u32; 2],
    frames: u32,
}

impl Offscreen {
    fn new(body: &Body, size: [u32; 2]) -> Result<Offscreen, Failure> {
        let gpu = open_gpu()?;
        let limit = gpu.max_edge();
        if size.iter().any(|edge| !(1..=limit).contains(edge)) {
            let error = render::DrawError::Size { width: size[0], height: size[1], limit };
            return Err(Failure::Input(error.to_string()));
        }
        let format = wgpu::TextureFormat::Rgba8Unorm;
        let painter = Painter::new(&gpu, format, body).map_err(|e| Failure::Input(e.to_string()))?;
        let texture = render::canvas(&gpu, "window", size, format);
        let ctx = Context::default();
        theme::apply(&ctx);
        Ok(Offscreen { gpu, painter, texture, ctx, size, frames: 0 })
    }

    /// Draws a frame, a second after the one before.
    fn draw(&mut self, show: &mut dyn FnMut(&mut egui::Ui), events: Vec<Event>) {
        let size = self.size;
        let room = egui::vec2(size[0] as f32, size[1] as f32) / self.ctx.pixels_per_point();
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, room)),
            time: Some(f64::from(self.frames)),
            focused: true,
            events,
            ..RawInput::default()
        };
        self.frames += 1;
        let output = self.ctx.run_ui(input, |ui| show(ui));
        let view = self.texture.create_view(&wgpu::TextureViewDescriptor::default());
        self.painter.paint(&self.ctx, output, size, &view);
    }

    fn image(&self) -> Result<Image, Failure> {
        let descriptor = wgpu::CommandEncoderDescriptor { label: Some("read window") };
        let encoder = self.gpu.device.create_command_encoder(&descriptor);
        render::read(&self.gpu, encoder, &self.texture).map_err(|e| Failure::Input(e.to_string()))
    }
}
