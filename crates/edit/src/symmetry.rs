//! Live symmetry: the command that does on the other side what a command does on this one.

use glam::DVec3;
use rig::{Bone, Dof, Figure, Frame, Limb, Part, Pose, Space, mirrored_pose};

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

/// The pose after a command and its twin with the rounding of the twin taken out: where a straight limb or a stop at a
/// range makes more of it, a symmetric pose would slowly go askew. `None` where the pose was not symmetric before, or the
/// two sides have really come out differently.
///
/// `one` is the pose after the command alone, `both` after its twin, too.
pub(crate) fn evened(before: &Pose, one: &Pose, both: &Pose) -> Option<Pose> {
    if apart(before, &mirrored_pose(before)) > EVEN_DEG {
        return None;
    }
    let (image, mut pose) = (mirrored_pose(one), one.clone());
    for bone in Bone::ALL {
        let twin = bone.mirrored();
        if one.angles(twin) != before.angles(twin) {
            pose.angles[bone.index()] = image.angles(bone);
        }
    }
    for limb in Limb::ALL {
        let twin = limb.mirrored();
        if one.limb(twin) != before.limb(twin) {
            pose.limbs[limb.index()] = image.limb(limb).clone();
        }
    }
    (apart(&pose, both) < EVEN_DEG).then_some(pose)
}

/// What is told apart from rounding, degrees of angles and tenths of millimetres of contacts.
const EVEN_DEG: f64 = 1e-3;

/// How far two poses are apart: the most of any angle in degrees and of any contact's target in units of 0.1 mm; infinitely
/// for contacts of different kinds.
fn apart(a: &Pose, b: &Pose) -> f64 {
    let angle = |bone: Bone| {
        let (a, b) = (a.angles(bone), b.angles(bone));
        Dof::ALL.map(|dof| (a.get(dof) - b.get(dof)).abs()).into_iter().fold(0.0, f64::max)
    };
    let hold = |limb: Limb| match (a.limb(limb).contact.target(), b.limb(limb).contact.target()) {
        (None, None) => 0.0,
        (Some((at, p)), Some((to, q))) if at == to => p.distance(q) * 1e4,
        _ => f64::INFINITY,
    };
    let angles = Bone::ALL.into_iter().map(angle).fold(0.0, f64::max);
    Limb::ALL.into_iter().map(hold).fold(angles, f64::max).max(a.hips.distance(b.hips) * 1e4)
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
