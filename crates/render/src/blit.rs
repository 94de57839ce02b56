//! Paints the renderer's picture into a rectangle of any pass: the window's, or a test harness's.

use crate::renderer::Renderer;
use crate::{Gpu, shaders};

/// Paints pictures into targets of one format.
///
/// In egui's paint callback: [`Renderer::draw`] and [`Blit::prepare`] in `prepare`, [`Blit::paint`] in `paint`.
#[derive(Debug)]
pub struct Blit {
    layout: wgpu::BindGroupLayout,
    sampler: wgpu::Sampler,
    pipeline: wgpu::RenderPipeline,
    source: Option<(wgpu::Texture, wgpu::BindGroup)>,
}

impl Blit {
    /// For targets of that format, one sample, no depth. A plain `Unorm` target gets sRGB numbers, as egui wants;
    /// an `UnormSrgb` one the same colours.
    pub fn new(gpu: &Gpu, target_format: wgpu::TextureFormat) -> Blit {
        let device = &gpu.device;
        let layout = bind_layout(device);
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("blit"),
            source: wgpu::ShaderSource::Wgsl(shaders::BLIT.into()),
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("blit"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        // An sRGB target encodes what it gets, and the picture is encoded already.
        let fragment = if target_format.is_srgb() { "fs_decode" } else { "fs_same" };
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(fragment),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vs_blit"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState {
                topology: wgpu::PrimitiveTopology::TriangleStrip,
                ..wgpu::PrimitiveState::default()
            },
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(fragment),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(wgpu::ColorTargetState {
                    format: target_format,
                    blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                    write_mask: wgpu::ColorWrites::ALL,
                })],
            }),
            multiview_mask: None,
            cache: None,
        });
        let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("blit"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..wgpu::SamplerDescriptor::default()
        });
        Blit { pipeline, layout, sampler, source: None }
    }

    /// Takes the renderer's present picture as source; cheap if its texture is the same as before.
    pub fn prepare(&mut self, renderer: &Renderer) {
        let Some(picture) = renderer.picture() else {
            self.source = None;
            return;
        };
        if self.source.as_ref().is_some_and(|(known, _)| known == picture) {
            return;
        }
        let view = picture.create_view(&wgpu::TextureViewDescriptor::default());
        let group = renderer.gpu().device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("blit"),
            layout: &self.layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&view) },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(&self.sampler) },
            ],
        });
        self.source = Some((picture.clone(), group));
    }

    /// Paints the picture into the pass: `[x, y, width, height]` in pixels of the target, stretched.
    ///
    /// Sets the viewport and leaves it set. Nothing happens without a picture or with an empty rectangle.
    pub fn paint(&self, pass: &mut wgpu::RenderPass<'_>, rect_px: [f32; 4]) {
        let Some((_, group)) = &self.source else { return };
        let [x, y, width, height] = rect_px;
        if !(width >= 1.0 && height >= 1.0 && x.is_finite() && y.is_finite()) {
            return;
        }
        pass.set_viewport(x, y, width, height, 0.0, 1.0);
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, group, &[]);
        pass.draw(0..4, 0..1);
    }
}

fn bind_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty,
        count: None,
    };
    let texture = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: true },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("blit"),
        entries: &[entry(0, texture), entry(1, sampler)],
    })
}
