//! The scene's uniform on the device.

use crate::Gpu;
use crate::layouts::Layouts;
use crate::uniforms::SceneUniform;

/// A buffer with a [`SceneUniform`], written only when that changes.
#[derive(Debug)]
pub(crate) struct SceneBuffer {
    buffer: wgpu::Buffer,
    pub group: wgpu::BindGroup,
    written: Option<Box<SceneUniform>>,
}

impl SceneBuffer {
    pub fn new(device: &wgpu::Device, layouts: &Layouts) -> SceneBuffer {
        let buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("scene"),
            size: size_of::<SceneUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scene"),
            layout: &layouts.scene,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() }],
        });
        SceneBuffer { buffer, group, written: None }
    }

    /// The bytes uploaded: none if it is the uniform that is there.
    pub fn write(&mut self, gpu: &Gpu, uniform: &SceneUniform) -> usize {
        let bytes = bytemuck::bytes_of(uniform);
        if self.written.as_ref().is_some_and(|written| bytemuck::bytes_of(&**written) == bytes) {
            return 0;
        }
        gpu.queue.write_buffer(&self.buffer, 0, bytes);
        self.written = Some(Box::new(*uniform));
        bytes.len()
    }
}
