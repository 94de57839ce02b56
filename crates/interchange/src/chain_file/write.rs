//! A chain as the text of a chain file.

use std::fmt::Write as _;

use glam::{DQuat, DVec3};
use kin::Frame;
use rig::{DofPart, Robot, RobotJointKind, RobotLink, RootMoves, Shape, Visual, rpy_of_rotation};

use super::read::along;
use super::{CHAIN_VERSION, ChainFile};

/// Writes a chain: what [`read`](super::read) reads back as the same chain, angles to a billionth of a degree.
///
/// Left out of nodes, since a chain file has no word for them: names of visuals and materials, opacity, what bumps into things, how a
/// mass is spread, how strong and fast joints are.
pub fn write(chain: &ChainFile) -> String {
    let mut text = format!("(\n    version: {CHAIN_VERSION},\n");
    if chain.urdf.is_none() {
        let _ = writeln!(text, "    name: {:?},", chain.robot.name());
    }
    if chain.planar {
        text += "    mode: Planar,\n";
    }
    match chain.root {
        RootMoves::Free => {}
        RootMoves::Held => text += "    root: Held,\n",
        RootMoves::Sideways(range) => {
            let _ = writeln!(text, "    root: Sideways({}, {}),", number(range.min), number(range.max));
        }
    }
    if chain.world_from_root.position != DVec3::ZERO {
        let _ = writeln!(text, "    place: {},", vector(chain.world_from_root.position));
    }
    let turned = Robot::WORLD_FROM_ROOT.rotation.conjugate() * chain.world_from_root.rotation;
    if let Some(turned) = rotation(turned) {
        let _ = writeln!(text, "    turned: {turned},");
    }
    match &chain.urdf {
        Some(urdf) => named(&mut text, chain, urdf),
        None => own(&mut text, chain),
    }
    text + ")\n"
}

fn named(text: &mut String, chain: &ChainFile, urdf: &str) {
    let _ = writeln!(text, "    urdf: {urdf:?},");
    let moved: Vec<String> = (0..chain.robot.joints().len())
        .filter_map(|joint| {
            Some(format!("        {:?}: {},\n", chain.robot.joints()[joint].name, values(chain, joint)?))
        })
        .collect();
    if !moved.is_empty() {
        let _ = writeln!(text, "    values: {{\n{}    }},", moved.concat());
    }
}

fn own(text: &mut String, chain: &ChainFile) {
    let robot = &chain.robot;
    if let Some(root) = robot.links().first() {
        let mut fields = vec![format!("name: {:?}", root.name)];
        link_fields(&mut fields, root, robot.tip(0));
        let _ = writeln!(text, "    base: ({}),", fields.join(", "));
    }
    text.push_str("    nodes: {\n");
    for joint in 0..robot.joints().len() {
        let name = &robot.joints()[joint].child;
        let _ = writeln!(text, "        {name:?}: ({}),", node(chain, joint).join(", "));
    }
    text.push_str("    },\n");
}

/// The fields of a node; what reads back the same without is left out.
fn node(chain: &ChainFile, i: usize) -> Vec<String> {
    let robot = &chain.robot;
    let joint = &robot.joints()[i];
    let carrier = robot.carrier(i).unwrap_or(0);
    let mut fields = Vec::new();
    if carrier != i {
        fields.push(format!("parent: {:?}", joint.parent));
    }
    let kind = match joint.kind {
        RobotJointKind::Revolute | RobotJointKind::Continuous => None,
        RobotJointKind::Prismatic => Some("Slider"),
        RobotJointKind::Ball => Some("Ball"),
        RobotJointKind::Fixed => Some("Fixed"),
        RobotJointKind::Planar => Some("Planar"),
        RobotJointKind::Floating => Some("Floating"),
    };
    fields.extend(kind.map(|kind| format!("joint: {kind}")));
    if joint.name != joint.child {
        fields.push(format!("joint_name: {:?}", joint.name));
    }
    if joint.parent_from_joint.position != robot.tip(carrier) {
        fields.push(format!("at: {}", vector(joint.parent_from_joint.position)));
    }
    fields.extend(rotation(joint.parent_from_joint.rotation).map(|turned| format!("turned: {turned}")));
    if joint.kind.has_axis() && joint.axis != DVec3::Y {
        fields.push(format!("axis: {}", vector(joint.axis)));
    }
    let range = joint.range();
    if joint.kind.is_limited() && (range.min.is_finite() || range.max.is_finite()) {
        let unit = |v: f64| if joint.kind == RobotJointKind::Revolute { degrees(v) } else { number(v) };
        fields.push(format!("range: ({}, {})", unit(range.min), unit(range.max)));
    }
    match &joint.mimic {
        Some(mimic) => {
            let angle = joint.kind != RobotJointKind::Prismatic;
            let plus = if angle { degrees(mimic.offset) } else { number(mimic.offset) };
            let times = number(mimic.multiplier);
            fields.push(format!("follows: (joint: {:?}, times: {times}, plus: {plus})", mimic.master));
        }
        None => fields.extend(values(chain, i).map(|values| format!("value: {values}"))),
    }
    link_fields(&mut fields, &robot.links()[i + 1], robot.tip(i + 1));
    fields
}

/// The values of a joint; nothing where all are 0 or follow another joint.
fn values(chain: &ChainFile, joint: usize) -> Option<String> {
    let values = chain.robot.values(&chain.pose, joint);
    if values.iter().all(|v| *v == 0.0) || chain.robot.master(joint).is_some() {
        return None;
    }
    let parts = chain.robot.joints()[joint].kind.parts();
    let unit = |(v, part): (&f64, &DofPart)| if part.is_angle() { degrees(*v) } else { number(*v) };
    let told: Vec<String> = values.iter().zip(parts).map(unit).collect();
    Some(if told.len() == 1 { told.concat() } else { format!("({})", told.join(", ")) })
}

fn link_fields(fields: &mut Vec<String>, link: &RobotLink, tip: DVec3) {
    if tip == DVec3::X * tip.x && tip.x > 0.0 {
        fields.push(format!("length: {}", number(tip.x)));
    } else if tip != DVec3::ZERO {
        fields.push(format!("tip: {}", vector(tip)));
    }
    match link.visuals.as_slice() {
        [] if tip == DVec3::ZERO => {}
        [only] if is_rod(only, tip) => {
            if let Shape::Capsule { radius, .. } = only.shape {
                fields.push(format!("shape: Rod({})", number(radius)));
            }
            fields.extend(color(only).map(|color| format!("color: {color}")));
        }
        visuals => {
            let shapes: Vec<String> = visuals.iter().map(placed).collect();
            fields.push(format!("shapes: [{}]", shapes.join(", ")));
        }
    }
    if let Some(inertial) = &link.inertial {
        fields.push(format!("mass: {}", number(inertial.mass)));
    }
}

fn is_rod(visual: &Visual, tip: DVec3) -> bool {
    let long = matches!(visual.shape, Shape::Capsule { length, .. } if length == tip.length());
    let there = visual.link_from_visual;
    let rod = along(tip);
    long && there.position.abs_diff_eq(rod.position, 1e-12)
        && there.rotation.dot(rod.rotation).abs() > 1.0 - 1e-14
}

fn placed(visual: &Visual) -> String {
    let shape = match &visual.shape {
        Shape::Box(e) => format!("Box({}, {}, {})", number(e.x), number(e.y), number(e.z)),
        Shape::Sphere(radius) => format!("Ball({})", number(*radius)),
        Shape::Cylinder { radius, length } => {
            format!("Cylinder(radius: {}, length: {})", number(*radius), number(*length))
        }
        Shape::Capsule { radius, length } => {
            format!("Capsule(radius: {}, length: {})", number(*radius), number(*length))
        }
        Shape::Mesh { file, scale, .. } if *scale == DVec3::ONE => format!("Mesh(file: {file:?})"),
        Shape::Mesh { file, scale, .. } => format!("Mesh(file: {file:?}, scale: {})", vector(*scale)),
    };
    let Frame { rotation: turn, position } = visual.link_from_visual;
    let mut fields = vec![format!("shape: {shape}")];
    if position != DVec3::ZERO {
        fields.push(format!("at: {}", vector(position)));
    }
    fields.extend(rotation(turn).map(|turned| format!("turned: {turned}")));
    fields.extend(color(visual).map(|color| format!("color: {color}")));
    format!("({})", fields.join(", "))
}

fn color(visual: &Visual) -> Option<String> {
    let [r, g, b, _] = visual.paint.as_ref()?.rgba;
    Some(vector(DVec3::new(r, g, b)))
}

/// A number as short as it reads back the same.
fn number(v: f64) -> String {
    match v {
        0.0 => "0".to_owned(),
        f64::INFINITY => "inf".to_owned(),
        f64::NEG_INFINITY => "-inf".to_owned(),
        v => v.to_string(),
    }
}

/// Degrees of an angle in radians. Those of whole degrees come out whole: what lies below 1e-9 is rounding.
fn degrees(rad: f64) -> String {
    number((rad.to_degrees() * 1e9).round() / 1e9)
}

fn vector(v: DVec3) -> String {
    format!("({}, {}, {})", number(v.x), number(v.y), number(v.z))
}

/// Roll, pitch and yaw in degrees; nothing for no turn.
fn rotation(turn: DQuat) -> Option<String> {
    let rpy = rpy_of_rotation(turn).map(degrees);
    rpy.iter().any(|v| v != "0").then(|| format!("({})", rpy.join(", ")))
}
