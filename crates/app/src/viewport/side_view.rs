//! A second, small picture of the same figure, seen from 90° to the side, so that depth needs no turn of the view.

use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};

use edit::{Editor, Selection, Sight, Stage};
use egui::{Align2, FontId, Id, Pos2, Rect, Response, Role, Sense, Stroke, StrokeKind, Ui, WidgetInfo, vec2};
use glam::{DVec3, Vec2};
use rig::{Camera, Projection};

use super::drawing::Drawing;
use super::pace::Quality;
use super::picture::{Lit, Picture};
use super::{Viewport, guides, handles, marks};

/// Its width among the picture's, and its height among its width.
const SHARE: f32 = 0.28;
const SHAPE: f32 = 1.05;
const INSET: f32 = 12.0;
const TITLE: f32 = 22.0;
/// From so far to the figure's left on, the small picture is seen from its right.
const LEAST_YAW_RAD: f32 = 0.26;

/// The small picture: where it is, and which camera it has.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Side {
    /// Points.
    pub rect: Rect,
    /// At right angles to the main one.
    pub camera: Camera,
}

impl Side {
    fn sight(&self) -> Sight {
        Sight { camera: self.camera, size_px: Vec2::new(self.rect.width(), self.rect.height()) }
    }
}

impl Viewport {
    /// The small picture, if it is shown and there is room for it.
    pub(super) fn side(&self) -> Option<Side> {
        let width = self.rect.width() * SHARE;
        let height = (width * SHAPE).min(self.rect.height() * 0.5);
        if !self.side_view || width < 120.0 || height < 120.0 {
            return None;
        }
        let corner = self.rect.right_bottom() - egui::Vec2::splat(INSET);
        let rect = Rect::from_min_max(corner - vec2(width, height), corner);
        Some(Side { rect, camera: side_camera(&self.camera) })
    }

    /// Where a point of the world is in the second picture, points of the window; `None` if that isn't shown.
    pub fn second_window_of(&self, point_in_world: DVec3) -> Option<Pos2> {
        let side = self.side()?;
        let at = side.sight().pixel_of(point_in_world)?;
        Some(side.rect.min + vec2(at.x, at.y))
    }

    /// What the pointer does in the small picture, if it is there or began to drag there.
    pub(super) fn pane(&mut self, ui: &Ui) -> Option<Response> {
        let side = self.side();
        let response = side.map(|side| {
            let response = ui.interact(side.rect, Id::unique("second view"), Sense::click_and_drag());
            response.widget_info(|| WidgetInfo::labeled(Role::Canvas, true, "Second view"));
            response
        });
        let busy = self.hands.holds() || self.navigator.motion().is_some();
        if !busy {
            self.in_side = response.as_ref().is_some_and(Response::contains_pointer);
        }
        response.filter(|_| self.in_side)
    }

    /// The small picture, if the pointer is there.
    pub(super) fn side_here(&self) -> Option<Side> {
        self.side().filter(|_| self.in_side)
    }

    /// The picture in which the pointer is, points.
    pub(super) fn rect_here(&self) -> Rect {
        self.side_here().map_or(self.rect, |side| side.rect)
    }

    /// What the pointer sees the figure through.
    pub(super) fn sight_here(&self) -> Sight {
        self.side_here().map_or(self.sight(), |side| side.sight())
    }

    /// Moves the main camera as the one at its side was moved; that one stays level.
    pub(super) fn follow_side(&mut self, was: Camera, is: Camera) {
        self.camera.orbit(is.yaw_rad - was.yaw_rad, 0.0);
        self.camera.target = is.target;
        self.camera.distance = is.distance;
    }

    /// Paints the small picture with its frame and title, and closes it when asked.
    pub(super) fn paint_side(&mut self, ui: &Ui, editor: &Editor, selection: &Selection, quality: Quality) {
        let Some(side) = self.side() else { return };
        let scale = ui.ctx().pixels_per_point();
        let hovered = self.hovered().or(self.hinted);
        let mut drawing = Drawing::new(side.sight(), scale);
        marks::draw(&mut drawing, editor, selection, hovered.as_slice(), self.marks);
        guides::draw(&mut drawing, editor, &self.guides);
        let lit = Lit { selected: selection.bones(), hovered };
        let look = quality.of(self.look(ui));
        let picture = Picture::new(editor, side.camera, side.rect, scale, drawing.overlay, lit, look);
        let picture = picture.upon(self.ground.as_ref()).in_second_slot();
        let painter = ui.painter();
        painter.add(egui_wgpu::Callback::new_paint_callback(side.rect, picture));
        let stage = Stage { sight: side.sight(), ..self.stage(editor, selection.active()) };
        handles::paint(ui, &self.hands, &stage, side.rect);
        let edge = ui.visuals().window_stroke.color;
        painter.rect_stroke(side.rect, 2.0, Stroke::new(1.0, edge), StrokeKind::Outside);
        let title = Rect::from_min_size(side.rect.min, vec2(side.rect.width(), TITLE));
        painter.rect_filled(title, 0.0, ui.visuals().window_fill.gamma_multiply(0.85));
        let at = title.left_center() + vec2(8.0, 0.0);
        let font = FontId::proportional(12.0);
        painter.text(at, Align2::LEFT_CENTER, title_of(&side.camera), font, ui.visuals().text_color());
        if close_button(ui, title) {
            self.side_view = false;
            ui.ctx().request_repaint();
        }
    }
}

/// From the side of the main camera that sees more of the figure's front, level, without perspective, at the same scale.
fn side_camera(main: &Camera) -> Camera {
    let mut camera = Camera { pitch_rad: 0.0, projection: Projection::Orthographic, ..*main };
    // Not at zero, about which one turns most: the small picture would jump there.
    let side = if main.yaw_rad > LEAST_YAW_RAD { -FRAC_PI_2 } else { FRAC_PI_2 };
    camera.orbit(side, 0.0);
    camera
}

/// From which of eight sides of the figure it looks.
fn title_of(camera: &Camera) -> &'static str {
    const SIDES: [&str; 8] = [
        "From the front",
        "From the front left",
        "From the left",
        "From the back left",
        "From the back",
        "From the back right",
        "From the right",
        "From the front right",
    ];
    let eighth = (camera.yaw_rad / FRAC_PI_4).round().rem_euclid(8.0);
    SIDES[eighth as usize % 8]
}

fn close_button(ui: &Ui, title: Rect) -> bool {
    let rect = Rect::from_min_max(title.right_top() - vec2(TITLE, 0.0), title.right_bottom());
    let response = ui.interact(rect, Id::unique("close second view"), Sense::click());
    response.widget_info(|| WidgetInfo::labeled(Role::Button, true, "Close the second view"));
    let lit = response.hovered() || response.has_focus();
    let color = if lit { ui.visuals().strong_text_color() } else { ui.visuals().text_color() };
    let (at, arm) = (rect.center(), 4.0);
    for diagonal in [vec2(arm, arm), vec2(arm, -arm)] {
        ui.painter().line_segment([at - diagonal, at + diagonal], Stroke::new(1.5, color));
    }
    response.on_hover_text("Close the second view").clicked()
}

#[cfg(test)]
mod tests {
    use rig::View;

    use super::*;

    #[test]
    fn the_side_looks_across_the_view_and_says_from_where() {
        for (view, title) in [
            (View::Front, "From the left"),
            (View::Left, "From the front"),
            (View::Back, "From the left"),
            (View::Right, "From the front"),
            (View::Top, "From the left"),
        ] {
            let main = Camera::default().seen_from(view);
            let side = side_camera(&main);
            assert!((side.axes().z_axis.dot(main.axes().x_axis).abs() - 1.0).abs() < 1e-5, "{view}");
            assert_eq!((title_of(&side), side.target), (title, main.target));
        }
        let main = Camera::default().seen_from(View::ThreeQuarter);
        assert_eq!(title_of(&side_camera(&main)), "From the front right");
    }
}
