//! What can be wrong with a URDF file.

use rig::{Bone, Dof, RobotError, SkeletonError};

use crate::Spot;

/// A fault of a URDF file and where it is.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[error("{spot}: {fault}")]
pub struct UrdfError {
    /// Where.
    pub spot: Spot,
    /// What.
    pub fault: UrdfFault,
}

/// A fault of a URDF file.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[allow(missing_docs)]
pub enum UrdfFault {
    #[error("{0}")]
    Syntax(String),
    #[error("the file has {0} bytes, more than the {max} that are read", max = super::MAX_BYTES)]
    TooLarge(usize),
    #[error("the file has {0} links, more than the {max} that are read", max = super::tree::MAX_LINKS)]
    TooMany(usize),
    #[error("{element} has no {missing}")]
    Missing { element: String, missing: String },
    #[error("{element}: {attribute}=\"{found}\", expected {expected}")]
    Value { element: String, attribute: String, found: String, expected: &'static str },
    #[error("{tag} \"{name}\" is given twice")]
    Twice { tag: &'static str, name: String },
    #[error(
        "joint \"{joint}\": its {end} is link \"{link}\", which the file lacks, did you mean \"{nearest}\"?"
    )]
    UnknownLink { joint: String, end: &'static str, link: String, nearest: String },
    #[error(
        "link \"{link}\" is the child of joint \"{first}\" and of joint \"{second}\", expected one of them"
    )]
    TwoParents { link: String, first: String, second: String },
    #[error("link \"{link}\" carries itself, by way of joint \"{joint}\"")]
    Cycle { link: String, joint: String },
    #[error(
        "bone \"{bone}\" has the role of link \"{link}\", which the file lacks, did you mean \"{nearest}\"?"
    )]
    NoLink { bone: Bone, link: String, nearest: String },
    #[error("link \"{link}\" has the role of \"{first}\" and of \"{second}\", expected one of them")]
    TwoRoles { link: String, first: Bone, second: Bone },
    #[error("bone \"{bone}\" (link \"{link}\") is not carried by the hips")]
    Adrift { bone: Bone, link: String },
    #[error("bone \"{bone}\" is carried by \"{carrier}\", which comes after it in the body")]
    Order { bone: Bone, carrier: Bone },
    #[error("joint \"{joint}\" of bone \"{bone}\" is {found}, expected {}", expected_type(*.bone))]
    Type { joint: String, bone: Bone, found: String },
    #[error(
        "joint \"{joint}\" does not say what it does, expected a name that ends in _flexion, _abduction or _twist, such as _{nearest}"
    )]
    Dof { joint: String, nearest: String },
    #[error("joint \"{joint}\": bone \"{bone}\" has {} already", .dof.name())]
    DofTwice { joint: String, bone: Bone, dof: Dof },
    #[error("joint \"{joint}\" has an axis of no length")]
    Axis { joint: String },
    #[error("joint \"{joint}\" has lower {lower} above upper {upper}")]
    Limit { joint: String, lower: f64, upper: f64 },
    #[error(
        "joint \"{joint}\" lies {distance_m} m beyond the first joint of bone \"{bone}\", expected the same place"
    )]
    Apart { joint: String, bone: Bone, distance_m: f64 },
    #[error(
        "joint \"{joint}\": the three joints of bone \"{bone}\" are not flexion, abduction, twist in that order"
    )]
    BallOrder { joint: String, bone: Bone },
    #[error("joint \"{joint}\": the three axes of bone \"{bone}\" are not at right angles")]
    Skew { joint: String, bone: Bone },
    #[error(transparent)]
    Skeleton(#[from] SkeletonError),
    #[error(transparent)]
    Robot(#[from] RobotError),
}

fn expected_type(bone: Bone) -> &'static str {
    if bone == Bone::Hips { "floating or fixed" } else { "revolute, continuous or fixed" }
}

impl UrdfFault {
    /// The fault at that place.
    pub(crate) fn at(self, spot: Spot) -> UrdfError {
        UrdfError { spot, fault: self }
    }

    /// The element that the fault is about: its tag and name.
    pub(crate) fn subject(&self) -> Option<(&'static str, &str)> {
        use UrdfFault as F;
        match self {
            F::UnknownLink { joint, .. }
            | F::Cycle { joint, .. }
            | F::TwoParents { second: joint, .. }
            | F::Type { joint, .. }
            | F::Dof { joint, .. }
            | F::DofTwice { joint, .. }
            | F::Axis { joint }
            | F::Limit { joint, .. }
            | F::Apart { joint, .. }
            | F::BallOrder { joint, .. }
            | F::Skew { joint, .. } => Some(("joint", joint)),
            F::TwoRoles { link, .. } | F::Adrift { link, .. } => Some(("link", link)),
            F::Order { bone, .. } => Some(("link", bone.name())),
            F::Robot(fault) => fault.subject(),
            F::Syntax(_)
            | F::TooLarge(_)
            | F::TooMany(_)
            | F::Missing { .. }
            | F::Value { .. }
            | F::Twice { .. }
            | F::NoLink { .. }
            | F::Skeleton(_) => None,
        }
    }

    /// The part of that element which the fault is about.
    pub(crate) fn part(&self) -> Option<&'static str> {
        use UrdfFault as F;
        match self {
            F::Axis { .. } | F::Robot(RobotError::Axis { .. }) => Some("axis"),
            F::Limit { .. } | F::Robot(RobotError::Limit { .. }) => Some("limit"),
            F::UnknownLink { end, .. } | F::Robot(RobotError::UnknownLink { end, .. }) => Some(end),
            F::TwoParents { .. } | F::Robot(RobotError::TwoParents { .. }) => Some("child"),
            F::Robot(
                RobotError::UnknownMaster { .. }
                | RobotError::MimicLoop { .. }
                | RobotError::MimicKind { .. },
            ) => Some("mimic"),
            _ => None,
        }
    }
}
