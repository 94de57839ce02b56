//! What a pose comes to, as data for tests and scripts: the records of `--report` and `inspect`.

use std::collections::BTreeMap;

use glam::DVec3;
use rig::{Bone, Contact, Dof, Limb};
use serde::Serialize;

use crate::Editor;

/// One record: the figure after a command. World space, metres, degrees.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Report {
    /// The command as a script would write it; "start" for the starting pose.
    pub command: String,
    /// Whether a range, the reach or a contact stopped the command short.
    pub clamped: bool,
    /// Joints by bone.
    pub joints: BTreeMap<&'static str, JointReport>,
    /// Limbs by name.
    pub limbs: BTreeMap<&'static str, LimbReport>,
    /// Metres.
    pub center_of_mass: [f64; 3],
}

/// A joint in the world.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct JointReport {
    /// Metres.
    pub position: [f64; 3],
    /// Unit quaternion x, y, z, w; the identity at rest.
    pub rotation: [f64; 4],
    /// Degrees by degree of freedom; 0 for those that the joint lacks.
    pub angles: BTreeMap<&'static str, f64>,
}

/// A limb's contact and inverse parameters.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct LimbReport {
    /// "Free", "Point" or "Planted".
    pub contact: &'static str,
    /// Metres, world.
    pub articulator: [f64; 3],
    /// The command's goal if it is an inverse gesture on this limb, else the contact's target, else the articulator.
    pub target: [f64; 3],
    /// From articulator to target, metres.
    pub residual: f64,
    /// How far a planted end is turned from the rotation it keeps, degrees.
    pub rotation_residual: f64,
    /// Degrees in (-180, 180]; null where articulator and root coincide.
    pub elevation: Option<f64>,
    /// The feasible interval around the elevation, degrees; null if there is none.
    pub elevation_range: Option<[f64; 2]>,
    /// +1 or -1.
    pub branch: i8,
}

impl Report {
    /// The record of an editor's pose; `goal` is where an inverse gesture was to bring a limb.
    pub fn of(editor: &Editor, command: &str, goal: Option<(Limb, DVec3)>) -> Report {
        let evaluation = editor.evaluation();
        let joints = editor.figure().skeleton.joints().map(|joint| {
            let frame = evaluation.frames[joint.bone];
            (
                joint.bone.name(),
                JointReport {
                    position: frame.position.to_array(),
                    rotation: frame.rotation.to_array(),
                    angles: angles(editor, joint.bone),
                },
            )
        });
        let limbs = Limb::ALL.map(|limb| (limb.name(), limb_report(editor, limb, goal)));
        Report {
            command: command.to_owned(),
            clamped: false,
            joints: joints.collect(),
            limbs: limbs.into_iter().collect(),
            center_of_mass: evaluation.center_of_mass.to_array(),
        }
    }
}

fn angles(editor: &Editor, bone: Bone) -> BTreeMap<&'static str, f64> {
    let angles = editor.pose().angles(bone);
    Dof::ALL.map(|dof| (dof.name(), angles.get(dof))).into_iter().collect()
}

fn limb_report(editor: &Editor, limb: Limb, goal: Option<(Limb, DVec3)>) -> LimbReport {
    let view = editor.evaluation().limbs[limb.index()];
    let target = goal.filter(|(aimed, _)| *aimed == limb).map_or(view.target, |(_, at)| at);
    LimbReport {
        contact: match editor.pose().limb(limb).contact {
            Contact::Free => "Free",
            Contact::Point { .. } => "Point",
            Contact::Planted { .. } => "Planted",
        },
        articulator: view.articulator.to_array(),
        target: target.to_array(),
        residual: view.articulator.distance(target),
        rotation_residual: view.rotation_residual,
        elevation: view.elevation,
        elevation_range: view.elevation_range,
        branch: view.branch,
    }
}
