//! A robot: links on a tree of joints, as in URDF, with their looks; how it stands at given joint values.

mod change;
mod fault;
mod joint;
mod look;
mod nodes;
mod order;
mod pose;
mod reach;
mod root;
mod skin;
mod solid;

use std::collections::BTreeMap;

use glam::{DQuat, DVec3};
use kin::Frame;

pub use change::{ChangeError, NewLink};
pub use fault::RobotError;
pub use joint::{DofPart, JointLimit, Mimic, RobotJoint, RobotJointKind, rotation_of_rpy, rpy_of_rotation};
pub use look::{Inertial, Paint, RobotLink, Shape, Visual};
pub use nodes::RobotChain;
pub use pose::{RobotDof, RobotPose};
pub use reach::{RobotGoal, RobotReach};
pub use root::RootMoves;
pub use skin::RobotSkin;
pub use solid::{STAND_IN, STAND_IN_EDGE_M, Solid, UNPAINTED};

/// Links on a tree of joints.
///
/// Link 0 is the root, and joint `i` carries link `i + 1`; whatever carries comes before what it carries. Frames and places
/// are in the frame of the root link, metres, which URDF has z up: [`Robot::WORLD_FROM_ROOT`] stands it into our world.
#[derive(Clone, PartialEq, Debug)]
pub struct Robot {
    /// Its name.
    name: String,
    links: Vec<RobotLink>,
    joints: Vec<RobotJoint>,
    /// The link that each joint hangs on.
    carriers: Vec<usize>,
    /// The joint that each joint follows.
    masters: Vec<Option<usize>>,
    /// The joints that follow another, each after its master.
    followers: Vec<usize>,
    /// Where the values of each joint begin, and the number of all.
    slots: Vec<usize>,
}

impl Robot {
    /// Stands the z of the root link up along our y: its x stays to our x.
    pub const WORLD_FROM_ROOT: Frame = Frame::new(
        DQuat::from_xyzw(-std::f64::consts::FRAC_1_SQRT_2, 0.0, 0.0, std::f64::consts::FRAC_1_SQRT_2),
        DVec3::ZERO,
    );

    /// Makes a robot; links keep their order but for those that come before what carries them. Axes come out as unit
    /// vectors, limits of joints that have no ends as free.
    ///
    /// # Errors
    /// No links, a name twice, links and joints that are no tree, an axis of no length, limits the wrong way round, numbers that
    /// are not finite, a joint that mimics itself, one that isn't there or one with other than one value.
    pub fn new(
        name: impl Into<String>,
        links: Vec<RobotLink>,
        mut joints: Vec<RobotJoint>,
    ) -> Result<Robot, RobotError> {
        for joint in &mut joints {
            check_numbers(joint)?;
            joint.axis = direction(joint)?;
            if let Some(limit) = joint.limit.as_mut().filter(|_| !joint.kind.is_limited()) {
                limit.range = kin::Interval::FREE;
            }
        }
        for link in &links {
            check_link(link)?;
        }
        let (links, joints, carriers) = order::parents_first(links, joints)?;
        let (masters, followers) = order::masters(&joints)?;
        let mut slots = vec![0];
        for joint in &joints {
            slots.push(slots[slots.len() - 1] + joint.kind.parts().len());
        }
        Ok(Robot { name: name.into(), links, joints, carriers, masters, followers, slots })
    }

    /// Its name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its links; what carries comes first.
    pub fn links(&self) -> &[RobotLink] {
        &self.links
    }

    /// Its joints: joint `i` carries link `i + 1`.
    pub fn joints(&self) -> &[RobotJoint] {
        &self.joints
    }

    /// The number of the link of that name.
    pub fn link(&self, name: &str) -> Option<usize> {
        self.links.iter().position(|l| l.name == name)
    }

    /// The number of the joint of that name.
    pub fn joint(&self, name: &str) -> Option<usize> {
        self.joints.iter().position(|j| j.name == name)
    }

    /// The number of the link that a joint hangs on; the link that it carries is one beyond the joint's own number.
    pub fn carrier(&self, joint: usize) -> Option<usize> {
        self.carriers.get(joint).copied()
    }

    /// The number of the joint that a joint follows.
    pub fn master(&self, joint: usize) -> Option<usize> {
        self.masters.get(joint).copied().flatten()
    }

    /// The frame of each link in the root link's at those values; mimicking joints follow their masters.
    pub fn frames(&self, pose: &RobotPose) -> Vec<Frame> {
        let pose = self.followed(pose);
        let mut frames = vec![Frame::IDENTITY; self.links.len()];
        for (i, joint) in self.joints.iter().enumerate() {
            let moved = joint.joint_from_child(self.values(&pose, i));
            let root_from_child = frames[self.carriers[i]].then(joint.parent_from_joint).then(moved);
            frames[i + 1] = Frame::new(root_from_child.rotation.normalize(), root_from_child.position);
        }
        frames
    }

    /// Gives the meshes of visuals their triangles. `fetch` is asked for each file once, in the order of the links; where it
    /// says why not, the visual keeps its stand-in.
    ///
    /// Returns what could not be had, each with its reason.
    pub fn fill_meshes(
        &mut self,
        fetch: &mut dyn FnMut(&str) -> Result<std::sync::Arc<Solid>, String>,
    ) -> Vec<String> {
        let mut known: BTreeMap<String, Option<std::sync::Arc<Solid>>> = BTreeMap::new();
        let mut missing = Vec::new();
        for link in &mut self.links {
            for visual in &mut link.visuals {
                let Shape::Mesh { file, solid, .. } = &mut visual.shape else { continue };
                let found = known.entry(file.clone()).or_insert_with(|| match fetch(file) {
                    Ok(found) => Some(found),
                    Err(why) => {
                        missing
                            .push(format!("link \"{}\": mesh \"{file}\": {why}; a box stands in", link.name));
                        None
                    }
                });
                solid.clone_from(found);
            }
        }
        missing
    }
}

fn check_numbers(joint: &RobotJoint) -> Result<(), RobotError> {
    let limit = joint.limit.map_or([0.0; 2], |l| [l.effort, l.velocity]);
    let mimic = joint.mimic.as_ref().map_or([0.0; 2], |m| [m.multiplier, m.offset]);
    let ends = joint.limit.map_or([0.0; 2], |l| [l.range.min, l.range.max]);
    let finite = joint.parent_from_joint.position.is_finite()
        && joint.parent_from_joint.rotation.is_finite()
        && joint.axis.is_finite()
        && limit.iter().chain(&mimic).all(|v| v.is_finite())
        && ends.iter().all(|v| !v.is_nan());
    if !finite {
        return Err(RobotError::NotFinite { kind: "joint", name: joint.name.clone() });
    }
    match joint.limit {
        _ if !joint.kind.is_limited() => Ok(()),
        None => Err(RobotError::NoLimit { joint: joint.name.clone(), kind: joint.kind.name() }),
        Some(JointLimit { range, .. }) if range.min > range.max => {
            Err(RobotError::Limit { joint: joint.name.clone(), range })
        }
        Some(_) => Ok(()),
    }
}

/// The unit axis; what has none keeps what it says.
fn direction(joint: &RobotJoint) -> Result<DVec3, RobotError> {
    if !joint.kind.has_axis() {
        return Ok(joint.axis);
    }
    // Files say 0 0 1 most of the time: a unit vector stays the very same.
    if (joint.axis.length_squared() - 1.0).abs() < 1e-15 {
        return Ok(joint.axis);
    }
    let largest = joint.axis.abs().max_element();
    let unit = (largest > 0.0).then(|| (joint.axis / largest).normalize());
    unit.filter(|u| u.is_finite()).ok_or_else(|| RobotError::Axis { joint: joint.name.clone() })
}

fn check_link(link: &RobotLink) -> Result<(), RobotError> {
    let whole = |frame: &Frame| frame.position.is_finite() && frame.rotation.is_finite();
    let visual = |v: &Visual| {
        whole(&v.link_from_visual)
            && match &v.shape {
                Shape::Box(edges) => edges.is_finite(),
                Shape::Cylinder { radius, length } | Shape::Capsule { radius, length } => {
                    radius.is_finite() && length.is_finite()
                }
                Shape::Sphere(radius) => radius.is_finite(),
                Shape::Mesh { scale, .. } => scale.is_finite(),
            }
            && v.paint.as_ref().is_none_or(|p| p.rgba.iter().all(|c| c.is_finite()))
    };
    let mass = |m: &Inertial| {
        whole(&m.link_from_inertia) && m.mass.is_finite() && m.inertia.iter().all(|i| i.is_finite())
    };
    if link.visuals.iter().chain(&link.collisions).all(visual) && link.inertial.as_ref().is_none_or(mass) {
        return Ok(());
    }
    Err(RobotError::NotFinite { kind: "link", name: link.name.clone() })
}
