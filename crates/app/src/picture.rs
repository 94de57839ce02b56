//! Pictures without a window: a figure drawn to a PNG.

use std::path::Path;

use edit::Editor;
use glam::DVec3;
use render::{FigureView, Gpu, GpuError, Image, Look, Pass, Renderer, Scene};
use rig::{Bone, Bounds, Camera, Evaluation, Figure, Palette, SkinBounds, View};

use crate::disk::write_atomic;
use crate::failure::Failure;

/// What to draw, and how.
#[derive(Clone, Copy, Debug)]
pub struct Shot {
    /// Width and height in pixels.
    pub size: [u32; 2],
    /// From where.
    pub view: View,
    /// What each pixel says.
    pub pass: Pass,
    /// Whether the background is left clear.
    pub transparent: bool,
}

/// Opens the graphics adapter.
///
/// # Errors
/// None to be had: the sentence that names the cure.
pub fn open_gpu() -> Result<Gpu, Failure> {
    Gpu::headless().map_err(|e| match e {
        GpuError::NoAdapter(_) => Failure::NoScreen(e.to_string()),
        other => Failure::NoScreen(format!("the graphics adapter can't be used: {other}")),
    })
}

/// The joints' places at rest, which the skin's palette needs.
pub fn rest_positions(figure: &Figure) -> [DVec3; Bone::COUNT] {
    Bone::ALL.map(|bone| figure.skeleton.rest_position(bone))
}

/// The box around a posed figure: its skin, or its joints if it has none.
pub fn bounds(figure: &Figure, evaluation: &Evaluation) -> Bounds {
    match &figure.skin {
        Some(mesh) => {
            let palette = Palette::new(&evaluation.frames, &rest_positions(figure));
            SkinBounds::new(mesh).posed(&palette)
        }
        None => Bounds::of(evaluation.frames.0.iter().map(|f| f.position.as_vec3())),
    }
}

/// Draws an editor's pose.
///
/// # Errors
/// No adapter; a size that the adapter can't draw.
pub fn picture(editor: &Editor, shot: &Shot) -> Result<Image, Failure> {
    let aspect = shot.size[0] as f32 / shot.size[1] as f32;
    let camera = Camera::view(shot.view, bounds(editor.figure(), editor.evaluation()), aspect);
    let look = Look { transparent: shot.transparent, ..Look::default() };
    image_of(editor, camera, shot.size, look, shot.pass)
}

/// Draws an editor's pose as a camera sees it, without marks.
///
/// # Errors
/// No adapter; a size that the adapter can't draw.
pub fn seen(editor: &Editor, camera: Camera, size: [u32; 2]) -> Result<Image, Failure> {
    image_of(editor, camera, size, Look::default(), Pass::Color)
}

fn image_of(
    editor: &Editor,
    camera: Camera,
    size: [u32; 2],
    look: Look,
    pass: Pass,
) -> Result<Image, Failure> {
    let gpu = open_gpu()?;
    let figure = editor.figure();
    let evaluation = editor.evaluation();
    let mut renderer = Renderer::new(&gpu);
    let mesh = figure.skin.clone().unwrap_or_default();
    renderer.set_mesh(0, &mesh).map_err(|e| Failure::Input(e.to_string()))?;
    let palette = Palette::new(&evaluation.frames, &rest_positions(figure));
    let figures = [FigureView::new(&palette)];
    let keypoints = keypoints(figure, evaluation);
    let scene = Scene { look, pass, keypoints: &keypoints, ..Scene::new(&figures, camera, size) };
    renderer.image(&scene).map_err(|e| Failure::Input(e.to_string()))
}

/// The COCO keypoints of a figure in the world: nose, neck, arms right then left, legs right then left, eyes, ears.
fn keypoints(figure: &Figure, evaluation: &Evaluation) -> Vec<(usize, DVec3)> {
    let frames = &evaluation.frames;
    let joint = |bone: Bone| frames[bone].position;
    let in_head = |v: DVec3| frames[Bone::Head].point(v);
    let eye = figure.skeleton.joint(Bone::LeftEye).map_or(DVec3::new(0.03, 0.07, 0.08), |j| j.offset);
    let (nose, ear) = (DVec3::new(0.0, eye.y - 0.035, eye.z + 0.035), DVec3::new(0.075, eye.y - 0.01, 0.0));
    let arms = [
        Bone::RightUpperArm,
        Bone::RightLowerArm,
        Bone::RightHand,
        Bone::LeftUpperArm,
        Bone::LeftLowerArm,
        Bone::LeftHand,
    ];
    let legs = [
        Bone::RightUpperLeg,
        Bone::RightLowerLeg,
        Bone::RightFoot,
        Bone::LeftUpperLeg,
        Bone::LeftLowerLeg,
        Bone::LeftFoot,
    ];
    let shoulders = (joint(Bone::LeftUpperArm) + joint(Bone::RightUpperArm)) * 0.5;
    let mirror = DVec3::new(-1.0, 1.0, 1.0);
    let mut points = vec![in_head(nose), shoulders];
    points.extend(arms.into_iter().chain(legs).map(joint));
    points.extend([in_head(eye * mirror), in_head(eye), in_head(ear * mirror), in_head(ear)]);
    points.into_iter().enumerate().collect()
}

/// Writes a picture as PNG, whole or not at all.
///
/// # Errors
/// A file that can't be written.
pub fn write_png(image: &Image, path: &Path) -> Result<(), Failure> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    let buffer = image::RgbaImage::from_raw(image.width, image.height, image.rgba.clone());
    let written = buffer.map(|b| b.write_to(&mut bytes, image::ImageFormat::Png));
    match written {
        Some(Ok(())) => write_atomic(path, &bytes.into_inner()),
        _ => Err(Failure::Input(format!("{}: the picture can't be encoded", path.display()))),
    }
}
