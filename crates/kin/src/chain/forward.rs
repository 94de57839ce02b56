//! From values to places, and a turn of one joint.

use glam::{DQuat, DVec3};

use super::{Chain, ChainError, Joint, Node, Value};
use crate::{Frame, axis_angle};

/// A link's two ends in the world, metres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Place {
    /// Where the node's frame is: its joint, after the slide of a prismatic one.
    pub joint: DVec3,
    /// The end of its link.
    pub tip: DVec3,
}

impl Chain {
    /// Writes `world_from_node` for every node; `out` is emptied first and can be used again.
    ///
    /// Values are used as given, in range or not.
    ///
    /// # Errors
    /// As many values as nodes are needed, each of its joint's kind, finite, rotations of unit length to 1e-6.
    /// `out` is then empty.
    pub fn frames(
        &self,
        values: &[Value],
        world_from_root: Frame,
        out: &mut Vec<Frame>,
    ) -> Result<(), ChainError> {
        out.clear();
        self.check(values)?;
        if !(world_from_root.position.is_finite() && world_from_root.rotation.is_finite()) {
            return Err(ChainError::BadNumber { what: "place of the chain" });
        }
        for (node, &value) in self.nodes.iter().zip(values) {
            let world_from_parent = node.parent.map_or(world_from_root, |parent| out[parent]);
            out.push(node.carried(world_from_parent, value));
        }
        Ok(())
    }

    /// Both ends of every link in the world, root to tip.
    ///
    /// # Errors
    /// As [`Chain::frames`].
    pub fn place(&self, values: &[Value], world_from_root: Frame) -> Result<Vec<Place>, ChainError> {
        let mut frames = Vec::with_capacity(self.nodes.len());
        self.frames(values, world_from_root, &mut frames)?;
        let ends = frames.iter().zip(&self.nodes);
        Ok(ends.map(|(frame, node)| Place { joint: frame.position, tip: frame.point(node.tip) }).collect())
    }

    /// Moves one joint by a delta, as far as its range lets it, and so everything that it carries. Says where it
    /// is then.
    ///
    /// An amount is added; a rotation turns the node in the joint's axes (`delta * before`). A value that lies
    /// outside its range may stay or move inward and never goes further out. A fixed joint takes no turn but
    /// zero.
    ///
    /// # Errors
    /// No such node, wrong count of values, or a delta or value of another kind or not finite; the values are
    /// then as before.
    pub fn turn(&self, values: &mut [Value], node: usize, delta: Value) -> Result<Value, ChainError> {
        let joint = self.node(node)?.joint;
        self.check(values)?;
        delta.check(&joint, node)?;
        let moved = match (values[node], delta) {
            (_, Value::Amount(by)) if matches!(joint, Joint::Fixed) && by != 0.0 => {
                return Err(ChainError::Kind { node, joint: joint.name(), wanted: joint.takes() });
            }
            (Value::Amount(from), Value::Amount(by)) => Value::Amount(from + by),
            (Value::Turn(from), Value::Turn(by)) => Value::Turn((by * from).normalize()),
            (from, _) => from,
        };
        moved.check(&joint, node)?;
        values[node] = joint.reaching(values[node]).clamp(moved);
        Ok(values[node])
    }

    /// Whether the values are as many as the nodes and each fits its joint.
    ///
    /// # Errors
    /// The first that does not, with its node.
    pub fn check(&self, values: &[Value]) -> Result<(), ChainError> {
        if values.len() != self.nodes.len() {
            let (values, nodes) = (values.len(), self.nodes.len());
            return Err(ChainError::Count { what: "values", values, nodes });
        }
        for (i, (node, value)) in self.nodes.iter().zip(values).enumerate() {
            value.check(&node.joint, i)?;
        }
        Ok(())
    }
}

impl Node {
    /// `world_from_node`; rotations that are the identity cost nothing.
    #[inline(always)]
    pub(super) fn carried(&self, world_from_parent: Frame, value: Value) -> Frame {
        carried(world_from_parent, &self.origin, &self.joint, value)
    }
}

/// The frame behind a joint; rotations that are the identity cost nothing.
#[inline(always)]
pub(super) fn carried(world_from_parent: Frame, origin: &Frame, joint: &Joint, value: Value) -> Frame {
    let position = if world_from_parent.rotation == DQuat::IDENTITY {
        world_from_parent.position + origin.position
    } else {
        world_from_parent.point(origin.position)
    };
    let rotation = turned(world_from_parent.rotation, origin.rotation);
    match (joint, value) {
        (Joint::Ball { .. }, Value::Turn(q)) => Frame::new(turned(rotation, q), position),
        (Joint::Revolute { axis, .. }, Value::Amount(angle)) if angle != 0.0 => {
            Frame::new(rotation * axis_angle(*axis, angle), position)
        }
        (Joint::Prismatic { axis, .. }, Value::Amount(way)) => {
            Frame::new(rotation, position + rotation * (*axis * way))
        }
        _ => Frame::new(rotation, position),
    }
}

/// The product of two rotations, the first itself if the second is the identity.
#[inline(always)]
fn turned(rotation: DQuat, by: DQuat) -> DQuat {
    if by == DQuat::IDENTITY { rotation } else { rotation * by }
}
