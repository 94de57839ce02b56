//! A chain file's text as a chain.

use glam::{DQuat, DVec3};
use kin::{Frame, Interval};
use rig::{
    DofPart, Inertial, JointLimit, Mimic, Paint, Robot, RobotError, RobotJoint, RobotJointKind, RobotLink,
    RobotPose, RootMoves, Shape, Visual, rotation_of_rpy,
};

use super::file::{Base, File, Follows, Kind, Mode, NodeFile, Placed, Root, ShapeFile, Three, Values};
use super::{CHAIN_VERSION, ChainFile, ChainFileError};
use crate::Spot;
use crate::figure::keys;

/// The name of the root link where the file gives none.
const BASE: &str = "base";
/// How thick a rod is that the file doesn't describe, as a part of its length.
const ROD: f64 = 0.06;
/// Kilograms in a cubic metre, for the inertia of what has a mass.
const DENSITY: f64 = 1000.0;

/// Reads a chain file. `fetch` brings the URDF file that it names, if it does, relative to it, or says why not.
///
/// Also returns warnings: what is odd but does no harm.
///
/// # Errors
/// Malformed text, unknown fields, another version, nodes that are no tree, values and ranges that are none; each with its place.
pub fn read(
    text: &str,
    fetch: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>,
) -> Result<(ChainFile, Vec<String>), ChainFileError> {
    let located = |fault: rig::TextFault| ChainFileError {
        file: String::new(),
        spot: Spot { line: fault.line, column: fault.column },
        message: fault.message,
    };
    rig::check_version(text, CHAIN_VERSION).map_err(located)?;
    let file: File = rig::from_ron(text).map_err(located)?;
    let reader = Reader { text, file: &file };
    let mut warnings = Vec::new();
    let (robot, pose) = match (&file.urdf, &file.nodes) {
        (Some(_), Some(_)) => return Err(reader.fault(&["urdf"], "expected nodes or a urdf, not both")),
        (Some(name), None) => reader.named(name, fetch, &mut warnings)?,
        (None, Some(_)) => reader.own()?,
        (None, None) => return Err(reader.fault(&[], "missing field `nodes`, or a `urdf` instead")),
    };
    let chain = ChainFile {
        robot,
        pose,
        world_from_root: reader.world_from_root()?,
        root: reader.root()?,
        planar: file.mode == Mode::Planar,
        urdf: file.urdf.clone(),
    };
    warnings.extend(out_of_plane(&chain));
    Ok((chain, warnings))
}

/// Joints of a planar chain that leave its plane.
fn out_of_plane(chain: &ChainFile) -> Option<String> {
    if !chain.planar {
        return None;
    }
    let frames = chain.robot.frames(&RobotPose::default());
    let mut turning = chain.robot.joints().iter().enumerate().filter_map(|(i, joint)| {
        let turns = matches!(joint.kind, RobotJointKind::Revolute | RobotJointKind::Continuous);
        turns.then(|| (joint, frames[i + 1].vector(joint.axis)))
    });
    let (_, normal) = turning.next()?;
    let (joint, _) = turning.find(|(_, axis)| axis.dot(normal).abs() < 1.0 - 1e-9)?;
    Some(format!("the chain is planar, but joint \"{}\" turns about another axis than the first", joint.name))
}

/// A chain file on its way to a chain.
struct Reader<'a> {
    text: &'a str,
    file: &'a File,
}

type Made = Result<(Robot, RobotPose), ChainFileError>;

impl Reader<'_> {
    /// A fault of the value at that path of keys.
    fn fault(&self, path: &[&str], message: impl Into<String>) -> ChainFileError {
        let spot = keys::spot(self.text, path);
        ChainFileError { file: String::new(), spot, message: message.into() }
    }

    fn vector(&self, v: Three, path: &[&str]) -> Result<DVec3, ChainFileError> {
        let vector = DVec3::from(v);
        if vector.is_finite() { Ok(vector) } else { Err(self.fault(path, "expected three finite numbers")) }
    }

    fn rotation(&self, degrees: Option<Three>, path: &[&str]) -> Result<DQuat, ChainFileError> {
        let degrees = self.vector(degrees.unwrap_or_default(), path)?;
        Ok(rotation_of_rpy(degrees.to_array().map(f64::to_radians)))
    }

    fn world_from_root(&self) -> Result<Frame, ChainFileError> {
        let place = self.vector(self.file.place.unwrap_or_default(), &["place"])?;
        let turned = self.rotation(self.file.turned, &["turned"])?;
        Ok(Frame::new(Robot::WORLD_FROM_ROOT.rotation * turned, place))
    }

    fn root(&self) -> Result<RootMoves, ChainFileError> {
        match self.file.root {
            Root::Free => Ok(RootMoves::Free),
            Root::Held => Ok(RootMoves::Held),
            Root::Sideways(min, max) if min <= max => Ok(RootMoves::Sideways(Interval { min, max })),
            Root::Sideways(min, max) => {
                let message = format!("Sideways({min}, {max}), expected metres, the lower end first");
                Err(self.fault(&["root"], message))
            }
        }
    }

    /// The robot of a URDF file.
    fn named(
        &self,
        name: &str,
        fetch: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>,
        warnings: &mut Vec<String>,
    ) -> Made {
        for (given, field) in [(self.file.base.is_some(), "base"), (self.file.name.is_some(), "name")] {
            if given {
                return Err(self.fault(&[field], format!("{field} is said by the urdf")));
            }
        }
        let bytes = fetch(name).map_err(|e| self.fault(&["urdf"], format!("\"{name}\": {e}")))?;
        let inside = |spot, message: String| ChainFileError { file: name.to_owned(), spot, message };
        let text = std::str::from_utf8(&bytes).map_err(|e| {
            let valid = std::str::from_utf8(&bytes[..e.valid_up_to()]).unwrap_or_default();
            inside(Spot::at(valid, valid.len()), "this is not UTF-8 text".to_owned())
        })?;
        let (robot, told) = crate::urdf::read_robot(text).map_err(|e| inside(e.spot, e.fault.to_string()))?;
        warnings.extend(told.into_iter().map(|w| format!("{name}: {w}")));
        let mut pose = robot.rest();
        for (joint, values) in &self.file.values.0 {
            let path = ["values", joint.as_str()];
            let found = robot.joint(joint).ok_or_else(|| {
                let nearest = rig::nearest(joint, robot.joints().iter().map(|j| &*j.name));
                let message = format!("\"{name}\" has no joint \"{joint}\", did you mean \"{nearest}\"?");
                self.fault(&path, message)
            })?;
            self.set(&robot, &mut pose, found, values, &path)?;
        }
        let pose = robot.followed(&pose);
        Ok((robot, pose))
    }

    /// Sets the values of a joint from degrees and metres.
    fn set(
        &self,
        robot: &Robot,
        pose: &mut RobotPose,
        joint: usize,
        values: &Values,
        path: &[&str],
    ) -> Result<(), ChainFileError> {
        let parts = robot.joints()[joint].kind.parts();
        if values.0.len() != parts.len() || !values.0.iter().all(|v| v.is_finite()) {
            let names: Vec<&str> = parts.iter().map(|p| p.name()).collect();
            let expected = if names.is_empty() { "no value".to_owned() } else { names.join(", ") };
            let name = &robot.joints()[joint].name;
            return Err(self.fault(path, format!("joint \"{name}\" takes {expected}")));
        }
        for ((slot, value), part) in robot.slot(joint).zip(&values.0).zip(parts) {
            pose.0[slot] = if DofPart::is_angle(*part) { value.to_radians() } else { *value };
        }
        Ok(())
    }

    /// The robot of the file's own nodes.
    fn own(&self) -> Made {
        if !self.file.values.0.is_empty() {
            return Err(self.fault(&["values"], "values are for a urdf: a node has its own value"));
        }
        let default = Base::default();
        let base = self.file.base.as_ref().unwrap_or(&default);
        let root = base.name.clone().unwrap_or_else(|| BASE.to_owned());
        let looks = Looks {
            length: base.length,
            tip: base.tip,
            shape: base.shape.as_ref(),
            color: base.color,
            shapes: base.shapes.as_deref(),
            mass: base.mass,
        };
        let mut links = vec![self.link(&root, &looks, &["base"])?];
        let nodes = self.file.nodes.as_ref().map_or(&[][..], |n| &n.0);
        for (name, node) in nodes {
            links.push(self.link(name, &looks_of(node), &["nodes", name])?);
        }
        let mut joints: Vec<RobotJoint> = Vec::new();
        for (i, (name, node)) in nodes.iter().enumerate() {
            let before = i.checked_sub(1).map_or(root.as_str(), |i| &nodes[i].0);
            let parent = node.parent.as_deref().unwrap_or(before);
            // A parent that isn't there is named with what might have been meant when the tree is made.
            let end = links.iter().find(|l| l.name == parent).and_then(|l| l.tip);
            joints.push(self.joint(name, node, parent, end.unwrap_or_default())?);
        }
        let name = self.file.name.clone().unwrap_or_else(|| "chain".to_owned());
        let robot = Robot::new(name, links, joints).map_err(|e| self.located(&e))?;
        let mut pose = robot.rest();
        for (name, node) in nodes {
            let joint = robot.joint(node.joint_name.as_ref().unwrap_or(name));
            if let (Some(values), Some(joint)) = (&node.value, joint) {
                self.set(&robot, &mut pose, joint, values, &["nodes", name, "value"])?;
            }
        }
        let pose = robot.followed(&pose);
        Ok((robot, pose))
    }

    /// A fault of the robot at the node that it is about.
    fn located(&self, fault: &RobotError) -> ChainFileError {
        let nodes = self.file.nodes.as_ref().map_or(&[][..], |n| &n.0);
        let node = fault.subject().and_then(|(tag, name)| {
            let called = |(own, node): &&(String, NodeFile)| match tag {
                "joint" => node.joint_name.as_ref().unwrap_or(own) == name,
                _ => own == name,
            };
            nodes.iter().find(called)
        });
        let field = match fault {
            RobotError::UnknownLink { .. } | RobotError::Cycle { .. } => "parent",
            RobotError::Axis { .. } => "axis",
            RobotError::UnknownMaster { .. }
            | RobotError::MimicLoop { .. }
            | RobotError::MimicKind { .. } => "follows",
            _ => "joint_name",
        };
        match node {
            Some((name, _)) => self.fault(&["nodes", name, field], fault.to_string()),
            None => self.fault(&["nodes"], fault.to_string()),
        }
    }

    fn joint(
        &self,
        name: &str,
        node: &NodeFile,
        parent: &str,
        end: DVec3,
    ) -> Result<RobotJoint, ChainFileError> {
        let at = |field: &'static str| ["nodes", name, field];
        let place = match node.at {
            Some(place) => self.vector(place, &at("at"))?,
            None => end,
        };
        let kind = kind(node.joint, node.range.is_some());
        let range = match node.range {
            Some(_) if !kind.is_limited() => {
                return Err(self
                    .fault(&at("range"), format!("node \"{name}\": only hinges and sliders have a range")));
            }
            Some((min, max)) if min <= max => {
                let unit = |v: f64| if kind == RobotJointKind::Revolute { v.to_radians() } else { v };
                Interval { min: unit(min), max: unit(max) }
            }
            Some((min, max)) => {
                let message = format!("node \"{name}\": range ({min}, {max}), expected the lower end first");
                return Err(self.fault(&at("range"), message));
            }
            None => Interval::FREE,
        };
        Ok(RobotJoint {
            name: node.joint_name.clone().unwrap_or_else(|| name.to_owned()),
            kind,
            parent: parent.to_owned(),
            child: name.to_owned(),
            parent_from_joint: Frame::new(self.rotation(node.turned, &at("turned"))?, place),
            axis: match node.axis {
                Some(axis) => self.vector(axis, &at("axis"))?,
                None => DVec3::Y,
            },
            limit: kind.is_limited().then_some(JointLimit { range, effort: 0.0, velocity: 0.0 }),
            mimic: node.follows.as_ref().map(|Follows { joint, times, plus }| Mimic {
                master: joint.clone(),
                multiplier: *times,
                offset: if kind == RobotJointKind::Prismatic { *plus } else { plus.to_radians() },
            }),
        })
    }

    fn link(&self, name: &str, looks: &Looks<'_>, path: &[&str]) -> Result<RobotLink, ChainFileError> {
        let field = |field: &'static str| [path, &[field]].concat();
        let tip = match (looks.tip, looks.length) {
            (Some(_), Some(_)) => {
                return Err(
                    self.fault(&field("tip"), format!("\"{name}\": expected a length or a tip, not both"))
                );
            }
            (Some(tip), None) => self.vector(tip, &field("tip"))?,
            (None, Some(length)) if length >= 0.0 && length.is_finite() => DVec3::X * length,
            (None, Some(length)) => {
                let message = format!("\"{name}\": length {length}, expected metres, at least 0");
                return Err(self.fault(&field("length"), message));
            }
            (None, None) => DVec3::ZERO,
        };
        let mut visuals = Vec::new();
        match (looks.shape, looks.shapes) {
            (Some(_), Some(_)) => {
                let message = format!("\"{name}\": expected a shape or shapes, not both");
                return Err(self.fault(&field("shapes"), message));
            }
            (None, Some(shapes)) => {
                for placed in shapes {
                    visuals.push(self.placed(placed, tip, looks.color, &field("shapes"))?);
                }
            }
            (Some(shape), None) => visuals.push(visual(shape, tip, Frame::IDENTITY, looks.color)),
            (None, None) if tip != DVec3::ZERO => {
                visuals.push(visual(&ShapeFile::Rod(rod(tip)), tip, Frame::IDENTITY, looks.color));
            }
            (None, None) => {}
        }
        if let Some(mass) = looks.mass.filter(|m| !(*m >= 0.0 && m.is_finite())) {
            return Err(self.fault(&field("mass"), format!("\"{name}\": mass {mass}, expected kilograms")));
        }
        let inertial = looks.mass.map(|mass| inertial(mass, tip));
        Ok(RobotLink { name: name.to_owned(), visuals, collisions: Vec::new(), inertial, tip: Some(tip) })
    }

    fn placed(
        &self,
        placed: &Placed,
        tip: DVec3,
        color: Option<Three>,
        path: &[&str],
    ) -> Result<Visual, ChainFileError> {
        let at = self.vector(placed.at.unwrap_or_default(), path)?;
        let frame = Frame::new(self.rotation(placed.turned, path)?, at);
        Ok(visual(&placed.shape, tip, frame, placed.color.or(color)))
    }
}

/// What base and nodes say of a link.
struct Looks<'a> {
    length: Option<f64>,
    tip: Option<Three>,
    shape: Option<&'a ShapeFile>,
    color: Option<Three>,
    shapes: Option<&'a [Placed]>,
    mass: Option<f64>,
}

fn looks_of(node: &NodeFile) -> Looks<'_> {
    Looks {
        length: node.length,
        tip: node.tip,
        shape: node.shape.as_ref(),
        color: node.color,
        shapes: node.shapes.as_deref(),
        mass: node.mass,
    }
}

fn kind(kind: Kind, ranged: bool) -> RobotJointKind {
    match kind {
        Kind::Hinge if ranged => RobotJointKind::Revolute,
        Kind::Hinge => RobotJointKind::Continuous,
        Kind::Slider => RobotJointKind::Prismatic,
        Kind::Ball => RobotJointKind::Ball,
        Kind::Fixed => RobotJointKind::Fixed,
        Kind::Planar => RobotJointKind::Planar,
        Kind::Floating => RobotJointKind::Floating,
    }
}

fn visual(shape: &ShapeFile, tip: DVec3, at: Frame, color: Option<Three>) -> Visual {
    let (shape, frame) = match shape {
        ShapeFile::Rod(radius) => {
            (Shape::Capsule { radius: *radius, length: tip.length() }, at.then(along(tip)))
        }
        ShapeFile::Box(x, y, z) => (Shape::Box(DVec3::new(*x, *y, *z)), at),
        ShapeFile::Ball(radius) => (Shape::Sphere(*radius), at),
        ShapeFile::Cylinder { radius, length } => (Shape::Cylinder { radius: *radius, length: *length }, at),
        ShapeFile::Capsule { radius, length } => (Shape::Capsule { radius: *radius, length: *length }, at),
        ShapeFile::Mesh { file, scale } => {
            let scale = scale.map_or(DVec3::ONE, DVec3::from);
            (Shape::Mesh { file: file.clone(), scale, solid: None }, at)
        }
    };
    let paint = color.map(|(r, g, b)| Paint { name: String::new(), rgba: [r, g, b, 1.0] });
    Visual { name: None, link_from_visual: frame, shape, paint }
}

/// How thick a rod is that the file doesn't describe, in whole micrometres.
fn rod(tip: DVec3) -> f64 {
    (ROD * tip.length() * 1e6).round() / 1e6
}

/// The frame of a rod from a link's origin to its tip.
pub(super) fn along(tip: DVec3) -> Frame {
    let turn = tip.try_normalize().map_or(DQuat::IDENTITY, |to| DQuat::from_rotation_arc(DVec3::Z, to));
    Frame::new(turn, tip / 2.0)
}

/// A mass in the middle of a link, spread as in a ball of water.
fn inertial(mass: f64, tip: DVec3) -> Inertial {
    let radius = (mass / DENSITY * 3.0 / (4.0 * std::f64::consts::PI)).cbrt();
    let moment = 0.4 * mass * radius * radius;
    let link_from_inertia = Frame::new(DQuat::IDENTITY, tip / 2.0);
    Inertial { link_from_inertia, mass, inertia: [moment, 0.0, 0.0, moment, 0.0, moment] }
}
