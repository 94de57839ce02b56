//! The orbit camera: where it stands, what it sees, and how a drag moves it.
//!
//! Yaw 0 looks at the figure's front from +Z, yaw 90 from +X, the figure's left. Pixels count from the
//! picture's top left corner, y down, with pixel centres at halves.

use std::f32::consts::{FRAC_PI_2, PI, TAU};
use std::str::FromStr;

use glam::camera::rh::proj::directx;
use glam::{Mat3, Mat4, Vec2, Vec3, Vec4};

use crate::{Bounds, nearest};

/// A named direction to look from, as the command line says it.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default)]
pub enum View {
    /// From +Z, the figure faces the camera.
    #[default]
    Front,
    /// From -Z.
    Back,
    /// The camera stands at the figure's left, at +X.
    Left,
    /// The camera stands at the figure's right, at -X.
    Right,
    /// From above, with the figure's front at the bottom of the picture.
    Top,
    /// From below, with the figure's front at the top of the picture.
    Bottom,
    /// From the front, the figure's left and a little above.
    ThreeQuarter,
}

impl View {
    /// Every view.
    pub const ALL: [View; 7] =
        [View::Front, View::Back, View::Left, View::Right, View::Top, View::Bottom, View::ThreeQuarter];

    /// The name on the command line.
    pub const fn name(self) -> &'static str {
        match self {
            View::Front => "front",
            View::Back => "back",
            View::Left => "left",
            View::Right => "right",
            View::Top => "top",
            View::Bottom => "bottom",
            View::ThreeQuarter => "three-quarter",
        }
    }

    /// Yaw and pitch, radians.
    pub const fn angles_rad(self) -> (f32, f32) {
        match self {
            View::Front => (0.0, 0.0),
            View::Back => (PI, 0.0),
            View::Left => (FRAC_PI_2, 0.0),
            View::Right => (-FRAC_PI_2, 0.0),
            View::Top => (0.0, FRAC_PI_2),
            View::Bottom => (0.0, -FRAC_PI_2),
            View::ThreeQuarter => (35.0 * PI / 180.0, 12.0 * PI / 180.0),
        }
    }
}

impl std::fmt::Display for View {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for View {
    type Err = String;
    fn from_str(word: &str) -> Result<View, String> {
        View::ALL.into_iter().find(|v| v.name() == word).ok_or_else(|| {
            let all = View::ALL.map(View::name);
            let near = nearest(word, all.into_iter());
            format!("unknown view \"{word}\" (did you mean \"{near}\"?), expected one of {}", all.join(", "))
        })
    }
}

/// How depth becomes size in the picture.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Projection {
    /// Farther is smaller.
    #[default]
    Perspective,
    /// Farther is as large; the scale is that of a perspective picture at the target's distance.
    Orthographic,
}

/// A ray in world space.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Ray {
    /// Metres.
    pub origin: Vec3,
    /// Unit length.
    pub direction: Vec3,
}

/// A camera that turns about a target point. Plain data: the caller may set any field.
///
/// ```
/// use rig::{Bounds, Camera, View};
/// use glam::{Vec2, Vec3};
/// let body = Bounds { min: Vec3::new(-0.8, 0.0, -0.2), max: Vec3::new(0.8, 1.7, 0.2) };
/// let camera = Camera::view(View::Left, body, 1.6);
/// assert!(camera.eye().x > 2.0);
/// let pixel = camera.pixel_of(Vec3::new(0.0, 1.0, 0.0), Vec2::new(1280.0, 800.0)).unwrap();
/// assert!((pixel.x - 640.0).abs() < 1e-3);
/// ```
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Camera {
    /// The point that it looks at and turns about, metres, world.
    pub target: Vec3,
    /// Where it stands about the vertical through the target, radians: 0 at +Z, +π/2 at +X.
    pub yaw_rad: f32,
    /// How far above the target's horizon it stands, radians, within ±π/2.
    pub pitch_rad: f32,
    /// From the eye to the target, metres, positive.
    pub distance: f32,
    /// Vertical field of view, radians.
    pub fov_y_rad: f32,
    /// Perspective or not.
    pub projection: Projection,
}

impl Default for Camera {
    fn default() -> Camera {
        Camera {
            target: Vec3::new(0.0, 0.9, 0.0),
            yaw_rad: 0.0,
            pitch_rad: 0.0,
            distance: 4.0,
            fov_y_rad: 30.0_f32.to_radians(),
            projection: Projection::Perspective,
        }
    }
}

const LEAST_DISTANCE_M: f32 = 0.02;
const GREATEST_DISTANCE_M: f32 = 500.0;
/// A framed body leaves a little air around itself.
const AIR: f32 = 1.08;

impl Camera {
    /// A perspective camera at a named view, with the box just inside a picture of that aspect (width / height).
    pub fn view(view: View, bounds: Bounds, aspect: f32) -> Camera {
        let (yaw_rad, pitch_rad) = view.angles_rad();
        let mut camera = Camera { yaw_rad, pitch_rad, ..Camera::default() };
        camera.frame(bounds, aspect);
        camera
    }

    /// The same camera from a named view; target, distance and lens stay.
    pub fn seen_from(self, view: View) -> Camera {
        let (yaw_rad, pitch_rad) = view.angles_rad();
        Camera { yaw_rad, pitch_rad, ..self }
    }

    /// The same camera from the other side of its target. Straight from above becomes straight from below with the
    /// same side of the figure at the picture's right.
    pub fn opposite(self) -> Camera {
        let steep = self.pitch_rad.abs() > FRAC_PI_2 - 1e-3;
        let yaw_rad = if steep { self.yaw_rad } else { half_turn(self.yaw_rad + PI) };
        Camera { yaw_rad, pitch_rad: -self.pitch_rad, ..self }
    }

    /// The camera's angles are those of a named view, but for rounding.
    pub fn is_at(&self, view: View) -> bool {
        let (yaw_rad, pitch_rad) = view.angles_rad();
        half_turn(self.yaw_rad - yaw_rad).abs() < 1e-4 && (self.pitch_rad - pitch_rad).abs() < 1e-4
    }

    /// Moves target and distance so that the box is just inside the picture; an empty box changes nothing,
    /// a box of one point keeps the distance.
    pub fn frame(&mut self, bounds: Bounds, aspect: f32) {
        if bounds.is_empty() {
            return;
        }
        let tan_y = (self.fov_y_rad * 0.5).tan();
        let tan_x = tan_y * aspect.max(1e-3);
        let view_from_world = self.axes().transpose();
        self.target = bounds.center();
        let needed = |corner: Vec3| {
            let c = view_from_world * (corner - self.target);
            let toward = if self.projection == Projection::Perspective { c.z } else { 0.0 };
            toward + AIR * (c.x.abs() / tan_x).max(c.y.abs() / tan_y)
        };
        let distance = bounds.corners().into_iter().map(needed).fold(0.0, f32::max);
        if distance > 0.0 {
            self.distance = distance.clamp(LEAST_DISTANCE_M, GREATEST_DISTANCE_M);
        }
    }

    /// Turns about the target; the pitch stops straight above and straight below.
    pub fn orbit(&mut self, yaw_rad: f32, pitch_rad: f32) {
        if yaw_rad.is_finite() && pitch_rad.is_finite() {
            self.yaw_rad = half_turn(self.yaw_rad + yaw_rad);
            self.pitch_rad = (self.pitch_rad + pitch_rad).clamp(-FRAC_PI_2, FRAC_PI_2);
        }
    }

    /// Slides sideways so that what lies at the target's depth follows a drag by that many pixels.
    pub fn pan(&mut self, drag_px: Vec2, height_px: f32) {
        let metres = drag_px * (self.height_at_target() / height_px.max(1.0));
        let axes = self.axes();
        let shift = axes.y_axis * metres.y - axes.x_axis * metres.x;
        if shift.is_finite() {
            self.target += shift;
        }
    }

    /// Scales the distance by `factor` (below 1 comes nearer) while `toward`, a world point, stays on its pixel.
    pub fn zoom(&mut self, factor: f32, toward: Vec3) {
        if !factor.is_finite() || !toward.is_finite() {
            return;
        }
        let before = self.distance;
        self.distance = (before * factor).clamp(LEAST_DISTANCE_M, GREATEST_DISTANCE_M);
        self.target = toward + (self.target - toward) * (self.distance / before);
    }

    /// Where the camera stands, metres, world. In orthographic projection it only gives the direction.
    pub fn eye(&self) -> Vec3 {
        self.target + self.axes().z_axis * self.distance
    }

    /// The camera's axes in the world as columns: right, up, toward the viewer.
    pub fn axes(&self) -> Mat3 {
        let (sy, cy) = self.yaw_rad.sin_cos();
        let (sp, cp) = self.pitch_rad.sin_cos();
        let right = Vec3::new(cy, 0.0, -sy);
        let back = Vec3::new(cp * sy, sp, cp * cy);
        Mat3::from_cols(right, back.cross(right), back)
    }

    /// World to view space: x right, y up, z toward the viewer, metres from the eye.
    pub fn view_from_world(&self) -> Mat4 {
        let rotation = self.axes().transpose();
        Mat4::from_translation(-(rotation * self.eye())) * Mat4::from_mat3(rotation)
    }

    /// View to clip space with y up and depth 0 at the near plane, 1 at the far one; aspect is width / height.
    pub fn clip_from_view(&self, aspect: f32) -> Mat4 {
        let aspect = if aspect.is_finite() { aspect.max(1e-3) } else { 1.0 };
        match self.projection {
            Projection::Perspective => {
                let near = (self.distance * 0.02).clamp(0.001, 0.1);
                directx::perspective(self.fov_y_rad, aspect, near, self.distance + 200.0)
            }
            Projection::Orthographic => {
                let half = self.height_at_target() * 0.5;
                let reach = 200.0;
                directx::orthographic(
                    -half * aspect,
                    half * aspect,
                    -half,
                    half,
                    -reach,
                    self.distance + reach,
                )
            }
        }
    }

    /// World to clip space.
    pub fn clip_from_world(&self, aspect: f32) -> Mat4 {
        self.clip_from_view(aspect) * self.view_from_world()
    }

    /// Height in metres of what the picture shows at the target's depth.
    pub fn height_at_target(&self) -> f32 {
        2.0 * self.distance * (self.fov_y_rad * 0.5).tan()
    }

    /// The ray through a pixel of a picture of that size. It starts at the eye, or, in orthographic projection,
    /// on the plane through the eye.
    pub fn ray(&self, pixel: Vec2, size_px: Vec2) -> Ray {
        let size_px = size_px.max(Vec2::ONE);
        let half = self.height_at_target() * 0.5;
        let across = (pixel / size_px * 2.0 - Vec2::ONE) * Vec2::new(half * size_px.x / size_px.y, -half);
        let axes = self.axes();
        let offset = axes.x_axis * across.x + axes.y_axis * across.y;
        match self.projection {
            Projection::Perspective => {
                Ray { origin: self.eye(), direction: (offset - axes.z_axis * self.distance).normalize() }
            }
            Projection::Orthographic => Ray { origin: self.eye() + offset, direction: -axes.z_axis },
        }
    }

    /// The world point seen at a pixel in the plane through the target that faces the camera.
    pub fn point_under(&self, pixel: Vec2, size_px: Vec2) -> Vec3 {
        let ray = self.ray(pixel, size_px);
        let toward = self.axes().z_axis;
        let depth = (self.target - ray.origin).dot(toward) / ray.direction.dot(toward);
        ray.origin + ray.direction * depth
    }

    /// The pixel of a world point, also outside the picture; `None` if the point is behind the eye.
    pub fn pixel_of(&self, point: Vec3, size_px: Vec2) -> Option<Vec2> {
        let size_px = size_px.max(Vec2::ONE);
        let clip: Vec4 = self.clip_from_world(size_px.x / size_px.y) * point.extend(1.0);
        if clip.w <= 1e-6 || !clip.is_finite() {
            return None;
        }
        let ndc = Vec2::new(clip.x, clip.y) / clip.w;
        Some((ndc * Vec2::new(0.5, -0.5) + 0.5) * size_px)
    }

    /// Metres that one pixel spans at a point's depth, in a picture of that height.
    pub fn metres_per_pixel(&self, point: Vec3, height_px: f32) -> f32 {
        let depth = match self.projection {
            Projection::Perspective => (self.eye() - point).dot(self.axes().z_axis).max(LEAST_DISTANCE_M),
            Projection::Orthographic => self.distance,
        };
        self.height_at_target() * depth / (self.distance * height_px.max(1.0))
    }
}

/// The same angle within a half turn of zero.
fn half_turn(angle_rad: f32) -> f32 {
    (angle_rad + PI).rem_euclid(TAU) - PI
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIZE: Vec2 = Vec2::new(1280.0, 800.0);

    fn body() -> Bounds {
        Bounds { min: Vec3::new(-0.8, 0.0, -0.2), max: Vec3::new(0.8, 1.7, 0.2) }
    }

    fn cameras() -> impl Iterator<Item = Camera> {
        [Projection::Perspective, Projection::Orthographic]
            .into_iter()
            .flat_map(|projection| View::ALL.map(|v| Camera { projection, ..Camera::view(v, body(), 1.6) }))
    }

    #[test]
    fn a_pixel_s_ray_meets_the_point_that_projects_there() {
        for camera in cameras() {
            for pixel in [Vec2::new(0.0, 0.0), Vec2::new(333.5, 612.0), Vec2::new(1280.0, 800.0)] {
                let ray = camera.ray(pixel, SIZE);
                let back = camera.pixel_of(ray.origin + ray.direction * 3.3, SIZE).unwrap();
                assert!((back - pixel).length() < 0.01, "{camera:?}: {pixel} -> {back}");
            }
        }
    }

    #[test]
    fn the_projection_agrees_with_the_depth_range() {
        for camera in cameras() {
            let clip = camera.clip_from_world(1.6) * camera.target.extend(1.0);
            let depth = clip.z / clip.w;
            assert!((0.0..1.0).contains(&depth), "{depth}");
            let farther = camera.target - camera.axes().z_axis;
            let clip = camera.clip_from_world(1.6) * farther.extend(1.0);
            assert!(clip.z / clip.w > depth);
        }
    }

    #[test]
    fn left_is_the_figure_s_left() {
        let camera = Camera::view(View::Left, body(), 1.6);
        assert!(camera.eye().x > 1.0 && camera.eye().z.abs() < 1e-3);
        let front = camera.pixel_of(Vec3::new(0.0, 0.85, 0.2), SIZE).unwrap();
        assert!(front.x < 600.0, "seen from its left the figure faces the picture's left: {front}");
        let front = Camera::view(View::Front, body(), 1.6);
        let left_hand = front.pixel_of(Vec3::new(0.8, 1.4, 0.0), SIZE).unwrap();
        assert!(
            left_hand.x > 800.0,
            "seen from the front its left hand is at the picture's right: {left_hand}"
        );
        let top = Camera::view(View::Top, body(), 1.6);
        assert!(top.eye().y > 2.0);
        let nose = top.pixel_of(Vec3::new(0.0, 1.6, 0.2), SIZE).unwrap();
        assert!(nose.y > 400.0, "from the top the front is at the bottom: {nose}");
        let bottom = Camera::view(View::Bottom, body(), 1.6);
        assert!(bottom.eye().y < -1.0);
        let nose = bottom.pixel_of(Vec3::new(0.0, 1.6, 0.2), SIZE).unwrap();
        assert!(nose.y < 400.0, "from below the front is at the top: {nose}");
    }

    #[test]
    fn the_opposite_view_looks_back_and_twice_opposite_is_the_same() {
        for (view, opposite) in
            [(View::Front, View::Back), (View::Left, View::Right), (View::Top, View::Bottom)]
        {
            let camera = Camera { target: Vec3::new(0.1, 0.8, 0.2), ..Camera::view(view, body(), 1.6) };
            assert!(camera.opposite().is_at(opposite) && camera.is_at(view) && !camera.is_at(opposite));
            assert!(camera.opposite().opposite().is_at(view));
        }
        for camera in cameras() {
            let there = camera.opposite();
            assert!((there.axes().z_axis + camera.axes().z_axis).length() < 1e-5, "{camera:?}");
            assert_eq!((there.target, there.distance), (camera.target, camera.distance));
        }
    }

    #[test]
    fn the_point_under_a_pixel_is_seen_there_at_the_target_s_depth() {
        for camera in cameras() {
            let pixel = Vec2::new(301.0, 622.0);
            let point = camera.point_under(pixel, SIZE);
            assert!((camera.pixel_of(point, SIZE).unwrap() - pixel).length() < 0.01);
            assert!((point - camera.target).dot(camera.axes().z_axis).abs() < 1e-4);
        }
    }

    #[test]
    fn a_framed_box_is_inside_and_fills_the_picture() {
        for aspect in [0.5_f32, 1.0, 1.6] {
            let size = Vec2::new(800.0 * aspect, 800.0);
            for view in View::ALL {
                let camera = Camera::view(view, body(), aspect);
                let reach = body().corners().map(|c| {
                    let ndc = camera.pixel_of(c, size).unwrap() / size * 2.0 - 1.0;
                    ndc.abs().max_element()
                });
                let most = reach.into_iter().fold(0.0, f32::max);
                assert!((0.85..1.0).contains(&most), "{view} at {aspect}: {most}");
            }
        }
    }

    #[test]
    fn zoom_keeps_the_pixel_and_pan_follows_the_pointer() {
        for mut camera in cameras() {
            let hand = Vec3::new(0.3, 1.1, 0.1);
            let before = camera.pixel_of(hand, SIZE).unwrap();
            camera.zoom(0.6, hand);
            let after = camera.pixel_of(hand, SIZE).unwrap();
            assert!((after - before).length() < 0.02, "{before} {after}");
            let target = camera.target;
            camera.pan(Vec2::new(30.0, -20.0), SIZE.y);
            let moved = camera.pixel_of(target, SIZE).unwrap() - SIZE * 0.5;
            assert!((moved - Vec2::new(30.0, -20.0)).length() < 0.02, "{moved}");
        }
    }

    #[test]
    fn bad_numbers_change_nothing_and_the_pitch_stops() {
        let mut camera = Camera::default();
        camera.orbit(f32::NAN, 0.0);
        camera.zoom(f32::NAN, Vec3::ZERO);
        camera.zoom(0.5, Vec3::NAN);
        camera.pan(Vec2::NAN, 0.0);
        camera.frame(Bounds::EMPTY, 1.0);
        assert_eq!(camera, Camera::default());
        camera.orbit(0.0, 9.0);
        assert_eq!(camera.pitch_rad, FRAC_PI_2);
        assert!(camera.pixel_of(Vec3::ZERO, Vec2::ZERO).is_some());
        assert_eq!(Camera::default().pixel_of(Vec3::new(0.0, 0.9, 9.0), SIZE), None);
    }

    #[test]
    fn views_are_read_by_name() {
        for view in View::ALL {
            assert_eq!(view.name().parse(), Ok(view));
        }
        let error = "frnt".parse::<View>().unwrap_err();
        assert!(error.contains("\"front\"") && error.contains("three-quarter"), "{error}");
    }
}
