//! What to reach with a chain, how, and what came of it.

use glam::{DQuat, DVec3};

use super::{Chain, ChainError, Value, unit_rotation};
use crate::Frame;

/// Where a point of one node should go.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Goal {
    /// The node that carries the point. Only joints on the way from the root to it move.
    pub node: usize,
    /// The point in the node's frame, metres.
    pub point: DVec3,
    /// Where it should go in the world, metres.
    pub target: DVec3,
    /// How the node should be turned in the world, `world_from_node`; `None` if it may be turned any way.
    pub rotation: Option<DQuat>,
    /// What the root does.
    pub root: Root,
}

/// What a chain's root does while a point is dragged.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Root {
    /// It stays, and the point may turn out to be out of reach.
    #[default]
    Held,
    /// It is drawn along, as a rope is or a snake: each link follows the one ahead of it no further than it
    /// must. The point always gets there.
    Follows,
}

/// How to find the values.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Solver {
    /// A closed form where there is one, else damped least squares, with other starts if the first leads nowhere.
    #[default]
    Best,
    /// Two links, or one bend shared by all joints of a straight chain. Where neither fits, it returns the start.
    ClosedForm,
    /// Cyclic coordinate descent: joint by joint from the tip, each brings the point as near to the target as it
    /// can. Positions only.
    Ccd,
    /// Forward and backward reaching: the joints' places are dragged to the target and back, then each joint
    /// aims at them. Positions only.
    Fabrik,
    /// Damped least squares, all joints at once: the smallest change that does it.
    DampedLeastSquares,
}

/// Solver, tolerance and cap.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Options<'a> {
    /// How to find the values.
    pub solver: Solver,
    /// How far off the point may be, metres, above zero.
    pub tolerance_m: f64,
    /// How far off the rotation may be if the goal has one, radians, above zero.
    pub tolerance_rad: f64,
    /// How many sweeps and steps the search may take in all, other starts included.
    pub cap: usize,
    /// Which nodes keep their value, one flag a node; empty if none does.
    pub held: &'a [bool],
}

/// What a solver found.
#[derive(Clone, PartialEq, Debug)]
pub struct Solved {
    /// A value for each node, each in its range or no further out than it was.
    pub values: Vec<Value>,
    /// Where the chain stands then; as before, unless the root follows.
    pub world_from_root: Frame,
    /// Whether the residuals are within the tolerances.
    pub reached: bool,
    /// How far the point is from its target, metres; NaN only if the numbers overflow.
    pub residual_m: f64,
    /// How far the node is from the rotation asked for, radians; 0 without one.
    pub residual_rad: f64,
    /// Sweeps and steps taken, other starts included; a closed form counts one, a goal that is met already none.
    pub iterations: usize,
    /// How many other starts were tried after the given one had led nowhere.
    pub restarts: usize,
}

impl Goal {
    /// The tip of a node's link to a place in the world, the root held.
    ///
    /// # Errors
    /// No such node.
    pub fn tip(chain: &Chain, node: usize, target: DVec3) -> Result<Goal, ChainError> {
        Ok(Goal { node, point: chain.node(node)?.tip, target, rotation: None, root: Root::Held })
    }

    /// The goal with its rotation at unit length, or what is wrong with it.
    pub(super) fn sound(mut self) -> Result<Goal, ChainError> {
        let finite = [(self.point, "point of the goal"), (self.target, "target")];
        for (place, what) in finite {
            if !place.is_finite() {
                return Err(ChainError::BadNumber { what });
            }
        }
        if let Some(rotation) = self.rotation {
            let what = "rotation of the goal";
            self.rotation = Some(unit_rotation(rotation).ok_or(ChainError::BadNumber { what })?);
        }
        Ok(self)
    }
}

impl Options<'static> {
    /// The best solver to a ten-thousandth of the chain's length and a milliradian, with at most 1,000 steps,
    /// nothing held.
    pub fn of(chain: &Chain) -> Options<'static> {
        let tolerance_m = (1e-4 * chain.length()).clamp(f64::MIN_POSITIVE, f64::MAX);
        Options { solver: Solver::Best, tolerance_m, tolerance_rad: 1e-3, cap: 1000, held: &[] }
    }
}

impl Options<'_> {
    /// What is wrong with the options for that many nodes.
    pub(super) fn check(&self, nodes: usize) -> Result<(), ChainError> {
        for (tolerance, what) in
            [(self.tolerance_m, "tolerance in metres"), (self.tolerance_rad, "tolerance in radians")]
        {
            if !(tolerance > 0.0 && tolerance.is_finite()) {
                return Err(ChainError::Tolerance { what, tolerance });
            }
        }
        if !(self.held.is_empty() || self.held.len() == nodes) {
            return Err(ChainError::Count { what: "flags", values: self.held.len(), nodes });
        }
        Ok(())
    }

    /// Whether a node may not move.
    pub(super) fn holds(&self, node: usize) -> bool {
        self.held.get(node).copied().unwrap_or(false)
    }
}
