//! The plane that a foot stands on, fitted to the ground under its sole.

use glam::{DMat3, DVec2, DVec3};

use super::fade::smooth;
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

    /// The plane on which a sole with those points stands, given about a place: least squares over the ground that
    /// carries it. Of ground with steps that is the highest: what lies lower than a step carries nothing.
    pub fn under(ground: &Ground, at: DVec2, points: &[DVec2]) -> Plane {
        // More than the points of any sole isn't asked for.
        let mut samples = [(DVec2::ZERO, 0.0, DVec2::ZERO); 8];
        let samples = &mut samples[..points.len().min(8)];
        let mut highest = f64::NEG_INFINITY;
        for (sample, point) in samples.iter_mut().zip(points) {
            let found = ground.under(point.x, point.y);
            let n = found.normal;
            let gradient = -DVec2::new(n.x, n.z) / n.y.max(0.1);
            *sample = (*point - at, found.height, gradient.clamp_length_max(STEEPEST));
            highest = highest.max(found.height - sample.2.dot(sample.0));
        }
        let (mut square, mut right) = (DMat3::ZERO, DVec3::ZERO);
        for (off, height, gradient) in samples.iter() {
            let low = highest - (height - gradient.dot(*off));
            let weight = 1.0 - smooth(low, STEP_DOWN_M.0, STEP_DOWN_M.1);
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
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Slope, Stairs};

    fn sole(at: DVec2) -> Vec<DVec2> {
        [(-0.02, -0.08), (0.02, -0.08), (-0.03, 0.08), (0.04, 0.08), (0.0, 0.15)]
            .map(|(x, z)| at + DVec2::new(x, z))
            .to_vec()
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
