//! A robot as the text of a URDF file.

use std::fmt::Write as _;

use kin::Frame;
use rig::{Robot, RobotJoint, RobotLink, Shape, Visual, rpy_of_rotation};

/// Writes a robot: what [`read_robot`](super::read_robot) reads back as the same robot, numbers to 1e-12.
///
/// Meshes are named and not written. Where a limit has no end the file says version 1.2, in which that can be said.
pub fn write_robot(robot: &Robot) -> String {
    let mut text = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let open = |j: &RobotJoint| {
        let range = j.range();
        j.kind.is_limited() && !(range.min.is_finite() && range.max.is_finite())
    };
    let version = if robot.joints().iter().any(open) { " version=\"1.2\"" } else { "" };
    let _ = writeln!(text, "<robot name=\"{}\"{version}>", escaped(robot.name()));
    for (i, link) in robot.links().iter().enumerate() {
        if let Some(joint) = i.checked_sub(1).map(|j| &robot.joints()[j]) {
            write_joint(&mut text, joint);
        }
        write_link(&mut text, link);
    }
    text + "</robot>\n"
}

fn escaped(name: &str) -> String {
    let mut text = String::new();
    for c in name.chars() {
        match c {
            '&' => text += "&amp;",
            '<' => text += "&lt;",
            '>' => text += "&gt;",
            '"' => text += "&quot;",
            _ => text.push(c),
        }
    }
    text
}

/// Numbers with spaces between, each as short as it reads back the same.
fn numbers(values: &[f64]) -> String {
    let number = |v: &f64| if *v == 0.0 { "0".to_owned() } else { v.to_string() };
    values.iter().map(number).collect::<Vec<_>>().join(" ")
}

fn origin(frame: &Frame) -> String {
    if *frame == Frame::IDENTITY {
        return String::new();
    }
    let rpy = rpy_of_rotation(frame.rotation).map(plain);
    format!("<origin xyz=\"{}\" rpy=\"{}\"/>", numbers(&frame.position.to_array()), numbers(&rpy))
}

/// An angle without the rounding of quaternions: whole degrees are whole, others have 14 places.
fn plain(rad: f64) -> f64 {
    let degrees = rad.to_degrees();
    let whole = degrees.round();
    if (degrees - whole).abs() < 1e-11 { whole.to_radians() } else { (rad * 1e14).round() / 1e14 }
}

fn line(text: &mut String, indent: usize, content: &str) {
    if !content.is_empty() {
        let _ = writeln!(text, "{:indent$}{content}", "");
    }
}

fn write_link(text: &mut String, link: &RobotLink) {
    let name = escaped(&link.name);
    if link.visuals.is_empty() && link.collisions.is_empty() && link.inertial.is_none() {
        return line(text, 2, &format!("<link name=\"{name}\"/>"));
    }
    line(text, 2, &format!("<link name=\"{name}\">"));
    if let Some(inertial) = &link.inertial {
        line(text, 4, "<inertial>");
        line(text, 6, &origin(&inertial.link_from_inertia));
        line(text, 6, &format!("<mass value=\"{}\"/>", numbers(&[inertial.mass])));
        let names = ["ixx", "ixy", "ixz", "iyy", "iyz", "izz"].into_iter().zip(&inertial.inertia);
        let parts: Vec<String> = names.map(|(n, v)| format!("{n}=\"{}\"", numbers(&[*v]))).collect();
        line(text, 6, &format!("<inertia {}/>", parts.join(" ")));
        line(text, 4, "</inertial>");
    }
    for (tag, shapes) in [("visual", &link.visuals), ("collision", &link.collisions)] {
        shapes.iter().for_each(|shape| write_shape(text, tag, shape));
    }
    line(text, 2, "</link>");
}

fn write_shape(text: &mut String, tag: &str, visual: &Visual) {
    let name = visual.name.as_ref().map_or(String::new(), |n| format!(" name=\"{}\"", escaped(n)));
    line(text, 4, &format!("<{tag}{name}>"));
    line(text, 6, &origin(&visual.link_from_visual));
    let shape = match &visual.shape {
        Shape::Box(edges) => format!("<box size=\"{}\"/>", numbers(&edges.to_array())),
        Shape::Cylinder { radius, length } => {
            format!("<cylinder radius=\"{}\" length=\"{}\"/>", numbers(&[*radius]), numbers(&[*length]))
        }
        Shape::Capsule { radius, length } => {
            format!("<capsule radius=\"{}\" length=\"{}\"/>", numbers(&[*radius]), numbers(&[*length]))
        }
        Shape::Sphere(radius) => format!("<sphere radius=\"{}\"/>", numbers(&[*radius])),
        Shape::Mesh { file, scale, .. } if *scale == glam::DVec3::ONE => {
            format!("<mesh filename=\"{}\"/>", escaped(file))
        }
        Shape::Mesh { file, scale, .. } => {
            format!("<mesh filename=\"{}\" scale=\"{}\"/>", escaped(file), numbers(&scale.to_array()))
        }
    };
    line(text, 6, &format!("<geometry>{shape}</geometry>"));
    if let Some(paint) = &visual.paint {
        let (name, rgba) = (escaped(&paint.name), numbers(&paint.rgba));
        line(text, 6, &format!("<material name=\"{name}\"><color rgba=\"{rgba}\"/></material>"));
    }
    line(text, 4, &format!("</{tag}>"));
}

fn write_joint(text: &mut String, joint: &RobotJoint) {
    line(text, 2, &format!("<joint name=\"{}\" type=\"{}\">", escaped(&joint.name), joint.kind.name()));
    line(text, 4, &origin(&joint.parent_from_joint));
    line(text, 4, &format!("<parent link=\"{}\"/>", escaped(&joint.parent)));
    line(text, 4, &format!("<child link=\"{}\"/>", escaped(&joint.child)));
    if joint.kind.has_axis() {
        line(text, 4, &format!("<axis xyz=\"{}\"/>", numbers(&joint.axis.to_array())));
    }
    if let Some(limit) = &joint.limit {
        let mut parts = String::new();
        let ends = [("lower", limit.range.min), ("upper", limit.range.max)];
        for (name, end) in ends.into_iter().filter(|(_, end)| joint.kind.is_limited() && end.is_finite()) {
            let _ = write!(parts, "{name}=\"{}\" ", numbers(&[end]));
        }
        let (effort, velocity) = (numbers(&[limit.effort]), numbers(&[limit.velocity]));
        line(text, 4, &format!("<limit {parts}effort=\"{effort}\" velocity=\"{velocity}\"/>"));
    }
    if let Some(mimic) = &joint.mimic {
        let (multiplier, offset) = (numbers(&[mimic.multiplier]), numbers(&[mimic.offset]));
        let master = escaped(&mimic.master);
        line(
            text,
            4,
            &format!("<mimic joint=\"{master}\" multiplier=\"{multiplier}\" offset=\"{offset}\"/>"),
        );
    }
    line(text, 2, "</joint>");
}
