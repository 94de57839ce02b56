//! Chains from the files that show one, and back: URDF, chain files, scripts that name a chain.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use edit::{ChainDocument, ChainEditor, ChainReport, chain_of_script, parse_chain_script, run_chain_script};
use interchange::chain_file::ChainFile;
use rig::Robot;

use super::relative::renamed;
use super::{Kind, at, chain};
use crate::disk::{read_text, write_atomic};
use crate::failure::Failure;
use crate::library::chains;

/// Whether a file shows a chain and not a figure.
///
/// # Errors
/// A file of no known kind, a script that can't be read.
pub fn shows_chain(path: &Path) -> Result<bool, Failure> {
    Ok(match Kind::of(path)? {
        Kind::Urdf | Kind::Chain => true,
        Kind::Script => chain_of_script(&read_text(path)?).is_some(),
        _ => false,
    })
}

/// An editor that shows the chain of a file, and the records of a script's commands. What is odd about the file is logged.
///
/// # Errors
/// A file at fault: where and why; one that shows no chain.
pub fn chain_editor(path: &Path) -> Result<(ChainEditor, Vec<ChainReport>), Failure> {
    if Kind::of(path)? == Kind::Script {
        return script(path, None).map(|ran| (ran.editor, ran.reports));
    }
    let (editor, warnings) = open_chain(path)?;
    for warning in warnings {
        log::warn!("{}: {warning}", path.display());
    }
    Ok((editor, Vec::new()))
}

/// An editor that shows the chain of a chain file or a URDF, and what is odd about the file but does no harm.
///
/// # Errors
/// A file at fault: where and why; one that is neither.
pub fn open_chain(path: &Path) -> Result<(ChainEditor, Vec<String>), Failure> {
    let (file, warnings) = chain(path)?;
    // Meshes are named from the robot's file, which may be in another folder than the chain's.
    let robot = match file.urdf.as_deref().map(Path::new).and_then(Path::parent) {
        Some(folder) if folder != Path::new("") => {
            file.robot.with_mesh_files(|name| renamed(name, |name| folder.join(name)))
        }
        _ => file.robot,
    };
    let document = ChainDocument {
        world_from_root: file.world_from_root,
        root: file.root,
        planar: file.planar,
        urdf: file.urdf,
        ..ChainDocument::of(Arc::new(robot), &file.pose)
    };
    let stands = Kind::of(path)? == Kind::Chain;
    Ok((ChainEditor::of(if stands { document } else { document.on_the_ground() }), warnings))
}

/// What a script made of a chain.
pub struct Ran {
    /// The editor that ran it.
    pub editor: ChainEditor,
    /// What each command did.
    pub reports: Vec<ChainReport>,
    /// The file of the chain before.
    pub chain: PathBuf,
}

/// What a script makes of its chain, or of the one of another file.
///
/// # Errors
/// As [`chain_editor`].
pub fn script(path: &Path, on: Option<&Path>) -> Result<Ran, Failure> {
    let script = parse_chain_script(&read_text(path)?).map_err(|fault| at(path, &fault))?;
    let chain = on.map_or_else(|| beside(path, &script.chain), Path::to_owned);
    if Kind::of(&chain)? == Kind::Script {
        return Err(Failure::Input(format!("{}: a script is no chain to start from", chain.display())));
    }
    let (mut editor, _) = chain_editor(&chain)?;
    let reports = run_chain_script(&mut editor, &script).map_err(|fault| at(path, &fault))?;
    Ok(Ran { editor, reports, chain })
}

/// Saves a chain that was read from some file, whole or not at all. The files that it names are named from its new place.
///
/// # Errors
/// A file that can't be written, or isn't called like a chain.
pub fn save(document: &ChainDocument, from: Option<&Path>, to: &Path) -> Result<(), Failure> {
    let moved = |name: &str| match from {
        Some(from) => super::relative::moved(name, from, to),
        None => name.to_owned(),
    };
    let robot = Robot::clone(&document.robot).with_mesh_files(moved);
    let text = match Kind::of(to)? {
        Kind::Chain => interchange::chain_file::write(&ChainFile {
            robot,
            pose: document.pose.clone(),
            world_from_root: document.world_from_root,
            root: document.root,
            planar: document.planar,
            urdf: document.urdf.as_deref().map(moved),
        }),
        Kind::Urdf => interchange::urdf::write_robot(&robot),
        _ => {
            let message = "a chain is saved as .chain.ron or .urdf";
            return Err(Failure::Input(format!("{}: {message}", to.display())));
        }
    };
    write_atomic(to, text.as_bytes())
}

/// The file that another one names: a shipped one, or from the same folder.
fn beside(path: &Path, name: &str) -> PathBuf {
    match chains::is_shipped(name) {
        true => PathBuf::from(name),
        false => path.parent().map_or_else(|| PathBuf::from(name), |folder| folder.join(name)),
    }
}
