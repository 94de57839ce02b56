//! Makes the meshes of the shipped chains: plates and turned parts, drawn as outlines.

mod excavator;
mod lamp;
mod lathe;
mod outline;
mod plate;
mod solid;

use anyhow::Context;

use solid::Solid;

/// Every mesh by the name of its file.
fn meshes() -> Vec<(&'static str, Solid)> {
    excavator::meshes().into_iter().chain(lamp::meshes()).collect()
}

/// Writes them all into the folder of the chains.
///
/// # Errors
/// A file cannot be written.
pub fn run() -> anyhow::Result<()> {
    let folder = crate::root().join("assets/chains/meshes");
    std::fs::create_dir_all(&folder).with_context(|| format!("cannot make {}", folder.display()))?;
    for (name, solid) in meshes() {
        let path = folder.join(format!("{name}.obj"));
        std::fs::write(&path, solid.obj()).with_context(|| format!("cannot write {}", path.display()))?;
        println!("{name}.obj: {} triangles", solid.triangles());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stored_meshes_are_those_that_are_made() {
        let folder = crate::root().join("assets/chains/meshes");
        let stored = std::fs::read_dir(&folder).unwrap().count();
        assert_eq!(stored, meshes().len(), "files in {}", folder.display());
        for (name, solid) in meshes() {
            let text = std::fs::read_to_string(folder.join(format!("{name}.obj"))).unwrap();
            assert_eq!(text, solid.obj(), "{name}: run `cargo xtask chains`");
        }
    }

    #[test]
    fn every_mesh_is_closed_and_faces_outward() {
        let told = |(name, solid): (&str, Solid)| {
            let (open, inside) = (solid.open_edges(), solid.volume());
            (open > 0 || inside < 1e-5).then(|| format!("{name}: {open} open edges, {inside} m3 inside"))
        };
        let faults: Vec<String> = meshes().into_iter().filter_map(told).collect();
        assert!(faults.is_empty(), "{}", faults.join("\n"));
    }
}
