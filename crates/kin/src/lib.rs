//! Kinematics of limbs, spine and collar: closed forms in `f64`, no files, clocks or randomness.
//!
//! Column vectors, right-handed frames, metres, radians. The mathematics and its sources are in
//! `docs/conventions.md` and `docs/sources.md`.

mod ball;
mod carrier;
mod elevation;
mod fk;
mod frame;
mod limb;
mod range;
mod reach;

pub use ball::{Ball, swing_twist};
pub use carrier::Carrier;
pub use elevation::{Arc, Elevations, RootRange};
pub use fk::{FkError, Link, fk};
pub use frame::Frame;
pub use limb::{
    Branch, Degenerate, HingeSolution, Limb, LimbGoal, LimbSolution, LimbState, Span, wrapped,
};
pub use range::{Cone, Interval};
pub use reach::{LimbRanges, Reach, softened};
