//! The picture camera: saved apart from the working one. One may look through it, and pictures are taken with it.

use egui::{Align2, Color32, FontId, Rect, Stroke, Ui, vec2};
use glam::Vec2;
use render::{Layer, Line, Overlay};
use rig::Camera;

use super::Viewport;

/// What share of the view the frame fills when one looks through the picture camera.
const FRAME_SHARE: f32 = 0.9;
const DIM: Color32 = Color32::from_black_alpha(110);

impl Viewport {
    /// The picture camera takes the present view. While looking through it, this changes nothing.
    pub fn set_picture_camera(&mut self) {
        if !self.looks_through_picture_camera() {
            self.picture_camera = Some(self.camera);
        }
    }

    /// Looks through the picture camera, or no longer; without one, the present view becomes it first.
    pub fn toggle_picture_camera(&mut self) {
        if let Some(working) = self.working.take() {
            self.camera = working;
            return;
        }
        let camera = *self.picture_camera.get_or_insert(self.camera);
        self.working = Some(self.camera);
        self.camera = self.framing(camera);
    }

    /// Whether the view is that of the picture camera.
    pub fn looks_through_picture_camera(&self) -> bool {
        self.working.is_some() && self.picture_camera.is_some()
    }

    /// The camera with which a picture is taken: the picture camera, or the working one if none is set.
    pub fn camera_for_picture(&self) -> Camera {
        self.picture_camera.unwrap_or(self.camera)
    }

    /// Before the view moves by hand: it goes on from the picture camera's place with the picture camera's own lens.
    pub(super) fn leave_picture_camera(&mut self) {
        if let (Some(_), Some(camera)) = (self.working.take(), self.picture_camera) {
            self.camera = camera;
        }
    }

    /// Keeps the frame where it is when the view's shape has changed.
    pub(super) fn refit_picture_camera(&mut self) {
        if let (Some(_), Some(camera)) = (self.working, self.picture_camera) {
            self.camera = self.framing(camera);
        }
    }

    /// The same camera with so wide a lens that its picture is the frame within the view.
    fn framing(&self, camera: Camera) -> Camera {
        let tangent = (camera.fov_y_rad * 0.5).tan() * self.size().y / self.frame_size().y;
        Camera { fov_y_rad: 2.0 * tangent.atan(), ..camera }
    }

    fn picture_aspect(&self) -> f32 {
        let [width, height] = self.picture_size.map(|edge| edge.max(1) as f32);
        width / height
    }

    /// Width and height of the frame, points.
    fn frame_size(&self) -> Vec2 {
        let (size, aspect) = (self.size() * FRAME_SHARE, self.picture_aspect());
        let height = size.y.min(size.x / aspect).max(1.0);
        Vec2::new(height * aspect, height)
    }

    /// The frame of the picture, its outside dimmed.
    pub(super) fn paint_frame(&self, ui: &Ui) {
        let size = self.frame_size();
        let frame = Rect::from_center_size(self.rect.center(), vec2(size.x, size.y));
        let painter = ui.painter().with_clip_rect(self.rect);
        let all = self.rect;
        for outside in [
            Rect::from_min_max(all.min, egui::pos2(all.right(), frame.top())),
            Rect::from_min_max(egui::pos2(all.left(), frame.bottom()), all.max),
            Rect::from_min_max(egui::pos2(all.left(), frame.top()), frame.left_bottom()),
            Rect::from_min_max(frame.right_top(), egui::pos2(all.right(), frame.bottom())),
        ] {
            painter.rect_filled(outside, 0.0, DIM);
        }
        let line = Stroke::new(1.0, Color32::from_white_alpha(200));
        painter.rect_stroke(frame, 0.0, line, egui::StrokeKind::Outside);
        let [width, height] = self.picture_size;
        let words = format!("Picture camera · {width} × {height}");
        let (at, font) = (frame.left_top() + vec2(0.0, -5.0), FontId::proportional(12.0));
        painter.text(at, Align2::LEFT_BOTTOM, words, font, Color32::from_white_alpha(220));
    }

    /// The picture camera as thin lines: from where it stands to the corners of what it shows at its target's depth.
    pub(super) fn mark_picture_camera(&self, overlay: &mut Overlay, scale: f32) {
        // Seen from itself it would only be a line about the view.
        let apart = |camera: &Camera| self.working.is_none() && *camera != self.camera;
        let Some(camera) = self.picture_camera.filter(apart) else { return };
        let style = Line {
            from: camera.eye(),
            to: camera.eye(),
            color: [240, 214, 120, 150],
            width_px: scale,
            dash_px: 0.0,
            layer: Layer::Ghosted,
        };
        let size = Vec2::new(self.picture_aspect(), 1.0);
        let corner = |x: f32, y: f32| {
            let at = Vec2::new(x, y) * size;
            (camera.ray(at, size).origin, camera.point_under(at, size))
        };
        let corners = [corner(0.0, 0.0), corner(1.0, 0.0), corner(1.0, 1.0), corner(0.0, 1.0)];
        for (i, (near, far)) in corners.into_iter().enumerate() {
            let (next_near, next_far) = corners[(i + 1) % 4];
            overlay.lines.push(Line { from: near, to: far, ..style });
            overlay.lines.push(Line { from: far, to: next_far, ..style });
            if near != next_near {
                overlay.lines.push(Line { from: near, to: next_near, ..style });
            }
        }
        // A small roof tells which edge is the upper one.
        let (left, right) = (corners[0].1, corners[1].1);
        let tip = (left + right) * 0.5 + camera.axes().y_axis * (left - right).length() * 0.08;
        for end in [left.lerp(right, 0.42), left.lerp(right, 0.58)] {
            overlay.lines.push(Line { from: end, to: tip, ..style });
        }
    }
}
