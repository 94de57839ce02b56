//! Keys of one value over time.

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
