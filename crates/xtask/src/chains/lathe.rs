//! Turned parts: an outline of (distance from the axis, height) turned about z.

use std::f64::consts::TAU;

use glam::DVec3;

use super::outline::Outline;
use super::solid::Solid;

/// Segments around.
const AROUND: usize = 28;

/// The outline turned about z; no point of it may lie beyond the axis. Edges on the axis vanish.
pub fn turned(outline: &Outline) -> Solid {
    let mut solid = Solid::default();
    let count = outline.0.len();
    let around = |k: usize| {
        let angle = TAU * (k % AROUND) as f64 / AROUND as f64;
        DVec3::new(angle.cos(), angle.sin(), 0.0)
    };
    for i in 0..count {
        let ends = [outline.0[i], outline.0[(i + 1) % count]];
        let normals = outline.normals(i);
        for k in 0..AROUND {
            let corner = |end: usize, k: usize| {
                let (p, n, a) = (ends[end], normals[end], around(k));
                (a * p.x + DVec3::Z * p.y, a * n.x + DVec3::Z * n.y)
            };
            solid.quad([corner(0, k), corner(0, k + 1), corner(1, k + 1), corner(1, k)]);
        }
    }
    solid
}
