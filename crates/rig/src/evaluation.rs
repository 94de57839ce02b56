//! What a pose comes to: every joint in the world, every limb's contact and inverse parameters.

use glam::{DQuat, DVec3};
use kin::{Frame, Link, RootRange};

use crate::{Bone, Contact, Figure, Frames, Limb, Place, Pose, Space};

/// Derived from figure and pose, never stored.
#[derive(Clone, PartialEq, Debug)]
pub struct Evaluation {
    /// `world_from_joint` of every bone; bones that the figure lacks share their carrier's frame.
    pub frames: Frames,
    /// The limbs by [`Limb::index`].
    pub limbs: [LimbView; Limb::ALL.len()],
    /// Centre of mass, metres, world.
    pub center_of_mass: DVec3,
}

/// A limb as the animator sees it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LimbView {
    /// Where the articulator is, metres, world.
    pub articulator: DVec3,
    /// The contact's target, else the articulator itself; metres, world.
    pub target: DVec3,
    /// From articulator to target, metres.
    pub residual: f64,
    /// How far a planted end is turned from the rotation it should keep, degrees; else 0.
    pub rotation_residual: f64,
    /// Degrees in (-180, 180]; `None` where articulator and root joint coincide.
    pub elevation: Option<f64>,
    /// The feasible interval around the elevation, degrees, so that it contains it (ends may pass
    /// 180); -180 to 180 if free, `None` if the ranges leave none.
    pub elevation_range: Option<[f64; 2]>,
    /// +1 or -1: which solution of the hinge.
    pub branch: i8,
}

/// Works out everything that a pose comes to; with `ranges` off, elevations are free.
pub fn evaluate(figure: &Figure, pose: &Pose, ranges: bool) -> Evaluation {
    let frames = frames(figure, pose);
    let limbs = Limb::ALL.map(|limb| view(figure, pose, &frames, limb, ranges));
    Evaluation { center_of_mass: center_of_mass(figure, &frames), frames, limbs }
}

/// `world_from_joint` of every bone.
pub fn frames(figure: &Figure, pose: &Pose) -> Frames {
    // The turns first, each on its own, then the chain: a processor overlaps what does not wait for the joint before.
    let mut rotations = [DQuat::IDENTITY; Bone::COUNT];
    for joint in figure.skeleton.joints() {
        rotations[joint.bone.index()] = joint.rotation(pose.angles(joint.bone));
    }
    let links = Bone::ALL.iter().map(|&bone| match figure.skeleton.joint(bone) {
        Some(joint) => Link {
            carrier: joint.carrier.map(Bone::index),
            offset: if bone == Bone::Hips { pose.hips } else { joint.offset },
            rotation: rotations[bone.index()],
        },
        None => {
            Link { carrier: Some(bone.carrier().index()), offset: DVec3::ZERO, rotation: DQuat::IDENTITY }
        }
    });
    let mut frames = Frames([Frame::IDENTITY; Bone::COUNT]);
    let written = kin::fk(pose.place.world_from_figure(), links, &mut frames.0);
    debug_assert_eq!(written, Ok(Bone::COUNT), "bones are in carrier order");
    frames
}

impl Place {
    /// The frame of the placed figure in the world.
    pub fn world_from_figure(&self) -> Frame {
        Frame::new(kin::axis_angle(DVec3::Y, self.turn.to_radians()), self.position)
    }
}

impl Frames {
    /// The frame of a space in the world.
    pub fn space(&self, space: Space) -> Frame {
        match space {
            Space::World => Frame::IDENTITY,
            Space::Body(bone) => self[bone],
        }
    }
}

/// The mean of the segments' centres by mass; the hips if the figure has no mass.
pub fn center_of_mass(figure: &Figure, frames: &Frames) -> DVec3 {
    let (mut mass, mut moment) = (0.0, DVec3::ZERO);
    for joint in figure.skeleton.joints().filter(|joint| joint.mass != 0.0) {
        mass += joint.mass;
        moment += frames[joint.bone].point(joint.center_of_mass) * joint.mass;
    }
    if mass > 0.0 { moment / mass } else { frames[Bone::Hips].position }
}

fn view(figure: &Figure, pose: &Pose, frames: &Frames, limb: Limb, ranges: bool) -> LimbView {
    let at = figure.articulator(pose, limb);
    let articulator = frames[at.bone].point(at.at);
    let contact = pose.limb(limb).contact;
    let target = contact.target().map_or(articulator, |(space, point)| frames.space(space).point(point));
    let rotation_residual = match contact {
        Contact::Planted { space, rotation, .. } => {
            angle_between(frames[limb.parts().end].rotation, frames.space(space).rotation * rotation)
                .to_degrees()
        }
        _ => 0.0,
    };
    let empty = LimbView {
        articulator,
        target,
        residual: articulator.distance(target),
        rotation_residual,
        elevation: None,
        elevation_range: None,
        branch: 1,
    };
    let Some(rig) = figure.limbs.get(limb) else { return empty };
    // A planted end elevates about the line to its own joint.
    let planted = matches!(contact, Contact::Planted { .. }) && at.bone != limb.parts().hinge;
    let about = if planted { frames[limb.parts().end].position } else { articulator };
    let about_in_limb = rig.target_in_limb(frames[rig.base].inverse().point(about));
    let limits = if ranges { rig.ranges.root } else { RootRange::FREE };
    match rig.kin.read_within(rig.root_in(frames), about_in_limb, &limits) {
        Ok((goal, feasible)) => LimbView {
            elevation: Some(rig.reported(goal.elevation)),
            elevation_range: rig.reported_range(&goal, &feasible),
            branch: goal.branch.sign() as i8,
            ..empty
        },
        Err(_) => empty,
    }
}

/// The angle of the turn between two rotations, radians, accurate at 0.
pub(crate) fn angle_between(a: DQuat, b: DQuat) -> f64 {
    let d = a.conjugate() * b;
    2.0 * DVec3::new(d.x, d.y, d.z).length().atan2(d.w.abs())
}
