//! What a plan's text can say and a tree can't do: found before a tree is made, with the way to the value at
//! fault.

use std::ops::RangeInclusive;

use super::places::{PlanFault, Step};
use super::plan::{At, Condition, Plan, PlanNode, Transition};
use crate::Parameter;
use crate::cells::{Cells, CellsError};

/// Parameters and times beyond mean nothing.
const SOUND: RangeInclusive<f64> = -1e6..=1e6;
const PACES: RangeInclusive<f64> = 0.05..=20.0;
const AMOUNTS: RangeInclusive<f64> = 0.0..=1.0;
const LONGEST_TRANSITION_SECS: f64 = 60.0;
/// Deeper plans are none that people write, and might exhaust the stack.
const DEEPEST: usize = 64;

type Checked = Result<(), PlanFault>;

/// The way to a value, written backward: each step knows the one before.
#[derive(Clone, Copy)]
pub(super) struct Way<'a> {
    before: Option<&'a Way<'a>>,
    step: Step,
    depth: usize,
}

impl<'a> Way<'a> {
    pub(super) const ROOT: Way<'static> = Way { before: None, step: Step::Field("root"), depth: 1 };

    pub(super) fn field(&'a self, name: &'static str) -> Way<'a> {
        Way { before: Some(self), step: Step::Field(name), depth: self.depth + 1 }
    }

    pub(super) fn item(&'a self, index: usize) -> Way<'a> {
        Way { before: Some(self), step: Step::Item(index), depth: self.depth + 1 }
    }

    pub(super) fn fault(&self, message: impl Into<String>) -> PlanFault {
        let mut path = Vec::with_capacity(self.depth);
        let mut here = Some(self);
        while let Some(way) = here {
            path.push(way.step);
            here = way.before;
        }
        path.reverse();
        PlanFault { path, message: message.into() }
    }

    fn within(&self, value: f64, range: RangeInclusive<f64>) -> Checked {
        if range.contains(&value) {
            return Ok(());
        }
        Err(self.fault(format!("{value} found, expected {} to {}", range.start(), range.end())))
    }
}

pub(super) fn check(plan: &Plan) -> Checked {
    if let PlanNode::FootPlacement { node, .. } = &plan.root {
        return check_node(node, &Way::ROOT.field("node"));
    }
    check_node(&plan.root, &Way::ROOT)
}

fn check_node(node: &PlanNode, way: &Way<'_>) -> Checked {
    if way.depth > DEEPEST {
        return Err(way.fault("nodes stand too deep in each other"));
    }
    match node {
        PlanNode::Clip { pace, turn, .. } => {
            way.field("turn").within(*turn, SOUND)?;
            if PACES.contains(&pace.abs()) {
                return Ok(());
            }
            let message = format!(
                "{pace} found, expected {} to {}, or less than 0 to go backward",
                PACES.start(),
                PACES.end()
            );
            Err(way.field("pace").fault(message))
        }
        PlanNode::Blend { by, points, cells } => check_blend(by, points, cells.as_deref(), way),
        PlanNode::Crossfade { over, from, to, .. } => {
            way.field("over").item(0).within(over.0, SOUND)?;
            way.field("over").item(1).within(over.1, SOUND)?;
            if over.0 >= over.1 {
                return Err(way.field("over").fault("expected the lower value first, then a higher one"));
            }
            check_node(from, &way.field("from"))?;
            check_node(to, &way.field("to"))
        }
        PlanNode::Additive { base, layer, less, amount, by } => {
            way.field("amount").within(*amount, AMOUNTS)?;
            if let Some((_, full)) = by {
                way.field("by").item(1).within(*full, SOUND)?;
                if full.abs() < 1e-6 {
                    return Err(way
                        .field("by")
                        .item(1)
                        .fault("expected the value at which all is added, not 0"));
                }
            }
            check_node(base, &way.field("base"))?;
            check_node(layer, &way.field("layer"))?;
            less.as_ref().map_or(Ok(()), |less| check_node(less, &way.field("less")))
        }
        PlanNode::Mask { base, layer, parts, bones, amount } => {
            way.field("amount").within(*amount, AMOUNTS)?;
            if parts.is_empty() && bones.is_empty() {
                return Err(way.field("parts").fault("expected some parts or bones that the layer is for"));
            }
            check_node(base, &way.field("base"))?;
            check_node(layer, &way.field("layer"))
        }
        PlanNode::Mirror { node } => check_node(node, &way.field("node")),
        PlanNode::FootPlacement { .. } => Err(
            way.fault("FootPlacement found within another node, expected it outermost: feet are placed last")
        ),
        PlanNode::States { initial, states, transitions } => check_states(initial, states, transitions, way),
    }
}

fn check_blend(
    by: &[Parameter],
    points: &[(At, PlanNode)],
    cells: Option<&[Vec<usize>]>,
    way: &Way<'_>,
) -> Checked {
    if by.is_empty() || by.len() > 3 {
        return Err(way.field("by").fault(format!("{} parameters found, expected 1 to 3", by.len())));
    }
    if let Some(twice) = (0..by.len()).find(|&i| by[..i].contains(&by[i])) {
        return Err(way.field("by").item(twice).fault("this parameter is there twice"));
    }
    for (p, (at, _)) in points.iter().enumerate() {
        let (points, dims) = (way.field("points"), by.len());
        let point = points.item(p);
        let place = point.item(0);
        if at.values().len() != dims {
            let message =
                format!("{} values found, expected one for each of {dims} parameters", at.values().len());
            return Err(place.fault(message));
        }
        for (i, value) in at.values().iter().enumerate() {
            let within =
                if dims == 1 { place.within(*value, SOUND) } else { place.item(i).within(*value, SOUND) };
            within?;
        }
    }
    let places: Vec<[f64; 3]> = points.iter().map(|(at, _)| at.padded()).collect();
    cells_of(by.len(), &places, cells).map_err(|error| cells_fault(&error, way))?;
    for (p, (_, node)) in points.iter().enumerate() {
        check_node(node, &way.field("points").item(p).item(1))?;
    }
    Ok(())
}

/// The cells that a plan gives, or those that suit its points.
pub(super) fn cells_of(
    dims: usize,
    places: &[[f64; 3]],
    cells: Option<&[Vec<usize>]>,
) -> Result<Cells, CellsError> {
    match cells {
        Some(cells) => Cells::given(places, dims, cells),
        None => Cells::between(places, dims),
    }
}

pub(super) fn cells_fault(error: &CellsError, way: &Way<'_>) -> PlanFault {
    let (points, cells) = (way.field("points"), way.field("cells"));
    match error {
        CellsError::Count { .. } | CellsError::Degenerate { .. } => points.fault(error.to_string()),
        CellsError::Doubled { point, .. } => points.item(*point).item(0).fault(error.to_string()),
        CellsError::Corners { cell, .. }
        | CellsError::Flat { cell }
        | CellsError::Overlap { cell, .. }
        | CellsError::Holds { cell, .. } => cells.item(*cell).fault(error.to_string()),
        CellsError::Gap { .. } => cells.fault(error.to_string()),
    }
}

fn check_states(
    initial: &str,
    states: &[(String, PlanNode)],
    transitions: &[Transition],
    way: &Way<'_>,
) -> Checked {
    let names = || states.iter().map(|(name, _)| name.as_str());
    for (s, (name, _)) in states.iter().enumerate() {
        if names().take(s).any(|other| other == name) {
            let message = format!("a second state \"{name}\", expected a name of its own");
            return Err(way.field("states").item(s).item(0).fault(message));
        }
    }
    let known = |name: &str, way: &Way<'_>| {
        if names().any(|other| other == name) {
            return Ok(());
        }
        Err(way.fault(unknown("state", name, names())))
    };
    known(initial, &way.field("initial"))?;
    let list = way.field("transitions");
    for (t, transition) in transitions.iter().enumerate() {
        let way = list.item(t);
        known(&transition.from, &way.field("from"))?;
        known(&transition.to, &way.field("to"))?;
        check_transition(transition, &way)?;
    }
    for (s, (_, node)) in states.iter().enumerate() {
        check_node(node, &way.field("states").item(s).item(1))?;
    }
    Ok(())
}

/// "unknown … found, expected one of …".
pub(super) fn unknown<'a>(what: &str, name: &str, known: impl Iterator<Item = &'a str>) -> String {
    let known: Vec<&str> = known.collect();
    format!(
        "unknown {what} \"{name}\", expected {}",
        if known.is_empty() { "one that exists".into() } else { known.join(", ") }
    )
}

fn check_transition(transition: &Transition, way: &Way<'_>) -> Checked {
    if transition.from == transition.to {
        return Err(way.field("to").fault("a transition to the state that it is from, expected another"));
    }
    if !(transition.secs > 0.0 && transition.secs <= LONGEST_TRANSITION_SECS) {
        let message = format!(
            "{} found, expected more than 0 and at most {LONGEST_TRANSITION_SECS} seconds",
            transition.secs
        );
        return Err(way.field("secs").fault(message));
    }
    if transition.when.is_empty() {
        return Err(way.field("when").fault("expected at least one condition"));
    }
    for (c, condition) in transition.when.iter().enumerate() {
        let list = way.field("when");
        let way = list.item(c);
        match condition {
            Condition::Above(_, value) | Condition::Below(_, value) => way.item(1).within(*value, SOUND)?,
            Condition::EndsWithin(secs) => way.item(0).within(*secs, 0.0..=1e6)?,
            Condition::Sit | Condition::Stand => {}
        }
    }
    Ok(())
}
