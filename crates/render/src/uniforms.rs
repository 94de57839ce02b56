//! What the shaders read each picture, byte for byte.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use rig::{Bone, PLACES, Palette, Projection, bone_of_place};

use crate::light::Light;
use crate::overlay::Color;
use crate::scene::{FigureView, Scene};
use crate::tile::Tile;

/// Twin of `Scene` in scene.wgsl.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct SceneUniform {
    pub clip_from_world: [[f32; 4]; 4],
    pub view_from_world: [[f32; 4]; 4],
    pub shadow_from_world: [[f32; 4]; 4],
    pub eye: [f32; 4],
    pub key: [f32; 4],
    pub fill: [f32; 4],
    pub viewport: [f32; 4],
    pub tile: [f32; 4],
    pub background_top: [f32; 4],
    pub background_bottom: [f32; 4],
    pub ranges: [f32; 4],
    pub ground: [f32; 4],
    pub footprint: [f32; 4],
    pub light: [f32; 4],
    pub selected_tint: [f32; 4],
    pub hovered_tint: [f32; 4],
}

/// Twin of `Figure` in skin.wgsl, padded to the alignment of dynamic offsets.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct FigureUniform {
    pub palette: Palette,
    pub world_from_figure: [[f32; 4]; 4],
    pub selected: [u32; 2],
    pub hovered: [u32; 2],
    pub look: [f32; 4],
    pub padding: [f32; 40],
}

const _: () = assert!(size_of::<FigureUniform>().is_multiple_of(256));

impl FigureUniform {
    pub fn of(view: &FigureView<'_>) -> FigureUniform {
        FigureUniform {
            palette: *view.palette,
            world_from_figure: view.world_from_figure.to_cols_array_2d(),
            selected: mask(view.selected),
            hovered: mask(view.hovered),
            look: [view.opacity.clamp(0.0, 1.0), 0.0, 0.0, 0.0],
            padding: [0.0; 40],
        }
    }
}

/// Bits of the places that belong to some bones: their own and their segments' twist places.
fn mask(bones: &[Bone]) -> [u32; 2] {
    let marked = |place: &usize| bones.contains(&bone_of_place(*place));
    let bits = (0..PLACES).filter(marked).fold(0_u64, |bits, place| bits | 1 << place);
    [bits as u32, (bits >> 32) as u32]
}

impl SceneUniform {
    /// `tile` is what is drawn of the picture; `depth_range` the figures' nearest and farthest view depth.
    pub fn of(scene: &Scene<'_>, tile: Tile, light: &Light, depth_range: [f32; 2]) -> SceneUniform {
        let camera = &scene.camera;
        let look = &scene.look;
        let [width, height] = tile.size.map(|s| s as f32);
        let [left, top] = tile.origin.map(|s| s as f32);
        let [whole_width, whole_height] = tile.whole.map(|s| s as f32);
        let axes = camera.axes();
        let eye = match camera.projection {
            Projection::Perspective => camera.eye().extend(1.0),
            Projection::Orthographic => axes.z_axis.extend(0.0),
        };
        let fill = (axes.z_axis + axes.y_axis * 0.35 - axes.x_axis * 0.45).normalize_or(Vec3::Z);
        let reach = (camera.distance * 2.0).clamp(2.0, 100.0);
        let spacing = if camera.height_at_target() > 12.0 { 1.0 } else { 0.1 };
        SceneUniform {
            clip_from_world: (tile.from_whole() * camera.clip_from_world(tile.aspect())).to_cols_array_2d(),
            view_from_world: camera.view_from_world().to_cols_array_2d(),
            shadow_from_world: light.shadow_from_world.to_cols_array_2d(),
            eye: eye.to_array(),
            key: light.toward.extend(f32::from(u8::from(light.casts))).to_array(),
            fill: fill.extend(fill_strength(axes.z_axis, light.toward)).to_array(),
            viewport: [width, height, 1.0 / width, 1.0 / height],
            tile: [left, top, whole_width, whole_height],
            background_top: unit(look.background_top),
            background_bottom: unit(look.background_bottom),
            ranges: [depth_range[0], depth_range[1], light.texel_m, 1.0 / light.size as f32],
            ground: [camera.target.x, reach, camera.target.z, spacing],
            footprint: light.footprint,
            light: [light.deep_m, look.backdrop_opacity.clamp(0.0, 1.0), 0.0, 0.0],
            selected_tint: linear(look.selected),
            hovered_tint: linear(look.hovered),
        }
    }

    /// The same, for strokes given in the clip space of the whole picture.
    pub fn flat(mut self, tile: Tile) -> SceneUniform {
        self.clip_from_world = tile.from_whole().to_cols_array_2d();
        self
    }
}

/// The fill light takes over as the camera comes round to the side that the key light leaves dark.
fn fill_strength(toward_viewer: Vec3, toward_key: Vec3) -> f32 {
    let behind = ((0.35 - toward_viewer.dot(toward_key)) / 1.1).clamp(0.0, 1.0);
    1.0 + 3.4 * behind * behind
}

fn unit(color: Color) -> [f32; 4] {
    color.map(|c| f32::from(c) / 255.0)
}

/// Linear light; alpha as it is.
fn linear(color: Color) -> [f32; 4] {
    let [r, g, b, a] = unit(color);
    [linear_from_srgb(r), linear_from_srgb(g), linear_from_srgb(b), a]
}

fn linear_from_srgb(c: f32) -> f32 {
    if c <= 0.04045 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
}
