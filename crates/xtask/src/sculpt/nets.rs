//! Surface nets over a sparse grid: the left half of the body as triangles, closed by its mirror image.
//!
//! A cell that two sheets of the surface cross gets one vertex a sheet, so that every edge has two triangles.

use std::collections::HashMap;

use glam::DVec3;

use super::field::{Active, BLOCK, Field, Lookup};
use super::shape::Bounds;

/// A triangle mesh without attributes.
#[derive(Clone, Debug, Default)]
pub struct Surface {
    /// Vertices, metres.
    pub points: Vec<DVec3>,
    /// Triangles, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

/// Cells along one side of a block.
const CELLS: i32 = 8;
/// Blocks along one side of a coarse box.
const COARSE: i32 = 4;
/// Side of a cell, metres.
pub const CELL: f64 = BLOCK / CELLS as f64;

/// The edges of a cell as pairs of corners; corner bits are x, y, z.
const EDGES: [(usize, usize); 12] =
    [(0, 1), (2, 3), (4, 5), (6, 7), (0, 2), (1, 3), (4, 6), (5, 7), (0, 4), (1, 5), (2, 6), (3, 7)];
/// The faces of a cell as corners in a ring.
const FACES: [[usize; 4]; 6] =
    [[0, 2, 6, 4], [1, 3, 7, 5], [0, 1, 5, 4], [2, 3, 7, 6], [0, 1, 3, 2], [4, 5, 7, 6]];

/// One cell's vertices: the number of the first, and for each edge which of them it belongs to.
struct Sheets {
    first: u32,
    of_edge: [u8; 12],
}

/// The left half of the surface (x of 0 and more), rim on the middle plane, and the field with its blocks remembered.
/// With a box, only the blocks that touch it: the surface then ends open at its border.
pub fn polygonize<'a>(field: &'a Field, within: Option<&Bounds>) -> (Surface, Lookup<'a>) {
    let blocks = surface_blocks(field, within);
    let mut surface = Surface::default();
    let mut cells: HashMap<[i32; 3], Sheets> = HashMap::new();
    let mut crossings = Vec::new();
    for (block, active) in &blocks {
        net_block(field, *block, active, &mut surface, &mut cells, &mut crossings);
    }
    for crossing in &crossings {
        join(crossing, &cells, &mut surface);
    }
    untangle(&mut surface);
    (surface, Lookup::new(field, blocks.into_iter().collect()))
}

/// Where two sheets touch along an edge, so that four triangles share it, gives each sheet an edge of its own by a new
/// vertex in its middle.
fn untangle(surface: &mut Surface) {
    let mut sides: Vec<(u32, u32, usize, bool)> = Vec::with_capacity(surface.triangles.len() * 3);
    for (t, &[a, b, c]) in surface.triangles.iter().enumerate() {
        sides.extend([(a, b), (b, c), (c, a)].map(|(p, q)| (p.min(q), p.max(q), t, p < q)));
    }
    sides.sort_unstable();
    for shared in sides.chunk_by(|x, y| (x.0, x.1) == (y.0, y.1)).filter(|s| s.len() == 4) {
        let (a, b) = (shared[0].0, shared[0].1);
        let apex = |surface: &Surface, t: usize| surface.triangles[t].into_iter().find(|&v| v != a && v != b);
        let middle = 0.5 * (surface.points[a as usize] + surface.points[b as usize]);
        let away = |surface: &Surface, t: usize| {
            apex(surface, t)
                .map_or(DVec3::ZERO, |v| (surface.points[v as usize] - middle).normalize_or_zero())
        };
        let up: Vec<usize> = shared.iter().filter(|s| s.3).map(|s| s.2).collect();
        let mut down: Vec<usize> = shared.iter().filter(|s| !s.3).map(|s| s.2).collect();
        if up.len() != 2 || down.len() != 2 {
            continue;
        }
        let first = away(surface, up[0]);
        if first.dot(away(surface, down[1])) > first.dot(away(surface, down[0])) {
            down.swap(0, 1);
        }
        for (t, u) in up.into_iter().zip(down) {
            let lean = away(surface, t) + away(surface, u);
            let new = surface.points.len() as u32;
            surface.points.push(middle + lean * (0.1 * CELL));
            for triangle in [t, u] {
                let whole = surface.triangles[triangle];
                let with = |old: u32| whole.map(|v| if v == old { new } else { v });
                let (near, far) = (with(b), with(a));
                surface.triangles[triangle] = near;
                surface.triangles.push(far);
            }
        }
    }
}

/// Blocks that the surface may cross, in a fixed order.
fn surface_blocks(field: &Field, within: Option<&Bounds>) -> Vec<([i32; 3], Active)> {
    let everything = field.everything();
    let extent = field.extent();
    let wanted = |at: [i32; 3], side: f64| {
        let low = DVec3::from(at.map(f64::from)) * side;
        within.is_none_or(|b| b.gap(&Bounds { low, high: low + DVec3::splat(side) }) <= 0.0)
    };
    let side = BLOCK * f64::from(COARSE);
    let low = (extent.low / side).floor().as_ivec3();
    let high = (extent.high / side).floor().as_ivec3();
    let mut found = Vec::new();
    for z in low.z..=high.z {
        for y in low.y..=high.y {
            for x in low.x.max(0)..=high.x {
                if !wanted([x, y, z], side) {
                    continue;
                }
                let Some(coarse) = crossed(field, &everything, [x, y, z], side) else { continue };
                for i in 0..COARSE.pow(3) {
                    let at = [
                        x * COARSE + i % COARSE,
                        y * COARSE + i / COARSE % COARSE,
                        z * COARSE + i / COARSE.pow(2),
                    ];
                    if !wanted(at, BLOCK) {
                        continue;
                    }
                    if let Some(active) = crossed(field, &coarse, at, BLOCK) {
                        found.push((at, active));
                    }
                }
            }
        }
    }
    found
}

/// The shapes that matter in a box, or nothing if the surface stays clear of it.
fn crossed(field: &Field, among: &Active, at: [i32; 3], side: f64) -> Option<Active> {
    let low = DVec3::from(at.map(f64::from)) * side;
    let bounds = Bounds { low, high: low + DVec3::splat(side) }.grown(CELL);
    let active = field.near(among, &bounds);
    // Distances are estimates: half again as far as an exact one would need.
    let reach = side * 0.87 * 1.6;
    let clear = active.is_empty() || field.value(&active, low + DVec3::splat(side * 0.5)).abs() > reach;
    (!clear).then_some(active)
}

/// A grid edge that the surface crosses: its lower node, axis, and whether the lower node is inside.
struct Crossing {
    node: [i32; 3],
    axis: usize,
    inside: bool,
}

/// The place of a grid node. The first column of cells straddles the middle plane, so that its vertices lie on it.
fn node_place(node: [i32; 3]) -> DVec3 {
    DVec3::new(f64::from(node[0]) - 0.5, f64::from(node[1]), f64::from(node[2])) * CELL
}

fn net_block(
    field: &Field,
    block: [i32; 3],
    active: &Active,
    surface: &mut Surface,
    cells: &mut HashMap<[i32; 3], Sheets>,
    crossings: &mut Vec<Crossing>,
) {
    const N: usize = CELLS as usize + 1;
    let origin = block.map(|b| b * CELLS);
    let mut values = [0.0; N * N * N];
    for (i, value) in values.iter_mut().enumerate() {
        let at = [i % N, i / N % N, i / (N * N)];
        let node: [i32; 3] = std::array::from_fn(|c| origin[c] + at[c] as i32);
        let v = field.value(active, node_place(node));
        *value = if v == 0.0 { 1e-12 } else { v };
    }
    let at = |x: usize, y: usize, z: usize| values[x + N * (y + N * z)];
    for i in 0..(N - 1).pow(3) {
        let (x, y, z) = (i % (N - 1), i / (N - 1) % (N - 1), i / (N - 1).pow(2));
        let corners: [f64; 8] = std::array::from_fn(|c| at(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2)));
        if corners.iter().all(|v| *v < 0.0) || corners.iter().all(|v| *v > 0.0) {
            continue;
        }
        let cell = [origin[0] + x as i32, origin[1] + y as i32, origin[2] + z as i32];
        cells.insert(cell, sheets(cell, &corners, surface));
        for axis in 0..3 {
            if (corners[0] < 0.0) != (corners[1 << axis] < 0.0) {
                crossings.push(Crossing { node: cell, axis, inside: corners[0] < 0.0 });
            }
        }
    }
}

/// Puts one vertex a sheet into a cell: the mean of the sheet's crossings.
fn sheets(cell: [i32; 3], corners: &[f64; 8], surface: &mut Surface) -> Sheets {
    let inside: [bool; 8] = corners.map(|v| v < 0.0);
    let crossed = EDGES.map(|(a, b)| inside[a] != inside[b]);
    let mut group: [usize; 12] = std::array::from_fn(|i| i);
    for face in FACES {
        for (a, b) in face_links(face, &inside) {
            let (from, to) = (group[a].max(group[b]), group[a].min(group[b]));
            group.iter_mut().filter(|g| **g == from).for_each(|g| *g = to);
        }
    }
    let first = surface.points.len() as u32;
    let mut of_edge = [0; 12];
    let mut next = 0;
    for g in 0..12 {
        let members: Vec<usize> = (0..12).filter(|&e| crossed[e] && group[e] == g).collect();
        if members.is_empty() {
            continue;
        }
        let sum: DVec3 = members.iter().map(|&e| crossing_place(cell, corners, EDGES[e])).sum();
        let mut p = sum / members.len() as f64;
        if cell[0] == 0 {
            p.x = 0.0;
        }
        surface.points.push(p);
        members.iter().for_each(|&e| of_edge[e] = next);
        next += 1;
    }
    Sheets { first, of_edge }
}

/// Pairs of crossed edges that the surface joins across a face; solid corners that touch stay apart.
fn face_links(face: [usize; 4], inside: &[bool; 8]) -> Vec<(usize, usize)> {
    let ring = |i: usize| face[i % 4];
    let edge = |i: usize| {
        let (a, b) = (ring(i).min(ring(i + 1)), ring(i).max(ring(i + 1)));
        EDGES.iter().position(|&e| e == (a, b)).unwrap_or(0)
    };
    let crossed: Vec<usize> = (0..4).filter(|&i| inside[ring(i)] != inside[ring(i + 1)]).collect();
    match crossed.len() {
        2 => vec![(edge(crossed[0]), edge(crossed[1]))],
        4 => (0..4).filter(|&i| inside[ring(i)]).map(|i| (edge(i + 3), edge(i))).collect(),
        _ => Vec::new(),
    }
}

fn crossing_place(cell: [i32; 3], corners: &[f64; 8], (a, b): (usize, usize)) -> DVec3 {
    let place = |c: usize| {
        node_place([cell[0] + (c & 1) as i32, cell[1] + (c >> 1 & 1) as i32, cell[2] + (c >> 2) as i32])
    };
    place(a).lerp(place(b), corners[a] / (corners[a] - corners[b]))
}

/// Two triangles between the four cells around a crossed grid edge.
fn join(crossing: &Crossing, cells: &HashMap<[i32; 3], Sheets>, surface: &mut Surface) {
    let (u, v) = ((crossing.axis + 1) % 3, (crossing.axis + 2) % 3);
    // From the middle column outward: an edge at its inner side belongs to the other half.
    if crossing.axis != 0 && crossing.node[0] == 0 {
        return;
    }
    let mut ring = [0; 4];
    for (slot, (du, dv)) in ring.iter_mut().zip([(-1, -1), (0, -1), (0, 0), (-1, 0)]) {
        let mut cell = crossing.node;
        cell[u] += du;
        cell[v] += dv;
        // The edge as that cell sees it starts at the corner opposite to the shift.
        let corner = (usize::from(du < 0) << u) | (usize::from(dv < 0) << v);
        let edge = EDGES.iter().position(|&e| e == (corner, corner | 1 << crossing.axis)).unwrap_or(0);
        let Some(sheets) = cells.get(&cell) else { return };
        *slot = sheets.first + u32::from(sheets.of_edge[edge]);
    }
    if !crossing.inside {
        ring.reverse();
    }
    let p = ring.map(|i| surface.points[i as usize]);
    let quad = if p[0].distance_squared(p[2]) <= p[1].distance_squared(p[3]) {
        [[ring[0], ring[1], ring[2]], [ring[0], ring[2], ring[3]]]
    } else {
        [[ring[1], ring[2], ring[3]], [ring[1], ring[3], ring[0]]]
    };
    surface.triangles.extend(quad);
}
