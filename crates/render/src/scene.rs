//! What is to be drawn, as plain data.

use glam::{DVec3, Mat4, Vec3};
use rig::{Bone, Camera, Palette};

use crate::Overlay;
use crate::overlay::Color;

/// One picture: figures, camera, look and marks.
#[derive(Clone, Debug)]
pub struct Scene<'a> {
    /// The figures, any number.
    pub figures: &'a [FigureView<'a>],
    /// Where it is seen from.
    pub camera: Camera,
    /// Width and height, pixels.
    pub size: [u32; 2],
    /// How it looks.
    pub look: Look,
    /// Which picture of the scene.
    pub pass: Pass,
    /// Marks over it; only in [`Pass::Color`].
    pub overlay: &'a Overlay,
    /// COCO keypoints by number (0 nose … 17 left ear), world space, metres; only for [`Pass::OpenPose`].
    pub keypoints: &'a [(usize, DVec3)],
}

static NO_MARKS: Overlay = Overlay::EMPTY;

impl<'a> Scene<'a> {
    /// A colour picture of figures, without marks.
    pub fn new(figures: &'a [FigureView<'a>], camera: Camera, size: [u32; 2]) -> Scene<'a> {
        Scene {
            figures,
            camera,
            size,
            look: Look::default(),
            pass: Pass::Color,
            overlay: &NO_MARKS,
            keypoints: &[],
        }
    }
}

/// One posed figure.
#[derive(Clone, Copy, Debug)]
pub struct FigureView<'a> {
    /// The slot given to [`crate::Renderer::set_mesh`].
    pub skin: usize,
    /// Its posed bones.
    pub palette: &'a Palette,
    /// Where it stands, a rigid transform; the identity if the palette was made from frames in the world.
    pub world_from_figure: Mat4,
    /// Bones drawn in [`Look::selected`].
    pub selected: &'a [Bone],
    /// Bones drawn in [`Look::hovered`].
    pub hovered: &'a [Bone],
    /// 1 is solid; below, the figure is a translucent ghost that casts no shadow.
    pub opacity: f32,
    /// Draws the inside of open skins as well; costs up to twice the time.
    pub two_sided: bool,
}

impl<'a> FigureView<'a> {
    /// Skin 0 of that pose at the world's origin, solid, nothing marked.
    pub fn new(palette: &'a Palette) -> FigureView<'a> {
        FigureView {
            skin: 0,
            palette,
            world_from_figure: Mat4::IDENTITY,
            selected: &[],
            hovered: &[],
            opacity: 1.0,
            two_sided: false,
        }
    }
}

/// Which picture of the scene.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Pass {
    /// The lit picture, sRGB.
    #[default]
    Color,
    /// Linear depth along the view across the figures' range: near white, far black, background black.
    Depth,
    /// View-space normals as `n * 0.5 + 0.5`, x right, y up, z to the viewer; background (128, 128, 255).
    Normal,
    /// The figures white on black.
    Silhouette,
    /// COCO-18 keypoints and limbs in OpenPose colours on black.
    OpenPose,
}

/// Samples a pixel.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Msaa {
    /// Jagged and cheap.
    One,
    /// Smooth edges.
    #[default]
    Four,
}

impl Msaa {
    /// As a number.
    pub const fn samples(self) -> u32 {
        match self {
            Msaa::One => 1,
            Msaa::Four => 4,
        }
    }
}

/// How the colour picture looks. `Msaa` and `scale` also serve the other passes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Look {
    /// Colour at the top of the background.
    pub background_top: Color,
    /// Colour at its bottom.
    pub background_bottom: Color,
    /// Leaves the background out: alpha 0 where nothing is drawn. The grid is then left out as well.
    pub transparent: bool,
    /// How much of the picture given to [`crate::Renderer::set_backdrop`] shows, 0 to 1.
    pub backdrop_opacity: f32,
    /// The grid and the axes on the ground y = 0.
    pub grid: bool,
    /// Shadows of the key light, on the figures and on the ground.
    pub shadow: bool,
    /// Samples a pixel. Depth and normals always take one.
    pub msaa: Msaa,
    /// Resolution of the drawn texture over [`Scene::size`], within 0.1 to 1; [`crate::Blit`] stretches it.
    /// [`crate::Renderer::image`] ignores it.
    pub scale: f32,
    /// From the figure toward the key light, world space, any length; at least 20° above the ground.
    pub key_light: Vec3,
    /// Tint of selected bones; alpha is its strength.
    pub selected: Color,
    /// Tint of the bones under the pointer; alpha is its strength.
    pub hovered: Color,
}

impl Default for Look {
    fn default() -> Look {
        Look {
            background_top: [104, 109, 116, 255],
            background_bottom: [54, 57, 62, 255],
            transparent: false,
            backdrop_opacity: 0.0,
            grid: true,
            shadow: true,
            msaa: Msaa::Four,
            scale: 1.0,
            key_light: Vec3::new(-0.5, 1.05, 0.8),
            selected: [255, 128, 30, 190],
            hovered: [255, 184, 96, 110],
        }
    }
}

impl Look {
    /// Bright surroundings; [`Look::default`] is the dark ones. Grid and marks are legible on both.
    #[must_use]
    pub fn light() -> Look {
        Look {
            background_top: [226, 229, 233, 255],
            background_bottom: [186, 190, 196, 255],
            selected: [255, 112, 16, 205],
            hovered: [255, 164, 70, 140],
            ..Look::default()
        }
    }

    /// What a software adapter can draw fluently while something moves: one sample, no shadow, the rest as it is.
    #[must_use]
    pub fn lean(self) -> Look {
        Look { msaa: Msaa::One, shadow: false, ..self }
    }
}
