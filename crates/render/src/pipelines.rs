//! Pipelines, each made from its recipe when first used, and kept.

use std::collections::HashMap;
use std::sync::OnceLock;

use crate::layouts::Layouts;
use crate::recipe::{Draw, Groups, Recipe, Source};
use crate::scene::Msaa;
use crate::shaders;
use crate::target::DEPTH_FORMAT;

/// All pipelines so far.
#[derive(Debug)]
pub(crate) struct Pipelines {
    pub layouts: Layouts,
    figure: wgpu::ShaderModule,
    /// Made when it is first used, as most pictures have no crowd.
    crowd: OnceLock<wgpu::ShaderModule>,
    shadow: wgpu::ShaderModule,
    soften: wgpu::ShaderModule,
    backdrop: wgpu::ShaderModule,
    image: wgpu::ShaderModule,
    ground: wgpu::ShaderModule,
    overlay: wgpu::ShaderModule,
    surfaces: wgpu::ShaderModule,
    occlusion: wgpu::ShaderModule,
    smooth: wgpu::ShaderModule,
    trace: wgpu::ShaderModule,
    made: HashMap<(Draw, Msaa), wgpu::RenderPipeline>,
}

impl Pipelines {
    pub fn new(device: &wgpu::Device) -> Pipelines {
        let module = |label, source| module(device, label, source);
        Pipelines {
            layouts: Layouts::new(device),
            figure: module("figure", shaders::FIGURE),
            crowd: OnceLock::new(),
            shadow: module("shadow", shaders::SHADOW),
            soften: module("soften", shaders::SOFTEN),
            backdrop: module("backdrop", shaders::BACKDROP),
            image: module("image", shaders::IMAGE),
            ground: module("ground", shaders::GROUND),
            overlay: module("overlay", shaders::OVERLAY),
            surfaces: module("surfaces", shaders::SURFACES),
            occlusion: module("occlusion", shaders::OCCLUSION),
            smooth: module("smooth", shaders::SMOOTH),
            trace: module("trace", shaders::TRACE),
            made: HashMap::new(),
        }
    }

    /// Makes a pipeline unless it exists.
    pub fn prepare(&mut self, device: &wgpu::Device, draw: Draw, msaa: Msaa) {
        if !self.made.contains_key(&(draw, msaa)) {
            let made = self.make(device, &Recipe::of(draw, msaa));
            self.made.insert((draw, msaa), made);
        }
    }

    /// A pipeline that was prepared.
    pub fn get(&self, draw: Draw, msaa: Msaa) -> Option<&wgpu::RenderPipeline> {
        self.made.get(&(draw, msaa))
    }

    fn module(&self, device: &wgpu::Device, source: Source) -> &wgpu::ShaderModule {
        match source {
            Source::Figure => &self.figure,
            Source::Crowd => self.crowd.get_or_init(|| module(device, "crowd", shaders::CROWD)),
            Source::Shadow => &self.shadow,
            Source::Soften => &self.soften,
            Source::Backdrop => &self.backdrop,
            Source::Image => &self.image,
            Source::Ground => &self.ground,
            Source::Overlay => &self.overlay,
            Source::Surfaces => &self.surfaces,
            Source::Occlusion => &self.occlusion,
            Source::Smooth => &self.smooth,
            Source::Trace => &self.trace,
        }
    }

    fn layout(&self, device: &wgpu::Device, groups: Groups) -> wgpu::PipelineLayout {
        let Layouts { scene, figure, crowd, shadow, soft, seen, found } = &self.layouts;
        let all = match groups {
            Groups::Scene => [Some(scene), None, None, None],
            Groups::Figure => [Some(scene), Some(figure), None, None],
            Groups::Lit => [Some(scene), Some(figure), Some(shadow), Some(found)],
            Groups::Crowd => [Some(scene), crowd.as_ref(), None, None],
            Groups::LitCrowd => [Some(scene), crowd.as_ref(), Some(shadow), Some(found)],
            Groups::Soft => [Some(scene), None, Some(soft), Some(found)],
            Groups::Seen => [Some(scene), None, Some(seen), None],
            Groups::Rough => [Some(scene), None, Some(found), None],
        };
        let used = all.iter().rposition(Option::is_some).map_or(0, |last| last + 1);
        device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &all[..used],
            immediate_size: 0,
        })
    }

    fn make(&self, device: &wgpu::Device, recipe: &Recipe) -> wgpu::RenderPipeline {
        let module = self.module(device, recipe.source);
        let targets = [recipe.format.map(|format| wgpu::ColorTargetState {
            format,
            blend: recipe.blend,
            write_mask: wgpu::ColorWrites::ALL,
        })];
        let options = || wgpu::PipelineCompilationOptions {
            constants: &recipe.constants,
            ..wgpu::PipelineCompilationOptions::default()
        };
        let fragment = recipe.fragment.map(|entry| wgpu::FragmentState {
            module,
            entry_point: Some(entry),
            compilation_options: options(),
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
            layout: Some(&self.layout(device, recipe.groups)),
            vertex: wgpu::VertexState {
                module,
                entry_point: Some(recipe.vertex),
                compilation_options: options(),
                buffers: recipe.buffers,
            },
            primitive: wgpu::PrimitiveState {
                topology,
                cull_mode: recipe.cull,
                ..wgpu::PrimitiveState::default()
            },
            depth_stencil,
            multisample: wgpu::MultisampleState {
                count: recipe.samples,
                ..wgpu::MultisampleState::default()
            },
            fragment,
            multiview_mask: None,
            cache: None,
        })
    }
}

fn module(device: &wgpu::Device, label: &str, source: &'static str) -> wgpu::ShaderModule {
    device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(label),
        source: wgpu::ShaderSource::Wgsl(source.into()),
    })
}
