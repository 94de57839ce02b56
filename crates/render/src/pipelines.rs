//! Pipelines, each made when first used and kept.

use std::collections::HashMap;

use crate::overlay::Stroke;
use crate::shaders;
use crate::skins::VERTEX_LAYOUTS;
use crate::target::{DEPTH_FORMAT, TargetKey};
use crate::uniforms::FigureUniform;

/// What a pipeline draws.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Draw {
    /// Depth of the figures from the key light.
    Shadow,
    /// Depth of a translucent figure, so that its far side stays hidden.
    Ghost { two_sided: bool },
    /// A figure with one of figure.wgsl's fragment shaders.
    Figure { fragment: &'static str, two_sided: bool },
    /// The gradient behind everything.
    Backdrop,
    /// The grid on the ground.
    Grid,
    /// The figures' shadow on the ground.
    Shade,
    /// Lines and points: seen, hidden or both.
    Strokes(Seen),
}

/// Which strokes a draw lets through.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Seen {
    /// Those before everything.
    Before,
    /// Those behind something, faintly.
    Behind,
    /// All.
    Always,
}

/// The layouts of what shaders read.
#[derive(Debug)]
pub(crate) struct Layouts {
    pub scene: wgpu::BindGroupLayout,
    pub figure: wgpu::BindGroupLayout,
    pub shadow: wgpu::BindGroupLayout,
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
        Layouts {
            scene: layout("scene", &[uniform(None)]),
            figure: layout("figure", &[uniform(Some(size_of::<FigureUniform>()))]),
            shadow: layout("shadow", &[fragment(0, shadow_map), fragment(1, compare)]),
        }
    }
}

/// All pipelines so far.
#[derive(Debug)]
pub(crate) struct Pipelines {
    pub layouts: Layouts,
    figure: wgpu::ShaderModule,
    shadow: wgpu::ShaderModule,
    backdrop: wgpu::ShaderModule,
    ground: wgpu::ShaderModule,
    overlay: wgpu::ShaderModule,
    made: HashMap<(Draw, u32, wgpu::TextureFormat), wgpu::RenderPipeline>,
}

/// How a kind of draw differs from the others.
struct Recipe<'a> {
    module: &'a wgpu::ShaderModule,
    vertex: &'static str,
    fragment: Option<&'static str>,
    buffers: &'a [Option<wgpu::VertexBufferLayout<'a>>],
    groups: &'a [Option<&'a wgpu::BindGroupLayout>],
    strip: bool,
    cull: Option<wgpu::Face>,
    depth_write: bool,
    depth_compare: wgpu::CompareFunction,
    bias: wgpu::DepthBiasState,
    blend: bool,
}

const STROKE_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<Stroke>() as u64,
    step_mode: wgpu::VertexStepMode::Instance,
    attributes: &wgpu::vertex_attr_array![
        0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4, 3 => Unorm8x4, 4 => Float32x4
    ],
};

impl Pipelines {
    pub fn new(device: &wgpu::Device) -> Pipelines {
        let module = |label, source: &'static str| {
            device.create_shader_module(wgpu::ShaderModuleDescriptor {
                label: Some(label),
                source: wgpu::ShaderSource::Wgsl(source.into()),
            })
        };
        Pipelines {
            layouts: Layouts::new(device),
            figure: module("figure", shaders::FIGURE),
            shadow: module("shadow", shaders::SHADOW),
            backdrop: module("backdrop", shaders::BACKDROP),
            ground: module("ground", shaders::GROUND),
            overlay: module("overlay", shaders::OVERLAY),
            made: HashMap::new(),
        }
    }

    /// Makes a pipeline unless it exists.
    pub fn prepare(&mut self, device: &wgpu::Device, draw: Draw, key: TargetKey) {
        let (samples, format) = (key.msaa.samples(), key.format);
        if !self.made.contains_key(&(draw, samples, format)) {
            let made = self.make(device, draw, samples, format);
            self.made.insert((draw, samples, format), made);
        }
    }

    /// A pipeline that was prepared.
    pub fn get(&self, draw: Draw, key: TargetKey) -> Option<&wgpu::RenderPipeline> {
        self.made.get(&(draw, key.msaa.samples(), key.format))
    }

    fn make(
        &self,
        device: &wgpu::Device,
        draw: Draw,
        samples: u32,
        format: wgpu::TextureFormat,
    ) -> wgpu::RenderPipeline {
        use wgpu::CompareFunction::{Always, Greater, Less, LessEqual};
        let [skin, surface] = VERTEX_LAYOUTS.map(Some);
        let skin_only = [skin.clone()];
        let both = [skin, surface];
        let strokes = [Some(STROKE_LAYOUT)];
        let layouts = &self.layouts;
        let groups = [Some(&layouts.scene), Some(&layouts.figure), Some(&layouts.shadow)];
        let no_bias = wgpu::DepthBiasState::default();
        let plain = Recipe {
            module: &self.ground,
            vertex: "vs_grid",
            fragment: None,
            buffers: &[],
            groups: &groups,
            strip: true,
            cull: None,
            depth_write: false,
            depth_compare: LessEqual,
            bias: no_bias,
            blend: true,
        };
        let skinned = Recipe { strip: false, depth_write: true, depth_compare: Less, ..plain };
        let side = |two_sided: bool| (!two_sided).then_some(wgpu::Face::Back);
        let recipe = match draw {
            Draw::Shadow => Recipe {
                module: &self.shadow,
                vertex: "vs_shadow",
                buffers: &skin_only,
                groups: &groups[..2],
                bias: wgpu::DepthBiasState { constant: 0, slope_scale: 2.0, clamp: 0.0 },
                ..skinned
            },
            Draw::Ghost { two_sided } => Recipe {
                module: &self.figure,
                vertex: "vs_figure",
                fragment: Some("fs_nothing"),
                buffers: &both,
                cull: side(two_sided),
                ..skinned
            },
            Draw::Figure { fragment, two_sided } => Recipe {
                module: &self.figure,
                vertex: "vs_figure",
                fragment: Some(fragment),
                buffers: &both,
                cull: side(two_sided),
                depth_compare: LessEqual,
                ..skinned
            },
            Draw::Backdrop => Recipe {
                module: &self.backdrop,
                vertex: "vs_backdrop",
                fragment: Some("fs_backdrop"),
                blend: false,
                ..plain
            },
            Draw::Grid => Recipe { fragment: Some("fs_grid"), ..plain },
            Draw::Shade => Recipe { vertex: "vs_shade", fragment: Some("fs_shade"), ..plain },
            Draw::Strokes(seen) => Recipe {
                module: &self.overlay,
                vertex: "vs_stroke",
                fragment: Some(if seen == Seen::Behind { "fs_hidden" } else { "fs_stroke" }),
                buffers: &strokes,
                depth_compare: match seen {
                    Seen::Before => LessEqual,
                    Seen::Behind => Greater,
                    Seen::Always => Always,
                },
                ..plain
            },
        };
        let format = (draw != Draw::Shadow).then_some(format);
        build(device, &recipe, if format.is_some() { samples } else { 1 }, format)
    }
}

fn build(
    device: &wgpu::Device,
    recipe: &Recipe<'_>,
    samples: u32,
    format: Option<wgpu::TextureFormat>,
) -> wgpu::RenderPipeline {
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(recipe.vertex),
        bind_group_layouts: recipe.groups,
        immediate_size: 0,
    });
    let target = format.map(|format| wgpu::ColorTargetState {
        format,
        blend: recipe.blend.then_some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
        write_mask: wgpu::ColorWrites::ALL,
    });
    let targets = [target];
    let fragment = recipe.fragment.map(|entry| wgpu::FragmentState {
        module: recipe.module,
        entry_point: Some(entry),
        compilation_options: wgpu::PipelineCompilationOptions::default(),
        targets: &targets,
    });
    let topology = if recipe.strip {
        wgpu::PrimitiveTopology::TriangleStrip
    } else {
        wgpu::PrimitiveTopology::TriangleList
    };
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(recipe.fragment.unwrap_or(recipe.vertex)),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: recipe.module,
            entry_point: Some(recipe.vertex),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: recipe.buffers,
        },
        primitive: wgpu::PrimitiveState {
            topology,
            cull_mode: recipe.cull,
            ..wgpu::PrimitiveState::default()
        },
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH_FORMAT,
            depth_write_enabled: Some(recipe.depth_write),
            depth_compare: Some(recipe.depth_compare),
            stencil: wgpu::StencilState::default(),
            bias: recipe.bias,
        }),
        multisample: wgpu::MultisampleState { count: samples, ..wgpu::MultisampleState::default() },
        fragment,
        multiview_mask: None,
        cache: None,
    })
}
