//! Pictures read back from the device.

use crate::flat::flat;
use crate::{DrawError, Gpu};

/// A picture in memory.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Image {
    /// Pixels across.
    pub width: u32,
    /// Pixels down.
    pub height: u32,
    /// Four bytes a pixel, rows from the top, straight alpha; sRGB, or plain numbers for data passes.
    pub rgba: Vec<u8>,
}

impl Image {
    /// A pixel; `None` outside.
    pub fn pixel(&self, x: u32, y: u32) -> Option<[u8; 4]> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let at = 4 * (y as usize * self.width as usize + x as usize);
        self.rgba.get(at..at + 4).and_then(|p| p.try_into().ok())
    }
}

/// A texture to draw into and then [`read`]; each edge at least 1 pixel and no more than the device holds.
pub fn canvas(gpu: &Gpu, label: &str, size: [u32; 2], format: wgpu::TextureFormat) -> wgpu::Texture {
    let usage = wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC;
    flat(&gpu.device, label, size, 1, format, usage)
}

/// Copies a texture of four-byte texels into memory, after the encoder's commands.
///
/// # Errors
/// The driver complains or loses the device.
pub fn read(
    gpu: &Gpu,
    mut encoder: wgpu::CommandEncoder,
    texture: &wgpu::Texture,
) -> Result<Image, DrawError> {
    let (width, height) = (texture.width(), texture.height());
    let texel = texture.format().block_copy_size(None).unwrap_or(4);
    let row = width * texel;
    let stride = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read back"),
        size: u64::from(stride) * u64::from(height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &buffer,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(stride),
                rows_per_image: Some(height),
            },
        },
        texture.size(),
    );
    gpu.queue.submit([encoder.finish()]);
    let driver = |e: &dyn std::fmt::Display| DrawError::Driver(e.to_string());
    buffer.map_async(wgpu::MapMode::Read, .., |_| {});
    gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| driver(&e))?;
    if let Some(fault) = gpu.take_fault() {
        return Err(DrawError::Driver(fault));
    }
    let bytes = buffer.get_mapped_range(..).map_err(|e| driver(&e))?;
    let rows = bytes.chunks_exact(stride as usize);
    let rgba = rows.flat_map(|r| r.iter().take(row as usize).copied()).collect();
    Ok(Image { width, height, rgba })
}
