//! Morph targets out of a glTF file: their names and what they move.

use glam::DVec3;
use gltf::mesh::Primitive;
use serde::Deserialize;

use super::GlbError;
use super::accessor::rows;

/// Names of each mesh's morph targets, in the order in which its primitives list them.
pub(super) type Names = Vec<Vec<String>>;

#[derive(Deserialize)]
struct Head {
    #[serde(default)]
    meshes: Vec<MeshHead>,
}

#[derive(Deserialize)]
struct MeshHead {
    #[serde(default)]
    extras: serde_json::Value,
}

/// The names as glTF files carry them, `extras.targetNames`; what is no list of texts counts as no names.
pub(super) fn names(json: &[u8]) -> Names {
    let Ok(head) = serde_json::from_slice::<Head>(json) else { return Names::new() };
    let of_mesh = |mesh: MeshHead| {
        let names = mesh.extras.get("targetNames").and_then(|n| n.as_array()).cloned().unwrap_or_default();
        let text = |name: serde_json::Value| name.as_str().map_or_else(String::new, str::to_owned);
        names.into_iter().map(text).collect()
    };
    head.meshes.into_iter().map(of_mesh).collect()
}

/// Whether every accessor that a morph target names is there: the glTF library looks them up unchecked.
pub(super) fn accessors_exist(root: &gltf::json::Root) -> bool {
    let count = root.accessors.len();
    let primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let mut targets = primitives.flat_map(|p| p.targets.iter().flatten());
    targets.all(|t| {
        [&t.positions, &t.normals, &t.tangents].into_iter().flatten().all(|accessor| accessor.value() < count)
    })
}

/// What the wanted targets of a primitive add to each of its vertices' places: name and one row a vertex.
///
/// # Errors
/// Data outside of the file, another number of rows than vertices, numbers that are not finite.
pub(super) fn wanted(
    primitive: &Primitive<'_>,
    names: Option<&Vec<String>>,
    wanted: &dyn Fn(&str) -> bool,
    count: usize,
    (data, what): (&[u8], &str),
) -> Result<Vec<(String, Vec<DVec3>)>, GlbError> {
    let mut found = Vec::new();
    for (i, target) in primitive.morph_targets().enumerate() {
        let given = names.and_then(|n| n.get(i)).filter(|name| !name.is_empty());
        let name = given.cloned().unwrap_or_else(|| format!("target {i}"));
        let Some(accessor) = target.positions().filter(|_| wanted(&name)) else { continue };
        let what = format!("{what} morph target \"{name}\"");
        let moved = rows(&accessor, data, &what)?;
        if moved.len() != count {
            return Err(GlbError::Unexpected {
                what: format!("the length of {what}"),
                found: moved.len().to_string(),
                expected: "as many as positions",
            });
        }
        let moved: Vec<DVec3> = moved.iter().map(|r| glam::Vec3::new(r[0], r[1], r[2]).as_dvec3()).collect();
        if let Some(v) = moved.iter().position(|d| !d.is_finite()) {
            return Err(GlbError::NotFinite { what: format!("{what} vertex {v}") });
        }
        found.push((name, moved));
    }
    Ok(found)
}
