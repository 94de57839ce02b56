//! The figures' uniforms: one buffer for all, chosen by dynamic offset.

use crate::Gpu;
use crate::scene::FigureView;
use crate::uniforms::FigureUniform;

/// A growing buffer of [`FigureUniform`]s and its bind group.
#[derive(Debug)]
pub(crate) struct Figures {
    buffer: wgpu::Buffer,
    pub group: wgpu::BindGroup,
    /// What the buffer holds.
    written: Vec<FigureUniform>,
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
        Figures { buffer, group, written: Vec::new() }
    }

    /// Uploads the figures that changed, in a larger buffer if need be; returns how many bytes.
    pub fn write(&mut self, gpu: &Gpu, layout: &wgpu::BindGroupLayout, views: &[FigureView<'_>]) -> usize {
        if self.buffer.size() < STRIDE * views.len() as u64 {
            *self = Figures::new(&gpu.device, layout, views.len());
        }
        let mut bytes = 0;
        for (i, view) in views.iter().enumerate() {
            let uniform = FigureUniform::of(view);
            let same = |known: &FigureUniform| bytemuck::bytes_of(known) == bytemuck::bytes_of(&uniform);
            if self.written.get(i).is_some_and(same) {
                continue;
            }
            gpu.queue.write_buffer(&self.buffer, STRIDE * i as u64, bytemuck::bytes_of(&uniform));
            bytes += size_of::<FigureUniform>();
            match self.written.get_mut(i) {
                Some(known) => *known = uniform,
                None => self.written.push(uniform),
            }
        }
        bytes
    }

    /// The dynamic offset of a figure.
    pub fn offset(figure: usize) -> u32 {
        u32::try_from(STRIDE * figure as u64).unwrap_or(0)
    }
}
