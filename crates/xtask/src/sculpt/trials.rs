//! The poses that weights are mended by: joints at their extremes, and every pose that is shipped.

use anyhow::Context;
use rig::{Angles, Bone, Figure, Palette, Skeleton};

use super::buried::Depths;
use super::stances::{Stance, extremes, relaxed, together};

/// A pose by its name.
pub struct Trial {
    /// Joints and angles or the file's name, for messages.
    pub name: String,
    /// Where it takes the skin.
    pub palette: Palette,
}

/// All of them, for the left half.
///
/// # Errors
/// A shipped pose that cannot be read.
pub fn trials(skeleton: &Skeleton, depths: &Depths) -> anyhow::Result<Vec<Trial>> {
    let mut all = Vec::new();
    // Cones stand in the figure file; without it, nothing but single extremes is known.
    let figure = interchange::figure::bare_mannequin().ok();
    let ranges = figure.as_ref().map_or(skeleton, |figure| &figure.skeleton);
    for stance in training(ranges) {
        all.extend(
            depths.freed(skeleton, stance).map(|(stance, palette)| Trial { name: stance.name, palette }),
        );
    }
    if let Some(figure) = &figure {
        for (name, palette) in shipped(figure)? {
            all.push(Trial { name, palette });
        }
    }
    Ok(all)
}

/// The left half's extremes from rest; around the shoulder from hanging arms, too. Nothing of the left half follows the
/// right side, so that may stay at rest.
fn training(ranges: &Skeleton) -> Vec<Stance> {
    let mut all = extremes(ranges, &[Angles::REST; Bone::COUNT], 1);
    let moves = |s: &Stance, bones: &[Bone]| bones.iter().any(|b| s.name.starts_with(b.name()));
    let near = [Bone::LeftShoulder, Bone::UpperChest, Bone::Neck];
    all.extend(extremes(ranges, &relaxed(), 1).into_iter().filter(|s| moves(s, &near)));
    all.extend(together(ranges));
    all
}

/// The poses of the library and their mirror images.
///
/// # Errors
/// One that cannot be read.
pub fn shipped(figure: &Figure) -> anyhow::Result<Vec<(String, Palette)>> {
    let folder = crate::root().join("assets/poses");
    let read = || -> std::io::Result<Vec<_>> { std::fs::read_dir(&folder)?.map(|f| Ok(f?.path())).collect() };
    let mut files = read().with_context(|| format!("cannot list {}", folder.display()))?;
    files.sort();
    let rest = Bone::ALL.map(|b| figure.skeleton.rest_position(b));
    let mut all = Vec::new();
    for path in files.iter().filter(|p| p.to_string_lossy().ends_with(".pose.ron")) {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let text =
            std::fs::read_to_string(path).with_context(|| format!("cannot read {}", path.display()))?;
        let patch = rig::parse_pose(&text).with_context(|| format!("{name} is no pose"))?;
        let pose = patch.onto(&figure.rest_pose());
        let image = rig::mirrored_pose(&pose);
        for (pose, side) in [(pose, ""), (image, " mirrored")] {
            all.push((format!("{name}{side}"), Palette::new(&rig::frames(figure, &pose), &rest)));
        }
    }
    Ok(all)
}
