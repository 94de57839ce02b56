//! Chains from the files that show one: URDF, chain files, scripts that name a chain.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use edit::{ChainDocument, ChainEditor, ChainReport, chain_of_script, parse_chain_script, run_chain_script};

use super::{Kind, at, robot};
use crate::disk::read_text;
use crate::failure::Failure;

/// Whether a file shows a chain and not a figure.
///
/// # Errors
/// A file of no known kind, a script that can't be read.
pub fn shows_chain(path: &Path) -> Result<bool, Failure> {
    Ok(match Kind::of(path)? {
        Kind::Urdf => true,
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
            Ok((ChainEditor::new(Arc::new(robot), &rest), Vec::new()))
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
pub fn save(_document: &ChainDocument, path: &Path) -> Result<(), Failure> {
    Err(Failure::Input(format!("{}: chains can't be saved yet", path.display())))
}

/// The file that another one names: from the same folder.
fn beside(path: &Path, name: &str) -> PathBuf {
    path.parent().map_or_else(|| PathBuf::from(name), |folder| folder.join(name))
}
