//! Wavefront OBJ with the colours of its MTL files.

use std::cell::RefCell;
use std::io::BufReader;

use glam::Vec3;
use rig::{Solid, UNPAINTED};
use tobj::{LoadError, LoadOptions};

use super::triangles::{Triangles, linear};

/// Reads triangles and polygons; points and lines are left out.
pub(super) fn read(
    bytes: &[u8],
    fetch: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>,
) -> Result<Solid, String> {
    let options =
        LoadOptions { single_index: false, triangulate: true, ignore_points: true, ignore_lines: true };
    // `tobj` asks through a shared function.
    let fetch = RefCell::new(fetch);
    let materials = |path: &std::path::Path| {
        let bytes = (fetch.borrow_mut())(&path.to_string_lossy()).map_err(|_| LoadError::OpenFileFailed)?;
        tobj::load_mtl_buf(&mut BufReader::new(&*bytes))
    };
    let (models, materials) = tobj::load_obj_buf(&mut BufReader::new(bytes), &options, materials)
        .map_err(|e| format!("not OBJ: {e}"))?;
    let materials = materials.unwrap_or_default();
    let mut triangles = Triangles::default();
    for model in &models {
        let mesh = &model.mesh;
        let diffuse = mesh.material_id.and_then(|i| materials.get(i)?.diffuse);
        let color = diffuse.map_or(UNPAINTED, linear);
        for at in 0..mesh.indices.len() / 3 {
            let [a, b, c] = [0, 1, 2].map(|k| vector(&mesh.positions, mesh.indices.get(3 * at + k)));
            let (Some(a), Some(b), Some(c)) = (a, b, c) else {
                return Err(format!("\"{}\": a face names a vertex that is not there", model.name));
            };
            let normals = [0, 1, 2].map(|k| vector(&mesh.normals, mesh.normal_indices.get(3 * at + k)));
            let normals = match normals {
                [Some(a), Some(b), Some(c)] => Some([a, b, c]),
                _ => None,
            };
            triangles.add([a, b, c], normals, color)?;
        }
    }
    Ok(triangles.solid())
}

fn vector(numbers: &[f32], index: Option<&u32>) -> Option<Vec3> {
    let start = usize::try_from(*index?).ok()?.checked_mul(3)?;
    numbers.get(start..start.checked_add(3)?).map(Vec3::from_slice)
}

#[cfg(test)]
mod tests {
    use super::*;

    const OBJ: &str = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nusemtl red\nf 1 2 3 4\nl 1 2\n";

    #[test]
    fn polygons_become_triangles_in_their_materials_colour() {
        let mut asked = Vec::new();
        let mut fetch = |name: &str| {
            asked.push(name.to_owned());
            Ok(b"newmtl red\nKd 1 0 0\n".to_vec())
        };
        let solid = read(OBJ.as_bytes(), &mut fetch).unwrap();
        assert_eq!((solid.positions.len(), solid.indices.len()), (4, 6));
        assert_eq!((solid.colors[0], solid.normals[0]), ([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]));
        assert_eq!(asked, ["a.mtl"]);
    }

    #[test]
    fn without_its_materials_a_mesh_is_grey() {
        let solid = read(OBJ.as_bytes(), &mut |_| Err("no such file".to_owned())).unwrap();
        assert_eq!(solid.colors[0], UNPAINTED);
    }

    #[test]
    fn a_face_of_vertices_that_are_not_there_is_an_error() {
        assert!(read(b"v 0 0 0\nf 1 2 3\n", &mut |_| Err(String::new())).is_err());
        assert!(read(b"v 0 0 0\nf -9 -8 -7\n", &mut |_| Err(String::new())).is_err());
    }
}
