//! The camera that sees all of a skin, and no more than a little air around it.

use glam::{Vec2, Vec3};
use rig::{Camera, Projection};

/// Air around the skin, in each direction, as a share of the picture.
const AIR: f32 = 0.05;

/// Moves a camera, whose direction and lens stay, so that all points are just inside a picture of that aspect
/// (width / height) and in its middle. No points, or none that is finite, change nothing.
///
/// For perspective this is exact: a point at (x, z) to the right and toward the viewer is inside the side whose slope is
/// t if x + t z is at most what it is for the eye, so the eye is where the greatest of these meet.
pub fn fit(camera: Camera, points: &[Vec3], aspect: f32) -> Camera {
    let axes = camera.axes();
    let views = || points.iter().filter(|p| p.is_finite()).map(|p| axes.transpose() * *p);
    let greatest = |of: &dyn Fn(Vec3) -> f32| views().map(of).fold(f32::NEG_INFINITY, f32::max);
    if views().next().is_none() {
        return camera;
    }
    let tan = (camera.fov_y_rad * 0.5).tan() * Vec2::new(aspect.max(1e-3), 1.0);
    let t = tan * (1.0 - 2.0 * AIR);
    let perspective = camera.projection == Projection::Perspective;
    let slope = if perspective { t } else { Vec2::ZERO };
    let (right, left) = (greatest(&|p| p.x + slope.x * p.z), greatest(&|p| slope.x * p.z - p.x));
    let (top, bottom) = (greatest(&|p| p.y + slope.y * p.z), greatest(&|p| slope.y * p.z - p.y));
    let (near, far) = (greatest(&|p| p.z), -greatest(&|p| -p.z));
    let needed = ((right + left) / (2.0 * t.x)).max((top + bottom) / (2.0 * t.y));
    let middle_z = (near + far) * 0.5;
    // Perspective: how far forward the eye is. Otherwise: the distance at which the picture spans what is needed.
    let distance = if perspective { needed - middle_z } else { needed };
    let target = axes * Vec3::new((right - left) * 0.5, (top - bottom) * 0.5, middle_z);
    Camera { target, distance: distance.max(0.05), ..camera }
}

#[cfg(test)]
mod tests {
    use rig::View;

    use super::*;

    #[test]
    fn points_touch_the_air_and_stay_inside() {
        let points: Vec<Vec3> = (0..200)
            .map(|i| {
                let f = i as f32;
                Vec3::new((f * 0.7).sin() * 0.6, 0.9 + (f * 1.3).cos() * 0.9, (f * 2.1).sin() * 0.5)
            })
            .collect();
        for projection in [Projection::Perspective, Projection::Orthographic] {
            for (view, size) in
                [(View::ThreeQuarter, Vec2::new(300.0, 400.0)), (View::Top, Vec2::new(900.0, 400.0))]
            {
                let camera = Camera { projection, ..Camera::default().seen_from(view) };
                let camera = fit(camera, &points, size.x / size.y);
                let seen: Vec<Vec2> =
                    points.iter().map(|p| camera.pixel_of(*p, size).unwrap() / size).collect();
                let least = seen.iter().fold(Vec2::MAX, |a, b| a.min(*b));
                let most = seen.iter().fold(Vec2::MIN, |a, b| a.max(*b));
                let margin = least.min(1.0 - most);
                assert!((margin.min_element() - AIR).abs() < 2e-3, "{view} {projection:?}: {least} {most}");
                assert!((least + most - 1.0).abs().min_element() < 2e-2, "in the middle: {least} {most}");
            }
        }
    }

    #[test]
    fn nothing_to_see_changes_nothing() {
        let camera = Camera::default();
        assert_eq!(fit(camera, &[], 1.0), camera);
        assert_eq!(fit(camera, &[Vec3::NAN], 1.0), camera);
    }
}
