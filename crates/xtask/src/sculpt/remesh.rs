//! From the fine net to the figure's mesh: edges are collapsed to the length wanted there, flipped to even
//! valences, vertices evened out and put back on the surface. The rim on the middle plane stays on it.

use glam::DVec3;

use super::field::Lookup;
use super::nets::Surface;

/// Longest edge that a collapse may make, in wanted lengths.
const LONGEST: f64 = 1.4;
/// Edges shorter than this are collapsed, in wanted lengths.
const SHORTEST: f64 = 0.75;

/// A mesh being worked on.
pub struct Remesh<'a> {
    field: &'a Lookup<'a>,
    points: Vec<DVec3>,
    normals: Vec<DVec3>,
    /// Wanted edge length at each vertex.
    sizes: Vec<f64>,
    triangles: Vec<Option<[u32; 3]>>,
    around: Vec<Vec<u32>>,
}

impl<'a> Remesh<'a> {
    /// Starts from the half surface; `size` gives the wanted edge length at a point of given curvature (1/m).
    pub fn new(half: &Surface, field: &'a Lookup<'a>, size: impl Fn(DVec3, f64) -> f64) -> Remesh<'a> {
        let (points, normals): (Vec<DVec3>, Vec<DVec3>) =
            half.points.iter().map(|p| field.settle(*p, 1)).unzip();
        let mut around = vec![Vec::new(); points.len()];
        for (t, triangle) in half.triangles.iter().enumerate() {
            triangle.iter().for_each(|&v| around[v as usize].push(t as u32));
        }
        let triangles = half.triangles.iter().copied().map(Some).collect();
        let mut mesh = Remesh { field, points, normals, sizes: Vec::new(), triangles, around };
        mesh.sizes = mesh.graded(size);
        mesh
    }

    /// Works until the edges have their lengths, and gives the half mesh.
    pub fn finish(mut self, rounds: usize) -> Surface {
        for _ in 0..2 {
            self.split_long();
        }
        for round in 0..rounds {
            for _ in 0..40 {
                if self.collapse_short() == 0 {
                    break;
                }
            }
            self.flip();
            self.relax(if round + 1 == rounds { 3 } else { 1 });
        }
        self.packed()
    }

    /// Wanted lengths that grow by at most a quarter of the way from vertex to vertex.
    fn graded(&self, size: impl Fn(DVec3, f64) -> f64) -> Vec<f64> {
        let mut sizes: Vec<f64> = (0..self.points.len() as u32)
            .map(|v| {
                let p = self.points[v as usize];
                let n = self.normals[v as usize];
                let bend = self.neighbours(v).into_iter().map(|w| {
                    let w = w as usize;
                    (self.normals[w] - n).length() / self.points[w].distance(p).max(1e-6)
                });
                size(p, bend.fold(0.0, f64::max))
            })
            .collect();
        for sweep in 0..24 {
            let order: Box<dyn Iterator<Item = usize>> =
                if sweep % 2 == 0 { Box::new(0..sizes.len()) } else { Box::new((0..sizes.len()).rev()) };
            for v in order {
                for w in self.neighbours(v as u32) {
                    let limit = sizes[w as usize] + 0.25 * self.points[v].distance(self.points[w as usize]);
                    sizes[v] = sizes[v].min(limit);
                }
            }
        }
        sizes
    }

    fn neighbours(&self, v: u32) -> Vec<u32> {
        let mut all = Vec::with_capacity(8);
        for t in &self.around[v as usize] {
            let Some(triangle) = self.triangles[*t as usize] else { continue };
            for w in triangle {
                if w != v && !all.contains(&w) {
                    all.push(w);
                }
            }
        }
        all
    }

    fn on_rim(&self, v: u32) -> bool {
        self.points[v as usize].x == 0.0
    }

    fn wanted(&self, a: u32, b: u32) -> f64 {
        0.5 * (self.sizes[a as usize] + self.sizes[b as usize])
    }

    fn length(&self, a: u32, b: u32) -> f64 {
        self.points[a as usize].distance(self.points[b as usize])
    }

    /// Triangles that have both vertices.
    fn beside(&self, a: u32, b: u32) -> Vec<u32> {
        let has = |t: &&u32| self.triangles[**t as usize].is_some_and(|v| v.contains(&b));
        self.around[a as usize].iter().filter(has).copied().collect()
    }

    fn edges(&self) -> Vec<(u32, u32)> {
        let corners = self.triangles.iter().flatten();
        let sides = corners.flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
        let mut edges: Vec<(u32, u32)> = sides.map(|(p, q)| (p.min(q), p.max(q))).collect();
        edges.sort_unstable();
        edges.dedup();
        edges
    }

    /// Halves the edges that are too long, where the surface is to be finer than the net; longest first, a triangle
    /// takes part once.
    fn split_long(&mut self) {
        let mut long: Vec<(f64, u32, u32)> = self
            .edges()
            .into_iter()
            .map(|(a, b)| (self.length(a, b) / self.wanted(a, b), a, b))
            .filter(|e| e.0 > LONGEST)
            .collect();
        long.sort_by(|x, y| y.0.total_cmp(&x.0).then(x.1.cmp(&y.1)).then(x.2.cmp(&y.2)));
        let mut used = vec![false; self.triangles.len()];
        for (_, a, b) in long {
            let beside = self.beside(a, b);
            if beside.iter().all(|&t| !used.get(t as usize).copied().unwrap_or(true)) {
                beside.iter().for_each(|&t| used[t as usize] = true);
                self.split(a, b, &beside);
            }
        }
    }

    /// Puts a vertex into the middle of an edge.
    fn split(&mut self, a: u32, b: u32, beside: &[u32]) {
        let middle = 0.5 * (self.points[a as usize] + self.points[b as usize]);
        let (p, normal) = self.field.settle(middle, 2);
        let new = self.points.len() as u32;
        self.points.push(p);
        self.normals.push(normal);
        self.sizes.push(self.wanted(a, b));
        self.around.push(Vec::new());
        for &t in beside {
            let Some(whole) = self.triangles[t as usize] else { continue };
            let with = |old: u32| whole.map(|v| if v == old { new } else { v });
            let other = self.triangles.len() as u32;
            self.triangles[t as usize] = Some(with(b));
            self.triangles.push(Some(with(a)));
            self.around[new as usize].extend([t, other]);
            self.around[b as usize].retain(|&u| u != t);
            self.around[b as usize].push(other);
            if let Some(c) = whole.into_iter().find(|&v| v != a && v != b) {
                self.around[c as usize].push(other);
            }
        }
    }

    /// One pass over the edges that are too short, shortest first; a vertex takes part once. Returns how many went.
    fn collapse_short(&mut self) -> usize {
        let mut short: Vec<(f64, u32, u32)> = self
            .edges()
            .into_iter()
            .map(|(a, b)| (self.length(a, b) / self.wanted(a, b), a, b))
            .filter(|e| e.0 < SHORTEST)
            .collect();
        short.sort_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)).then(x.2.cmp(&y.2)));
        let mut touched = vec![false; self.points.len()];
        let mut gone = 0;
        for (_, a, b) in short {
            if touched[a as usize] || touched[b as usize] || !self.collapse(a, b) {
                continue;
            }
            gone += 1;
            touched[b as usize] = true;
            touched[a as usize] = true;
            self.neighbours(a).into_iter().for_each(|w| touched[w as usize] = true);
        }
        gone
    }

    /// Draws `b` into `a` (or the other way, if only `b` is on the rim), where the surface allows it.
    fn collapse(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = if self.on_rim(b) && !self.on_rim(a) { (b, a) } else { (a, b) };
        let beside = self.beside(a, b);
        let rim_edge = self.on_rim(a) && self.on_rim(b);
        if beside.len() != if rim_edge { 1 } else { 2 } {
            return false;
        }
        let (ring_a, ring_b) = (self.neighbours(a), self.neighbours(b));
        let common = ring_a.iter().filter(|v| ring_b.contains(v)).count();
        if common != beside.len() {
            return false;
        }
        let (p, normal) = if self.on_rim(a) && !rim_edge {
            (self.points[a as usize], self.normals[a as usize])
        } else {
            self.field.settle(0.5 * (self.points[a as usize] + self.points[b as usize]), 1)
        };
        let size = self.sizes[a as usize].min(self.sizes[b as usize]);
        let too_long =
            |w: &u32| self.points[*w as usize].distance(p) > LONGEST * 0.5 * (size + self.sizes[*w as usize]);
        if ring_a.iter().chain(&ring_b).filter(|&&w| w != a && w != b).any(too_long) {
            return false;
        }
        // A rim vertex gains b's neighbours: an inner edge between two rim vertices would pinch the halves.
        if self.on_rim(a)
            && !rim_edge
            && ring_b.iter().any(|&w| w != a && self.on_rim(w) && !ring_a.contains(&w))
        {
            return false;
        }
        if !self.stays_upright(a, b, p, &beside) {
            return false;
        }
        self.merge(a, b, (p, normal), size, &beside);
        true
    }

    /// Whether no triangle around the two would turn away from the surface.
    fn stays_upright(&self, a: u32, b: u32, p: DVec3, beside: &[u32]) -> bool {
        let moved =
            self.around[a as usize].iter().chain(&self.around[b as usize]).filter(|t| !beside.contains(t));
        moved.filter_map(|t| self.triangles[*t as usize]).all(|triangle| {
            let at = |v: u32| if v == a || v == b { p } else { self.points[v as usize] };
            self.upright(triangle, at) && triangle.iter().filter(|&&v| at(v).x == 0.0).count() < 3
        })
    }

    fn upright(&self, triangle: [u32; 3], at: impl Fn(u32) -> DVec3) -> bool {
        let [a, b, c] = triangle.map(&at);
        let face = (b - a).cross(c - a);
        let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
        let normal: DVec3 = triangle.iter().map(|&v| self.normals[v as usize]).sum();
        // Also no slivers: the height must be a tenth of the longest side.
        face.dot(normal.normalize_or_zero()) > 0.1 * longest
    }

    fn merge(&mut self, a: u32, b: u32, (p, normal): (DVec3, DVec3), size: f64, beside: &[u32]) {
        for &t in beside {
            if let Some(triangle) = self.triangles[t as usize].take() {
                triangle.iter().for_each(|&v| self.around[v as usize].retain(|&u| u != t));
            }
        }
        for t in std::mem::take(&mut self.around[b as usize]) {
            if let Some(triangle) = &mut self.triangles[t as usize] {
                triangle.iter_mut().filter(|v| **v == b).for_each(|v| *v = a);
                self.around[a as usize].push(t);
            }
        }
        self.points[a as usize] = p;
        self.normals[a as usize] = normal;
        self.sizes[a as usize] = size;
    }

    /// Flips edges where that brings the valences nearer to six.
    fn flip(&mut self) {
        for (a, b) in self.edges() {
            let beside = self.beside(a, b);
            let [t, u] = beside[..] else { continue };
            let (Some(first), Some(second)) = (self.triangles[t as usize], self.triangles[u as usize]) else {
                continue;
            };
            // Turn the first triangle so that it reads a, b, c or b, a, c.
            let Some(c) = first.iter().copied().find(|&v| v != a && v != b) else { continue };
            let Some(d) = second.iter().copied().find(|&v| v != a && v != b) else { continue };
            let forward = (0..3).any(|i| first[i] == a && first[(i + 1) % 3] == b);
            let (a, b) = if forward { (a, b) } else { (b, a) };
            if c == d || (self.on_rim(c) && self.on_rim(d)) || !self.beside(c, d).is_empty() {
                continue;
            }
            let off = |v: u32, change: i32| {
                let ideal = if self.on_rim(v) { 4 } else { 6 };
                (self.around[v as usize].len() as i32 + i32::from(self.on_rim(v)) + change - ideal).pow(2)
            };
            let now = off(a, 0) + off(b, 0) + off(c, 0) + off(d, 0);
            let then = off(a, -1) + off(b, -1) + off(c, 1) + off(d, 1);
            let at = |v: u32| self.points[v as usize];
            let (one, two) = ([c, a, d], [d, b, c]);
            if then >= now || self.length(c, d) > LONGEST * self.wanted(c, d) {
                continue;
            }
            if !self.upright(one, at) || !self.upright(two, at) || !self.keeps_crease([a, b, c, d]) {
                continue;
            }
            self.triangles[t as usize] = Some(one);
            self.triangles[u as usize] = Some(two);
            self.around[b as usize].retain(|&x| x != t);
            self.around[a as usize].retain(|&x| x != u);
            self.around[d as usize].push(t);
            self.around[c as usize].push(u);
        }
    }

    /// Whether the flipped edge lies about as close to the surface as the old one.
    fn keeps_crease(&self, [a, b, c, d]: [u32; 4]) -> bool {
        let off = |p: u32, q: u32| {
            self.field.value(0.5 * (self.points[p as usize] + self.points[q as usize])).abs()
        };
        off(c, d) <= off(a, b) + 0.05 * self.wanted(a, b)
    }

    /// Moves each vertex along the surface to the middle of its neighbours.
    fn relax(&mut self, passes: usize) {
        for _ in 0..passes {
            for v in 0..self.points.len() as u32 {
                let ring: Vec<u32> = if self.on_rim(v) {
                    self.neighbours(v).into_iter().filter(|&w| self.on_rim(w)).collect()
                } else {
                    self.neighbours(v)
                };
                if ring.is_empty() {
                    continue;
                }
                let (mut sum, mut total) = (DVec3::ZERO, 0.0);
                for &w in &ring {
                    let weight = 1.0 / self.sizes[w as usize];
                    sum += self.points[w as usize] * weight;
                    total += weight;
                }
                let (p, n) = (self.points[v as usize], self.normals[v as usize]);
                let step = sum / total - p;
                let (moved, normal) = self.field.settle(p + 0.5 * (step - n * step.dot(n)), 2);
                let fits = self.around[v as usize]
                    .iter()
                    .filter_map(|t| self.triangles[*t as usize])
                    .all(|t| self.upright(t, |w| if w == v { moved } else { self.points[w as usize] }));
                if fits && (moved.x > 0.0 || self.on_rim(v)) {
                    self.points[v as usize] = moved;
                    self.normals[v as usize] = normal;
                }
            }
        }
    }

    /// What is left, numbered anew.
    fn packed(&self) -> Surface {
        let mut place = vec![u32::MAX; self.points.len()];
        let mut half = Surface::default();
        for triangle in self.triangles.iter().flatten() {
            half.triangles.push(triangle.map(|v| {
                let slot = &mut place[v as usize];
                if *slot == u32::MAX {
                    *slot = half.points.len() as u32;
                    half.points.push(self.points[v as usize]);
                }
                *slot
            }));
        }
        half
    }
}
