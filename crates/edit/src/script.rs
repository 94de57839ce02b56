//! Script files: commands in RON, run one after another.

use rig::{TextFault, check_version, from_ron};
use serde::Deserialize;

use crate::{Command, Editor, Files, Rejected, Report, Request};

/// The newest version of script files.
pub const SCRIPT_VERSION: u32 = 1;

/// Commands with the line and column at which each begins.
#[derive(Clone, PartialEq, Debug)]
pub struct Script {
    /// The commands in order.
    pub commands: Vec<Command>,
    /// Line and column of each command, from 1.
    pub places: Vec<(usize, usize)>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ScriptText {
    #[serde(rename = "version")]
    _version: u32,
    commands: Vec<Command>,
}

/// Reads a script.
///
/// # Errors
/// Malformed text, a version that is not known, unknown commands or fields: what and where.
pub fn parse_script(text: &str) -> Result<Script, TextFault> {
    check_version(text, SCRIPT_VERSION)?;
    let file: ScriptText = from_ron(text)?;
    let places = places(text, file.commands.len());
    Ok(Script { commands: file.commands, places })
}

/// Runs a script on an editor and reports the start and then every command.
///
/// # Errors
/// The first command that can't be done, with its place; the editor then stands after the one before it.
pub fn run_script(
    editor: &mut Editor,
    script: &Script,
    files: &mut dyn Files,
) -> Result<Vec<Report>, TextFault> {
    let mut reports = vec![Report::of(editor, "start", None)];
    for (command, (line, column)) in script.commands.iter().zip(&script.places) {
        let goal = crate::apply::goal_in_world(editor.figure(), editor.pose(), command);
        let outcome = editor.submit(Request::Do(command.clone()), files).map_err(|Rejected(message)| {
            TextFault { line: *line, column: *column, message: format!("{}: {message}", command.name()) }
        })?;
        let mut report = Report::of(editor, &command.text(), goal);
        report.clamped = outcome.clamped;
        reports.push(report);
    }
    Ok(reports)
}

/// Where each command begins: the starts of the items of the `commands` list, comments and strings passed over.
pub(crate) fn places(text: &str, count: usize) -> Vec<(usize, usize)> {
    let mut found = Vec::with_capacity(count);
    let (mut line, mut column, mut depth) = (1, 0, 0i32);
    let mut fresh = false;
    let mut chars = text.chars().peekable();
    let mut in_string = false;
    while let Some(c) = chars.next() {
        column += 1;
        if c == '\n' {
            (line, column) = (line + 1, 0);
        }
        if in_string {
            match c {
                '\\' => {
                    chars.next();
                    column += 1;
                }
                '"' => in_string = false,
                _ => {}
            }
            continue;
        }
        match c {
            '"' => in_string = true,
            '/' if chars.peek() == Some(&'/') => {
                while chars.peek().is_some_and(|c| *c != '\n') {
                    chars.next();
                    column += 1;
                }
            }
            '(' | '{' => depth += 1,
            ')' | '}' => depth -= 1,
            '[' => {
                depth += 1;
                fresh |= depth == 2;
            }
            ']' => depth -= 1,
            ',' if depth == 2 => fresh = true,
            _ => {}
        }
        if fresh && depth == 2 && c.is_alphabetic() {
            found.push((line, column));
            fresh = false;
        }
    }
    found.resize(count, (1, 1));
    found
}
