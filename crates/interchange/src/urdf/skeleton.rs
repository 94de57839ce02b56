//! A skeleton from the links and joints of a URDF file.
//!
//! Each bone is a link; its degrees of freedom are revolute joints `<link>_flexion`, `<link>_abduction`,
//! `<link>_twist` at one place, in the order in which they apply, the first carrying the offset from the
//! bone before. A floating joint carries the hips. Joint axes may be written in turned frames (`rpy`):
//! they are brought to world axes at rest.

use std::collections::BTreeMap;

use glam::{DMat3, DQuat, DVec3, EulerRot};
use kin::{Ball, Interval};
use rig::{Articulation, Bone, Dof, Hinge, Joint};
use urdf_rs::JointType;

use super::UrdfFault;
use super::tree::Tree;

/// The joints of the bones of a tree.
pub(super) fn joints(tree: &Tree<'_>) -> Result<Vec<Joint>, UrdfFault> {
    // How each link's frame stands in the world at rest.
    let mut frames = BTreeMap::new();
    let mut joints = Vec::new();
    let masses = tree.masses();
    for bone in tree.bones() {
        let (mut joint, world_from_link) = joint(tree, bone, &frames)?;
        let (mass, center) = masses.get(&bone).copied().unwrap_or_default();
        (joint.mass, joint.center_of_mass) = (mass, world_from_link * center);
        frames.insert(bone, world_from_link);
        joints.push(joint);
    }
    Ok(joints)
}

/// The joint of a bone, still without mass, and the rotation of its link at rest.
fn joint(tree: &Tree<'_>, bone: Bone, frames: &BTreeMap<Bone, DQuat>) -> Result<(Joint, DQuat), UrdfFault> {
    let (carrier, chain) = tree.chain(bone)?;
    let mut world_from_link = match carrier {
        Some(carrier) => *frames.get(&carrier).ok_or(UrdfFault::Order { bone, carrier })?,
        None => DQuat::IDENTITY,
    };
    let mut offset = DVec3::ZERO;
    let mut hinges: Vec<(Hinge, &str)> = Vec::new();
    for joint in chain {
        let step = world_from_link * DVec3::from_array(joint.origin.xyz.0);
        if !hinges.is_empty() && step.length() > 1e-9 {
            return Err(UrdfFault::Apart { joint: joint.name.clone(), bone, distance_m: step.length() });
        }
        offset += step;
        let [roll, pitch, yaw] = joint.origin.rpy.0;
        world_from_link = (world_from_link * DQuat::from_euler(EulerRot::ZYX, yaw, pitch, roll)).normalize();
        if let Some(hinge) = hinge(joint, bone, world_from_link)? {
            if hinges.iter().any(|(h, _)| h.dof == hinge.dof) {
                return Err(UrdfFault::DofTwice { joint: joint.name.clone(), bone, dof: hinge.dof });
            }
            hinges.push((hinge, &joint.name));
        }
    }
    let articulation = if bone == Bone::Hips { hips() } else { articulation(bone, hinges)? };
    let joint = Joint { bone, carrier, offset, articulation, mass: 0.0, center_of_mass: DVec3::ZERO };
    Ok((joint, world_from_link))
}

/// What one URDF joint on the way to a bone adds: a hinge, or nothing if it is fixed.
fn hinge(joint: &urdf_rs::Joint, bone: Bone, world_from_joint: DQuat) -> Result<Option<Hinge>, UrdfFault> {
    let name = || joint.name.clone();
    let range = match joint.joint_type {
        JointType::Fixed => return Ok(None),
        JointType::Floating if bone == Bone::Hips => return Ok(None),
        JointType::Revolute if bone != Bone::Hips => range(joint)?,
        JointType::Continuous if bone != Bone::Hips => Interval::FREE,
        ref found => {
            return Err(UrdfFault::Type { joint: name(), bone, found: format!("{found:?}").to_lowercase() });
        }
    };
    let word = joint.name.rsplit('_').next().unwrap_or_default();
    let dof = Dof::ALL.into_iter().find(|d| d.name() == word).ok_or_else(|| UrdfFault::Dof {
        joint: name(),
        nearest: rig::nearest(word, Dof::ALL.iter().map(|d| d.name())).to_owned(),
    })?;
    let axis = (world_from_joint * DVec3::from_array(joint.axis.xyz.0))
        .try_normalize()
        .ok_or_else(|| UrdfFault::Axis { joint: name() })?;
    Ok(Some(Hinge { dof, axis, range }))
}

/// The limits in degrees. Radians of whole degrees come out whole: what lies below 1e-9 is rounding.
fn range(joint: &urdf_rs::Joint) -> Result<Interval, UrdfFault> {
    let (lower, upper) = (joint.limit.lower, joint.limit.upper);
    if lower > upper {
        return Err(UrdfFault::Limit { joint: joint.name.clone(), lower, upper });
    }
    let degrees = |rad: f64| (rad.to_degrees() * 1e9).round() / 1e9;
    Ok(Interval { min: degrees(lower), max: degrees(upper) })
}

fn articulation(bone: Bone, hinges: Vec<(Hinge, &str)>) -> Result<Articulation, UrdfFault> {
    let last = hinges.last().map_or(String::new(), |(_, joint)| (*joint).to_owned());
    let hinges: Vec<Hinge> = hinges.into_iter().map(|(hinge, _)| hinge).collect();
    let [flexion, abduction, twist] = hinges.as_slice() else {
        return Ok(Articulation::Hinges(hinges));
    };
    if [flexion.dof, abduction.dof, twist.dof] != Dof::ALL {
        return Err(UrdfFault::BallOrder { joint: last, bone });
    }
    let axes = DMat3::from_cols(flexion.axis, abduction.axis, twist.axis);
    let square = axes.transpose() * axes;
    if !square.abs_diff_eq(DMat3::IDENTITY, 1e-6) {
        return Err(UrdfFault::Skew { joint: last, bone });
    }
    Ok(Articulation::Ball {
        ball: Ball { flexion: flexion.axis, abduction: abduction.axis, twist: twist.axis },
        ranges: [flexion.range, abduction.range, twist.range],
        cone: None,
    })
}

/// The floating joint under the hips: free, with the trunk's axes.
fn hips() -> Articulation {
    Articulation::Ball {
        ball: Ball { flexion: DVec3::X, abduction: DVec3::NEG_Z, twist: DVec3::Y },
        ranges: [Interval::FREE; 3],
        cone: None,
    }
}
