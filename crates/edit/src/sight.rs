//! What the pointer sees the figure through: a camera and the size of its picture.

use glam::{DVec3, Vec2};
use rig::{Camera, Projection, Ray};

/// A camera and the picture that it makes.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Sight {
    /// The camera.
    pub camera: Camera,
    /// Width and height of the picture, in the unit of the pointer's places: pixels or points.
    pub size_px: Vec2,
}

impl Sight {
    /// The ray through a place of the picture.
    pub fn ray(&self, at_px: Vec2) -> Ray {
        self.camera.ray(at_px, self.size_px)
    }

    /// Where a point of the world is in the picture; `None` behind the eye.
    pub fn pixel_of(&self, point_in_world: DVec3) -> Option<Vec2> {
        self.camera.pixel_of(point_in_world.as_vec3(), self.size_px)
    }

    /// Metres that a pixel spans at the depth of a point.
    pub fn metres_per_px(&self, point_in_world: DVec3) -> f64 {
        f64::from(self.camera.metres_per_pixel(point_in_world.as_vec3(), self.size_px.y))
    }

    /// The unit direction from a point toward the viewer; zero at the eye.
    pub fn toward_viewer(&self, point_in_world: DVec3) -> DVec3 {
        match self.camera.projection {
            Projection::Perspective => (self.camera.eye().as_dvec3() - point_in_world).normalize_or_zero(),
            Projection::Orthographic => self.camera.axes().z_axis.as_dvec3(),
        }
    }
}
