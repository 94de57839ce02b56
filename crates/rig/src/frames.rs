//! Rigid frames: where a posed figure's joints are.

use glam::{DQuat, DVec3};

use crate::Bone;

/// A rigid frame: `to_from` with a rotation first and a shift after it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Frame {
    /// Unit rotation.
    pub rotation: DQuat,
    /// Origin, metres.
    pub position: DVec3,
}

impl Frame {
    /// The frame that moves nothing.
    pub const IDENTITY: Frame = Frame { rotation: DQuat::IDENTITY, position: DVec3::ZERO };

    /// A point of the inner frame, seen from the outer one.
    pub fn point(self, p: DVec3) -> DVec3 {
        self.position + self.rotation * p
    }
}

/// `figure_from_joint` of every bone, by [`Bone::index`]; a bone that the figure lacks stays with its carrier.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Frames(pub [Frame; Bone::COUNT]);

impl std::ops::Index<Bone> for Frames {
    type Output = Frame;
    fn index(&self, bone: Bone) -> &Frame {
        &self.0[bone.index()]
    }
}
