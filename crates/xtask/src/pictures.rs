//! `cargo xtask pictures`: makes the pictures of the README and the guide anew, with the program itself.

pub mod contact_sheet;
pub mod shots;

use std::process::Command;

use anyhow::{Context, Result, ensure};

use crate::stages::cargo;
use contact_sheet::SHEETS;
use shots::{FOLDER, TABLE};

/// Builds the program and writes the pictures of these names, with or without their ending, or every one if none is named.
///
/// # Errors
/// The build or a rendering fails; a picture can't be written; a name that no picture has.
pub fn run(names: &[String]) -> Result<()> {
    let known = TABLE.iter().map(|picture| picture.name).chain(SHEETS.iter().map(|sheet| sheet.name));
    for name in names {
        ensure!(known.clone().any(|other| is(other, name)), "no picture is called {name}");
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
    for name in known.filter(|name| names.is_empty() || names.iter().any(|asked| is(name, asked))) {
        let sheet = SHEETS.iter().find(|sheet| sheet.name == name).map(|sheet| sheet.make(&program, &root));
        let picture = TABLE.iter().find(|picture| picture.name == name);
        let made = sheet.or_else(|| picture.map(|picture| picture.make(&program, &root)));
        let bytes = shots::png(&shots::rounded(made.context("a picture that none makes")??))?;
        total += bytes.len();
        println!("{name:14} {:5} kB", bytes.len() / 1000);
        let path = root.join(FOLDER).join(name);
        std::fs::write(&path, bytes).with_context(|| format!("writing {}", path.display()))?;
    }
    println!("{} kB in {FOLDER}", total / 1000);
    Ok(())
}

/// Whether a picture is meant by a name.
fn is(picture: &str, asked: &str) -> bool {
    picture == asked || picture.strip_suffix(".png") == Some(asked)
}
