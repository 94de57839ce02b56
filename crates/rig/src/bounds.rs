//! An axis-aligned box.

use glam::Vec3;

/// An axis-aligned box, metres; empty if `min` exceeds `max` on any axis.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Bounds {
    /// Least coordinates.
    pub min: Vec3,
    /// Greatest coordinates.
    pub max: Vec3,
}

impl Bounds {
    /// The box of nothing.
    pub const EMPTY: Bounds = Bounds { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    /// The smallest box around all finite points.
    pub fn of(points: impl IntoIterator<Item = Vec3>) -> Bounds {
        points.into_iter().fold(Bounds::EMPTY, Bounds::with)
    }

    /// The box grown to hold a point; a point that is not finite changes nothing.
    pub fn with(self, p: Vec3) -> Bounds {
        if p.is_finite() { Bounds { min: self.min.min(p), max: self.max.max(p) } } else { self }
    }

    /// The smallest box around both.
    pub fn union(self, other: Bounds) -> Bounds {
        Bounds { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Whether it holds no point.
    pub fn is_empty(&self) -> bool {
        !self.min.cmple(self.max).all()
    }

    /// The middle; the origin if empty.
    pub fn center(&self) -> Vec3 {
        if self.is_empty() { Vec3::ZERO } else { (self.min + self.max) * 0.5 }
    }

    /// Half the diagonal: the radius of the ball about [`Bounds::center`] that holds the box; 0 if empty.
    pub fn radius(&self) -> f32 {
        if self.is_empty() { 0.0 } else { (self.max - self.min).length() * 0.5 }
    }

    /// The eight corners.
    pub fn corners(&self) -> [Vec3; 8] {
        std::array::from_fn(|i| {
            let pick = |bit: usize, a: f32, b: f32| if i & bit == 0 { a } else { b };
            Vec3::new(
                pick(1, self.min.x, self.max.x),
                pick(2, self.min.y, self.max.y),
                pick(4, self.min.z, self.max.z),
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_empty_and_a_bad_point_changes_nothing() {
        assert!(Bounds::EMPTY.is_empty());
        assert_eq!(Bounds::EMPTY.radius(), 0.0);
        let b = Bounds::of([Vec3::ZERO, Vec3::NAN, Vec3::new(2.0, 0.0, 0.0)]);
        assert_eq!(b.center(), Vec3::X);
        assert_eq!(b.radius(), 1.0);
        assert!(b.corners().iter().all(|&c| b.with(c) == b));
    }
}
