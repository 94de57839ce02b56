//! Feet on uneven ground: a blend tree's last node.

use glam::DVec3;
use serde::{Deserialize, Serialize};

/// How feet are placed.
#[derive(Clone, Copy, PartialEq, Debug, Default, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PlacementSettings {}

/// What the placement remembers from step to step.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct FeetState {}

/// A foot as it was placed.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct FootView {
    /// Whether the whole sole stands on the ground and bears weight.
    pub stance: bool,
    /// Points of the sole, metres, world: heel, ball and toes, outer and inner edge.
    pub sole_in_world: Vec<DVec3>,
    /// The ground's height under each, metres.
    pub ground_under_sole: Vec<f64>,
    /// The ankle's joint as the motion on flat ground has it, metres, world.
    pub animated_ankle_in_world: DVec3,
    /// Where it was placed, metres, world.
    pub ankle_in_world: DVec3,
}
