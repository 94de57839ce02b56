//! What the shaders read each picture, byte for byte.

use bytemuck::{Pod, Zeroable};
use glam::{Mat4, Vec2, Vec3};
use rig::{Bone, Camera, PLACES, Palette, Projection, bone_of_place};

use crate::light::Light;
use crate::overlay::Color;
use crate::scene::{FigureView, Scene, Style};
use crate::tile::Tile;

/// What a drawing is on; as in survey.wgsl.
const PAPER: Color = [252, 251, 249, 255];

/// Twin of `Scene` in scene.wgsl.
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct SceneUniform {
    pub clip_from_world: [[f32; 4]; 4],
    pub view_from_world: [[f32; 4]; 4],
    pub shadow_from_world: [[f32; 4]; 4],
    pub shadow_from_view: [[f32; 4]; 4],
    pub world_from_view: [[f32; 4]; 4],
    pub lens: [f32; 4],
    pub unproject: [f32; 4],
    pub eye: [f32; 4],
    pub key: [f32; 4],
    pub fill: [f32; 4],
    pub rim_left: [f32; 4],
    pub rim_right: [f32; 4],
    pub viewport: [f32; 4],
    pub tile: [f32; 4],
    pub background_top: [f32; 4],
    pub background_bottom: [f32; 4],
    pub ranges: [f32; 4],
    pub surveyed: [f32; 4],
    pub ground: [f32; 4],
    pub silhouette: [f32; 4],
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
        let fill = (axes.z_axis + axes.y_axis * 0.45 + axes.x_axis * 0.70).normalize_or(Vec3::Z);
        let reach = (camera.distance * 2.0).clamp(2.0, 100.0);
        let spacing = if camera.height_at_target() > 12.0 { 1.0 } else { 0.1 };
        let paper = look.style == Style::Line;
        let world_from_view = camera.view_from_world().inverse();
        let (lens, unproject) = lens(camera, tile.aspect(), f32::from(u8::from(!paper)));
        let background = if paper { [PAPER; 2] } else { [look.background_top, look.background_bottom] };
        SceneUniform {
            clip_from_world: (tile.tile_from_whole() * camera.clip_from_world(tile.aspect()))
                .to_cols_array_2d(),
            view_from_world: camera.view_from_world().to_cols_array_2d(),
            shadow_from_world: light.shadow_from_world.to_cols_array_2d(),
            shadow_from_view: (light.shadow_from_world * world_from_view).to_cols_array_2d(),
            world_from_view: world_from_view.to_cols_array_2d(),
            lens,
            unproject,
            eye: eye.to_array(),
            key: light.toward.extend(f32::from(u8::from(light.casts))).to_array(),
            fill: fill.extend(fill_strength(axes.z_axis, light.toward)).to_array(),
            rim_left: (axes * Vec3::new(-0.80, 0.38, -0.46)).normalize_or(Vec3::X).extend(0.0).to_array(),
            rim_right: (axes * Vec3::new(0.86, 0.10, -0.50)).normalize_or(Vec3::X).extend(0.0).to_array(),
            viewport: [width, height, 1.0 / width, 1.0 / height],
            tile: [left, top, whole_width, whole_height],
            background_top: unit(background[0]),
            background_bottom: unit(background[1]),
            ranges: [depth_range[0], depth_range[1], light.texel_m, 1.0 / light.size as f32],
            surveyed: surveyed(camera, light, depth_range),
            ground: [camera.target.x, reach, camera.target.z, spacing],
            silhouette: [-1.0, -1.0, 1.0, 1.0],
            footprint: light.footprint,
            light: [light.deep_m, look.backdrop_opacity.clamp(0.0, 1.0), 0.0, 0.0],
            selected_tint: linear(look.selected),
            hovered_tint: linear(look.hovered),
        }
    }

    /// The same with a rectangle around the figures, given by points around them.
    pub fn with_silhouette(mut self, corners: impl Iterator<Item = Vec3>) -> SceneUniform {
        let clip_from_world = Mat4::from_cols_array_2d(&self.clip_from_world);
        let mut rectangle = [f32::MAX, f32::MAX, f32::MIN, f32::MIN];
        for corner in corners {
            let clip = clip_from_world * corner.extend(1.0);
            if clip.w <= 1e-3 {
                return self;
            }
            let at = Vec2::new(clip.x, clip.y) / clip.w;
            rectangle = [
                rectangle[0].min(at.x),
                rectangle[1].min(at.y),
                rectangle[2].max(at.x),
                rectangle[3].max(at.y),
            ];
        }
        // Lines reach a little beyond the figures.
        let [x, y] = [self.tile[2] * 0.01 * self.viewport[2], self.tile[3] * 0.01 * self.viewport[3]];
        let [left, low, right, high] = rectangle;
        if left <= right {
            self.silhouette = [left - x, low - y, right + x, high + y];
        }
        self
    }

    /// The same with the figures standing at that height.
    pub fn on_floor(mut self, height_m: f32) -> SceneUniform {
        self.light[2] = height_m;
        self
    }

    /// The same but for what doesn't show in a survey.
    pub fn without_tints(mut self) -> SceneUniform {
        self.selected_tint = [0.0; 4];
        self.hovered_tint = [0.0; 4];
        self
    }

    /// The same, for strokes given in the clip space of the whole picture.
    pub fn flat(mut self, tile: Tile) -> SceneUniform {
        self.clip_from_world = tile.tile_from_whole().to_cols_array_2d();
        self
    }
}

/// `Scene::lens` and `Scene::unproject`; `depth` is the background's light and shade.
fn lens(camera: &Camera, aspect: f32, depth: f32) -> ([f32; 4], [f32; 4]) {
    let m = camera.clip_from_view(aspect);
    let (a, b) = (m.z_axis.z, m.w_axis.z);
    // Half the size of the view where clip space's w is 1.
    let half = [1.0 / m.x_axis.x, 1.0 / m.y_axis.y];
    match camera.projection {
        Projection::Perspective => ([half[0], half[1], 1.0, depth], [0.0, -b, 1.0, a]),
        Projection::Orthographic => ([half[0], half[1], 0.0, depth], [1.0, -b, 0.0, a]),
    }
}

/// The depths between which a survey finds anything: figures and the ground around them.
fn surveyed(camera: &Camera, light: &Light, [near, far]: [f32; 2]) -> [f32; 4] {
    let view = camera.view_from_world();
    let [x0, z0, x1, z1] = light.footprint;
    let beyond = 0.4;
    let corners = [
        [x0 - beyond, z0 - beyond],
        [x1 + beyond, z0 - beyond],
        [x0 - beyond, z1 + beyond],
        [x1 + beyond, z1 + beyond],
    ];
    let depths = corners.map(|[x, z]| -view.transform_point3(Vec3::new(x, 0.0, z)).z);
    let (near, far) = depths.into_iter().fold((near, far), |(near, far), d| (near.min(d), far.max(d)));
    [near.max(0.0), far.max(1e-3), 0.0, 0.0]
}

/// The fill light takes over as the camera comes round to the side that the key light leaves dark.
fn fill_strength(toward_viewer: Vec3, toward_key: Vec3) -> f32 {
    let behind = ((0.35 - toward_viewer.dot(toward_key)) / 1.1).clamp(0.0, 1.0);
    1.0 + 8.0 * behind * behind
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_marked_bone_marks_the_twist_place_of_its_segment() {
        let places = |bones: &[Bone]| {
            let [low, high] = mask(bones);
            (u64::from(high) << 32 | u64::from(low)).count_ones()
        };
        assert_eq!(places(&[Bone::Head]), 1);
        assert_eq!(places(&[Bone::LeftLowerArm, Bone::RightLowerLeg]), 4);
        assert_eq!(places(&Bone::ALL), PLACES as u32);
    }
}
