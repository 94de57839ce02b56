//! Script files for chains: the name of a chain, and commands that run one after another on it.

use rig::{TextFault, check_version, from_ron};
use serde::Deserialize;

use super::command::ChainCommand;
use super::document::ChainOutcome;
use super::editor::{ChainEditor, ChainRequest};
use super::report::ChainReport;
use crate::Rejected;
use crate::script::{SCRIPT_VERSION, places};

/// Commands with the line and column at which each begins, and the chain that they are for.
#[derive(Clone, PartialEq, Debug)]
pub struct ChainScript {
    /// The file of the chain, from the script's folder or `library:`.
    pub chain: String,
    /// The commands in order.
    pub commands: Vec<ChainCommand>,
    /// Line and column of each command, from 1.
    pub places: Vec<(usize, usize)>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ScriptText {
    #[serde(rename = "version")]
    _version: u32,
    chain: String,
    commands: Vec<ChainCommand>,
}

/// The chain that a script names; `None` for a script that poses a figure, or is none.
pub fn chain_of_script(text: &str) -> Option<String> {
    #[derive(Deserialize)]
    struct Head {
        chain: String,
    }
    from_ron::<Head>(text).ok().map(|head| head.chain)
}

/// Reads a script for a chain.
///
/// # Errors
/// Malformed text, a version that is not known, unknown commands or fields: what and where.
pub fn parse_chain_script(text: &str) -> Result<ChainScript, TextFault> {
    check_version(text, SCRIPT_VERSION)?;
    let file: ScriptText = from_ron(text)?;
    let places = places(text, file.commands.len());
    Ok(ChainScript { chain: file.chain, commands: file.commands, places })
}

/// Runs a script on a chain and reports the start and then every command.
///
/// # Errors
/// The first command that can't be done, with its place; the editor then stands after the one before it.
pub fn run_chain_script(
    editor: &mut ChainEditor,
    script: &ChainScript,
) -> Result<Vec<ChainReport>, TextFault> {
    let mut reports = vec![ChainReport::of(editor, "start", &ChainOutcome::default())];
    for (command, (line, column)) in script.commands.iter().zip(&script.places) {
        let outcome = editor.submit(ChainRequest::Do(command.clone())).map_err(|Rejected(message)| {
            TextFault { line: *line, column: *column, message: format!("{}: {message}", command.name()) }
        })?;
        reports.push(ChainReport::of(editor, &command.text(), &outcome));
    }
    Ok(reports)
}
