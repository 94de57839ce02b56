//! A plan with the clips of a figure: nodes in one row, outer ones before what is in them.

use std::ops::Range;
use std::sync::Arc;

use rig::{Bone, TextFault};

use super::check::{Way, cells_fault, cells_of, unknown};
use super::places::PlanFault;
use super::plan::{At, Condition, Plan, PlanNode, Transition, parse_plan};
use crate::cells::Cells;
use crate::{Feather, FittedClip, Parameter, PlacementSettings};

/// A blend tree for one figure. Walkers of that figure share it; each has its own
/// [`TreeState`](super::TreeState).
#[derive(Clone, PartialEq, Debug)]
pub struct Tree {
    pub(super) nodes: Vec<Node>,
    pub(super) clips: Vec<Arc<FittedClip>>,
    pub(super) placement: Option<PlacementSettings>,
    /// The ratio of the figure's speeds to those of the figure that the clips were made with.
    pub(super) pace: f64,
    /// How many samples are held at once at most.
    pub(super) depth: usize,
    /// The twin of each bone, by index.
    pub(super) twins: [u8; Bone::COUNT],
}

/// A node.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Node {
    pub(super) kind: Kind,
    /// This node and those in it, in the row.
    pub(super) all: Range<usize>,
    /// How many nodes it is in.
    pub(super) level: usize,
    pub(super) label: String,
    /// What a reload knows it by; no two nodes have the same.
    pub(super) key: String,
}

#[derive(Clone, PartialEq, Debug)]
pub(super) enum Kind {
    Clip(ClipNode),
    Blend {
        by: Vec<Parameter>,
        cells: Cells,
        places: Vec<[f64; 3]>,
        children: Vec<usize>,
    },
    Crossfade {
        by: Parameter,
        over: (f64, f64),
        feather: Feather,
        children: [usize; 2],
    },
    Additive {
        base: usize,
        layer: usize,
        less: Option<usize>,
        amount: f64,
        by: Option<(Parameter, f64)>,
    },
    Mask {
        base: usize,
        layer: usize,
        bones: Box<[bool; Bone::COUNT]>,
        amount: f64,
    },
    States(StatesNode),
    /// Hands on its one child: mirrors are told to the clips, placement to the walker.
    Pass(usize),
}

#[derive(Clone, PartialEq, Debug)]
pub(super) struct ClipNode {
    /// Index among the tree's clips.
    pub(super) clip: usize,
    pub(super) pace: f64,
    pub(super) mirrored: bool,
    /// Degrees a second, mirrored if the clip is.
    pub(super) turn: f64,
}

#[derive(Clone, PartialEq, Debug)]
pub(super) struct StatesNode {
    /// Index among the state's machines.
    pub(super) machine: usize,
    pub(super) initial: usize,
    pub(super) names: Vec<String>,
    pub(super) children: Vec<usize>,
    pub(super) ways: Vec<StateWay>,
}

/// A transition of a figure.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct StateWay {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) when: Vec<Condition>,
    pub(super) secs: f64,
    pub(super) feather: Feather,
}

/// Reads a blend tree file and binds it to the clips of a figure.
///
/// # Errors
/// Those of [`parse_plan`] and [`Tree::new`], with their places in the text.
pub fn read_tree(text: &str, clips: &[Arc<FittedClip>]) -> Result<Tree, TextFault> {
    let plan = parse_plan(text)?;
    Tree::new(&plan, clips).map_err(|fault| fault.in_text(text))
}

impl Tree {
    /// A plan with the clips of one figure, found by name. Points, thresholds and times of the plan are
    /// scaled as the first clip was in speed, so a child walks where its own walk is.
    ///
    /// # Errors
    /// What [`Plan::check`] finds; clips that there aren't; strides that are to go backward.
    pub fn new(plan: &Plan, clips: &[Arc<FittedClip>]) -> Result<Tree, PlanFault> {
        plan.check()?;
        let pace = clips.first().map_or(1.0, |clip| clip.pace());
        let tree = Tree {
            nodes: Vec::new(),
            clips: Vec::new(),
            placement: None,
            pace,
            depth: 0,
            twins: Bone::ALL.map(|bone| bone.mirrored().index() as u8),
        };
        let mut builder = Builder { tree, given: clips, machines: 0 };
        if let PlanNode::FootPlacement { settings, .. } = &plan.root {
            builder.tree.placement = Some(*settings);
        }
        builder.node(&plan.root, &Way::ROOT, Within { level: 0, mirrored: false, at: "", scope: "" })?;
        let mut tree = builder.tree;
        tree.depth = tree.samples_of(0);
        Ok(tree)
    }

    /// The clips that it plays, in the order of the weights in
    /// [`TreeState::weights`](super::TreeState::weights).
    pub fn clips(&self) -> &[Arc<FittedClip>] {
        &self.clips
    }

    /// How the feet are placed; `None` if they aren't.
    pub fn placement(&self) -> Option<&PlacementSettings> {
        self.placement.as_ref()
    }

    /// How many samples are held at once at most to take a node's.
    fn samples_of(&self, node: usize) -> usize {
        let most = |children: &[usize]| {
            let most = children.iter().map(|&child| self.samples_of(child)).max().unwrap_or(0);
            most + usize::from(children.len() > 1)
        };
        match &self.nodes[node].kind {
            Kind::Clip(_) => 1,
            Kind::Pass(child) => self.samples_of(*child),
            Kind::Blend { children, .. } => most(children),
            Kind::Crossfade { children, .. } => most(children),
            Kind::States(states) => most(&states.children),
            Kind::Mask { base, layer, .. } => self.samples_of(*base).max(1 + self.samples_of(*layer)),
            Kind::Additive { base, layer, less, .. } => {
                let less = less.map_or(0, |less| 2 + self.samples_of(less));
                self.samples_of(*base).max(1 + self.samples_of(*layer)).max(less)
            }
        }
    }
}

/// Where a node is.
#[derive(Clone, Copy)]
struct Within<'a> {
    level: usize,
    mirrored: bool,
    /// What its parent has it for: shown before its own label.
    at: &'a str,
    /// The states that it is in, each with a slash.
    scope: &'a str,
}

struct Builder<'a> {
    tree: Tree,
    given: &'a [Arc<FittedClip>],
    machines: usize,
}

type Built<T = usize> = Result<T, PlanFault>;

impl Builder<'_> {
    fn node(&mut self, plan: &PlanNode, way: &Way<'_>, within: Within<'_>) -> Built {
        let index = self.tree.nodes.len();
        let name = label(plan);
        let label = if within.at.is_empty() { name.clone() } else { format!("{}: {name}", within.at) };
        let known_by = if let PlanNode::Clip { name, .. } = plan { name } else { &name };
        let key = self.key(format!("{}{known_by}", within.scope));
        let all = index..index + 1;
        self.tree.nodes.push(Node { kind: Kind::Pass(index), all, level: within.level, label, key });
        let kind = self.kind(plan, way, Within { level: within.level + 1, at: "", ..within })?;
        self.tree.nodes[index].kind = kind;
        self.tree.nodes[index].all.end = self.tree.nodes.len();
        Ok(index)
    }

    /// A key that no node has yet.
    fn key(&self, wanted: String) -> String {
        let taken = |key: &str| self.tree.nodes.iter().any(|node| node.key == key);
        let numbered = (2..).map(|n| format!("{wanted} #{n}"));
        let mut keys = std::iter::once(wanted.clone()).chain(numbered);
        keys.find(|key| !taken(key)).unwrap_or(wanted)
    }

    fn kind(&mut self, plan: &PlanNode, way: &Way<'_>, within: Within<'_>) -> Built<Kind> {
        Ok(match plan {
            PlanNode::Clip { name, pace, mirrored, turn } => {
                Kind::Clip(self.clip(name, *pace, *mirrored != within.mirrored, *turn, way)?)
            }
            PlanNode::Blend { by, points, cells } => self.blend(by, points, cells.as_deref(), way, within)?,
            PlanNode::Crossfade { by, over, from, to, feather } => {
                let scale = by.of_pace(self.tree.pace);
                let from = self.node(from, &way.field("from"), within)?;
                let to = self.node(to, &way.field("to"), within)?;
                let over = (over.0 * scale, over.1 * scale);
                Kind::Crossfade { by: *by, over, feather: *feather, children: [from, to] }
            }
            PlanNode::Additive { base, layer, less, amount, by } => {
                let base = self.node(base, &way.field("base"), Within { at: "base", ..within })?;
                let layer = self.node(layer, &way.field("layer"), Within { at: "layer", ..within })?;
                let minus = Within { at: "less", ..within };
                let less =
                    less.as_ref().map(|less| self.node(less, &way.field("less"), minus)).transpose()?;
                let by = by.map(|(by, full)| (by, full * by.of_pace(self.tree.pace)));
                Kind::Additive { base, layer, less, amount: *amount, by }
            }
            PlanNode::Mask { base, layer, parts, bones, amount } => {
                let base = self.node(base, &way.field("base"), Within { at: "base", ..within })?;
                let layer = self.node(layer, &way.field("layer"), Within { at: "layer", ..within })?;
                let has = |bone: &Bone| parts.contains(&bone.part()) || bones.contains(bone);
                let seen = |bone: Bone| if within.mirrored { bone.mirrored() } else { bone };
                let bones = Box::new(Bone::ALL.map(|bone| has(&seen(bone))));
                Kind::Mask { base, layer, bones, amount: *amount }
            }
            PlanNode::Mirror { node } => {
                let within = Within { mirrored: !within.mirrored, ..within };
                Kind::Pass(self.node(node, &way.field("node"), within)?)
            }
            PlanNode::FootPlacement { node, .. } => {
                Kind::Pass(self.node(node, &way.field("node"), within)?)
            }
            PlanNode::States { initial, states, transitions } => {
                self.states(initial, states, transitions, way, within)?
            }
        })
    }

    fn clip(&mut self, name: &str, pace: f64, mirrored: bool, turn: f64, way: &Way<'_>) -> Built<ClipNode> {
        let Some(clip) = self.given.iter().find(|clip| clip.name() == name) else {
            let known = self.given.iter().map(|clip| clip.name());
            return Err(way.field("name").fault(unknown("clip", name, known)));
        };
        if clip.is_stride() && pace < 0.0 {
            let message = format!("{pace} found, expected a pace above 0: strides don't go backward");
            return Err(way.field("pace").fault(message));
        }
        let clips = &mut self.tree.clips;
        let index = clips.iter().position(|known| known.name() == name).unwrap_or_else(|| {
            clips.push(clip.clone());
            clips.len() - 1
        });
        let turn = turn * Parameter::Turn.of_pace(self.tree.pace);
        Ok(ClipNode { clip: index, pace, mirrored, turn: if mirrored { -turn } else { turn } })
    }

    fn blend(
        &mut self,
        by: &[Parameter],
        points: &[(At, PlanNode)],
        cells: Option<&[Vec<usize>]>,
        way: &Way<'_>,
        within: Within<'_>,
    ) -> Built<Kind> {
        let mut scale = [1.0; 3];
        scale.iter_mut().zip(by).for_each(|(scale, by)| *scale = by.of_pace(self.tree.pace));
        let scaled = |at: &At| {
            let at = at.padded();
            [at[0] * scale[0], at[1] * scale[1], at[2] * scale[2]]
        };
        let places: Vec<[f64; 3]> = points.iter().map(|(at, _)| scaled(at)).collect();
        let cells = cells_of(by.len(), &places, cells).map_err(|error| cells_fault(&error, way))?;
        let list = way.field("points");
        let mut children = Vec::with_capacity(points.len());
        for (p, (at, node)) in points.iter().enumerate() {
            let values: Vec<String> = at.values().iter().map(f64::to_string).collect();
            let at = values.join(", ");
            children.push(self.node(node, &list.item(p).item(1), Within { at: &at, ..within })?);
        }
        Ok(Kind::Blend { by: by.to_vec(), cells, places, children })
    }

    fn states(
        &mut self,
        initial: &str,
        states: &[(String, PlanNode)],
        transitions: &[Transition],
        way: &Way<'_>,
        within: Within<'_>,
    ) -> Built<Kind> {
        let machine = self.machines;
        self.machines += 1;
        let names: Vec<String> = states.iter().map(|(name, _)| name.clone()).collect();
        let list = way.field("states");
        let mut children = Vec::with_capacity(states.len());
        for (s, (name, node)) in states.iter().enumerate() {
            let scope = format!("{}{name}/", within.scope);
            let within = Within { at: name, scope: &scope, ..within };
            children.push(self.node(node, &list.item(s).item(1), within)?);
        }
        // The check has found every name.
        let index = |name: &str| names.iter().position(|other| other == name).unwrap_or(0);
        let pace = self.tree.pace;
        let scaled = |condition: &Condition| match *condition {
            Condition::Above(by, value) => Condition::Above(by, value * by.of_pace(pace)),
            Condition::Below(by, value) => Condition::Below(by, value * by.of_pace(pace)),
            Condition::EndsWithin(secs) => Condition::EndsWithin(secs * pace),
            condition @ (Condition::Sit | Condition::Stand) => condition,
        };
        let ways = transitions.iter().map(|t| StateWay {
            from: index(&t.from),
            to: index(&t.to),
            when: t.when.iter().map(scaled).collect(),
            secs: t.secs * pace,
            feather: t.feather,
        });
        let (initial, ways) = (index(initial), ways.collect());
        Ok(Kind::States(StatesNode { machine, initial, names, children, ways }))
    }
}

/// What a node is called in the tree's picture.
fn label(plan: &PlanNode) -> String {
    match plan {
        PlanNode::Clip { name, pace, mirrored, turn } => {
            let mut label = name.clone();
            if *pace != 1.0 {
                label.push_str(&format!(" ×{pace}"));
            }
            if *turn != 0.0 {
                label.push_str(&format!(" turning {turn}°/s"));
            }
            if *mirrored {
                label.push_str(" mirrored");
            }
            label
        }
        PlanNode::Blend { by, .. } => {
            let names: Vec<&str> = by.iter().map(|by| by.name()).collect();
            format!("blend by {}", names.join(", "))
        }
        PlanNode::Crossfade { by, .. } => format!("crossfade by {}", by.name()),
        PlanNode::Additive { .. } => "additive".into(),
        PlanNode::Mask { parts, bones, .. } => {
            let names = parts.iter().map(|part| part.name()).chain(bones.iter().map(|bone| bone.name()));
            format!("mask {}", names.collect::<Vec<&str>>().join(", "))
        }
        PlanNode::Mirror { .. } => "mirror".into(),
        PlanNode::FootPlacement { .. } => "foot placement".into(),
        PlanNode::States { .. } => "states".into(),
    }
}
