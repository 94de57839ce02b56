//! How each kind of draw uses the device: shader, buffers, depth and blending, as plain data.

use wgpu::CompareFunction::{self, Always, Greater, Less, LessEqual};

use crate::overlay::Stroke;
use crate::parts::PART_LAYOUT;
use crate::scene::Msaa;
use crate::shadow::SOFT_FORMAT;
use crate::skins::VERTEX_LAYOUTS;
use crate::surfaces::{Corner, Shell};
use crate::target::PICTURE_FORMAT;

/// What a pipeline draws.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Draw {
    /// Depth of the figures from the key light.
    Shadow { two_sided: bool },
    /// The figures' shadow on the ground, into a small map of its own.
    Soften,
    /// Depth of a translucent figure, so that its far side stays hidden.
    Ghost { two_sided: bool },
    /// A figure.
    Figure { paint: Paint, two_sided: bool },
    /// Depth of a crowd from the key light.
    CrowdShadow,
    /// A crowd.
    Crowd { paint: Paint },
    /// The gradient behind everything.
    Backdrop,
    /// The picture for reference.
    Image,
    /// The grid on the ground.
    Grid,
    /// The figures' shadow on the ground, with or without what a survey found there.
    Shade { occluded: bool },
    /// The ground around the figures in a survey.
    Contact,
    /// Openness and key light of what a survey shows.
    Openness,
    /// The same, smooth.
    Smooth,
    /// Lines of what a survey shows.
    Trace,
    /// The outer half of a drawing's outlines.
    Ink,
    /// Lines and points: seen, hidden or both.
    Strokes(Seen),
    /// Translucent balls.
    Balls(Seen),
    /// Translucent sheets.
    Fans(Seen),
}

/// How figure.wgsl colours a figure. Each flag left out saves time at every pixel.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) struct Paint {
    pub fragment: &'static str,
    /// The skin is cut into parts.
    pub parts: bool,
    /// The key light's shadow falls on it.
    pub shadowed: bool,
    /// Some of its bones are selected or hovered.
    pub marked: bool,
    /// A survey tells how open and lit it is, or where its lines are.
    pub occluded: bool,
    /// The lines of the grid lie on it.
    pub lined: bool,
}

impl Paint {
    /// View-space normals.
    pub const NORMAL: Paint = Paint::plain("fs_normal");

    /// That fragment shader and nothing else.
    pub const fn plain(fragment: &'static str) -> Paint {
        Paint { fragment, parts: false, shadowed: false, marked: false, occluded: false, lined: false }
    }

    /// Values for figure.wgsl's overrides.
    fn constants(self) -> Vec<(&'static str, f64)> {
        let flags = [
            ("shadowed", self.shadowed),
            ("marked", self.marked),
            ("occluded", self.occluded),
            ("colored", self.parts),
            ("lined", self.lined),
        ];
        flags.map(|(name, on)| (name, f64::from(u8::from(on)))).to_vec()
    }
}

/// Which marks a draw lets through.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug)]
pub(crate) enum Seen {
    /// Those before everything.
    Before,
    /// Those behind something, faintly.
    Behind,
    /// All.
    Always,
}

/// A shader file.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Source {
    Figure,
    Crowd,
    Shadow,
    Soften,
    Backdrop,
    Image,
    Ground,
    Overlay,
    Surfaces,
    Occlusion,
    Smooth,
    Trace,
}

/// Which bind groups a draw reads; each has the scene's.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Groups {
    Scene,
    Figure,
    /// Figure and shadow map.
    Lit,
    /// A crowd's matrices.
    Crowd,
    /// A crowd's matrices and shadow map.
    LitCrowd,
    /// A filtered texture: the soft shadow, or the picture for reference; and what a survey found.
    Soft,
    /// What a survey sees.
    Seen,
    /// What a survey found, before it is smooth.
    Rough,
}

/// What a draw does with depth.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct DepthRule {
    pub write: bool,
    pub compare: CompareFunction,
    pub slope_bias: f32,
}

/// How a kind of draw differs from the others.
#[derive(Clone, Debug)]
pub(crate) struct Recipe {
    pub source: Source,
    pub vertex: &'static str,
    pub fragment: Option<&'static str>,
    pub buffers: &'static [Option<wgpu::VertexBufferLayout<'static>>],
    pub groups: Groups,
    /// `None` draws depth alone.
    pub format: Option<wgpu::TextureFormat>,
    pub samples: u32,
    pub strip: bool,
    pub cull: Option<wgpu::Face>,
    pub depth: Option<DepthRule>,
    pub blend: Option<wgpu::BlendState>,
    /// Values for the shader's overrides.
    pub constants: Vec<(&'static str, f64)>,
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

const SKIN: [Option<wgpu::VertexBufferLayout<'static>>; 1] = {
    let [skin, _] = VERTEX_LAYOUTS;
    [Some(skin)]
};
const SKIN_AND_SURFACE: [Option<wgpu::VertexBufferLayout<'static>>; 2] = {
    let [skin, surface] = VERTEX_LAYOUTS;
    [Some(skin), Some(surface)]
};
const SKIN_SURFACE_AND_PART: [Option<wgpu::VertexBufferLayout<'static>>; 3] = {
    let [skin, surface] = VERTEX_LAYOUTS;
    [Some(skin), Some(surface), Some(PART_LAYOUT)]
};
const STROKES: [Option<wgpu::VertexBufferLayout<'static>>; 1] = [Some(wgpu::VertexBufferLayout {
    array_stride: size_of::<Stroke>() as u64,
    step_mode: wgpu::VertexStepMode::Instance,
    attributes: &wgpu::vertex_attr_array![
        0 => Float32x3, 1 => Float32x3, 2 => Unorm8x4, 3 => Unorm8x4, 4 => Float32x4
    ],
})];

const BALLS: [Option<wgpu::VertexBufferLayout<'static>>; 1] = [Some(wgpu::VertexBufferLayout {
    array_stride: size_of::<Shell>() as u64,
    step_mode: wgpu::VertexStepMode::Instance,
    attributes: &wgpu::vertex_attr_array![0 => Float32x4, 1 => Unorm8x4],
})];
const FANS: [Option<wgpu::VertexBufferLayout<'static>>; 1] = [Some(wgpu::VertexBufferLayout {
    array_stride: size_of::<Corner>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Unorm8x4],
})];

impl Recipe {
    /// How to draw that into pictures of so many samples.
    pub fn of(draw: Draw, msaa: Msaa) -> Recipe {
        use Source::{Backdrop, Ground, Soften};
        match draw {
            Draw::Shadow { two_sided } => Recipe {
                source: Source::Shadow,
                vertex: "vs_shadow",
                fragment: None,
                buffers: &SKIN,
                groups: Groups::Figure,
                format: None,
                depth: Some(DepthRule { write: true, compare: Less, slope_bias: 2.0 }),
                constants: Vec::new(),
                ..Recipe::skinned(Paint::plain(""), two_sided, Less, Msaa::One)
            },
            Draw::Soften => Recipe {
                groups: Groups::Lit,
                format: Some(SOFT_FORMAT),
                blend: None,
                ..Recipe::surroundings(Soften, "vs_soften", "fs_soften")
            },
            Draw::Ghost { two_sided } => Recipe::skinned(Paint::plain("fs_nothing"), two_sided, Less, msaa),
            Draw::Figure { paint, two_sided } => Recipe::skinned(paint, two_sided, LessEqual, msaa),
            Draw::CrowdShadow => Recipe {
                vertex: "vs_crowd_shadow",
                groups: Groups::Crowd,
                source: Source::Crowd,
                ..Recipe::of(Draw::Shadow { two_sided: false }, msaa)
            },
            Draw::Crowd { paint } => Recipe {
                vertex: if paint.parts { "vs_crowd_part" } else { "vs_crowd" },
                groups: Groups::LitCrowd,
                source: Source::Crowd,
                ..Recipe::skinned(paint, false, LessEqual, msaa)
            },
            Draw::Backdrop => {
                Recipe { strip: false, ..Recipe::surroundings(Backdrop, "vs_backdrop", "fs_backdrop") }
            }
            Draw::Image => {
                Recipe { groups: Groups::Soft, ..Recipe::surroundings(Source::Image, "vs_image", "fs_image") }
            }
            Draw::Grid => Recipe::surroundings(Ground, "vs_grid", "fs_grid"),
            Draw::Shade { occluded } => Recipe {
                groups: Groups::Soft,
                constants: vec![("occluded", f64::from(u8::from(occluded)))],
                ..Recipe::surroundings(Ground, "vs_shade", "fs_shade")
            },
            Draw::Ink => Recipe { groups: Groups::Soft, ..Recipe::surroundings(Ground, "vs_ink", "fs_ink") },
            Draw::Contact => Recipe {
                depth: Some(DepthRule { write: true, compare: Less, slope_bias: 0.0 }),
                blend: None,
                ..Recipe::surroundings(Ground, "vs_contact", "fs_contact")
            },
            Draw::Openness => Recipe::seen(Source::Occlusion, "fs_occlusion", Groups::Seen),
            Draw::Smooth => Recipe::seen(Source::Smooth, "fs_smooth", Groups::Rough),
            Draw::Trace => Recipe::seen(Source::Trace, "fs_trace", Groups::Seen),
            Draw::Strokes(seen) => Recipe::marks(seen, msaa, ["vs_stroke", "fs_stroke", "fs_hidden"]),
            Draw::Balls(seen) => Recipe {
                source: Source::Surfaces,
                buffers: &BALLS,
                strip: false,
                ..Recipe::marks(seen, msaa, ["vs_ball", "fs_ball", "fs_ball_hidden"])
            },
            Draw::Fans(seen) => Recipe {
                source: Source::Surfaces,
                buffers: &FANS,
                strip: false,
                ..Recipe::marks(seen, msaa, ["vs_fan", "fs_fan", "fs_fan_hidden"])
            },
        }
    }

    fn skinned(paint: Paint, two_sided: bool, compare: CompareFunction, msaa: Msaa) -> Recipe {
        Recipe {
            source: Source::Figure,
            vertex: if paint.parts { "vs_part" } else { "vs_figure" },
            fragment: Some(paint.fragment),
            buffers: if paint.parts { &SKIN_SURFACE_AND_PART } else { &SKIN_AND_SURFACE },
            constants: paint.constants(),
            groups: Groups::Lit,
            format: Some(PICTURE_FORMAT),
            samples: msaa.samples(),
            strip: false,
            cull: (!two_sided).then_some(wgpu::Face::Back),
            depth: Some(DepthRule { write: true, compare, slope_bias: 0.0 }),
            blend: Some(OVER),
        }
    }

    fn surroundings(source: Source, vertex: &'static str, fragment: &'static str) -> Recipe {
        Recipe {
            source,
            vertex,
            fragment: Some(fragment),
            buffers: &[],
            groups: Groups::Scene,
            format: Some(PICTURE_FORMAT),
            samples: 1,
            strip: true,
            cull: None,
            depth: None,
            blend: Some(UNDER),
            constants: Vec::new(),
        }
    }

    /// Over a survey, where its depth shows something.
    fn seen(source: Source, fragment: &'static str, groups: Groups) -> Recipe {
        Recipe {
            groups,
            depth: Some(DepthRule { write: false, compare: Greater, slope_bias: 0.0 }),
            blend: None,
            ..Recipe::surroundings(source, "vs_everywhere", fragment)
        }
    }

    /// Vertex shader, fragment shader, and that for what lies behind something.
    fn marks(seen: Seen, msaa: Msaa, [vertex, shown, hidden]: [&'static str; 3]) -> Recipe {
        let (fragment, compare) = match seen {
            Seen::Before => (shown, LessEqual),
            Seen::Behind => (hidden, Greater),
            Seen::Always => (shown, Always),
        };
        Recipe {
            buffers: &STROKES,
            samples: msaa.samples(),
            depth: Some(DepthRule { write: false, compare, slope_bias: 0.0 }),
            blend: Some(OVER),
            ..Recipe::surroundings(Source::Overlay, vertex, fragment)
        }
    }
}
