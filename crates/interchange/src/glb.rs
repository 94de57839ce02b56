//! Skins as binary glTF 2.0: a mesh, the joints that carry it their inverse binds, morph targets.

mod accessor;
mod container;
mod read;
mod targets;
mod write;

use rig::Bone;

pub use read::{read, read_with_targets};
pub use write::{write, write_with_targets};

/// The most vertices and triangle corners that are read.
pub const MAX_CORNERS: usize = 12_000_000;

/// Why bytes are not a skin for a skeleton.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
#[allow(missing_docs)]
pub enum GlbError {
    #[error("this is not a binary glTF file: {0}")]
    Container(String),
    #[error("the glTF in this file is broken: {0}")]
    Document(String),
    #[error("{what} lies outside the file's {len} bytes of data")]
    OutOfRange { what: String, len: usize },
    #[error("{what} is {found}, expected {expected}")]
    Unexpected { what: String, found: String, expected: &'static str },
    #[error("{what} is kept in another file or in a text, expected it within the binary part of this file")]
    External { what: String },
    #[error("{what} has {count} entries, more than the {MAX_CORNERS} that are read")]
    TooLarge { what: String, count: usize },
    #[error("{what} is not finite")]
    NotFinite { what: String },
    #[error("node {node} is its own ancestor, expected a tree")]
    Cycle { node: String },
    #[error("there is no triangle in this file, expected a skinned mesh")]
    Empty,
    #[error(
        "joint \"{name}\" is no bone of the figure and hangs on none, expected VRM names such as \"{nearest}\""
    )]
    UnknownJoint { name: String, nearest: String },
    #[error(
        "joint \"{bone}\" rests at ({}, {}, {}) m in the skin, expected ({}, {}, {}) m as in the skeleton",
        found[0], found[1], found[2], expected[0], expected[1], expected[2]
    )]
    Rest { bone: Bone, found: [f64; 3], expected: [f64; 3] },
}
