//! Ground by the word of a kind, or from a file's triangles.

use std::path::Path;
use std::sync::Arc;

use glam::DVec3;
use motion::{Ground, GroundKind, Sheet};

use crate::disk::{MODEL_LIMIT, read_bytes};
use crate::failure::Failure;

/// The ground of a kind, `hills`, `stairs` and so on, or of a mesh's file: `.obj`, `.stl`, `.dae`, `.glb`. The seed matters to
/// hills and stones.
///
/// # Errors
/// A word that is neither; a file at fault: which, where and why.
pub fn ground(name: &str, seed: u64) -> Result<Ground, Failure> {
    if let Some(ground) = Ground::parse_kind(name, seed) {
        return Ok(ground);
    }
    let path = Path::new(name);
    if path.extension().is_none() {
        let kinds = GroundKind::ALL.map(GroundKind::name);
        let nearest = rig::nearest(name, kinds.into_iter());
        let message = format!(
            "--ground {name}: neither a kind of ground nor a mesh's file; there are {} (did you mean \"{nearest}\"?)",
            kinds.join(", ")
        );
        return Err(Failure::Usage(message));
    }
    let fault = |words: String| Failure::Input(format!("{}:1:1: {words}", path.display()));
    let bytes = read_bytes(path, MODEL_LIMIT)?;
    let (positions, indices) = triangles(path, &bytes)?;
    let places: Vec<DVec3> = positions.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
    let sheet = Sheet::new(&places, &indices).map_err(|e| fault(e.to_string()))?;
    Ok(Ground::Mesh(Arc::new(sheet)))
}

type Triangles = (Vec<[f32; 3]>, Vec<u32>);

fn triangles(path: &Path, bytes: &[u8]) -> Result<Triangles, Failure> {
    let fault = |words: String| Failure::Input(format!("{}:1:1: {words}", path.display()));
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("glb")) {
        // What of it hangs on no bone stays where it is; nothing moves the bones.
        let figure = super::figure(None)?;
        let mesh = interchange::glb::read(bytes, &figure.skeleton).map_err(|e| fault(e.to_string()))?;
        return Ok((mesh.positions, mesh.indices));
    }
    let name = path.to_string_lossy();
    let solid = interchange::solid::read(&name, bytes, &mut super::beside(path)).map_err(|words| {
        // Formats that have lines begin with theirs.
        match words.strip_prefix("line ").and_then(|rest| rest.split_once(": ")) {
            Some((line, words)) if line.parse::<u64>().is_ok() => {
                Failure::Input(format!("{}:{line}:1: {words}", path.display()))
            }
            _ => fault(words),
        }
    })?;
    Ok((solid.positions, solid.indices))
}
