//! URDF, the robot description format: read as a robot or as the skeleton of a figure, and written.

mod check;
mod document;
mod fault;
mod figure;
mod outline;
mod robot;
mod skeleton;
mod tree;
mod write;

use std::collections::BTreeMap;

use rig::{Bone, Robot, Skeleton};

use document::Document;
pub use fault::{UrdfError, UrdfFault};
pub use figure::figure_robot;
use tree::Tree;
pub use write::write_robot;

/// The largest file that is read, bytes.
pub const MAX_BYTES: usize = 8 << 20;

/// Reads a skeleton. `roles` names the link of a bone where it isn't called like the bone.
///
/// Also returns warnings, each naming what it is about: links that are no bones (a leaf's mass joins the
/// bone that carries it).
///
/// # Errors
/// Anything that keeps the file from being a skeleton: [`UrdfFault`] says what, with line and column.
pub fn read(text: &str, roles: &BTreeMap<Bone, String>) -> Result<(Skeleton, Vec<String>), UrdfError> {
    let document = Document::read(text)?;
    let tree = Tree::new(&document.robot, roles).map_err(|fault| document.locate(fault))?;
    let joints = skeleton::joints(&tree).map_err(|fault| document.locate(fault))?;
    let skeleton = Skeleton::new(joints).map_err(|e| document.locate(UrdfFault::Skeleton(e)))?;
    Ok((skeleton, tree.warnings()))
}

/// Reads a robot: every link and joint with limits, masses and looks. Meshes of other files are named and not read:
/// [`Robot::fill_meshes`] brings them, with [`solid::read`](crate::solid::read) for their bytes.
///
/// Also returns warnings: what is odd but does no harm, each naming what it is about.
///
/// # Errors
/// Anything that keeps the file from being a robot: [`UrdfFault`] says what, with line and column.
pub fn read_robot(text: &str) -> Result<(Robot, Vec<String>), UrdfError> {
    // Some programs write the NUL that ends their text in memory.
    let whole = text.trim_end_matches('\0');
    let document = Document::read(whole)?;
    let mut warnings = Vec::new();
    if whole.len() < text.len() {
        warnings.push("the file ends with a NUL, which is left out".to_owned());
    }
    let robot = robot::robot(&document, &mut warnings)?;
    Ok((robot, warnings))
}
