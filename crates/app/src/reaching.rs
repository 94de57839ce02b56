//! A place in the world as the goal of a limb, and why a limb misses its own.

use edit::{Command, Editor, Goal};
use glam::DVec3;
use rig::{Contact, Limb, Miss, Space, Why};

use crate::labels;

/// An end that is turned less than this from its hold keeps it, degrees.
const HELD_DEG: f64 = 0.05;

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

/// By how much and why a limb misses its contact; `None` if it is met within half a millimetre.
pub fn miss(editor: &Editor, limb: Limb) -> Option<Miss> {
    let document = editor.document();
    if document.pose.limb(limb).contact == Contact::Free {
        return None;
    }
    let evaluation = editor.evaluation();
    let limits =
        rig::reach_limits(editor.figure(), &document.pose, &evaluation.frames, limb, document.ranges)?;
    limits.miss(&evaluation.limbs[limb.index()])
}

/// The miss in words: `12 mm short: out of reach`.
pub fn miss_words(editor: &Editor, limb: Limb) -> Option<String> {
    let miss = miss(editor, limb)?;
    let root = labels::joint(limb.parts().root).to_lowercase();
    let why = match miss.why {
        Why::TooFar => "out of reach".to_owned(),
        Why::TooNear => format!("too near to the {root}"),
        Why::Range => format!("the {root}'s range stops it"),
    };
    Some(format!("{:.0} mm short: {why}", miss.by_m * 1000.0))
}

/// How far a planted end is turned from its hold, in words.
pub fn turned_words(editor: &Editor, limb: Limb) -> Option<String> {
    let off = editor.evaluation().limbs[limb.index()].rotation_residual;
    let end = labels::joint(limb.parts().end).to_lowercase();
    (off > HELD_DEG).then(|| format!("turned {off:.1}° from its hold: the {end}'s range stops it"))
}
