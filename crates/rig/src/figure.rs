//! A figure: skeleton, named articulators, handshapes and skin, as one value.

use std::collections::BTreeMap;

use glam::DVec3;

use crate::{Angles, Bone, Limb, LimbRigs, Mesh, Pose, Reacher, Skeleton};

/// A point that can reach: fixed in the joint frame of a bone.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Articulator {
    /// The bone: the limb's lower segment, its end, or one of its fingers or toes.
    pub bone: Bone,
    /// Metres in that bone's joint frame.
    pub at: DVec3,
}

/// A handshape: finger angles of the left hand in degrees, by bone. The right hand takes the twins.
pub type Handshape = BTreeMap<Bone, Angles>;

/// Everything that a figure is, apart from how it is posed.
#[derive(Clone, PartialEq, Debug)]
pub struct Figure {
    /// The name that pose files carry.
    pub name: String,
    /// Joints, axes, ranges, masses.
    pub skeleton: Skeleton,
    /// Named articulators of each limb, in [`Limb::ALL`] order.
    pub articulators: [BTreeMap<String, Articulator>; Limb::ALL.len()],
    /// Handshapes by name.
    pub handshapes: BTreeMap<String, Handshape>,
    /// The limbs, ready to solve.
    pub limbs: LimbRigs,
    /// The skin, if the figure has one.
    pub skin: Option<Mesh>,
}

impl Figure {
    /// The pose at rest: every angle 0, every limb free.
    pub fn rest_pose(&self) -> Pose {
        Pose::rest(self.skeleton.rest_position(Bone::Hips))
    }

    /// The point of a limb that reaches in a pose; the end's joint if the figure lacks the name.
    pub fn articulator(&self, pose: &Pose, limb: Limb) -> Articulator {
        let end = Articulator { bone: limb.parts().end, at: DVec3::ZERO };
        match &pose.limb(limb).reacher {
            Reacher::Named(name) => self.articulators[limb.index()].get(name).copied().unwrap_or(end),
            Reacher::Point(bone, at) => Articulator { bone: *bone, at: *at },
        }
    }
}
