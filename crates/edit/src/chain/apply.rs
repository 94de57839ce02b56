//! Applying commands to a chain.

use std::sync::Arc;

use glam::{DQuat, DVec3};
use kin::Interval;
use kin::chain::Root;
use rig::{ChangeError, DofPart, Frame, NewLink, Robot, RobotGoal, RobotJointKind, RootMoves};

use super::command::{ChainCommand, ChainGoal, ChainPart, ChainRoot, ChainSolver};
use super::document::{ChainDocument, ChainOutcome, ChainReach};
use super::node::{self, ChainNode};
use crate::{By, Rejected};

impl From<ChangeError> for Rejected {
    fn from(error: ChangeError) -> Rejected {
        Rejected(error.to_string())
    }
}

type Applied = Result<(ChainDocument, ChainOutcome), Rejected>;

/// Applies a command, or says why it can't be done; the document given is never changed.
pub(super) fn apply(document: &ChainDocument, command: &ChainCommand) -> Applied {
    let robot = &document.robot;
    match command {
        ChainCommand::Turn { joint, degrees, by, part } => {
            shift(document, joint, *part, finite(*degrees, "degrees")?.to_radians(), *by, true)
        }
        ChainCommand::Slide { joint, metres, by, part } => {
            shift(document, joint, *part, finite(*metres, "metres")?, *by, false)
        }
        ChainCommand::Reach { link, to, point, rotation, solver, root } => {
            let asked = Reaching { to, point: *point, rotation: *rotation, solver: *solver, root: *root };
            reach(document, link, &asked)
        }
        ChainCommand::Append { to, name, length, range, axis } => {
            let to = robot.find_link(to)?;
            let range = ordered(*range)?.scaled(1f64.to_radians());
            let axis = axis.unwrap_or_else(|| robot.axis_for_more(to));
            let new = NewLink { name: name.clone(), length: *length, range, axis };
            rebuilt(document, robot.appended(to, new)?, format!("Appended {name}"))
        }
        ChainCommand::Remove { link } => {
            rebuilt(document, robot.without(robot.find_link(link)?)?, format!("Removed {link}"))
        }
        ChainCommand::SetLength { link, metres } => {
            let changed = robot.with_length(robot.find_link(link)?, *metres)?;
            rebuilt(document, changed, format!("{link} is {metres} m long"))
        }
        ChainCommand::SetRange { joint, to } => set_range(document, joint, *to),
        ChainCommand::Place { by, turn } => place(document, *by, *turn),
        ChainCommand::Reset { joints } => reset(document, joints),
        ChainCommand::Ranges { on } => {
            let words = if *on { "Ranges on" } else { "Ranges off" };
            Ok((ChainDocument { ranges: *on, ..document.clone() }, told(words.to_owned())))
        }
    }
}

fn told(message: String) -> ChainOutcome {
    ChainOutcome { message, ..ChainOutcome::default() }
}

fn finite(value: f64, what: &str) -> Result<f64, Rejected> {
    if value.is_finite() { Ok(value) } else { Err(Rejected(format!("{what}: expected a finite number"))) }
}

fn finite_point(point: DVec3, what: &str) -> Result<DVec3, Rejected> {
    if point.is_finite() { Ok(point) } else { Err(Rejected(format!("{what}: expected finite numbers"))) }
}

fn ordered((low, high): (f64, f64)) -> Result<Interval, Rejected> {
    // Infinite ends are free ones.
    if low <= high {
        return Ok(Interval { min: low, max: high });
    }
    Err(Rejected(format!("a range from {low} to {high}: expected the lower end first")))
}

/// Which value of a pose a turn or a slide of a joint changes.
fn slot(robot: &Robot, joint: usize, part: Option<ChainPart>, turns: bool) -> Result<usize, Rejected> {
    let (name, kind) = (&robot.joints()[joint].name, robot.joints()[joint].kind);
    if let Some(master) = robot.master(joint) {
        let master = &robot.joints()[master].name;
        return Err(Rejected(format!("{name} follows {master}: move that")));
    }
    let fitting: Vec<usize> =
        (0..kind.parts().len()).filter(|&i| kind.parts()[i].is_angle() == turns).collect();
    let word = if turns { "turn" } else { "slide" };
    let chosen = match (part.map(DofPart::from), &fitting[..]) {
        (None, [only]) => Some(*only),
        (Some(part), _) => fitting.iter().copied().find(|&i| kind.parts()[i] == part),
        (None, _) => None,
    };
    let at = chosen.ok_or_else(|| {
        let parts: Vec<&str> = fitting.iter().map(|&i| kind.parts()[i].name()).collect();
        let ways =
            if parts.is_empty() { "not at all".to_owned() } else { format!("by {}", parts.join(", ")) };
        Rejected(format!("{name} is {}: it can {word} {ways}", kind.name()))
    })?;
    Ok(robot.slot(joint).start + at)
}

fn shift(
    document: &ChainDocument,
    joint: &str,
    part: Option<ChainPart>,
    amount: f64,
    by: By,
    turns: bool,
) -> Applied {
    let robot = &document.robot;
    let number = robot.find_joint(joint)?;
    let slot = slot(robot, number, part, turns)?;
    let mut pose = document.pose.clone();
    let before = pose.0[slot];
    let wanted = match by {
        By::Delta => before + amount,
        By::To => amount,
    };
    let range = robot.joints()[number].range();
    // A value outside its range may only move inward.
    let after = if document.ranges { range.reaching(before).clamp(wanted) } else { wanted };
    pose.0[slot] = after;
    let clamped = after != wanted;
    let at = if turns { format!("{:.1}°", after.to_degrees()) } else { format!("{after:.3} m") };
    let stop = if clamped { ", the end of its range" } else { "" };
    let message = format!("{joint} at {at}{stop}");
    let pose = robot.followed(&pose);
    Ok((ChainDocument { pose, ..document.clone() }, ChainOutcome { message, clamped, reach: None }))
}

/// Where a link's point is to go, and how.
struct Reaching<'a> {
    to: &'a ChainGoal,
    point: Option<DVec3>,
    rotation: Option<DQuat>,
    solver: ChainSolver,
    root: ChainRoot,
}

fn reach(document: &ChainDocument, name: &str, asked: &Reaching<'_>) -> Applied {
    let &Reaching { to, point, rotation, solver, root } = asked;
    let robot = &document.robot;
    let link = robot.find_link(name)?;
    let point = finite_point(point.unwrap_or_else(|| robot.tip(link)), "point")?;
    let frames = document.frames();
    let at = frames[link].point(point);
    let target = match to {
        ChainGoal::World(target) => *target,
        ChainGoal::Link(other, target) => frames[robot.find_link(other)?].point(*target),
        ChainGoal::Offset(by) => at + *by,
        ChainGoal::Here => return Ok((document.clone(), told(format!("{name} stays")))),
    };
    let target = finite_point(target, "target")?;
    let goal = RobotGoal {
        link,
        point,
        target,
        rotation,
        // What may not be placed anywhere can't be drawn along either.
        root: if document.root == RootMoves::Free { root.into() } else { Root::Held },
        solver: solver.into(),
        ranges: document.ranges,
        held: node::base(robot).filter(|base| {
            // A base is part of what stands still, unless it is the very thing that is drawn.
            root == ChainRoot::Held && ChainNode::of_link(robot, link).joint(robot) != Some(*base)
        }),
    };
    let found = robot.reach(&document.pose, document.world_from_root, &goal).map_err(Rejected)?;
    let reach = ChainReach {
        link: name.to_owned(),
        target,
        solver,
        reached: found.reached,
        residual_m: found.residual_m,
        residual_deg: found.residual_rad.to_degrees(),
        iterations: found.iterations,
    };
    let message = if found.reached {
        format!("{name} reached")
    } else {
        format!("{name} is {:.1} mm off its target", found.residual_m * 1e3)
    };
    let outcome = ChainOutcome { message, clamped: !found.reached, reach: Some(reach) };
    let moved =
        ChainDocument { pose: found.pose, world_from_root: found.world_from_root, ..document.clone() };
    Ok((moved, outcome))
}

/// The document with another structure: joints that both have keep their values.
fn rebuilt(document: &ChainDocument, robot: Robot, message: String) -> Applied {
    let pose = robot.pose_from(&document.robot, &document.pose);
    let changed = ChainDocument { robot: Arc::new(robot), pose, urdf: None, ..document.clone() };
    Ok((changed, told(message)))
}

fn set_range(document: &ChainDocument, joint: &str, to: (f64, f64)) -> Applied {
    let number = document.robot.find_joint(joint)?;
    let turns = document.robot.joints()[number].kind != RobotJointKind::Prismatic;
    let range = ordered(to)?;
    let natural = if turns { range.scaled(1f64.to_radians()) } else { range };
    let unit = if turns { "°" } else { " m" };
    let message = format!("{joint} goes from {}{unit} to {}{unit}", range.min, range.max);
    let mut applied = rebuilt(document, document.robot.with_range(number, natural)?, message)?;
    // A new range takes the joint along.
    let robot = applied.0.robot.clone();
    let slot = robot.slot(number);
    for value in &mut applied.0.pose.0[slot] {
        *value = natural.clamp(*value);
    }
    applied.0.pose = robot.followed(&applied.0.pose);
    Ok(applied)
}

fn place(document: &ChainDocument, by: DVec3, turn: f64) -> Applied {
    let by = finite_point(by, "by")?;
    let turn = DQuat::from_rotation_y(finite(turn, "turn")?.to_radians());
    let Frame { rotation, position } = document.world_from_root;
    let wanted = Frame::new((turn * rotation).normalize(), position + by);
    let world_from_root = document.root.clamped(document.world_from_root, wanted);
    let clamped = world_from_root != wanted;
    let message = if clamped { "Placed as far as its root moves" } else { "Placed" };
    let outcome = ChainOutcome { clamped, ..told(message.to_owned()) };
    Ok((ChainDocument { world_from_root, ..document.clone() }, outcome))
}

fn reset(document: &ChainDocument, joints: &[String]) -> Applied {
    let robot = &document.robot;
    let mut numbers = Vec::with_capacity(joints.len());
    for name in joints {
        numbers.push(robot.find_joint(name)?);
    }
    let mut pose = document.pose.clone();
    for (slot, dof) in robot.dofs().enumerate() {
        if joints.is_empty() || numbers.contains(&dof.joint) {
            pose.0[slot] = if document.ranges { dof.range.clamp(0.0) } else { 0.0 };
        }
    }
    let pose = robot.followed(&pose);
    Ok((ChainDocument { pose, ..document.clone() }, told("Reset".to_owned())))
}
