//! Egui's side of the renderer: draws the picture before egui's own pass and paints it inside.

use std::sync::Arc;

use edit::Editor;
use egui::Rect;
use egui_wgpu::{CallbackResources, CallbackTrait, ScreenDescriptor};
use render::{Blit, DrawError, FigureView, Gpu, Look, Overlay, Renderer, Scene};
use rig::{Bone, Camera, Mesh, Palette};

/// What one picture shows. Equal pictures look equal, so the second of two is not drawn.
#[derive(Clone, PartialEq, Debug)]
pub struct Picture {
    camera: Camera,
    size: [u32; 2],
    look: Look,
    palette: Palette,
    has_skin: bool,
    selected: Vec<Bone>,
    hovered: Vec<Bone>,
    overlay: Overlay,
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
        lean: bool,
    ) -> Picture {
        let rest = crate::picture::rest_positions(editor.figure());
        let look = Look::default();
        Picture {
            camera,
            size: [rect.width(), rect.height()].map(|s| ((s * pixels_per_point).round() as u32).max(1)),
            look: if lean { look.lean() } else { look },
            // Frames of the world in place of the figure's: the figure's transform is the identity then.
            palette: Palette::new(&editor.evaluation().frames, &rest),
            has_skin: editor.figure().skin.is_some(),
            selected: lit.selected.to_vec(),
            hovered: lit.hovered.into_iter().collect(),
            overlay,
        }
    }
}

/// What draws pictures, kept with egui's renderer.
pub struct PictureGpu {
    renderer: Renderer,
    blit: Blit,
    drawn: Option<Picture>,
    /// Pictures drawn so far.
    pub count: u64,
}

impl PictureGpu {
    /// Makes ready for a target of that format; uploads the skin, if there is one.
    ///
    /// # Errors
    /// The skin is at fault.
    pub fn new(gpu: &Gpu, format: wgpu::TextureFormat, skin: Option<&Mesh>) -> Result<PictureGpu, DrawError> {
        let mut renderer = Renderer::new(gpu);
        if let Some(mesh) = skin {
            renderer.set_mesh(0, mesh)?;
        }
        Ok(PictureGpu { renderer, blit: Blit::new(gpu, format), drawn: None, count: 0 })
    }

    fn draw(&mut self, encoder: &mut wgpu::CommandEncoder, picture: &Picture) {
        if self.drawn.as_ref() == Some(picture) {
            return;
        }
        let figure = FigureView {
            selected: &picture.selected,
            hovered: &picture.hovered,
            ..FigureView::new(&picture.palette)
        };
        let figures = if picture.has_skin { std::slice::from_ref(&figure) } else { &[] };
        let scene = Scene {
            look: picture.look,
            overlay: &picture.overlay,
            ..Scene::new(figures, picture.camera, picture.size)
        };
        match self.renderer.draw(encoder, &scene) {
            Ok(_) => {
                self.count += 1;
                self.drawn = Some(picture.clone());
                self.blit.prepare(&self.renderer);
            }
            Err(error) => log::error!("the figure can't be drawn: {error}"),
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
        gpu.blit.paint(pass, rect);
    }
}

/// Puts what draws pictures among the resources of egui's renderer: a window's, a test harness's, an offscreen one's.
///
/// # Errors
/// The figure's skin is at fault.
pub fn install(
    renderer: &mut egui_wgpu::Renderer,
    gpu: &Gpu,
    format: wgpu::TextureFormat,
    figure: &Arc<rig::Figure>,
) -> Result<(), DrawError> {
    renderer.callback_resources.insert(PictureGpu::new(gpu, format, figure.skin.as_ref())?);
    Ok(())
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
        install(&mut state.renderer.write(), &gpu, state.target_format, &figure).unwrap();
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
    }
}
