//! A circle in the world, and where it is in the picture.

use std::f64::consts::TAU;

use glam::{DVec3, Vec2};

use crate::Sight;

/// A circle about an axis; angles count from `start` by the right-hand rule.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Circle {
    /// Metres, world.
    pub center: DVec3,
    /// Unit axis, world.
    pub axis: DVec3,
    /// Unit direction from the centre to angle 0, perpendicular to the axis.
    pub start: DVec3,
    /// Metres.
    pub radius_m: f64,
}

/// A place of a circle that the pointer is near.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct NearCircle {
    /// How far the pointer is from it in the picture.
    pub distance_px: f32,
    /// Its angle, radians.
    pub angle_rad: f64,
    /// Whether it lies on the half that is turned toward the viewer.
    pub front: bool,
}

/// Lines that a circle is drawn and picked as.
const STEPS: u32 = 72;

impl Circle {
    /// A circle whose angle 0 lies toward a direction; anywhere if that runs along the axis.
    pub fn new(center: DVec3, axis: DVec3, toward: DVec3, radius_m: f64) -> Circle {
        let axis = axis.try_normalize().unwrap_or(DVec3::Y);
        let start = toward.reject_from_normalized(axis).try_normalize();
        let start = start.unwrap_or_else(|| axis.any_orthonormal_vector());
        Circle { center, axis, start, radius_m }
    }

    /// The point at an angle, metres, world.
    pub fn point(&self, angle_rad: f64) -> DVec3 {
        self.center + self.direction(angle_rad) * self.radius_m
    }

    /// The unit direction from the centre to the point at an angle.
    pub fn direction(&self, angle_rad: f64) -> DVec3 {
        let (sine, cosine) = angle_rad.sin_cos();
        self.start * cosine + self.axis.cross(self.start) * sine
    }

    /// The angle of a point seen along the axis, radians in (-pi, pi]; 0 on the axis.
    pub fn angle_of(&self, point_in_world: DVec3) -> f64 {
        let from_center = point_in_world - self.center;
        self.axis.cross(self.start).dot(from_center).atan2(self.start.dot(from_center))
    }

    /// The angle at which a sight line meets the circle's plane; `None` where it runs beside it or meets it behind
    /// the eye.
    pub fn angle_under(&self, sight: &Sight, at_px: Vec2) -> Option<f64> {
        let ray = sight.ray(at_px);
        let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        let far = (self.center - origin).dot(self.axis) / direction.dot(self.axis);
        let point = origin + direction * far;
        (far > 0.0 && point.is_finite() && point.distance_squared(self.center) > 1e-12)
            .then(|| self.angle_of(point))
    }

    /// Whether the point at an angle lies on the half toward the viewer. Of a circle seen face on, all of it does.
    pub fn is_front(&self, sight: &Sight, angle_rad: f64) -> bool {
        let toward = sight.toward_viewer(self.center);
        self.axis.dot(toward).abs() > FACE_ON || self.direction(angle_rad).dot(toward) >= -1e-6
    }

    /// The nearest place of the circle to a place of the picture.
    pub fn nearest(&self, sight: &Sight, at_px: Vec2) -> Option<NearCircle> {
        let step = TAU / f64::from(STEPS);
        let mut nearest: Option<NearCircle> = None;
        let mut last: Option<Vec2> = None;
        for i in 0..=STEPS {
            let pixel = sight.pixel_of(self.point(f64::from(i) * step));
            if let (Some(from), Some(to)) = (last, pixel) {
                let along = to - from;
                let share = ((at_px - from).dot(along) / along.length_squared().max(1e-12)).clamp(0.0, 1.0);
                let distance_px = (from + along * share).distance(at_px);
                let angle_rad = (f64::from(i - 1) + f64::from(share)) * step;
                let front = self.is_front(sight, angle_rad);
                let cost = |n: &NearCircle| n.distance_px + if n.front { 0.0 } else { HIDDEN_PX };
                let here = NearCircle { distance_px, angle_rad, front };
                if nearest.as_ref().is_none_or(|n| cost(&here) < cost(n)) {
                    nearest = Some(here);
                }
            }
            last = pixel;
        }
        nearest
    }

    /// The same circle turned about its own axis so that angle 0 is where an angle was.
    pub fn from_angle(self, angle_rad: f64) -> Circle {
        Circle { start: self.direction(angle_rad), ..self }
    }
}

/// A circle whose axis points at the viewer by more than this cosine hides none of itself.
const FACE_ON: f64 = 0.97;
/// The half behind is taken only where the pointer is nearer to it by this.
const HIDDEN_PX: f32 = 3.0;

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use rig::Camera;

    use super::*;

    fn sight() -> Sight {
        Sight { camera: Camera::default(), size_px: Vec2::new(800.0, 600.0) }
    }

    #[test]
    fn a_circle_is_found_where_it_is_drawn() {
        let circle = Circle::new(DVec3::new(0.1, 1.0, 0.0), DVec3::new(0.3, 1.0, 0.5), DVec3::X, 0.2);
        for i in 0..24 {
            let angle = f64::from(i) * 0.26;
            let place = sight().pixel_of(circle.point(angle)).unwrap();
            let near = circle.nearest(&sight(), place).unwrap();
            assert!(near.distance_px < 0.3, "{near:?}");
            let under = circle.angle_under(&sight(), place).unwrap();
            assert!(kin_wrapped(under - angle).abs() < 1e-4, "{under} for {angle}");
        }
    }

    fn kin_wrapped(angle: f64) -> f64 {
        (angle + TAU / 2.0).rem_euclid(TAU) - TAU / 2.0
    }

    #[test]
    fn a_circle_about_nothing_is_still_a_circle() {
        let circle = Circle::new(DVec3::ZERO, DVec3::ZERO, DVec3::NAN, 0.1);
        assert!(circle.point(1.0).is_finite());
        let circle = Circle::new(DVec3::ZERO, DVec3::X, DVec3::X, 0.1);
        assert!((circle.point(2.0).length() - 0.1).abs() < 1e-12);
    }
}
