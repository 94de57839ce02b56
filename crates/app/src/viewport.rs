//! The picture of the figure and what the pointer does in it.
//!
//! The figure is grabbed by its skin or by a limb's target and dragged; empty space turns the view; a click chooses a
//! joint. Every change of the pose leaves as a request.

mod grip;
mod marks;
mod pick;
mod picture;
mod skin;

use edit::{Axis, Choose, Constraint, Editor, Hit, Request, Selection};
use egui::{CursorIcon, Event, Key, Modifiers, PointerButton, Pos2, Rect, Sense, Ui};
use glam::{DVec3, Vec2, Vec3};
use rig::{Bone, Camera, Projection, Ray, View};

use grip::Grip;
use pick::Picked;
use picture::Picture;
pub use picture::install;
use skin::Skin;

use crate::panels::way_of_click;
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
    /// The bone whose skin lights up.
    hovered: Option<Bone>,
    /// The bone to which a panel points.
    hinted: Option<Bone>,
    /// The figure's skin, ready for picking.
    skin: Option<Skin>,
    /// Where the picture was last, points.
    rect: Rect,
    /// When the wheel last turned, seconds of the context's clock.
    wheeled_at: f64,
}

/// What a drag in the picture moves.
#[derive(Clone, Debug)]
enum Held {
    /// The view, turned about its target.
    Orbit,
    /// The view, slid.
    Pan,
    /// A part of the figure, or a limb's target.
    Figure(Box<Grip>),
    /// Nothing any more: the drag was taken back, and the button is still down.
    Nothing,
}

/// What the picture asks for.
#[derive(Clone, Default, Debug)]
pub struct Asked {
    /// Changes of the pose.
    pub requests: Vec<Request>,
    /// A click: what it chooses.
    pub chosen: Option<Choose>,
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
            hovered: None,
            hinted: None,
            skin: None,
            rect: Rect::from_min_size(Pos2::ZERO, egui::vec2(1.0, 1.0)),
            wheeled_at: f64::NEG_INFINITY,
        }
    }
}

impl Viewport {
    /// Shows the picture in what is left of the window.
    pub fn show(&mut self, ui: &mut Ui, editor: &Editor, selection: &Selection, lean: bool) -> Asked {
        let (id, rect) = (egui::Id::unique("viewport"), ui.available_rect_before_wrap());
        ui.allocate_rect(rect, Sense::hover());
        self.rect = rect;
        if self.unframed {
            self.frame_all(editor);
        }
        let response = ui.interact(rect, id, Sense::click_and_drag());
        response.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Canvas, true, "Figure"));
        let mut asked = Asked::default();
        self.drag(ui, &response, editor, &mut asked);
        self.wheel(ui, &response);
        if response.clicked_by(PointerButton::Primary) {
            let bone = response.interact_pointer_pos().and_then(|at| self.clicked(editor, at));
            asked.chosen = Some(bone.map_or(Choose::None, |bone| way_of_click(ui, bone)));
        }
        let mark = response.hover_pos().filter(|_| self.held.is_none()).and_then(|at| self.pick(editor, at));
        self.light_up(ui, editor, response.hover_pos(), mark);
        let moving = lean && self.is_moving(ui, editor);
        self.paint(ui, editor, selection, moving);
        if let Some(picked) = mark {
            self.paint_hovered(ui, editor, picked);
        }
        asked
    }

    /// The bone whose skin is lit: the one under the pointer, or the one that is dragged.
    pub fn hovered(&self) -> Option<Bone> {
        self.hovered
    }

    /// Lights up a bone's skin while the pointer is on its name in a panel.
    pub fn hint(&mut self, bone: Option<Bone>) {
        self.hinted = bone;
    }

    /// What a drag of the figure is doing and which keys change it; `None` while there is none.
    pub fn telling(&self) -> Option<String> {
        match &self.held {
            Some(Held::Figure(grip)) => Some(grip.telling()),
            _ => None,
        }
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

    fn ray(&self, at: Pos2) -> Ray {
        self.camera.ray(self.inside(at), self.size())
    }

    fn hit(&mut self, editor: &Editor, at: Pos2) -> Option<Hit> {
        let ray = self.ray(at);
        Skin::follow(&mut self.skin, editor).hit(editor, ray)
    }

    /// The bone that a click chooses: that of the mark there, or of the skin.
    fn clicked(&mut self, editor: &Editor, at: Pos2) -> Option<Bone> {
        let marked = self.pick(editor, at).map(|picked| picked.bone(editor));
        marked.or_else(|| self.hit(editor, at).map(|hit| hit.bone))
    }

    /// Finds the bone whose skin a drag from here would take, or has taken.
    fn light_up(&mut self, ui: &Ui, editor: &Editor, at: Option<Pos2>, mark: Option<Picked>) {
        self.hovered = match (&self.held, mark) {
            (Some(Held::Figure(grip)), _) => {
                ui.ctx().set_cursor_icon(CursorIcon::Grabbing);
                grip.bone()
            }
            (Some(_), _) | (None, Some(Picked::Target(_))) => None,
            (None, _) => {
                let bone = at.and_then(|at| self.hit(editor, at)).map(|hit| hit.bone);
                if bone.is_some() {
                    ui.ctx().set_cursor_icon(CursorIcon::Grab);
                }
                bone
            }
        };
    }

    fn drag(&mut self, ui: &Ui, response: &egui::Response, editor: &Editor, asked: &mut Asked) {
        let before = self.telling();
        if response.drag_started() {
            self.held = Some(self.take_hold(ui, editor));
        }
        if !response.dragged() {
            self.held = None;
        }
        let delta = response.drag_delta();
        match &mut self.held {
            Some(Held::Orbit) => {
                self.camera.orbit(-delta.x * ORBIT_RAD_PER_POINT, delta.y * ORBIT_RAD_PER_POINT);
            }
            Some(Held::Pan) => self.camera.pan(Vec2::new(delta.x, delta.y), self.rect.height()),
            Some(Held::Figure(_)) => {
                asked.requests.extend(self.drag_figure(ui, editor, response.interact_pointer_pos()));
            }
            Some(Held::Nothing) | None => {}
        }
        if self.telling() != before {
            // The status line has been drawn already.
            ui.ctx().request_repaint();
        }
    }

    fn drag_figure(&mut self, ui: &Ui, editor: &Editor, at: Option<Pos2>) -> Option<Request> {
        let ray = self.ray(at?);
        let Some(Held::Figure(grip)) = &mut self.held else { return None };
        let cancelled = ui.input(|i| i.pointer.button_pressed(PointerButton::Secondary));
        if cancelled || grip.is_over(editor) {
            self.held = Some(Held::Nothing);
            return cancelled.then_some(Request::Cancel);
        }
        for constraint in constraints(ui) {
            grip.toggle(constraint);
        }
        let Modifiers { shift, command, .. } = ui.input(|i| i.modifiers);
        grip.follow(editor, ray, edit::Modifiers { slow: shift, snap: command })
    }

    /// What lies under the place where the button went down: a target comes before the skin, the skin before space.
    fn take_hold(&mut self, ui: &Ui, editor: &Editor) -> Held {
        let (shift, primary, origin) =
            ui.input(|i| (i.modifiers.shift, i.pointer.primary_down(), i.pointer.press_origin()));
        if shift {
            return Held::Pan;
        }
        let Some(at) = origin.filter(|_| primary) else { return Held::Orbit };
        let (camera, ray) = (self.camera, self.ray(at));
        if let Some(Picked::Target(limb)) = self.pick(editor, at) {
            return Held::Figure(Box::new(Grip::of_target(editor, limb, &camera, ray)));
        }
        match self.hit(editor, at) {
            Some(hit) => Held::Figure(Box::new(Grip::of_skin(editor, &hit, &camera, ray))),
            None => Held::Orbit,
        }
    }

    fn wheel(&mut self, ui: &Ui, response: &egui::Response) {
        // A dragged point is where the pointer is only as long as the camera stays.
        if !response.contains_pointer() || matches!(self.held, Some(Held::Figure(_))) {
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
        let ray = self.ray(at);
        let toward = self.camera.axes().z_axis;
        let depth = (self.camera.target - ray.origin).dot(toward) / ray.direction.dot(toward);
        ray.origin + ray.direction * depth
    }

    fn is_moving(&self, ui: &Ui, editor: &Editor) -> bool {
        self.held.is_some() || editor.in_gesture() || ui.input(|i| i.time) - self.wheeled_at < WHEEL_REST_SECS
    }

    fn paint(&self, ui: &Ui, editor: &Editor, selection: &Selection, lean: bool) {
        let scale = ui.ctx().pixels_per_point();
        let mut overlay = marks::of(editor, selection, self.marks, scale);
        if let Some(Held::Figure(grip)) = &self.held {
            let (first, axes) = grip.guides();
            marks::guides(&mut overlay, first, &axes, self.camera.distance, scale);
        }
        let lit = picture::Lit { selected: selection.bones(), hovered: self.hovered.or(self.hinted) };
        let picture = Picture::new(editor, self.camera, self.rect, scale, overlay, lit, lean);
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
        ui.ctx().set_cursor_icon(CursorIcon::PointingHand);
    }
}

/// Axes and planes whose keys were pressed in this frame; a key that repeats counts once.
fn constraints(ui: &Ui) -> Vec<Constraint> {
    let constraint = |event: &Event| {
        let Event::Key { key, pressed: true, repeat: false, modifiers, .. } = event else { return None };
        let axis = match key {
            Key::X => Axis::X,
            Key::Y => Axis::Y,
            Key::Z => Axis::Z,
            _ => return None,
        };
        Some(if modifiers.shift { Constraint::Across(axis) } else { Constraint::Along(axis) })
    };
    ui.input(|i| i.events.iter().filter_map(constraint).collect())
}

/// Keys that change the view: number row and pad, Home, F.
pub fn keys(ui: &Ui, viewport: &mut Viewport, editor: &Editor, selected: Option<Bone>) {
    if ui.ctx().text_edit_focused() || viewport.telling().is_some() {
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
