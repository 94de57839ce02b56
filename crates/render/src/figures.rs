//! The figures' uniforms: one buffer for all, chosen by dynamic offset.

use crate::scene::FigureView;
use crate::uniforms::FigureUniform;

/// A growing buffer of [`FigureUniform`]s and its bind group.
#[derive(Debug)]
pub(crate) struct Figures {
    buffer: wgpu::Buffer,
    pub group: wgpu::BindGroup,
}

const STRIDE: u64 = size_of::<FigureUniform>() as u64;

impl Figures {
    pub fn new(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, count: usize) -> Figures {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("figures"),
            size: STRIDE * count.max(1).next_power_of_two() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let binding =
            wgpu::BufferBinding { buffer: &buffer, offset: 0, size: std::num::NonZeroU64::new(STRIDE) };
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("figures"),
            layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::Buffer(binding) }],
        });
        Figures { buffer, group }
    }

    /// Uploads the figures, in a larger buffer if need be.
    pub fn write(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        layout: &wgpu::BindGroupLayout,
        views: &[FigureView<'_>],
    ) {
        if self.buffer.size() < STRIDE * views.len() as u64 {
            *self = Figures::new(device, layout, views.len());
        }
        let uniforms: Vec<FigureUniform> = views.iter().map(FigureUniform::of).collect();
        if !uniforms.is_empty() {
            queue.write_buffer(&self.buffer, 0, bytemuck::cast_slice(&uniforms));
        }
    }

    /// The dynamic offset of a figure.
    pub fn offset(figure: usize) -> u32 {
        u32::try_from(STRIDE * figure as u64).unwrap_or(0)
    }
}
