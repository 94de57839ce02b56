//! Convex outlines: capsules, ellipses and polygons with round corners, and how far a point is from them.

use egui::{Pos2, Vec2, pos2, vec2};

/// Points on a quarter of a circle.
const QUARTER: usize = 5;

/// Two discs and what lies between them. The discs may differ in size; neither holds the other.
pub fn capsule(from: (f32, f32), from_radius: f32, to: (f32, f32), to_radius: f32) -> Vec<Pos2> {
    let (a, b) = (pos2(from.0, from.1), pos2(to.0, to.1));
    let along = (b - a).normalized();
    // Where the common tangent touches: the sine of the cone's half angle is the difference of the radii over the length.
    let lean = ((from_radius - to_radius) / (b - a).length()).clamp(-1.0, 1.0).asin();
    let quarter = std::f32::consts::FRAC_PI_2;
    let mut outline = arc(b, to_radius, along, -(quarter - lean), quarter - lean);
    outline.extend(arc(a, from_radius, along, quarter - lean, 3.0 * quarter + lean));
    outline
}

/// An arc about a direction, from one angle to another.
fn arc(center: Pos2, radius: f32, along: Vec2, from: f32, to: f32) -> Vec<Pos2> {
    let steps = 2 * QUARTER;
    let at = |step: usize| {
        let angle = from + (to - from) * step as f32 / steps as f32;
        let (sin, cos) = angle.sin_cos();
        center + radius * vec2(along.x * cos - along.y * sin, along.x * sin + along.y * cos)
    };
    (0..=steps).map(at).collect()
}

/// An ellipse; its lower half is drawn in toward the chin by `taper`, 0 to 1.
pub fn egg(center: (f32, f32), radii: (f32, f32), taper: f32) -> Vec<Pos2> {
    let steps = 8 * QUARTER;
    let at = |step: usize| {
        let (sin, cos) = (std::f32::consts::TAU * step as f32 / steps as f32).sin_cos();
        let narrow = 1.0 - taper * sin.max(0.0).powi(2);
        pos2(center.0 + radii.0 * cos * narrow, center.1 + radii.1 * sin)
    };
    (0..steps).map(at).collect()
}

/// A convex polygon whose corners are rounded, each from `radius` before to `radius` after it at most.
pub fn rounded(corners: &[(f32, f32)], radius: f32) -> Vec<Pos2> {
    let count = corners.len();
    let corner = |i: usize| {
        let (x, y) = corners[i % count];
        pos2(x, y)
    };
    let mut outline = Vec::with_capacity(count * (QUARTER + 1));
    for i in 0..count {
        let (before, here, after) = (corner(i + count - 1), corner(i), corner(i + 1));
        let cut = |to: Pos2| here + (to - here).normalized() * radius.min((to - here).length() * 0.5);
        let (first, last) = (cut(before), cut(after));
        for step in 0..=QUARTER {
            let t = step as f32 / QUARTER as f32;
            outline.push(first.lerp(here, t).lerp(here.lerp(last, t), t));
        }
    }
    outline
}

/// How far a point is from a convex outline: 0 inside.
pub fn distance(outline: &[Pos2], point: Pos2) -> f32 {
    let edges = || outline.iter().zip(outline.iter().cycle().skip(1));
    let turn = |(a, b): (&Pos2, &Pos2)| {
        let (edge, to) = (*b - *a, point - *a);
        edge.x * to.y - edge.y * to.x
    };
    let left = edges().all(|edge| turn(edge) >= 0.0);
    if left || edges().all(|edge| turn(edge) <= 0.0) {
        return 0.0;
    }
    let to_edge = |(a, b): (&Pos2, &Pos2)| {
        let (edge, to) = (*b - *a, point - *a);
        let t = (to.dot(edge) / edge.length_sq().max(1e-6)).clamp(0.0, 1.0);
        (to - edge * t).length()
    };
    edges().map(to_edge).fold(f32::INFINITY, f32::min)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_convex(outline: &[Pos2]) -> bool {
        let n = outline.len();
        let turn = |i: usize| {
            let (a, b, c) = (outline[i], outline[(i + 1) % n], outline[(i + 2) % n]);
            (b - a).x * (c - b).y - (b - a).y * (c - b).x
        };
        (0..n).all(|i| turn(i) >= -1e-3) || (0..n).all(|i| turn(i) <= 1e-3)
    }

    #[test]
    fn outlines_are_convex() {
        assert!(is_convex(&capsule((0.0, 0.0), 7.0, (3.0, 40.0), 4.0)));
        assert!(is_convex(&capsule((0.0, 0.0), 2.0, (-20.0, 5.0), 4.0)));
        assert!(is_convex(&egg((0.0, 18.0), (12.5, 16.0), 0.2)));
        assert!(is_convex(&rounded(&[(-9.0, 0.0), (9.0, 0.0), (12.0, 20.0), (-12.0, 20.0)], 4.0)));
    }

    #[test]
    fn a_capsule_reaches_its_discs_and_no_farther() {
        let outline = capsule((0.0, 0.0), 4.0, (0.0, 20.0), 2.0);
        let near = |x, y| distance(&outline, pos2(x, y));
        assert_eq!(near(0.0, -3.9), 0.0);
        assert_eq!(near(0.0, 21.9), 0.0);
        assert!((near(0.0, 25.0) - 3.0).abs() < 0.05, "{}", near(0.0, 25.0));
        assert_eq!(near(3.9, 0.0), 0.0);
        assert!(near(3.9, 20.0) > 1.5);
    }

    #[test]
    fn a_round_corner_is_cut() {
        let outline = rounded(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)], 4.0);
        assert!(distance(&outline, pos2(0.1, 0.1)) > 0.5);
        assert_eq!(distance(&outline, pos2(0.1, 5.0)), 0.0);
    }
}
