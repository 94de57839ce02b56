//! The picture's textures.

use crate::flat::flat;
use crate::scene::{Msaa, Pass};

/// Format of depth buffers and of the shadow map.
pub(crate) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Format of every picture. Light is stored encoded for the eye (sRGB numbers) in a texture that does not know it:
/// blending, resolving and blitting then cost no conversion, and data passes keep their numbers.
pub(crate) const PICTURE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// What a picture's textures depend on.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct TargetKey {
    pub size: [u32; 2],
    pub msaa: Msaa,
}

impl TargetKey {
    /// The textures of a pass. Depth, normals and parts must not mix at edges.
    pub fn of(pass: Pass, size: [u32; 2], msaa: Msaa) -> TargetKey {
        let msaa = if matches!(pass, Pass::Depth | Pass::Normal | Pass::Parts) { Msaa::One } else { msaa };
        TargetKey { size, msaa }
    }
}

/// The picture, its depth and its samples.
#[derive(Debug)]
pub(crate) struct Target {
    pub key: TargetKey,
    pub picture: wgpu::Texture,
    pub view: wgpu::TextureView,
    pub depth: wgpu::TextureView,
    samples: Option<wgpu::TextureView>,
}

impl Target {
    pub fn new(device: &wgpu::Device, key: TargetKey) -> Target {
        let texture = |label, samples, format, usage| flat(device, label, key.size, samples, format, usage);
        let drawn = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let read = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let samples = key.msaa.samples();
        let picture = texture("picture", 1, PICTURE_FORMAT, drawn | read);
        let view_of = |t: &wgpu::Texture| t.create_view(&wgpu::TextureViewDescriptor::default());
        Target {
            view: view_of(&picture),
            depth: view_of(&texture("picture depth", samples, DEPTH_FORMAT, drawn)),
            samples: (samples > 1)
                .then(|| view_of(&texture("picture samples", samples, PICTURE_FORMAT, drawn))),
            picture,
            key,
        }
    }

    /// The attachment to draw into, resolved into the picture.
    pub fn color(&self, clear: wgpu::Color) -> wgpu::RenderPassColorAttachment<'_> {
        let store = if self.samples.is_some() { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store };
        wgpu::RenderPassColorAttachment {
            view: self.samples.as_ref().unwrap_or(&self.view),
            depth_slice: None,
            resolve_target: self.samples.is_some().then_some(&self.view),
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store },
        }
    }
}
