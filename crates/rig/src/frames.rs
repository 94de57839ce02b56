//! Rigid frames: where a posed figure's joints are.

use kin::Frame;

use crate::Bone;

/// `figure_from_joint` of every bone, by [`Bone::index`]; a bone that the figure lacks stays with its carrier.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Frames(pub [Frame; Bone::COUNT]);

impl std::ops::Index<Bone> for Frames {
    type Output = Frame;
    fn index(&self, bone: Bone) -> &Frame {
        &self.0[bone.index()]
    }
}
