//! Applying commands to a document: each arm only hands over to the figure's gestures.

use glam::DVec3;
use rig::{
    Contact, Evaluation, Figure, GestureError, Limb, Locks, Mechanics, Moved, Pose, PosePatch, Reacher,
    Space, Target, frames,
};

use crate::symmetry::{evened, mirrored};
use crate::telling::words;
use crate::{At, By, Command, Document, Files, Goal, Hold, Outcome, Rejected};

/// A document after commands, what it comes to, and what is to be said of it.
pub(crate) struct Applied {
    pub document: Document,
    pub evaluation: Evaluation,
    pub outcome: Outcome,
}

/// What one command made of a document.
struct Change {
    document: Document,
    clamped: bool,
    /// Where it brings a limb.
    goal: Option<(Limb, DVec3)>,
}

impl Applied {
    fn new(
        figure: &Figure,
        document: Document,
        clamped: bool,
        goals: &[(Limb, DVec3)],
        told: String,
    ) -> Applied {
        let evaluation = document.evaluated(figure);
        let missed = missed(&evaluation, goals);
        let message = message(told, &missed);
        Applied { document, evaluation, outcome: Outcome { message, clamped, missed } }
    }
}

/// Applies commands one after another, each followed by its twin while symmetry is on, or says why they can't be done;
/// the document given is never changed. A twin that can't be done is left out, and the message says so.
pub(crate) fn apply(
    figure: &Figure,
    first: &Document,
    commands: &[Command],
    files: &mut dyn Files,
) -> Result<Applied, Rejected> {
    let mut document = first.clone();
    let (mut clamped, mut goals, mut not_mirrored) = (false, Vec::new(), String::new());
    for command in commands {
        let twin = first.symmetry.then(|| mirrored(figure, &document.pose, command)).flatten();
        let before = twin.as_ref().map(|_| document.pose.clone());
        let one = change(figure, &document, command, files)?;
        document = one.document;
        clamped |= one.clamped;
        goals = one.goal.into_iter().collect();
        match twin.map(|twin| change(figure, &document, &twin, files)) {
            Some(Ok(both)) => {
                let even = before.and_then(|before| evened(&before, &document.pose, &both.document.pose));
                document = both.document;
                document.pose = even.unwrap_or(document.pose);
                clamped |= both.clamped;
                goals.extend(both.goal);
            }
            Some(Err(why)) => not_mirrored = format!("; not mirrored: {why}"),
            None => {}
        }
    }
    let told = match (joints_turned(commands), commands.last()) {
        (Some(count), _) => format!("Turned {count} joints"),
        // What was asked for is not what became of it.
        (None, Some(Command::Turn { joint, dof, .. })) if clamped => {
            let degrees = document.pose.angles[joint.index()].get(*dof);
            Command::Turn { joint: *joint, dof: *dof, degrees, by: By::To }.told()
        }
        (None, last) => last.map_or_else(String::new, Command::told),
    };
    let mut applied = Applied::new(figure, document, clamped, &goals, told);
    applied.outcome.message += &not_mirrored;
    Ok(applied)
}

/// How many joints commands turn that do nothing else; `None` for one joint.
fn joints_turned(commands: &[Command]) -> Option<usize> {
    let joint = |command: &Command| match command {
        Command::Turn { joint, .. } => Some(*joint),
        _ => None,
    };
    let joints: Locks = commands.iter().map(joint).collect::<Option<Locks>>()?;
    Some(joints.iter().count()).filter(|count| *count > 1)
}

/// Applies one command.
fn change(
    figure: &Figure,
    document: &Document,
    command: &Command,
    files: &mut dyn Files,
) -> Result<Change, Rejected> {
    let goal = goal_in_world(figure, &document.pose, command);
    let locked = locked(figure, document);
    let rules = Rules::of(document);
    let Moved { pose, clamped } = match command {
        Command::Ranges { on } => {
            let document = Document { ranges: *on, ..document.clone() };
            return Ok(Change { document, clamped: false, goal });
        }
        Command::ApplyPose { path, parts, amount, mirrored } => {
            let (patch, figure) =
                (read_pose(figure, files, path, *mirrored)?, locked.as_ref().unwrap_or(figure));
            rig::apply_patch(figure, &document.pose, &patch, parts, *amount, rules.ranges)?
        }
        other => gesture(locked.as_ref().unwrap_or(figure), &document.pose, other, &rules)?,
    };
    Ok(Change { document: Document { pose, ..document.clone() }, clamped, goal })
}

/// What gestures have to heed besides the figure.
struct Rules {
    ranges: bool,
    mechanics: Mechanics,
}

impl Rules {
    fn of(document: &Document) -> Rules {
        // A locked joint stays by its range. Hands that go apart in symmetry don't turn the torso both ways.
        let follow = if document.symmetry { 0.0 } else { document.mechanics.torso_follow };
        Rules {
            ranges: document.ranges || !document.locks.is_empty(),
            mechanics: Mechanics { torso_follow: follow, ..document.mechanics },
        }
    }
}

/// The figure whose locked joints can't move; `None` if none is locked.
fn locked(figure: &Figure, document: &Document) -> Option<Figure> {
    let Document { pose, ranges, locks, .. } = document;
    (!locks.is_empty()).then(|| figure.with_locks(pose, *locks, *ranges))
}

/// A document after pasting the text of a pose file.
///
/// # Errors
/// Text that is no pose of the figure: where and why.
pub(crate) fn paste(
    figure: &Figure,
    document: &Document,
    text: &str,
    mirrored: bool,
) -> Result<Applied, Rejected> {
    let patch = read(figure, "clipboard", text, mirrored)?;
    if patch.joints.is_empty() && patch.limbs.is_empty() && patch.hips.is_none() {
        return Err(Rejected("clipboard: this pose names no joint".to_owned()));
    }
    let locked = locked(figure, document);
    let ranges = Rules::of(document).ranges;
    let Moved { pose, clamped } =
        rig::apply_patch(locked.as_ref().unwrap_or(figure), &document.pose, &patch, &[], 1.0, ranges)?;
    let count = patch.joints.len();
    let told = format!("Pasted {count} {}", if count == 1 { "joint" } else { "joints" });
    Ok(Applied::new(figure, Document { pose, ..document.clone() }, clamped, &[], told))
}

impl From<GestureError> for Rejected {
    fn from(error: GestureError) -> Rejected {
        Rejected(error.to_string())
    }
}

/// The commands that need nothing but figure and pose.
fn gesture(figure: &Figure, pose: &Pose, command: &Command, rules: &Rules) -> Result<Moved, GestureError> {
    let ranges = rules.ranges;
    match command {
        Command::Turn { joint, dof, degrees, by } => {
            let degrees = goal_angle(pose.angles(*joint).get(*dof), *degrees, *by);
            rig::turn_with(figure, pose, *joint, *dof, degrees, ranges, &rules.mechanics)
        }
        Command::Reach { limb, to } => reach(figure, pose, *limb, *to, rules),
        Command::Elevate { limb, degrees, by } => {
            rig::elevate(figure, pose, *limb, *degrees, *by == By::To, ranges)
        }
        Command::TurnInContact { limb, dof, degrees, by } => {
            let bone = rig::contact_joint(figure, *limb, *dof)?;
            let degrees = goal_angle(pose.angles(bone).get(*dof), *degrees, *by);
            rig::turn_in_contact(figure, pose, *limb, *dof, degrees, ranges)
        }
        Command::Flip { limb } => rig::flip(figure, pose, *limb, ranges),
        Command::Articulate { limb, at } => {
            let reacher = match at {
                At::Named(name) => Reacher::Named(name.clone()),
                At::Point(bone, point) => Reacher::Point(*bone, *point),
            };
            rig::articulate(figure, pose, *limb, reacher).map(still)
        }
        Command::Keep { limb, contact, space } => {
            rig::keep(figure, pose, *limb, held(*contact, *space)).map(still)
        }
        Command::MoveHips { by } => rig::move_hips(figure, pose, *by, ranges),
        Command::Place { by, turn } => rig::place(pose, *by, *turn).map(still),
        Command::AimSpine { at, twist } => rig::aim_spine(figure, pose, *at, *twist, ranges),
        Command::LookAt { at } => rig::look_at(figure, pose, *at, ranges),
        Command::Handshape { side, name, amount } => {
            rig::handshape(figure, pose, *side, name, *amount, ranges)
        }
        Command::Mirror { parts } => rig::mirror(figure, pose, parts, ranges),
        Command::Reset { parts } => rig::reset(figure, pose, parts, ranges),
        Command::Balance { amount } => rig::balance(figure, pose, *amount, ranges),
        Command::ApplyPose { .. } | Command::Ranges { .. } => Ok(still(pose.clone())),
    }
}

fn still(pose: Pose) -> Moved {
    Moved { pose, clamped: false }
}

fn goal_angle(now: f64, degrees: f64, by: By) -> f64 {
    match by {
        By::Delta => now + degrees,
        By::To => degrees,
    }
}

/// A contact of that kind; where it holds is read off the pose.
fn held(hold: Hold, space: Space) -> Contact {
    match hold {
        Hold::Free => Contact::Free,
        Hold::Point => Contact::Point { space, target: DVec3::ZERO },
        Hold::Planted => Contact::Planted { space, target: DVec3::ZERO, rotation: glam::DQuat::IDENTITY },
    }
}

fn reach(figure: &Figure, pose: &Pose, limb: Limb, to: Goal, rules: &Rules) -> Result<Moved, GestureError> {
    match target_of(figure, pose, limb, to)? {
        Some(target) => rig::reach_with(figure, pose, limb, target, rules.ranges, &rules.mechanics),
        None => rig::limb_parts_present(figure, limb).map(|()| still(pose.clone())),
    }
}

/// The target of a reach; `None` for here, which moves nothing.
fn target_of(figure: &Figure, pose: &Pose, limb: Limb, to: Goal) -> Result<Option<Target>, GestureError> {
    Ok(match to {
        Goal::Here => None,
        Goal::Offset(by) if by == DVec3::ZERO => None,
        Goal::World(point) => Some(Target { space: Space::World, point }),
        Goal::Body(bone, point) => {
            figure.skeleton.joint(bone).ok_or(GestureError::NoBone(bone))?;
            Some(Target { space: Space::Body(bone), point })
        }
        Goal::Offset(by) => {
            let space = pose.limb(limb).contact.target().map_or(Space::World, |(space, _)| space);
            let here = rig::articulator_in(figure, pose, limb, Space::World) + by;
            let point = frames(figure, pose).space(space).inverse().point(here);
            Some(Target { space, point })
        }
    })
}

/// Where an inverse gesture brings its limb, in the world, before anything moves.
pub(crate) fn goal_in_world(figure: &Figure, pose: &Pose, command: &Command) -> Option<(Limb, DVec3)> {
    match *command {
        Command::Reach { limb, to } => {
            let target = target_of(figure, pose, limb, to).ok()?;
            let here = || rig::articulator_in(figure, pose, limb, Space::World);
            let at = target.map_or_else(here, |t| frames(figure, pose).space(t.space).point(t.point));
            Some((limb, at))
        }
        Command::Elevate { limb, .. } | Command::TurnInContact { limb, .. } | Command::Flip { limb } => {
            let held = pose.limb(limb).contact.target();
            let here = || rig::articulator_in(figure, pose, limb, Space::World);
            Some((limb, held.map_or_else(here, |(space, t)| frames(figure, pose).space(space).point(t))))
        }
        _ => None,
    }
}

fn read_pose(
    figure: &Figure,
    files: &mut dyn Files,
    path: &str,
    mirrored: bool,
) -> Result<PosePatch, Rejected> {
    let text = files.read(path).map_err(Rejected)?;
    read(figure, path, &text, mirrored)
}

/// The patch of a pose file's text; faults are named by where it comes from.
fn read(figure: &Figure, from: &str, text: &str, mirrored: bool) -> Result<PosePatch, Rejected> {
    let patch = rig::read_pose(figure, text).map_err(|fault| Rejected(format!("{from}:{fault}")))?;
    Ok(if mirrored { rig::mirrored_patch(&patch) } else { patch })
}

/// Limbs that missed their contact, or a gesture's goal, by more than a hundredth of a millimetre.
fn missed(evaluation: &Evaluation, goals: &[(Limb, DVec3)]) -> Vec<(Limb, f64)> {
    let of = |limb: Limb| {
        let view = &evaluation.limbs[limb.index()];
        let goal = goals.iter().find(|(aimed, _)| *aimed == limb);
        goal.map_or(view.residual, |(_, at)| view.articulator.distance(*at))
    };
    Limb::ALL.into_iter().map(|limb| (limb, of(limb))).filter(|(_, off)| *off > 1e-5).collect()
}

fn message(mut told: String, missed: &[(Limb, f64)]) -> String {
    for (limb, off) in missed {
        told += &format!("; {} is {:.1} mm off its target", words(limb.name()), off * 1000.0);
    }
    let mut letters = told.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}
