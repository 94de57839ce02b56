//! A robot from the links and joints of a URDF file.

use std::collections::BTreeMap;

use glam::DVec3;
use kin::{Frame, Interval};
use rig::{
    Inertial, JointLimit, Mimic, Paint, Robot, RobotJoint, RobotJointKind, RobotLink, Shape, Visual,
    rotation_of_rpy,
};
use urdf_rs::{Geometry, JointType, Material, Pose};

use super::document::Document;
use super::{UrdfError, UrdfFault};

/// The robot that a document describes.
pub(super) fn robot(document: &Document<'_>, warnings: &mut Vec<String>) -> Result<Robot, UrdfError> {
    let file = &document.robot;
    let paints = paints(file);
    let links = file.links.iter().map(|l| link(l, &paints, warnings)).collect();
    let joints = file.joints.iter().map(|j| joint(j, warnings)).collect();
    Robot::new(file.name.clone(), links, joints).map_err(|e| document.locate(UrdfFault::Robot(e)))
}

/// The colours that the file gives names: those of the robot, then those of links, the first of a name.
fn paints(file: &urdf_rs::Robot) -> BTreeMap<&str, [f64; 4]> {
    let own = file.links.iter().flat_map(|l| &l.visual).filter_map(|v| v.material.as_ref());
    let mut paints = BTreeMap::new();
    for material in file.materials.iter().chain(own) {
        if let Some(color) = &material.color {
            paints.entry(material.name.as_str()).or_insert(color.rgba.0);
        }
    }
    paints
}

fn frame(pose: &Pose) -> Frame {
    Frame::new(rotation_of_rpy(pose.rpy.0), DVec3::from_array(pose.xyz.0))
}

fn link(link: &urdf_rs::Link, paints: &BTreeMap<&str, [f64; 4]>, warnings: &mut Vec<String>) -> RobotLink {
    let visuals = link.visual.iter().map(|v| Visual {
        name: v.name.clone(),
        link_from_visual: frame(&v.origin),
        shape: shape(&v.geometry),
        paint: v.material.as_ref().and_then(|m| paint(&link.name, m, paints, warnings)),
    });
    let visuals = visuals.collect();
    let collisions = link.collision.iter().map(|c| Visual {
        name: c.name.clone(),
        link_from_visual: frame(&c.origin),
        shape: shape(&c.geometry),
        paint: None,
    });
    if link.inertial.mass.value < 0.0 {
        warnings.push(format!("link \"{}\" weighs {} kg", link.name, link.inertial.mass.value));
    }
    RobotLink {
        name: link.name.clone(),
        visuals,
        collisions: collisions.collect(),
        inertial: inertial(&link.inertial),
        tip: None,
    }
}

/// What a link weighs. `urdf-rs` gives zeros where the file says nothing.
fn inertial(inertial: &urdf_rs::Inertial) -> Option<Inertial> {
    let i = &inertial.inertia;
    let found = Inertial {
        link_from_inertia: frame(&inertial.origin),
        mass: inertial.mass.value,
        inertia: [i.ixx, i.ixy, i.ixz, i.iyy, i.iyz, i.izz],
    };
    let nothing = Inertial { link_from_inertia: Frame::IDENTITY, mass: 0.0, inertia: [0.0; 6] };
    (found != nothing).then_some(found)
}

fn paint(
    link: &str,
    material: &Material,
    paints: &BTreeMap<&str, [f64; 4]>,
    warnings: &mut Vec<String>,
) -> Option<Paint> {
    let own = material.color.as_ref().map(|c| c.rgba.0);
    let rgba = own.or_else(|| paints.get(material.name.as_str()).copied());
    if let Some(texture) = &material.texture {
        warnings.push(format!("link \"{link}\": texture \"{}\" is not shown", texture.filename));
    } else if rgba.is_none() && !material.name.is_empty() {
        warnings.push(format!("link \"{link}\": material \"{}\" has no colour", material.name));
    }
    Some(Paint { name: material.name.clone(), rgba: rgba? })
}

fn shape(geometry: &Geometry) -> Shape {
    match geometry {
        Geometry::Box { size } => Shape::Box(DVec3::from_array(size.0)),
        Geometry::Cylinder { radius, length } => Shape::Cylinder { radius: *radius, length: *length },
        Geometry::Capsule { radius, length } => Shape::Capsule { radius: *radius, length: *length },
        Geometry::Sphere { radius } => Shape::Sphere(*radius),
        Geometry::Mesh { filename, scale } => Shape::Mesh {
            file: filename.clone(),
            scale: scale.map_or(DVec3::ONE, |s| DVec3::from_array(s.0)),
            solid: None,
        },
    }
}

fn joint(joint: &urdf_rs::Joint, warnings: &mut Vec<String>) -> RobotJoint {
    let kind = kind(&joint.joint_type);
    let mimic = joint.mimic.as_ref().map(|m| Mimic {
        master: m.joint.clone(),
        multiplier: m.multiplier.unwrap_or(1.0),
        offset: m.offset.unwrap_or(0.0),
    });
    if kind == RobotJointKind::Fixed && mimic.is_some() {
        warnings.push(format!("joint \"{}\" is fixed and mimics nothing", joint.name));
    }
    if kind == RobotJointKind::Ball {
        let name = &joint.name;
        warnings.push(format!("joint \"{name}\" is spherical, which not every program reads"));
    }
    RobotJoint {
        name: joint.name.clone(),
        kind,
        parent: joint.parent.link.clone(),
        child: joint.child.link.clone(),
        parent_from_joint: frame(&joint.origin),
        axis: DVec3::from_array(joint.axis.xyz.0),
        limit: limit(kind, &joint.limit),
        mimic: mimic.filter(|_| kind != RobotJointKind::Fixed),
    }
}

fn kind(kind: &JointType) -> RobotJointKind {
    match kind {
        JointType::Fixed => RobotJointKind::Fixed,
        JointType::Revolute => RobotJointKind::Revolute,
        JointType::Continuous => RobotJointKind::Continuous,
        JointType::Prismatic => RobotJointKind::Prismatic,
        JointType::Planar => RobotJointKind::Planar,
        JointType::Spherical => RobotJointKind::Ball,
        JointType::Floating => RobotJointKind::Floating,
    }
}

/// The limits. `urdf-rs` gives its defaults where the file says nothing, which it may not for those two kinds.
fn limit(kind: RobotJointKind, limit: &urdf_rs::JointLimit) -> Option<JointLimit> {
    let finite = |v: f64| if v.is_finite() { v } else { 0.0 };
    (kind.is_limited() || *limit != urdf_rs::JointLimit::default()).then(|| JointLimit {
        range: Interval { min: limit.lower, max: limit.upper },
        effort: finite(limit.effort),
        velocity: finite(limit.velocity),
    })
}
