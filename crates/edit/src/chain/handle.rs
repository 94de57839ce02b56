//! What is drawn at the chosen joint of a chain to be taken hold of: rings, and tracks to slide along.

use glam::{DQuat, DVec3, Vec2};
use rig::{DofPart, Frame, RobotJointKind};

use super::editor::ChainEditor;
use super::node::ChainNode;
use crate::{Circle, Sight};

/// A handle of one value of a pose.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ChainHandle {
    /// The place of the value in a pose.
    pub slot: usize,
    /// The joint.
    pub joint: usize,
    /// What the value does.
    pub part: DofPart,
    /// Where the handle is.
    pub shape: ChainShape,
    /// How far the value goes from where it is, radians or metres; infinite where free.
    pub range: [f64; 2],
}

/// The shape of a handle. Sizes follow the picture: the same pixels from near and far.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum ChainShape {
    /// A ring about the joint's axis; its angle 0 points where the link points.
    Ring(Circle),
    /// A straight track.
    Track(ChainTrack),
}

/// A straight line on which a joint slides.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ChainTrack {
    /// Where the joint is, metres, world.
    pub at: DVec3,
    /// Unit direction of larger values, world.
    pub direction: DVec3,
    /// From there to each end of the handle, metres.
    pub arm_m: f64,
}

/// Radius of a ring; a joint's second and third ring are a little smaller.
const RING_PX: f64 = 76.0;
/// From the middle of a track's handle to its ends.
const ARM_PX: f64 = 64.0;
/// How near the pointer must be.
const REACH_PX: f32 = 7.0;

/// The handles of a node: one for each way in which its joint moves; none for the root and for a joint that follows another.
pub fn chain_handles(editor: &ChainEditor, node: ChainNode, sight: &Sight) -> Vec<ChainHandle> {
    let (document, robot) = (editor.document(), editor.robot());
    let Some(dof) = node.dof(robot).filter(|dof| !dof.follows) else { return Vec::new() };
    let slots = robot.slot(dof.joint);
    let dofs = robot.dofs().enumerate().filter(|(slot, _)| slots.contains(slot));
    dofs.filter_map(|(slot, dof)| {
        let value = document.pose.0.get(slot).copied()?;
        let free = [f64::NEG_INFINITY, f64::INFINITY];
        let range = if document.ranges { [dof.range.min - value, dof.range.max - value] } else { free };
        let shape = shape(editor, dof.joint, dof.part, sight)?;
        Some(ChainHandle { slot, joint: dof.joint, part: dof.part, shape, range })
    })
    .collect()
}

fn shape(editor: &ChainEditor, joint: usize, part: DofPart, sight: &Sight) -> Option<ChainShape> {
    let robot = editor.robot();
    let link = editor.frames().get(joint + 1).copied()?;
    let at = link.position;
    let axis = chain_axis(editor, joint, part)?;
    let metres = sight.metres_per_px(at);
    if !part.is_angle() {
        return Some(ChainShape::Track(ChainTrack { at, direction: axis, arm_m: ARM_PX * metres }));
    }
    let toward = link.point(robot.tip(joint + 1)) - at;
    let along = if toward.cross(axis).length() > 1e-6 { toward } else { sight.toward_viewer(at) };
    let share = match part {
        DofPart::Pitch => 0.86,
        DofPart::Roll => 0.72,
        _ => 1.0,
    };
    Some(ChainShape::Ring(Circle::new(at, axis, along, RING_PX * share * metres)))
}

/// The unit direction in the world in which a part of a joint turns, by the right-hand rule, or slides; `None` for parts that
/// the joint doesn't have.
pub fn chain_axis(editor: &ChainEditor, joint: usize, part: DofPart) -> Option<DVec3> {
    let (document, robot) = (editor.document(), editor.robot());
    let own = robot.joints().get(joint)?;
    let place = own.kind.parts().iter().position(|known| *known == part)?;
    let carrier: Frame = editor.frames().get(robot.carrier(joint)?).copied()?;
    let world_from_joint = carrier.then(own.parent_from_joint).rotation;
    let values = robot.values(&document.pose, joint);
    if !part.is_angle() {
        let mut moved = values.to_vec();
        *moved.get_mut(place)? += 1.0;
        let way = own.joint_from_child(&moved).position - own.joint_from_child(values).position;
        return (world_from_joint * way).try_normalize();
    }
    let first = if own.kind == RobotJointKind::Floating { 3 } else { 0 };
    let angle = |i: usize| values.get(first + i).copied().unwrap_or(0.0);
    let yawed = DQuat::from_rotation_z(angle(2));
    let axis = match part {
        DofPart::Yaw => DVec3::Z,
        DofPart::Pitch => yawed * DVec3::Y,
        DofPart::Roll => yawed * DQuat::from_rotation_y(angle(1)) * DVec3::X,
        _ => own.axis,
    };
    (world_from_joint * axis).try_normalize()
}

impl ChainTrack {
    /// The two ends of the handle, that of smaller values first.
    pub fn ends(&self) -> [DVec3; 2] {
        [-self.arm_m, self.arm_m].map(|along| self.at + self.direction * along)
    }

    /// The line in the picture, and how many metres a pixel along it is; `None` where it points at the viewer.
    pub(super) fn seen(&self, sight: &Sight) -> Option<(Vec2, f64)> {
        let [from, to] = self.ends().map(|end| sight.pixel_of(end));
        let along = to? - from?;
        let length = along.length();
        (length > 4.0).then(|| (along / length, 2.0 * self.arm_m / f64::from(length)))
    }
}

impl ChainHandle {
    /// How near the pointer is to it; `None` out of reach.
    pub(super) fn cost_px(&self, sight: &Sight, at_px: Vec2) -> Option<f32> {
        let far = match self.shape {
            ChainShape::Ring(circle) => {
                let near = circle.nearest(sight, at_px)?;
                near.distance_px + if near.front { 0.0 } else { 3.0 }
            }
            ChainShape::Track(track) => {
                let [from, to] = track.ends().map(|end| sight.pixel_of(end));
                let (from, along) = (from?, to? - from?);
                let share = (at_px - from).dot(along) / along.length_squared().max(1e-12);
                (from + along * share.clamp(0.0, 1.0)).distance(at_px)
            }
        };
        (far <= REACH_PX).then_some(far)
    }

    /// A place of the picture at which a press takes it.
    pub fn place(&self, sight: &Sight) -> Option<Vec2> {
        match self.shape {
            // Beside the place where the link crosses it.
            ChainShape::Ring(circle) => {
                let angles = [0.9, -0.9, 2.2, -2.2, 0.4, 3.1];
                let front = angles.into_iter().find(|angle| circle.is_front(sight, *angle)).unwrap_or(0.9);
                sight.pixel_of(circle.point(front))
            }
            ChainShape::Track(track) => sight.pixel_of(track.at + track.direction * track.arm_m * 0.8),
        }
    }
}
