//! Chains of any length: a root and the nodes it carries, in a line or a tree, each link on a joint of its own.
//!
//! The structure ([`Chain`]) and the pose (one [`Value`] a node) are apart: the values are the only state, and
//! frames, places and residuals follow from them. A node's frame is `parent_from_node = origin * joint(value)`;
//! its link runs from that frame's origin to its [`Node::tip`]. Lengths are metres, angles radians.
//!
//! Forward kinematics is [`Chain::frames`] and [`Chain::place`]; [`Chain::turn`] moves one joint as far as
//! its range lets it and so carries every descendant.
//! [`Chain::solve`] goes the other way: a [`Goal`] for a point of any node, and a [`Solver`].
//!
//! What does not fit is a [`ChainError`] that names the node; what can't be reached is an answer with its residual.
//! Places are good to the rounding: the tip of a thousand links to 1e-13 of the length. A search stops at its tolerance.
//! Sources are named by the files of the solvers.
//!
//! ```
//! use glam::DVec3;
//! use kin::{Frame, Interval, chain::{Chain, Goal, Joint, Node, Options, Value}};
//! let hinge = Joint::Revolute { axis: DVec3::Z, range: Interval::new(-2.0, 2.0) };
//! let mut chain = Chain::default();
//! for parent in [None, Some(0), Some(1)] {
//!     chain.append(Node::link(parent, hinge, DVec3::X))?;
//! }
//! let mut values = chain.rest();
//! chain.turn(&mut values, 1, Value::Amount(5.0))?;
//! assert_eq!(values[1], Value::Amount(2.0));
//! let goal = Goal::tip(&chain, 2, DVec3::new(1.0, 2.0, 0.0))?;
//! let solved = chain.solve(&values, Frame::IDENTITY, &goal, &Options::of(&chain))?;
//! assert!(solved.reached);
//! let ends = chain.place(&values, Frame::IDENTITY)?;
//! assert!(ends[2].joint.abs_diff_eq(DVec3::new(1.0 + 2f64.cos(), 2f64.sin(), 0.0), 1e-15));
//! # Ok::<(), kin::chain::ChainError>(())
//! ```

mod bend;
mod ccd;
mod edit;
mod error;
mod fabrik;
mod follow;
mod forward;
mod goal;
mod joint;
mod least_squares;
mod linkage;
mod restart;
mod solve;
mod two_links;

pub use error::ChainError;
pub use forward::Place;
pub use goal::{Goal, Options, Root, Solved, Solver};
pub use joint::{BallRange, Joint, Value};

use glam::{DQuat, DVec3};

use crate::Frame;

/// A joint and the rigid link behind it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Node {
    /// Index of the node that carries this one, which comes before it; `None` for the root, node 0, alone.
    pub parent: Option<usize>,
    /// `parent_from_joint` at value zero; for the root, in the frame that the chain stands in.
    pub origin: Frame,
    /// How the node moves from there.
    pub joint: Joint,
    /// The link's end in the node's frame, metres; a node that is appended joins there.
    pub tip: DVec3,
}

impl Node {
    /// A node whose link runs to `tip`. Its origin is left for [`Chain::append`] to set.
    pub const fn link(parent: Option<usize>, joint: Joint, tip: DVec3) -> Node {
        Node { parent, origin: Frame::IDENTITY, joint, tip }
    }

    /// The link's length, metres.
    pub fn length(&self) -> f64 {
        self.tip.length()
    }
}

/// Nodes in an order in which parents come first; a line or a tree with one root, or nothing at all.
///
/// What can be built is sound: parents come before their children, axes and rotations are of unit length, every
/// number is finite (ends of ranges may be infinite), and no range is empty.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Chain {
    nodes: Vec<Node>,
}

/// A node and its neighbours.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Selected {
    /// The node asked for.
    pub node: usize,
    /// What carries it; `None` for the root.
    pub parent: Option<usize>,
    /// What it carries, in order.
    pub children: Vec<usize>,
}

impl Chain {
    /// A chain of those nodes, with their origins as they are. Axes and rotations are normalised.
    ///
    /// # Errors
    /// A parent that does not come first, a second root, an axis or rotation without length or direction, a
    /// number that is not finite, a range that is empty or not a number; each with the node's index.
    pub fn new(nodes: Vec<Node>) -> Result<Chain, ChainError> {
        let mut chain = Chain { nodes: Vec::with_capacity(nodes.len()) };
        for node in nodes {
            chain.push(node)?;
        }
        Ok(chain)
    }

    /// Adds a node as it is, if it is sound.
    fn push(&mut self, node: Node) -> Result<usize, ChainError> {
        let index = self.nodes.len();
        match node.parent {
            None if index > 0 => return Err(ChainError::SecondRoot { node: index }),
            Some(parent) if parent >= index => return Err(ChainError::Parent { node: index, parent }),
            _ => {}
        }
        self.nodes.push(node.sound(index)?);
        Ok(index)
    }

    /// All nodes, parents first.
    pub fn nodes(&self) -> &[Node] {
        &self.nodes
    }

    /// How many nodes there are.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether there is no node.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// One node.
    ///
    /// # Errors
    /// There is no such node.
    pub fn node(&self, node: usize) -> Result<&Node, ChainError> {
        self.nodes.get(node).ok_or(ChainError::NoNode { node, nodes: self.nodes.len() })
    }

    /// A node with its parent and children.
    ///
    /// # Errors
    /// There is no such node.
    pub fn select(&self, node: usize) -> Result<Selected, ChainError> {
        let parent = self.node(node)?.parent;
        Ok(Selected { node, parent, children: self.children(node).collect() })
    }

    /// The nodes that a node carries directly, in order; none for an index without node.
    pub fn children(&self, node: usize) -> impl Iterator<Item = usize> + '_ {
        (0..self.nodes.len()).filter(move |&i| self.nodes[i].parent == Some(node))
    }

    /// The nodes from the root to this one, both included.
    ///
    /// # Errors
    /// There is no such node.
    pub fn path(&self, node: usize) -> Result<Vec<usize>, ChainError> {
        let mut at = self.node(node)?.parent;
        let mut path = Vec::with_capacity(node + 1);
        path.push(node);
        while let Some(parent) = at {
            path.push(parent);
            at = self.nodes[parent].parent;
        }
        path.reverse();
        Ok(path)
    }

    /// The length of the chain: the longest way from the root along joints to the end of a link, every joint at
    /// zero, metres.
    pub fn length(&self) -> f64 {
        let mut ways: Vec<f64> = Vec::with_capacity(self.nodes.len());
        let mut longest = 0.0_f64;
        for node in &self.nodes {
            let way = node.parent.map_or(0.0, |parent| ways[parent] + node.origin.position.length());
            longest = longest.max(way + node.length());
            ways.push(way);
        }
        longest
    }

    /// A value for each node: zero, or the identity for a ball, wherever the range lies.
    pub fn rest(&self) -> Vec<Value> {
        self.nodes.iter().map(|node| node.joint.rest()).collect()
    }
}

impl Node {
    /// The node with unit axes and rotations, or what is wrong with it.
    fn sound(mut self, node: usize) -> Result<Node, ChainError> {
        let what = |what| ChainError::NotFinite { node, what };
        if !self.origin.position.is_finite() {
            return Err(what("place of the joint"));
        }
        if !self.tip.is_finite() {
            return Err(what("tip"));
        }
        let rotation = self.origin.rotation;
        if !rotation.is_finite() {
            return Err(what("rotation of the joint"));
        }
        self.origin.rotation = unit_rotation(rotation).ok_or(ChainError::NoRotation { node })?;
        self.joint = self.joint.sound(node)?;
        Ok(self)
    }
}

/// The rotation at unit length, itself to the bit if it has that; `None` without length.
fn unit_rotation(q: DQuat) -> Option<DQuat> {
    let length = q.length();
    if (length - 1.0).abs() < 1e-14 {
        return Some(q);
    }
    (length > 1e-100 && length.is_finite()).then(|| q / length)
}
