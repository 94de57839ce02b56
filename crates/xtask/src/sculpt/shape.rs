//! The solids that the body is built from, as distances: negative inside, metres.

use glam::{DMat3, DVec3};

use super::blend::soft_max;
use super::curve::Curve;

/// A closed box along the world axes.
#[derive(Clone, Copy, Debug)]
pub struct Bounds {
    /// The lowest corner.
    pub low: DVec3,
    /// The highest corner.
    pub high: DVec3,
}

impl Bounds {
    /// How far two boxes are apart; 0 if they overlap.
    pub fn gap(&self, other: &Bounds) -> f64 {
        (self.low - other.high).max(other.low - self.high).max(DVec3::ZERO).length()
    }

    /// The box grown on all sides.
    pub fn grown(&self, by: f64) -> Bounds {
        Bounds { low: self.low - DVec3::splat(by), high: self.high + DVec3::splat(by) }
    }

    /// The smallest box around both.
    pub fn union(&self, other: &Bounds) -> Bounds {
        Bounds { low: self.low.min(other.low), high: self.high.max(other.high) }
    }
}

/// One section of a [`Loft`]: centre across (u, v), radii to +u, -u, +v, -v, and squareness 0 to 1.
pub type Section = [f64; 7];

/// A tube with a section for every place along a straight axis.
#[derive(Clone, Debug)]
pub struct Loft {
    /// Where the parameter is 0.
    pub origin: DVec3,
    /// Columns u, v and the axis; unit and square to each other.
    pub frame: DMat3,
    /// Sections by metres along the axis.
    pub sections: Curve<7>,
    /// Rounding of the two end faces in metres.
    pub cap: f64,
}

/// A solid.
#[derive(Clone, Debug)]
pub enum Shape {
    /// A ball stretched along three axes (columns of `frame`).
    Ellipsoid { center: DVec3, frame: DMat3, radii: DVec3 },
    /// Two balls and the cone that touches both.
    Cone { a: DVec3, b: DVec3, ra: f64, rb: f64 },
    /// A box with rounded edges; `half` includes the rounding.
    Slab { center: DVec3, frame: DMat3, half: DVec3, round: f64 },
    /// A tube through sections.
    Loft(Loft),
}

impl Shape {
    /// About the distance to the surface, negative inside. Exact in sign; near the surface also nearly in size.
    pub fn distance(&self, p: DVec3) -> f64 {
        match self {
            Shape::Ellipsoid { center, frame, radii } => ellipsoid(frame.transpose() * (p - *center), *radii),
            Shape::Cone { a, b, ra, rb } => cone(p, *a, *b, *ra, *rb),
            Shape::Slab { center, frame, half, round } => {
                let q = (frame.transpose() * (p - *center)).abs() - (*half - DVec3::splat(*round));
                q.max(DVec3::ZERO).length() + q.max_element().min(0.0) - round
            }
            Shape::Loft(loft) => loft.distance(p),
        }
    }

    /// A box around the solid.
    pub fn bounds(&self) -> Bounds {
        match self {
            Shape::Ellipsoid { center, frame, radii } => {
                let reach = |i: usize| (frame.row(i) * *radii).length();
                around(*center, DVec3::new(reach(0), reach(1), reach(2)))
            }
            Shape::Cone { a, b, ra, rb } => {
                around(*a, DVec3::splat(*ra)).union(&around(*b, DVec3::splat(*rb)))
            }
            Shape::Slab { center, frame, half, .. } => {
                let reach = |i: usize| frame.row(i).abs().dot(*half);
                around(*center, DVec3::new(reach(0), reach(1), reach(2)))
            }
            Shape::Loft(loft) => loft.bounds(),
        }
    }
}

fn around(center: DVec3, half: DVec3) -> Bounds {
    Bounds { low: center - half, high: center + half }
}

/// Quotient estimate: exact on the surface, first order near it.
fn ellipsoid(p: DVec3, radii: DVec3) -> f64 {
    let inner = (p / radii).length();
    let slope = (p / (radii * radii)).length();
    if slope < 1e-9 { -radii.min_element() } else { inner * (inner - 1.0) / slope }
}

/// Exact distance to the convex hull of two balls.
fn cone(p: DVec3, a: DVec3, b: DVec3, ra: f64, rb: f64) -> f64 {
    let axis = b - a;
    let l2 = axis.length_squared();
    let rr = ra - rb;
    let a2 = l2 - rr * rr;
    let pa = p - a;
    if a2 <= 0.0 {
        return if ra > rb { pa.length() - ra } else { (p - b).length() - rb };
    }
    let y = pa.dot(axis);
    let z = y - l2;
    let x2 = (pa * l2 - axis * y).length_squared();
    let (y2, z2) = (y * y * l2, z * z * l2);
    let k = rr.signum() * rr * rr * x2;
    if z.signum() * a2 * z2 > k {
        (x2 + z2).sqrt() / l2 - rb
    } else if y.signum() * a2 * y2 < k {
        (x2 + y2).sqrt() / l2 - ra
    } else {
        ((x2 * a2 / l2).sqrt() + y * rr) / l2 - ra
    }
}

impl Loft {
    fn distance(&self, p: DVec3) -> f64 {
        const STEP: f64 = 0.0005;
        let q = self.frame.transpose() * (p - self.origin);
        let (low, high) = self.sections.ends();
        let flat = DVec3::new(q.x, q.y, q.z.clamp(low, high));
        let step = if flat.z + STEP < high { STEP } else { -STEP };
        let (side, ahead) = (self.side(flat), self.side(flat + DVec3::Z * step));
        // Where the tube narrows, the way across is longer than the nearest one.
        let slant = (ahead - side) / STEP;
        let side = side / (1.0 + slant * slant).sqrt();
        soft_max(side, (low - q.z).max(q.z - high), self.cap)
    }

    /// Distance to the tube's wall within the section.
    fn side(&self, q: DVec3) -> f64 {
        let [cu, cv, right, left, front, back, square] = self.sections.sample(q.z);
        let (u, v) = (q.x - cu, q.y - cv);
        let a = u / if u > 0.0 { right } else { left };
        let b = v / if v > 0.0 { front } else { back };
        let (a2, b2) = (a * a, b * b);
        let round = (a2 + b2).sqrt();
        let boxy = (a2 * a2 + b2 * b2).sqrt().sqrt();
        let g = round + (boxy - round) * square;
        let rho = (u * u + v * v).sqrt();
        if g < 1e-6 { -right.min(left).min(front).min(back) } else { rho * (1.0 - 1.0 / g) }
    }

    fn bounds(&self) -> Bounds {
        let (low, high) = self.sections.ends();
        let mut all: Option<Bounds> = None;
        for (t, [cu, cv, right, left, front, back, _]) in self.sections.rows() {
            for (du, dv) in [(*right, *front), (*right, -back), (-left, *front), (-left, -back)] {
                let corner = self.origin + self.frame * DVec3::new(cu + du, cv + dv, t.clamp(low, high));
                let point = Bounds { low: corner, high: corner };
                all = Some(all.map_or(point, |b| b.union(&point)));
            }
        }
        all.unwrap_or(Bounds { low: self.origin, high: self.origin })
    }
}
