//! `cargo xtask pictures`: makes the pictures of the README and the guide anew, with the program itself.

pub mod shots;

use std::process::Command;

use anyhow::{Context, Result, ensure};

use crate::stages::cargo;
use shots::{FOLDER, TABLE};

/// Builds the program and writes the pictures of these names, or every picture of the table if none is named.
///
/// # Errors
/// The build or a rendering fails; a picture can't be written; a name that no picture has.
pub fn run(names: &[String]) -> Result<()> {
    for name in names {
        ensure!(TABLE.iter().any(|picture| picture.name == *name), "no picture is called {name}");
    }
    let status = cargo(["build", "--package", "app", "--bin", "posewright"]).status()?;
    ensure!(status.success(), "the build ended with {status}");
    let root = crate::root();
    let own = std::env::current_exe().context("finding the folder of built programs")?;
    let program = own.with_file_name(format!("posewright{}", std::env::consts::EXE_SUFFIX));
    let version = Command::new(&program).arg("--version").output();
    version.with_context(|| format!("starting {}", program.display()))?;
    std::fs::create_dir_all(root.join(FOLDER))?;
    let mut total = 0;
    let asked = |name: &str| names.is_empty() || names.iter().any(|other| other == name);
    for picture in TABLE.iter().filter(|picture| asked(picture.name)) {
        let bytes = shots::png(&picture.make(&program, &root)?)?;
        total += bytes.len();
        println!("{:14} {:5} kB", picture.name, bytes.len() / 1000);
        let path = root.join(FOLDER).join(picture.name);
        std::fs::write(&path, bytes).with_context(|| format!("writing {}", path.display()))?;
    }
    println!("{} kB in {FOLDER}", total / 1000);
    Ok(())
}
