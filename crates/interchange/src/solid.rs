//! Meshes that stay as they are, of robots' links: STL, OBJ and COLLADA as triangles.

mod collada;
mod obj;
mod stl;
mod triangles;

use rig::Solid;

/// The most triangles of one mesh.
pub const MAX_TRIANGLES: usize = 4_000_000;

/// Reads the mesh of a file by the ending of its name: `.stl` in either form, `.obj`, `.dae`. Colours are those of the file's
/// materials where it has some; units are metres, those of COLLADA files as they say.
///
/// `fetch` brings the files that this one names, such as the materials of an OBJ; where it can't, colours are missing.
///
/// COLLADA's `up_axis` is left alone, as RViz and Gazebo do: a mesh's axes are those of its visual. (The gripper of the PR2, of
/// which the tutorials of URDF have an STL and a Y_UP COLLADA file, says so.)
///
/// # Errors
/// A sentence what is wrong, with the line where the format has lines.
pub fn read(
    name: &str,
    bytes: &[u8],
    fetch: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>,
) -> Result<Solid, String> {
    let ending = name.rsplit('.').next().unwrap_or_default().to_ascii_lowercase();
    let solid = match ending.as_str() {
        "stl" => stl::read(bytes),
        "obj" => obj::read(bytes, fetch),
        "dae" => collada::read(bytes),
        _ => Err(format!("\".{ending}\" is no kind of mesh that is read, expected .stl, .obj or .dae")),
    }?;
    match solid.fault() {
        None if solid.indices.is_empty() => Err("it has no triangles".to_owned()),
        None => Ok(solid),
        Some(fault) => Err(fault),
    }
}
