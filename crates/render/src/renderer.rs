//! The renderer: keeps what lives on the device and records one picture after another.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};

use glam::Vec3;
use rig::{Bounds, Mesh};

use crate::backdrop::BackdropImage;
use crate::bands::PIECE_EDGE;
use crate::bodies::Body;
use crate::crowd::{self, Crowds};
use crate::figures::Figures;
use crate::layered::{Layered, LayeredBuffer};
use crate::light::Light;
use crate::overlay::{self, Layer, Overlay, Stroke};
use crate::paints::{casts, crowd_paint, has_ground, is_solid, paint_of};
use crate::pipelines::Pipelines;
use crate::recipe::{Draw, Paint};
use crate::scene::{FigureView, Msaa, Pass, Scene, Style};
use crate::scene_buffer::SceneBuffer;
use crate::shadow::ShadowMaps;
use crate::stats::{Counters, Stats};
use crate::surfaces::{self, Corner, Shell};
use crate::survey::{self, Search, Survey};
use crate::target::{Target, TargetKey};
use crate::tile::Tile;
use crate::uniforms::{FigureUniform, SceneUniform};
use crate::{DrawError, Gpu, Image, openpose};

/// Draws scenes into its own texture.
///
/// Meshes are uploaded once by [`Renderer::set_mesh`]; a picture then uploads only palettes, camera and marks.
#[derive(Debug)]
pub struct Renderer {
    pub(crate) gpu: Gpu,
    pub(crate) pipelines: Pipelines,
    pub(crate) bodies: HashMap<usize, Body>,
    /// How many skins were set so far: tells whether what was drawn from them still holds.
    skins_set: u64,
    pub(crate) scene_buffer: SceneBuffer,
    pub(crate) figures: Figures,
    pub(crate) crowds: Crowds,
    pub(crate) shadow: ShadowMaps,
    /// What the shadow maps show.
    shadow_key: Option<u64>,
    pub(crate) survey: Option<Survey>,
    pub(crate) survey_buffer: SceneBuffer,
    /// What the survey shows.
    survey_key: Option<u64>,
    pub(crate) backdrop: Option<BackdropImage>,
    pub(crate) balls: LayeredBuffer<Shell>,
    pub(crate) fans: LayeredBuffer<Corner>,
    pub(crate) strokes: LayeredBuffer<Stroke>,
    pub(crate) target: Option<Target>,
    pub(crate) counters: Counters,
    piece_edge: u32,
}

impl Renderer {
    /// A renderer without meshes.
    pub fn new(gpu: &Gpu) -> Renderer {
        let device = &gpu.device;
        let pipelines = Pipelines::new(device);
        let layouts = &pipelines.layouts;
        Renderer {
            figures: Figures::new(device, &layouts.figure, 1),
            crowds: Crowds::default(),
            shadow: ShadowMaps::new(device, layouts),
            shadow_key: None,
            scene_buffer: SceneBuffer::new(device, layouts),
            survey: None,
            survey_buffer: SceneBuffer::new(device, layouts),
            survey_key: None,
            backdrop: None,
            balls: LayeredBuffer::new("balls"),
            fans: LayeredBuffer::new("fans"),
            strokes: LayeredBuffer::new("strokes"),
            gpu: gpu.clone(),
            pipelines,
            bodies: HashMap::new(),
            skins_set: 0,
            target: None,
            counters: Counters::default(),
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
        self.skins_set += 1;
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
        self.counters.reset();
        if !scene.crowds.is_empty() && self.pipelines.layouts.crowd.is_none() {
            self.pipelines.layouts.crowd = Some(crowd::layout(&self.gpu)?);
        }
        self.prepare_target(TargetKey::of(scene.pass, tile.size, scene.look.msaa));
        let light = self.light(scene);
        self.upload(scene, tile, &light);
        self.prepare_pipelines(scene);
        let shadow_key = light.casts.then(|| self.shadow_key(scene, &light));
        if light.casts {
            self.keep_shadow(encoder, scene, shadow_key);
        }
        if let Some(search) = survey::search_of(scene) {
            self.keep_survey(encoder, scene, tile.whole, search, &light, shadow_key);
        }
        self.record_picture(encoder, scene);
        self.picture_view().ok_or_else(|| DrawError::Driver("the picture's texture is gone".to_owned()))
    }

    /// What the last picture cost.
    pub fn stats(&self) -> Stats {
        self.counters.stats()
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
        for (crowd, view) in scene.crowds.iter().enumerate() {
            view.check(crowd, &self.gpu.device.limits())?;
            if !self.bodies.contains_key(&view.skin) {
                return Err(DrawError::CrowdNoSkin { crowd, skin: view.skin });
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

    /// Corners of the boxes around the crowds' seen parts.
    fn crowd_corners(&self, scene: &Scene<'_>) -> Vec<Vec3> {
        let aspect = scene.size[0] as f32 / scene.size[1].max(1) as f32;
        let clip_from_world = scene.camera.clip_from_world(aspect);
        let seen = scene.crowds.iter().filter_map(|view| Some((view, self.bodies.get(&view.skin)?)));
        let boxes = seen.map(|(view, body)| view.bounds(body.at_rest, clip_from_world));
        boxes.filter(|bounds| !bounds.is_empty()).flat_map(|bounds| bounds.corners()).collect()
    }

    pub(crate) fn casts_shadow(&self, scene: &Scene<'_>) -> bool {
        let look = &scene.look;
        let falls = look.ground_shadow || has_ground(scene);
        let seen = look.style != Style::Line && (look.style != Style::Matcap || falls);
        scene.pass == Pass::Color
            && look.shadow
            && seen
            && (!scene.crowds.is_empty() || scene.figures.iter().any(casts))
    }

    fn light(&self, scene: &Scene<'_>) -> Light {
        let wanted = self.casts_shadow(scene);
        let casting: Vec<FigureView<'_>> = scene.figures.iter().copied().filter(casts).collect();
        let corners: Vec<Vec3> = self.corners(&casting).chain(self.crowd_corners(scene)).collect();
        Light::fit(scene.look.key_light, &corners, wanted, !scene.look.ambient_occlusion)
    }

    fn uniform(&self, scene: &Scene<'_>, tile: Tile, light: &Light) -> SceneUniform {
        let chosen = |wanted: &dyn Fn(&FigureView<'_>) -> bool| -> Vec<FigureView<'_>> {
            scene.figures.iter().copied().filter(|view| wanted(view)).collect()
        };
        let view = scene.camera.view_from_world();
        let bodies = chosen(&|view| !view.ground);
        // A picture of depth tells figures apart; a survey finds the ground as well.
        let ranged = if scene.pass == Pass::Depth { &bodies } else { scene.figures };
        let crowds = self.crowd_corners(scene);
        let depths = self.corners(ranged).chain(crowds.iter().copied()).map(|c| -view.transform_point3(c).z);
        let range = depths.fold([f32::MAX, f32::MIN], |[near, far], d| [near.min(d), far.max(d)]);
        let lowest =
            self.corners(&bodies).chain(crowds.iter().copied()).map(|c| c.y).fold(f32::INFINITY, f32::min);
        let floor = if has_ground(scene) && lowest.is_finite() { lowest } else { 0.0 };
        let solid = chosen(&is_solid);
        SceneUniform::of(scene, tile, light, range)
            .with_silhouette(self.corners(&solid).chain(crowds))
            .on_floor(floor)
    }

    /// Writes all that changed since the last picture.
    fn upload(&mut self, scene: &Scene<'_>, tile: Tile, light: &Light) {
        let uniform = self.uniform(scene, tile, light);
        let uniform = if scene.pass == Pass::OpenPose { uniform.flat(tile) } else { uniform };
        self.counters.upload(self.scene_buffer.write(&self.gpu, &uniform));
        let layout = &self.pipelines.layouts.figure;
        self.counters.upload(self.figures.write(&self.gpu, layout, scene.figures));
        if let Some(layout) = &self.pipelines.layouts.crowd {
            self.counters.upload(self.crowds.write(&self.gpu, layout, scene.crowds));
        }
        self.upload_marks(scene, tile.whole);
    }

    /// What the shadow maps depend on.
    fn shadow_key(&self, scene: &Scene<'_>, light: &Light) -> u64 {
        let mut hasher = DefaultHasher::new();
        self.skins_set.hash(&mut hasher);
        light.shadow_from_world.to_cols_array().map(f32::to_bits).hash(&mut hasher);
        light.footprint.map(f32::to_bits).hash(&mut hasher);
        light.size.hash(&mut hasher);
        for view in scene.figures.iter().filter(|view| casts(view)) {
            (view.skin, view.two_sided).hash(&mut hasher);
            let unmarked = FigureView { selected: &[], hovered: &[], ..*view };
            bytemuck::bytes_of(&FigureUniform::of(&unmarked)).hash(&mut hasher);
        }
        hasher.finish()
    }

    /// Draws the shadow maps, unless they show that already. Crowds move, so what they are in is drawn anew.
    fn keep_shadow(&mut self, encoder: &mut wgpu::CommandEncoder, scene: &Scene<'_>, key: Option<u64>) {
        if self.shadow_key == key && scene.crowds.is_empty() {
            return self.counters.kept(2);
        }
        self.record_shadow(encoder, scene);
        self.shadow_key = key.filter(|_| scene.crowds.is_empty());
    }

    /// Surveys the whole picture, unless that has been done.
    fn keep_survey(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &Scene<'_>,
        whole: [u32; 2],
        search: Search,
        light: &Light,
        shadow_key: Option<u64>,
    ) {
        let tile = survey::tile_of(search, whole);
        let uniform = self.uniform(scene, tile, light);
        let mut hasher = DefaultHasher::new();
        (search, shadow_key.unwrap_or_else(|| self.shadow_key(scene, light))).hash(&mut hasher);
        bytemuck::bytes_of(&uniform.without_tints()).hash(&mut hasher);
        let key = Some(hasher.finish());
        if self.survey_key == key && scene.crowds.is_empty() {
            return self.counters.kept(3);
        }
        if self.survey.as_ref().is_none_or(|survey| (survey.search, survey.size) != (search, tile.size)) {
            self.survey = None;
            let layouts = &self.pipelines.layouts;
            self.survey = Some(Survey::new(&self.gpu.device, layouts, &self.shadow.depth, search, tile.size));
        }
        self.counters.upload(self.survey_buffer.write(&self.gpu, &uniform));
        self.record_survey(encoder, scene, search);
        self.survey_key = key.filter(|_| scene.crowds.is_empty());
    }

    fn upload_marks(&mut self, scene: &Scene<'_>, size: [u32; 2]) {
        let strokes = match scene.pass {
            Pass::OpenPose => openpose::strokes(scene, size).into_iter().map(|s| (Layer::OnTop, s)).collect(),
            Pass::Color => overlay::strokes(scene.overlay, size[0] as f32 / scene.size[0] as f32),
            _ => Layered::default(),
        };
        let seen = if scene.pass == Pass::Color { scene.overlay } else { &Overlay::EMPTY };
        self.counters.upload(self.balls.write(&self.gpu, &surfaces::shells(seen)));
        self.counters.upload(self.fans.write(&self.gpu, &surfaces::corners(seen)));
        self.counters.upload(self.strokes.write(&self.gpu, &strokes));
    }

    fn prepare_pipelines(&mut self, scene: &Scene<'_>) {
        let Some(msaa) = self.target.as_ref().map(|t| t.key.msaa) else { return };
        let mut draws = Vec::new();
        draws.extend(self.balls.draws().map(|(_, seen, _)| Draw::Balls(seen)));
        draws.extend(self.fans.draws().map(|(_, seen, _)| Draw::Fans(seen)));
        draws.extend(self.strokes.draws().map(|(_, seen, _)| Draw::Strokes(seen)));
        for view in scene.figures {
            let two_sided = view.two_sided;
            let Some(paint) = paint_of(scene, view) else { continue };
            draws.push(Draw::Figure { paint, two_sided });
            if !is_solid(view) {
                draws.push(Draw::Ghost { two_sided });
            }
            if let Some(body) = self.bodies.get_mut(&view.skin).filter(|_| paint.parts) {
                body.cut(&self.gpu.device);
            }
        }
        if let Some(paint) = crowd_paint(scene).filter(|_| !scene.crowds.is_empty()) {
            draws.push(Draw::Crowd { paint });
            for view in scene.crowds.iter().filter(|_| paint.parts) {
                if let Some(body) = self.bodies.get_mut(&view.skin) {
                    body.cut(&self.gpu.device);
                }
            }
        }
        for draw in draws {
            self.pipelines.prepare(&self.gpu.device, draw, msaa);
        }
        self.prepare_helpers(scene);
    }

    /// What shadow, survey and surroundings draw with, one sample a pixel.
    fn prepare_helpers(&mut self, scene: &Scene<'_>) {
        let occluded = survey::search_of(scene).is_some();
        let mut draws = Vec::new();
        if scene.pass == Pass::Color {
            draws = vec![Draw::Ink, Draw::Backdrop, Draw::Image, Draw::Grid, Draw::Shade { occluded }];
        }
        for two_sided in scene.figures.iter().filter(|view| is_solid(view)).map(|view| view.two_sided) {
            if self.casts_shadow(scene) {
                draws.extend([Draw::Shadow { two_sided }, Draw::Soften]);
            }
            draws.push(Draw::Figure { paint: Paint::NORMAL, two_sided });
        }
        if !scene.crowds.is_empty() {
            draws.extend([Draw::CrowdShadow, Draw::Soften, Draw::Crowd { paint: Paint::NORMAL }]);
        }
        match survey::search_of(scene) {
            Some(Search::Openness) => draws.extend([Draw::Contact, Draw::Openness, Draw::Smooth]),
            Some(Search::Lines) => draws.push(Draw::Trace),
            None => draws.retain(|draw| !matches!(draw, Draw::Figure { .. } | Draw::Crowd { .. })),
        }
        for draw in draws {
            self.pipelines.prepare(&self.gpu.device, draw, Msaa::One);
        }
    }
}
