//! The window as a picture, without a display: the same session, drawn into a texture.

use std::path::Path;

use edit::Editor;
use egui::{Context, Event, Pos2, RawInput, Rect};
use render::Image;
use rig::View;

use crate::failure::Failure;
use crate::finish::Finish;
use crate::painter::Painter;
use crate::picture::open_gpu;
use crate::session::Session;
use crate::theme;

use super::Showing;

/// Draws the whole window, panels included, without a display.
///
/// # Errors
/// No adapter.
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
    let gpu = open_gpu()?;
    let limit = gpu.max_edge();
    if size.iter().any(|edge| !(1..=limit).contains(edge)) {
        let error = render::DrawError::Size { width: size[0], height: size[1], limit };
        return Err(Failure::Input(error.to_string()));
    }
    let format = wgpu::TextureFormat::Rgba8Unorm;
    let mut painter =
        Painter::new(&gpu, format, session.editor().figure()).map_err(|e| Failure::Input(e.to_string()))?;
    let texture = render::canvas(&gpu, "window", size, format);
    let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
    let ctx = Context::default();
    theme::apply(&ctx);
    let mut frames = 0;
    let mut draw = |session: &mut Session, events: Vec<Event>| {
        let room = egui::vec2(size[0] as f32, size[1] as f32) / ctx.pixels_per_point();
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, room)),
            time: Some(f64::from(frames)),
            focused: true,
            events,
            ..RawInput::default()
        };
        frames += 1;
        let output = ctx.run_ui(input, |ui| session.ui(ui));
        painter.paint(&ctx, output, size, &view);
    };
    draw(session, Vec::new());
    showing.apply(&ctx, session);
    (1..FRAMES).for_each(|_| draw(session, Vec::new()));
    for _ in 0..WAITS {
        if session.library().is_settled() {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
        draw(session, Vec::new());
    }
    showing.events().into_iter().for_each(|events| draw(session, events));
    let descriptor = wgpu::CommandEncoderDescriptor { label: Some("read window") };
    let encoder = gpu.device.create_command_encoder(&descriptor);
    render::read(&gpu, encoder, &texture).map_err(|e| Failure::Input(e.to_string()))
}
