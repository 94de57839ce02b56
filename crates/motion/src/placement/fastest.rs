//! How fast a motion's own turns were, lately.

/// How long a motion's fastest turn counts, seconds: a third is left of it then.
const REMEMBERED_SECS: f64 = 6.0;

/// The fastest of a motion's turns, each counting for some seconds; an angle a second.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Fastest(f64);

impl Fastest {
    /// The share that is left of what was seen before, after a time step of some seconds.
    pub fn left(dt_secs: f64) -> f64 {
        (-dt_secs / REMEMBERED_SECS).exp()
    }

    /// Takes in by how much the motion turned in a time step, and that share.
    pub fn see(&mut self, turned: f64, left: f64, dt_secs: f64) {
        self.0 = (self.0 * left).max(turned / dt_secs);
    }

    /// What may be turned in some seconds: `at_least` an angle a second, for a motion that was seen for a moment only.
    pub fn most(self, at_least: f64, secs: f64) -> f64 {
        self.0.max(at_least) * secs
    }
}
