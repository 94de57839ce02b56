//! The project's chores, run as `cargo xtask …`: opening the window, checking everything, sculpting the figure.
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod chains;
mod check;
mod clips;
mod display;
mod launch;
mod machine;
mod pictures;
mod sculpt;
mod stages;

use std::path::PathBuf;
use std::process::ExitCode;

const USAGE: &str = "\
Usage: cargo xtask <COMMAND>

  run [ARGS]             build in release and open the window; without a display, render the sample poses
                         ARGS go to the program: `cargo xtask run FILE`, `cargo xtask run -- --help`
  test                   every test: units, documents, pictures, the window on a display of its own
  lint                   formatting, lints and documentation
  sculpt [--preview DIR [--only PART]]
                         make the shipped figure anew, or only draw it or a part of it
  chains                 make the meshes of the shipped chains anew
  clips                 make the shipped clips of motion anew
  pictures [NAME…]       make the pictures of the README and the guide anew; `pictures sheet` the contact sheet alone

`run` and `test` first install the system packages that are missing on Debian and Ubuntu, where they may.";

fn main() -> ExitCode {
    let args: Vec<String> = std::env::args().skip(1).collect();
    let Some((command, rest)) = args.split_first() else {
        eprintln!("{USAGE}");
        return ExitCode::from(2);
    };
    let outcome = match (command.as_str(), rest) {
        ("run", args) => launch::run(args),
        ("test", []) => check::test(),
        ("lint", []) => check::lint(),
        ("chains", []) => chains::run(),
        ("clips", []) => clips::run(),
        ("sculpt", args) => sculpt::run(args),
        ("pictures", names) => pictures::run(names),
        ("help" | "--help" | "-h", _) => {
            println!("{USAGE}");
            Ok(())
        }
        _ => {
            eprintln!("xtask doesn't know `{}`.\n\n{USAGE}", args.join(" "));
            return ExitCode::from(2);
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("xtask: {error:#}");
            ExitCode::FAILURE
        }
    }
}

/// The top folder of the project, wherever the command was typed.
fn root() -> PathBuf {
    let crate_folder = std::env::var_os("CARGO_MANIFEST_DIR")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")), PathBuf::from);
    crate_folder.ancestors().nth(2).map_or_else(PathBuf::new, PathBuf::from)
}
