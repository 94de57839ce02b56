//! What is to be drawn, as plain data.

use glam::{Mat4, Vec3};
use rig::{Bone, Camera, Palette};

use crate::Overlay;
use crate::crowd::CrowdView;
use crate::keypoints::Keypoints;
use crate::overlay::Color;

/// One picture: figures, camera, look and marks.
#[derive(Clone, Debug)]
pub struct Scene<'a> {
    /// The figures, any number.
    pub figures: &'a [FigureView<'a>],
    /// Crowds, each drawn at once.
    pub crowds: &'a [CrowdView<'a>],
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
    /// The keypoints of each person; only for [`Pass::OpenPose`].
    pub keypoints: &'a [Keypoints],
}

static NO_MARKS: Overlay = Overlay::EMPTY;

impl<'a> Scene<'a> {
    /// A colour picture of figures, without marks.
    pub fn new(figures: &'a [FigureView<'a>], camera: Camera, size: [u32; 2]) -> Scene<'a> {
        Scene {
            figures,
            crowds: &[],
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
    /// Whether it is ground under the figures: it takes the place of the ground y = 0 with its grid and its shadow, is lit in
    /// its own colours in every style, carries the lines of the grid, fades out far from the camera's target, catches
    /// shadows and casts none. It is in no silhouette and is no part of a body.
    pub ground: bool,
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
            ground: false,
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
    /// Which bone moves the skin at each pixel, as the colour [`crate::part_color`] of that bone, on black. Nothing is
    /// mixed at edges: every pixel is black or some bone's colour. Where bones share the skin, the strongest has it.
    Parts,
    /// Keypoints and limbs of body, hands and feet in OpenPose colours on black.
    OpenPose,
}

impl Pass {
    /// Every pass.
    pub const ALL: [Pass; 6] =
        [Pass::Color, Pass::Depth, Pass::Normal, Pass::Silhouette, Pass::Parts, Pass::OpenPose];
}

/// How figures are drawn in the colour picture.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum Style {
    /// The skin's own colours under studio lights: key, fill and rim.
    #[default]
    Studio,
    /// Sculptor's clay of one colour, whatever the skin's.
    Clay,
    /// Wax in a light that goes with the camera, so that form reads alike from everywhere; the key light plays no part.
    Matcap,
    /// Flat tones, one colour for each part of the body, light and dark with a sharp border.
    Flat,
    /// A drawing with a pen on white paper: outlines, contours and creases.
    Line,
}

impl Style {
    /// Every style.
    pub const ALL: [Style; 5] = [Style::Studio, Style::Clay, Style::Matcap, Style::Flat, Style::Line];
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
    /// What the figures are made of and drawn with.
    pub style: Style,
    /// Colours the parts of the body in wood tones with grooves at the joints, as on a jointed lay figure. Not in
    /// [`Style::Line`], and [`Style::Flat`] has a colour for each part anyway.
    pub joint_planes: bool,
    /// Shadows of the key light on the figures.
    pub shadow: bool,
    /// The ground y = 0 catches the shadow. In a transparent picture it is otherwise clear: black whose alpha is the
    /// shadow's strength, to be laid over any other picture. Needs [`Look::shadow`] and a camera above the ground.
    pub ground_shadow: bool,
    /// Darkens creases and where parts meet or stand on the ground, and softens shadows on the figures with the
    /// distance to what casts them. Costs two passes over the figures.
    pub ambient_occlusion: bool,
    /// Samples a pixel. Depth, normals and parts always take one.
    pub msaa: Msaa,
    /// Pixels drawn along each edge of a pixel of the picture that [`crate::Renderer::image`] and
    /// [`crate::Renderer::bands`] make, 1 to 4; they are averaged. For stills: the cost grows with the square. Depth,
    /// normals and parts ignore it, and so does [`crate::Renderer::draw`].
    pub supersampling: u32,
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
            style: Style::Studio,
            joint_planes: false,
            shadow: true,
            ground_shadow: true,
            ambient_occlusion: true,
            msaa: Msaa::Four,
            supersampling: 1,
            scale: 1.0,
            key_light: Vec3::new(-0.72, 1.0, 0.66),
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

    /// The same in bright or in dark surroundings: what [`Look::light`] and [`Look::default`] differ in.
    #[must_use]
    pub fn in_surroundings(self, bright: bool) -> Look {
        let Look { background_top, background_bottom, selected, hovered, .. } =
            if bright { Look::light() } else { Look::default() };
        Look { background_top, background_bottom, selected, hovered, ..self }
    }

    /// What a software adapter can draw fluently while something moves: one sample, no shadow, no ambient occlusion,
    /// the rest as it is.
    #[must_use]
    pub fn lean(self) -> Look {
        Look { msaa: Msaa::One, shadow: false, ambient_occlusion: false, ..self }
    }
}
