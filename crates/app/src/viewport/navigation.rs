//! Looking around in the picture: what the pointer does goes to the navigator; keys and buttons move the camera in steps.

use edit::{Button, Editor, Keys, Motion, Preset, Step, ViewEvent};
use egui::{CursorIcon, Event, MouseWheelUnit, PointerButton, Pos2, Ui};
use glam::{DVec3, Vec2};
use rig::{Bone, Projection, View};

use super::{Viewport, framed};

/// After the wheel stops for this long, the picture is drawn in full quality.
pub const WHEEL_REST_SECS: f64 = 0.2;
/// What a notch of a wheel counts as among the points that two fingers slide.
const POINTS_PER_LINE: f32 = 40.0;

impl Viewport {
    /// Goes along with a figure that has moved by so much, metres.
    pub fn go_along(&mut self, by: DVec3) {
        if by.is_finite() {
            self.camera.target += by.as_vec3();
        }
    }

    /// Seen from a named side, with the same target and lens.
    pub fn view(&mut self, view: View) {
        self.leave_picture_camera();
        self.camera = self.camera.seen_from(view);
    }

    /// Seen from the other side.
    pub fn view_opposite(&mut self) {
        self.leave_picture_camera();
        self.camera = self.camera.opposite();
    }

    /// From a named side, or from the opposite one if it is seen from there already.
    pub fn view_or_opposite(&mut self, view: View) {
        if self.camera.is_at(view) { self.view_opposite() } else { self.view(view) }
    }

    /// Turns, nears or takes away the camera by one step.
    pub fn step(&mut self, step: Step) {
        self.leave_picture_camera();
        step.apply(&mut self.camera);
    }

    /// Perspective or orthographic.
    pub fn set_projection(&mut self, projection: Projection) {
        self.leave_picture_camera();
        self.camera.projection = projection;
    }

    /// The other projection.
    pub fn toggle_projection(&mut self) {
        self.set_projection(match self.camera.projection {
            Projection::Perspective => Projection::Orthographic,
            Projection::Orthographic => Projection::Perspective,
        });
    }

    /// Brings the whole figure into the picture.
    pub fn frame_all(&mut self, editor: &Editor) {
        self.unframed = false;
        self.frame(editor, None);
    }

    /// Brings a bone into the picture, or the whole figure if there is none.
    pub fn frame(&mut self, editor: &Editor, bone: Option<Bone>) {
        self.leave_picture_camera();
        self.camera.frame(framed::bounds(editor, bone), self.aspect());
    }

    /// A button went down: whether the view takes the drag, which it does beside the figure and where the preset says so.
    pub(super) fn take_view(&mut self, ui: &Ui, button: PointerButton, at: Pos2, on_figure: bool) -> bool {
        self.navigate(pressed(ui, button, self.inside(at), on_figure))
    }

    /// Moves the view by what the pointer went in this frame.
    pub(super) fn drag_view(&mut self, ui: &Ui, by: egui::Vec2) {
        let Some(motion) = self.navigator.motion() else { return };
        ui.ctx().set_cursor_icon(cursor(motion));
        if by != egui::Vec2::ZERO {
            self.navigate(ViewEvent::Moved { by: Vec2::new(by.x, by.y) });
        }
    }

    /// Lets the view go.
    pub(super) fn let_view_go(&mut self) {
        self.navigate(ViewEvent::Released);
    }

    /// Wheel, two fingers and pinching, at a place of the window.
    pub(super) fn wheel(&mut self, ui: &Ui, at: Pos2) {
        for event in scrolled(ui, self.preset, self.inside(at)) {
            self.navigate(event);
            self.touch_wheel(ui);
        }
    }

    /// Remembers that the wheel moves the view now, and asks for a picture in full quality once it rests.
    pub(super) fn touch_wheel(&mut self, ui: &Ui) {
        self.wheeled_at = ui.input(|i| i.time);
        ui.ctx().request_repaint_after(std::time::Duration::from_secs_f64(WHEEL_REST_SECS + 0.02));
    }

    /// Whether the wheel moved the view just now.
    pub(super) fn is_wheeling(&self, ui: &Ui) -> bool {
        ui.input(|i| i.time) - self.wheeled_at < WHEEL_REST_SECS
    }

    fn navigate(&mut self, event: ViewEvent) -> bool {
        let moves = !matches!(event, ViewEvent::Pressed { .. } | ViewEvent::Released);
        if moves {
            self.leave_picture_camera();
        }
        let size = self.sight_here().size_px;
        let Some(side) = self.side_here() else {
            return self.navigator.take(event, self.preset, &mut self.camera, size);
        };
        let mut camera = side.camera;
        let taken = self.navigator.take(event, self.preset, &mut camera, size);
        self.follow_side(side.camera, camera);
        taken
    }
}

/// A press of a button at a place of the picture, for the navigator.
pub fn pressed(ui: &Ui, button: PointerButton, at: Vec2, on_figure: bool) -> ViewEvent {
    let button = match button {
        PointerButton::Primary => Button::Primary,
        PointerButton::Middle => Button::Middle,
        _ => Button::Secondary,
    };
    ViewEvent::Pressed { button, keys: keys(ui), at, on_figure }
}

/// What the pointer looks like during a motion of the view.
pub const fn cursor(motion: Motion) -> CursorIcon {
    match motion {
        Motion::Zoom => CursorIcon::ZoomIn,
        Motion::Orbit | Motion::Pan => CursorIcon::Move,
    }
}

/// What wheel, two fingers and pinching did in this frame at a place of the picture, for the navigator.
pub fn scrolled(ui: &Ui, preset: Preset, at: Vec2) -> Vec<ViewEvent> {
    let fingers = preset == Preset::Trackpad;
    let by = if fingers { raw_scroll(ui) } else { ui.input(|i| i.smooth_scroll_delta()) };
    let factor = ui.input(|i| i.zoom_delta());
    let pinched = (factor != 1.0).then_some(ViewEvent::Pinched { factor, at });
    // A wheel's sideways part, and what Shift makes of it, do nothing to a zoom.
    let wanted = by.y != 0.0 || fingers && by.x != 0.0;
    let scrolled = wanted.then(|| ViewEvent::Scrolled { by: Vec2::new(by.x, by.y), keys: keys(ui), at });
    pinched.into_iter().chain(scrolled).collect()
}

fn keys(ui: &Ui) -> Keys {
    ui.input(|i| Keys { shift: i.modifiers.shift, ctrl: i.modifiers.command, alt: i.modifiers.alt })
}

/// What two fingers did in both directions, before Shift makes egui scroll sideways; with Ctrl it is a pinch already.
fn raw_scroll(ui: &Ui) -> egui::Vec2 {
    let points = |event: &Event| match event {
        Event::MouseWheel { unit, delta, modifiers, .. } if !modifiers.command => Some(match unit {
            MouseWheelUnit::Point => *delta,
            MouseWheelUnit::Line | MouseWheelUnit::Page => *delta * POINTS_PER_LINE,
        }),
        _ => None,
    };
    ui.input(|i| i.events.iter().filter_map(points).fold(egui::Vec2::ZERO, |sum, by| sum + by))
}
