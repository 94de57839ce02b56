//! Grabbing the figure: which gesture a drag of a part of the skin is, and the commands that it makes.
//!
//! A grab is read off the pose when it begins; every later place of the pointer makes commands that start from that
//! first pose, so that the result does not depend on how many events came between.

use glam::{DQuat, DVec3};
use rig::{Bone, Contact, Evaluation, Figure, Frames, Limb, Pose};

use crate::elevation::elevation_circle;
use crate::ring::Swing;
use crate::{At, By, Command, Goal, Hit};

/// What a drag moves.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Handle {
    /// The grabbed point of a limb's lower segment, end, finger or toe reaches.
    Reach(Limb),
    /// The hinge swings about the line from root to articulator.
    Elevate(Limb),
    /// A ball joint turns so that the grabbed point follows: upper arm, thigh, collar.
    Swing(Bone),
    /// The hips move; contacts are kept.
    Hips,
    /// The spine bends.
    Spine,
    /// Neck and head turn.
    Head,
}

/// A part of the figure held by the pointer.
#[derive(Clone, PartialEq, Debug)]
pub struct Grab {
    /// What the drag moves.
    pub handle: Handle,
    /// The bone under the pointer.
    pub bone: Bone,
    /// The grabbed point in that bone's joint frame, metres.
    pub point_in_bone: DVec3,
    /// Where it was when it was grabbed, metres, world.
    pub first_in_world: DVec3,
    first: Pose,
    frames: Frames,
}

/// How near to elbow or knee, as a share of the upper segment, a grab is one of the hinge itself.
const HINGE_SHARE: f64 = 0.18;

impl Grab {
    /// Takes hold of the skin where a ray met it.
    pub fn begin(figure: &Figure, pose: &Pose, evaluation: &Evaluation, hit: &Hit) -> Grab {
        Grab {
            handle: handle(figure, pose, &evaluation.frames, hit),
            bone: hit.bone,
            point_in_bone: hit.point_in_bone,
            first_in_world: hit.point_in_world,
            first: pose.clone(),
            frames: evaluation.frames,
        }
    }

    /// Takes hold of a point of a bone, metres, world, to move what a handle says.
    pub fn of(
        handle: Handle,
        bone: Bone,
        point_in_world: DVec3,
        pose: &Pose,
        evaluation: &Evaluation,
    ) -> Grab {
        Grab {
            handle,
            bone,
            point_in_bone: evaluation.frames[bone].inverse().point(point_in_world),
            first_in_world: point_in_world,
            first: pose.clone(),
            frames: evaluation.frames,
        }
    }

    /// The commands that bring the grabbed point toward a point of the world, from the pose at which the grab began.
    pub fn commands(&self, figure: &Figure, to_in_world: DVec3) -> Vec<Command> {
        match self.handle {
            Handle::Reach(limb) => vec![
                Command::Articulate { limb, at: At::Point(self.bone, self.point_in_bone) },
                Command::Reach { limb, to: Goal::World(to_in_world) },
            ],
            Handle::Elevate(limb) => self.elevate(figure, limb, to_in_world),
            Handle::Swing(bone) => self.swing(figure, bone, to_in_world),
            Handle::Hips => vec![Command::MoveHips { by: to_in_world - self.first_in_world }],
            Handle::Spine => self.bend(figure, to_in_world),
            Handle::Head => self.look(to_in_world),
        }
    }

    /// The turn about a joint that takes the grabbed point's direction to the pointer's.
    fn turn_about(&self, joint_in_world: DVec3, to_in_world: DVec3) -> DQuat {
        let direction = |point: DVec3| (point - joint_in_world).try_normalize();
        match (direction(self.first_in_world), direction(to_in_world)) {
            (Some(from), Some(to)) => DQuat::from_rotation_arc(from, to),
            _ => DQuat::IDENTITY,
        }
    }

    fn elevate(&self, figure: &Figure, limb: Limb, to_in_world: DVec3) -> Vec<Command> {
        let Some((circle, sense)) = elevation_circle(figure, &self.first, &self.frames, limb) else {
            return Vec::new();
        };
        let taken = circle.from_angle(circle.angle_of(self.first_in_world));
        let degrees = sense * taken.angle_of(to_in_world).to_degrees();
        vec![Command::Elevate { limb, degrees, by: By::Delta }]
    }

    fn swing(&self, figure: &Figure, bone: Bone, to_in_world: DVec3) -> Vec<Command> {
        let Some(swing) = Swing::of(figure, &self.first, &self.frames, bone) else { return Vec::new() };
        swing.commands(self.turn_about(self.frames[bone].position, to_in_world))
    }

    fn bend(&self, figure: &Figure, to_in_world: DVec3) -> Vec<Command> {
        let foot = self.frames[Bone::Spine].position;
        let chord = self.frames[Bone::Neck].position - foot;
        let at = foot + self.turn_about(foot, to_in_world) * chord;
        let aim = |twist| Command::AimSpine { at, twist };
        rig::spine_twist(figure, &self.first).map(aim).into_iter().collect()
    }

    fn look(&self, to_in_world: DVec3) -> Vec<Command> {
        let head = self.frames[Bone::Head];
        let eyes = (self.frames[Bone::LeftEye].position + self.frames[Bone::RightEye].position) * 0.5;
        let turn = self.turn_about(self.frames[Bone::Neck].position, to_in_world);
        let gaze = turn * (head.rotation * DVec3::Z);
        vec![Command::LookAt { at: eyes + gaze * 2.0 }]
    }
}

/// What a drag of that place of the skin moves.
fn handle(figure: &Figure, pose: &Pose, frames: &Frames, hit: &Hit) -> Handle {
    let Some(limb) = Limb::of(hit.bone) else {
        return match hit.bone {
            Bone::Hips => Handle::Hips,
            Bone::Spine | Bone::Chest | Bone::UpperChest => Handle::Spine,
            Bone::LeftShoulder | Bone::RightShoulder => Handle::Swing(hit.bone),
            _ => Handle::Head,
        };
    };
    let parts = limb.parts();
    let upper = figure.skeleton.joint(parts.hinge).map_or(0.0, |joint| joint.offset.length());
    let at_hinge = hit.bone <= parts.hinge
        && frames[parts.hinge].position.distance(hit.point_in_world) < 0.02 + HINGE_SHARE * upper;
    let held = pose.limb(limb).contact != Contact::Free;
    match (at_hinge, held) {
        (true, true) => Handle::Elevate(limb),
        (true, false) => Handle::Swing(parts.root),
        _ if hit.bone == parts.root => Handle::Swing(parts.root),
        _ => Handle::Reach(limb),
    }
}
