//! A figure's skeleton as a robot, in the words that the skeleton reader knows.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DQuat, DVec3};
use kin::{Frame, Interval};
use rig::{
    Articulation, Bone, Dof, Figure, Hinge, Inertial, Joint, JointLimit, Paint, Robot, RobotError,
    RobotJoint, RobotJointKind, RobotLink, Shape, Visual, rotation_of_rpy,
};

use super::tree::GROUND;

/// Kilograms in a cubic metre of body.
const DENSITY: f64 = 1000.0;
/// The torque in newton metres and the speed in radians a second that limits must name; figures have none.
const EFFORT: f64 = 100.0;
const VELOCITY: f64 = 10.0;

/// A figure's skeleton as a robot: each bone a link of its name, each degree of freedom a revolute joint, those of one joint at
/// one place with links without mass between. [`read`](super::read) makes the same skeleton of what is written of it.
///
/// The root link has x ahead, y to the left and z up, as robots have; "ground" below it has the figure's axes. Links look like the
/// rods and balls that their masses fill. A ball joint is the box of its ranges: cones are not written, and a swing is
/// flexion, then abduction, where the figure turns by both at once.
///
/// # Errors
/// None for a skeleton of finite numbers.
pub fn figure_robot(figure: &Figure) -> Result<Robot, RobotError> {
    let mut links = vec![empty("base"), empty(GROUND)];
    let mut joints = vec![RobotJoint {
        name: "upright".to_owned(),
        kind: RobotJointKind::Fixed,
        parent: "base".to_owned(),
        child: GROUND.to_owned(),
        parent_from_joint: Frame::new(rotation_of_rpy([FRAC_PI_2, 0.0, FRAC_PI_2]), DVec3::ZERO),
        axis: DVec3::X,
        limit: None,
        mimic: None,
    }];
    for joint in figure.skeleton.joints() {
        add(joint, &mut links, &mut joints);
        let link = RobotLink {
            visuals: looks(figure, joint),
            inertial: inertial(joint),
            ..empty(joint.bone.name())
        };
        links.push(link);
    }
    Robot::new(figure.name.clone(), links, joints)
}

fn empty(name: &str) -> RobotLink {
    RobotLink { name: name.to_owned(), ..RobotLink::default() }
}

/// Adds the joints of a bone and the links between them, all but the bone's own.
fn add(joint: &Joint, links: &mut Vec<RobotLink>, joints: &mut Vec<RobotJoint>) {
    let bone = joint.bone.name();
    let mut parent = joint.carrier.map_or(GROUND, Bone::name).to_owned();
    let mut offset = joint.offset;
    let mut push = |name: String, kind, child: String, axis, limit| {
        let parent_from_joint = Frame::new(DQuat::IDENTITY, std::mem::take(&mut offset));
        let parent = std::mem::replace(&mut parent, child.clone());
        joints.push(RobotJoint { name, kind, parent, child, parent_from_joint, axis, limit, mimic: None });
    };
    let hinges = hinges(joint);
    if joint.bone == Bone::Hips {
        return push(bone.to_owned(), RobotJointKind::Floating, bone.to_owned(), DVec3::X, None);
    }
    if hinges.is_empty() {
        return push(bone.to_owned(), RobotJointKind::Fixed, bone.to_owned(), DVec3::X, None);
    }
    for (i, hinge) in hinges.iter().enumerate() {
        let name = format!("{bone}_{}", hinge.dof.name());
        let child = if i + 1 == hinges.len() { bone.to_owned() } else { name.clone() };
        if i + 1 < hinges.len() {
            links.push(empty(&child));
        }
        let free = !(hinge.range.min.is_finite() && hinge.range.max.is_finite());
        let kind = if free { RobotJointKind::Continuous } else { RobotJointKind::Revolute };
        let range = Interval { min: hinge.range.min.to_radians(), max: hinge.range.max.to_radians() };
        let limit = JointLimit { range, effort: EFFORT, velocity: VELOCITY };
        push(name, kind, child, hinge.axis, Some(limit));
    }
}

fn hinges(joint: &Joint) -> Vec<Hinge> {
    match &joint.articulation {
        Articulation::Hinges(hinges) => hinges.clone(),
        Articulation::Ball { ball, ranges, .. } => {
            let axes = [ball.flexion, ball.abduction, ball.twist];
            let hinge = |i: usize| Hinge { dof: Dof::ALL[i], axis: axes[i], range: ranges[i] };
            (0..3).map(hinge).collect()
        }
    }
}

/// The mass, spread as in a ball.
fn inertial(joint: &Joint) -> Option<Inertial> {
    (joint.mass > 0.0).then(|| {
        let moment = 0.4 * joint.mass * ball_radius(joint.mass).powi(2);
        let link_from_inertia = Frame::new(DQuat::IDENTITY, joint.center_of_mass);
        Inertial { link_from_inertia, mass: joint.mass, inertia: [moment, 0.0, 0.0, moment, 0.0, moment] }
    })
}

fn ball_radius(mass: f64) -> f64 {
    (mass / DENSITY * 3.0 / (4.0 * PI)).cbrt()
}

/// A rod to the joint of what the bone carries, as thick as its mass makes it; a ball for a bone at an end.
fn looks(figure: &Figure, joint: &Joint) -> Vec<Visual> {
    let carried: Vec<DVec3> = figure
        .skeleton
        .joints()
        .filter(|j| j.carrier == Some(joint.bone))
        .map(|j| j.offset)
        .filter(|o| o.length() > 1e-4)
        .collect();
    let paint = Some(Paint { name: "clay".to_owned(), rgba: [0.75, 0.68, 0.6, 1.0] });
    let visual = |at: Frame, shape| Visual { name: None, link_from_visual: at, shape, paint: paint.clone() };
    if carried.is_empty() {
        let radius = ball_radius(joint.mass);
        let at = Frame::new(DQuat::IDENTITY, joint.center_of_mass);
        return if radius > 0.0 { vec![visual(at, Shape::Sphere(radius))] } else { Vec::new() };
    }
    let total: f64 = carried.iter().map(|o| o.length()).sum();
    let radius = (joint.mass / DENSITY / (PI * total)).sqrt().clamp(0.004, 0.12);
    let rod = |offset: &DVec3| {
        let turn = DQuat::from_rotation_arc(DVec3::Z, offset.normalize());
        visual(Frame::new(turn, *offset / 2.0), Shape::Cylinder { radius, length: offset.length() })
    };
    carried.iter().map(rod).collect()
}
