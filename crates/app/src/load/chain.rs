//! Chains from the files that show one: URDF, chain files, scripts that name a chain.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use edit::{ChainDocument, ChainEditor, ChainReport, chain_of_script, parse_chain_script, run_chain_script};

use interchange::chain_file::ChainFile;
use rig::Robot;

use super::{Kind, at, chain, robot};
use crate::disk::{read_text, write_atomic};
use crate::failure::Failure;

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

/// An editor that shows the chain of a file, and the records of a script's commands.
///
/// # Errors
/// A file at fault: where and why; one that shows no chain.
pub fn chain_editor(path: &Path) -> Result<(ChainEditor, Vec<ChainReport>), Failure> {
    match Kind::of(path)? {
        Kind::Urdf => {
            let (robot, warnings) = robot(path)?;
            for warning in warnings {
                log::warn!("{}: {warning}", path.display());
            }
            let rest = robot.rest();
            let document = ChainDocument::of(Arc::new(robot), &rest).on_the_ground();
            Ok((ChainEditor::of(document), Vec::new()))
        }
        Kind::Chain => {
            let (file, warnings) = chain(path)?;
            for warning in warnings {
                log::warn!("{}: {warning}", path.display());
            }
            let document = ChainDocument::of(Arc::new(file.robot), &file.pose);
            Ok((
                ChainEditor::of(ChainDocument { world_from_root: file.world_from_root, ..document }),
                Vec::new(),
            ))
        }
        Kind::Script => script(path, None),
        _ => Err(Failure::Input(format!("{}: this shows no chain", path.display()))),
    }
}

/// What a script makes of its chain, or of the one of another file.
///
/// # Errors
/// As [`chain_editor`].
pub fn script(path: &Path, on: Option<&Path>) -> Result<(ChainEditor, Vec<ChainReport>), Failure> {
    let script = parse_chain_script(&read_text(path)?).map_err(|fault| at(path, &fault))?;
    let chain = match on {
        Some(on) => on.to_owned(),
        None => beside(path, &script.chain),
    };
    if Kind::of(&chain)? == Kind::Script {
        return Err(Failure::Input(format!("{}: a script is no chain to start from", chain.display())));
    }
    let (mut editor, _) = chain_editor(&chain)?;
    let reports = run_chain_script(&mut editor, &script).map_err(|fault| at(path, &fault))?;
    Ok((editor, reports))
}

/// Saves a chain, whole or not at all.
///
/// # Errors
/// A file that can't be written, or isn't called like a chain.
pub fn save(document: &ChainDocument, path: &Path) -> Result<(), Failure> {
    let robot = Robot::clone(&document.robot);
    let text = match Kind::of(path)? {
        Kind::Chain => interchange::chain_file::write(&ChainFile {
            pose: document.pose.clone(),
            world_from_root: document.world_from_root,
            ..ChainFile::of(robot)
        }),
        Kind::Urdf => interchange::urdf::write_robot(&robot),
        _ => {
            let message = "a chain is saved as .chain.ron or .urdf";
            return Err(Failure::Input(format!("{}: {message}", path.display())));
        }
    };
    write_atomic(path, text.as_bytes())
}

/// The file that another one names: from the same folder.
fn beside(path: &Path, name: &str) -> PathBuf {
    path.parent().map_or_else(|| PathBuf::from(name), |folder| folder.join(name))
}
