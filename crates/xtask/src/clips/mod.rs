//! `cargo xtask clips`: makes the shipped clips from gait data and hand-set keys.

mod carriage;
mod curve;
mod idle;
mod leg;
pub mod motion;
mod path;
mod sole;
mod step;
pub mod walk;

use ::motion::write_clip;
use anyhow::Context;

use motion::Motion;

/// Every motion that ships.
pub fn motions() -> Vec<Motion> {
    vec![idle::idle(), walk::walk()]
}

/// Makes the clips and writes them into the folder of the clips.
///
/// # Errors
/// The shipped figure can't be read or lacks a part; a file can't be written.
pub fn run() -> anyhow::Result<()> {
    let figure = interchange::figure::bare_mannequin()?;
    let folder = crate::root().join("assets/clips");
    std::fs::create_dir_all(&folder).with_context(|| format!("cannot make {}", folder.display()))?;
    for motion in motions() {
        let clip = motion.clip(&figure).with_context(|| format!("{} lacks a part", figure.name))?;
        let path = folder.join(format!("{}.clip.ron", motion.name));
        std::fs::write(&path, write_clip(&clip))
            .with_context(|| format!("cannot write {}", path.display()))?;
        println!("{}: {} s", motion.name, motion.length_secs);
    }
    Ok(())
}
