//! A place in the world as the goal of a limb.

use edit::{Command, Editor, Goal};
use glam::DVec3;
use rig::{Limb, Space};

/// Reaches for a world point, metres; a limb that holds on to a body goes on holding on to it, at another place.
pub fn reach(editor: &Editor, limb: Limb, goal_in_world: DVec3) -> Command {
    let space = editor.pose().limb(limb).contact.target().map(|(space, _)| space);
    let to = match space {
        Some(Space::Body(bone)) => {
            let world_from_bone = editor.evaluation().frames[bone];
            Goal::Body(bone, world_from_bone.inverse().point(goal_in_world))
        }
        Some(Space::World) | None => Goal::World(goal_in_world),
    };
    Command::Reach { limb, to }
}
