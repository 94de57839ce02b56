//! Cells between the points of an axis blend: segments, triangles or tetrahedra, and the weights of their
//! corners.
//!
//! All is reckoned in axes that are scaled so that the points fill 0 to 1 along each.

use glam::{DMat3, DVec3};

/// The most points that an axis blend may have.
pub const MOST_POINTS: usize = 24;

/// Points nearer than this, as a part of the points' extent, are taken for one.
const NEAR: f64 = 1e-3;
/// Cells with less content than this are flat.
const FLAT: f64 = 1e-7;
/// Weights below are 0, so that the points themselves have weights of exactly 1 and 0.
const NOTHING: f64 = 1e-12;
/// How far heights are lifted at most to make them generic: far less than two near points' heights differ,
/// far more than rounding.
const LIFT: f64 = 1e-8;

/// Why points or cells can't be blended between.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum CellsError {
    /// Too few or too many points.
    #[error("{found} points found, expected {least} to {MOST_POINTS} in a blend by {dims} parameter(s)")]
    Count {
        /// How many there are.
        found: usize,
        /// The least that there must be.
        least: usize,
        /// The number of parameters.
        dims: usize,
    },
    /// Two points at one place.
    #[error("this point is where point {other} is (counted from 0), expected a place of its own")]
    Doubled {
        /// The latter point.
        point: usize,
        /// The former.
        other: usize,
    },
    /// All points in a line or plane.
    #[error("all points lie on a {}, expected some to the side of it", if *.dims == 2 { "line" } else { "plane" })]
    Degenerate {
        /// The number of parameters.
        dims: usize,
    },
    /// A cell that has not one corner more than there are parameters, or names one that there isn't, or one
    /// twice.
    #[error("expected {corners} different points of {points}, counted from 0")]
    Corners {
        /// The cell.
        cell: usize,
        /// How many corners it must have.
        corners: usize,
        /// How many points there are.
        points: usize,
    },
    /// A cell without content.
    #[error("this cell is flat: its corners lie on a line or plane")]
    Flat {
        /// The cell.
        cell: usize,
    },
    /// Two cells share content.
    #[error("this cell overlaps cell {other} (counted from 0)")]
    Overlap {
        /// The latter cell.
        cell: usize,
        /// The former.
        other: usize,
    },
    /// A point within a cell, or on the edge of one, of which it is no corner: weights would jump there.
    #[error("this cell holds point {point} (counted from 0), which is none of its corners")]
    Holds {
        /// The cell.
        cell: usize,
        /// The point.
        point: usize,
    },
    /// The cells leave a part of the points' hull empty.
    #[error("the cells cover {covered:.3} of the points' hull, expected all of it")]
    Gap {
        /// Which part they cover, 0 to 1.
        covered: f64,
    },
}

/// A segment, triangle or tetrahedron.
#[derive(Clone, PartialEq, Debug)]
struct Cell {
    /// Indices of points; as many as count, the rest 0.
    corners: [usize; 4],
    /// From a scaled point to the weights of all corners but the first.
    weights_from_point: DMat3,
    /// Twice or six times the content, positive.
    content: f64,
}

/// The points of an axis blend and the cells between them.
#[derive(Clone, PartialEq, Debug)]
pub struct Cells {
    dims: usize,
    least: DVec3,
    /// One over the extent; 0 along axes that aren't used.
    scale: DVec3,
    /// Scaled.
    points: Vec<DVec3>,
    cells: Vec<Cell>,
    /// The hull's faces: those that only one cell has.
    faces: Vec<[usize; 3]>,
}

impl Cells {
    /// Cells between points with 1 to 3 coordinates (the rest 0): a Delaunay triangulation; where several are
    /// as good, on grids and circles, the points' order decides.
    ///
    /// # Errors
    /// Too few or too many points, points at one place, all on one line or plane.
    pub fn between(points: &[[f64; 3]], dims: usize) -> Result<Cells, CellsError> {
        let mut cells = Cells::of_points(points, dims)?;
        cells.cells = cells.regular();
        if cells.cells.is_empty() {
            return Err(CellsError::Degenerate { dims });
        }
        cells.faces = cells.hull();
        Ok(cells)
    }

    /// Cells as they are given: indices of points, one more than there are parameters for each.
    ///
    /// # Errors
    /// Those of [`Cells::between`]; cells that are flat, overlap, have a point inside or leave a gap.
    pub fn given(points: &[[f64; 3]], dims: usize, given: &[Vec<usize>]) -> Result<Cells, CellsError> {
        let regular = Cells::between(points, dims)?;
        let mut cells = Cells { cells: Vec::new(), faces: Vec::new(), ..regular.clone() };
        for (c, corners) in given.iter().enumerate() {
            let cell = cells.cell_of(c, corners)?;
            let other = cells.cells.iter().position(|other| cells.overlap(&cell, other));
            if let Some(other) = other {
                return Err(CellsError::Overlap { cell: c, other });
            }
            let held =
                |p: &usize| !corners.contains(p) && cells.least_weight(&cell, cells.points[*p]) >= -NOTHING;
            if let Some(point) = (0..points.len()).find(held) {
                return Err(CellsError::Holds { cell: c, point });
            }
            cells.cells.push(cell);
        }
        let content = |cells: &Cells| cells.cells.iter().map(|cell| cell.content).sum::<f64>();
        let covered = content(&cells) / content(&regular);
        if covered < 1.0 - 1e-6 {
            return Err(CellsError::Gap { covered });
        }
        cells.faces = cells.hull();
        Ok(cells)
    }

    /// The corners of each cell, indices of points.
    pub fn corners(&self) -> impl Iterator<Item = &[usize]> {
        self.cells.iter().map(|cell| &cell.corners[..=self.dims])
    }

    /// The weights of all points at a place: none below 0, at most one more than there are parameters above
    /// it, in sum 1 to the last digits. Outside of the points' hull those of its nearest place (by scaled
    /// axes).
    ///
    /// The place must be finite; `out` has room for every point.
    pub fn weights(&self, place: [f64; 3], out: &mut [f64]) {
        out.fill(0.0);
        let place = (DVec3::from(place) - self.least) * self.scale;
        let mut best = (f64::NEG_INFINITY, 0);
        for (c, cell) in self.cells.iter().enumerate() {
            let least = self.least_weight(cell, place);
            if least > best.0 {
                best = (least, c);
            }
            if least >= 0.0 {
                break;
            }
        }
        if best.0 >= -NOTHING {
            let cell = &self.cells[best.1];
            let weights = cell.weights(place, self.points[cell.corners[0]]);
            for (corner, weight) in cell.corners.into_iter().zip(weights).take(self.dims + 1) {
                out[corner] = weight;
            }
        } else {
            self.weights_of_nearest(place, out);
        }
        let mut sum = 0.0;
        for weight in out.iter_mut() {
            if *weight < NOTHING {
                *weight = 0.0;
            }
            sum += *weight;
        }
        for weight in out.iter_mut().filter(|w| **w > 0.0) {
            *weight /= sum;
        }
    }

    fn least_weight(&self, cell: &Cell, place: DVec3) -> f64 {
        let weights = cell.weights(place, self.points[cell.corners[0]]);
        weights[..=self.dims].iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// Of the place of the hull that is nearest to one outside. The hull is convex, so this place goes along
    /// without a jump.
    fn weights_of_nearest(&self, place: DVec3, out: &mut [f64]) {
        let mut best = (f64::INFINITY, [0; 3], [1.0, 0.0, 0.0]);
        for face in &self.faces {
            let corners = face.map(|p| self.points[p]);
            let weights = match self.dims {
                1 => [1.0, 0.0, 0.0],
                2 => nearest_of_segment(place, corners[0], corners[1]),
                _ => nearest_of_triangle(place, corners),
            };
            let nearest = corners[0] * weights[0] + corners[1] * weights[1] + corners[2] * weights[2];
            let distance = nearest.distance_squared(place);
            if distance < best.0 {
                best = (distance, *face, weights);
            }
        }
        for (point, weight) in best.1.into_iter().zip(best.2) {
            out[point] += weight;
        }
    }
}

impl Cell {
    /// The weights of the four corners; those that don't count are 0.
    fn weights(&self, place: DVec3, first: DVec3) -> [f64; 4] {
        let rest = self.weights_from_point * (place - first);
        [1.0 - rest.x - rest.y - rest.z, rest.x, rest.y, rest.z]
    }
}

/// The weights of a segment's ends at its place nearest to a point.
fn nearest_of_segment(p: DVec3, a: DVec3, b: DVec3) -> [f64; 3] {
    let along = b - a;
    let t = ((p - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
    [1.0 - t, t, 0.0]
}

/// The weights of a triangle's corners at its place nearest to a point.
fn nearest_of_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let (ab, ac) = (b - a, c - a);
    let normal = ab.cross(ac);
    let area = normal.length_squared();
    let (v, w) = ((p - a).cross(ac).dot(normal) / area, ab.cross(p - a).dot(normal) / area);
    if v >= 0.0 && w >= 0.0 && v + w <= 1.0 {
        return [1.0 - v - w, v, w];
    }
    let [s, t, _] = nearest_of_segment(p, a, b);
    let on_ab = [s, t, 0.0];
    let [s, t, _] = nearest_of_segment(p, b, c);
    let on_bc = [0.0, s, t];
    let [s, t, _] = nearest_of_segment(p, a, c);
    let on_ac = [s, 0.0, t];
    let distance = |w: &[f64; 3]| (a * w[0] + b * w[1] + c * w[2]).distance_squared(p);
    let nearer = |x: [f64; 3], y: [f64; 3]| if distance(&y) < distance(&x) { y } else { x };
    nearer(nearer(on_ab, on_bc), on_ac)
}

// Making the cells.
impl Cells {
    fn of_points(points: &[[f64; 3]], dims: usize) -> Result<Cells, CellsError> {
        let found = points.len();
        if found <= dims || found > MOST_POINTS {
            return Err(CellsError::Count { found, least: dims + 1, dims });
        }
        let points = points.iter().copied().map(DVec3::from);
        let least = points.clone().fold(DVec3::INFINITY, DVec3::min);
        let extent = points.clone().fold(DVec3::NEG_INFINITY, DVec3::max) - least;
        let flat = (0..dims).any(|axis| extent[axis] <= 0.0);
        let scale = DVec3::from_array(std::array::from_fn(|axis| {
            if axis < dims && extent[axis] > 0.0 { extent[axis].recip() } else { 0.0 }
        }));
        let points: Vec<DVec3> = points.map(|p| (p - least) * scale).collect();
        for (i, point) in points.iter().enumerate() {
            if let Some(other) = points[..i].iter().position(|other| other.distance(*point) < NEAR) {
                return Err(CellsError::Doubled { point: i, other });
            }
        }
        if flat {
            return Err(CellsError::Degenerate { dims });
        }
        Ok(Cells { dims, least, scale, points, cells: Vec::new(), faces: Vec::new() })
    }

    /// The edges from the first corner to the others; unit vectors along the axes that aren't used.
    fn edges(&self, corners: &[usize]) -> DMat3 {
        let first = self.points[corners[0]];
        let column =
            |i: usize| if i <= self.dims { self.points[corners[i]] - first } else { DVec3::AXES[i - 1] };
        DMat3::from_cols(column(1), column(2), column(3))
    }

    fn cell(&self, corners: &[usize]) -> Option<Cell> {
        let edges = self.edges(corners);
        let content = edges.determinant().abs();
        if content < FLAT {
            return None;
        }
        let mut of_four = [0; 4];
        of_four[..corners.len()].copy_from_slice(corners);
        Some(Cell { corners: of_four, weights_from_point: edges.inverse(), content })
    }

    /// A cell as a file gives it.
    fn cell_of(&self, c: usize, corners: &[usize]) -> Result<Cell, CellsError> {
        let points = self.points.len();
        let distinct = |(i, corner): (usize, &usize)| *corner < points && !corners[..i].contains(corner);
        if corners.len() != self.dims + 1 || !corners.iter().enumerate().all(distinct) {
            return Err(CellsError::Corners { cell: c, corners: self.dims + 1, points });
        }
        self.cell(corners).ok_or(CellsError::Flat { cell: c })
    }

    /// The lower hull of the points lifted onto a paraboloid: those cells under whose plane no lifted point
    /// lies. Small offsets of the heights, other for every index, see to it that no plane holds more points
    /// than its corners, so the cells fit together on grids and circles, too.
    fn regular(&self) -> Vec<Cell> {
        let height = |i: usize| self.points[i].length_squared() + LIFT * offset(i);
        let heights: Vec<f64> = (0..self.points.len()).map(height).collect();
        let mut cells = Vec::new();
        each_choice(self.points.len(), self.dims + 1, &mut |corners| {
            let Some(cell) = self.cell(corners) else { return };
            let over_plane = |m: usize| {
                let weights = cell.weights(self.points[m], self.points[corners[0]]);
                let plane: f64 = corners.iter().zip(weights).map(|(&c, weight)| weight * heights[c]).sum();
                heights[m] > plane
            };
            if (0..self.points.len()).all(|m| corners.contains(&m) || over_plane(m)) {
                cells.push(cell);
            }
        });
        cells
    }

    /// The faces that only one cell has.
    fn hull(&self) -> Vec<[usize; 3]> {
        let mut faces: Vec<[usize; 3]> = Vec::new();
        for cell in &self.cells {
            for left_out in 0..=self.dims {
                let mut face = [usize::MAX; 3];
                let corners = (0..=self.dims).filter(|i| *i != left_out).map(|i| cell.corners[i]);
                face.iter_mut().zip(corners).for_each(|(slot, corner)| *slot = corner);
                face[..self.dims].sort_unstable();
                match faces.iter().position(|other| *other == face) {
                    Some(twin) => drop(faces.remove(twin)),
                    None => faces.push(face),
                }
            }
        }
        // What a face has too little of is never read with a weight.
        for face in &mut faces {
            let first = face[0];
            face[self.dims..].fill(first);
        }
        faces
    }

    /// Whether two cells share more than a border: no axis along which one is beyond the other. For simplices
    /// the normals of faces and the products of edges are all the axes there are to try.
    fn overlap(&self, a: &Cell, b: &Cell) -> bool {
        let directions = |cell: &Cell| {
            let corners = cell.corners[..=self.dims].iter().map(|&c| self.points[c]);
            let corners: Vec<DVec3> = corners.collect();
            let pairs = (0..corners.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
            pairs.map(|(i, j)| corners[i] - corners[j]).collect::<Vec<DVec3>>()
        };
        let (of_a, of_b) = (directions(a), directions(b));
        let axes: Vec<DVec3> = match self.dims {
            1 => vec![DVec3::X],
            2 => of_a.iter().chain(&of_b).map(|d| DVec3::new(-d.y, d.x, 0.0)).collect(),
            _ => {
                let all: Vec<DVec3> = of_a.iter().chain(&of_b).copied().collect();
                let products = all.iter().enumerate().flat_map(|(i, d)| all[..i].iter().map(|e| d.cross(*e)));
                products.collect()
            }
        };
        let span = |cell: &Cell, axis: DVec3| {
            let along = cell.corners[..=self.dims].iter().map(|&c| self.points[c].dot(axis));
            along.fold((f64::INFINITY, f64::NEG_INFINITY), |(min, max), x| (min.min(x), max.max(x)))
        };
        axes.into_iter().filter_map(DVec3::try_normalize).all(|axis| {
            let (a, b) = (span(a, axis), span(b, axis));
            a.1.min(b.1) - a.0.max(b.0) > 1e-9
        })
    }
}

/// Every choice of `count` of the first `of` numbers, in order.
fn each_choice(of: usize, count: usize, with: &mut dyn FnMut(&[usize])) {
    fn more(chosen: &mut Vec<usize>, of: usize, count: usize, with: &mut dyn FnMut(&[usize])) {
        if chosen.len() == count {
            return with(chosen);
        }
        for next in chosen.last().map_or(0, |last| last + 1)..of {
            chosen.push(next);
            more(chosen, of, count, with);
            chosen.pop();
        }
    }
    more(&mut Vec::with_capacity(count), of, count, with);
}

/// A number from 0 to 1 without any pattern: SplitMix64 of the index.
fn offset(index: usize) -> f64 {
    let mut z = (index as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    (z ^ (z >> 31)) as f64 / u64::MAX as f64
}
