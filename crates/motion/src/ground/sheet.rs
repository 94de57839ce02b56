//! Ground of triangles: the height by a vertical ray, found by a grid over the triangles.

use glam::{DVec2, DVec3};

use crate::GroundPoint;

/// The most cells of the grid along one side.
const MOST_CELLS: usize = 1024;

/// Triangles to walk on.
#[derive(Clone, PartialEq, Debug)]
pub struct Sheet {
    /// Corners, unit normal upward.
    triangles: Vec<([DVec3; 3], DVec3)>,
    /// Upright ones, only to be drawn: corners, unit normal outward.
    walls: Vec<([DVec3; 3], DVec3)>,
    low: DVec2,
    high: DVec2,
    cells_a_metre: f64,
    columns: usize,
    rows: usize,
    /// Where each cell's triangles begin in `members`; one more than cells.
    starts: Vec<u32>,
    members: Vec<u32>,
}

/// Why triangles are no ground.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum SheetError {
    /// The number of indices.
    #[error("{0} indices are not whole triangles")]
    Odd(usize),
    /// An index.
    #[error("triangle {triangle} names vertex {index}, but there are {vertices}")]
    Index {
        /// Which triangle, from 0.
        triangle: usize,
        /// What it names.
        index: u32,
        /// How many there are.
        vertices: usize,
    },
    /// A number.
    #[error("vertex {0} is not finite")]
    NotFinite(usize),
    /// Nothing to stand on.
    #[error("of {0} triangles none faces up or down enough to stand on")]
    Empty(usize),
}

impl Sheet {
    /// Ground of triangles, metres, world; which way round they go doesn't matter. Upright triangles are left out.
    ///
    /// # Errors
    /// Indices that are no triangles or name no vertex, numbers that are none, nothing to stand on.
    pub fn new(positions: &[DVec3], indices: &[u32]) -> Result<Sheet, SheetError> {
        if !indices.len().is_multiple_of(3) {
            return Err(SheetError::Odd(indices.len()));
        }
        if let Some(bad) = positions.iter().position(|p| !(p.is_finite() && p.abs().max_element() < 1e9)) {
            return Err(SheetError::NotFinite(bad));
        }
        let mut triangles = Vec::with_capacity(indices.len() / 3);
        let mut walls = Vec::new();
        for (triangle, corners) in indices.as_chunks::<3>().0.iter().enumerate() {
            let find = |index: u32| {
                let fault = SheetError::Index { triangle, index, vertices: positions.len() };
                positions.get(index as usize).copied().ok_or(fault)
            };
            let [a, b, c] = [find(corners[0])?, find(corners[1])?, find(corners[2])?];
            let normal = (b - a).cross(c - a).normalize_or_zero();
            if normal.y.abs() > 0.02 {
                triangles.push(([a, b, c], normal * normal.y.signum()));
            } else if normal != DVec3::ZERO {
                walls.push(([a, b, c], normal));
            }
        }
        if triangles.is_empty() {
            return Err(SheetError::Empty(indices.len() / 3));
        }
        Ok(Sheet { walls, ..Sheet::indexed(triangles) })
    }

    fn indexed(triangles: Vec<([DVec3; 3], DVec3)>) -> Sheet {
        let corners = triangles.iter().flat_map(|(corners, _)| corners.iter().map(|p| DVec2::new(p.x, p.z)));
        let (low, high) =
            corners.fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
        let size = (high - low).max(DVec2::splat(1e-6));
        // About one triangle a cell.
        let cell = (size.x * size.y / triangles.len() as f64).sqrt();
        let cell = cell.max(size.max_element() / MOST_CELLS as f64);
        let count = |length: f64| ((length / cell).ceil() as usize).clamp(1, MOST_CELLS);
        let (columns, rows) = (count(size.x), count(size.y));
        let mut sheet = Sheet {
            triangles,
            walls: Vec::new(),
            low,
            high,
            cells_a_metre: 1.0 / cell,
            columns,
            rows,
            starts: vec![0; columns * rows + 1],
            members: Vec::new(),
        };
        sheet.fill();
        sheet
    }

    /// Counts the triangles of each cell, then writes them one cell after the other.
    fn fill(&mut self) {
        let spans: Vec<[usize; 4]> = self.triangles.iter().map(|(corners, _)| self.span(corners)).collect();
        let cells = |[i0, i1, j0, j1]: [usize; 4]| {
            let columns = self.columns;
            (j0..=j1).flat_map(move |j| (i0..=i1).map(move |i| j * columns + i))
        };
        let mut starts = vec![0u32; self.starts.len()];
        for span in &spans {
            cells(*span).for_each(|cell| starts[cell + 1] += 1);
        }
        for cell in 1..starts.len() {
            starts[cell] += starts[cell - 1];
        }
        let mut next = starts.clone();
        let mut members = vec![0; starts.last().copied().unwrap_or(0) as usize];
        for (triangle, span) in spans.iter().enumerate() {
            for cell in cells(*span) {
                members[next[cell] as usize] = triangle as u32;
                next[cell] += 1;
            }
        }
        (self.starts, self.members) = (starts, members);
    }

    /// The first and last column and row that a triangle touches.
    fn span(&self, corners: &[DVec3; 3]) -> [usize; 4] {
        let [a, b, c] = corners.map(|p| DVec2::new(p.x, p.z));
        let (i0, j0) = self.cell(a.min(b).min(c));
        let (i1, j1) = self.cell(a.max(b).max(c));
        [i0, i1, j0, j1]
    }

    fn cell(&self, at: DVec2) -> (usize, usize) {
        let cell = (at - self.low) * self.cells_a_metre;
        let held = |value: f64, count: usize| (value.max(0.0) as usize).min(count - 1);
        (held(cell.x, self.columns), held(cell.y, self.rows))
    }

    /// The highest ground not above a height; the lowest where all is above it.
    pub(crate) fn under(&self, x: f64, z: f64, height: f64) -> GroundPoint {
        let at = DVec2::new(x, z).clamp(self.low, self.high);
        let (i, j) = self.cell(at);
        let cell = j * self.columns + i;
        let (mut below, mut above) = (None::<GroundPoint>, None::<GroundPoint>);
        for &member in &self.members[self.starts[cell] as usize..self.starts[cell + 1] as usize] {
            let Some(point) = hit(&self.triangles[member as usize], at) else { continue };
            if point.height <= height {
                if below.is_none_or(|best| point.height > best.height) {
                    below = Some(point);
                }
            } else if above.is_none_or(|best| point.height < best.height) {
                above = Some(point);
            }
        }
        below.or(above).unwrap_or(GroundPoint::level(0.0))
    }

    /// The triangles that touch a rectangle: corners and unit normal.
    pub(crate) fn triangles(&self, low: DVec2, high: DVec2) -> impl Iterator<Item = &([DVec3; 3], DVec3)> {
        self.triangles.iter().filter(move |(corners, _)| overlaps(corners, low, high))
    }

    /// The upright triangles whose boxes overlap one, with their outward normals.
    pub(crate) fn walls(&self, low: DVec2, high: DVec2) -> impl Iterator<Item = &([DVec3; 3], DVec3)> {
        self.walls.iter().filter(move |(corners, _)| overlaps(corners, low, high))
    }
}

fn overlaps(corners: &[DVec3; 3], low: DVec2, high: DVec2) -> bool {
    let [a, b, c] = corners.map(|p| DVec2::new(p.x, p.z));
    a.min(b).min(c).cmple(high).all() && a.max(b).max(c).cmpge(low).all()
}

/// Where the vertical through a place meets a triangle, its edges included.
fn hit(([a, b, c], normal): &([DVec3; 3], DVec3), at: DVec2) -> Option<GroundPoint> {
    let flat = |p: &DVec3| DVec2::new(p.x, p.z);
    let (ab, ac, ap) = (flat(b) - flat(a), flat(c) - flat(a), at - flat(a));
    let area = ab.perp_dot(ac);
    let (u, v) = (ap.perp_dot(ac) / area, ab.perp_dot(ap) / area);
    let slack = -1e-9;
    (u >= slack && v >= slack && u + v <= 1.0 - slack)
        .then_some(GroundPoint { height: a.y + u * (b.y - a.y) + v * (c.y - a.y), normal: *normal })
}
