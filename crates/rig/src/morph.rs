//! Morph targets: named displacements of a skin's vertices at rest.

use std::collections::BTreeMap;

use crate::Mesh;

/// The vertices that a target moves, each once and in ascending order, and by how much, metres at rest.
pub type MorphTarget = Vec<(u32, [f32; 3])>;

/// Morph targets by name.
pub type MorphTargets = BTreeMap<String, MorphTarget>;

/// Moves the vertices of a mesh by shares of its targets; normals stay as they are. Names that `targets` lacks and
/// vertices that the mesh lacks are left out, as are shares that are not finite.
pub fn add_targets(mesh: &mut Mesh, targets: &MorphTargets, shares: &[(&str, f64)]) {
    for (name, share) in shares.iter().filter(|(_, share)| share.is_finite()) {
        for (vertex, moved) in targets.get(*name).into_iter().flatten() {
            let Some(place) = mesh.positions.get_mut(*vertex as usize) else { continue };
            for (p, d) in place.iter_mut().zip(moved) {
                *p = (f64::from(*p) + share * f64::from(*d)) as f32;
            }
        }
    }
}
