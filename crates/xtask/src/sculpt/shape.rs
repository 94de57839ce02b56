//! The solids that the body is built from, as distances: negative inside, metres.

use glam::{DMat3, DVec3};

use super::blend::{FAR, mix, soft_max};
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
    /// Balls and the cones between neighbours: a tube along a bent line. Centres with radii, at least one.
    Strand(Vec<(DVec3, f64)>),
    /// Balls so close that their falls add up to a smooth ridge along a line, which fades towards both ends.
    Ridge(Vec<Bead>),
    /// What a ball's centre sees through a slit in its front (+Z), from `floor` metres on to a third over the radius.
    Slit(Slit),
}

/// One ball of a ridge.
#[derive(Clone, Copy, Debug)]
pub struct Bead {
    /// Its centre.
    pub at: DVec3,
    /// The square of its radius.
    pub r2: f64,
    /// Its part of the ridge's height.
    pub share: f64,
}

/// A slit on a ball, as between two lids.
#[derive(Clone, Debug)]
pub struct Slit {
    /// The ball's centre.
    pub center: DVec3,
    /// The ball's radius, on which the slit is drawn.
    pub radius: f64,
    /// Lower and upper edge (metres above the centre) by metres beside it; they meet at both ends.
    pub edges: Curve<2>,
    /// Nothing nearer to the centre belongs to the solid, metres.
    pub floor: f64,
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
            Shape::Strand(beads) => strand(p, beads),
            Shape::Ridge(beads) => beads.iter().map(|b| p.distance(b.at) - b.r2.sqrt()).fold(FAR, f64::min),
            Shape::Slit(slit) => slit.distance(p),
        }
    }

    /// 1 at the core of the solid, 0 from its surface on, smooth in between; the core is a ball's centre, or the line of
    /// a ridge, a cone or a strand. Other solids have none.
    pub fn core(&self, p: DVec3) -> f64 {
        match self {
            Shape::Ellipsoid { center, frame, radii } => {
                fall((frame.transpose() * (p - *center) / *radii).length_squared())
            }
            Shape::Ridge(beads) => {
                beads.iter().map(|b| b.share * fall((p - b.at).length_squared() / b.r2)).sum()
            }
            Shape::Cone { a, b, ra, rb } => along(p, (*a, *ra), (*b, *rb)),
            Shape::Strand(beads) => {
                beads.windows(2).map(|pair| along(p, pair[0], pair[1])).fold(0.0, f64::max)
            }
            Shape::Slab { .. } | Shape::Loft(_) | Shape::Slit(_) => 0.0,
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
            Shape::Strand(beads) => {
                let each = beads.iter().map(|(at, r)| around(*at, DVec3::splat(*r)));
                each.reduce(|a, b| a.union(&b)).unwrap_or(around(DVec3::ZERO, DVec3::ZERO))
            }
            Shape::Ridge(beads) => {
                let each = beads.iter().map(|b| around(b.at, DVec3::splat(b.r2.sqrt())));
                each.reduce(|a, b| a.union(&b)).unwrap_or(around(DVec3::ZERO, DVec3::ZERO))
            }
            Shape::Slit(slit) => around(slit.center, DVec3::splat(slit.radius * 1.4)),
        }
    }
}

/// 1 on the line between two balls, 0 from the radius there on.
fn along(p: DVec3, (a, ra): (DVec3, f64), (b, rb): (DVec3, f64)) -> f64 {
    let line = b - a;
    let t = ((p - a).dot(line) / line.length_squared().max(1e-18)).clamp(0.0, 1.0);
    fall((p - a - line * t).length_squared() / mix(ra, rb, t).powi(2).max(1e-18))
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

/// From 1 at no distance to 0 at one radius, by the square of the distance in radii.
fn fall(r2: f64) -> f64 {
    let left = (1.0 - r2).max(0.0);
    left * left * left
}

/// Distance to the nearest of the cones between neighbours.
fn strand(p: DVec3, beads: &[(DVec3, f64)]) -> f64 {
    if let [(at, r)] = beads {
        return p.distance(*at) - r;
    }
    beads.windows(2).map(|w| cone(p, w[0].0, w[1].0, w[0].1, w[1].1)).fold(FAR, f64::min)
}

impl Slit {
    fn distance(&self, p: DVec3) -> f64 {
        const STEP: f64 = 0.0003;
        let d = p - self.center;
        let far = d.length().max(1e-6);
        let q = d * (self.radius / far);
        let (low, high) = self.edges.ends();
        let x = q.x.clamp(low, high);
        let gap = |x: f64| {
            let [below, above] = self.edges.sample(x);
            (q.y - above).max(below - q.y)
        };
        let step = if x + STEP < high { STEP } else { -STEP };
        let slant = (gap(x + step) - gap(x)) / STEP;
        let side = gap(x) / (1.0 + slant * slant).sqrt();
        let beyond = (q.x - x).abs();
        let side = if beyond > 0.0 { (side.max(0.0).powi(2) + beyond * beyond).sqrt() } else { side };
        (side * (far / self.radius)).max(self.floor - far).max(far - 1.35 * self.radius).max(-d.z)
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
