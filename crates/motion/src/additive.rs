//! Motion that is added to other motion: what differs from a reference.

use std::collections::BTreeMap;

use rig::{Angles, Bone, Figure};

use crate::{Clip, Key, Mode, Sample, Track};

impl Clip {
    /// What the clip does beyond a reference, key by key: sampled, it can be [added](Sample::add) to any sample.
    ///
    /// It has a track for every joint that the reference bends, and no root. Between the keys of [`Mode::Linear`] a ball
    /// joint's angles deviate a little from the difference of what goes by the shortest turn. The figure tells where hips
    /// are that the clip doesn't name.
    pub fn less(&self, figure: &Figure, reference: &Sample) -> Clip {
        let rest = figure.skeleton.rest_position(Bone::Hips);
        let hips = self.hips.clone().unwrap_or_else(|| constant(rest));
        let mut joints: BTreeMap<Bone, Track<Angles>> = BTreeMap::new();
        for bone in Bone::ALL {
            let from = reference.angles[bone.index()];
            match self.joints.get(&bone) {
                Some(track) => joints.insert(bone, track.map(|angles| plus(angles, -1.0, from))),
                None if from != Angles::REST => joints.insert(bone, constant(plus(Angles::REST, -1.0, from))),
                None => None,
            };
        }
        let hips = hips.map(|hips| hips - reference.hips);
        Clip { root: None, hips: Some(hips), joints, ..self.clone() }
    }
}

impl Sample {
    /// Adds so much of a difference: 0 changes nothing. How feet bear stays.
    pub fn add(&mut self, difference: &Sample, amount: f64) {
        self.hips += difference.hips * amount;
        for (own, other) in self.angles.iter_mut().zip(&difference.angles) {
            *own = plus(*own, amount, *other);
        }
    }
}

fn plus(angles: Angles, amount: f64, other: Angles) -> Angles {
    Angles {
        flexion: angles.flexion + amount * other.flexion,
        abduction: angles.abduction + amount * other.abduction,
        twist: angles.twist + amount * other.twist,
    }
}

fn constant<T>(value: T) -> Track<T> {
    Track { mode: Mode::Step, keys: vec![Key { at_secs: 0.0, value }] }
}
