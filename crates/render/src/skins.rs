//! Skins on the device: uploaded once, drawn in every pass.

use bytemuck::{Pod, Zeroable};
use rig::{Mesh, SkinBounds};
use wgpu::util::DeviceExt;

/// What every pass reads of a vertex; `SkinVertex` in skin.wgsl.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct SkinVertex {
    position: [f32; 3],
    joints: [u8; 4],
    weights: [u16; 4],
}

/// What shading reads besides; `SurfaceVertex` in skin.wgsl.
#[derive(Clone, Copy, Pod, Zeroable)]
#[repr(C)]
struct SurfaceVertex {
    normal: [f32; 3],
    color: [u16; 4],
}

/// A skin on the device.
#[derive(Debug)]
pub(crate) struct Skin {
    pub vertices: wgpu::Buffer,
    pub surface: wgpu::Buffer,
    pub indices: wgpu::Buffer,
    pub index_count: u32,
    pub bounds: SkinBounds,
}

impl Skin {
    /// Uploads a mesh without faults.
    pub fn upload(device: &wgpu::Device, mesh: &Mesh) -> Skin {
        let rows = mesh.positions.iter().zip(&mesh.joints).zip(&mesh.weights);
        let vertices: Vec<SkinVertex> =
            rows.map(|((&position, &joints), &weights)| SkinVertex { position, joints, weights }).collect();
        let rows = mesh.normals.iter().zip(&mesh.colors);
        let surface: Vec<SurfaceVertex> = rows
            .map(|(&normal, &[r, g, b])| SurfaceVertex { normal, color: [r, g, b, 1.0].map(unorm16) })
            .collect();
        let buffer = |label, contents: &[u8], usage| {
            let descriptor = wgpu::util::BufferInitDescriptor { label: Some(label), contents, usage };
            device.create_buffer_init(&descriptor)
        };
        Skin {
            vertices: buffer("skin vertices", bytemuck::cast_slice(&vertices), wgpu::BufferUsages::VERTEX),
            surface: buffer("skin surface", bytemuck::cast_slice(&surface), wgpu::BufferUsages::VERTEX),
            indices: buffer("skin indices", bytemuck::cast_slice(&mesh.indices), wgpu::BufferUsages::INDEX),
            index_count: u32::try_from(mesh.indices.len()).unwrap_or(u32::MAX),
            bounds: SkinBounds::new(mesh),
        }
    }
}

fn unorm16(x: f32) -> u16 {
    (x.clamp(0.0, 1.0) * 65535.0).round() as u16
}

/// The layouts of both vertex buffers.
pub(crate) const VERTEX_LAYOUTS: [wgpu::VertexBufferLayout<'static>; 2] = [
    wgpu::VertexBufferLayout {
        array_stride: size_of::<SkinVertex>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Uint8x4, 2 => Unorm16x4],
    },
    wgpu::VertexBufferLayout {
        array_stride: size_of::<SurfaceVertex>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![3 => Float32x3, 4 => Unorm16x4],
    },
];
