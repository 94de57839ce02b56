//! Every way to change a chain, as data: window, scripts and tests use the same commands.

use glam::{DQuat, DVec3};
use kin::chain::{Root, Solver};
use rig::DofPart;
use serde::{Deserialize, Serialize};

use crate::By;

/// Where a reach goes.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub enum ChainGoal {
    /// A point of the world, metres.
    World(DVec3),
    /// A point in the frame of another link, metres.
    Link(String, DVec3),
    /// From where the point is, metres, world axes.
    Offset(DVec3),
    /// Where the point is: nothing moves.
    Here,
}

/// How to find what reaches.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub enum ChainSolver {
    /// A closed form where there is one, else damped least squares.
    #[default]
    Best,
    /// Two links, or one bend for all; nothing where neither fits.
    ClosedForm,
    /// Joint by joint from the tip.
    Ccd,
    /// Forward and backward reaching.
    Fabrik,
    /// All joints at once, as little as will do.
    DampedLeastSquares,
}

impl ChainSolver {
    /// All, the usual one first.
    pub const ALL: [ChainSolver; 5] = [
        ChainSolver::Best,
        ChainSolver::ClosedForm,
        ChainSolver::Ccd,
        ChainSolver::Fabrik,
        ChainSolver::DampedLeastSquares,
    ];

    /// The name for people.
    pub const fn label(self) -> &'static str {
        match self {
            ChainSolver::Best => "Best",
            ChainSolver::ClosedForm => "Closed form",
            ChainSolver::Ccd => "CCD",
            ChainSolver::Fabrik => "FABRIK",
            ChainSolver::DampedLeastSquares => "Damped least squares",
        }
    }
}

impl From<ChainSolver> for Solver {
    fn from(solver: ChainSolver) -> Solver {
        match solver {
            ChainSolver::Best => Solver::Best,
            ChainSolver::ClosedForm => Solver::ClosedForm,
            ChainSolver::Ccd => Solver::Ccd,
            ChainSolver::Fabrik => Solver::Fabrik,
            ChainSolver::DampedLeastSquares => Solver::DampedLeastSquares,
        }
    }
}

/// What the root does while a point is brought somewhere.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub enum ChainRoot {
    /// It stays, and so does a base that slides on it.
    #[default]
    Held,
    /// It is drawn along, as a snake's tail; a base slides.
    Follows,
}

impl From<ChainRoot> for Root {
    fn from(root: ChainRoot) -> Root {
        match root {
            ChainRoot::Held => Root::Held,
            ChainRoot::Follows => Root::Follows,
        }
    }
}

/// Which value of a joint with several a turn or a slide changes.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[allow(missing_docs)]
pub enum ChainPart {
    Turn,
    Slide,
    X,
    Y,
    Z,
    Roll,
    Pitch,
    Yaw,
}

impl From<ChainPart> for DofPart {
    fn from(part: ChainPart) -> DofPart {
        match part {
            ChainPart::Turn => DofPart::Turn,
            ChainPart::Slide => DofPart::Slide,
            ChainPart::X => DofPart::X,
            ChainPart::Y => DofPart::Y,
            ChainPart::Z => DofPart::Z,
            ChainPart::Roll => DofPart::Roll,
            ChainPart::Pitch => DofPart::Pitch,
            ChainPart::Yaw => DofPart::Yaw,
        }
    }
}

impl From<DofPart> for ChainPart {
    fn from(part: DofPart) -> ChainPart {
        match part {
            DofPart::Turn => ChainPart::Turn,
            DofPart::Slide => ChainPart::Slide,
            DofPart::X => ChainPart::X,
            DofPart::Y => ChainPart::Y,
            DofPart::Z => ChainPart::Z,
            DofPart::Roll => ChainPart::Roll,
            DofPart::Pitch => ChainPart::Pitch,
            DofPart::Yaw => ChainPart::Yaw,
        }
    }
}

/// A change of a chain.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[allow(missing_docs)]
pub enum ChainCommand {
    /// Turns a joint; all beyond it follows. `part` is for joints that turn in several ways.
    Turn {
        joint: String,
        degrees: f64,
        by: By,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        part: Option<ChainPart>,
    },
    /// Slides a joint; all beyond it follows. `part` is for joints that slide in several ways.
    Slide {
        joint: String,
        metres: f64,
        by: By,
        #[serde(default, skip_serializing_if = "Option::is_none")]
        part: Option<ChainPart>,
    },
    /// Brings a point of a link, its end unless told otherwise, to a goal.
    Reach {
        link: String,
        to: ChainGoal,
        /// In the link's frame, metres.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        point: Option<DVec3>,
        /// How the link is to be turned in the world: x, y, z, w.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        rotation: Option<DQuat>,
        #[serde(default)]
        solver: ChainSolver,
        #[serde(default)]
        root: ChainRoot,
    },
    /// Adds a link at the end of another, on a joint of the same name that turns between two angles, degrees. The axis is that of
    /// the other link's joint unless told otherwise.
    Append {
        to: String,
        name: String,
        length: f64,
        #[serde(default = "half_turns")]
        range: (f64, f64),
        #[serde(default, skip_serializing_if = "Option::is_none")]
        axis: Option<DVec3>,
    },
    /// Takes a link out; what it carries joins on.
    Remove { link: String },
    /// Makes a link as long as that.
    SetLength { link: String, metres: f64 },
    /// Sets how far a joint goes: degrees, or metres if it slides.
    SetRange { joint: String, to: (f64, f64) },
    /// Shifts and turns the whole chain; the turn is about the vertical through its root, degrees.
    Place {
        #[serde(default)]
        by: DVec3,
        #[serde(default)]
        turn: f64,
    },
    /// Returns joints to 0, or as near as their ranges let them; no joints: all.
    Reset {
        #[serde(default)]
        joints: Vec<String>,
    },
    /// Switches the ranges of joints.
    Ranges { on: bool },
}

fn half_turns() -> (f64, f64) {
    (-180.0, 180.0)
}

impl ChainCommand {
    /// A short name for the history and for faults.
    pub fn name(&self) -> &'static str {
        match self {
            ChainCommand::Turn { .. } => "Turn",
            ChainCommand::Slide { .. } => "Slide",
            ChainCommand::Reach { .. } => "Reach",
            ChainCommand::Append { .. } => "Append",
            ChainCommand::Remove { .. } => "Remove",
            ChainCommand::SetLength { .. } => "Set length",
            ChainCommand::SetRange { .. } => "Set range",
            ChainCommand::Place { .. } => "Place",
            ChainCommand::Reset { .. } => "Reset",
            ChainCommand::Ranges { .. } => "Ranges",
        }
    }

    /// The command as a script would write it.
    pub fn text(&self) -> String {
        ron::to_string(self).unwrap_or_default()
    }
}
