//! The bind groups' layouts: what shaders read.

use crate::uniforms::FigureUniform;

/// The layouts of what shaders read.
#[derive(Debug)]
pub(crate) struct Layouts {
    pub scene: wgpu::BindGroupLayout,
    pub figure: wgpu::BindGroupLayout,
    /// What crowds read, once there was one.
    pub crowd: Option<wgpu::BindGroupLayout>,
    /// The key light's depth.
    pub shadow: wgpu::BindGroupLayout,
    /// A filtered texture: the softened shadow on the ground, or the picture for reference.
    pub soft: wgpu::BindGroupLayout,
    /// What a survey sees: depth, normals, and the shadow map.
    pub seen: wgpu::BindGroupLayout,
    /// What it found.
    pub found: wgpu::BindGroupLayout,
}

impl Layouts {
    pub fn new(device: &wgpu::Device) -> Layouts {
        let layout = |label, entries: &[wgpu::BindGroupLayoutEntry]| {
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(label), entries })
        };
        let uniform = |size: Option<usize>| wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: size.is_some(),
                min_binding_size: size.and_then(|s| std::num::NonZeroU64::new(s as u64)),
            },
            count: None,
        };
        let fragment = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty,
            count: None,
        };
        let shadow_map = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Depth,
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let compare = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison);
        let soft_map = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: true },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        let filter = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
        Layouts {
            scene: layout("scene", &[uniform(None)]),
            figure: layout("figure", &[uniform(Some(size_of::<FigureUniform>()))]),
            crowd: None,
            shadow: layout("shadow", &[fragment(0, shadow_map), fragment(1, compare)]),
            soft: layout("soft shadow", &[fragment(0, soft_map), fragment(1, filter)]),
            seen: layout("seen", &[fragment(0, shadow_map), fragment(1, soft_map), fragment(2, shadow_map)]),
            found: layout("found", &[fragment(0, soft_map)]),
        }
    }
}
