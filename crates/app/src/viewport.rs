//! The picture of the figure and what the pointer does in it.
//!
//! Empty space turns the view; a joint is chosen by a click; a limb's target is dragged in the plane of the view. Every
//! change of the pose leaves as a request.

mod marks;
mod pick;
mod picture;

use edit::{Editor, Request};
use egui::{Key, PointerButton, Pos2, Rect, Sense, Ui};
use glam::{DVec3, Vec2, Vec3};
use rig::{Bone, Camera, Limb, Projection, View};

use pick::Picked;
use picture::Picture;
pub use picture::install;

use crate::reaching::reach;
use crate::{labels, theme};

/// How the figure is looked at, and the gesture in the picture.
#[derive(Clone, Debug)]
pub struct Viewport {
    /// Where it is seen from.
    pub camera: Camera,
    /// Whether joints and targets are marked.
    pub marks: bool,
    /// Whether the camera still has to be fitted to the picture's shape.
    unframed: bool,
    /// What the pointer holds.
    held: Option<Held>,
    /// Where the picture was last, points.
    rect: Rect,
    /// When the wheel last turned, seconds of the context's clock.
    wheeled_at: f64,
}

/// What a drag in the picture moves.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Held {
    /// The view, turned about its target.
    Orbit,
    /// The view, slid.
    Pan,
    /// The target of a limb: where it was, and where the pointer took hold of it.
    Target { limb: Limb, first: DVec3, from: Vec2 },
}

/// What the picture asks for.
#[derive(Clone, Default, Debug)]
pub struct Asked {
    /// Changes of the pose.
    pub requests: Vec<Request>,
    /// A click: the bone that it chose, or none.
    pub chosen: Option<Option<Bone>>,
}

/// After the wheel stops for this long, the picture is drawn in full quality.
const WHEEL_REST_SECS: f64 = 0.2;
const ORBIT_RAD_PER_POINT: f32 = 0.008;

impl Default for Viewport {
    fn default() -> Viewport {
        let camera = Camera::default().seen_from(View::ThreeQuarter);
        Viewport {
            camera,
            marks: true,
            unframed: true,
            held: None,
            rect: Rect::from_min_size(Pos2::ZERO, egui::vec2(1.0, 1.0)),
            wheeled_at: f64::NEG_INFINITY,
        }
    }
}

impl Viewport {
    /// Shows the picture in what is left of the window.
    pub fn show(&mut self, ui: &mut Ui, editor: &Editor, selected: Option<Bone>, lean: bool) -> Asked {
        let (id, rect) = (egui::Id::unique("viewport"), ui.available_rect_before_wrap());
        ui.allocate_rect(rect, Sense::hover());
        self.rect = rect;
        if self.unframed {
            self.frame_all(editor);
        }
        let response = ui.interact(rect, id, Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, "Figure"));
        let mut asked = Asked::default();
        let hovered = response.hover_pos().and_then(|at| self.pick(editor, at));
        self.drag(ui, &response, editor, &mut asked);
        self.wheel(ui, &response);
        if response.clicked_by(PointerButton::Primary) {
            let picked = response.interact_pointer_pos().and_then(|at| self.pick(editor, at));
            asked.chosen = Some(picked.map(|picked| picked.bone(editor)));
        }
        let moving = lean && self.is_moving(ui, editor);
        self.paint(ui, editor, selected, moving);
        if let Some(picked) = hovered.filter(|_| self.held.is_none()) {
            self.paint_hovered(ui, editor, picked);
        }
        asked
    }

    /// Seen from a named side, with the same target and lens.
    pub fn view(&mut self, view: View) {
        self.camera = self.camera.seen_from(view);
    }

    /// Perspective or orthographic.
    pub fn set_projection(&mut self, projection: Projection) {
        self.camera.projection = projection;
    }

    /// Brings the whole figure into the picture.
    pub fn frame_all(&mut self, editor: &Editor) {
        self.unframed = false;
        self.camera.frame(pick::bounds(editor, None), self.aspect());
    }

    /// Brings a bone into the picture, or the whole figure if there is none.
    pub fn frame(&mut self, editor: &Editor, bone: Option<Bone>) {
        self.camera.frame(pick::bounds(editor, bone), self.aspect());
    }

    /// Fits the camera when the picture is next shown and its shape is known.
    pub fn frame_soon(&mut self) {
        self.unframed = true;
    }

    /// Where a point of the world is in the window, points; `None` behind the eye.
    pub fn window_of(&self, point_in_world: DVec3) -> Option<Pos2> {
        let pixel = self.camera.pixel_of(point_in_world.as_vec3(), self.size())?;
        Some(self.rect.min + egui::vec2(pixel.x, pixel.y))
    }

    /// Where the picture is, points.
    pub fn rect(&self) -> Rect {
        self.rect
    }

    fn aspect(&self) -> f32 {
        self.rect.width() / self.rect.height().max(1.0)
    }

    fn size(&self) -> Vec2 {
        Vec2::new(self.rect.width(), self.rect.height())
    }

    /// From the window's points to the picture's.
    fn inside(&self, at: Pos2) -> Vec2 {
        Vec2::new(at.x - self.rect.left(), at.y - self.rect.top())
    }

    fn pick(&self, editor: &Editor, at: Pos2) -> Option<Picked> {
        self.marks.then(|| pick::at(&self.camera, self.size(), editor, self.inside(at)))?
    }

    fn drag(&mut self, ui: &Ui, response: &egui::Response, editor: &Editor, asked: &mut Asked) {
        if response.drag_started() {
            self.held = Some(self.take_hold(ui, editor));
        }
        if !response.dragged() {
            self.held = None;
            return;
        }
        let delta = response.drag_delta();
        match self.held {
            Some(Held::Orbit) => {
                self.camera.orbit(-delta.x * ORBIT_RAD_PER_POINT, delta.y * ORBIT_RAD_PER_POINT);
            }
            Some(Held::Pan) => self.camera.pan(Vec2::new(delta.x, delta.y), self.rect.height()),
            Some(Held::Target { limb, first, from }) => {
                if let Some(at) = response.interact_pointer_pos().filter(|_| delta != egui::Vec2::ZERO) {
                    let goal = first + self.shift_at(first, self.inside(at) - from);
                    asked.requests.push(Request::Preview(reach(editor, limb, goal)));
                }
            }
            None => {}
        }
    }

    /// What lies under the place where the button went down.
    fn take_hold(&self, ui: &Ui, editor: &Editor) -> Held {
        let (shift, primary, origin) =
            ui.input(|i| (i.modifiers.shift, i.pointer.primary_down(), i.pointer.press_origin()));
        let picked = origin.filter(|_| primary && !shift).and_then(|at| self.pick(editor, at));
        match (picked, origin) {
            (Some(Picked::Target(limb)), Some(at)) => {
                let first = editor.evaluation().limbs[limb.index()].target;
                Held::Target { limb, first, from: self.inside(at) }
            }
            _ if shift => Held::Pan,
            _ => Held::Orbit,
        }
    }

    /// A shift in the picture as one in the world, in the plane of the view at that point's depth; metres.
    fn shift_at(&self, point: DVec3, shift: Vec2) -> DVec3 {
        let scale = self.camera.metres_per_pixel(point.as_vec3(), self.rect.height());
        let axes = self.camera.axes();
        ((axes.x_axis * shift.x - axes.y_axis * shift.y) * scale).as_dvec3()
    }

    fn wheel(&mut self, ui: &Ui, response: &egui::Response) {
        if !response.contains_pointer() {
            return;
        }
        let (scroll, pinch) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
        let factor = (-scroll * 0.0025).exp() / pinch;
        let Some(at) = response.hover_pos().filter(|_| factor != 1.0) else { return };
        self.camera.zoom(factor, self.under(at));
        self.wheeled_at = ui.input(|i| i.time);
        ui.ctx().request_repaint_after(std::time::Duration::from_secs_f64(WHEEL_REST_SECS + 0.02));
    }

    /// The point of the world under the pointer, in the plane of the view through the camera's target.
    fn under(&self, at: Pos2) -> Vec3 {
        let ray = self.camera.ray(self.inside(at), self.size());
        let toward = self.camera.axes().z_axis;
        let depth = (self.camera.target - ray.origin).dot(toward) / ray.direction.dot(toward);
        ray.origin + ray.direction * depth
    }

    fn is_moving(&self, ui: &Ui, editor: &Editor) -> bool {
        self.held.is_some() || editor.in_gesture() || ui.input(|i| i.time) - self.wheeled_at < WHEEL_REST_SECS
    }

    fn paint(&self, ui: &Ui, editor: &Editor, selected: Option<Bone>, lean: bool) {
        let scale = ui.ctx().pixels_per_point();
        let overlay = marks::of(editor, selected, self.marks, scale);
        let picture = Picture::new(editor, self.camera, self.rect, scale, overlay, selected, lean);
        ui.painter().add(egui_wgpu::Callback::new_paint_callback(self.rect, picture));
    }

    /// A ring and a name at what a click would choose.
    fn paint_hovered(&self, ui: &Ui, editor: &Editor, picked: Picked) {
        let Some(at) = self.window_of(picked.place(editor)) else { return };
        let painter = ui.painter().with_clip_rect(self.rect);
        painter.circle_stroke(at, 8.0, egui::Stroke::new(2.0, theme::ACCENT));
        let words = match picked {
            Picked::Joint(bone) => labels::full(bone),
            Picked::Target(limb) => format!("{} target", labels::limb(limb)),
        };
        let font = egui::FontId::proportional(12.5);
        let text = painter.layout_no_wrap(words, font, egui::Color32::WHITE);
        let place =
            Rect::from_min_size(at + egui::vec2(12.0, -9.0), text.size()).expand2(egui::vec2(5.0, 2.0));
        painter.rect_filled(place, 3.0, egui::Color32::from_black_alpha(190));
        painter.galley(place.min + egui::vec2(5.0, 2.0), text, egui::Color32::WHITE);
        ui.ctx().set_cursor_icon(egui::CursorIcon::PointingHand);
    }
}

/// Keys that change the view: number row and pad, Home, F.
pub fn keys(ui: &Ui, viewport: &mut Viewport, editor: &Editor, selected: Option<Bone>) {
    if ui.ctx().text_edit_focused() {
        return;
    }
    let views = [
        (Key::Num1, View::Front, View::Back),
        (Key::Num3, View::Left, View::Right),
        (Key::Num7, View::Top, View::Top),
    ];
    for (key, plain, opposite) in views {
        let (pressed, command) = ui.input(|i| (i.key_pressed(key), i.modifiers.command));
        if pressed {
            viewport.view(if command { opposite } else { plain });
        }
    }
    if ui.input(|i| i.key_pressed(Key::Home)) {
        viewport.frame_all(editor);
    }
    if ui.input(|i| i.key_pressed(Key::F)) {
        viewport.frame(editor, selected);
    }
}
