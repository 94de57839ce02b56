//! Robots from their files, with the meshes that those name.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use interchange::chain_file::ChainFile;
use rig::{Robot, Solid};

use super::Kind;
use crate::disk::{MODEL_LIMIT, read_bytes, read_text};
use crate::failure::Failure;
use crate::library::chains;
use crate::library::shipped::PREFIX;

/// How many folders above a robot's own are searched for its meshes.
const LEVELS: usize = 6;

/// Reads a `*.urdf` file and the meshes that it names.
///
/// Also returns warnings: what is odd but does no harm, such as meshes that could not be had and have stand-ins.
///
/// # Errors
/// A file at fault: where and why.
pub fn robot(path: &Path) -> Result<(Robot, Vec<String>), Failure> {
    let (mut robot, mut warnings) = interchange::urdf::read_robot(&text_of(path)?)
        .map_err(|e| Failure::Input(format!("{}:{e}", path.display())))?;
    warnings.extend(fill(&mut robot, path));
    Ok((robot, warnings))
}

/// Reads a `*.chain.ron` file, the URDF file and the meshes that it names; a `*.urdf` file is a chain that stands free at the
/// world's origin, and is kept as that file's.
///
/// Also returns warnings, as [`robot`] does.
///
/// # Errors
/// A file at fault: where and why; one that is neither.
pub fn chain(path: &Path) -> Result<(ChainFile, Vec<String>), Failure> {
    match Kind::of(path)? {
        Kind::Chain => {}
        Kind::Urdf => {
            let (robot, warnings) = robot(path)?;
            let urdf = path.file_name().map(|name| name.to_string_lossy().into_owned());
            return Ok((ChainFile { urdf, ..ChainFile::of(robot) }, warnings));
        }
        _ => {
            let message = "this shows no chain; give a .chain.ron or .urdf file";
            return Err(Failure::Input(format!("{}: {message}", path.display())));
        }
    }
    let (mut chain, mut warnings) =
        interchange::chain_file::read(&text_of(path)?, &mut |name| near(path, name))
            .map_err(|e| Failure::Input(e.named(&path.display().to_string()).to_string()))?;
    // Meshes are named from the file that names them.
    let shipped = chains::is_shipped(&path.to_string_lossy());
    let named = chain.urdf.as_ref().filter(|_| !shipped).map(|urdf| match chains::is_shipped(urdf) {
        true => PathBuf::from(urdf),
        false => path.with_file_name(urdf),
    });
    warnings.extend(fill(&mut chain.robot, named.as_deref().unwrap_or(path)));
    Ok((chain, warnings))
}

/// The text of a file, which may be a shipped one.
fn text_of(path: &Path) -> Result<String, Failure> {
    match chains::bytes(&path.to_string_lossy()) {
        Some(found) => found.map(|bytes| String::from_utf8_lossy(bytes).into_owned()).map_err(Failure::Input),
        None => read_text(path),
    }
}

/// The bytes of a file that another one names from its folder.
fn near(path: &Path, name: &str) -> Result<Vec<u8>, String> {
    if chains::is_shipped(name) {
        return shipped(name);
    }
    match chains::bytes(&path.to_string_lossy()) {
        Some(_) => shipped(name),
        None => super::beside(path)(name),
    }
}

/// The bytes of a shipped file by its name among them, with `library:` before it or without.
fn shipped(name: &str) -> Result<Vec<u8>, String> {
    let bare = name.strip_prefix(PREFIX).unwrap_or(name);
    chains::bytes(&format!("{PREFIX}{bare}"))
        .unwrap_or_else(|| Err(format!("{name}: no shipped file")))
        .map(<[u8]>::to_vec)
}

/// Gives a robot the meshes that its file names; what could not be had is returned.
fn fill(robot: &mut Robot, path: &Path) -> Vec<String> {
    if chains::is_shipped(&path.to_string_lossy()) {
        return robot.fill_meshes(&mut |file| {
            interchange::solid::read(file, &shipped(file)?, &mut |name| shipped(name)).map(Arc::new)
        });
    }
    let folder = path.parent().map(Path::to_owned).unwrap_or_default();
    robot.fill_meshes(&mut |file| mesh(&folder, file).map(Arc::new))
}

fn mesh(folder: &Path, file: &str) -> Result<Solid, String> {
    if chains::is_shipped(file) {
        return interchange::solid::read(file, &shipped(file)?, &mut |name| shipped(name));
    }
    let found = candidates(folder, file).into_iter().find(|p| p.is_file());
    let path = found.ok_or_else(|| "there is no such file".to_owned())?;
    let bytes = read_bytes(&path, MODEL_LIMIT).map_err(|e| e.to_string())?;
    let beside = path.parent().map(Path::to_owned).unwrap_or_default();
    interchange::solid::read(file, &bytes, &mut |name| {
        read_bytes(&beside.join(name), MODEL_LIMIT).map_err(|e| e.to_string())
    })
}

/// Where a mesh may be. `package://NAME/REST` is NAME/REST or REST in the robot's folder or one above; so is what stands after
/// the `..` of other names, since robots are often copied without the folders around them.
fn candidates(folder: &Path, file: &str) -> Vec<PathBuf> {
    let file = file.strip_prefix("file://").unwrap_or(file);
    let mut names = Vec::new();
    match file.strip_prefix("package://").or_else(|| file.strip_prefix("model://")) {
        Some(name) => {
            names.push(name);
            names.extend(name.split_once('/').map(|(_, rest)| rest));
        }
        None => {
            names.push(file);
            names.push(file.trim_start_matches("../").trim_start_matches("./"));
        }
    }
    let whole = std::path::absolute(folder).unwrap_or_else(|_| folder.to_owned());
    let levels = whole.ancestors().take(LEVELS);
    levels.flat_map(|level| names.iter().map(|name| level.join(name)).collect::<Vec<_>>()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packages_are_looked_for_beside_and_above() {
        let found = candidates(Path::new("/robots/arm/urdf"), "package://arm/meshes/a.stl");
        for expected in
            ["/robots/arm/urdf/meshes/a.stl", "/robots/arm/meshes/a.stl", "/robots/arm/meshes/a.stl"]
        {
            assert!(found.contains(&PathBuf::from(expected)), "{expected}: {found:?}");
        }
        assert_eq!(
            candidates(Path::new("/robots"), "../meshes/b.stl")[..2],
            [PathBuf::from("/robots/../meshes/b.stl"), PathBuf::from("/robots/meshes/b.stl")]
        );
        assert_eq!(candidates(Path::new("/robots"), "/meshes/c.stl")[0], Path::new("/meshes/c.stl"));
    }
}
