//! `cargo xtask clips`: makes the shipped clips from gait data and hand-set keys.

mod aside;
mod carriage;
mod curve;
mod idle;
mod jog;
mod leg;
mod motion;
mod path;
mod rising;
mod sole;
mod step;
mod walk;

use ::motion::write_clip;
use anyhow::Context;
use rig::Figure;

use motion::Motion;

/// Every motion that ships. `None` if the figure lacks a part.
fn motions(figure: &Figure) -> Option<Vec<Motion>> {
    let (arc, strafe, turn) = (walk::walk_turn(), aside::strafe(), aside::turn());
    let motions = [
        idle::idle(),
        walk::walk(),
        arc.mirrored("walk-turn-right"),
        arc,
        walk::walk_back(),
        jog::jog(),
        strafe.mirrored("strafe-right"),
        strafe,
        turn.mirrored("turn-right"),
        turn,
        rising::sit_to_stand(),
    ];
    motions.into_iter().map(|motion| motion.settled(figure)).collect()
}

/// Makes the clips and writes them into the folder of the clips.
///
/// # Errors
/// The shipped figure can't be read or lacks a part; a file can't be written.
pub fn run() -> anyhow::Result<()> {
    let figure = interchange::figure::bare_mannequin()?;
    let folder = crate::root().join("assets/clips");
    std::fs::create_dir_all(&folder).with_context(|| format!("cannot make {}", folder.display()))?;
    let lacks = || format!("{} lacks a part", figure.name);
    for motion in motions(&figure).with_context(lacks)? {
        let clip = motion.clip(&figure).with_context(lacks)?;
        let path = folder.join(format!("{}.clip.ron", motion.name));
        std::fs::write(&path, write_clip(&clip))
            .with_context(|| format!("cannot write {}", path.display()))?;
        println!("{}: {} s", motion.name, motion.length_secs);
    }
    Ok(())
}

#[cfg(test)]
mod tests;
