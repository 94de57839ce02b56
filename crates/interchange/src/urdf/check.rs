//! Looks over the outline of a URDF file for what `urdf-rs` would report without saying where, or let pass.

use std::collections::BTreeSet;

use super::outline::{Attribute, Element};
use super::{UrdfError, UrdfFault};
use crate::Spot;

/// What a number attribute holds.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    One,
    Three,
    Four,
}

const SHAPES: [&str; 5] = ["box", "cylinder", "capsule", "sphere", "mesh"];
const TYPES: [&str; 7] = ["revolute", "continuous", "prismatic", "fixed", "floating", "planar", "spherical"];

/// Checks names, numbers and the parts that no joint or link may lack.
pub fn check(text: &str, outline: &[Element<'_>]) -> Result<(), UrdfError> {
    let spot = |at| Spot::at(text, at);
    if outline[0].name != "robot" {
        let found = format!("the root element is <{}>, expected <robot>", outline[0].name);
        return Err(UrdfFault::Syntax(found).at(spot(outline[0].at)));
    }
    let mut names = BTreeSet::new();
    for (i, element) in outline.iter().enumerate() {
        if !read(outline, i) {
            continue;
        }
        for attribute in &element.attributes {
            number(outline, i, attribute).map_err(|fault| fault.at(spot(attribute.at)))?;
        }
        single(outline, i).map_err(|fault| fault.at(spot(element.at)))?;
        required(outline, i).map_err(|fault| fault.at(spot(element.at)))?;
        let tag = match element.name {
            "link" => "link",
            "joint" => "joint",
            _ => continue,
        };
        let name = element.attribute("name").unwrap_or_default();
        if element.parent == Some(0) && !names.insert((tag, name)) {
            return Err(UrdfFault::Twice { tag, name: name.to_owned() }.at(spot(element.at)));
        }
    }
    Ok(())
}

/// Whether an element is one that is read: simulators and planners add elements of their own, some by the same names.
fn read(outline: &[Element<'_>], i: usize) -> bool {
    let Some(parent) = outline[i].parent else { return true };
    let known: &[&str] = match outline[parent].name {
        "robot" => &["link", "joint", "material"],
        "link" => &["inertial", "visual", "collision"],
        "inertial" => &["origin", "mass", "inertia"],
        "visual" | "collision" => &["origin", "geometry", "material"],
        "geometry" => &SHAPES,
        "material" => &["color", "texture"],
        "joint" => &[
            "origin",
            "parent",
            "child",
            "axis",
            "limit",
            "mimic",
            "dynamics",
            "calibration",
            "safety_controller",
        ],
        _ => &[],
    };
    known.contains(&outline[i].name) && read(outline, parent)
}

/// The first text between elements that are read, where none has a meaning.
pub fn stray(outline: &[Element<'_>]) -> Option<(usize, UrdfFault)> {
    let found = (0..outline.len()).filter(|&i| read(outline, i)).find_map(|i| Some((i, outline[i].stray?)));
    found.map(|(i, at)| {
        let message = format!("{}: text between elements, expected none", described(outline, i));
        (at, UrdfFault::Syntax(message))
    })
}

/// An element of which there may be one beside another of its tag.
fn single(outline: &[Element<'_>], i: usize) -> Result<(), UrdfFault> {
    let element = &outline[i];
    let Some(parent) = element.parent.filter(|p| *p > 0) else { return Ok(()) };
    if matches!(element.name, "visual" | "collision") {
        return Ok(());
    }
    let before = &outline[parent + 1..i];
    if before.iter().any(|e| e.parent == Some(parent) && e.name == element.name) {
        let message = format!("{}: <{}> is given twice", described(outline, parent), element.name);
        return Err(UrdfFault::Syntax(message));
    }
    Ok(())
}

/// How a message calls an element: with the joint or link that it is in.
fn described(outline: &[Element<'_>], i: usize) -> String {
    let element = &outline[i];
    let mut owner = Some(i);
    while let Some(o) = owner {
        if let ("joint" | "link", Some(name)) = (outline[o].name, outline[o].attribute("name")) {
            let owner_name = format!("{} \"{name}\"", outline[o].name);
            return if o == i { owner_name } else { format!("{owner_name}, <{}>", element.name) };
        }
        owner = outline[o].parent;
    }
    format!("<{}>", element.name)
}

fn kind(element: &str, attribute: &str) -> Option<Kind> {
    match (element, attribute) {
        ("origin", "xyz" | "rpy") | ("axis", "xyz") | ("box", "size") | ("mesh", "scale") => {
            Some(Kind::Three)
        }
        ("origin", "quat_xyzw") | ("color", "rgba") => Some(Kind::Four),
        ("mass", "value")
        | ("inertia", "ixx" | "ixy" | "ixz" | "iyy" | "iyz" | "izz")
        | ("limit", "lower" | "upper" | "effort" | "velocity")
        | ("mimic", "multiplier" | "offset")
        | ("cylinder" | "capsule", "radius" | "length")
        | ("sphere", "radius")
        | ("dynamics", "damping" | "friction")
        | ("calibration", "rising" | "falling")
        | ("safety_controller", "soft_lower_limit" | "soft_upper_limit" | "k_position" | "k_velocity") => {
            Some(Kind::One)
        }
        _ => None,
    }
}

fn number(outline: &[Element<'_>], i: usize, attribute: &Attribute<'_>) -> Result<(), UrdfFault> {
    let Some(kind) = kind(outline[i].name, attribute.name) else { return Ok(()) };
    let words: Vec<_> = attribute.value.split_whitespace().map(str::parse::<f64>).collect();
    let (count, expected) = match kind {
        Kind::One => (1, "one finite number"),
        Kind::Three => (3, "three finite numbers"),
        Kind::Four => (4, "four finite numbers"),
    };
    let finite = words.iter().all(|w| w.as_ref().is_ok_and(|v| v.is_finite()));
    if finite && words.len() == count {
        return Ok(());
    }
    Err(UrdfFault::Value {
        element: described(outline, i),
        attribute: attribute.name.to_owned(),
        found: attribute.value.chars().take(60).collect(),
        expected,
    })
}

fn required(outline: &[Element<'_>], i: usize) -> Result<(), UrdfFault> {
    let element = &outline[i];
    let missing =
        |what: &str| UrdfFault::Missing { element: described(outline, i), missing: what.to_owned() };
    let inside = || outline[i + 1..].iter().take_while(|e| e.parent.is_some_and(|p| p >= i));
    let child = |tag: &str| inside().any(|e| e.parent == Some(i) && e.name == tag);
    let attributes: &[&str] = match (element.name, element.parent) {
        ("link", Some(0)) => &["name"],
        ("joint", Some(0)) => &["name", "type"],
        ("parent" | "child", _) => &["link"],
        ("mass", _) => &["value"],
        ("inertia", _) => &["ixx", "ixy", "ixz", "iyy", "iyz", "izz"],
        ("axis", _) => &["xyz"],
        ("limit", _) => &["velocity"],
        ("safety_controller", _) => &["k_velocity"],
        ("mimic", _) => &["joint"],
        ("box", _) => &["size"],
        ("cylinder" | "capsule", _) => &["radius", "length"],
        ("sphere", _) => &["radius"],
        ("mesh" | "texture", _) => &["filename"],
        ("material", _) => &["name"],
        ("color", _) => &["rgba"],
        _ => &[],
    };
    if let Some(name) = attributes.iter().find(|name| element.attribute(name).is_none()) {
        return Err(missing(&format!("attribute {name}")));
    }
    let children: &[&str] = match element.name {
        "inertial" => &["mass", "inertia"],
        "visual" | "collision" => &["geometry"],
        _ => &[],
    };
    if let Some(tag) = children.iter().find(|tag| !child(tag)) {
        return Err(missing(&format!("<{tag}>")));
    }
    if element.name == "geometry" && !SHAPES.iter().any(|tag| child(tag)) {
        return Err(missing(&format!("shape, expected one of <{}>", SHAPES.join(">, <"))));
    }
    if element.name != "joint" || element.parent != Some(0) {
        return Ok(());
    }
    let found = element.attribute("type").unwrap_or_default();
    if !TYPES.contains(&found) {
        return Err(UrdfFault::Value {
            element: described(outline, i),
            attribute: "type".to_owned(),
            found: found.chars().take(60).collect(),
            expected: "revolute, continuous, prismatic, fixed, floating or planar",
        });
    }
    let limit: &[&str] = if matches!(found, "revolute" | "prismatic") {
        &["parent", "child", "limit"]
    } else {
        &["parent", "child"]
    };
    match limit.iter().find(|tag| !child(tag)) {
        Some(tag) => Err(missing(&format!("<{tag}>"))),
        None => Ok(()),
    }
}
