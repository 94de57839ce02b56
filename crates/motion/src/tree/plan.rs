//! The plan of a blend tree: what a `*.blend.ron` file says, an editable value that knows clips by their names.

use rig::{Bone, Part, TextFault, check_version};
use serde::de::{SeqAccess, Visitor};
use serde::ser::SerializeTuple;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::check::check;
use super::places::PlanFault;
use crate::{Feather, Parameter, PlacementSettings};

/// The newest version of blend tree files.
pub const BLEND_VERSION: u32 = 1;

/// The plan of a blend tree.
#[derive(Clone, PartialEq, Debug)]
pub struct Plan {
    /// The outermost node.
    pub root: PlanNode,
}

/// A node of a plan. Speeds, times and rates of turning are those of the figure that the clips were made with.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum PlanNode {
    /// Plays a clip.
    Clip {
        /// The clip's name.
        name: String,
        /// How fast, as a multiple of its own pace; negative: from its end to its start (no strides).
        #[serde(default = "one", skip_serializing_if = "is_one")]
        pace: f64,
        /// Whether left and right are exchanged.
        #[serde(default, skip_serializing_if = "is_false")]
        mirrored: bool,
        /// Degrees a second that the figure turns to its left besides.
        #[serde(default, skip_serializing_if = "is_zero")]
        turn: f64,
    },
    /// An axis blend: between the points of the cell in which the parameters lie.
    Blend {
        /// One to three parameters.
        by: Vec<Parameter>,
        /// What there is at which values of them.
        points: Vec<(At, PlanNode)>,
        /// The cells, as indices of points; a triangulation if not given.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        cells: Option<Vec<Vec<usize>>>,
    },
    /// From one node to another as a parameter grows.
    Crossfade {
        /// The parameter.
        by: Parameter,
        /// Where it begins and where it is complete.
        over: (f64, f64),
        /// What there is below.
        from: Box<PlanNode>,
        /// What there is above.
        to: Box<PlanNode>,
        /// How.
        #[serde(default)]
        feather: Feather,
    },
    /// Adds the difference between two nodes to a third; the hips' place and the angles of all joints.
    Additive {
        /// What is added to: its travel and how its feet bear are kept.
        base: Box<PlanNode>,
        /// What is added.
        layer: Box<PlanNode>,
        /// What the layer is a change of; if not given, rest, and the hips keep the base's place.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        less: Option<Box<PlanNode>>,
        /// How much, 0 to 1.
        #[serde(default = "one", skip_serializing_if = "is_one")]
        amount: f64,
        /// A parameter and the value at which the amount is reached; it grows with the parameter, to the
        /// other side too.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        by: Option<(Parameter, f64)>,
    },
    /// A layer over some parts of the body. The hips' place is that of the base.
    Mask {
        /// The whole body.
        base: Box<PlanNode>,
        /// What some parts do instead.
        layer: Box<PlanNode>,
        /// These parts …
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        parts: Vec<Part>,
        /// … and these bones.
        #[serde(default, skip_serializing_if = "Vec::is_empty")]
        bones: Vec<Bone>,
        /// How much, 0 to 1.
        #[serde(default = "one", skip_serializing_if = "is_one")]
        amount: f64,
    },
    /// The mirror image; strides begin with the other foot.
    Mirror {
        /// Of what.
        node: Box<PlanNode>,
    },
    /// Places the feet on the ground: the outermost node if there is one.
    FootPlacement {
        /// Of what.
        node: Box<PlanNode>,
        /// How.
        #[serde(default, skip_serializing_if = "is_default")]
        settings: PlacementSettings,
    },
    /// One state at a time, and timed transitions between them.
    States {
        /// The state at the start.
        initial: String,
        /// States by name.
        states: Vec<(String, PlanNode)>,
        /// The first that fits is taken, also during another.
        #[serde(default)]
        transitions: Vec<Transition>,
    },
}

/// A timed way from one state to another.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Transition {
    /// A state's name.
    pub from: String,
    /// Another's.
    pub to: String,
    /// All of these must hold, at least one.
    pub when: Vec<Condition>,
    /// How long it takes.
    pub secs: f64,
    /// How it goes. Linear ones change pace suddenly, the others don't.
    #[serde(default)]
    pub feather: Feather,
}

/// What a transition waits for.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub enum Condition {
    /// A parameter is greater than a value.
    Above(Parameter, f64),
    /// A parameter is less than a value.
    Below(Parameter, f64),
    /// The figure is asked to sit.
    Sit,
    /// The figure is not asked to sit.
    Stand,
    /// Every clip of the state that doesn't loop ends in this time at most, seconds; never, if there is none.
    EndsWithin(f64),
}

/// Values of one to three parameters: `1.4` or `(1.4, 0.0)`.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct At {
    values: [f64; 3],
    count: usize,
}

impl At {
    /// Up to three values; more are left out.
    pub fn new(values: &[f64]) -> At {
        let count = values.len().min(3);
        let mut at = At { values: [0.0; 3], count };
        at.values[..count].copy_from_slice(&values[..count]);
        at
    }

    /// The values.
    pub fn values(&self) -> &[f64] {
        &self.values[..self.count]
    }

    /// The values, and 0 for what is missing of three.
    pub fn padded(&self) -> [f64; 3] {
        self.values
    }
}

impl Serialize for At {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        if let [value] = self.values() {
            return serializer.serialize_f64(*value);
        }
        let mut tuple = serializer.serialize_tuple(self.count)?;
        for value in self.values() {
            tuple.serialize_element(value)?;
        }
        tuple.end()
    }
}

impl<'de> Deserialize<'de> for At {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<At, D::Error> {
        deserializer.deserialize_any(AtVisitor)
    }
}

struct AtVisitor;

impl<'de> Visitor<'de> for AtVisitor {
    type Value = At;

    fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("a number, or up to three in brackets")
    }

    fn visit_f64<E>(self, value: f64) -> Result<At, E> {
        Ok(At::new(&[value]))
    }

    fn visit_u64<E>(self, value: u64) -> Result<At, E> {
        Ok(At::new(&[value as f64]))
    }

    fn visit_i64<E>(self, value: i64) -> Result<At, E> {
        Ok(At::new(&[value as f64]))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut values: A) -> Result<At, A::Error> {
        let mut at = At::new(&[]);
        while let Some(value) = values.next_element()? {
            if at.count == 3 {
                return Err(serde::de::Error::invalid_length(4, &self));
            }
            at.values[at.count] = value;
            at.count += 1;
        }
        Ok(at)
    }
}

fn one() -> f64 {
    1.0
}

// `skip_serializing_if` hands over a reference.
#[allow(clippy::trivially_copy_pass_by_ref)]
fn is_one(x: &f64) -> bool {
    *x == 1.0
}

#[allow(clippy::trivially_copy_pass_by_ref)]
fn is_zero(x: &f64) -> bool {
    *x == 0.0
}

#[allow(clippy::trivially_copy_pass_by_ref)]
fn is_false(x: &bool) -> bool {
    !*x
}

fn is_default(settings: &PlacementSettings) -> bool {
    *settings == PlacementSettings::default()
}

/// A plan as its file has it.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "Blend")]
struct PlanText {
    version: u32,
    root: PlanNode,
}

/// As other files are read, but nodes stand deeper in each other.
fn options() -> ron::Options {
    ron::Options::default()
        .with_recursion_limit(96)
        .with_default_extension(ron::extensions::Extensions::IMPLICIT_SOME)
}

/// Reads a blend tree file. Nodes may stand some twenty deep in each other.
///
/// # Errors
/// Malformed text, a version that is not known, unknown fields, and whatever [`Plan::check`] finds: what and where.
pub fn parse_plan(text: &str) -> Result<Plan, TextFault> {
    check_version(text, BLEND_VERSION)?;
    let PlanText { root, .. } = options().from_str(text).map_err(|e| TextFault {
        line: e.span.start.line.max(1),
        column: e.span.start.col.max(1),
        message: e.code.to_string(),
    })?;
    let plan = Plan { root };
    plan.check().map_err(|fault| fault.in_text(text))?;
    Ok(plan)
}

/// Writes a blend tree file. Reading it back gives the same plan.
pub fn write_plan(plan: &Plan) -> String {
    let pretty = ron::ser::PrettyConfig::new().separate_tuple_members(false).new_line("\n");
    let file = PlanText { version: BLEND_VERSION, root: plan.root.clone() };
    let mut text = options().to_string_pretty(&file, pretty).unwrap_or_default();
    text.push('\n');
    text
}

impl Plan {
    /// Checks all but whether the clips exist.
    ///
    /// # Errors
    /// Numbers that are not finite or out of their range, names of states that don't exist or exist twice, points and cells that
    /// can't be blended between, feet placed anywhere but outermost.
    pub fn check(&self) -> Result<(), PlanFault> {
        check(self)
    }

    /// The names of the clips that it plays, each once, in the order in which they are first named.
    pub fn clip_names(&self) -> Vec<&str> {
        let mut names: Vec<&str> = Vec::new();
        self.root.each(&mut |node| {
            if let PlanNode::Clip { name, .. } = node
                && !names.contains(&name.as_str())
            {
                names.push(name);
            }
        });
        names
    }
}

impl PlanNode {
    /// Plays a clip as it is.
    pub fn clip(name: &str) -> PlanNode {
        PlanNode::Clip { name: name.to_owned(), pace: 1.0, mirrored: false, turn: 0.0 }
    }

    /// Hands this node and all in it to a function, outer ones first.
    pub fn each<'a>(&'a self, with: &mut dyn FnMut(&'a PlanNode)) {
        with(self);
        match self {
            PlanNode::Clip { .. } => {}
            PlanNode::Blend { points, .. } => points.iter().for_each(|(_, node)| node.each(with)),
            PlanNode::States { states, .. } => states.iter().for_each(|(_, node)| node.each(with)),
            PlanNode::Crossfade { from, to, .. } => {
                from.each(with);
                to.each(with);
            }
            PlanNode::Additive { base, layer, less, .. } => {
                base.each(with);
                layer.each(with);
                less.iter().for_each(|node| node.each(with));
            }
            PlanNode::Mask { base, layer, .. } => {
                base.each(with);
                layer.each(with);
            }
            PlanNode::Mirror { node } | PlanNode::FootPlacement { node, .. } => node.each(with),
        }
    }
}
