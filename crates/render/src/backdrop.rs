//! The picture for reference behind the figures.

use wgpu::util::DeviceExt as _;

use crate::layouts::Layouts;
use crate::{DrawError, Gpu, Image};

/// A picture on the device.
#[derive(Debug)]
pub(crate) struct BackdropImage {
    pub group: wgpu::BindGroup,
}

impl BackdropImage {
    /// Uploads a picture.
    ///
    /// # Errors
    /// A size that the device can't hold, or bytes that are too few or too many for it.
    pub fn upload(gpu: &Gpu, layouts: &Layouts, image: &Image) -> Result<BackdropImage, DrawError> {
        let (width, height, limit) = (image.width, image.height, gpu.max_edge());
        let bytes = 4 * width as usize * height as usize;
        let fits = (1..=limit).contains(&width) && (1..=limit).contains(&height);
        if !fits || image.rgba.len() != bytes {
            return Err(DrawError::Size { width, height, limit });
        }
        let texture = gpu.device.create_texture_with_data(
            &gpu.queue,
            &wgpu::TextureDescriptor {
                label: Some("reference"),
                size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format: wgpu::TextureFormat::Rgba8Unorm,
                usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
                view_formats: &[],
            },
            wgpu::util::TextureDataOrder::LayerMajor,
            &image.rgba,
        );
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let sampler = gpu.device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("reference"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..wgpu::SamplerDescriptor::default()
        });
        let group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("reference"),
            layout: &layouts.soft,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&view) },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(&sampler) },
            ],
        });
        Ok(BackdropImage { group })
    }
}
