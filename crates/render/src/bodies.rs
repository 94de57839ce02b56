//! A figure's skin on the device, whole and cut into parts.

use glam::Vec3;
use rig::{Bounds, Mesh};
use wgpu::util::DeviceExt as _;

use crate::parts::Cut;
use crate::skins::Skin;

/// What is drawn of a figure.
#[derive(Debug)]
pub(crate) struct Body {
    pub skin: Skin,
    /// The skin cut into parts, once a picture wanted it.
    pub parts: Option<PartSkin>,
    /// The box around the skin at rest.
    pub at_rest: Bounds,
    mesh: Mesh,
}

/// A skin cut into parts.
#[derive(Debug)]
pub(crate) struct PartSkin {
    pub skin: Skin,
    /// One [`crate::parts::PartVertex`] for each of the skin's.
    pub vertices: wgpu::Buffer,
}

impl Body {
    /// Uploads a mesh without faults.
    pub fn upload(device: &wgpu::Device, mesh: &Mesh) -> Body {
        let at_rest = Bounds::of(mesh.positions.iter().map(|p| Vec3::from_array(*p)));
        Body { skin: Skin::upload(device, mesh), parts: None, at_rest, mesh: mesh.clone() }
    }

    /// Cuts the skin into parts, unless that is done.
    pub fn cut(&mut self, device: &wgpu::Device) {
        if self.parts.is_none() {
            let cut = Cut::new(&self.mesh);
            let vertices = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
                label: Some("skin parts"),
                contents: bytemuck::cast_slice(&cut.parts),
                usage: wgpu::BufferUsages::VERTEX,
            });
            self.parts = Some(PartSkin { skin: Skin::upload(device, &cut.mesh), vertices });
        }
    }
}
