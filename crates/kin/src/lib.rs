//! Kinematics of limbs, spine and collar: closed forms in `f64`, no files, clocks or randomness.
//!
//! Column vectors, right-handed frames, metres, radians. The mathematics and its sources are in
//! `docs/conventions.md` and `docs/sources.md`.

mod ball;
mod fk;
mod frame;
mod range;

pub use ball::{Ball, swing_twist};
pub use fk::{FkError, Link, fk};
pub use frame::Frame;
pub use range::{Cone, Interval};
