//! Why a gesture can't be made.

use crate::{Bone, Dof, Limb};

/// A gesture that has no answer; nothing is changed.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
#[allow(missing_docs)]
pub enum GestureError {
    #[error("the figure has no \"{0}\"")]
    NoBone(Bone),
    #[error("\"{bone}\" has no {dof}: it has {has}", dof = dof.name(), has = list(has))]
    NoDof { bone: Bone, dof: Dof, has: Vec<Dof> },
    #[error("{what} is not a finite number")]
    NotFinite { what: &'static str },
    #[error("{}: {why}", limb.name())]
    Degenerate { limb: Limb, why: kin::Degenerate },
    #[error("the figure's {} lacks a joint that reaching needs", .0.name())]
    NoLimb(Limb),
    #[error("contacts go round in a circle: {}; let one of them go first", circle(.0))]
    Cycle(Vec<Limb>),
    #[error("{}: the other bend of the hinge is {degrees:.1} degrees, outside its range", limb.name())]
    NoFlip { limb: Limb, degrees: f64 },
    #[error("{}: no articulator \"{name}\"; there are {known}", limb.name())]
    NoArticulator { limb: Limb, name: String, known: String },
    #[error("{}: \"{bone}\" can't reach: a point must be on the lower segment, the end, or its fingers or toes", limb.name())]
    NotOnLimb { limb: Limb, bone: Bone },
    #[error("{}: turning in contact takes {allowed}", limb.name())]
    NotInContact { limb: Limb, allowed: &'static str },
    #[error("no handshape \"{name}\"; there are {known}")]
    NoHandshape { name: String, known: String },
    #[error("balance needs a foot in contact with the ground or another still thing: keep one first")]
    NoSupport,
    #[error("\"{0}\" is locked: unlock it first")]
    Locked(Bone),
    #[error("the point to aim at is at the joint that aims")]
    NoDirection,
}

fn list(dofs: &[Dof]) -> String {
    if dofs.is_empty() {
        return "no degree of freedom".to_owned();
    }
    dofs.iter().map(|d| d.name()).collect::<Vec<_>>().join(", ")
}

fn circle(limbs: &[Limb]) -> String {
    limbs.iter().chain(limbs.first()).map(|l| l.name()).collect::<Vec<_>>().join(" -> ")
}
