//! Egui's side of the renderer: draws the picture of a figure or a robot before egui's own pass and paints it inside.

use std::sync::Arc;

use edit::Editor;
use egui::Rect;
use egui_wgpu::{CallbackResources, CallbackTrait, ScreenDescriptor};
use render::{Blit, DrawError, FigureView, Gpu, Image, Look, Overlay, Renderer, Scene};
use rig::{Bone, Camera, Figure, Mesh, Palette, RobotSkin};

use crate::picture::Underfoot;

/// What one picture shows. Equal pictures look equal, so the second of two is not drawn.
#[derive(Clone, PartialEq, Debug)]
pub struct Picture {
    camera: Camera,
    size: [u32; 2],
    look: Look,
    body: Body,
    /// How each of the body's meshes is posed and tinted.
    parts: Vec<Part>,
    overlay: Overlay,
    backdrop: Option<Reference>,
    ground: Option<Underfoot>,
    slot: usize,
}

/// A picture behind the figure; the same one is one and the same allocation.
#[derive(Clone, Debug)]
struct Reference(Arc<Image>);

impl PartialEq for Reference {
    fn eq(&self, other: &Reference) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// Whose meshes are drawn; the same ones are one and the same allocation.
#[derive(Clone, Debug)]
pub enum Body {
    /// A figure with its skin, if it has one.
    Figure(Arc<Figure>),
    /// A robot's links.
    Robot(Arc<RobotSkin>),
}

impl Body {
    fn meshes(&self) -> &[Mesh] {
        match self {
            Body::Figure(figure) => figure.skin.as_slice(),
            Body::Robot(skin) => &skin.meshes,
        }
    }
}

impl PartialEq for Body {
    fn eq(&self, other: &Body) -> bool {
        match (self, other) {
            (Body::Figure(own), Body::Figure(other)) => Arc::ptr_eq(own, other),
            (Body::Robot(own), Body::Robot(other)) => Arc::ptr_eq(own, other),
            _ => false,
        }
    }
}

/// One mesh of a body as it is posed, and its parts that are tinted.
#[derive(Clone, PartialEq, Debug)]
pub struct Part {
    /// Its places in the world.
    pub palette: Palette,
    /// The chosen ones.
    pub selected: Vec<Bone>,
    /// Those under the pointer.
    pub hovered: Vec<Bone>,
}

/// Bones whose skin is tinted.
#[derive(Clone, Copy, PartialEq, Eq, Default, Debug)]
pub struct Lit<'a> {
    /// The chosen ones.
    pub selected: &'a [Bone],
    /// The one under the pointer.
    pub hovered: Option<Bone>,
}

impl Picture {
    /// The picture of a pose for a rectangle of the window.
    pub fn new(
        editor: &Editor,
        camera: Camera,
        rect: Rect,
        pixels_per_point: f32,
        overlay: Overlay,
        lit: Lit<'_>,
        look: Look,
    ) -> Picture {
        let rest = crate::picture::rest_positions(editor.figure());
        let part = Part {
            // Frames of the world in place of the figure's: the figure's transform is the identity then.
            palette: Palette::new(&editor.evaluation().frames, &rest),
            selected: lit.selected.to_vec(),
            hovered: lit.hovered.into_iter().collect(),
        };
        let body = Body::Figure(editor.figure().clone());
        Picture::of(body, vec![part], camera, rect, pixels_per_point, overlay, look)
    }

    /// The picture of a body for a rectangle of the window.
    pub fn of(
        body: Body,
        parts: Vec<Part>,
        camera: Camera,
        rect: Rect,
        pixels_per_point: f32,
        overlay: Overlay,
        look: Look,
    ) -> Picture {
        Picture {
            camera,
            size: [rect.width(), rect.height()].map(|s| ((s * pixels_per_point).round() as u32).max(1)),
            look,
            body,
            parts,
            overlay,
            backdrop: None,
            ground: None,
            slot: 0,
        }
    }

    /// On a patch of ground in place of the plane at height 0.
    pub fn upon(mut self, ground: Option<&Underfoot>) -> Picture {
        self.ground = ground.cloned();
        self
    }

    /// Before a picture for reference of that opacity.
    pub fn before(mut self, reference: Option<(&Arc<Image>, f32)>) -> Picture {
        self.backdrop = reference.map(|(image, _)| Reference(image.clone()));
        self.look.backdrop_opacity = reference.map_or(0.0, |(_, opacity)| opacity);
        self
    }

    /// The small second picture, kept apart from the large one.
    pub fn in_second_slot(mut self) -> Picture {
        self.slot = 1;
        self
    }
}

/// What draws pictures, kept with egui's renderer.
pub struct PictureGpu {
    gpu: Gpu,
    format: wgpu::TextureFormat,
    /// The large picture, and the small one once it was shown: each has textures of its own.
    slots: [Option<Slot>; 2],
    /// Pictures drawn so far.
    pub count: u64,
}

/// One picture's renderer, and what it drew last.
struct Slot {
    renderer: Renderer,
    blit: Blit,
    drawn: Option<Picture>,
    /// The body whose meshes the renderer has.
    body: Body,
    /// The ground that it has.
    ground: Option<Underfoot>,
}

/// Where the renderer keeps the ground: beyond the meshes of any body.
const GROUND_SLOT: usize = usize::MAX;

impl Slot {
    fn new(gpu: &Gpu, format: wgpu::TextureFormat, body: &Body) -> Result<Slot, DrawError> {
        let mut slot = Slot {
            renderer: Renderer::new(gpu),
            blit: Blit::new(gpu, format),
            drawn: None,
            body: body.clone(),
            ground: None,
        };
        slot.upload()?;
        Ok(slot)
    }

    fn upload(&mut self) -> Result<(), DrawError> {
        let meshes = self.body.meshes().iter().enumerate();
        meshes
            .filter(|(_, mesh)| !mesh.indices.is_empty())
            .try_for_each(|(i, mesh)| self.renderer.set_mesh(i, mesh))
    }

    /// Draws a picture unless it is the one drawn before; whether it did.
    fn draw(&mut self, encoder: &mut wgpu::CommandEncoder, picture: &Picture) -> Result<bool, DrawError> {
        if self.drawn.as_ref() == Some(picture) {
            return Ok(false);
        }
        if self.body != picture.body {
            self.body = picture.body.clone();
            self.upload()?;
        }
        if self.drawn.as_ref().and_then(|drawn| drawn.backdrop.as_ref()) != picture.backdrop.as_ref() {
            self.renderer.set_backdrop(picture.backdrop.as_ref().map(|reference| &*reference.0))?;
        }
        if let Some(patch) = picture.ground.as_ref().filter(|_| self.ground != picture.ground) {
            self.renderer.set_mesh(GROUND_SLOT, patch.mesh())?;
            self.ground = picture.ground.clone();
        }
        let meshes = picture.body.meshes().iter().zip(&picture.parts).enumerate();
        // A mesh of nothing was not uploaded: its slot has what another body left there.
        let seen = meshes.filter(|(_, (mesh, _))| !mesh.indices.is_empty());
        let ground = picture.ground.as_ref().map(|_| Underfoot::view(GROUND_SLOT));
        let figures = seen.map(|(skin, (_, part))| FigureView {
            skin,
            selected: &part.selected,
            hovered: &part.hovered,
            ..FigureView::new(&part.palette)
        });
        let figures: Vec<FigureView> = figures.chain(ground).collect();
        let scene = Scene {
            look: picture.look,
            overlay: &picture.overlay,
            ..Scene::new(&figures, picture.camera, picture.size)
        };
        self.renderer.draw(encoder, &scene)?;
        self.drawn = Some(picture.clone());
        self.blit.prepare(&self.renderer);
        Ok(true)
    }
}

impl PictureGpu {
    /// Makes ready for a target of that format; uploads the meshes, if there are any.
    ///
    /// # Errors
    /// A mesh is at fault.
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat, body: &Body) -> Result<PictureGpu, DrawError> {
        let first = Slot::new(gpu, format, body)?;
        let slots = [Some(first), None];
        Ok(PictureGpu { gpu: gpu.clone(), format, slots, count: 0 })
    }

    fn draw(&mut self, encoder: &mut wgpu::CommandEncoder, picture: &Picture) {
        let Some(place) = self.slots.get_mut(picture.slot) else { return };
        let slot = match place.take() {
            Some(slot) => Ok(slot),
            None => Slot::new(&self.gpu, self.format, &picture.body),
        };
        let drawn = slot.and_then(|slot| place.insert(slot).draw(encoder, picture));
        match drawn {
            Ok(drawn) => self.count += u64::from(drawn),
            Err(error) => log::error!("the picture can't be drawn: {error}"),
        }
    }
}

impl CallbackTrait for Picture {
    fn prepare(
        &self,
        _device: &wgpu::Device,
        _queue: &wgpu::Queue,
        _screen: &ScreenDescriptor,
        encoder: &mut wgpu::CommandEncoder,
        resources: &mut CallbackResources,
    ) -> Vec<wgpu::CommandBuffer> {
        if let Some(gpu) = resources.get_mut::<PictureGpu>() {
            gpu.draw(encoder, self);
        }
        Vec::new()
    }

    fn paint(
        &self,
        info: egui::PaintCallbackInfo,
        pass: &mut wgpu::RenderPass<'static>,
        resources: &CallbackResources,
    ) {
        let Some(gpu) = resources.get::<PictureGpu>() else { return };
        let at = info.viewport_in_pixels();
        let rect = [at.left_px as f32, at.top_px as f32, at.width_px as f32, at.height_px as f32];
        if let Some(slot) = gpu.slots.get(self.slot).and_then(Option::as_ref) {
            slot.blit.paint(pass, rect);
        }
    }
}

/// Puts what draws pictures among the resources of egui's renderer: a window's, a test harness's, an offscreen one's.
///
/// # Errors
/// A mesh of the body is at fault.
pub fn install(
    renderer: &mut egui_wgpu::Renderer,
    gpu: &Gpu,
    format: wgpu::TextureFormat,
    body: &Body,
) -> Result<(), DrawError> {
    renderer.callback_resources.insert(PictureGpu::new(gpu, format, body)?);
    Ok(())
}

/// How many pictures were drawn with egui's renderer so far.
pub fn drawn(renderer: &egui_wgpu::Renderer) -> u64 {
    renderer.callback_resources.get::<PictureGpu>().map_or(0, |gpu| gpu.count)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use egui::vec2;
    use egui_kittest::Harness;
    use egui_kittest::wgpu::{WgpuTestRenderer, create_render_state, default_wgpu_setup};

    use super::*;
    use crate::Session;

    #[test]
    fn the_pointer_draws_a_picture_only_when_another_bone_lights_up() {
        let state = create_render_state(default_wgpu_setup(), egui_wgpu::RendererOptions::PREDICTABLE);
        let gpu = Gpu::of_device(state.device.clone(), state.queue.clone(), state.adapter.get_info());
        let figure = crate::load::figure(None).unwrap();
        install(&mut state.renderer.write(), &gpu, state.target_format, &Body::Figure(figure.clone()))
            .unwrap();
        let count = || state.renderer.read().callback_resources.get::<PictureGpu>().unwrap().count;
        let session = Session::new(Editor::new(figure), None);
        let mut hand = Harness::builder()
            .with_size(vec2(900.0, 600.0))
            .renderer(WgpuTestRenderer::from_render_state(state.clone()))
            .build_ui_state(|ui, session: &mut Session| session.ui(ui), session);
        hand.run();
        let neck = hand.state().editor().evaluation().frames[Bone::UpperChest].position;
        let chest = hand.state().viewport.window_of(neck).unwrap() + vec2(6.0, 12.0);
        let mut drawn_at = |place| {
            hand.hover_at(place);
            hand.run();
            hand.render().unwrap();
            (hand.state().viewport.hovered(), count())
        };
        let (nowhere, first) = drawn_at(chest + vec2(0.0, 250.0));
        assert_eq!(nowhere, None);
        let (lit, second) = drawn_at(chest);
        assert!(lit.is_some() && second == first + 1, "{lit:?} {first} {second}");
        for shift in [vec2(1.0, 0.0), vec2(2.0, 1.0), vec2(3.0, 0.0)] {
            assert_eq!(drawn_at(chest + shift), (lit, second), "the same bone, the same picture");
        }
        hand.state_mut().viewport.side_view = true;
        hand.run();
        hand.render().unwrap();
        assert_eq!(count(), second + 1, "the second view costs one picture, the first none");
        hand.state_mut().viewport.side_view = false;
        hand.run();
        hand.render().unwrap();
        assert_eq!(count(), second + 1, "and nothing once it is closed");
    }
}
