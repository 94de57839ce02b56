//! A pose drawn small: the figure alone, seen from its front and left, on a clear background.

use std::sync::Arc;

use glam::Vec3;
use render::{FigureView, Gpu, Image, Layer, Line, Look, Overlay, Renderer, Scene};
use rig::{Bone, Bounds, Camera, Evaluation, Figure, Palette, Part, PosePatch, View};

use crate::failure::Failure;
use crate::load;
use crate::picture::{bounds, rest_positions};

/// Width and height of a portrait, pixels: two for each point of its place in the panel.
pub const SIZE: [u32; 2] = [240, 300];
/// How far skin reaches from its joints, metres.
const FLESH_M: f32 = 0.09;

/// Over so many pixels from either side a portrait becomes clear.
const FADE_PX: f32 = 24.0;

/// Opens a device of its own, so that a portrait never waits for the window or the window for it.
pub type Opener = fn() -> Result<Gpu, Failure>;

/// What draws portraits.
pub struct Studio {
    renderer: Renderer,
    figure: Option<Arc<Figure>>,
}

impl Studio {
    /// Makes ready.
    ///
    /// # Errors
    /// No adapter: the sentence that names the cure.
    pub fn open(opener: Opener) -> Result<Studio, String> {
        let gpu = opener().map_err(|e| e.to_string())?;
        Ok(Studio { renderer: Renderer::new(&gpu), figure: None })
    }

    /// Draws a figure in the pose that a file makes of it standing.
    ///
    /// # Errors
    /// The figure's skin is at fault; the driver complains.
    pub fn draw(&mut self, figure: &Arc<Figure>, patch: &PosePatch) -> Result<Image, String> {
        if !self.figure.as_ref().is_some_and(|former| Arc::ptr_eq(former, figure)) {
            let mesh = figure.skin.clone().unwrap_or_default();
            self.renderer.set_mesh(0, &mesh).map_err(|e| e.to_string())?;
            self.figure = Some(figure.clone());
        }
        // Files that name a hand or an arm alone are shown on a body that stands, nearer.
        let pose = patch.onto(&load::standing(figure));
        let evaluation = rig::evaluate(figure, &pose, true);
        let palette = Palette::new(&evaluation.frames, &rest_positions(figure));
        let figures = [FigureView::new(&palette)];
        let drawn = if figure.skin.is_some() { &figures[..] } else { &[] };
        let aspect = SIZE[0] as f32 / SIZE[1] as f32;
        let near = named_alone(patch, &evaluation);
        let seen = near.unwrap_or_else(|| bounds(figure, &evaluation));
        let camera = Camera::view(View::ThreeQuarter, seen, aspect);
        let marks = if figure.skin.is_none() { bones(figure, &evaluation) } else { Overlay::default() };
        let look = Look { transparent: true, ..Look::default() };
        let scene = Scene { look, overlay: &marks, ..Scene::new(drawn, camera, SIZE) };
        let mut image = self.renderer.image(&scene).map_err(|e| e.to_string())?;
        if near.is_none() {
            fade(&mut image);
        }
        Ok(image)
    }
}

/// Lets a shadow that leaves the picture at a side run out instead of being cut off.
fn fade(image: &mut Image) {
    let width = image.width as usize;
    for (i, pixel) in image.rgba.chunks_exact_mut(4).enumerate() {
        let x = i % width.max(1);
        let from_side = x.min(width - 1 - x) as f32 / FADE_PX;
        if from_side < 1.0 {
            pixel[3] = (f32::from(pixel[3]) * from_side).round() as u8;
        }
    }
}

/// The box around what a file names, if that is at most an arm, a leg, a hand or the head.
fn named_alone(patch: &PosePatch, evaluation: &Evaluation) -> Option<Bounds> {
    let parts: Vec<Part> =
        Part::ALL.into_iter().filter(|part| patch.joints.keys().any(|bone| bone.part() == *part)).collect();
    let small = !parts.is_empty() && parts.len() <= 2 && !parts.contains(&Part::Torso);
    if !small {
        return None;
    }
    // A bone that is named carries others along, whose joints are where it ends.
    let moved = |bone: &Bone| [*bone, bone.carrier()].iter().any(|bone| patch.joints.contains_key(bone));
    let named = Bone::ALL.into_iter().filter(moved);
    let places = named.map(|bone| evaluation.frames[bone].position.as_vec3());
    let reach = Vec3::splat(FLESH_M);
    Some(Bounds::of(places.flat_map(|place| [place - reach, place + reach])))
}

/// The bones of a figure without a skin as lines.
fn bones(figure: &Figure, evaluation: &Evaluation) -> Overlay {
    let place = |bone: Bone| evaluation.frames[bone].position.as_vec3();
    let line = |joint: &rig::Joint| Line {
        from: place(joint.bone.carrier()),
        to: place(joint.bone),
        color: [200, 170, 140, 255],
        width_px: 4.0,
        dash_px: 0.0,
        layer: Layer::OnTop,
    };
    Overlay { lines: figure.skeleton.joints().map(line).collect(), ..Overlay::default() }
}
