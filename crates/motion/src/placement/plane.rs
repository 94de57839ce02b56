//! The plane that a foot stands on, fitted to the ground under its sole.

use glam::{DMat3, DVec2, DVec3};

use super::fade::smooth;
use super::footing::Foot;
use crate::Ground;

/// The steepest plane that a foot is laid on, rise over run: 40 degrees.
const STEEPEST: f64 = 0.84;
/// Ground so far below what the highest of it leads to still carries the sole; from the second on it doesn't, metres.
const STEP_DOWN_M: (f64, f64) = (0.03, 0.07);
/// The weight of the ground's own slope against that of heights, metres squared.
const SLOPE_WEIGHT: f64 = 1e-4;

/// A plane over the level: height at a place and rise over run along x and z.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Plane {
    pub at: DVec2,
    pub height: f64,
    pub gradient: DVec2,
}

impl Plane {
    /// The height at a place, metres.
    pub fn height_at(&self, at: DVec2) -> f64 {
        self.height + self.gradient.dot(at - self.at)
    }

    /// Unit normal, upward.
    pub fn normal(&self) -> DVec3 {
        DVec3::new(-self.gradient.x, 1.0, -self.gradient.y).normalize()
    }

    /// The plane on which a foot stands, given where its points are over the level. On ground with steps an edge may lie
    /// under any of the sole; elsewhere its corners tell enough.
    pub fn of_foot(ground: &Ground, at: DVec2, foot: &Foot, place: impl Fn(DVec3) -> DVec2) -> Plane {
        if ground.has_steps() {
            Plane::under(ground, at, &foot.sole.map(place))
        } else {
            Plane::under(ground, at, &foot.print.map(place))
        }
    }

    /// The plane on which a sole with those points stands, given about a place: least squares over the ground that
    /// carries it. Of ground with steps that is the highest: what lies lower than a step carries nothing.
    pub fn under<const N: usize>(ground: &Ground, at: DVec2, points: &[DVec2; N]) -> Plane {
        let (samples, highest) = samples(ground, at, points);
        let (mut square, mut right) = (DMat3::ZERO, DVec3::ZERO);
        for Patch { off, height, gradient } in samples {
            let weight = carries(highest - (height - gradient.dot(off)));
            let row = DVec3::new(1.0, off.x, off.y);
            square +=
                DMat3::from_cols(row * (weight * row.x), row * (weight * row.y), row * (weight * row.z));
            right += row * (weight * height);
            let slope = weight * SLOPE_WEIGHT;
            square += DMat3::from_diagonal(DVec3::new(0.0, slope, slope));
            right += DVec3::new(0.0, slope * gradient.x, slope * gradient.y);
        }
        let fit = square.inverse() * right;
        if !fit.is_finite() {
            return Plane { at, height: ground.height(at.x, at.y), gradient: DVec2::ZERO };
        }
        Plane { at, height: fit.x, gradient: DVec2::new(fit.y, fit.z).clamp_length_max(STEEPEST) }
    }

    /// The share of a sole's points that the ground would carry, 0 to 1; ground at places around it that is higher
    /// doesn't let it down.
    pub fn carried<const N: usize, const M: usize>(
        ground: &Ground,
        at: DVec2,
        points: &[DVec2; N],
        around: &[DVec2; M],
    ) -> f64 {
        let (samples, highest) = samples(ground, at, points);
        let highest = around.iter().map(|p| ground.height(p.x, p.y)).fold(highest, f64::max);
        let carried = samples.iter().map(|s| carries(highest - (s.height - s.gradient.dot(s.off))));
        carried.sum::<f64>() / N as f64
    }
}

/// The ground under one of a sole's points.
#[derive(Clone, Copy)]
struct Patch {
    off: DVec2,
    height: f64,
    gradient: DVec2,
}

/// The ground under a sole's points, and the height to which the highest of it leads at the sole's place.
fn samples<const N: usize>(ground: &Ground, at: DVec2, points: &[DVec2; N]) -> ([Patch; N], f64) {
    let samples = points.map(|point| {
        let (height, gradient) = ground.facet(point.x, point.y);
        Patch { off: point - at, height, gradient: gradient.clamp_length_max(STEEPEST) }
    });
    let highest = samples.iter().map(|s| s.height - s.gradient.dot(s.off)).fold(f64::NEG_INFINITY, f64::max);
    (samples, highest)
}

/// How much ground so far below what the highest leads to carries.
fn carries(low: f64) -> f64 {
    1.0 - smooth(low, STEP_DOWN_M.0, STEP_DOWN_M.1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Slope, Stairs};

    fn sole(at: DVec2) -> [DVec2; 5] {
        [(-0.02, -0.08), (0.02, -0.08), (-0.03, 0.08), (0.04, 0.08), (0.0, 0.15)]
            .map(|(x, z)| at + DVec2::new(x, z))
    }

    #[test]
    fn on_a_slope_it_is_the_slope() {
        let ground = Ground::Slope(Slope::new(20.0, 30.0));
        let at = DVec2::new(0.4, -0.3);
        let plane = Plane::under(&ground, at, &sole(at));
        assert!(plane.normal().distance(ground.under(0.0, 0.0).normal) < 1e-9);
        assert!((plane.height - ground.height(at.x, at.y)).abs() < 1e-12);
    }

    #[test]
    fn over_an_edge_it_is_the_upper_tread() {
        let ground = Ground::Stairs(Stairs::new(0.17, 0.29, 8, 3.0));
        for z in [1.45, 1.5, 1.55] {
            let at = DVec2::new(0.0, z);
            let plane = Plane::under(&ground, at, &sole(at));
            assert!((plane.height - 0.17).abs() < 1e-9 && plane.gradient.length() < 1e-9, "{plane:?}");
        }
    }
}
