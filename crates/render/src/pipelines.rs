//! Pipelines, each made when first used and kept.

use std::collections::HashMap;

use crate::layouts::Layouts;
use crate::overlay::Stroke;
use crate::scene::Msaa;
use crate::shaders;
use crate::shadow::SOFT_FORMAT;
use crate::skins::VERTEX_LAYOUTS;
use crate::target::{DEPTH_FORMAT, PICTURE_FORMAT};

/// What a pipeline draws.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Draw {
    /// Depth of the figures from the key light.
    Shadow { two_sided: bool },
    /// The figures' shadow on the ground, into a small map of its own.
    Soften,
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

/// All pipelines so far.
#[derive(Debug)]
pub(crate) struct Pipelines {
    pub layouts: Layouts,
    figure: wgpu::ShaderModule,
    shadow: wgpu::ShaderModule,
    soften: wgpu::ShaderModule,
    backdrop: wgpu::ShaderModule,
    ground: wgpu::ShaderModule,
    overlay: wgpu::ShaderModule,
    made: HashMap<(Draw, Msaa), wgpu::RenderPipeline>,
}

/// How a kind of draw differs from the others.
struct Recipe<'a> {
    module: &'a wgpu::ShaderModule,
    vertex: &'static str,
    fragment: Option<&'static str>,
    buffers: &'a [Option<wgpu::VertexBufferLayout<'a>>],
    groups: &'a [Option<&'a wgpu::BindGroupLayout>],
    format: Option<wgpu::TextureFormat>,
    samples: u32,
    strip: bool,
    cull: Option<wgpu::Face>,
    depth: Option<DepthRule>,
    blend: Option<wgpu::BlendState>,
}

/// What a draw does with depth.
#[derive(Clone, Copy)]
struct DepthRule {
    write: bool,
    compare: wgpu::CompareFunction,
    slope_bias: f32,
}

/// Before what is there.
const OVER: wgpu::BlendState = wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING;

/// Behind what is there: surroundings come last, one sample a pixel whatever the figures have.
const UNDER: wgpu::BlendState = {
    let component = wgpu::BlendComponent {
        src_factor: wgpu::BlendFactor::OneMinusDstAlpha,
        dst_factor: wgpu::BlendFactor::One,
        operation: wgpu::BlendOperation::Add,
    };
    wgpu::BlendState { color: component, alpha: component }
};

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
            soften: module("soften", shaders::SOFTEN),
            backdrop: module("backdrop", shaders::BACKDROP),
            ground: module("ground", shaders::GROUND),
            overlay: module("overlay", shaders::OVERLAY),
            made: HashMap::new(),
        }
    }

    /// Makes a pipeline unless it exists.
    pub fn prepare(&mut self, device: &wgpu::Device, draw: Draw, msaa: Msaa) {
        if !self.made.contains_key(&(draw, msaa)) {
            let made = self.make(device, draw, msaa.samples());
            self.made.insert((draw, msaa), made);
        }
    }

    /// A pipeline that was prepared.
    pub fn get(&self, draw: Draw, msaa: Msaa) -> Option<&wgpu::RenderPipeline> {
        self.made.get(&(draw, msaa))
    }

    fn make(&self, device: &wgpu::Device, draw: Draw, samples: u32) -> wgpu::RenderPipeline {
        use wgpu::CompareFunction::{Always, Greater, Less, LessEqual};
        let [skin, surface] = VERTEX_LAYOUTS.map(Some);
        let (skin_only, both) = ([skin.clone()], [skin, surface]);
        let strokes = [Some(STROKE_LAYOUT)];
        let layouts = &self.layouts;
        let shaded = [Some(&layouts.scene), Some(&layouts.figure), Some(&layouts.shadow)];
        let ground = [Some(&layouts.scene), None, Some(&layouts.soft)];
        let plain = Recipe {
            module: &self.ground,
            vertex: "vs_grid",
            fragment: None,
            buffers: &[],
            groups: &ground,
            format: Some(PICTURE_FORMAT),
            samples: 1,
            strip: true,
            cull: None,
            depth: None,
            blend: Some(UNDER),
        };
        let side = |two_sided: bool| (!two_sided).then_some(wgpu::Face::Back);
        let skinned = |fragment, two_sided, compare| Recipe {
            module: &self.figure,
            vertex: "vs_figure",
            fragment: Some(fragment),
            buffers: &both,
            groups: &shaded,
            samples,
            strip: false,
            cull: side(two_sided),
            depth: Some(DepthRule { write: true, compare, slope_bias: 0.0 }),
            blend: Some(OVER),
            ..plain
        };
        let recipe = match draw {
            Draw::Shadow { two_sided } => Recipe {
                module: &self.shadow,
                vertex: "vs_shadow",
                fragment: None,
                buffers: &skin_only,
                groups: &shaded[..2],
                format: None,
                samples: 1,
                depth: Some(DepthRule { write: true, compare: Less, slope_bias: 2.0 }),
                ..skinned("", two_sided, Less)
            },
            Draw::Soften => Recipe {
                module: &self.soften,
                vertex: "vs_soften",
                fragment: Some("fs_soften"),
                groups: &shaded,
                format: Some(SOFT_FORMAT),
                blend: None,
                ..plain
            },
            Draw::Ghost { two_sided } => skinned("fs_nothing", two_sided, Less),
            Draw::Figure { fragment, two_sided } => skinned(fragment, two_sided, LessEqual),
            Draw::Backdrop => Recipe {
                module: &self.backdrop,
                vertex: "vs_backdrop",
                fragment: Some("fs_backdrop"),
                groups: &shaded[..1],
                ..plain
            },
            Draw::Grid => Recipe { fragment: Some("fs_grid"), groups: &shaded[..1], ..plain },
            Draw::Shade => Recipe { vertex: "vs_shade", fragment: Some("fs_shade"), ..plain },
            Draw::Strokes(seen) => Recipe {
                module: &self.overlay,
                vertex: "vs_stroke",
                fragment: Some(if seen == Seen::Behind { "fs_hidden" } else { "fs_stroke" }),
                buffers: &strokes,
                groups: &shaded[..1],
                depth: Some(DepthRule {
                    write: false,
                    compare: match seen {
                        Seen::Before => LessEqual,
                        Seen::Behind => Greater,
                        Seen::Always => Always,
                    },
                    slope_bias: 0.0,
                }),
                samples,
                blend: Some(OVER),
                ..plain
            },
        };
        build(device, &recipe)
    }
}

fn build(device: &wgpu::Device, recipe: &Recipe<'_>) -> wgpu::RenderPipeline {
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(recipe.vertex),
        bind_group_layouts: recipe.groups,
        immediate_size: 0,
    });
    let targets = [recipe.format.map(|format| wgpu::ColorTargetState {
        format,
        blend: recipe.blend,
        write_mask: wgpu::ColorWrites::ALL,
    })];
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
    let depth_stencil = recipe.depth.map(|rule| wgpu::DepthStencilState {
        format: DEPTH_FORMAT,
        depth_write_enabled: Some(rule.write),
        depth_compare: Some(rule.compare),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState { constant: 0, slope_scale: rule.slope_bias, clamp: 0.0 },
    });
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
        depth_stencil,
        multisample: wgpu::MultisampleState { count: recipe.samples, ..wgpu::MultisampleState::default() },
        fragment,
        multiview_mask: None,
        cache: None,
    })
}
