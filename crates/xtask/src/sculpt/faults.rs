//! What a pose did to a skin: triangles turned inside out.

use glam::Vec3;
use rig::Mesh;
#[cfg(test)]
use rig::{PALETTE_LEN, Palette, skin_normals, skin_positions};

/// A triangle with less area than this has no side worth speaking of, square metres.
#[cfg(test)]
pub const TINY_M2: f32 = 1e-7;

/// The triangles whose area, as seen along their skinned normals, is at most `left` of that at rest; places in
/// `mesh.indices` over three. With 0 these are the inverted ones.
#[cfg(test)]
pub fn squeezed(mesh: &Mesh, palette: &Palette, left: f32) -> Vec<usize> {
    let touched = Touched::new(mesh, palette);
    let places = skin_positions(&touched.mesh, palette);
    let normals = skin_normals(&touched.mesh, palette);
    let rest = |v: u32| Vec3::from_array(touched.mesh.positions[v as usize]);
    let mut all = Vec::new();
    for (&t, corner) in touched.triangles.iter().zip(touched.mesh.indices.chunks_exact(3)) {
        let [a, b, c] = [corner[0], corner[1], corner[2]];
        let face = |at: &dyn Fn(u32) -> Vec3| (at(b) - at(a)).cross(at(c) - at(a)) * 0.5;
        let posed = face(&|v| places[v as usize]);
        if posed.length() < TINY_M2 {
            continue;
        }
        let normal = normals[a as usize] + normals[b as usize] + normals[c as usize];
        let seen = posed.dot(normal.normalize_or_zero());
        if seen <= 0.0 || left > 0.0 && seen < left * face(&rest).length() {
            all.push(t);
        }
    }
    all
}

/// Triangles of creases that lie so much askew at rest that posing can't tell anything of them.
pub fn askew(mesh: &Mesh) -> Vec<usize> {
    let lies = |corner: &[u32]| {
        let [a, b, c] = [0, 1, 2].map(|i| Vec3::from_array(mesh.positions[corner[i] as usize]));
        let normal: Vec3 = corner.iter().map(|v| Vec3::from_array(mesh.normals[*v as usize])).sum();
        let face = (b - a).cross(c - a);
        face.dot(normal.normalize_or_zero()) < 0.4 * face.length()
    };
    let rows = mesh.indices.chunks_exact(3).enumerate();
    rows.filter(|(_, corner)| lies(corner)).map(|(t, _)| t).collect()
}

/// The triangles that a pose moves at all, numbered anew.
#[cfg(test)]
struct Touched {
    mesh: Mesh,
    /// Where each was.
    triangles: Vec<usize>,
}

#[cfg(test)]
impl Touched {
    fn new(mesh: &Mesh, palette: &Palette) -> Touched {
        let moved: [bool; PALETTE_LEN] = std::array::from_fn(|i| palette.0[i] != Palette::REST.0[i]);
        let moves = |v: u32| {
            let parts = mesh.joints[v as usize].iter().zip(mesh.weights[v as usize]);
            parts.into_iter().any(|(place, weight)| weight > 0 && moved[usize::from(*place)])
        };
        let moves: Vec<bool> = (0..mesh.positions.len() as u32).map(moves).collect();
        let mut touched = Touched { mesh: Mesh::default(), triangles: Vec::new() };
        let mut slots = vec![u32::MAX; mesh.positions.len()];
        for (t, corner) in mesh.indices.chunks_exact(3).enumerate() {
            if !corner.iter().any(|v| moves[*v as usize]) {
                continue;
            }
            touched.triangles.push(t);
            for &v in corner {
                let v = v as usize;
                if slots[v] == u32::MAX {
                    slots[v] = touched.mesh.positions.len() as u32;
                    touched.mesh.positions.push(mesh.positions[v]);
                    touched.mesh.normals.push(mesh.normals[v]);
                    touched.mesh.joints.push(mesh.joints[v]);
                    touched.mesh.weights.push(mesh.weights[v]);
                }
                touched.mesh.indices.push(slots[v]);
            }
        }
        touched
    }
}
