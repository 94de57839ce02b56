//! The ball of axes in the picture's corner: shows how the view is turned, turns it, and looks along an axis.

use egui::{
    Align2, Color32, FontId, Id, Painter, Pos2, Rect, Response, Role, Sense, Stroke, Ui, WidgetInfo, vec2,
};
use glam::Vec3;
use rig::{Camera, View};

use super::Viewport;

/// From the ball's centre to the middle of an end, points.
const ARM: f32 = 34.0;
const END: f32 = 9.0;
/// From the ball's centre to the picture's edges.
const INSET: f32 = 56.0;
const ORBIT_RAD_PER_POINT: f32 = 0.015;

/// One end of an axis.
struct End {
    axis: Vec3,
    view: View,
    letter: &'static str,
    words: &'static str,
    color: Color32,
}

const X: Color32 = Color32::from_rgb(236, 92, 84);
const Y: Color32 = Color32::from_rgb(126, 200, 92);
const Z: Color32 = Color32::from_rgb(88, 150, 246);

const ENDS: [End; 6] = [
    End { axis: Vec3::X, view: View::Left, letter: "X", words: "View from +X (left)", color: X },
    End { axis: Vec3::NEG_X, view: View::Right, letter: "", words: "View from -X (right)", color: X },
    End { axis: Vec3::Y, view: View::Top, letter: "Y", words: "View from +Y (top)", color: Y },
    End { axis: Vec3::NEG_Y, view: View::Bottom, letter: "", words: "View from -Y (bottom)", color: Y },
    End { axis: Vec3::Z, view: View::Front, letter: "Z", words: "View from +Z (front)", color: Z },
    End { axis: Vec3::NEG_Z, view: View::Back, letter: "", words: "View from -Z (back)", color: Z },
];

/// What was done to the ball.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum BallTurn {
    /// It was dragged: turns about the camera's target, radians.
    Orbit(f32, f32),
    /// An end was clicked.
    Look(View),
}

/// Shows the ball in a picture's corner: a drag on it turns the view, a click on an end looks from there. Pictures too small
/// for it have none.
pub fn show(ui: &mut Ui, rect: Rect, camera: &Camera) -> Option<BallTurn> {
    if rect.width() < 4.0 * INSET || rect.height() < 4.0 * INSET {
        return None;
    }
    let center = rect.right_top() + vec2(-INSET, INSET);
    let ball = ui.interact(
        Rect::from_center_size(center, egui::Vec2::splat(2.0 * (ARM + END + 2.0))),
        Id::unique("axis ball"),
        Sense::drag(),
    );
    ball.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Axis ball"));
    let by = ball.drag_delta() * ORBIT_RAD_PER_POINT;
    let mut turn = ball.dragged().then_some(BallTurn::Orbit(-by.x, by.y));
    let mut seen_from = *camera;
    if let Some(BallTurn::Orbit(yaw, pitch)) = turn {
        seen_from.orbit(yaw, pitch);
    }
    // The nearest end comes last: it lies before the others and takes the click.
    let mut ends = ENDS.map(|end| (seen(&seen_from, end.axis), end));
    ends.sort_by(|(a, _), (b, _)| a.z.total_cmp(&b.z));
    let responses = ends.each_ref().map(|(at, end)| interact(ui, center + in_window(*at), end));
    for (response, (_, end)) in responses.iter().zip(&ends) {
        if response.clicked() {
            turn = Some(BallTurn::Look(end.view));
        }
    }
    if turn.is_some() {
        ui.ctx().request_repaint();
    }
    let painter = ui.painter().with_clip_rect(rect);
    if ball.hovered() || ball.dragged() || responses.iter().any(Response::hovered) {
        painter.circle_filled(center, ARM + END + 5.0, veil(ui));
    }
    for ((at, end), response) in ends.iter().zip(&responses) {
        paint(&painter, ui, center, *at, end, response);
    }
    turn
}

impl Viewport {
    /// Shows the ball; a click on an end looks from there, or from the other side if that is so already.
    pub(super) fn axis_ball(&mut self, ui: &mut Ui) {
        match show(ui, self.rect, &self.camera) {
            Some(BallTurn::Orbit(yaw_rad, pitch_rad)) => {
                self.leave_picture_camera();
                self.camera.orbit(yaw_rad, pitch_rad);
            }
            Some(BallTurn::Look(view)) => self.view_or_opposite(view),
            None => {}
        }
    }
}

/// A direction of the world as the camera sees it: x right, y up, z to the viewer.
fn seen(camera: &Camera, axis: Vec3) -> Vec3 {
    camera.axes().transpose() * axis
}

fn in_window(at: Vec3) -> egui::Vec2 {
    vec2(at.x, -at.y) * ARM
}

fn interact(ui: &Ui, at: Pos2, end: &End) -> Response {
    let rect = Rect::from_center_size(at, egui::Vec2::splat(2.0 * END));
    let response = ui.interact(rect, Id::unique(("axis ball", end.words)), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, end.words));
    response.on_hover_text(end.words)
}

fn veil(ui: &Ui) -> Color32 {
    if ui.visuals().dark_mode { Color32::from_white_alpha(16) } else { Color32::from_black_alpha(18) }
}

fn paint(painter: &Painter, ui: &Ui, center: Pos2, at: Vec3, end: &End, response: &Response) {
    let place = center + in_window(at);
    // What points away is fainter, so that depth reads.
    let ground = if ui.visuals().dark_mode { Color32::from_gray(92) } else { Color32::from_gray(214) };
    let color = ground.lerp_to_gamma(end.color, 0.72 + 0.28 * at.z);
    let lit = response.hovered() || response.has_focus();
    if end.letter.is_empty() {
        painter.circle(place, END - 2.0, ground.gamma_multiply(0.55), Stroke::new(1.6, color));
    } else {
        let along = in_window(at);
        let stem = along * (1.0 - END / along.length().max(END));
        painter.line_segment([center, center + stem], Stroke::new(2.4, color));
        painter.circle_filled(place, END, color);
        let ink = Color32::from_black_alpha(220);
        painter.text(place, Align2::CENTER_CENTER, end.letter, FontId::proportional(12.0), ink);
    }
    if lit {
        let ring = if ui.visuals().dark_mode { Color32::WHITE } else { Color32::from_gray(30) };
        painter.circle_stroke(place, END + 1.5, Stroke::new(1.6, ring));
    }
}
