//! The passes of a picture: shadow, survey, figures with their marks, and surroundings.

use std::ops::Range;

use crate::bodies::Body;
use crate::figures::Figures;
use crate::paints::{casts, crowd_paint, has_ground, is_solid, paint_of};
use crate::recipe::{Draw, Paint};
use crate::renderer::Renderer;
use crate::scene::{FigureView, Msaa, Pass, Scene, Style};
use crate::surfaces::BALL_VERTICES;
use crate::survey::{Search, search_of};
use crate::target::Target;

/// Vertices of a rectangle, drawn as a strip.
const RECTANGLE: Range<u32> = 0..4;
/// Vertices of the backdrop's net, as in backdrop.wgsl.
const BACKDROP_VERTICES: Range<u32> = 0..6 * 20 * 14;

impl Renderer {
    pub(crate) fn record_shadow(&self, encoder: &mut wgpu::CommandEncoder, scene: &Scene<'_>) {
        let mut pass = self.depth_pass(encoder, "shadow", &self.shadow.depth, &[]);
        pass.set_bind_group(0, &self.scene_buffer.group, &[]);
        for (i, view) in scene.figures.iter().enumerate().filter(|(_, v)| casts(v)) {
            self.draw_skin(&mut pass, Draw::Shadow { two_sided: view.two_sided }, Msaa::One, i, view);
        }
        self.draw_crowds(&mut pass, Draw::CrowdShadow, Msaa::One, scene);
        drop(pass);
        let mut pass = self.texture_pass(
            encoder,
            "soft shadow",
            &self.shadow.soft,
            wgpu::LoadOp::Clear(wgpu::Color::WHITE),
        );
        pass.set_bind_group(0, &self.scene_buffer.group, &[]);
        pass.set_bind_group(1, &self.figures.group, &[0]);
        pass.set_bind_group(2, &self.shadow.depth_group, &[]);
        pass.set_bind_group(3, &self.shadow.nothing_group, &[]);
        self.cover(&mut pass, Draw::Soften, [self.shadow.soft_size; 2], RECTANGLE);
    }

    /// Depth and normals of all that is solid, then what is looked for in them.
    pub(crate) fn record_survey(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        scene: &Scene<'_>,
        search: Search,
    ) {
        let Some(survey) = &self.survey else { return };
        let normals = wgpu::RenderPassColorAttachment {
            view: &survey.normal,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        };
        let mut pass = self.depth_pass(encoder, "survey", &survey.depth, &[Some(normals)]);
        pass.set_bind_group(0, &self.survey_buffer.group, &[]);
        pass.set_bind_group(2, &self.shadow.depth_group, &[]);
        pass.set_bind_group(3, &self.shadow.nothing_group, &[]);
        for (i, view) in scene.figures.iter().enumerate().filter(|(_, v)| is_solid(v)) {
            let draw = Draw::Figure { paint: Paint::NORMAL, two_sided: view.two_sided };
            self.draw_skin(&mut pass, draw, Msaa::One, i, view);
        }
        self.draw_crowds(&mut pass, Draw::Crowd { paint: Paint::NORMAL }, Msaa::One, scene);
        if search == Search::Openness && self.shades_ground(scene) {
            self.cover(&mut pass, Draw::Contact, [0, 0], RECTANGLE);
        }
        drop(pass);
        let (draw, into) = match search {
            Search::Openness => (Draw::Openness, &survey.rough),
            Search::Lines => (Draw::Trace, &survey.found),
        };
        let mut pass = self.seen_pass(encoder, into, &survey.depth);
        pass.set_bind_group(0, &self.survey_buffer.group, &[]);
        pass.set_bind_group(2, &survey.seen_group, &[]);
        self.cover(&mut pass, draw, survey.size, RECTANGLE);
        drop(pass);
        if search == Search::Openness {
            let mut pass = self.seen_pass(encoder, &survey.found, &survey.depth);
            pass.set_bind_group(0, &self.survey_buffer.group, &[]);
            pass.set_bind_group(2, &survey.rough_group, &[]);
            self.cover(&mut pass, Draw::Smooth, survey.size, RECTANGLE);
        }
    }

    pub(crate) fn record_picture(&self, encoder: &mut wgpu::CommandEncoder, scene: &Scene<'_>) {
        let Some(target) = &self.target else { return };
        let mut pass =
            self.depth_pass(encoder, "picture", &target.depth, &[Some(target.color(clear_of(scene)))]);
        pass.set_bind_group(0, &self.scene_buffer.group, &[]);
        pass.set_bind_group(1, &self.figures.group, &[0]);
        pass.set_bind_group(3, self.found(scene), &[]);
        self.draw_figures(&mut pass, scene, target.key.msaa, is_solid);
        if let Some(paint) = crowd_paint(scene) {
            self.draw_crowds(&mut pass, Draw::Crowd { paint }, target.key.msaa, scene);
        }
        self.draw_figures(&mut pass, scene, target.key.msaa, |view| !is_solid(view));
        self.draw_marks(&mut pass, target.key.msaa);
        drop(pass);
        if scene.pass == Pass::Color {
            self.record_surroundings(encoder, target, scene);
        }
    }

    /// Outlines, grid, shadow and background, put under the resolved figures: nothing of theirs needs samples or depth.
    fn record_surroundings(&self, encoder: &mut wgpu::CommandEncoder, target: &Target, scene: &Scene<'_>) {
        let opaque = !scene.look.transparent;
        let occluded = search_of(scene).is_some();
        let soft = &self.shadow.soft_group;
        let image = self.backdrop.as_ref().filter(|_| opaque && scene.look.backdrop_opacity > 0.0);
        let drawn = scene.figures.iter().any(is_solid) || !scene.crowds.is_empty();
        let lines = drawn && search_of(scene) == Some(Search::Lines);
        let wanted = [
            (Draw::Ink, lines.then_some(soft)),
            (Draw::Grid, (scene.look.grid && opaque && !has_ground(scene)).then_some(soft)),
            (Draw::Shade { occluded }, self.shades_ground(scene).then_some(soft)),
            (Draw::Image, image.map(|image| &image.group)),
            (Draw::Backdrop, opaque.then_some(soft)),
        ];
        let mut pass = self.texture_pass(encoder, "surroundings", &target.view, wgpu::LoadOp::Load);
        pass.set_bind_group(0, &self.scene_buffer.group, &[]);
        pass.set_bind_group(3, self.found(scene), &[]);
        for (draw, texture) in wanted.into_iter().filter_map(|(draw, group)| Some((draw, group?))) {
            pass.set_bind_group(2, texture, &[]);
            let vertices = if draw == Draw::Backdrop { BACKDROP_VERTICES } else { RECTANGLE };
            self.cover(&mut pass, draw, target.key.size, vertices);
        }
    }

    /// Whether the ground shows a shadow.
    fn shades_ground(&self, scene: &Scene<'_>) -> bool {
        let above = scene.camera.eye().y > 0.0 && !has_ground(scene);
        above && scene.look.ground_shadow && scene.look.style != Style::Line && self.casts_shadow(scene)
    }

    /// What the survey found, if the scene wants one.
    fn found(&self, scene: &Scene<'_>) -> &wgpu::BindGroup {
        let survey = self.survey.as_ref().filter(|_| search_of(scene).is_some());
        survey.map_or(&self.shadow.nothing_group, |survey| &survey.found_group)
    }

    fn draw_figures(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        scene: &Scene<'_>,
        msaa: Msaa,
        chosen: impl Fn(&FigureView<'_>) -> bool,
    ) {
        pass.set_bind_group(2, &self.shadow.depth_group, &[]);
        for (i, view) in scene.figures.iter().enumerate().filter(|(_, v)| chosen(v)) {
            let two_sided = view.two_sided;
            let Some(paint) = paint_of(scene, view) else { continue };
            if !is_solid(view) {
                self.draw_skin(pass, Draw::Ghost { two_sided }, msaa, i, view);
            }
            self.draw_skin(pass, Draw::Figure { paint, two_sided }, msaa, i, view);
        }
    }

    /// Surfaces below lines and points.
    fn draw_marks(&self, pass: &mut wgpu::RenderPass<'_>, msaa: Msaa) {
        for (buffer, seen, range) in self.balls.draws() {
            self.draw_buffer(pass, (Draw::Balls(seen), msaa), buffer, 0..BALL_VERTICES, range);
        }
        for (buffer, seen, range) in self.fans.draws() {
            self.draw_buffer(pass, (Draw::Fans(seen), msaa), buffer, range, 0..1);
        }
        for (buffer, seen, range) in self.strokes.draws() {
            self.draw_buffer(pass, (Draw::Strokes(seen), msaa), buffer, RECTANGLE, range);
        }
    }

    fn draw_buffer(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        (draw, msaa): (Draw, Msaa),
        buffer: &wgpu::Buffer,
        vertices: Range<u32>,
        instances: Range<u32>,
    ) {
        if self.set_pipeline(pass, draw, msaa) {
            pass.set_vertex_buffer(0, buffer.slice(..));
            pass.draw(vertices, instances);
            self.counters.marks();
        }
    }

    fn draw_skin(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        draw: Draw,
        msaa: Msaa,
        figure: usize,
        view: &FigureView<'_>,
    ) {
        let Some(body) = self.bodies.get(&view.skin) else { return };
        pass.set_bind_group(1, &self.figures.group, &[Figures::offset(figure)]);
        self.draw_body(pass, (draw, msaa), body, 0..1);
    }

    /// Each crowd at once.
    fn draw_crowds(&self, pass: &mut wgpu::RenderPass<'_>, draw: Draw, msaa: Msaa, scene: &Scene<'_>) {
        for (i, view) in scene.crowds.iter().enumerate().filter(|(_, view)| view.count > 0) {
            let (Some(body), Some(group)) = (self.bodies.get(&view.skin), self.crowds.group(i)) else {
                continue;
            };
            pass.set_bind_group(1, group, &[]);
            self.draw_body(pass, (draw, msaa), body, 0..u32::try_from(view.count).unwrap_or(u32::MAX));
        }
    }

    /// A skin as often as there are instances, what moves it being bound.
    fn draw_body(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        (draw, msaa): (Draw, Msaa),
        body: &Body,
        instances: Range<u32>,
    ) {
        let parts = match draw {
            Draw::Figure { paint, .. } | Draw::Crowd { paint } if paint.parts => body.parts.as_ref(),
            _ => None,
        };
        let skin = parts.map_or(&body.skin, |parts| &parts.skin);
        // An empty skin has no buffers to bind.
        if skin.index_count == 0 || !self.set_pipeline(pass, draw, msaa) {
            return;
        }
        pass.set_vertex_buffer(0, skin.vertices.slice(..));
        if !matches!(draw, Draw::Shadow { .. } | Draw::CrowdShadow) {
            pass.set_vertex_buffer(1, skin.surface.slice(..));
        }
        if let Some(parts) = parts {
            pass.set_vertex_buffer(2, parts.vertices.slice(..));
        }
        pass.set_index_buffer(skin.indices.slice(..), wgpu::IndexFormat::Uint32);
        let drawn = u64::from(instances.end - instances.start);
        pass.draw_indexed(0..skin.index_count, 0, instances);
        self.counters.figures(drawn * u64::from(skin.index_count / 3));
    }

    /// Draws over a rectangle of at most that size.
    fn cover(&self, pass: &mut wgpu::RenderPass<'_>, draw: Draw, size: [u32; 2], vertices: Range<u32>) {
        if self.set_pipeline(pass, draw, Msaa::One) {
            pass.draw(vertices, 0..1);
            self.counters.cover(size);
        }
    }

    fn set_pipeline(&self, pass: &mut wgpu::RenderPass<'_>, draw: Draw, msaa: Msaa) -> bool {
        let pipeline = self.pipelines.get(draw, msaa);
        if let Some(pipeline) = pipeline {
            pass.set_pipeline(pipeline);
        }
        pipeline.is_some()
    }

    /// A pass that starts with an empty depth buffer and keeps it, unless it is the picture's.
    fn depth_pass<'e>(
        &self,
        encoder: &'e mut wgpu::CommandEncoder,
        label: &str,
        depth: &wgpu::TextureView,
        colors: &[Option<wgpu::RenderPassColorAttachment<'_>>],
    ) -> wgpu::RenderPass<'e> {
        self.counters.pass();
        let picture = self.target.as_ref().is_some_and(|target| target.depth == *depth);
        let store = if picture { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(label),
            color_attachments: colors,
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store }),
                stencil_ops: None,
            }),
            ..wgpu::RenderPassDescriptor::default()
        })
    }

    /// A pass over a texture, without depth.
    fn texture_pass<'e>(
        &self,
        encoder: &'e mut wgpu::CommandEncoder,
        label: &str,
        view: &wgpu::TextureView,
        load: wgpu::LoadOp<wgpu::Color>,
    ) -> wgpu::RenderPass<'e> {
        self.counters.pass();
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(label),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load, store: wgpu::StoreOp::Store },
            })],
            ..wgpu::RenderPassDescriptor::default()
        })
    }

    /// A pass over a survey, where anything is seen.
    fn seen_pass<'e>(
        &self,
        encoder: &'e mut wgpu::CommandEncoder,
        view: &wgpu::TextureView,
        depth: &wgpu::TextureView,
    ) -> wgpu::RenderPass<'e> {
        self.counters.pass();
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("survey"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: depth,
                depth_ops: None,
                stencil_ops: None,
            }),
            ..wgpu::RenderPassDescriptor::default()
        })
    }
}

fn clear_of(scene: &Scene<'_>) -> wgpu::Color {
    match scene.pass {
        Pass::Color => wgpu::Color::TRANSPARENT,
        Pass::Normal => wgpu::Color { r: 128.0 / 255.0, g: 128.0 / 255.0, b: 1.0, a: 1.0 },
        Pass::Depth | Pass::Silhouette | Pass::Parts | Pass::OpenPose => wgpu::Color::BLACK,
    }
}
