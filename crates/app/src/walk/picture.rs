//! The picture of a walker on its ground: its camera, which goes along, and what the pointer does to it.

use std::sync::Arc;

use edit::{Navigator, Preset, Sight, Step, ViewEvent};
use egui::{Align2, Color32, FontId, PointerButton, Pos2, Rect, Response, Sense, Ui, pos2, vec2};
use glam::{DVec3, Vec2, Vec3};
use render::Look;
use rig::{Bone, Bounds, Camera, Figure, Frames, Palette, Projection, View};

use super::marks::{Marks, Of};
use super::prints::Prints;
use super::stage::Moment;
use crate::finish::Finish;
use crate::picture::Underfoot;
use crate::theme;
use crate::viewport::axis_ball::{self, BallTurn};
use crate::viewport::drawing::{Drawing, write_words};
use crate::viewport::navigation::{self, WHEEL_REST_SECS};
use crate::viewport::pace::{Pace, Quality};
use crate::viewport::{Body, Part, Picture};

/// The camera catches up with the walker's place within about so long, seconds.
const LAG_SECS: f64 = 0.12;
/// A walker that is farther off has been set down elsewhere: the camera goes there at once, metres.
const FAR_M: f64 = 6.0;
/// The line between the two pictures, points.
const SEAM: f32 = 3.0;

/// How a walker is looked at.
#[derive(Clone, Debug)]
pub struct WalkPicture {
    /// Where it is seen from.
    pub camera: Camera,
    /// Whose habits looking around follows.
    pub preset: Preset,
    /// What the figure is made of and drawn with.
    pub finish: Finish,
    /// Whether the camera goes along with the walker.
    pub follows: bool,
    navigator: Navigator,
    rect: Rect,
    wheeled_at: f64,
    pace: Pace,
    drawn_in: Quality,
    slow: bool,
    unframed: bool,
    /// Where the walker was to which the camera has come, metres, world.
    followed: Option<DVec3>,
}

impl Default for WalkPicture {
    fn default() -> WalkPicture {
        WalkPicture {
            camera: Camera::default().seen_from(View::ThreeQuarter),
            preset: Preset::default(),
            finish: Finish::default(),
            follows: true,
            navigator: Navigator::default(),
            rect: Rect::from_min_size(Pos2::ZERO, vec2(1.0, 1.0)),
            wheeled_at: f64::NEG_INFINITY,
            pace: Pace::default(),
            drawn_in: Quality::Full,
            slow: false,
            unframed: true,
            followed: None,
        }
    }
}

/// One walker as it is shown.
pub struct Figured<'a> {
    /// As it is now.
    pub moment: &'a Moment,
    /// Its joints in the world.
    pub frames: &'a Frames,
    /// Where its feet stood.
    pub prints: &'a Prints,
    /// What stands above its picture; nothing if it is alone.
    pub title: Option<String>,
}

/// What the picture shows.
pub struct Shown<'a> {
    /// The figure.
    pub figure: &'a Arc<Figure>,
    /// One walker, or two side by side.
    pub walkers: &'a [Figured<'a>],
    /// The ground's piece around them, unless it is level at height 0.
    pub ground: Option<&'a Underfoot>,
    /// What is drawn over them.
    pub marks: Marks,
    /// Whether time runs.
    pub playing: bool,
    /// Whether the processor draws.
    pub slow: bool,
}

impl WalkPicture {
    /// Shows the picture in what is left of the window.
    pub fn show(&mut self, ui: &mut Ui, shown: &Shown) {
        let (id, rect) = (egui::Id::unique("walk picture"), ui.available_rect_before_wrap());
        ui.allocate_rect(rect, Sense::hover());
        self.rect = rect;
        if std::mem::take(&mut self.unframed) {
            self.frame(shown);
        }
        self.follow(ui, shown);
        let response = ui.interact(rect, id, Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, "Walking figure"));
        self.look_around(ui, &response);
        let quality = self.quality(ui, shown);
        for (slot, (walker, rect)) in shown.walkers.iter().zip(parts(rect, shown.walkers.len())).enumerate() {
            self.paint(ui, shown, walker, rect, quality, slot);
        }
        if shown.walkers.len() > 1 {
            let line = egui::Stroke::new(SEAM, theme::of(ui).bar);
            ui.painter().vline(rect.center().x, rect.y_range(), line);
        }
        match axis_ball::show(ui, rect, &self.camera) {
            Some(BallTurn::Orbit(yaw_rad, pitch_rad)) => self.camera.orbit(yaw_rad, pitch_rad),
            Some(BallTurn::Look(view)) if self.camera.is_at(view) => self.camera = self.camera.opposite(),
            Some(BallTurn::Look(view)) => self.look_from(view),
            None => {}
        }
    }

    /// Where the picture is, points.
    pub fn rect(&self) -> Rect {
        self.rect
    }

    /// How well the last frame drew it.
    pub fn drawn_in(&self) -> Quality {
        self.drawn_in
    }

    /// A frame in which it was drawn anew took so long.
    pub fn took(&mut self, now: f64, secs: f32) {
        self.pace.took(now, secs);
    }

    /// From a named side, with the same target and lens.
    pub fn look_from(&mut self, view: View) {
        self.camera = self.camera.seen_from(view);
    }

    /// Turns, nears or takes away the camera by one step.
    pub fn step(&mut self, step: Step) {
        step.apply(&mut self.camera);
    }

    /// The other projection.
    pub fn toggle_projection(&mut self) {
        self.camera.projection = match self.camera.projection {
            Projection::Perspective => Projection::Orthographic,
            Projection::Orthographic => Projection::Perspective,
        };
    }

    /// Brings the walker into the picture with the next frame.
    pub fn frame_all(&mut self) {
        self.unframed = true;
    }

    /// Where a point of the world is in the window, points; `None` behind the eye. Side by side, in the right one.
    pub fn window_of(&self, point_in_world: DVec3) -> Option<Pos2> {
        let sight = sight(&self.camera, self.rect);
        sight.pixel_of(point_in_world).map(|at| self.rect.min + vec2(at.x, at.y))
    }

    fn frame(&mut self, shown: &Shown) {
        let Some(walker) = shown.walkers.last() else { return };
        let joints = shown.figure.skeleton.joints();
        let tight = Bounds::of(joints.map(|joint| walker.frames[joint.bone].position.as_vec3()));
        // Room for a stride and for the ground around it.
        let wide = if shown.walkers.len() > 1 { 0.15 } else { 0.4 };
        let air = Vec3::new(wide, 0.15, wide) * (tight.max.y - tight.min.y).max(0.1) / 1.7;
        let width = self.rect.width() / shown.walkers.len().max(1) as f32;
        let bounds = Bounds { min: tight.min - air, max: tight.max + air };
        self.camera.frame(bounds, width / self.rect.height().max(1.0));
        self.followed = None;
    }

    /// Brings the camera nearer to where the walker is.
    fn follow(&mut self, ui: &Ui, shown: &Shown) {
        let Some(walker) = shown.walkers.last() else { return };
        // Hips bob with every step; what is followed is the place, and slowly the height.
        let at = walker.frames[Bone::Hips].position;
        let secs = f64::from(ui.input(|i| i.stable_dt)).min(0.1);
        let from = self.followed.filter(|from| from.distance(at) < FAR_M).unwrap_or(at);
        let share = 1.0 - (-secs / LAG_SECS).exp();
        let slow = 1.0 - (-secs / (6.0 * LAG_SECS)).exp();
        let to = from + (at - from) * DVec3::new(share, slow, share);
        let jump =
            self.followed.map_or(DVec3::ZERO, |former| if from == at { at - former } else { to - from });
        self.followed = Some(to);
        if self.follows && jump.is_finite() {
            self.camera.target += jump.as_vec3();
        }
    }

    fn look_around(&mut self, ui: &Ui, response: &Response) {
        let corner = self.rect.min;
        let inside = |at: Pos2| Vec2::new(at.x - corner.x, at.y - corner.y);
        for button in [PointerButton::Primary, PointerButton::Middle, PointerButton::Secondary] {
            let pressed =
                response.is_pointer_button_down_on() && ui.input(|i| i.pointer.button_pressed(button));
            if let Some(at) = ui.input(|i| i.pointer.interact_pos()).filter(|_| pressed) {
                let event = navigation::pressed(ui, button, inside(at), false);
                self.navigate(event);
            }
        }
        if let Some(motion) = self.navigator.motion().filter(|_| response.dragged()) {
            ui.ctx().set_cursor_icon(navigation::cursor(motion));
            let by = response.drag_delta();
            if by != egui::Vec2::ZERO {
                self.navigate(ViewEvent::Moved { by: Vec2::new(by.x, by.y) });
            }
        }
        if !ui.input(|i| i.pointer.any_down()) {
            self.navigate(ViewEvent::Released);
        }
        if let Some(at) = response.hover_pos().filter(|_| response.contains_pointer()) {
            for event in navigation::scrolled(ui, self.preset, inside(at)) {
                self.navigate(event);
                self.wheeled_at = ui.input(|i| i.time);
                ui.ctx().request_repaint_after_secs(WHEEL_REST_SECS as f32 + 0.02);
            }
        }
    }

    fn navigate(&mut self, event: ViewEvent) {
        let size = Vec2::new(self.rect.width(), self.rect.height());
        self.navigator.take(event, self.preset, &mut self.camera, size);
    }

    /// How well to draw now; asks for the picture in full once movement has come to rest.
    fn quality(&mut self, ui: &Ui, shown: &Shown) -> Quality {
        if self.slow != shown.slow {
            self.slow = shown.slow;
            self.pace = if shown.slow { Pace::slow() } else { Pace::default() };
        }
        let now = ui.input(|i| i.time);
        let moving =
            shown.playing || self.navigator.motion().is_some() || now - self.wheeled_at < WHEEL_REST_SECS;
        let quality = self.pace.quality(now, moving);
        if let Some(secs) = self.pace.rests_in(now).filter(|_| !moving) {
            ui.ctx().request_repaint_after_secs(secs as f32 + 0.01);
        }
        self.drawn_in = quality;
        quality
    }

    fn paint(&self, ui: &Ui, shown: &Shown, walker: &Figured, rect: Rect, quality: Quality, slot: usize) {
        let scale = ui.ctx().pixels_per_point();
        let mut drawing = Drawing::new(sight(&self.camera, rect), scale);
        let Figured { moment, frames, prints, .. } = *walker;
        Of { moment, frames, prints }.draw(&mut drawing, shown.marks);
        let Drawing { overlay, words, sight, .. } = drawing;
        let rest = crate::picture::rest_positions(shown.figure);
        let part = Part { palette: Palette::new(frames, &rest), selected: Vec::new(), hovered: Vec::new() };
        let look = self.finish.on(Look::default()).in_surroundings(!ui.visuals().dark_mode);
        let body = Body::Figure(shown.figure.clone());
        let picture = Picture::of(body, vec![part], self.camera, rect, scale, overlay, quality.of(look));
        let picture = picture.upon(shown.ground);
        let picture = if slot == 0 { picture } else { picture.in_second_slot() };
        ui.painter().add(egui_wgpu::Callback::new_paint_callback(rect, picture));
        write_words(ui.painter(), rect, &sight, &words);
        if let Some(title) = &walker.title {
            caption(ui, rect, title);
        }
    }
}

/// The rectangles of so many pictures side by side.
fn parts(rect: Rect, count: usize) -> Vec<Rect> {
    let width = rect.width() / count.max(1) as f32;
    let part = |i: usize| {
        let left = rect.left() + width * i as f32;
        Rect::from_min_max(pos2(left, rect.top()), pos2(left + width, rect.bottom()))
    };
    (0..count).map(part).collect()
}

fn sight(camera: &Camera, rect: Rect) -> Sight {
    Sight { camera: *camera, size_px: Vec2::new(rect.width(), rect.height()) }
}

/// Words at the top of a picture, on a dark ground.
fn caption(ui: &Ui, rect: Rect, words: &str) {
    let painter = ui.painter().with_clip_rect(rect);
    let mut at = rect.left_top() + vec2(14.0, 12.0);
    for (i, line) in words.lines().enumerate() {
        let size = if i == 0 { 14.0 } else { 12.5 };
        let text =
            painter.layout_no_wrap(line.to_owned(), FontId::proportional(size), Color32::from_gray(238));
        let place = Align2::LEFT_TOP.anchor_size(at, text.size()).expand2(vec2(6.0, 2.0));
        painter.rect_filled(place, 3.0, Color32::from_black_alpha(165));
        at.y = place.bottom() + 2.0;
        painter.galley(place.min + vec2(6.0, 2.0), text, Color32::WHITE);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_side_by_side_fill_the_room() {
        let whole = Rect::from_min_max(pos2(10.0, 20.0), pos2(410.0, 220.0));
        assert_eq!(parts(whole, 1), [whole]);
        let [left, right] = parts(whole, 2)[..] else { panic!("two") };
        assert!(left.right() == right.left() && left.union(right) == whole && left.width() == 200.0);
    }
}
