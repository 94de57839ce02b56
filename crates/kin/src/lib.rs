//! Kinematics of limbs, spine, collar and chains: closed forms in `f64`, no files, clocks or randomness.
//!
//! Column vectors, right-handed frames, metres, radians. The mathematics and its sources are in
//! `docs/conventions.md` and `docs/sources.md`.

mod aim;
mod arc_tangent;
mod axis_angle;
mod ball;
mod bounded_step;
mod carrier;
pub mod chain;
mod collar;
mod elevation;
mod eye;
mod fk;
mod frame;
mod gaze;
mod limb;
mod nearest;
mod range;
mod reach;
mod settle;
mod spine;

pub use aim::{AIM_STEPS, AIM_TOLERANCE_RAD, AimError};
pub use arc_tangent::arc_tangent;
pub use axis_angle::axis_angle;
pub use ball::{Ball, swing_twist, twist_about};
pub use carrier::Carrier;
pub use collar::{CollarTurn, Rhythm, collar_turn};
pub use elevation::{Arc, Elevations, RootRange};
pub use eye::Eye;
pub use fk::{FkError, Link, fk};
pub use frame::Frame;
pub use gaze::{Gaze, GazeSolution, GazeState};
pub use limb::{Branch, Degenerate, HingeSolution, Limb, LimbGoal, LimbSolution, LimbState, Span, wrapped};
pub use range::{Cone, Interval};
pub use reach::{LimbRanges, Reach, softened};
pub use spine::{Bend, Column, ColumnSolution, ColumnState};
