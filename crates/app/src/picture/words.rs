//! Words as pictures, in the window's own typeface.

use egui::{Align2, Color32, Context, FontId, Pos2, RawInput, Rect, vec2};
use render::{Gpu, Image};

use crate::failure::Failure;
use crate::painter::Painter;

/// Writes words into pictures of one size.
pub struct Writer {
    ctx: Context,
    painter: Painter,
    texture: wgpu::Texture,
    size: [u32; 2],
    frames: u32,
}

impl Writer {
    /// Makes ready; each edge at least 1 pixel and no more than the device holds.
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Writer {
        let format = wgpu::TextureFormat::Rgba8Unorm;
        let texture = render::canvas(gpu, "words", size, format);
        Writer { ctx: Context::default(), painter: Painter::plain(gpu, format), texture, size, frames: 0 }
    }

    /// One line in the middle, so many pixels high, smaller if it is too long; on a ground of that colour, or on none.
    ///
    /// # Errors
    /// The driver complains.
    pub fn line(
        &mut self,
        words: &str,
        height: f32,
        color: [u8; 3],
        ground: [u8; 4],
    ) -> Result<Image, Failure> {
        // White on black first: what is white tells how much of the letters' colour is there.
        let drawn = self.white_on_black(words, height)?;
        let mixed = |light: u8| {
            let [covers, light] = [f32::from(ground[3]) / 255.0, f32::from(light) / 255.0];
            let alpha = light + covers * (1.0 - light);
            let channel = |i: usize| {
                let whole = f32::from(color[i]) * light + f32::from(ground[i]) * covers * (1.0 - light);
                if alpha > 0.0 { (whole / alpha).round() as u8 } else { 0 }
            };
            [channel(0), channel(1), channel(2), (alpha * 255.0).round() as u8]
        };
        let rgba = drawn.rgba.chunks_exact(4).flat_map(|pixel| mixed(pixel[1])).collect();
        Ok(Image { rgba, ..drawn })
    }

    fn white_on_black(&mut self, words: &str, height: f32) -> Result<Image, Failure> {
        let color = Color32::WHITE;
        let room = vec2(self.size[0] as f32, self.size[1] as f32);
        let rect = Rect::from_min_size(Pos2::ZERO, room);
        let input =
            RawInput { screen_rect: Some(rect), time: Some(f64::from(self.frames)), ..RawInput::default() };
        self.frames += 1;
        let output = self.ctx.run_ui(input, |ui| {
            let painter = ui.ctx().layer_painter(egui::LayerId::background());
            let width = |height| {
                painter.layout_no_wrap(words.to_owned(), FontId::proportional(height), color).size().x
            };
            let fitting = (room.x * 0.94 / width(height).max(1.0)).min(1.0);
            let font = FontId::proportional((height * fitting).floor().max(6.0));
            painter.text(rect.center(), Align2::CENTER_CENTER, words, font, color);
        });
        let view = self.texture.create_view(&wgpu::TextureViewDescriptor::default());
        self.painter.paint(&self.ctx, output, self.size, &view);
        let gpu = self.painter.gpu();
        let descriptor = wgpu::CommandEncoderDescriptor { label: Some("read words") };
        let encoder = gpu.device.create_command_encoder(&descriptor);
        Ok(render::read(gpu, encoder, &self.texture)?)
    }
}
