//! From the proportions that the body was drawn in to those of a skeleton.
//!
//! Shapes are written down once, in the places of the shipped mannequin. A [`Fit`] stretches them along a chain of
//! joints, so that they follow the joints of another skeleton; across the chain they grow with the whole figure.

use glam::{DMat3, DVec3, DVec4};
use rig::{Bone, Skeleton};

use super::blend::{ease, mix};
use super::curve::Curve;
use super::shape::{Bead, Loft, Section, Shape, Slit};

/// Hips height in the proportions that the body is drawn in, metres.
const DRAWN_HIPS: f64 = 0.94;

/// A map along one axis through drawn places and the skeleton's.
#[derive(Clone, Debug)]
pub struct Fit {
    axis: DVec3,
    stops: Vec<(DVec3, DVec3)>,
    girth: f64,
}

/// How much larger the whole figure is than the drawn one.
pub fn figure_scale(skeleton: &Skeleton) -> f64 {
    let height = skeleton.rest_position(Bone::Hips).y;
    if height > 0.05 { height / DRAWN_HIPS } else { 1.0 }
}

impl Fit {
    /// Along a chain: bones with their drawn places, in order along `axis`. Bones that the skeleton lacks are left out.
    pub fn chain(skeleton: &Skeleton, axis: DVec3, drawn: &[(Bone, [f64; 3])]) -> Fit {
        let stops = drawn
            .iter()
            .filter(|(bone, _)| skeleton.joint(*bone).is_some())
            .map(|(bone, place)| (DVec3::from(*place), skeleton.rest_position(*bone)))
            .collect();
        Fit { axis, stops, girth: figure_scale(skeleton) }
    }

    /// The scale across the chain.
    pub fn girth(&self) -> f64 {
        self.girth
    }

    /// Overrides the scale across the chain.
    pub fn with_girth(mut self, girth: f64) -> Fit {
        self.girth = girth;
        self
    }

    /// A drawn point in the skeleton's proportions.
    pub fn point(&self, drawn: [f64; 3]) -> DVec3 {
        let p = DVec3::from(drawn);
        let along = |q: DVec3| q.dot(self.axis);
        let Some(((first, to), rest)) = self.stops.split_first() else { return p * self.girth };
        if rest.is_empty() || along(p) <= along(*first) {
            return *to + (p - *first) * self.girth;
        }
        for ((a, fit_a), (b, fit_b)) in self.stops.iter().zip(rest) {
            let span = along(*b) - along(*a);
            let t = (along(p) - along(*a)) / span;
            if t <= 1.0 && span > 1e-9 {
                let base = a.lerp(*b, t);
                return fit_a.lerp(*fit_b, t) + (p - base) * self.girth;
            }
        }
        let (last, fit_last) = self.stops[self.stops.len() - 1];
        fit_last + (p - last) * self.girth
    }

    /// A ball stretched along the axes of the world.
    pub fn ball(&self, at: [f64; 3], radii: [f64; 3]) -> Shape {
        Shape::Ellipsoid {
            center: self.point(at),
            frame: DMat3::IDENTITY,
            radii: DVec3::from(radii) * self.girth,
        }
    }

    /// A ball with its first radius along `long` and its second near `up`.
    pub fn egg(&self, at: [f64; 3], radii: [f64; 3], long: [f64; 3], up: [f64; 3]) -> Shape {
        let frame = frame(DVec3::from(long), DVec3::from(up));
        Shape::Ellipsoid { center: self.point(at), frame, radii: DVec3::from(radii) * self.girth }
    }

    /// Two balls and the cone around both.
    pub fn cone(&self, a: [f64; 3], ra: f64, b: [f64; 3], rb: f64) -> Shape {
        Shape::Cone { a: self.point(a), b: self.point(b), ra: ra * self.girth, rb: rb * self.girth }
    }

    /// A tube along a smooth line through places with radii (x, y, z, radius). A line that ends on the middle plane
    /// meets its mirror image without a kink.
    pub fn strand(&self, knots: &[[f64; 4]]) -> Shape {
        let row = |k: &[f64; 4]| DVec4::from(*k);
        let mirrored = |v: DVec4| DVec4::new(-v.x, v.y, v.z, v.w);
        let outer = |end: DVec4, next: DVec4| if end.x == 0.0 { mirrored(next) } else { 2.0 * end - next };
        let Some((last, before)) = knots.split_last() else { return Shape::Strand(Vec::new()) };
        let mut line: Vec<DVec4> = Vec::with_capacity(knots.len() + 2);
        line.push(outer(row(&knots[0]), row(knots.get(1).unwrap_or(last))));
        line.extend(knots.iter().map(row));
        line.push(outer(row(last), row(before.last().unwrap_or(last))));
        let mut beads = Vec::new();
        for w in line.windows(4) {
            for step in 0..STRAND_STEPS {
                beads.push(through(w, f64::from(step) / f64::from(STRAND_STEPS)));
            }
        }
        beads.push(row(last));
        let bead = |v: DVec4| (self.point([v.x, v.y, v.z]), v.w.max(1e-5) * self.girth);
        Shape::Strand(beads.into_iter().map(bead).collect())
    }

    /// A ridge along a smooth line through places with radii, to swell the skin with; all of its height is there in
    /// the middle fifth of the line.
    pub fn ridge(&self, knots: &[[f64; 4]]) -> Shape {
        let Shape::Strand(line) = self.strand(knots) else { return Shape::Ridge(Vec::new()) };
        let mut far = vec![0.0];
        for w in line.windows(2) {
            far.push(far[far.len() - 1] + w[0].0.distance(w[1].0));
        }
        let length = far[far.len() - 1];
        let least = line.iter().map(|b| b.1).fold(f64::MAX, f64::min);
        let steps = (length / (0.45 * least)).ceil().clamp(2.0, 200.0);
        let bead = |i: usize| {
            let s = (i as f64 + 0.5) / steps;
            let k = far.partition_point(|&f| f <= s * length).clamp(1, line.len() - 1);
            let t = (s * length - far[k - 1]) / (far[k] - far[k - 1]).max(1e-12);
            let r = mix(line[k - 1].1, line[k].1, t);
            let fade = ease(0.0, 0.4, s) * ease(1.0, 0.6, s);
            // A ball of radius 1 sums to 32/35 along a line through its centre.
            let share = fade * (length / steps) * 35.0 / (32.0 * r);
            Bead { at: line[k - 1].0.lerp(line[k].0, t), r2: r * r, share }
        };
        Shape::Ridge((0..steps as usize).map(bead).collect())
    }

    /// A slit on a ball's front: rows of metres beside the centre, lower and upper edge; see [`Slit`].
    pub fn slit(&self, at: [f64; 3], radius: f64, floor: f64, rows: &[(f64, [f64; 2])]) -> Shape {
        let g = self.girth;
        let rows: Vec<(f64, [f64; 2])> = rows.iter().map(|(x, e)| (x * g, e.map(|e| e * g))).collect();
        Shape::Slit(Slit {
            center: self.point(at),
            radius: radius * g,
            edges: Curve::new(&rows),
            floor: floor * g,
        })
    }

    /// A rounded box along the axes of the world.
    pub fn slab(&self, at: [f64; 3], half: [f64; 3], round: f64) -> Shape {
        Shape::Slab {
            center: self.point(at),
            frame: DMat3::IDENTITY,
            half: DVec3::from(half) * self.girth,
            round: round * self.girth,
        }
    }

    /// As [`Fit::loft`] through sections whose bends flow on without jumps.
    pub fn limb(&self, through: [f64; 3], u: DVec3, v: DVec3, cap: f64, knots: &[(f64, Section)]) -> Shape {
        let Shape::Loft(mut loft) = self.loft(through, u, v, cap, knots) else {
            return Shape::Strand(Vec::new());
        };
        let rows: Vec<(f64, Section)> = loft.sections.rows().map(|(t, row)| (t, *row)).collect();
        loft.sections = Curve::flowing(&rows);
        Shape::Loft(loft)
    }

    /// A tube: sections by drawn place along `axis` (through `through`), radii to +u, -u, +v, -v with u x v = axis.
    pub fn loft(&self, through: [f64; 3], u: DVec3, v: DVec3, cap: f64, knots: &[(f64, Section)]) -> Shape {
        let axis = u.cross(v);
        let through = DVec3::from(through);
        let across = through - axis * through.dot(axis);
        let rows: Vec<(f64, Section)> = knots
            .iter()
            .map(|(t, [cu, cv, right, left, front, back, square])| {
                let at = self.point((across + axis * *t).to_array());
                let g = self.girth;
                let row = [
                    at.dot(u) + cu * g,
                    at.dot(v) + cv * g,
                    right * g,
                    left * g,
                    front * g,
                    back * g,
                    *square,
                ];
                (at.dot(axis), row)
            })
            .collect();
        Shape::Loft(Loft {
            origin: DVec3::ZERO,
            frame: DMat3::from_cols(u, v, axis),
            sections: Curve::new(&rows),
            cap: cap * self.girth,
        })
    }
}

/// Straight pieces between two places of a strand.
const STRAND_STEPS: u32 = 4;

/// The curve through the two inner ones of four rows.
fn through(rows: &[DVec4], t: f64) -> DVec4 {
    let (t2, t3) = (t * t, t * t * t);
    0.5 * (rows[0] * (2.0 * t2 - t - t3)
        + rows[1] * (2.0 - 5.0 * t2 + 3.0 * t3)
        + rows[2] * (t + 4.0 * t2 - 3.0 * t3)
        + rows[3] * (t3 - t2))
}

/// Columns: along `long`, as near to `up` as can be, and the third.
fn frame(long: DVec3, up: DVec3) -> DMat3 {
    let x = long.normalize();
    let z = x.cross(up).try_normalize().unwrap_or_else(|| x.any_orthonormal_vector());
    DMat3::from_cols(x, z.cross(x), z)
}
