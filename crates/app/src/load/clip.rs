//! Clips from their files, and the poses of their moments.

use std::path::Path;

use motion::{Clip, FittedClip, Sample};
use rig::{Figure, Pose};

use super::at;
use crate::disk::read_text;
use crate::failure::Failure;
use crate::library::clips;

/// Reads a `*.clip.ron` file, or one that comes with the program, `library:NAME.clip.ron`.
///
/// # Errors
/// A file at fault: where and why.
pub fn clip(path: &Path) -> Result<Clip, Failure> {
    motion::parse_clip(&motion_text(path)?).map_err(|fault| at(path, &fault))
}

/// The text of a clip's or a tree's file, or of one that comes with the program.
pub(super) fn motion_text(path: &Path) -> Result<String, Failure> {
    match clips::text(&path.to_string_lossy()) {
        Some(found) => found.map(str::to_owned).map_err(Failure::Input),
        None => read_text(path),
    }
}

/// The pose of a figure in a clip that was fitted to it, after so many seconds: where the clip has carried it, over level
/// ground.
pub fn pose_at(figure: &Figure, clip: &FittedClip, secs: f64) -> Pose {
    let mut sample = Sample::at_rest(figure);
    clip.sample(secs / clip.length_secs(), &mut sample);
    let place = clip.travel().place_after(secs);
    Pose { place, hips: sample.hips, angles: sample.angles, ..figure.rest_pose() }
}
