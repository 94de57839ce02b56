//! What draws pictures without a window: one device for any number of them.

use std::sync::Arc;

use glam::DVec3;
use render::{FigureView, Gpu, GpuError, Image, Keypoints, Pass, Renderer, Scene};
use rig::{Bone, Bounds, Camera, Evaluation, Figure, Mesh, Palette, skin_positions};

use super::keypoints::Landmarks;
use super::shot::Shot;
use super::subject::Subject;
use super::underfoot::Underfoot;
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

/// A device, and what was drawn last.
pub struct Darkroom {
    renderer: Renderer,
    drawn: Option<Subject>,
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
    /// A skin at fault, a size that can't be, keypoints of a chain, a driver that complains.
    pub fn image(&mut self, subject: &Subject, camera: Camera, shot: &Shot) -> Result<Image, Failure> {
        self.seat(subject)?;
        let (palettes, keypoints) = self.prepared(subject, shot.pass)?;
        let figures = views(subject, &palettes);
        Ok(self.renderer.image(&scene(&figures, &keypoints, camera, shot))?)
    }

    /// Draws a picture of any size, band after band from the top, each as wide as the picture.
    ///
    /// # Errors
    /// As [`Darkroom::image`], and what `take` finds wrong.
    pub fn bands(
        &mut self,
        subject: &Subject,
        camera: Camera,
        shot: &Shot,
        mut take: impl FnMut(&Image) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        self.seat(subject)?;
        let (palettes, keypoints) = self.prepared(subject, shot.pass)?;
        let figures = views(subject, &palettes);
        self.renderer.bands(&scene(&figures, &keypoints, camera, shot), |band| take(&band.image))
    }

    /// The keypoints of a posed figure.
    ///
    /// # Errors
    /// A chain has none.
    pub fn keypoints(&mut self, subject: &Subject) -> Result<Keypoints, Failure> {
        let posed = subject.posed().ok_or_else(|| {
            let name = subject.name();
            Failure::Usage(format!("{name} is a chain: only figures have the keypoints of OpenPose"))
        })?;
        Ok(match &self.landmarks {
            Some((figure, landmarks)) if Arc::ptr_eq(figure, &posed.figure) => {
                landmarks.keypoints(&posed.evaluation)
            }
            _ => {
                let landmarks = Landmarks::of(&posed.figure);
                let points = landmarks.keypoints(&posed.evaluation);
                self.landmarks = Some((posed.figure.clone(), landmarks));
                points
            }
        })
    }

    /// Uploads what is seen of a subject, but for what is there.
    fn seat(&mut self, subject: &Subject) -> Result<(), Failure> {
        // Until all is there, nothing counts.
        let former = self.drawn.take();
        let kept = former.as_ref().map(meshes).unwrap_or_default();
        for (slot, mesh) in meshes(subject).into_iter().enumerate() {
            if !kept.get(slot).is_some_and(|kept| std::ptr::eq(*kept, mesh)) {
                self.renderer.set_mesh(slot, mesh)?;
            }
        }
        self.drawn = Some(subject.clone());
        Ok(())
    }

    fn prepared(&mut self, subject: &Subject, pass: Pass) -> Result<(Vec<Palette>, Vec<Keypoints>), Failure> {
        let points = if pass == Pass::OpenPose { vec![self.keypoints(subject)?] } else { Vec::new() };
        Ok((subject.palettes(), points))
    }
}

/// The meshes of a subject by their slots, the ground being the last. They stay where they are while a clone of the subject
/// is kept.
fn meshes(subject: &Subject) -> Vec<&Mesh> {
    subject.meshes().iter().chain(subject.underfoot().map(Underfoot::mesh)).collect()
}

/// A view of each mesh of a subject.
fn views<'a>(subject: &Subject, palettes: &'a [Palette]) -> Vec<FigureView<'a>> {
    let own = subject.meshes().len();
    let bodies =
        (0..own).zip(palettes).map(|(skin, palette)| FigureView { skin, ..FigureView::new(palette) });
    bodies.chain(subject.underfoot().map(|_| Underfoot::view(own))).collect()
}

fn scene<'a>(
    figures: &'a [FigureView<'a>],
    keypoints: &'a [Keypoints],
    camera: Camera,
    shot: &Shot,
) -> Scene<'a> {
    Scene { look: shot.look, pass: shot.pass, keypoints, ..Scene::new(figures, camera, shot.size) }
}
