//! Commands for a value of a pose by its place.

use edit::{By, ChainCommand, ChainPart};
use rig::Robot;

/// The command that brings a value to a number, or moves it by one: degrees or metres. `None` for a place that no pose has.
pub fn value(robot: &Robot, slot: usize, amount: f64, by: By) -> Option<ChainCommand> {
    let dof = robot.dofs().nth(slot)?;
    let joint = robot.joints().get(dof.joint)?.name.clone();
    let part = Some(ChainPart::from(dof.part));
    Some(match dof.part.is_angle() {
        true => ChainCommand::Turn { joint, degrees: amount, by, part },
        false => ChainCommand::Slide { joint, metres: amount, by, part },
    })
}
