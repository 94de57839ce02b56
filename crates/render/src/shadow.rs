//! The key light's depth map, and the soft shadow on the ground made from it.

use crate::flat::read_later;
use crate::layouts::Layouts;
use crate::light::SHADOW_SIZE;
use crate::target::DEPTH_FORMAT;

/// Format of the soft shadow: how much of the key light arrives.
pub(crate) const SOFT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R8Unorm;
/// Edge of the soft shadow's map over the footprint, texels.
const SOFT_SIZE: u32 = 256;

/// Both maps and their bind groups.
#[derive(Debug)]
pub(crate) struct ShadowMaps {
    /// Depth from the key light.
    pub depth: wgpu::TextureView,
    pub depth_group: wgpu::BindGroup,
    /// Light on the ground.
    pub soft: wgpu::TextureView,
    pub soft_group: wgpu::BindGroup,
    /// Edge of [`ShadowMaps::soft`], texels.
    pub soft_size: u32,
    /// For what reads a survey where there is none.
    pub nothing_group: wgpu::BindGroup,
}

impl ShadowMaps {
    pub fn new(device: &wgpu::Device, layouts: &Layouts) -> ShadowMaps {
        let depth = read_later(device, "shadow map", [SHADOW_SIZE; 2], DEPTH_FORMAT);
        let soft = read_later(device, "soft shadow", [SOFT_SIZE; 2], SOFT_FORMAT);
        let compare = Some(wgpu::CompareFunction::LessEqual);
        ShadowMaps {
            depth_group: group(device, &layouts.shadow, &depth, compare),
            soft_group: group(device, &layouts.soft, &soft, None),
            nothing_group: nothing(device, layouts),
            soft_size: SOFT_SIZE,
            depth,
            soft,
        }
    }
}

fn nothing(device: &wgpu::Device, layouts: &Layouts) -> wgpu::BindGroup {
    let view = read_later(device, "nothing", [1, 1], SOFT_FORMAT);
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("nothing"),
        layout: &layouts.found,
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&view) }],
    })
}

fn group(
    device: &wgpu::Device,
    layout: &wgpu::BindGroupLayout,
    view: &wgpu::TextureView,
    compare: Option<wgpu::CompareFunction>,
) -> wgpu::BindGroup {
    let sampler = device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("shadow"),
        mag_filter: wgpu::FilterMode::Linear,
        min_filter: wgpu::FilterMode::Linear,
        compare,
        ..wgpu::SamplerDescriptor::default()
    });
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("shadow"),
        layout,
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(view) },
            wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(&sampler) },
        ],
    })
}
