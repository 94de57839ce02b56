//! What draws pictures without a window: one device for any number of them.

use std::sync::Arc;

use edit::Editor;
use glam::DVec3;
use render::{FigureView, Gpu, GpuError, Image, Keypoints, Pass, Renderer, Scene};
use rig::{Bone, Bounds, Camera, Evaluation, Figure, Palette, skin_positions};

use super::keypoints::Landmarks;
use super::shot::Shot;
use crate::failure::Failure;

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

/// The tightest box around a posed figure: its skin, or its joints if it has none.
pub fn bounds(figure: &Figure, evaluation: &Evaluation) -> Bounds {
    match &figure.skin {
        Some(mesh) => {
            let palette = Palette::new(&evaluation.frames, &rest_positions(figure));
            Bounds::of(skin_positions(mesh, &palette))
        }
        None => Bounds::of(evaluation.frames.0.iter().map(|f| f.position.as_vec3())),
    }
}

/// A figure in a pose.
#[derive(Clone, Debug)]
pub struct Posed {
    /// Who.
    pub figure: Arc<Figure>,
    /// How.
    pub evaluation: Evaluation,
}

impl Posed {
    /// As an editor shows it.
    pub fn of(editor: &Editor) -> Posed {
        Posed { figure: editor.figure().clone(), evaluation: editor.evaluation().clone() }
    }

    /// What moves its skin.
    pub fn palette(&self) -> Palette {
        Palette::new(&self.evaluation.frames, &rest_positions(&self.figure))
    }

    /// The box around it.
    pub fn bounds(&self) -> Bounds {
        bounds(&self.figure, &self.evaluation)
    }
}

/// A device, and the figure that was drawn last.
pub struct Darkroom {
    renderer: Renderer,
    drawn: Option<Arc<Figure>>,
    /// The figure's keypoints, once they were asked for.
    landmarks: Option<(Arc<Figure>, Landmarks)>,
}

impl Darkroom {
    /// Opens a device.
    ///
    /// # Errors
    /// None to be had: the sentence that names the cure.
    pub fn open() -> Result<Darkroom, Failure> {
        Ok(Darkroom { renderer: Renderer::new(&open_gpu()?), drawn: None, landmarks: None })
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        self.renderer.gpu()
    }

    /// Draws a picture.
    ///
    /// # Errors
    /// A skin at fault, a size that can't be, a driver that complains.
    pub fn image(&mut self, posed: &Posed, camera: Camera, shot: &Shot) -> Result<Image, Failure> {
        self.seat(&posed.figure)?;
        let (palette, keypoints) = self.prepared(posed, shot.pass);
        let figures = [FigureView::new(&palette)];
        let scene = scene(posed, &figures, &keypoints, camera, shot);
        Ok(self.renderer.image(&scene)?)
    }

    /// Draws a picture of any size, band after band from the top, each as wide as the picture.
    ///
    /// # Errors
    /// As [`Darkroom::image`], and what `take` finds wrong.
    pub fn bands(
        &mut self,
        posed: &Posed,
        camera: Camera,
        shot: &Shot,
        mut take: impl FnMut(&Image) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        self.seat(&posed.figure)?;
        let (palette, keypoints) = self.prepared(posed, shot.pass);
        let figures = [FigureView::new(&palette)];
        let scene = scene(posed, &figures, &keypoints, camera, shot);
        self.renderer.bands(&scene, |band| take(&band.image))
    }

    /// The keypoints of a posed figure.
    pub fn keypoints(&mut self, posed: &Posed) -> Keypoints {
        match &self.landmarks {
            Some((figure, landmarks)) if Arc::ptr_eq(figure, &posed.figure) => {
                landmarks.keypoints(&posed.evaluation)
            }
            _ => {
                let landmarks = Landmarks::of(&posed.figure);
                let points = landmarks.keypoints(&posed.evaluation);
                self.landmarks = Some((posed.figure.clone(), landmarks));
                points
            }
        }
    }

    /// Uploads the figure's skin, unless it is there.
    fn seat(&mut self, figure: &Arc<Figure>) -> Result<(), Failure> {
        if self.drawn.as_ref().is_some_and(|former| Arc::ptr_eq(former, figure)) {
            return Ok(());
        }
        if let Some(mesh) = &figure.skin {
            self.renderer.set_mesh(0, mesh)?;
        }
        self.drawn = Some(figure.clone());
        Ok(())
    }

    fn prepared(&mut self, posed: &Posed, pass: Pass) -> (Palette, Vec<Keypoints>) {
        let points = (pass == Pass::OpenPose).then(|| self.keypoints(posed));
        (posed.palette(), points.into_iter().collect())
    }
}

fn scene<'a>(
    posed: &Posed,
    figures: &'a [FigureView<'a>],
    keypoints: &'a [Keypoints],
    camera: Camera,
    shot: &Shot,
) -> Scene<'a> {
    let drawn = if posed.figure.skin.is_some() { figures } else { &[] };
    Scene { look: shot.look, pass: shot.pass, keypoints, ..Scene::new(drawn, camera, shot.size) }
}
