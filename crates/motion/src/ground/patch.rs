//! Ground as triangles to draw.

use glam::{DVec2, DVec3};
use rig::Mesh;

use super::{Ground, Hills, Stairs, Stones};

/// The two lights of the checker, linear RGB, and the darker one of gaps and risers.
const SQUARES: [[f32; 3]; 2] = [[0.60, 0.60, 0.585], [0.52, 0.52, 0.51]];
const SHADE: [f32; 3] = [0.36, 0.36, 0.36];

pub(super) fn patch(ground: &Ground, center: DVec2, half_extent_m: f64) -> Mesh {
    let center = if center.is_finite() { center } else { DVec2::ZERO };
    let half = if half_extent_m.is_nan() { 0.5 } else { half_extent_m.clamp(0.5, 60.0) };
    let (low, high) = (center - half, center + half);
    let mut sheet = Drawing::default();
    match ground {
        Ground::Hills(hills) => sheet.hills(hills, low, high),
        Ground::Stairs(stairs) => sheet.stairs(stairs, low, high),
        Ground::Stones(stones) => sheet.stones(stones, low, high),
        Ground::Mesh(mesh) => {
            for (corners, normal) in mesh.triangles(low, high) {
                let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
                sheet.polygon(corners, *normal, square(middle.x, middle.z));
            }
            for (corners, normal) in mesh.walls(low, high) {
                sheet.polygon(corners, *normal, SHADE);
            }
        }
        Ground::Flat | Ground::Slope(_) => sheet.squares(ground, low, high),
    }
    sheet.0
}

/// The checker's colour at a place.
fn square(x: f64, z: f64) -> [f32; 3] {
    SQUARES[((x.floor() + z.floor()).rem_euclid(2.0)) as usize]
}

#[derive(Default)]
struct Drawing(Mesh);

impl Drawing {
    fn vertex(&mut self, position: DVec3, normal: DVec3, color: [f32; 3]) {
        self.0.positions.push(position.as_vec3().to_array());
        self.0.normals.push(normal.as_vec3().to_array());
        self.0.colors.push(color);
        self.0.joints.push([0; 4]);
        self.0.weights.push([u16::MAX, 0, 0, 0]);
    }

    /// A fan, turned so that it is counter-clockwise seen against its normal.
    fn polygon(&mut self, corners: &[DVec3], normal: DVec3, color: [f32; 3]) {
        let first = self.0.positions.len() as u32;
        let [a, b, c, ..] = corners else { return };
        let backward = (*b - *a).cross(*c - *a).dot(normal) < 0.0;
        for corner in corners {
            self.vertex(*corner, normal, color);
        }
        for last in 2..corners.len() as u32 {
            let (b, c) = if backward { (last, last - 1) } else { (last - 1, last) };
            self.0.indices.extend([first, first + b, first + c]);
        }
    }

    /// A level strip between two corners at a height, cut into squares of the checker.
    fn level(&mut self, low: DVec2, high: DVec2, height: impl Fn(DVec2) -> DVec3, normal: DVec3) {
        for (z0, z1) in cuts(low.y, high.y) {
            for (x0, x1) in cuts(low.x, high.x) {
                let at = [(x0, z0), (x0, z1), (x1, z1), (x1, z0)].map(|(x, z)| height(DVec2::new(x, z)));
                self.polygon(&at, normal, square(0.5 * (x0 + x1), 0.5 * (z0 + z1)));
            }
        }
    }

    fn squares(&mut self, ground: &Ground, low: DVec2, high: DVec2) {
        let normal = ground.under(low.x, low.y).normal;
        self.level(low, high, |at| DVec3::new(at.x, ground.height(at.x, at.y), at.y), normal);
    }

    fn hills(&mut self, hills: &Hills, low: DVec2, high: DVec2) {
        let cell = hills.shape().cell_m;
        let corner = |i: i64, j: i64| DVec3::new(i as f64 * cell, hills.corner(i, j), j as f64 * cell);
        // The surface's normal at a corner by central differences: facets fade into rolling ground.
        let normal = |i: i64, j: i64| {
            let along_x = (hills.corner(i + 1, j) - hills.corner(i - 1, j)) / (2.0 * cell);
            let along_z = (hills.corner(i, j + 1) - hills.corner(i, j - 1)) / (2.0 * cell);
            DVec3::new(-along_x, 1.0, -along_z).normalize()
        };
        let whole = |value: f64| (value / cell).floor() as i64;
        for j in whole(low.y)..=whole(high.y) {
            for i in whole(low.x)..=whole(high.x) {
                let first = self.0.positions.len() as u32;
                let color = square((i as f64 + 0.5) * cell, (j as f64 + 0.5) * cell);
                for (i, j) in [(i, j), (i, j + 1), (i + 1, j + 1), (i + 1, j)] {
                    self.vertex(corner(i, j), normal(i, j), color);
                }
                self.0.indices.extend([0, 1, 2, 0, 2, 3].map(|corner| first + corner));
            }
        }
    }

    fn stairs(&mut self, stairs: &Stairs, low: DVec2, high: DVec2) {
        let mut before: Option<f64> = None;
        for (from, to, height) in stairs.treads(low.y, high.y) {
            if let Some(last) = before.replace(height) {
                let normal = if height > last { -DVec3::Z } else { DVec3::Z };
                for (x0, x1) in cuts(low.x, high.x) {
                    let riser = [(x0, last), (x1, last), (x1, height), (x0, height)];
                    self.polygon(&riser.map(|(x, y)| DVec3::new(x, y, from)), normal, SHADE);
                }
            }
            let (near, far) = (DVec2::new(low.x, from), DVec2::new(high.x, to));
            self.level(near, far, |at| DVec3::new(at.x, height, at.y), DVec3::Y);
        }
    }

    fn stones(&mut self, stones: &Stones, low: DVec2, high: DVec2) {
        let gap = stones.gap();
        let floor = [(low.x, low.y), (low.x, high.y), (high.x, high.y), (high.x, low.y)];
        self.polygon(&floor.map(|(x, z)| DVec3::new(x, gap, z)), DVec3::Y, SHADE);
        for (number, stone) in stones.stones(low, high).into_iter().enumerate() {
            let (a, b) = (stone.low, stone.high);
            let top = [DVec2::new(a.x, a.y), DVec2::new(a.x, b.y), b, DVec2::new(b.x, a.y)];
            let top = top.map(|at| DVec3::new(at.x, stone.height(at), at.y));
            self.polygon(&top, stone.normal(), SQUARES[number % 2]);
            for (edge, out) in [-DVec3::X, DVec3::Z, DVec3::X, -DVec3::Z].into_iter().enumerate() {
                let (p, q) = (top[edge], top[(edge + 1) % 4]);
                let side = [p, q, DVec3::new(q.x, gap, q.z), DVec3::new(p.x, gap, p.z)];
                self.polygon(&side, out, SHADE);
            }
        }
    }
}

/// An interval cut at whole metres.
fn cuts(from: f64, to: f64) -> impl Iterator<Item = (f64, f64)> {
    let first = from.floor();
    let pieces = (to.ceil() - first).max(0.0) as usize;
    (0..pieces).map(move |i| ((first + i as f64).max(from), (first + i as f64 + 1.0).min(to)))
}
