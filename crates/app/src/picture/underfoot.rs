//! Ground as it is drawn: a patch of it as a mesh, which a renderer takes into a slot of its own.

use std::sync::Arc;

use glam::{DVec2, DVec3};
use motion::Ground;
use render::FigureView;
use rig::{Mesh, Palette};

/// The patch moves in steps of so many metres, so that a figure that walks doesn't change it at every step.
const STEP_M: f64 = 2.0;
/// How far beyond the middle the patch reaches at least and at most, metres.
const REACH_M: [f64; 2] = [6.0, 24.0];
/// Linear colours of tops and of sides and gaps, in dark and in bright surroundings.
const COLORS: [[[f32; 3]; 2]; 2] =
    [[[0.105, 0.110, 0.118], [0.060, 0.063, 0.068]], [[0.50, 0.51, 0.53], [0.30, 0.31, 0.33]]];
/// Every other tread of stairs is so much darker: seen from above their edges would not be seen.
const ODD_TREAD: f32 = 0.72;
/// Below this red a patch means sides and gaps.
const DARKER: f32 = 0.45;

/// A patch of ground, ready to be drawn. Equal patches are one and the same allocation.
#[derive(Clone, Debug)]
pub struct Underfoot(Arc<Patch>);

#[derive(Debug)]
struct Patch {
    mesh: Mesh,
    middle: DVec2,
    reach_m: f64,
    bright: bool,
}

impl Underfoot {
    /// The ground around a place of the world as far as a camera at that distance shows it, for bright or dark surroundings.
    ///
    /// Bad numbers give a patch around the origin, as small as patches are.
    pub fn around(ground: &Ground, place: DVec3, camera_distance_m: f64, bright: bool) -> Underfoot {
        let (middle, reach_m) = extent(place, camera_distance_m);
        let mesh = mesh(ground, middle, reach_m, bright);
        Underfoot(Arc::new(Patch { mesh, middle, reach_m, bright }))
    }

    /// The ground of a square around the origin, half its side given, metres.
    pub fn square(ground: &Ground, half_m: f64, bright: bool) -> Underfoot {
        let middle = DVec2::ZERO;
        let mesh = mesh(ground, middle, half_m, bright);
        Underfoot(Arc::new(Patch { mesh, middle, reach_m: half_m, bright }))
    }

    /// The same patch as long as it does for that place, camera and surroundings, else a new one. The ground must be the same.
    #[must_use]
    pub fn following(
        &self,
        ground: &Ground,
        place: DVec3,
        camera_distance_m: f64,
        bright: bool,
    ) -> Underfoot {
        let Patch { middle, reach_m, bright: was, .. } = &*self.0;
        if (*middle, *reach_m, *was)
            == (extent(place, camera_distance_m).0, extent(place, camera_distance_m).1, bright)
        {
            return self.clone();
        }
        Underfoot::around(ground, place, camera_distance_m, bright)
    }

    /// What a renderer takes into a slot; in the world as it is.
    pub fn mesh(&self) -> &Mesh {
        &self.0.mesh
    }

    /// The view of the mesh in that slot.
    pub fn view(slot: usize) -> FigureView<'static> {
        FigureView { skin: slot, ground: true, ..FigureView::new(&Palette::REST) }
    }

    /// Whether the other one is the very same.
    pub fn is(&self, other: &Underfoot) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl PartialEq for Underfoot {
    fn eq(&self, other: &Underfoot) -> bool {
        self.is(other)
    }
}

/// The middle of the patch and how far it reaches from there, metres.
fn extent(place: DVec3, camera_distance_m: f64) -> (DVec2, f64) {
    let stepped = |v: f64| if v.is_finite() { (v / STEP_M).round() * STEP_M } else { 0.0 };
    // The ground fades out at twice the camera's distance.
    let wanted = (2.0 * camera_distance_m + STEP_M).ceil();
    let reach_m = if wanted.is_finite() { wanted.clamp(REACH_M[0], REACH_M[1]) } else { REACH_M[0] };
    (DVec2::new(stepped(place.x), stepped(place.z)), reach_m)
}

/// The patch in one light colour and one dark one; the grid's lines tell how large it is.
fn mesh(ground: &Ground, middle: DVec2, reach_m: f64, bright: bool) -> Mesh {
    let mut mesh = ground.patch(middle, reach_m);
    let [top, side] = COLORS[usize::from(bright)];
    let heights: Vec<f32> = mesh.positions.iter().map(|place| place[1]).collect();
    let rise = if matches!(ground, Ground::Stairs(_)) { least_rise(&heights) } else { None };
    for (color, height) in mesh.colors.iter_mut().zip(heights) {
        let odd = rise.is_some_and(|rise| (height / rise).round().rem_euclid(2.0) == 1.0);
        let shade = if odd { ODD_TREAD } else { 1.0 };
        *color = if color[0] < DARKER { side } else { top.map(|c| c * shade) };
    }
    mesh
}

/// The least difference between heights, metres; `None` if all are the same.
fn least_rise(heights: &[f32]) -> Option<f32> {
    let mut millimetres: Vec<i64> = heights.iter().map(|h| (h * 1000.0).round() as i64).collect();
    millimetres.sort_unstable();
    millimetres.dedup();
    millimetres.windows(2).map(|pair| (pair[1] - pair[0]) as f32 / 1000.0).reduce(f32::min)
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    #[test]
    fn a_patch_stays_while_it_does_and_follows_in_steps() {
        let first = Underfoot::around(&Ground::Flat, DVec3::ZERO, 4.0, false);
        assert_eq!(first.mesh().fault(), None);
        assert!(first.is(&first.following(&Ground::Flat, DVec3::new(0.7, 3.0, -0.9), 4.0, false)));
        let moved = first.following(&Ground::Flat, DVec3::new(0.0, 0.0, 5.2), 4.0, false);
        assert!(!first.is(&moved));
        let spread = |patch: &Underfoot| {
            let all = || patch.mesh().positions.iter().map(|p| p[2]);
            (all().fold(f32::MAX, f32::min), all().fold(f32::MIN, f32::max))
        };
        assert_eq!((spread(&first), spread(&moved)), ((-10.0, 10.0), (-4.0, 16.0)));
        assert!(!first.is(&first.following(&Ground::Flat, DVec3::ZERO, 4.0, true)), "other colours");
        let lost = Underfoot::around(&Ground::Flat, DVec3::NAN, f64::INFINITY, false);
        assert_eq!(lost.mesh().fault(), None);
        let triangle = |patch: &Underfoot| {
            let [a, b, c] =
                [0, 1, 2].map(|i| Vec3::from(patch.mesh().positions[patch.mesh().indices[i] as usize]));
            (b - a).cross(c - a)
        };
        assert!(triangle(&first).y > 0.0, "seen from above");
    }
}
