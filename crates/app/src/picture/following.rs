//! A camera that goes along with what moves.

use glam::Vec3;
use rig::{Bounds, Camera};

use super::shot::Viewpoint;

/// Cameras for frames of something that moves: each sees it from the same direction and as far away, so that it is inside every
/// picture of that aspect. `anchors` is where it is in each frame and `bounds` the box around it there; a box for only some of
/// the frames will do.
pub fn following(
    viewpoint: &Viewpoint,
    anchors: &[Vec3],
    bounds: impl IntoIterator<Item = (usize, Bounds)>,
    aspect: f32,
) -> Vec<Camera> {
    let around = bounds.into_iter().fold(Bounds::EMPTY, |all, (frame, own)| {
        let anchor = anchors.get(frame).copied().unwrap_or_default();
        all.union(moved(own, -anchor))
    });
    anchors.iter().map(|anchor| viewpoint.camera(moved(around, *anchor), aspect)).collect()
}

fn moved(bounds: Bounds, by: Vec3) -> Bounds {
    Bounds { min: bounds.min + by, max: bounds.max + by }
}

/// Each place the mean of those around it, so many frames to both sides and fewer toward the ends: without the ups and downs of
/// steps.
pub fn smoothed(places: &[Vec3], frames: usize) -> Vec<Vec3> {
    let mean = |i: usize| {
        // Evenly to both sides, or the ends would lag behind what goes straight on.
        let half = frames.min(i).min(places.len() - 1 - i);
        let own = &places[i - half..=i + half];
        own.iter().sum::<Vec3>() / own.len() as f32
    };
    (0..places.len()).map(mean).collect()
}

#[cfg(test)]
mod tests {
    use glam::Vec2;
    use rig::View;

    use super::*;

    #[test]
    fn what_moves_stays_inside_and_the_camera_as_far_away() {
        let anchors: Vec<Vec3> = (0..9).map(|i| Vec3::new(0.0, 0.1 * i as f32, 0.7 * i as f32)).collect();
        let own = |i: usize| Bounds {
            min: anchors[i] - Vec3::new(0.3 + 0.05 * i as f32, 0.0, 0.4),
            max: anchors[i] + Vec3::new(0.3, 1.7, 0.2 + 0.03 * i as f32),
        };
        let cameras =
            following(&Viewpoint::from(View::ThreeQuarter), &anchors, (0..9).map(|i| (i, own(i))), 0.8);
        for (i, camera) in cameras.iter().enumerate() {
            assert!((camera.distance - cameras[0].distance).abs() < 1e-5);
            let step = camera.target - cameras[0].target;
            assert!(step.distance(anchors[i] - anchors[0]) < 1e-5);
            for corner in own(i).corners() {
                let at = camera.pixel_of(corner, Vec2::new(80.0, 100.0)).unwrap();
                assert!(at.cmpge(Vec2::ZERO).all() && at.cmple(Vec2::new(80.0, 100.0)).all(), "{i}: {at}");
            }
        }
    }

    #[test]
    fn a_straight_way_stays_straight_and_bobbing_goes() {
        let bobbing: Vec<Vec3> =
            (0..60).map(|i| Vec3::new(0.0, 0.03 * (i as f32 * 0.9).sin(), 0.05 * i as f32)).collect();
        let smooth = smoothed(&bobbing, 14);
        assert_eq!(smooth.len(), 60);
        for (i, place) in smooth.iter().enumerate() {
            assert!((place.z - bobbing[i].z).abs() < 1e-5);
        }
        assert!(smooth[14..46].iter().all(|p| p.y.abs() < 0.006));
        assert!(smoothed(&[], 3).is_empty());
    }
}
