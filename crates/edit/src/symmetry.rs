//! Live symmetry: the command that does on the other side what a command does on this one.

use glam::DVec3;
use rig::{Bone, Figure, Frame, Limb, Part, Pose, Space};

use crate::{At, Command, Goal, Hold};

/// The twin of a command, mirrored in the placed figure's own middle plane. `None` for commands that have no side: those of
/// joints in the middle, of the hips, of the whole figure. Both eyes look one way, so they have no twin here; nor has
/// a limb that holds on to its twin, or is held by it, since it follows already.
pub fn mirrored(figure: &Figure, pose: &Pose, command: &Command) -> Option<Command> {
    let plane = Plane::of(pose);
    match command {
        Command::Turn { joint, dof, degrees, by } => {
            let twin = twin_of(figure, *joint)?;
            Some(Command::Turn { joint: twin, dof: *dof, degrees: *degrees, by: *by })
        }
        Command::Reach { limb, to } => {
            Some(Command::Reach { limb: alone(pose, *limb)?.mirrored(), to: plane.goal(*limb, *to)? })
        }
        Command::Elevate { limb, degrees, by } => {
            Some(Command::Elevate { limb: alone(pose, *limb)?.mirrored(), degrees: *degrees, by: *by })
        }
        Command::TurnInContact { limb, dof, degrees, by } => {
            let limb = alone(pose, *limb)?.mirrored();
            Some(Command::TurnInContact { limb, dof: *dof, degrees: *degrees, by: *by })
        }
        Command::Flip { limb } => Some(Command::Flip { limb: alone(pose, *limb)?.mirrored() }),
        Command::Articulate { limb, at } => {
            let at = match at {
                At::Named(name) => At::Named(name.clone()),
                At::Point(bone, point) => At::Point(bone.mirrored(), flipped(*point)),
            };
            Some(Command::Articulate { limb: limb.mirrored(), at })
        }
        Command::Keep { limb, contact, space } => keep(pose, *limb, *contact, *space),
        Command::Handshape { side, name, amount } => {
            Some(Command::Handshape { side: side.mirrored(), name: name.clone(), amount: *amount })
        }
        Command::ApplyPose { path, parts, amount, mirrored } => {
            let (path, amount, mirrored) = (path.clone(), *amount, !*mirrored);
            Some(Command::ApplyPose { path, parts: twins(parts)?, amount, mirrored })
        }
        Command::Reset { parts } => Some(Command::Reset { parts: twins(parts)? }),
        Command::MoveHips { .. }
        | Command::Place { .. }
        | Command::AimSpine { .. }
        | Command::LookAt { .. }
        | Command::Mirror { .. }
        | Command::Ranges { .. }
        | Command::Balance { .. } => None,
    }
}

/// The twin of a bone that the figure has; none for middle bones and eyes.
pub(crate) fn twin_of(figure: &Figure, bone: Bone) -> Option<Bone> {
    let twin = bone.mirrored();
    let paired = twin != bone && !matches!(bone, Bone::LeftEye | Bone::RightEye);
    figure.skeleton.joint(twin).filter(|_| paired).map(|joint| joint.bone)
}

/// The limb, unless it and its twin hang together by a contact.
fn alone(pose: &Pose, limb: Limb) -> Option<Limb> {
    let holds = |limb: Limb| match pose.limb(limb).contact.target() {
        Some((Space::Body(bone), _)) => Limb::of(bone) == Some(limb.mirrored()),
        _ => false,
    };
    (!holds(limb) && !holds(limb.mirrored())).then_some(limb)
}

fn keep(pose: &Pose, limb: Limb, contact: Hold, space: Space) -> Option<Command> {
    let space = match space {
        Space::World => Space::World,
        Space::Body(bone) if Limb::of(bone) == Some(limb.mirrored()) => return None,
        Space::Body(bone) => Space::Body(bone.mirrored()),
    };
    if contact != Hold::Free {
        alone(pose, limb)?;
    }
    Some(Command::Keep { limb: limb.mirrored(), contact, space })
}

/// The twins of those parts that are named on one side only.
fn twins(parts: &[Part]) -> Option<Vec<Part>> {
    let twins: Vec<Part> =
        parts.iter().map(|part| part.mirrored()).filter(|twin| !parts.contains(twin)).collect();
    (!twins.is_empty()).then_some(twins)
}

/// Adding to zero keeps a zero's sign plain.
fn flipped(v: DVec3) -> DVec3 {
    DVec3::new(0.0 - v.x, v.y, v.z)
}

/// The figure's middle plane in the world.
struct Plane(Frame);

impl Plane {
    fn of(pose: &Pose) -> Plane {
        Plane(pose.place.world_from_figure())
    }

    fn point(&self, point_in_world: DVec3) -> DVec3 {
        if self.0 == Frame::IDENTITY {
            return flipped(point_in_world);
        }
        self.0.point(flipped(self.0.inverse().point(point_in_world)))
    }

    fn vector(&self, in_world: DVec3) -> DVec3 {
        self.0.vector(flipped(self.0.inverse().vector(in_world)))
    }

    /// `None` for a goal on the twin itself, which has gone to meet it.
    fn goal(&self, limb: Limb, to: Goal) -> Option<Goal> {
        Some(match to {
            Goal::World(point) => Goal::World(self.point(point)),
            Goal::Body(bone, _) if Limb::of(bone) == Some(limb.mirrored()) => return None,
            Goal::Body(bone, point) => Goal::Body(bone.mirrored(), flipped(point)),
            Goal::Offset(by) => Goal::Offset(self.vector(by)),
            Goal::Here => Goal::Here,
        })
    }
}
