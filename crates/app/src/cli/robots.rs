//! Robots on the command line: inspected, checked, converted.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use edit::ChainDocument;
use interchange::urdf::figure_robot;
use rig::{Robot, RobotPose};
use serde::Serialize;
use serde_json::Value;

use super::{print, say, write_json};
use crate::failure::Failure;
use crate::load::{self, Kind};

/// Where a link is in the root link's frame.
#[derive(Serialize)]
struct LinkTold {
    /// Metres.
    position: [f64; 3],
    /// x, y, z, w, the w at least 0.
    rotation: [f64; 4],
}

/// How a joint stands.
#[derive(Serialize)]
struct JointTold {
    r#type: &'static str,
    parent: String,
    child: String,
    /// Radians or metres, followed joints as they follow; several for joints that move in several ways.
    value: Told,
    /// Radians or metres; absent where free.
    #[serde(skip_serializing_if = "Option::is_none")]
    lower: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    upper: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    mimic: Option<MimicTold>,
}

#[derive(Serialize)]
#[serde(untagged)]
enum Told {
    None(()),
    One(f64),
    Many(Vec<f64>),
}

#[derive(Serialize)]
struct MimicTold {
    joint: String,
    multiplier: f64,
    offset: f64,
}

#[derive(Serialize)]
struct RobotTold {
    robot: String,
    root: String,
    links: BTreeMap<String, LinkTold>,
    joints: BTreeMap<String, JointTold>,
}

/// Tells where the links of a robot are at joint values, a JSON object of radians and metres by joint. Without, a chain file's own
/// values count.
pub(super) fn inspect(path: &Path, json: bool, joints: Option<&str>) -> Result<(), Failure> {
    let (chain, warnings) = load::chain(path)?;
    warn(path, &warnings);
    let robot = chain.robot;
    let pose = match joints {
        Some(text) => given(&robot, text)?,
        None => chain.pose,
    };
    let told = told(&robot, &pose);
    if json { write_json(&told, Path::new("-")) } else { print(&table(&robot, &told)) }
}

/// Checks the file of a robot and tells what is odd about it.
pub(super) fn check(path: &Path) -> Result<(), Failure> {
    let (_, warnings) = load::chain(path)?;
    warn(path, &warnings);
    Ok(())
}

/// Writes a figure's skeleton, a robot or a chain as URDF or as a chain file. The meshes that it names are named from its new place.
pub(super) fn convert(path: &Path, to: &Path) -> Result<(), Failure> {
    if !matches!(Kind::of(to)?, Kind::Urdf | Kind::Chain) {
        let message = "a figure, a robot or a chain becomes a .urdf or a .chain.ron file";
        return Err(Failure::Usage(format!("{}: {message}", to.display())));
    }
    let document = match Kind::of(path)? {
        Kind::Figure => {
            let figure = load::figure(Some(path))?;
            let robot =
                figure_robot(&figure).map_err(|e| Failure::Input(format!("{}: {e}", path.display())))?;
            let rest = robot.rest();
            ChainDocument::of(Arc::new(robot), &rest)
        }
        Kind::Urdf | Kind::Chain => {
            let (editor, warnings) = load::open_chain(path)?;
            warn(path, &warnings);
            // What is written has nodes of its own.
            ChainDocument { urdf: None, ..editor.document().clone() }
        }
        _ => {
            let message = "this is converted to nothing; give a .figure.ron, .urdf or .chain.ron file";
            return Err(Failure::Input(format!("{}: {message}", path.display())));
        }
    };
    load::save_chain(&document, Some(path), to)
}

fn warn(path: &Path, warnings: &[String]) {
    for warning in warnings {
        say(&format!("{}: warning: {warning}", path.display()));
    }
}

/// The pose of a JSON object of values by joint.
fn given(robot: &Robot, text: &str) -> Result<RobotPose, Failure> {
    let values: BTreeMap<String, Value> = serde_json::from_str(text).map_err(|e| {
        Failure::Usage(format!(
            "--joints: {e}; expected an object such as '{{\"elbow\": 0.5}}', radians and metres"
        ))
    })?;
    let mut pose = robot.rest();
    for (name, value) in &values {
        let joint = robot.joint(name).ok_or_else(|| {
            let nearest = rig::nearest(name, robot.joints().iter().map(|j| &*j.name));
            let message = match nearest {
                "" => format!("joint \"{name}\" is not there: the robot has none"),
                near => format!("joint \"{name}\" is not there, did you mean \"{near}\"?"),
            };
            Failure::Input(format!("--joints: {message}"))
        })?;
        let slot = robot.slot(joint);
        let numbers = match value {
            Value::Number(n) => n.as_f64().map(|v| vec![v]),
            Value::Array(list) => list.iter().map(Value::as_f64).collect(),
            _ => None,
        };
        match numbers {
            Some(numbers) if numbers.len() == slot.len() => pose.0[slot].copy_from_slice(&numbers),
            _ => {
                let parts: Vec<&str> = robot.joints()[joint].kind.parts().iter().map(|p| p.name()).collect();
                let expected = match parts.as_slice() {
                    [] => "no value: it is fixed".to_owned(),
                    [one] => format!("one number: {one}"),
                    more => format!("[{}]", more.join(", ")),
                };
                return Err(Failure::Input(format!(
                    "--joints: joint \"{name}\" takes {expected}, not {value}"
                )));
            }
        }
    }
    Ok(robot.followed(&pose))
}

fn told(robot: &Robot, pose: &RobotPose) -> RobotTold {
    let frames = robot.frames(pose);
    let links = robot.links().iter().zip(&frames).map(|(link, frame)| {
        let rotation = if frame.rotation.w < 0.0 { -frame.rotation } else { frame.rotation };
        (link.name.clone(), LinkTold { position: frame.position.to_array(), rotation: rotation.to_array() })
    });
    let joints = robot.joints().iter().enumerate().map(|(i, joint)| {
        let range = joint.range();
        let finite = |v: f64| v.is_finite().then_some(v);
        let told = JointTold {
            r#type: joint.kind.name(),
            parent: joint.parent.clone(),
            child: joint.child.clone(),
            value: match robot.values(pose, i) {
                [] => Told::None(()),
                [one] => Told::One(*one),
                many => Told::Many(many.to_vec()),
            },
            lower: finite(range.min).filter(|_| !joint.kind.parts().is_empty()),
            upper: finite(range.max).filter(|_| !joint.kind.parts().is_empty()),
            mimic: joint.mimic.as_ref().map(|m| MimicTold {
                joint: m.master.clone(),
                multiplier: m.multiplier,
                offset: m.offset,
            }),
        };
        (joint.name.clone(), told)
    });
    RobotTold {
        robot: robot.name().to_owned(),
        root: robot.links().first().map(|l| l.name.clone()).unwrap_or_default(),
        links: links.collect(),
        joints: joints.collect(),
    }
}

/// The record for people: joints in degrees and millimetres, then links.
fn table(robot: &Robot, told: &RobotTold) -> String {
    use std::fmt::Write as _;
    let mut text = format!("{}\n\n", robot.name());
    let width = robot.joints().iter().map(|j| j.name.len()).chain(robot.links().iter().map(|l| l.name.len()));
    let width = width.max().unwrap_or(0);
    for joint in robot.joints().iter().filter(|j| !j.kind.parts().is_empty()) {
        let Some(stands) = told.joints.get(&joint.name) else { continue };
        let values = match &stands.value {
            Told::None(()) => Vec::new(),
            Told::One(one) => vec![*one],
            Told::Many(many) => many.clone(),
        };
        let number = |value: f64, angle: bool| {
            if angle { format!("{:.1}°", value.to_degrees()) } else { format!("{:.1} mm", value * 1000.0) }
        };
        let parts = joint.kind.parts();
        let shown: Vec<String> = values
            .iter()
            .zip(parts)
            .map(|(v, p)| format!("{} {}", p.name(), number(*v, p.is_angle())))
            .collect();
        let _ = write!(text, "{:width$}  {:10}  {}", joint.name, stands.r#type, shown.join("  "));
        if let (Some(lower), Some(upper)) = (stands.lower, stands.upper) {
            let angle = parts[0].is_angle();
            let _ = write!(text, "   from {} to {}", number(lower, angle), number(upper, angle));
        }
        if let Some(mimic) = &stands.mimic {
            let _ = write!(text, "   follows {}", mimic.joint);
        }
        text.push('\n');
    }
    text.push('\n');
    for link in robot.links() {
        let Some(LinkTold { position: [x, y, z], .. }) = told.links.get(&link.name) else { continue };
        let _ = writeln!(text, "{:width$}  at {x:8.4} {y:8.4} {z:8.4} m", link.name);
    }
    text
}
