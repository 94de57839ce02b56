//! The renderer: keeps what lives on the device and records one picture after another.

use std::collections::HashMap;
use std::ops::Range;

use glam::Vec3;
use rig::{Bounds, Mesh};

use crate::backdrop::BackdropImage;
use crate::bands::PIECE_EDGE;
use crate::bodies::Body;
use crate::figures::Figures;
use crate::layered::{Layered, LayeredBuffer};
use crate::light::Light;
use crate::overlay::{self, Layer, Overlay, Stroke};
use crate::pipelines::Pipelines;
use crate::recipe::{Draw, Paint};
use crate::scene::{FigureView, Pass, Scene, Style};
use crate::shadow::ShadowMaps;
use crate::surfaces::{self, BALL_VERTICES, Corner, Shell};
use crate::target::{Target, TargetKey};
use crate::tile::Tile;
use crate::uniforms::SceneUniform;
use crate::{DrawError, Gpu, Image, openpose};

/// Draws scenes into its own texture.
///
/// Meshes are uploaded once by [`Renderer::set_mesh`]; a picture then uploads only palettes, camera and marks.
#[derive(Debug)]
pub struct Renderer {
    gpu: Gpu,
    pipelines: Pipelines,
    bodies: HashMap<usize, Body>,
    scene_buffer: wgpu::Buffer,
    scene_group: wgpu::BindGroup,
    figures: Figures,
    shadow: ShadowMaps,
    backdrop: Option<BackdropImage>,
    balls: LayeredBuffer<Shell>,
    fans: LayeredBuffer<Corner>,
    strokes: LayeredBuffer<Stroke>,
    target: Option<Target>,
    piece_edge: u32,
}

impl Renderer {
    /// A renderer without meshes.
    pub fn new(gpu: &Gpu) -> Renderer {
        let device = &gpu.device;
        let pipelines = Pipelines::new(device);
        let scene_buffer = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("scene"),
            size: size_of::<SceneUniform>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let scene_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("scene"),
            layout: &pipelines.layouts.scene,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: scene_buffer.as_entire_binding() }],
        });
        Renderer {
            figures: Figures::new(device, &pipelines.layouts.figure, 1),
            shadow: ShadowMaps::new(device, &pipelines.layouts),
            backdrop: None,
            balls: LayeredBuffer::new("balls"),
            fans: LayeredBuffer::new("fans"),
            strokes: LayeredBuffer::new("strokes"),
            gpu: gpu.clone(),
            pipelines,
            bodies: HashMap::new(),
            scene_buffer,
            scene_group,
            target: None,
            piece_edge: PIECE_EDGE.min(gpu.max_edge()),
        }
    }

    /// The device that it draws on.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Uploads a skin into a slot, in place of what was there.
    ///
    /// # Errors
    /// The mesh has a [`Mesh::fault`]; the slot keeps what it had.
    pub fn set_mesh(&mut self, slot: usize, mesh: &Mesh) -> Result<(), DrawError> {
        if let Some(fault) = mesh.fault() {
            return Err(DrawError::Mesh(fault));
        }
        self.bodies.insert(slot, Body::upload(&self.gpu.device, mesh));
        Ok(())
    }

    /// Takes on a picture for reference, drawn behind the figures as high as the view with
    /// [`crate::Look::backdrop_opacity`]; `None` takes it away.
    ///
    /// # Errors
    /// A size that the device can't hold, or that isn't that of its bytes; there is no picture then.
    pub fn set_backdrop(&mut self, image: Option<&Image>) -> Result<(), DrawError> {
        self.backdrop = None;
        if let Some(image) = image {
            self.backdrop = Some(BackdropImage::upload(&self.gpu, &self.pipelines.layouts, image)?);
        }
        Ok(())
    }

    /// A box around posed figures, world space, metres; somewhat larger than the tightest one.
    ///
    /// Figures whose slot is empty count for nothing.
    pub fn bounds(&self, figures: &[FigureView<'_>]) -> Bounds {
        Bounds::of(self.corners(figures))
    }

    /// Records the picture; it stands in [`Renderer::picture`] once the encoder's commands are submitted.
    ///
    /// One call a submission: palettes and camera are written through the queue.
    ///
    /// # Errors
    /// A size that the device cannot hold, a figure whose slot is empty. Nothing is recorded then.
    pub fn draw(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &Scene<'_>,
    ) -> Result<&wgpu::TextureView, DrawError> {
        self.check(scene, self.gpu.max_edge())?;
        let scale = if scene.look.scale.is_finite() { scene.look.scale.clamp(0.1, 1.0) } else { 1.0 };
        let size = scene.size.map(|s| ((s as f32 * scale).round() as u32).max(1));
        self.draw_tile(encoder, scene, Tile::of_all(size))
    }

    /// Records a part of the picture, as [`Renderer::draw`] does the whole; the scene has been checked.
    pub(crate) fn draw_tile(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &Scene<'_>,
        tile: Tile,
    ) -> Result<&wgpu::TextureView, DrawError> {
        self.prepare_target(TargetKey::of(scene.pass, tile.size, scene.look.msaa));
        self.upload(scene, tile);
        self.prepare_pipelines(scene);
        if self.casts_shadow(scene) {
            self.record_shadow(encoder, scene);
        }
        self.record_picture(encoder, scene);
        self.picture_view().ok_or_else(|| DrawError::Driver("the picture's texture is gone".to_owned()))
    }

    /// Sets the longest edge of the pieces in which [`Renderer::image`] and [`Renderer::bands`] draw a large picture,
    /// within 1 and what the device can hold. Smaller ones take less memory and more time.
    pub fn set_piece_edge(&mut self, pixels: u32) {
        self.piece_edge = pixels.clamp(1, self.gpu.max_edge());
    }

    pub(crate) fn piece_edge(&self) -> u32 {
        self.piece_edge
    }

    /// The last picture: sRGB numbers, or a data pass's own, in a plain `Unorm` format; `None` before the first.
    pub fn picture(&self) -> Option<&wgpu::Texture> {
        self.target.as_ref().map(|t| &t.picture)
    }

    /// The whole of [`Renderer::picture`].
    pub fn picture_view(&self) -> Option<&wgpu::TextureView> {
        self.target.as_ref().map(|t| &t.view)
    }

    /// That the scene can be drawn with edges of at most that many pixels.
    pub(crate) fn check(&self, scene: &Scene<'_>, limit: u32) -> Result<(), DrawError> {
        let [width, height] = scene.size;
        if !(1..=limit).contains(&width) || !(1..=limit).contains(&height) {
            return Err(DrawError::Size { width, height, limit });
        }
        for (figure, view) in scene.figures.iter().enumerate() {
            if !self.bodies.contains_key(&view.skin) {
                return Err(DrawError::NoSkin { figure, skin: view.skin });
            }
        }
        Ok(())
    }

    fn prepare_target(&mut self, key: TargetKey) {
        if self.target.as_ref().is_none_or(|t| t.key != key) {
            // The former textures go first: both together may not fit.
            self.target = None;
            self.target = Some(Target::new(&self.gpu.device, key));
        }
    }

    fn corners<'a>(&'a self, figures: &'a [FigureView<'_>]) -> impl Iterator<Item = Vec3> + 'a {
        figures.iter().filter_map(|view| self.bodies.get(&view.skin).map(|body| (view, body))).flat_map(
            |(view, body)| {
                body.skin.bounds.corners(view.palette).map(|c| view.world_from_figure.transform_point3(c))
            },
        )
    }

    fn casts_shadow(&self, scene: &Scene<'_>) -> bool {
        scene.pass == Pass::Color && scene.look.shadow && scene.figures.iter().any(is_solid)
    }

    /// Writes all that changes from picture to picture.
    fn upload(&mut self, scene: &Scene<'_>, tile: Tile) {
        let Gpu { device, queue, .. } = &self.gpu;
        let solid: Vec<FigureView<'_>> = scene.figures.iter().copied().filter(is_solid).collect();
        let casters: Vec<Vec3> = self.corners(&solid).collect();
        let light = Light::fit(scene.look.key_light, &casters, self.casts_shadow(scene));
        let view = scene.camera.view_from_world();
        let depths = self.corners(scene.figures).map(|c| -view.transform_point3(c).z);
        let range = depths.fold([f32::MAX, f32::MIN], |[near, far], d| [near.min(d), far.max(d)]);
        let uniform = SceneUniform::of(scene, tile, &light, range);
        let uniform = if scene.pass == Pass::OpenPose { uniform.flat(tile) } else { uniform };
        queue.write_buffer(&self.scene_buffer, 0, bytemuck::bytes_of(&uniform));
        self.figures.write(device, queue, &self.pipelines.layouts.figure, scene.figures);
        self.upload_marks(scene, tile.whole);
    }

    fn upload_marks(&mut self, scene: &Scene<'_>, size: [u32; 2]) {
        let strokes = match scene.pass {
            Pass::OpenPose => openpose::strokes(scene, size).into_iter().map(|s| (Layer::OnTop, s)).collect(),
            Pass::Color => overlay::strokes(scene.overlay, size[0] as f32 / scene.size[0] as f32),
            _ => Layered::default(),
        };
        let seen = if scene.pass == Pass::Color { scene.overlay } else { &Overlay::EMPTY };
        self.balls.write(&self.gpu, &surfaces::shells(seen));
        self.fans.write(&self.gpu, &surfaces::corners(seen));
        self.strokes.write(&self.gpu, &strokes);
    }

    fn prepare_pipelines(&mut self, scene: &Scene<'_>) {
        let Some(msaa) = self.target.as_ref().map(|t| t.key.msaa) else { return };
        let mut draws = match scene.pass {
            Pass::Color => vec![Draw::Soften, Draw::Backdrop, Draw::Image, Draw::Grid, Draw::Shade],
            _ => Vec::new(),
        };
        draws.extend(self.balls.draws().map(|(_, seen, _)| Draw::Balls(seen)));
        draws.extend(self.fans.draws().map(|(_, seen, _)| Draw::Fans(seen)));
        draws.extend(self.strokes.draws().map(|(_, seen, _)| Draw::Strokes(seen)));
        for view in scene.figures {
            let two_sided = view.two_sided;
            let Some(paint) = paint_of(scene, view) else { continue };
            let other = if is_solid(view) { Draw::Shadow { two_sided } } else { Draw::Ghost { two_sided } };
            draws.extend([Draw::Figure { paint, two_sided }, other]);
            if let Some(body) = self.bodies.get_mut(&view.skin).filter(|_| paint.parts) {
                body.cut(&self.gpu.device);
            }
        }
        for draw in draws {
            self.pipelines.prepare(&self.gpu.device, draw, msaa);
        }
    }

    fn record_shadow(&self, encoder: &mut wgpu::CommandEncoder, scene: &Scene<'_>) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow"),
            depth_stencil_attachment: Some(depth_attachment(&self.shadow.depth, wgpu::StoreOp::Store)),
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_bind_group(0, &self.scene_group, &[]);
        for (i, view) in scene.figures.iter().enumerate().filter(|(_, v)| is_solid(v)) {
            self.draw_skin(&mut pass, Draw::Shadow { two_sided: view.two_sided }, i, view);
        }
        drop(pass);
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("soft shadow"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.shadow.soft,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations::default(),
            })],
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_bind_group(0, &self.scene_group, &[]);
        pass.set_bind_group(1, &self.figures.group, &[0]);
        pass.set_bind_group(2, &self.shadow.depth_group, &[]);
        if self.set_pipeline(&mut pass, Draw::Soften) {
            pass.draw(0..4, 0..1);
        }
    }

    fn record_picture(&self, encoder: &mut wgpu::CommandEncoder, scene: &Scene<'_>) {
        let Some(target) = &self.target else { return };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(target.color(clear_of(scene)))],
            depth_stencil_attachment: Some(depth_attachment(&target.depth, wgpu::StoreOp::Discard)),
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_bind_group(0, &self.scene_group, &[]);
        pass.set_bind_group(1, &self.figures.group, &[0]);
        self.draw_figures(&mut pass, scene, is_solid);
        self.draw_figures(&mut pass, scene, |view| !is_solid(view));
        self.draw_marks(&mut pass);
        drop(pass);
        if scene.pass == Pass::Color {
            self.record_surroundings(encoder, target, scene);
        }
    }

    /// Grid, shadow and background, put under the resolved figures: nothing of theirs needs samples or depth.
    fn record_surroundings(&self, encoder: &mut wgpu::CommandEncoder, target: &Target, scene: &Scene<'_>) {
        let above = scene.camera.eye().y > 0.0;
        let opaque = !scene.look.transparent;
        let soft = &self.shadow.soft_group;
        let image = self.backdrop.as_ref().filter(|_| opaque && scene.look.backdrop_opacity > 0.0);
        let wanted = [
            (Draw::Grid, (scene.look.grid && opaque).then_some(soft)),
            (Draw::Shade, (above && scene.look.ground_shadow && self.casts_shadow(scene)).then_some(soft)),
            (Draw::Image, image.map(|image| &image.group)),
            (Draw::Backdrop, opaque.then_some(soft)),
        ];
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("surroundings"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target.view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Load, store: wgpu::StoreOp::Store },
            })],
            ..wgpu::RenderPassDescriptor::default()
        });
        pass.set_bind_group(0, &self.scene_group, &[]);
        for (draw, texture) in wanted.into_iter().filter_map(|(draw, group)| Some((draw, group?))) {
            pass.set_bind_group(2, texture, &[]);
            if self.set_pipeline(&mut pass, draw) {
                pass.draw(0..4, 0..1);
            }
        }
    }

    fn draw_figures(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        scene: &Scene<'_>,
        chosen: impl Fn(&FigureView<'_>) -> bool,
    ) {
        pass.set_bind_group(2, &self.shadow.depth_group, &[]);
        for (i, view) in scene.figures.iter().enumerate().filter(|(_, v)| chosen(v)) {
            let two_sided = view.two_sided;
            let Some(paint) = paint_of(scene, view) else { continue };
            if !is_solid(view) {
                self.draw_skin(pass, Draw::Ghost { two_sided }, i, view);
            }
            self.draw_skin(pass, Draw::Figure { paint, two_sided }, i, view);
        }
    }

    /// Surfaces below lines and points.
    fn draw_marks(&self, pass: &mut wgpu::RenderPass<'_>) {
        for (buffer, seen, range) in self.balls.draws() {
            self.draw_buffer(pass, Draw::Balls(seen), buffer, 0..BALL_VERTICES, range);
        }
        for (buffer, seen, range) in self.fans.draws() {
            self.draw_buffer(pass, Draw::Fans(seen), buffer, range, 0..1);
        }
        for (buffer, seen, range) in self.strokes.draws() {
            self.draw_buffer(pass, Draw::Strokes(seen), buffer, 0..4, range);
        }
    }

    fn draw_buffer(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        draw: Draw,
        buffer: &wgpu::Buffer,
        vertices: Range<u32>,
        instances: Range<u32>,
    ) {
        if self.set_pipeline(pass, draw) {
            pass.set_vertex_buffer(0, buffer.slice(..));
            pass.draw(vertices, instances);
        }
    }

    fn draw_skin(&self, pass: &mut wgpu::RenderPass<'_>, draw: Draw, figure: usize, view: &FigureView<'_>) {
        let Some(body) = self.bodies.get(&view.skin) else { return };
        let parts = match draw {
            Draw::Figure { paint, .. } if paint.parts => Some(&body.parts),
            _ => None,
        };
        let skin = parts.and_then(Option::as_ref).map_or(&body.skin, |parts| &parts.skin);
        // An empty skin has no buffers to bind.
        if skin.index_count > 0 && self.set_pipeline(pass, draw) {
            pass.set_bind_group(1, &self.figures.group, &[Figures::offset(figure)]);
            pass.set_vertex_buffer(0, skin.vertices.slice(..));
            if !matches!(draw, Draw::Shadow { .. }) {
                pass.set_vertex_buffer(1, skin.surface.slice(..));
            }
            if let Some(Some(parts)) = parts {
                pass.set_vertex_buffer(2, parts.vertices.slice(..));
            }
            pass.set_index_buffer(skin.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..skin.index_count, 0, 0..1);
        }
    }

    fn set_pipeline(&self, pass: &mut wgpu::RenderPass<'_>, draw: Draw) -> bool {
        let pipeline = self.target.as_ref().and_then(|t| self.pipelines.get(draw, t.key.msaa));
        if let Some(pipeline) = pipeline {
            pass.set_pipeline(pipeline);
        }
        pipeline.is_some()
    }
}

fn is_solid(view: &FigureView<'_>) -> bool {
    view.opacity >= 1.0
}

/// How a pass paints a figure; `None` if figures aren't in it.
fn paint_of(scene: &Scene<'_>, view: &FigureView<'_>) -> Option<Paint> {
    match scene.pass {
        Pass::Color => {
            let (fragment, parts) = fragment_of(scene.look.style, scene.look.joint_planes);
            let marked = !(view.selected.is_empty() && view.hovered.is_empty());
            Some(Paint { fragment, parts, shadowed: scene.look.shadow && is_solid(view), marked })
        }
        Pass::Depth => Some(Paint::plain("fs_depth")),
        Pass::Normal => Some(Paint::plain("fs_normal")),
        Pass::Silhouette => Some(Paint::plain("fs_silhouette")),
        Pass::Parts => Some(Paint { parts: true, ..Paint::plain("fs_parts") }),
        Pass::OpenPose => None,
    }
}

/// The style's shader, and whether it needs a skin cut into parts.
fn fragment_of(style: Style, joint_planes: bool) -> (&'static str, bool) {
    match (style, joint_planes) {
        (Style::Studio, false) => ("fs_studio", false),
        (Style::Studio, true) => ("fs_studio_parts", true),
        (Style::Clay, false) => ("fs_clay", false),
        (Style::Clay, true) => ("fs_clay_parts", true),
        (Style::Matcap, false) => ("fs_matcap", false),
        (Style::Matcap, true) => ("fs_matcap_parts", true),
        (Style::Flat, _) => ("fs_flat", true),
        (Style::Line, _) => ("fs_line", false),
    }
}

fn clear_of(scene: &Scene<'_>) -> wgpu::Color {
    match scene.pass {
        Pass::Color => wgpu::Color::TRANSPARENT,
        Pass::Normal => wgpu::Color { r: 128.0 / 255.0, g: 128.0 / 255.0, b: 1.0, a: 1.0 },
        Pass::Depth | Pass::Silhouette | Pass::Parts | Pass::OpenPose => wgpu::Color::BLACK,
    }
}

fn depth_attachment(
    view: &wgpu::TextureView,
    store: wgpu::StoreOp,
) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store }),
        stencil_ops: None,
    }
}
