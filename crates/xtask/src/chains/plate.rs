//! Plates: an outline in the plane of x and z, thick along y, with bevelled edges.

use glam::{DVec2, DVec3};

use super::outline::Outline;
use super::solid::Solid;

fn placed(p: DVec2, y: f64) -> DVec3 {
    DVec3::new(p.x, y, p.y)
}

/// A plate from y = -`half` to `half` whose edges are cut off by `bevel`, metres.
pub fn plate(outline: &Outline, half: f64, bevel: f64) -> Solid {
    let face = outline.inset(bevel);
    let mut solid = Solid::default();
    let count = outline.0.len();
    for i in 0..count {
        let j = (i + 1) % count;
        let flat = outline.normals(i).map(|n| placed(n, 0.0));
        let edge = half - bevel;
        let at = |outline: &Outline, k: usize, y: f64| placed(outline.0[k], y);
        // What is counter-clockwise in (x, z) is so as seen from -y.
        solid.quad([
            (at(outline, i, -edge), flat[0]),
            (at(outline, i, edge), flat[0]),
            (at(outline, j, edge), flat[1]),
            (at(outline, j, -edge), flat[1]),
        ]);
        for side in [-1.0, 1.0] {
            let leaning = flat.map(|n| (n + DVec3::Y * side).normalize());
            let mut corners = [
                (at(outline, i, side * edge), leaning[0]),
                (at(&face, i, side * half), leaning[0]),
                (at(&face, j, side * half), leaning[1]),
                (at(outline, j, side * edge), leaning[1]),
            ];
            if side < 0.0 {
                corners.reverse();
            }
            solid.quad(corners);
        }
    }
    for side in [-1.0, 1.0] {
        for [a, b, c] in face.filled() {
            let at = |k: usize| (placed(face.0[k], side * half), DVec3::Y * side);
            solid.triangle(if side < 0.0 { [at(a), at(b), at(c)] } else { [at(a), at(c), at(b)] });
        }
    }
    solid
}
