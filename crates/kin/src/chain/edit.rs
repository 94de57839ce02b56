//! Changing a chain's structure: nodes come and go, lengths and ranges change, the rest stays where it is on its
//! parent.

use glam::DVec3;

use super::joint::interval;
use super::{BallRange, Chain, ChainError, Joint, Node};
use crate::{Frame, Interval};

impl Chain {
    /// Adds a node that joins at its parent's tip, in its parent's axes, and returns its index: always the last.
    /// A node without parent is the root of an empty chain and keeps its origin. The values need one more,
    /// [`Joint::rest`].
    ///
    /// To join elsewhere or turned, see [`Chain::attach`].
    ///
    /// # Errors
    /// No such parent, a second root, or a node that is not sound, as for [`Chain::new`].
    pub fn append(&mut self, node: Node) -> Result<usize, ChainError> {
        let Some(parent) = node.parent else { return self.push(node) };
        let origin = Frame::new(glam::DQuat::IDENTITY, self.node(parent)?.tip);
        self.push(Node { origin, ..node })
    }

    /// Adds a node with its origin as it is, and returns its index: always the last. The values need one more,
    /// [`Joint::rest`].
    ///
    /// # Errors
    /// As [`Chain::append`].
    pub fn attach(&mut self, node: Node) -> Result<usize, ChainError> {
        self.push(node)
    }

    /// Takes a node out. What it carried joins its parent where the node joined it, as if its link had shrunk to
    /// nothing; everything else stays. Nodes behind it move up by one index, so the caller removes
    /// `values[node]` too.
    ///
    /// # Errors
    /// No such node, or the root while it carries more than one node.
    pub fn remove(&mut self, node: usize) -> Result<Node, ChainError> {
        let removed = *self.node(node)?;
        let children = self.children(node).count();
        if removed.parent.is_none() && children > 1 {
            return Err(ChainError::ManyRoots { children });
        }
        self.nodes.remove(node);
        for other in &mut self.nodes[node..] {
            match other.parent {
                Some(parent) if parent == node => {
                    let from_tip = other.origin.position - removed.tip;
                    other.origin = removed.origin.then(Frame::new(other.origin.rotation, from_tip));
                    other.parent = removed.parent;
                }
                Some(parent) if parent > node => other.parent = Some(parent - 1),
                _ => {}
            }
        }
        Ok(removed)
    }

    /// Gives a revolute or prismatic joint another range, radians or metres. The value stays where it is:
    /// outside, it may only move inward.
    ///
    /// # Errors
    /// No such node, a joint of another kind, or a range that is empty or NaN.
    pub fn set_range(&mut self, node: usize, to: Interval) -> Result<(), ChainError> {
        let to = interval(to, node, "range")?;
        self.node(node)?;
        match &mut self.nodes[node].joint {
            Joint::Revolute { range, .. } | Joint::Prismatic { range, .. } => *range = to,
            joint => {
                let wanted = if matches!(joint, Joint::Fixed) { "no range" } else { "a cone and a twist" };
                return Err(ChainError::Kind { node, joint: joint.name(), wanted });
            }
        }
        Ok(())
    }

    /// Gives a ball joint another range, or none. The value stays where it is: outside, it may only move inward.
    ///
    /// # Errors
    /// No such node, a joint of another kind, or a range that is not sound, as for [`Chain::new`].
    pub fn set_ball_range(&mut self, node: usize, to: Option<BallRange>) -> Result<(), ChainError> {
        let joint = self.node(node)?.joint;
        if !matches!(joint, Joint::Ball { .. }) {
            let wanted = if matches!(joint, Joint::Fixed) { "no range" } else { "an interval" };
            return Err(ChainError::Kind { node, joint: joint.name(), wanted });
        }
        self.nodes[node].joint = Joint::Ball { range: to }.sound(node)?;
        Ok(())
    }

    /// Makes a link longer or shorter along its direction, metres. Children that join at its tip move along;
    /// others stay.
    ///
    /// # Errors
    /// No such node, a length that is not above zero and finite, or a link without direction.
    pub fn set_length(&mut self, node: usize, length: f64) -> Result<(), ChainError> {
        let tip = self.node(node)?.tip;
        if !(length > 0.0 && length.is_finite()) {
            return Err(ChainError::Length { node, length });
        }
        let direction = tip.try_normalize().ok_or(ChainError::NoDirection { node })?;
        self.set_tip(node, direction * length)
    }

    /// Moves the end of a link, in the node's frame. Children that join at it, to a billionth of the length,
    /// move along; others stay.
    ///
    /// # Errors
    /// No such node, or a place that is not finite.
    pub fn set_tip(&mut self, node: usize, tip: DVec3) -> Result<(), ChainError> {
        let before = self.node(node)?.tip;
        if !tip.is_finite() {
            return Err(ChainError::NotFinite { node, what: "tip" });
        }
        self.nodes[node].tip = tip;
        for child in &mut self.nodes[node + 1..] {
            if child.parent == Some(node) && child.origin.position.distance(before) <= 1e-9 * before.length()
            {
                child.origin.position = tip;
            }
        }
        Ok(())
    }
}
