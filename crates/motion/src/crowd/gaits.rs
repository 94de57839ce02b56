//! Gaits for a crowd: joint turns of one stride at several speeds, in a table.

use glam::{DQuat, Quat};
use rig::{Bone, Figure};

use crate::Sample;

/// One stride at one speed.
#[derive(Clone, PartialEq, Debug)]
pub struct Gait {
    /// Metres a second.
    pub speed: f32,
    /// Seconds a stride.
    pub length_secs: f32,
    /// The stride at even phases, from 0 to just before 1; at least one.
    pub samples: Vec<Sample>,
}

/// The hips and every joint's turn at a phase.
#[derive(Clone, PartialEq, Debug)]
pub(super) struct Entry {
    pub hips: [f32; 3],
    pub turns: [[f32; 4]; Bone::COUNT],
}

/// Strides at several speeds. All walkers of a crowd read the same table.
#[derive(Clone, PartialEq, Debug)]
pub struct Gaits {
    pub(super) strides: Vec<Stride>,
    /// Bones whose turn is not the same all through the table.
    pub(super) moving: Vec<usize>,
}

#[derive(Clone, PartialEq, Debug)]
pub(super) struct Stride {
    pub speed: f32,
    pub per_sec: f32,
    /// One more than there are phases: the last is the first again, its turns within a half turn of those before.
    pub entries: Vec<Entry>,
}

impl Gaits {
    /// Makes the table. `None` without gaits, or if one has no samples, no length or a number that is not finite.
    pub fn new(figure: &Figure, gaits: &[Gait]) -> Option<Gaits> {
        let sound =
            |gait: &Gait| gait.speed.is_finite() && gait.length_secs > 0.0 && !gait.samples.is_empty();
        if gaits.is_empty() || !gaits.iter().all(sound) {
            return None;
        }
        let strides: Vec<Stride> = gaits.iter().map(|gait| stride(figure, gait)).collect();
        let first = &strides[0].entries[0];
        let moves = |bone: &usize| {
            strides.iter().flat_map(|s| &s.entries).any(|entry| entry.turns[*bone] != first.turns[*bone])
        };
        let moving = (0..Bone::COUNT).filter(moves).collect();
        Some(Gaits { strides, moving })
    }
}

fn stride(figure: &Figure, gait: &Gait) -> Stride {
    let mut entries: Vec<Entry> = Vec::with_capacity(gait.samples.len() + 1);
    for sample in gait.samples.iter().chain(&gait.samples[..1]) {
        let turns = turns(figure, sample, entries.last());
        entries.push(Entry { hips: sample.hips.as_vec3().to_array(), turns });
    }
    Stride { speed: gait.speed, per_sec: 1.0 / gait.length_secs, entries }
}

fn turns(figure: &Figure, sample: &Sample, before: Option<&Entry>) -> [[f32; 4]; Bone::COUNT] {
    Bone::ALL.map(|bone| {
        let joint = figure.skeleton.joint(bone);
        let turn = joint.map_or(DQuat::IDENTITY, |j| j.rotation(sample.angles[bone.index()])).as_quat();
        let last = before.map_or(Quat::IDENTITY, |entry| Quat::from_array(entry.turns[bone.index()]));
        if turn.dot(last) < 0.0 { -turn } else { turn }.to_array()
    })
}
