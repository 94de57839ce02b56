//! What can be wrong with a chain, its values or a goal.

use super::Solver;

/// Why a chain, a value or a goal was refused.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ChainError {
    /// A node that does not exist was asked for.
    #[error("there is no node {node}: the chain has {nodes}")]
    NoNode {
        /// What was asked for.
        node: usize,
        /// How many nodes there are.
        nodes: usize,
    },
    /// A parent does not come before its child.
    #[error("node {node} is carried by {parent}, which does not come before it")]
    Parent {
        /// The faulty node.
        node: usize,
        /// The parent that it names.
        parent: usize,
    },
    /// A second node has no parent.
    #[error("node {node} has no parent, but node 0 is the root")]
    SecondRoot {
        /// The faulty node.
        node: usize,
    },
    /// The root can't be removed while it carries more than one node: each of them would be a root.
    #[error("the root carries {children} nodes, so it can't be removed: one could take its place, not more")]
    ManyRoots {
        /// How many nodes the root carries.
        children: usize,
    },
    /// A number is NaN or infinite.
    #[error("node {node}: its {what} is not finite")]
    NotFinite {
        /// The faulty node.
        node: usize,
        /// Which of its numbers.
        what: &'static str,
    },
    /// A number that does not belong to a node is NaN or infinite.
    #[error("the {what} is not finite")]
    BadNumber {
        /// Which number.
        what: &'static str,
    },
    /// An axis has no direction.
    #[error("node {node}: its {what} is zero, it should have a direction")]
    NoAxis {
        /// The faulty node.
        node: usize,
        /// Which of its axes.
        what: &'static str,
    },
    /// A quaternion without length.
    #[error("node {node}: its rotation is a quaternion of length zero")]
    NoRotation {
        /// The faulty node.
        node: usize,
    },
    /// A rotation among the values is not of unit length.
    #[error("node {node}: its rotation is a quaternion of length {length}, not 1")]
    NotUnit {
        /// The faulty node.
        node: usize,
        /// The quaternion's length; NaN if a part of it is.
        length: f64,
    },
    /// A range is NaN, or its lower end is above the upper.
    #[error("node {node}: the {what} from {min} to {max} is no range")]
    Range {
        /// The faulty node.
        node: usize,
        /// Which range.
        what: &'static str,
        /// Its lower end.
        min: f64,
        /// Its upper end.
        max: f64,
    },
    /// A range or a turn of another kind than the joint.
    #[error("node {node} is {joint}, it takes {wanted}")]
    Kind {
        /// The node.
        node: usize,
        /// What its joint is.
        joint: &'static str,
        /// What it takes.
        wanted: &'static str,
    },
    /// As many values as nodes are needed.
    #[error("{values} {what} for {nodes} nodes")]
    Count {
        /// What was counted.
        what: &'static str,
        /// How many came.
        values: usize,
        /// How many nodes there are.
        nodes: usize,
    },
    /// A length must be above zero.
    #[error("node {node}: a link's length must be above zero and finite, not {length} m")]
    Length {
        /// The node.
        node: usize,
        /// What was asked for, metres.
        length: f64,
    },
    /// A link without length has no direction to grow in.
    #[error("node {node} has its tip at its joint, so it has no direction to grow in")]
    NoDirection {
        /// The node.
        node: usize,
    },
    /// A tolerance must be above zero.
    #[error("the {what} must be above zero and finite, not {tolerance}")]
    Tolerance {
        /// Which tolerance.
        what: &'static str,
        /// What was asked for.
        tolerance: f64,
    },
    /// The solver knows positions only.
    #[error("{solver:?} solves for positions only: a goal with a rotation takes Best or DampedLeastSquares")]
    PositionsOnly {
        /// The solver that was asked for.
        solver: Solver,
    },
}
