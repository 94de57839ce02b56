//! From the proportions that the body was drawn in to those of a skeleton.
//!
//! Shapes are written down once, in the places of the shipped mannequin. A [`Fit`] stretches them along a chain of
//! joints, so that they follow the joints of another skeleton; across the chain they grow with the whole figure.

use glam::{DMat3, DVec3};
use rig::{Bone, Skeleton};

use super::curve::Curve;
use super::shape::{Loft, Section, Shape};

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

    /// A rounded box along the axes of the world.
    pub fn slab(&self, at: [f64; 3], half: [f64; 3], round: f64) -> Shape {
        Shape::Slab {
            center: self.point(at),
            frame: DMat3::IDENTITY,
            half: DVec3::from(half) * self.girth,
            round: round * self.girth,
        }
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

/// Columns: along `long`, as near to `up` as can be, and the third.
fn frame(long: DVec3, up: DVec3) -> DMat3 {
    let x = long.normalize();
    let z = x.cross(up).try_normalize().unwrap_or_else(|| x.any_orthonormal_vector());
    DMat3::from_cols(x, z.cross(x), z)
}
