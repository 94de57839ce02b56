//! Keys of one value over time.

use glam::{DQuat, DVec3};
use rig::{Angles, Articulation, Joint, Place};
use serde::{Deserialize, Serialize};

/// How a track goes from key to key.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub enum Mode {
    /// Stays on a key until the next.
    Step,
    /// Straight from key to key; ball joints by the shortest turn (slerp).
    Linear,
    /// Through the keys with a continuous rate (Catmull-Rom over uneven times); across the seam of a loop, too.
    #[default]
    Cubic,
}

/// A value at a time.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Key<T> {
    /// Seconds from the clip's start.
    pub at_secs: f64,
    /// The value then.
    pub value: T,
}

/// Keys in order of time, at least one.
#[derive(Clone, PartialEq, Debug)]
pub struct Track<T> {
    /// How it goes between them.
    pub mode: Mode,
    /// The keys.
    pub keys: Vec<Key<T>>,
}

/// A value that tracks can hold: some numbers that are interpolated each on its own.
pub trait Keyed: Copy {
    /// The numbers, 0 where there are fewer.
    fn numbers(self) -> [f64; 4];
    /// The value of some numbers.
    fn from_numbers(numbers: [f64; 4]) -> Self;
    /// What the same motion one loop later makes of the value, where `loop_start` became `loop_end`: the value itself,
    /// but for places, which go on from where the loop before ended.
    fn looped(self, _loop_start: Self, _loop_end: Self) -> Self {
        self
    }
}

impl Keyed for DVec3 {
    fn numbers(self) -> [f64; 4] {
        [self.x, self.y, self.z, 0.0]
    }
    fn from_numbers([x, y, z, _]: [f64; 4]) -> DVec3 {
        DVec3::new(x, y, z)
    }
}

impl Keyed for Angles {
    fn numbers(self) -> [f64; 4] {
        [self.flexion, self.abduction, self.twist, 0.0]
    }
    fn from_numbers([flexion, abduction, twist, _]: [f64; 4]) -> Angles {
        Angles { flexion, abduction, twist }
    }
}

impl Keyed for Place {
    fn numbers(self) -> [f64; 4] {
        [self.position.x, self.position.y, self.position.z, self.turn]
    }
    fn from_numbers([x, y, z, turn]: [f64; 4]) -> Place {
        Place { position: DVec3::new(x, y, z), turn }
    }
    fn looped(self, loop_start: Place, loop_end: Place) -> Place {
        place_in(loop_end, place_from(loop_start, self))
    }
}

/// A place that is given in another one, in that one's space. Turns add up beyond 360 degrees.
pub(crate) fn place_in(outer: Place, inner: Place) -> Place {
    let position = outer.world_from_figure().point(inner.position);
    Place { position, turn: outer.turn + inner.turn }
}

/// A place as seen from another: the inverse of [`place_in`].
pub(crate) fn place_from(outer: Place, place: Place) -> Place {
    let position = outer.world_from_figure().inverse().point(place.position);
    Place { position, turn: place.turn - outer.turn }
}

impl<T: Keyed> Track<T> {
    /// The value at a time, seconds.
    ///
    /// In a loop of that length (`None`: none) any time is brought into it, and the last key leads over to the first; a
    /// key at the very end is the same moment as the start, one loop later. Otherwise times beyond the keys have the
    /// nearest key's value. On a key the value is the key's, bit for bit. A time that is not finite counts as 0; a
    /// track without keys has zeros. Never allocates.
    pub fn at(&self, secs: f64, loop_secs: Option<f64>) -> T {
        self.at_with(secs, loop_secs, linear)
    }

    fn at_with(&self, secs: f64, loop_secs: Option<f64>, straight: impl Fn(T, T, f64) -> T) -> T {
        let secs = if secs.is_finite() { secs } else { 0.0 };
        let loop_secs = loop_secs.filter(|length| *length > 0.0 && self.keys.len() > 1);
        let secs = loop_secs.map_or(secs, |length| wrapped(secs, length));
        let next = self.keys.partition_point(|key| key.at_secs <= secs) as isize;
        let (Some(a), Some(b)) = (self.key(next - 1, loop_secs), self.key(next, loop_secs)) else {
            let nearest = if next == 0 { self.keys.first() } else { self.keys.last() };
            return nearest.map_or(T::from_numbers([0.0; 4]), |key| key.value);
        };
        let span = b.at_secs - a.at_secs;
        if secs == a.at_secs || span <= 0.0 {
            return a.value;
        }
        if secs == b.at_secs {
            return b.value;
        }
        let u = (secs - a.at_secs) / span;
        match self.mode {
            Mode::Step => a.value,
            Mode::Linear => straight(a.value, b.value, u),
            Mode::Cubic => {
                let before = self.key(next - 2, loop_secs);
                let after = self.key(next + 1, loop_secs);
                T::from_numbers(cubic(before.map(numbers), numbers(a), numbers(b), after.map(numbers), u))
            }
        }
    }

    /// A key by its number; in a loop, numbers go on before the first and beyond the last.
    fn key(&self, number: isize, loop_secs: Option<f64>) -> Option<Key<T>> {
        let count = self.keys.len() as isize;
        if (0..count).contains(&number) {
            return Some(self.keys[number as usize]);
        }
        let length = loop_secs?;
        let (first, last) = (self.keys.first()?, self.keys.last()?);
        // A key at the end and one at the start are one moment: only one of the two counts.
        let own = if last.at_secs - first.at_secs >= length { count - 1 } else { count };
        let (around, within) = (number.div_euclid(own), number.rem_euclid(own));
        let key = self.keys.get(within as usize)?;
        let (from, to) = if around < 0 { (last.value, first.value) } else { (first.value, last.value) };
        let value = (0..around.abs()).fold(key.value, |value, _| value.looped(from, to));
        Some(Key { at_secs: key.at_secs + length * around as f64, value })
    }
}

impl<T: Copy> Track<T> {
    /// The track with every key's value changed.
    pub(crate) fn map(&self, change: impl Fn(T) -> T) -> Track<T> {
        let keys = self.keys.iter().map(|key| Key { at_secs: key.at_secs, value: change(key.value) });
        Track { mode: self.mode, keys: keys.collect() }
    }
}

impl Track<Angles> {
    /// The angles at a time, seconds, as [`Track::at`] has them; in [`Mode::Linear`] a ball joint goes by the shortest
    /// turn. `None` for the joint takes every angle on its own.
    pub fn angles_at(&self, secs: f64, loop_secs: Option<f64>, joint: Option<&Joint>) -> Angles {
        let Some(joint) = joint.filter(|j| matches!(j.articulation, Articulation::Ball { .. })) else {
            return self.at(secs, loop_secs);
        };
        self.at_with(secs, loop_secs, |a, b, u| shortest_turn(joint, a, b, u))
    }
}

/// A time brought into `[0, length)`.
pub(crate) fn wrapped(secs: f64, length: f64) -> f64 {
    let within = secs.rem_euclid(length);
    if within < length { within } else { 0.0 }
}

fn numbers<T: Keyed>(key: Key<T>) -> (f64, [f64; 4]) {
    (key.at_secs, key.value.numbers())
}

/// Straight between two values, never beyond either.
fn linear<T: Keyed>(a: T, b: T, u: f64) -> T {
    let (a, b) = (a.numbers(), b.numbers());
    let between = |i: usize| (a[i] + (b[i] - a[i]) * u).clamp(a[i].min(b[i]), a[i].max(b[i]));
    T::from_numbers(std::array::from_fn(between))
}

fn shortest_turn(joint: &Joint, from: Angles, to: Angles, u: f64) -> Angles {
    let Articulation::Ball { ball, .. } = &joint.articulation else { return linear(from, to, u) };
    let (a, b) = (joint.rotation(from), joint.rotation(to));
    let turn = a.conjugate() * b;
    let turn = if turn.w < 0.0 { -turn } else { turn };
    let angles = ball.angles(a * DQuat::from_scaled_axis(turn.to_scaled_axis() * u));
    let [flexion, abduction, twist] = angles.map(f64::to_degrees);
    Angles { flexion, abduction, twist }
}

/// Hermite between the middle two of four keys. The rate at a key is that of the parabola through it and its neighbours:
/// Catmull-Rom for uneven times. At a track's end it is that of the straight line.
fn cubic(
    before: Option<(f64, [f64; 4])>,
    (ta, a): (f64, [f64; 4]),
    (tb, b): (f64, [f64; 4]),
    after: Option<(f64, [f64; 4])>,
    u: f64,
) -> [f64; 4] {
    let span = tb - ta;
    let rate = |i: usize, other: Option<(f64, [f64; 4])>, own: (f64, f64), towards: f64| {
        let slope = (b[i] - a[i]) / span;
        let Some((t, value)) = other else { return slope };
        let beside = (t - own.0).abs();
        if beside == 0.0 {
            return slope;
        }
        let far = towards * (value[i] - own.1) / beside;
        (slope * beside + far * span) / (beside + span)
    };
    std::array::from_fn(|i| {
        let ra = rate(i, before, (ta, a[i]), -1.0) * span;
        let rb = rate(i, after, (tb, b[i]), 1.0) * span;
        let (u2, u3) = (u * u, u * u * u);
        a[i] + (b[i] - a[i]) * (3.0 * u2 - 2.0 * u3) + ra * (u3 - 2.0 * u2 + u) + rb * (u3 - u2)
    })
}
