//! Normals of a skin whose vertices have moved.

use glam::{DQuat, DVec3};

use crate::Mesh;

/// Gives a moved mesh its normals: those that it had, turned as the triangles around each vertex have turned.
pub(super) fn turn_along(before: &Mesh, after: &mut Mesh) {
    let (was, is) = (around(before), around(after));
    for (normal, (was, is)) in after.normals.iter_mut().zip(was.into_iter().zip(is)) {
        if was == DVec3::ZERO || is == DVec3::ZERO || was == is {
            continue;
        }
        let n = DVec3::from(normal.map(f64::from));
        let turned = DQuat::from_rotation_arc(was, is) * n;
        *normal = turned.normalize_or(is).as_vec3().to_array();
    }
}

/// The unit mean normal of the triangles around each vertex by their areas; zero where there is none.
fn around(mesh: &Mesh) -> Vec<DVec3> {
    let at = |v: u32| DVec3::from(mesh.positions[v as usize].map(f64::from));
    let mut sums = vec![DVec3::ZERO; mesh.vertex_count()];
    for t in mesh.indices.chunks_exact(3) {
        let area = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
        t.iter().for_each(|&v| sums[v as usize] += area);
    }
    sums.iter_mut().for_each(|sum| *sum = sum.normalize_or_zero());
    sums
}
