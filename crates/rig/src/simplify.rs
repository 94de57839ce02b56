//! Lighter skins for figures that are seen small: vertices go, one by one, where they are missed the least.
//!
//! Each step moves a vertex into a neighbour (an edge collapses onto one of its ends), so what is left are vertices of the
//! skin with the colours and weights that they had. How much a vertex is missed is the mean square distance of the
//! place that it moves to from the planes of all triangles that its skin once had (quadric error metrics; source: `qem`), and
//! more where colours or weights differ.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use glam::{DMat3, DVec3};

use crate::Mesh;

/// How far off a vertex of a wholly other colour counts, metres.
const COLOR_M: f64 = 0.010;
/// How far off a vertex of wholly other bones counts, metres.
const BONES_M: f64 = 0.012;
/// How much the length of an edge counts as distance: between equals, short ones go first.
const LENGTH_SHARE: f64 = 0.03;
/// The least cosine between a triangle before and after a step.
const LEAST_COSINE: f64 = 0.2;
/// Triangles stay fatter than this: twice the area over the square of the longest edge.
const LEAST_FATNESS: f64 = 0.02;

/// A skin with about so many vertices, or more where none can go without tearing or turning the skin over. Vertices
/// at the same place become one. The farthest along each axis stay. The same mesh gives the same bits.
///
/// A mesh with a [`Mesh::fault`] comes back as it is.
pub fn simplified(mesh: &Mesh, vertices: usize) -> Mesh {
    if mesh.fault().is_some() {
        return mesh.clone();
    }
    let mut skin = Skin::of(mesh);
    skin.thin_out(vertices);
    skin.into_mesh(mesh)
}

/// Squared distance to planes, as a quadratic form, and the area of the triangles that they are of.
#[derive(Clone, Copy)]
struct Quadric {
    square: DMat3,
    linear: DVec3,
    constant: f64,
    area: f64,
}

impl Quadric {
    const NONE: Quadric = Quadric { square: DMat3::ZERO, linear: DVec3::ZERO, constant: 0.0, area: 0.0 };

    /// A plane through a place, by its unit normal.
    fn plane(normal: DVec3, through: DVec3, area: f64) -> Quadric {
        let offset = -normal.dot(through);
        let square = DMat3::from_cols(normal * normal.x, normal * normal.y, normal * normal.z);
        let (linear, constant) = (normal * offset * area, offset * offset * area);
        Quadric { square: square * area, linear, constant, area }
    }

    fn plus(self, other: Quadric) -> Quadric {
        Quadric {
            square: self.square + other.square,
            linear: self.linear + other.linear,
            constant: self.constant + other.constant,
            area: self.area + other.area,
        }
    }

    /// The mean square distance of a place, square metres.
    fn at(&self, p: DVec3) -> f64 {
        let sum = p.dot(self.square * p) + 2.0 * self.linear.dot(p) + self.constant;
        sum.max(0.0) / self.area.max(1e-12)
    }
}

/// A place of the skin.
struct Point {
    at: DVec3,
    normal: DVec3,
    /// The mesh's vertex whose colour and weights it has.
    vertex: usize,
    quadric: Quadric,
    /// Triangles around it, ascending.
    triangles: Vec<u32>,
    /// Counts changes, so that what was found before one is known to be old.
    version: u32,
    /// Must stay.
    held: bool,
    gone: bool,
}

/// A skin whose vertices go.
struct Skin<'a> {
    mesh: &'a Mesh,
    points: Vec<Point>,
    triangles: Vec<Option<[u32; 3]>>,
    left: usize,
    queue: BinaryHeap<Reverse<Step>>,
}

/// A step that could be taken: what it costs, who moves into whom, and when that was found.
type Step = (u64, u32, u32, u32, u32);

impl<'a> Skin<'a> {
    fn of(mesh: &'a Mesh) -> Skin<'a> {
        let (mut points, point_of) = welded(mesh);
        let mut triangles = Vec::new();
        for corners in mesh.indices.chunks_exact(3) {
            let corners = [0, 1, 2].map(|k| point_of[corners[k] as usize]);
            let [a, b, c] = corners;
            if a == b || b == c || c == a {
                continue;
            }
            for corner in corners {
                points[corner as usize].triangles.push(triangles.len() as u32);
            }
            triangles.push(Some(corners));
        }
        hold_farthest(&mut points);
        let left = points.iter().filter(|point| !point.triangles.is_empty()).count();
        let mut skin = Skin { mesh, points, triangles, left, queue: BinaryHeap::new() };
        skin.measure();
        skin
    }

    /// The quadrics of all planes, and of walls along the borders, so that holes keep their outline.
    fn measure(&mut self) {
        let mut edges: BTreeMap<(u32, u32), u32> = BTreeMap::new();
        for t in self.triangles.iter().flatten() {
            for (a, b) in [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])] {
                *edges.entry((a.min(b), a.max(b))).or_default() += 1;
            }
        }
        for corners in self.triangles.iter().flatten().copied() {
            let [a, b, c] = corners.map(|i| self.points[i as usize].at);
            let across = (b - a).cross(c - a);
            let Some(normal) = across.try_normalize() else { continue };
            let plane = Quadric::plane(normal, a, across.length() * 0.5);
            for k in 0..3 {
                let (from, to) = (corners[k] as usize, corners[(k + 1) % 3] as usize);
                self.points[from].quadric = self.points[from].quadric.plus(plane);
                let edge = (corners[k].min(corners[(k + 1) % 3]), corners[k].max(corners[(k + 1) % 3]));
                let along = self.points[to].at - self.points[from].at;
                if edges[&edge] == 1
                    && let Some(out) = along.cross(normal).try_normalize()
                {
                    let wall = Quadric::plane(out, self.points[from].at, along.length_squared());
                    self.points[from].quadric = self.points[from].quadric.plus(wall);
                    self.points[to].quadric = self.points[to].quadric.plus(wall);
                }
            }
        }
        for (a, b) in edges.into_keys() {
            self.offer(a, b);
            self.offer(b, a);
        }
    }

    /// What it costs to move a point into a neighbour, square metres.
    fn cost(&self, from: u32, to: u32) -> f64 {
        let [a, b] = [from, to].map(|i| &self.points[i as usize]);
        let color = |point: &Point| DVec3::from(self.mesh.colors[point.vertex].map(f64::from));
        let off = COLOR_M * color(a).distance(color(b)).min(1.0);
        let bones = BONES_M * strangeness(self.mesh, a.vertex, b.vertex);
        let length = LENGTH_SHARE * a.at.distance(b.at);
        a.quadric.plus(b.quadric).at(b.at) + off * off + bones * bones + length * length
    }

    fn offer(&mut self, from: u32, to: u32) {
        let [a, b] = [from, to].map(|i| &self.points[i as usize]);
        if !a.held {
            // Costs are never negative: their bits are in their order.
            let step = (self.cost(from, to).to_bits(), from, to, a.version, b.version);
            self.queue.push(Reverse(step));
        }
    }

    fn thin_out(&mut self, vertices: usize) {
        while self.left > vertices
            && let Some(Reverse((_, from, to, from_version, to_version))) = self.queue.pop()
        {
            let [a, b] = [from, to].map(|i| &self.points[i as usize]);
            let fresh = !a.gone && !b.gone && (a.version, b.version) == (from_version, to_version);
            if fresh && self.is_sound(from, to) {
                self.take(from, to);
            }
        }
    }

    /// The points around one, ascending.
    fn around(&self, point: u32) -> Vec<u32> {
        let corners =
            self.points[point as usize].triangles.iter().filter_map(|t| self.triangles[*t as usize]);
        let mut around: Vec<u32> = corners.flatten().filter(|corner| *corner != point).collect();
        around.sort_unstable();
        around.dedup();
        around
    }

    /// Whether a step leaves a skin that is whole: nothing folds onto itself, turns over or becomes a sliver.
    fn is_sound(&self, from: u32, to: u32) -> bool {
        let (near, far) = (self.around(from), self.around(to));
        let triangles = &self.points[from as usize].triangles;
        let corners = |t: &u32| self.triangles[*t as usize].unwrap_or_default();
        let shared = triangles.iter().filter(|t| corners(t).contains(&to)).count();
        let common = near.iter().filter(|point| far.binary_search(point).is_ok()).count();
        // At a border there are fewer triangles than neighbours: such a point moves along the border alone.
        let closed = |around: &[u32], point: u32| around.len() == self.points[point as usize].triangles.len();
        let along =
            shared == 2 && closed(&near, from) || shared == 1 && !closed(&near, from) && !closed(&far, to);
        along && common == shared && triangles.iter().all(|t| self.stays_up(corners(t), from, to))
    }

    /// Whether a triangle keeps its side up when a corner moves; those that vanish do.
    fn stays_up(&self, corners: [u32; 3], from: u32, to: u32) -> bool {
        if corners.contains(&to) {
            return true;
        }
        let moved = corners.map(|corner| if corner == from { to } else { corner });
        let at = |corners: [u32; 3]| corners.map(|i| self.points[i as usize].at);
        let across = |[a, b, c]: [DVec3; 3]| (b - a).cross(c - a);
        let (before, after) = (across(at(corners)), across(at(moved)));
        let [a, b, c] = at(moved);
        let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
        let outward: DVec3 = moved.iter().map(|i| self.points[*i as usize].normal).sum();
        after.length() > LEAST_FATNESS * longest
            && after.dot(before) > LEAST_COSINE * after.length() * before.length()
            && after.dot(outward) > 0.0
    }

    fn take(&mut self, from: u32, to: u32) {
        let gone = &mut self.points[from as usize];
        gone.gone = true;
        let (triangles, quadric) = (std::mem::take(&mut gone.triangles), gone.quadric);
        self.left -= 1;
        for t in triangles {
            let Some(corners) = self.triangles[t as usize] else { continue };
            if corners.contains(&to) {
                self.triangles[t as usize] = None;
                for corner in corners {
                    self.points[corner as usize].triangles.retain(|other| *other != t);
                }
            } else {
                let moved = corners.map(|corner| if corner == from { to } else { corner });
                self.triangles[t as usize] = Some(moved);
                self.points[to as usize].triangles.push(t);
            }
        }
        let stays = &mut self.points[to as usize];
        stays.triangles.sort_unstable();
        stays.quadric = stays.quadric.plus(quadric);
        stays.version += 1;
        for other in self.around(to) {
            self.offer(other, to);
            self.offer(to, other);
        }
    }

    fn into_mesh(self, mesh: &Mesh) -> Mesh {
        let mut out = Mesh::default();
        let mut numbers: Vec<Option<u32>> = vec![None; self.points.len()];
        for corner in self.triangles.iter().flatten().flatten() {
            let point = &self.points[*corner as usize];
            let number = *numbers[*corner as usize].get_or_insert_with(|| {
                out.positions.push(mesh.positions[point.vertex]);
                out.normals.push(point.normal.as_vec3().to_array());
                out.colors.push(mesh.colors[point.vertex]);
                out.joints.push(mesh.joints[point.vertex]);
                out.weights.push(mesh.weights[point.vertex]);
                out.positions.len() as u32 - 1
            });
            out.indices.push(number);
        }
        out
    }
}

/// One point for all vertices at a place, and which point each vertex became.
fn welded(mesh: &Mesh) -> (Vec<Point>, Vec<u32>) {
    let mut known: BTreeMap<[u32; 3], u32> = BTreeMap::new();
    let mut points: Vec<Point> = Vec::new();
    let mut point_of = Vec::with_capacity(mesh.positions.len());
    for (vertex, position) in mesh.positions.iter().enumerate() {
        // Adding 0 makes both zeros one.
        let number = *known.entry(position.map(|c| (c + 0.0).to_bits())).or_insert(points.len() as u32);
        if number as usize == points.len() {
            points.push(Point {
                at: DVec3::from(position.map(f64::from)),
                normal: DVec3::ZERO,
                vertex,
                quadric: Quadric::NONE,
                triangles: Vec::new(),
                version: 0,
                held: false,
                gone: false,
            });
        }
        points[number as usize].normal += DVec3::from(mesh.normals[vertex].map(f64::from));
        point_of.push(number);
    }
    for point in &mut points {
        point.normal = point.normal.normalize_or(DVec3::Y);
    }
    (points, point_of)
}

/// Holds the points that reach farthest along each axis, so that the skin keeps its size.
fn hold_farthest(points: &mut [Point]) {
    for axis in [DVec3::X, DVec3::Y, DVec3::Z, -DVec3::X, -DVec3::Y, -DVec3::Z] {
        let used = points.iter_mut().filter(|point| !point.triangles.is_empty());
        if let Some(farthest) = used.max_by(|a, b| a.at.dot(axis).total_cmp(&b.at.dot(axis))) {
            farthest.held = true;
        }
    }
}

/// How differently two vertices are moved: 0 by the same bones alike, 1 by none in common.
fn strangeness(mesh: &Mesh, a: usize, b: usize) -> f64 {
    let weight = |vertex: usize, place: u8| -> f64 {
        let rows = mesh.joints[vertex].iter().zip(mesh.weights[vertex]);
        rows.filter(|(joint, _)| **joint == place).map(|(_, weight)| f64::from(weight)).sum()
    };
    let mut places = [mesh.joints[a], mesh.joints[b]].concat();
    places.sort_unstable();
    places.dedup();
    let common: f64 = places.iter().map(|place| weight(a, *place).min(weight(b, *place))).sum();
    1.0 - common / f64::from(u16::MAX)
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;

    /// A ball of half a metre whose halves differ in colour and bone.
    fn ball() -> Mesh {
        let (rows, columns) = (40, 80);
        let mut mesh = Mesh::default();
        for row in 0..=rows {
            for column in 0..columns {
                let polar = f64::from(row) / f64::from(rows) * std::f64::consts::PI;
                let around = f64::from(column) / f64::from(columns) * std::f64::consts::TAU;
                let (sine, cosine) = if row == rows { (0.0, -1.0) } else { polar.sin_cos() };
                let sine = if row == 0 { 0.0 } else { sine };
                let out = DVec3::new(sine * around.sin(), cosine, sine * around.cos()).as_vec3();
                mesh.positions.push((out * 0.5).to_array());
                mesh.normals.push(out.to_array());
                let upper = out.y > 0.0;
                mesh.colors.push(if upper { [0.8, 0.2, 0.1] } else { [0.1, 0.2, 0.8] });
                mesh.joints.push([u8::from(upper), 9, 0, 0]);
                mesh.weights.push([40_000, 25_535, 0, 0]);
            }
        }
        for row in 0..rows as u32 {
            for column in 0..columns as u32 {
                let [a, b] = [column, (column + 1) % columns as u32].map(|c| row * columns as u32 + c);
                let [c, d] = [a, b].map(|i| i + columns as u32);
                mesh.indices.extend([a, c, d, a, d, b]);
            }
        }
        mesh
    }

    fn corners(mesh: &Mesh, triangle: &[u32]) -> [Vec3; 3] {
        [0, 1, 2].map(|k: usize| Vec3::from(mesh.positions[triangle[k] as usize]))
    }

    #[test]
    fn a_ball_stays_a_ball_with_the_vertices_that_it_had() {
        let ball = ball();
        let light = simplified(&ball, 200);
        assert_eq!(light.fault(), None);
        assert!((190..=200).contains(&light.vertex_count()), "{}", light.vertex_count());
        assert_eq!(light.indices.len() / 3, 2 * light.vertex_count() - 4, "closed, without handles");
        for (i, position) in light.positions.iter().enumerate() {
            let was = ball.positions.iter().position(|p| p == position).unwrap();
            assert_eq!((light.colors[i], light.weights[i]), (ball.colors[was], ball.weights[was]));
        }
        let mut off = 0.0_f32;
        for triangle in light.indices.chunks_exact(3) {
            let [a, b, c] = corners(&light, triangle);
            assert!((b - a).cross(c - a).dot(a + b + c) > 0.0, "turned over");
            off = off.max(0.5 - ((a + b + c) / 3.0).length());
        }
        assert!(off < 0.02, "{off} m inside the ball");
        assert_eq!(light, simplified(&ball, 200));
    }

    #[test]
    fn borders_keep_their_outline() {
        let mut open = ball();
        open.indices.truncate(20 * 80 * 6);
        let light = simplified(&open, 150);
        let on_rim: Vec<Vec3> =
            light.positions.iter().map(|p| Vec3::from(*p)).filter(|p| p.y.abs() < 1e-3).collect();
        assert!(on_rim.len() >= 8, "{} points on the rim", on_rim.len());
        for step in 0..36 {
            let at = (step as f32 * 10.0).to_radians();
            let farthest = on_rim.iter().map(|p| p.x * at.sin() + p.z * at.cos()).fold(0.0, f32::max);
            assert!(farthest > 0.47, "the rim reaches {farthest} m toward {step}");
        }
    }

    #[test]
    fn what_is_small_already_empty_or_faulty_comes_back() {
        assert_eq!(simplified(&Mesh::default(), 10), Mesh::default());
        let faulty = Mesh { indices: vec![0, 1], ..ball() };
        assert_eq!(simplified(&faulty, 10), faulty);
        let whole = simplified(&ball(), usize::MAX);
        assert_eq!(whole.vertex_count(), 39 * 80 + 2, "poles are one point each");
        let least = simplified(&ball(), 0);
        assert!((4..40).contains(&least.vertex_count()), "{}", least.vertex_count());
    }
}
