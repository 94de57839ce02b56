//! Closed outlines in a plane, counter-clockwise, with rounded corners.

use std::f64::consts::PI;

use glam::DVec2;

/// Segments of a half turn of a rounded corner of a radius of 10 cm or more; smaller ones have fewer.
const ROUND: f64 = 12.0;
/// Turns of less than this are round, radians.
const SMOOTH: f64 = 0.62;

/// A closed polygon, counter-clockwise.
#[derive(Clone, Debug)]
pub struct Outline(pub Vec<DVec2>);

impl Outline {
    /// Corners with the radius of each. A radius for which an edge has no room is as large as the room.
    pub fn rounded(corners: &[[f64; 3]]) -> Outline {
        let count = corners.len();
        let at = |i: usize| DVec2::new(corners[i % count][0], corners[i % count][1]);
        let mut points = Vec::new();
        for (i, [_, _, radius]) in corners.iter().enumerate() {
            let (corner, radius) = (at(i), *radius);
            let [back, on] = [at(i + count - 1) - corner, at(i + 1) - corner];
            let (u, v) = (back.normalize(), on.normalize());
            let half = 0.5 * u.angle_to(v).abs();
            // How far from the corner the arc begins.
            let reach = (radius / half.tan()).min(0.49 * back.length()).min(0.49 * on.length());
            if radius <= 0.0 || reach < 1e-4 || half > 0.5 * PI - 1e-3 {
                points.push(corner);
                continue;
            }
            let (radius, sweep) = (reach * half.tan(), PI - 2.0 * half);
            let middle = corner + (u + v).normalize() * (radius / half.sin());
            let start = corner + u * reach - middle;
            let steps = (ROUND * sweep / PI * (radius / 0.1).min(1.0).sqrt()).ceil().max(1.0);
            let sense = u.perp_dot(v).signum();
            for k in 0..=steps as usize {
                let angle = -sense * sweep * k as f64 / steps;
                points.push(middle + DVec2::from_angle(angle).rotate(start));
            }
        }
        Outline(points)
    }

    /// A bar with round ends from one point to another.
    pub fn bar(from: DVec2, to: DVec2, radius: f64) -> Outline {
        let along = (to - from).normalize() * radius;
        let across = along.perp();
        let corners =
            [from - along - across, to + along - across, to + along + across, from - along + across];
        Outline::rounded(&corners.map(|p| [p.x, p.y, radius * 0.999]))
    }

    /// The unit normal of the edge that begins at a point.
    pub fn normal(&self, i: usize) -> DVec2 {
        let count = self.0.len();
        -(self.0[(i + 1) % count] - self.0[i % count]).normalize().perp()
    }

    /// The normals with which an edge begins and ends: shared with its neighbours where the corner is round.
    pub fn normals(&self, i: usize) -> [DVec2; 2] {
        let count = self.0.len();
        let own = self.normal(i);
        let shared = |other: DVec2| {
            if own.angle_to(other).abs() < SMOOTH { (own + other).normalize() } else { own }
        };
        [shared(self.normal(i + count - 1)), shared(self.normal(i + 1))]
    }

    /// Drawn inward by a distance, corner by corner.
    #[must_use]
    pub fn inset(&self, by: f64) -> Outline {
        let count = self.0.len();
        let moved = |i: usize| {
            let (a, b) = (self.normal(i + count - 1), self.normal(i));
            let miter = a + b;
            self.0[i] - miter * (2.0 * by / miter.length_squared()).min(2.0 * by)
        };
        Outline((0..count).map(moved).collect())
    }

    /// Triangles that fill it, as numbers of its points: ear by ear.
    pub fn filled(&self) -> Vec<[usize; 3]> {
        let mut left: Vec<usize> = (0..self.0.len()).collect();
        let mut triangles = Vec::new();
        while left.len() > 3 {
            let count = left.len();
            let ear = |&k: &usize| {
                let [a, b, c] = [left[(k + count - 1) % count], left[k], left[(k + 1) % count]];
                let [p, q, r] = [self.0[a], self.0[b], self.0[c]];
                let empty = || {
                    let inside = |s: DVec2| {
                        (q - p).perp_dot(s - p) >= 0.0
                            && (r - q).perp_dot(s - q) >= 0.0
                            && (p - r).perp_dot(s - r) >= 0.0
                    };
                    !left.iter().any(|&s| s != a && s != b && s != c && inside(self.0[s]))
                };
                (q - p).perp_dot(r - q) > 0.0 && empty()
            };
            // An outline that doesn't cross itself always has an ear; one of many straight points has flat ones.
            let k = (0..count).find(ear).unwrap_or(0);
            triangles.push([left[(k + count - 1) % count], left[k], left[(k + 1) % count]]);
            left.remove(k);
        }
        triangles.push([left[0], left[1], left[2]]);
        triangles
    }
}
