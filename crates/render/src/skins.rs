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

#[cfg(test)]
mod tests {
    use glam::{DQuat, DVec3, Mat4, Vec3};
    use rig::{
        Bone, Frame, Frames, PALETTE_LEN, PLACES, Palette, bone_of_place, skin_normals, skin_positions,
    };

    use super::*;
    use crate::figures::Figures;
    use crate::layouts::Layouts;
    use crate::scene::FigureView;
    use crate::{Gpu, shaders};

    /// Every vertex on its own texel, so that what the vertex stage computes can be read back.
    const PROBE: &str = "
        struct Probe { @builtin(position) clip: vec4<f32>, @location(0) value: vec3<f32> }
        fn texel(index: u32) -> vec4<f32> {
            let at = vec2(f32(index % 64u) + 0.5, f32(index / 64u) + 0.5);
            return vec4(at.x / 32.0 - 1.0, 1.0 - at.y / 32.0, 0.5, 1.0);
        }
        @vertex fn position(in: SkinVertex, @builtin(vertex_index) i: u32) -> Probe {
            return Probe(texel(i), world_position(in));
        }
        @vertex fn normal(in: SkinVertex, s: SurfaceVertex, @builtin(vertex_index) i: u32) -> Probe {
            let n = vec4(s.normal, 0.0) * skin_matrix(in.joints, in.weights);
            return Probe(texel(i), normalize((figure.world_from_figure * vec4(n, 0.0)).xyz));
        }
        @fragment fn value(in: Probe) -> @location(0) vec4<f32> { return vec4(in.value, 1.0); }
    ";
    const VERTICES: usize = 4096;

    /// Numbers that look random and are the same on every run.
    fn random(seed: &mut u64) -> f64 {
        *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (*seed >> 33) as f64 / f64::from(1_u32 << 31)
    }

    fn random_vector(seed: &mut u64, reach: f64) -> DVec3 {
        DVec3::new(random(seed), random(seed), random(seed)) * (2.0 * reach) - DVec3::splat(reach)
    }

    fn random_mesh(seed: &mut u64) -> Mesh {
        let mut mesh = Mesh { indices: (0..VERTICES as u32).collect(), ..Mesh::default() };
        mesh.indices.truncate(VERTICES / 3 * 3);
        for _ in 0..VERTICES {
            mesh.positions.push(random_vector(seed, 1.0).as_vec3().to_array());
            mesh.normals.push(random_vector(seed, 1.0).normalize().as_vec3().to_array());
            mesh.colors.push([0.5; 3]);
            // A place, its bone and what carries that: on a body the bones of a vertex are neighbours.
            let place = (random(seed) * PLACES as f64) as usize;
            let bone = bone_of_place(place);
            let bones = [bone, bone.carrier(), bone.carrier().carrier()].map(Bone::index);
            mesh.joints.push([place, bones[0], bones[1], bones[2]].map(|place| place as u8));
            let a = (random(seed) * 40000.0) as u16;
            let b = (random(seed) * 20000.0) as u16;
            let c = (random(seed) * 5000.0) as u16;
            mesh.weights.push([65535 - a - b - c, a, b, c]);
        }
        mesh
    }

    fn random_palette(seed: &mut u64) -> Palette {
        let rest: [DVec3; Bone::COUNT] = std::array::from_fn(|_| random_vector(seed, 1.0));
        let mut frames = Frames([Frame::IDENTITY; Bone::COUNT]);
        for bone in Bone::ALL {
            let turn = DQuat::from_scaled_axis(random_vector(seed, 0.8));
            let rotation = frames[bone.carrier()].rotation * turn;
            frames.0[bone.index()] = Frame { rotation, position: random_vector(seed, 1.0) };
        }
        Palette::new(&frames, &rest)
    }

    fn probe(gpu: &Gpu, mesh: &Mesh, view: &FigureView<'_>, vertex: &str) -> Vec<Vec3> {
        let device = &gpu.device;
        let layouts = Layouts::new(device);
        let mut figures = Figures::new(device, &layouts.figure, 1);
        figures.write(gpu, &layouts.figure, std::slice::from_ref(view));
        let source = format!("{}{PROBE}", shaders::SHADOW);
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("probe"),
            source: wgpu::ShaderSource::Wgsl(source.into()),
        });
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[None, Some(&layouts.figure)],
            immediate_size: 0,
        });
        let format = wgpu::TextureFormat::Rgba32Float;
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some("probe"),
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some(vertex),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &VERTEX_LAYOUTS.map(Some),
            },
            primitive: wgpu::PrimitiveState {
                topology: wgpu::PrimitiveTopology::PointList,
                ..wgpu::PrimitiveState::default()
            },
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("value"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        let texture = crate::canvas(gpu, "skinned", [64, 64], format);
        let skin = Skin::upload(device, mesh);
        let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &texture.create_view(&wgpu::TextureViewDescriptor::default()),
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations::default(),
            })],
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(1, &figures.group, &[0]);
        pass.set_vertex_buffer(0, skin.vertices.slice(..));
        pass.set_vertex_buffer(1, skin.surface.slice(..));
        pass.draw(0..VERTICES as u32, 0..1);
        drop(pass);
        let read = crate::image::read(gpu, encoder, &texture).unwrap();
        let floats: Vec<f32> = bytemuck::pod_collect_to_vec(&read.rgba);
        floats.chunks_exact(4).map(|c| Vec3::new(c[0], c[1], c[2])).collect()
    }

    #[test]
    fn the_shader_skins_as_its_twin_on_the_cpu() {
        let gpu = Gpu::headless().unwrap();
        let seed = &mut 20_260_301;
        let (mesh, palette) = (random_mesh(seed), random_palette(seed));
        assert_eq!(mesh.fault(), None);
        assert_eq!(palette.0[PALETTE_LEN - 1], Palette::REST.0[0]);
        let world_from_figure =
            Mat4::from_rotation_translation(glam::Quat::from_rotation_y(0.7), Vec3::new(0.3, 0.1, -0.5));
        let view = FigureView { world_from_figure, ..FigureView::new(&palette) };
        let positions = probe(&gpu, &mesh, &view, "position");
        for (i, (gpu, cpu)) in positions.iter().zip(skin_positions(&mesh, &palette)).enumerate() {
            let cpu = world_from_figure.transform_point3(cpu);
            assert!((*gpu - cpu).length() < 1e-5, "vertex {i}: {gpu} on the device, {cpu} on the CPU");
        }
        let normals = probe(&gpu, &mesh, &view, "normal");
        for (i, (gpu, cpu)) in normals.iter().zip(skin_normals(&mesh, &palette)).enumerate() {
            let cpu = world_from_figure.transform_vector3(cpu);
            assert!((*gpu - cpu).length() < 1e-5, "vertex {i}: {gpu} on the device, {cpu} on the CPU");
        }
    }
}
