//! Crowds: many figures of one skin, drawn at once from a buffer of matrices.

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec3};
use rig::{Bounds, PLACES, Palette};

use crate::scene::FigureView;
use crate::uniforms::FigureUniform;
use crate::{DrawError, Gpu};

/// Many figures of one skin, each with matrices of its own; one draw call a pass.
///
/// Skinned by linear blending, which is enough where joints bend as in walking. They stand in every pass but
/// [`crate::Pass::OpenPose`], and cast and catch shadows.
#[derive(Clone, Copy, Debug)]
pub struct CrowdView<'a> {
    /// The slot given to [`crate::Renderer::set_mesh`]: the skin that all wear.
    pub skin: usize,
    /// World from rest, metres: blocks of [`CrowdView::lanes`] figures abreast; in a block by place of the palette, then
    /// by number of the matrix (three columns of the turn, then the shift), then by figure.
    pub matrices: &'a [f32],
    /// Figures abreast in a block, at least one.
    pub lanes: usize,
    /// Matrices of a figure, at least [`rig::PLACES`]; those after the places are not read.
    pub rows: usize,
    /// How many figures; those beyond in the last block are no one's.
    pub count: usize,
    /// How much colours differ from figure to figure, by its number: 0 not at all, 1 as people's clothes do.
    pub variety: f32,
    /// Other numbers give other colours.
    pub seed: u32,
}

impl<'a> CrowdView<'a> {
    /// Figures in skin 0, colours slightly varied.
    pub fn new(matrices: &'a [f32], lanes: usize, rows: usize, count: usize) -> CrowdView<'a> {
        CrowdView { skin: 0, matrices, lanes, rows, count, variety: 0.5, seed: 0 }
    }

    /// How many numbers the figures have; `None` if that, or a part of it, is no number of an array.
    fn numbers(&self) -> Option<usize> {
        let blocks = self.count.div_ceil(self.lanes.max(1));
        blocks.checked_mul(self.rows)?.checked_mul(12)?.checked_mul(self.lanes)
    }

    /// What the device reads: whole blocks.
    fn read(&self) -> &'a [f32] {
        self.numbers().and_then(|numbers| self.matrices.get(..numbers)).unwrap_or_default()
    }

    /// That the numbers are as many as they must be, and the device can hold them.
    pub(crate) fn check(&self, crowd: usize, limits: &wgpu::Limits) -> Result<(), DrawError> {
        let (found, expected) = (self.matrices.len(), self.numbers());
        if self.lanes == 0 || self.rows < PLACES || expected.is_none_or(|expected| found < expected) {
            let &CrowdView { count, lanes, rows, .. } = self;
            return Err(DrawError::CrowdNumbers { crowd, found, count, lanes, rows });
        }
        let held = limits.max_storage_buffer_binding_size.min(limits.max_buffer_size);
        let limit = held as usize / (12 * size_of::<f32>() * self.rows);
        if self.count.next_multiple_of(self.lanes) > limit {
            return Err(DrawError::CrowdSize { crowd, count: self.count, limit });
        }
        Ok(())
    }

    /// Where a figure's first place takes a point of the skin at rest.
    fn carried(&self, walker: usize, rest: Vec3) -> Vec3 {
        let first = (walker / self.lanes) * self.rows * 12 * self.lanes + walker % self.lanes;
        let at = |k: usize| self.matrices.get(first + k * self.lanes).copied().unwrap_or(f32::NAN);
        let column = |k: usize| Vec3::new(at(k), at(k + 1), at(k + 2));
        column(0) * rest.x + column(3) * rest.y + column(6) * rest.z + column(9)
    }

    /// A box around those who are in the picture or may cast a shadow into it. Nobody reaches farther from the
    /// middle of the skin at rest, carried by the first place (the hips), than the skin does at rest.
    pub(crate) fn bounds(&self, rest: Bounds, clip_from_world: Mat4) -> Bounds {
        let (middle, reach) = (rest.center(), rest.radius());
        let width = |row: glam::Vec4| row.truncate().length() * (reach + SHADOW_REACH_M);
        let rows = [0, 1, 3].map(|row| clip_from_world.row(row));
        let near = |at: Vec3| {
            let [x, y, w] = rows.map(|row| row.dot(at.extend(1.0)));
            let inside = |row, across: f32| across.abs() <= w + width(rows[2]) + width(row);
            w >= -width(rows[2]) && inside(rows[0], x) && inside(rows[1], y)
        };
        let all = (0..self.count).map(|walker| self.carried(walker, middle)).filter(|at| near(*at));
        all.fold(Bounds::EMPTY, |bounds, at| bounds.with(at - reach).with(at + reach))
    }
}

/// Farther off than so, beside the picture, nobody's shadow falls into it, metres.
const SHADOW_REACH_M: f32 = 2.0;

/// Twin of `Crowd` in crowd.wgsl.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct CrowdUniform {
    lanes: u32,
    rows: u32,
    seed: u32,
    variety: f32,
}

impl CrowdUniform {
    fn of(view: &CrowdView<'_>) -> CrowdUniform {
        let whole = |number: usize| u32::try_from(number).unwrap_or(u32::MAX);
        let variety = if view.variety.is_finite() { view.variety.clamp(0.0, 1.0) } else { 0.0 };
        CrowdUniform { lanes: whole(view.lanes), rows: whole(view.rows), seed: view.seed, variety }
    }
}

/// The crowds' buffers and bind groups, by their place in the scene.
#[derive(Debug, Default)]
pub(crate) struct Crowds(Vec<CrowdBuffer>);

#[derive(Debug)]
struct CrowdBuffer {
    matrices: wgpu::Buffer,
    uniform: wgpu::Buffer,
    group: wgpu::BindGroup,
}

impl Crowds {
    /// Uploads all matrices, in larger buffers if need be; returns how many bytes.
    pub fn write(&mut self, gpu: &Gpu, layout: &wgpu::BindGroupLayout, views: &[CrowdView<'_>]) -> usize {
        self.0.truncate(views.len());
        let mut bytes = 0;
        for (i, view) in views.iter().enumerate() {
            let matrices: &[u8] = bytemuck::cast_slice(view.read());
            if self.0.get(i).is_none_or(|buffer| buffer.matrices.size() < matrices.len() as u64) {
                let made = CrowdBuffer::new(gpu, layout, matrices.len() as u64);
                self.0.truncate(i);
                self.0.push(made);
            }
            let uniform = CrowdUniform::of(view);
            gpu.queue.write_buffer(&self.0[i].uniform, 0, bytemuck::bytes_of(&uniform));
            gpu.queue.write_buffer(&self.0[i].matrices, 0, matrices);
            bytes += matrices.len() + size_of::<CrowdUniform>();
        }
        bytes
    }

    /// What a crowd's draws read.
    pub fn group(&self, crowd: usize) -> Option<&wgpu::BindGroup> {
        self.0.get(crowd).map(|buffer| &buffer.group)
    }
}

impl CrowdBuffer {
    fn new(gpu: &Gpu, layout: &wgpu::BindGroupLayout, bytes: u64) -> CrowdBuffer {
        use wgpu::BufferUsages;
        let buffer = |label, size, usage| {
            gpu.device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(label),
                size,
                usage: usage | BufferUsages::COPY_DST,
                mapped_at_creation: false,
            })
        };
        let matrices = buffer("crowd's matrices", bytes.max(16), BufferUsages::STORAGE);
        let uniform = buffer("crowd", size_of::<CrowdUniform>() as u64, BufferUsages::UNIFORM);
        // What figures' shaders read: solid, unmarked.
        let figure = buffer("crowd's figure", size_of::<FigureUniform>() as u64, BufferUsages::UNIFORM);
        let solid = FigureUniform::of(&FigureView::new(&Palette::REST));
        gpu.queue.write_buffer(&figure, 0, bytemuck::bytes_of(&solid));
        let read = [(0, &figure), (1, &matrices), (2, &uniform)];
        let entries = read
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() });
        let descriptor = wgpu::BindGroupDescriptor { label: Some("crowd"), layout, entries: &entries };
        CrowdBuffer { group: gpu.device.create_bind_group(&descriptor), matrices, uniform }
    }
}

/// The layout of what crowds read.
///
/// # Errors
/// The device's vertex shaders can't read storage buffers.
pub(crate) fn layout(gpu: &Gpu) -> Result<wgpu::BindGroupLayout, DrawError> {
    let entry = |binding, visibility, ty| wgpu::BindGroupLayoutEntry {
        binding,
        visibility,
        ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
        count: None,
    };
    let (uniform, both) = (wgpu::BufferBindingType::Uniform, wgpu::ShaderStages::VERTEX_FRAGMENT);
    let storage = wgpu::BufferBindingType::Storage { read_only: true };
    let entries = [
        entry(0, both, uniform),
        entry(1, wgpu::ShaderStages::VERTEX, storage),
        entry(2, wgpu::ShaderStages::VERTEX, uniform),
    ];
    let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
    let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some("crowd"), entries: &entries };
    let layout = gpu.device.create_bind_group_layout(&descriptor);
    match pollster::block_on(scope.pop()) {
        Some(_) => Err(DrawError::CrowdDevice(gpu.info.name.clone())),
        None => Ok(layout),
    }
}
