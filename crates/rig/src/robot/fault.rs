//! What keeps links and joints from being a robot.

use kin::Interval;

/// A fault among the links and joints of a robot.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[allow(missing_docs)]
pub enum RobotError {
    #[error("there are no links, expected at least one")]
    Empty,
    #[error("{kind} \"{name}\" is given twice")]
    Twice { kind: &'static str, name: String },
    #[error(
        "joint \"{joint}\": its {end} is link \"{link}\", which is not there, did you mean \"{nearest}\"?"
    )]
    UnknownLink { joint: String, end: &'static str, link: String, nearest: String },
    #[error(
        "link \"{link}\" is the child of joint \"{first}\" and of joint \"{second}\", expected one of them"
    )]
    TwoParents { link: String, first: String, second: String },
    #[error("link \"{link}\" carries itself, by way of joint \"{joint}\": {path}")]
    Cycle { link: String, joint: String, path: String },
    #[error("links \"{first}\" and \"{second}\" both hang on no joint, expected one root")]
    TwoRoots { first: String, second: String },
    #[error("joint \"{joint}\" has an axis of no length, expected a direction")]
    Axis { joint: String },
    #[error("joint \"{joint}\" has lower {} above upper {}", .range.min, .range.max)]
    Limit { joint: String, range: Interval },
    #[error("joint \"{joint}\" is {kind} and has no limits")]
    NoLimit { joint: String, kind: &'static str },
    #[error("{kind} \"{name}\" has a number that is not finite")]
    NotFinite { kind: &'static str, name: String },
    #[error("joint \"{joint}\" mimics joint \"{master}\", which is not there, did you mean \"{nearest}\"?")]
    UnknownMaster { joint: String, master: String, nearest: String },
    #[error("joint \"{joint}\" mimics itself: {path}")]
    MimicLoop { joint: String, path: String },
    #[error(
        "joint \"{joint}\" mimics joint \"{master}\", expected both to have one value: {joint} is {kind}, {master} is {master_kind}"
    )]
    MimicKind { joint: String, kind: &'static str, master: String, master_kind: &'static str },
}

impl RobotError {
    /// The joint or link that the fault is about: its tag in URDF and its name.
    pub fn subject(&self) -> Option<(&'static str, &str)> {
        use RobotError as E;
        match self {
            E::Empty => None,
            E::Twice { kind, name } | E::NotFinite { kind, name } => Some((kind, name)),
            E::TwoRoots { second: link, .. } => Some(("link", link)),
            E::UnknownLink { joint, .. }
            | E::TwoParents { second: joint, .. }
            | E::Cycle { joint, .. }
            | E::Axis { joint }
            | E::Limit { joint, .. }
            | E::NoLimit { joint, .. }
            | E::UnknownMaster { joint, .. }
            | E::MimicLoop { joint, .. }
            | E::MimicKind { joint, .. } => Some(("joint", joint)),
        }
    }
}
