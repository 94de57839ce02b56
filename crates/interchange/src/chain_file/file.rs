//! The chain file as it is written.

use std::fmt;

use serde::de::{Deserialize, Deserializer, Error, MapAccess, SeqAccess, Visitor};

use crate::figure::file::Unique;

/// Three numbers in a row.
pub type Three = (f64, f64, f64);

/// A chain file of version 1.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct File {
    #[serde(rename = "version")]
    _version: u32,
    #[serde(default)]
    pub name: Option<String>,
    #[serde(default)]
    pub mode: Mode,
    #[serde(default)]
    pub root: Root,
    #[serde(default)]
    pub place: Option<Three>,
    #[serde(default)]
    pub turned: Option<Three>,
    #[serde(default)]
    pub urdf: Option<String>,
    #[serde(default)]
    pub values: Unique<String, Values>,
    #[serde(default)]
    pub base: Option<Base>,
    #[serde(default)]
    pub nodes: Option<Nodes>,
}

/// Whether the chain moves in one plane.
#[derive(serde::Deserialize, Clone, Copy, PartialEq, Eq, Default)]
pub enum Mode {
    Planar,
    #[default]
    Spatial,
}

/// How the root may be moved.
#[derive(serde::Deserialize, Clone, Copy, Default)]
pub enum Root {
    #[default]
    Free,
    Sideways(f64, f64),
    Held,
}

/// The link that hangs on nothing.
#[derive(serde::Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
pub struct Base {
    pub name: Option<String>,
    pub length: Option<f64>,
    pub tip: Option<Three>,
    pub shape: Option<ShapeFile>,
    pub color: Option<Three>,
    pub shapes: Option<Vec<Placed>>,
    pub mass: Option<f64>,
}

/// A link and the joint that it hangs on.
#[derive(serde::Deserialize, Default)]
#[serde(deny_unknown_fields, default)]
pub struct NodeFile {
    pub parent: Option<String>,
    pub joint: Kind,
    pub joint_name: Option<String>,
    pub axis: Option<Three>,
    pub range: Option<(f64, f64)>,
    pub value: Option<Values>,
    pub follows: Option<Follows>,
    pub at: Option<Three>,
    pub turned: Option<Three>,
    pub length: Option<f64>,
    pub tip: Option<Three>,
    pub shape: Option<ShapeFile>,
    pub color: Option<Three>,
    pub shapes: Option<Vec<Placed>>,
    pub mass: Option<f64>,
}

/// How a node moves.
#[derive(serde::Deserialize, Clone, Copy, PartialEq, Eq, Default)]
pub enum Kind {
    #[default]
    Hinge,
    Slider,
    Ball,
    Fixed,
    Planar,
    Floating,
}

/// The joint that a joint follows.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Follows {
    pub joint: String,
    #[serde(default = "one")]
    pub times: f64,
    #[serde(default)]
    pub plus: f64,
}

fn one() -> f64 {
    1.0
}

/// A shape; a rod runs along its link.
#[derive(serde::Deserialize)]
pub enum ShapeFile {
    Rod(f64),
    Box(f64, f64, f64),
    Ball(f64),
    Cylinder {
        radius: f64,
        length: f64,
    },
    Capsule {
        radius: f64,
        length: f64,
    },
    Mesh {
        file: String,
        #[serde(default)]
        scale: Option<Three>,
    },
}

/// A shape somewhere on a link.
#[derive(serde::Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Placed {
    pub shape: ShapeFile,
    #[serde(default)]
    pub at: Option<Three>,
    #[serde(default)]
    pub turned: Option<Three>,
    #[serde(default)]
    pub color: Option<Three>,
}

/// Nodes by name, in the order of the file.
#[derive(Default)]
pub struct Nodes(pub Vec<(String, NodeFile)>);

impl<'de> Deserialize<'de> for Nodes {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Nodes, D::Error> {
        deserializer.deserialize_map(NodesVisitor)
    }
}

struct NodesVisitor;

impl<'de> Visitor<'de> for NodesVisitor {
    type Value = Nodes;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a map of nodes by name")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut access: A) -> Result<Nodes, A::Error> {
        let mut nodes = Vec::new();
        let mut names = std::collections::BTreeSet::new();
        while let Some(name) = access.next_key::<String>()? {
            if !names.insert(name.clone()) {
                return Err(A::Error::custom(format_args!("\"{name}\" is given twice")));
            }
            nodes.push((name, access.next_value()?));
        }
        Ok(Nodes(nodes))
    }
}

/// The values of a joint: one number, or several in a row.
#[derive(Clone, PartialEq, Debug)]
pub struct Values(pub Vec<f64>);

impl<'de> Deserialize<'de> for Values {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Values, D::Error> {
        deserializer.deserialize_any(ValuesVisitor)
    }
}

struct ValuesVisitor;

impl<'de> Visitor<'de> for ValuesVisitor {
    type Value = Values;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a number, or several as in (10, 0, -5)")
    }

    fn visit_f64<E: Error>(self, v: f64) -> Result<Values, E> {
        Ok(Values(vec![v]))
    }

    fn visit_i64<E: Error>(self, v: i64) -> Result<Values, E> {
        Ok(Values(vec![v as f64]))
    }

    fn visit_u64<E: Error>(self, v: u64) -> Result<Values, E> {
        Ok(Values(vec![v as f64]))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut access: A) -> Result<Values, A::Error> {
        let mut values = Vec::new();
        while let Some(value) = access.next_element()? {
            values.push(value);
        }
        Ok(Values(values))
    }
}
