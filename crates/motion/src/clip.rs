//! A clip: keyed animation as its file says it, for flat ground.

use std::collections::BTreeMap;

use glam::DVec3;
use rig::{Angles, Bone, Figure, Place, Size};

use crate::track::{place_from, place_in};
use crate::{Bearing, Sample, Track, Travel};

/// Keyed animation of a figure on flat ground at height 0.
#[derive(Clone, PartialEq, Debug)]
pub struct Clip {
    /// The name that trees and reports use.
    pub name: String,
    /// The name of the figure that it was made with.
    pub figure: Option<String>,
    /// The size of that figure.
    pub size: Option<Size>,
    /// Seconds, positive.
    pub length_secs: f64,
    /// Whether the end goes over into the start.
    pub loops: bool,
    /// Whether one length is one stride that begins with the left heel's contact, so that it keeps step with others.
    pub stride: bool,
    /// Where the whole figure is, against where it started: root motion. Empty keys: it stays. In a clip that loops the
    /// keys go from 0 to the clip's length, and every loop goes on from where the one before ended.
    pub root: Option<Track<Place>>,
    /// The hips joint in figure space, metres.
    pub hips: Option<Track<DVec3>>,
    /// Joint angles, degrees; joints that are not named stay at rest.
    pub joints: BTreeMap<Bone, Track<Angles>>,
}

impl Clip {
    /// The length of a loop, seconds; `None` for a clip that doesn't.
    pub fn loop_secs(&self) -> Option<f64> {
        self.loops.then_some(self.length_secs)
    }

    /// The figure at a time, on flat ground, without root motion; bearing is left at 0. Never allocates.
    ///
    /// The figure tells which joints are ball joints, and where the hips are if the clip doesn't say.
    pub fn sample(&self, figure: &Figure, secs: f64, out: &mut Sample) {
        let around = self.loop_secs();
        let hips = self.hips.as_ref().map(|track| track.at(secs, around));
        out.hips = hips.unwrap_or_else(|| figure.skeleton.rest_position(Bone::Hips));
        out.angles = [Angles::REST; Bone::COUNT];
        for (bone, track) in &self.joints {
            out.angles[bone.index()] = track.angles_at(secs, around, figure.skeleton.joint(*bone));
        }
        out.bearing = [Bearing::default(); 2];
    }

    /// Where the whole figure is at a time against where it was at 0. Loops go on from where the one before ended, also
    /// before 0; other clips stay at their ends. A time that is not finite counts as 0.
    pub fn root_at(&self, secs: f64) -> Place {
        let secs = if secs.is_finite() { secs } else { 0.0 };
        if !self.loops {
            return self.root_within(secs.clamp(0.0, self.length_secs));
        }
        let rounds = (secs / self.length_secs).floor();
        let within = (secs - rounds * self.length_secs).clamp(0.0, self.length_secs);
        let place = self.root_within(within);
        if rounds == 0.0 { place } else { place_in(repeated(self.root_travel(), rounds), place) }
    }

    /// Where one length of the clip takes the whole figure.
    pub fn root_travel(&self) -> Place {
        self.root_within(self.length_secs)
    }

    /// The steady travel that gets the figure as far as the clip does.
    pub fn travel(&self) -> Travel {
        Travel::to_place(self.root_travel(), self.length_secs)
    }

    /// The root's place within one length, its end included.
    fn root_within(&self, secs: f64) -> Place {
        let Some(track) = &self.root else { return Place::default() };
        // The loop makes the rate continuous, but its end is not its start: the figure went on.
        let around = self.loop_secs().filter(|length| secs < *length);
        place_from(track.at(0.0, None), track.at(secs, around))
    }
}

/// A place taken as a step that is made so many times; backward for negative numbers.
fn repeated(step: Place, times: f64) -> Place {
    let mut left = times.abs() as u64;
    let mut power = if times < 0.0 { place_from(step, Place::default()) } else { step };
    let mut sum = Place::default();
    while left > 0 {
        if left % 2 == 1 {
            sum = place_in(sum, power);
        }
        power = place_in(power, power);
        left /= 2;
    }
    sum
}
