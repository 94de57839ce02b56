//! What a chain comes to, as data for tests and scripts: the records of `--report`.

use std::collections::BTreeMap;

use serde::Serialize;

use super::document::{ChainOutcome, ChainReach};
use super::editor::ChainEditor;

/// One record: the chain after a command. World space, metres, degrees.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ChainReport {
    /// The command as a script would write it; "start" for the start.
    pub command: String,
    /// Whether a range stopped the command short, or a point did not get to its target.
    pub clamped: bool,
    /// Joints by name.
    pub joints: BTreeMap<String, ChainJointReport>,
    /// Links by name, in the world.
    pub links: BTreeMap<String, ChainLinkReport>,
    /// How a reach went; null for other commands.
    pub reach: Option<ReachReport>,
}

/// The values of a joint.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ChainJointReport {
    /// "revolute", "prismatic" and so on.
    pub kind: &'static str,
    /// By what each does ("turn", "slide", "x" …): degrees, or metres of what slides.
    pub values: BTreeMap<&'static str, f64>,
}

/// A link in the world.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ChainLinkReport {
    /// Metres.
    pub position: [f64; 3],
    /// Unit quaternion x, y, z, w.
    pub rotation: [f64; 4],
    /// Where it ends, metres.
    pub end: [f64; 3],
}

/// How a reach went.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct ReachReport {
    /// The link.
    pub link: String,
    /// World, metres.
    pub target: [f64; 3],
    /// Whether the point is within a ten-thousandth of the chain's length of it.
    pub reached: bool,
    /// Metres.
    pub residual: f64,
    /// Degrees; 0 if no rotation was asked for.
    pub rotation_residual: f64,
    /// Sweeps and steps taken.
    pub iterations: usize,
}

impl ChainReport {
    /// The record of a chain after a command with that outcome.
    pub fn of(editor: &ChainEditor, command: &str, outcome: &ChainOutcome) -> ChainReport {
        let document = editor.document();
        let robot = &document.robot;
        let links = robot.links().iter().zip(editor.frames()).enumerate().map(|(i, (link, frame))| {
            let report = ChainLinkReport {
                position: frame.position.to_array(),
                rotation: frame.rotation.to_array(),
                end: frame.point(robot.tip(i)).to_array(),
            };
            (link.name.clone(), report)
        });
        let mut joints: BTreeMap<String, ChainJointReport> = BTreeMap::new();
        for (dof, value) in robot.dofs().zip(&document.pose.0) {
            let joint = &robot.joints()[dof.joint];
            let report = joints
                .entry(joint.name.clone())
                .or_insert_with(|| ChainJointReport { kind: joint.kind.name(), values: BTreeMap::new() });
            let natural = if dof.part.is_angle() { value.to_degrees() } else { *value };
            report.values.insert(dof.part.name(), natural);
        }
        ChainReport {
            command: command.to_owned(),
            clamped: outcome.clamped,
            joints,
            links: links.collect(),
            reach: outcome.reach.as_ref().map(ReachReport::of),
        }
    }
}

impl ReachReport {
    fn of(reach: &ChainReach) -> ReachReport {
        ReachReport {
            link: reach.link.clone(),
            target: reach.target.to_array(),
            reached: reach.reached,
            residual: reach.residual_m,
            rotation_residual: reach.residual_deg,
            iterations: reach.iterations,
        }
    }
}
