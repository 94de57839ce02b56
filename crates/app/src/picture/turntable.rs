//! A camera that goes once around what it sees.

use std::f32::consts::TAU;

use rig::{Bounds, Camera};

/// So many cameras, evenly about the vertical through the middle of the box, beginning with the given one and going to
/// the figure's left. All stand equally far, so far that the box is inside each picture of that aspect, `zoom` times
/// nearer.
pub fn turntable(first: Camera, bounds: Bounds, aspect: f32, frames: usize, zoom: f32) -> Vec<Camera> {
    let turned = around(first, frames);
    let framed = |camera: Camera| {
        let mut camera = camera;
        camera.frame(bounds, aspect);
        camera
    };
    let farthest = turned.iter().map(|camera| framed(*camera).distance).fold(0.0, f32::max);
    let target = framed(first).target;
    let nearer = |mut camera: Camera| {
        camera.zoom(1.0 / zoom, target);
        camera
    };
    turned.into_iter().map(|camera| nearer(Camera { target, distance: farthest, ..camera })).collect()
}

/// So many cameras, evenly about the vertical through the first one's target and as far as it, beginning with it.
pub fn around(first: Camera, frames: usize) -> Vec<Camera> {
    let turned = |i: usize| {
        let mut camera = first;
        if i > 0 {
            camera.orbit(TAU * i as f32 / frames as f32, 0.0);
        }
        camera
    };
    (0..frames).map(turned).collect()
}

#[cfg(test)]
mod tests {
    use glam::{Vec2, Vec3};
    use rig::View;

    use super::*;

    #[test]
    fn the_box_stays_inside_and_the_camera_comes_around() {
        let body = Bounds { min: Vec3::new(-0.8, 0.0, -0.2), max: Vec3::new(0.6, 1.7, 0.3) };
        let first = Camera::view(View::ThreeQuarter, body, 0.75);
        let cameras = turntable(first, body, 0.75, 24, 1.0);
        assert_eq!(cameras.len(), 24);
        assert_eq!(cameras[0].yaw_rad, first.yaw_rad);
        assert_eq!(around(first, 24)[0], first);
        for camera in &cameras {
            assert_eq!((camera.distance, camera.target), (cameras[0].distance, cameras[0].target));
            for corner in body.corners() {
                let at = camera.pixel_of(corner, Vec2::new(75.0, 100.0)).unwrap();
                assert!(at.cmpge(Vec2::ZERO).all() && at.cmple(Vec2::new(75.0, 100.0)).all(), "{at}");
            }
        }
        let quarter = cameras[6].eye() - cameras[6].target;
        let start = cameras[0].eye() - cameras[0].target;
        assert!((quarter.x * start.x + quarter.z * start.z).abs() < 1e-3, "a quarter after six");
        let near = turntable(first, body, 0.75, 24, 2.0);
        assert!((near[2].distance * 2.0 - cameras[2].distance).abs() < 1e-4);
        assert!(turntable(first, body, 0.75, 0, 1.0).is_empty());
    }
}
