//! Clips with other keys: at even times, from another start, backward, or a part.

use rig::{Angles, Bone, Figure, Place};

use crate::track::{place_from, wrapped};
use crate::{Clip, Key, Keyed, Mode, Track};

impl Clip {
    /// The clip with keys at equal times, about so many a second, straight between: what other programs and dense
    /// tables want. The clip's figure tells its ball joints. A rate that is no positive number counts as 1; at most a
    /// thousand a second.
    pub fn resampled(&self, figure: &Figure, rate: f64) -> Clip {
        let rate = if rate.is_finite() && rate > 0.0 { rate.min(1000.0) } else { 1.0 };
        let steps = (self.length_secs * rate).round().max(1.0) as usize;
        let at = |i: usize| self.length_secs * (i as f64 / steps as f64);
        let (around, own) = (self.loop_secs(), steps + usize::from(!self.loops));
        let joint = |(bone, track): (&Bone, &Track<Angles>)| {
            let joint = figure.skeleton.joint(*bone);
            (*bone, keyed((0..own).map(|i| (at(i), track.angles_at(at(i), around, joint)))))
        };
        Clip {
            root: self.root.as_ref().map(|_| keyed((0..=steps).map(|i| (at(i), self.root_at(at(i)))))),
            hips: self.hips.as_ref().map(|hips| keyed((0..own).map(|i| (at(i), hips.at(at(i), around))))),
            joints: self.joints.iter().map(joint).collect(),
            ..self.clone()
        }
    }

    /// A loop that starts later by so many seconds; other clips stay as they are.
    ///
    /// Keys keep their values; a key at the end, which the first one repeats, goes. The root starts at the origin again; it
    /// gets a key where it is cut.
    pub fn shifted(&self, by_secs: f64) -> Clip {
        let Some(length) = self.loop_secs().filter(|_| by_secs.is_finite()) else { return self.clone() };
        let by = wrapped(by_secs, length);
        Clip {
            root: self.root.as_ref().map(|root| self.shifted_root(root, by)),
            hips: self.hips.as_ref().map(|hips| shifted(hips, by, length)),
            joints: self.joints.iter().map(|(bone, track)| (*bone, shifted(track, by, length))).collect(),
            ..self.clone()
        }
    }

    fn shifted_root(&self, root: &Track<Place>, by: f64) -> Track<Place> {
        let start = self.root_at(by);
        let inner = shifted(root, by, self.length_secs).keys.into_iter().map(|key| key.at_secs);
        let inner = inner.filter(|at| *at > 0.0 && *at < self.length_secs);
        let times = std::iter::once(0.0).chain(inner).chain([self.length_secs]);
        let place = |at: f64| (at, place_from(start, self.root_at(at + by)));
        Track { mode: root.mode, ..keyed(times.map(place)) }
    }

    /// The clip backward. Steps take the value that they had until a key, so they change a key later.
    pub fn reversed(&self) -> Clip {
        let end = self.root_travel();
        let length = self.length_secs;
        let root = |root: &Track<Place>| {
            let place = |key: &Key<Place>| (length - key.at_secs, place_from(end, self.root_at(key.at_secs)));
            Track { mode: root.mode, ..keyed(root.keys.iter().rev().map(place)) }
        };
        Clip {
            root: self.root.as_ref().map(root),
            hips: self.hips.as_ref().map(|hips| reversed(hips, length)),
            joints: self.joints.iter().map(|(bone, track)| (*bone, reversed(track, length))).collect(),
            stride: false,
            ..self.clone()
        }
    }

    /// The part between two times, seconds, which doesn't loop; keys are set where it is cut. Times are brought into the
    /// clip; a part shorter than a hundredth of a second is one.
    pub fn cut(&self, figure: &Figure, from_secs: f64, to_secs: f64) -> Clip {
        let from = if from_secs.is_finite() { from_secs.clamp(0.0, self.length_secs) } else { 0.0 };
        let to = if to_secs.is_finite() { to_secs.min(self.length_secs) } else { self.length_secs };
        let length_secs = (to - from).max(0.01);
        let start = self.root_at(from);
        let around = self.loop_secs();
        let root = |root: &Track<Place>| cut(root, from, length_secs, |t| place_from(start, self.root_at(t)));
        let joint = |(bone, track): (&Bone, &Track<Angles>)| {
            let joint = figure.skeleton.joint(*bone);
            (*bone, cut(track, from, length_secs, |t| track.angles_at(t, around, joint)))
        };
        Clip {
            length_secs,
            loops: false,
            stride: false,
            root: self.root.as_ref().map(root),
            hips: self.hips.as_ref().map(|hips| cut(hips, from, length_secs, |t| hips.at(t, around))),
            joints: self.joints.iter().map(joint).collect(),
            ..self.clone()
        }
    }
}

fn keyed<T>(keys: impl Iterator<Item = (f64, T)>) -> Track<T> {
    Track { mode: Mode::Linear, keys: keys.map(|(at_secs, value)| Key { at_secs, value }).collect() }
}

fn shifted<T: Keyed>(track: &Track<T>, by: f64, length: f64) -> Track<T> {
    let mut keys = track.keys.clone();
    let closes = keys.len() > 1 && keys[keys.len() - 1].at_secs - keys[0].at_secs >= length;
    if closes {
        keys.pop();
    }
    for key in &mut keys {
        key.at_secs = wrapped(key.at_secs - by, length);
    }
    keys.sort_by(|a, b| a.at_secs.total_cmp(&b.at_secs));
    Track { mode: track.mode, keys }
}

fn reversed<T: Keyed>(track: &Track<T>, length: f64) -> Track<T> {
    let keys = track.keys.iter().rev().map(|key| Key { at_secs: length - key.at_secs, value: key.value });
    Track { mode: track.mode, keys: keys.collect() }
}

fn cut<T: Keyed>(track: &Track<T>, from: f64, length: f64, at: impl Fn(f64) -> T) -> Track<T> {
    let times = track.keys.iter().map(|key| key.at_secs - from).filter(|t| *t > 0.0 && *t < length);
    let times = std::iter::once(0.0).chain(times).chain([length]);
    Track { mode: track.mode, ..keyed(times.map(|t| (t, at(t + from)))) }
}
