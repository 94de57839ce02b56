//! The chain file, `*.chain.ron`: a chain or a robot with how it stands, small enough to write by hand.
//!
//! ```ron
//! (
//!     version: 1,
//!     name: "lamp",
//!     nodes: {
//!         "lower": (length: 0.4, range: (-60, 60), value: 20),
//!         "upper": (length: 0.35, range: (0, 150)),
//!         "shade": (parent: "upper", joint: Ball, length: 0.1, color: (0.9, 0.7, 0.1)),
//!     },
//! )
//! ```
//!
//! Lengths are metres and angles degrees. The root link has x ahead and z up, as robots have; a hinge turns about y unless it says
//! otherwise, so a chain lies in the plane of x and z. Instead of nodes a file may name a `urdf`.

mod file;
mod read;
mod write;

use kin::Frame;
use rig::{Robot, RobotPose, RootMoves};

use crate::Spot;

pub use read::read;
pub use write::write;

/// The version of chain files that is written.
pub const CHAIN_VERSION: u32 = 1;

/// A chain, how it stands and how it is worked with.
#[derive(Clone, PartialEq, Debug)]
pub struct ChainFile {
    /// Its links and joints. Meshes are named and not read: [`Robot::fill_meshes`] brings them.
    pub robot: Robot,
    /// Its joints' values; 0 where the file says nothing.
    pub pose: RobotPose,
    /// Where its root is.
    pub world_from_root: Frame,
    /// How its root may be moved.
    pub root: RootMoves,
    /// Whether it moves in one plane, which a flat view from the side shows.
    pub planar: bool,
    /// The URDF file that the links are of, as the chain file names it; `None` where it has nodes of its own.
    pub urdf: Option<String>,
}

impl ChainFile {
    /// A robot at rest that stands free at the world's origin, its links written as nodes.
    pub fn of(robot: Robot) -> ChainFile {
        ChainFile {
            pose: robot.rest(),
            robot,
            world_from_root: Robot::WORLD_FROM_ROOT,
            root: RootMoves::Free,
            planar: false,
            urdf: None,
        }
    }
}

/// A fault in a chain file or in the URDF file that it names.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct ChainFileError {
    /// The file at fault as the chain file names it; empty for the chain file itself.
    pub file: String,
    /// Where.
    pub spot: Spot,
    /// What is wrong and what was expected.
    pub message: String,
}

impl ChainFileError {
    /// The error with the chain file's own name, or beside it for a file that it names.
    #[must_use]
    pub fn named(mut self, chain_file: &str) -> ChainFileError {
        let folder = chain_file.rfind(['/', '\\']).map_or("", |i| &chain_file[..=i]);
        self.file = match self.file {
            file if file.is_empty() => chain_file.to_owned(),
            file => format!("{folder}{file}"),
        };
        self
    }
}

impl std::fmt::Display for ChainFileError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let colon = if self.file.is_empty() { "" } else { ":" };
        write!(f, "{}{colon}{}: {}", self.file, self.spot, self.message)
    }
}

impl std::error::Error for ChainFileError {}
