//! Paints egui's output, the picture of a figure or a robot included, into a texture: the window's or an offscreen one's.

use egui::{Context, FullOutput};
use egui_wgpu::{RendererOptions, ScreenDescriptor};
use render::{DrawError, Gpu};

use crate::viewport::{self, Body};

/// Egui's renderer with what draws the picture.
pub struct Painter {
    gpu: Gpu,
    renderer: egui_wgpu::Renderer,
}

impl Painter {
    /// Makes ready for targets of that format.
    ///
    /// # Errors
    /// A mesh of the body is at fault.
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat, body: &Body) -> Result<Painter, DrawError> {
        let mut painter = Painter::plain(gpu, format);
        viewport::install(&mut painter.renderer, gpu, format, body)?;
        Ok(painter)
    }

    /// The same for what shows no figure.
    pub fn plain(gpu: &Gpu, format: wgpu::TextureFormat) -> Painter {
        let renderer = egui_wgpu::Renderer::new(&gpu.device, format, RendererOptions::PREDICTABLE);
        Painter { gpu: gpu.clone(), renderer }
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// How many pictures of the figure or the robot were drawn so far.
    pub fn pictures(&self) -> u64 {
        viewport::drawn(&self.renderer)
    }

    /// Paints one frame. Every frame that egui has run must come here, or its textures are lost.
    pub fn paint(&mut self, ctx: &Context, output: FullOutput, size: [u32; 2], view: &wgpu::TextureView) {
        let Gpu { device, queue, .. } = &self.gpu;
        let FullOutput { mut textures_delta, shapes, pixels_per_point, .. } = output;
        let primitives = ctx.tessellate(shapes, pixels_per_point);
        let screen = ScreenDescriptor { size_in_pixels: size, pixels_per_point };
        for (id, deltas) in textures_delta.set.drain() {
            for delta in deltas {
                self.renderer.update_texture(device, queue, id, &delta);
            }
        }
        let mut encoder =
            device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") });
        let mut commands = self.renderer.update_buffers(device, queue, &mut encoder, &primitives, &screen);
        {
            let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("frame"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::BLACK),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                ..wgpu::RenderPassDescriptor::default()
            });
            self.renderer.render(&mut pass.forget_lifetime(), &primitives, &screen);
        }
        commands.push(encoder.finish());
        queue.submit(commands);
        for id in textures_delta.free.drain() {
            self.renderer.free_texture(&id);
        }
    }
}
