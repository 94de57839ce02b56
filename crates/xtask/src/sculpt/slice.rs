//! The middle of a limb's segment, cut out of a skin: its volume, and how that changes with the places of its vertices.

use std::collections::{BTreeMap, HashSet};

use glam::DVec3;
use rig::{Bone, Mesh, Skeleton};

/// Where it ends, as a fraction of the way between its two joints.
const END: f64 = 0.85;
/// Skin farther than this from the segment's axis belongs to something else, metres.
const ASIDE_M: f64 = 0.2;

/// Triangles of the left half around a limb's middle, and the edges of their rims, rim by rim.
pub struct Slice {
    triangles: Vec<[u32; 3]>,
    rims: Vec<Vec<(u32, u32)>>,
}

impl Slice {
    /// From some fraction of the way between two joints to [`END`], by where the skin is at rest.
    pub fn new(mesh: &Mesh, skeleton: &Skeleton, (bone, next): (Bone, Bone), start: f64) -> Slice {
        let [from, to] = [bone, next].map(|b| skeleton.rest_position(b));
        let inside = |v: &u32| {
            let p = DVec3::from(mesh.positions[*v as usize].map(f64::from));
            let along = (p - from).dot(to - from) / (to - from).length_squared();
            let aside = (p - from.lerp(to, along)).length();
            p.x >= 0.0 && (start..END).contains(&along) && aside < ASIDE_M
        };
        let whole = mesh.indices.chunks_exact(3).filter(|t| t.iter().all(inside));
        let triangles: Vec<[u32; 3]> = whole.map(|t| [t[0], t[1], t[2]]).collect();
        let sides: HashSet<(u32, u32)> =
            triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]).collect();
        let mut rim: Vec<(u32, u32)> =
            sides.iter().filter(|(a, b)| !sides.contains(&(*b, *a))).copied().collect();
        rim.sort_unstable();
        Slice { triangles, rims: connected(&rim) }
    }

    /// In how many rims it ends: 2 where it is a tube.
    #[cfg(test)]
    pub fn rims(&self) -> usize {
        self.rims.len()
    }

    /// Signed volume, the rims closed by fans about their middles, cubic metres; `at` tells where a vertex is.
    pub fn volume(&self, at: impl Fn(u32) -> DVec3) -> f64 {
        let Some(about) = self.triangles.first().map(|t| at(t[0])) else { return 0.0 };
        let tent = |a: DVec3, b: DVec3, c: DVec3| (a - about).dot((b - about).cross(c - about)) / 6.0;
        let skin: f64 = self.triangles.iter().map(|&[a, b, c]| tent(at(a), at(b), at(c))).sum();
        let cap = |rim: &Vec<(u32, u32)>| {
            let middle = middle(rim, &at);
            rim.iter().map(|&(a, b)| tent(at(b), at(a), middle)).sum::<f64>()
        };
        skin + self.rims.iter().map(cap).sum::<f64>()
    }

    /// How the volume grows with the place of each vertex, square metres.
    pub fn gradient(&self, at: impl Fn(u32) -> DVec3) -> Vec<(u32, DVec3)> {
        let mut pulls: BTreeMap<u32, DVec3> = BTreeMap::new();
        let Some(about) = self.triangles.first().map(|t| at(t[0])) else { return Vec::new() };
        let sixth = |a: DVec3, b: DVec3| (a - about).cross(b - about) / 6.0;
        for &[a, b, c] in &self.triangles {
            for (v, next, last) in [(a, b, c), (b, c, a), (c, a, b)] {
                *pulls.entry(v).or_default() += sixth(at(next), at(last));
            }
        }
        for rim in &self.rims {
            let middle = middle(rim, &at);
            let mut of_middle = DVec3::ZERO;
            for &(a, b) in rim {
                *pulls.entry(b).or_default() += sixth(at(a), middle);
                *pulls.entry(a).or_default() += sixth(middle, at(b));
                of_middle += sixth(at(b), at(a));
            }
            rim.iter().for_each(|e| *pulls.entry(e.0).or_default() += of_middle / rim.len() as f64);
        }
        pulls.into_iter().collect()
    }
}

fn middle(rim: &[(u32, u32)], at: impl Fn(u32) -> DVec3) -> DVec3 {
    rim.iter().map(|e| at(e.0)).sum::<DVec3>() / rim.len() as f64
}

/// Edges that share vertices, together.
fn connected(edges: &[(u32, u32)]) -> Vec<Vec<(u32, u32)>> {
    let mut up: BTreeMap<u32, u32> = BTreeMap::new();
    fn top(up: &mut BTreeMap<u32, u32>, v: u32) -> u32 {
        let next = *up.entry(v).or_insert(v);
        if next == v { v } else { top(up, next) }
    }
    for &(a, b) in edges {
        let (a, b) = (top(&mut up, a), top(&mut up, b));
        up.insert(a.max(b), a.min(b));
    }
    let mut groups: BTreeMap<u32, Vec<(u32, u32)>> = BTreeMap::new();
    for &edge in edges {
        groups.entry(top(&mut up, edge.0)).or_default().push(edge);
    }
    groups.into_values().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gradient_tells_how_the_volume_changes() {
        let figure = interchange::figure::mannequin().unwrap();
        let mesh = figure.skin.unwrap();
        let slice = Slice::new(&mesh, &figure.skeleton, (Bone::LeftUpperLeg, Bone::LeftLowerLeg), 0.3);
        let at = |v: u32| DVec3::from(mesh.positions[v as usize].map(f64::from));
        // Growing the higher, leaning the farther back.
        let way = |v: u32| at(v) * at(v).y + DVec3::X * at(v).z;
        let step = 1e-5;
        let change = (slice.volume(|v| at(v) + way(v) * step) - slice.volume(|v| at(v) - way(v) * step))
            / (2.0 * step);
        let told: f64 = slice.gradient(at).iter().map(|(v, pull)| pull.dot(way(*v))).sum();
        assert!(change.abs() > 1e-4 && (told / change - 1.0).abs() < 1e-5, "{told} for {change}");
    }
}
