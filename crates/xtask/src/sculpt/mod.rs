//! Sculpting the shipped figure: shapes along the bones of a skeleton, made into one skinned mesh.
//!
//! `cargo xtask sculpt` writes the figure's skin anew; with `--preview DIR` it only draws it, posed and from all
//! sides, into a folder. The same skeleton gives the same bytes.

mod arm;
mod assemble;
mod bend;
mod blend;
mod body;
mod buried;
mod character;
#[cfg(test)]
mod contact;
mod curve;
mod ear;
mod extremes;
mod eyes;
mod face;
mod faults;
mod field;
mod fit;
mod foot;
mod fullness;
mod hand;
#[cfg(test)]
mod handshape_tests;
mod head;
mod least_change;
mod leg;
mod nets;
mod paint;
mod part;
mod physique;
mod pinch;
mod posing;
mod preview;
mod relax;
mod remesh;
mod rings;
mod shape;
mod slice;
mod stances;
#[cfg(test)]
mod sweep_tests;
mod swelling;
#[cfg(test)]
mod target_tests;
mod targets;
#[cfg(test)]
mod tests;
mod torso;
mod trials;
mod views;
mod weights;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use physique::Physique;
use rig::{Mesh, Skeleton};

/// The folder of the shipped figure.
fn figures() -> PathBuf {
    crate::root().join("assets/figures")
}

/// `sculpt` writes the figure's skin, `sculpt --preview DIR` draws it into a folder instead; see [`views::run`].
///
/// # Errors
/// Unknown arguments, an unreadable skeleton, a mesh with a fault, files that cannot be written.
pub fn run(args: &[String]) -> anyhow::Result<()> {
    let skeleton = skeleton(&figures().join("mannequin.urdf"))?;
    match args {
        [] => {
            let mesh = mesh(&skeleton)?;
            println!("{} vertices, {} triangles", mesh.vertex_count(), mesh.indices.len() / 3);
            let targets = targets::targets(&mesh, &skeleton);
            for (name, moved) in &targets {
                println!("morph target {name} moves {} vertices", moved.len());
            }
            let path = figures().join("mannequin.glb");
            let bytes = interchange::glb::write_with_targets(&mesh, &targets, &skeleton, "mannequin");
            std::fs::write(&path, &bytes).with_context(|| format!("cannot write {}", path.display()))?;
            println!("wrote {}, {} bytes", path.display(), bytes.len());
            Ok(())
        }
        [flag, order @ ..] if flag == "--preview" => views::run(order, &skeleton),
        _ => bail!("sculpt takes nothing or `--preview DIR [OPTIONS]`, not `{}`", args.join(" ")),
    }
}

fn skeleton(path: &Path) -> anyhow::Result<Skeleton> {
    let text = std::fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))?;
    let (skeleton, _) = interchange::urdf::read(&text, &BTreeMap::new())
        .with_context(|| format!("{} is no skeleton", path.display()))?;
    Ok(skeleton)
}

/// The skin that fits a skeleton.
fn mesh(skeleton: &Skeleton) -> anyhow::Result<Mesh> {
    let field = body::field(skeleton, &Physique::NEUTRAL);
    let mesh = assemble::mesh(&field, skeleton, None, |p, bend| body::edge_length(skeleton, p, bend))?;
    match mesh.fault() {
        Some(fault) => bail!("the sculpted mesh is faulty: {fault}"),
        None => Ok(mesh),
    }
}
