//! Time of the walk: frames hand in what has passed, fixed steps come out, as many for any rate of frames.

/// One step, seconds.
pub const STEP_SECS: f64 = 1.0 / 120.0;
/// A frame that takes longer is as if the program had stood still for the rest of it, seconds.
const LONGEST_SECS: f64 = 0.25;
/// Sums of frames' times come so near to whole steps.
const NEAR_SECS: f64 = 1e-9;

/// How fast time runs.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Motion {
    /// As it is.
    #[default]
    Real,
    /// At a half.
    Half,
    /// At a quarter.
    Quarter,
    /// At a tenth.
    Tenth,
}

impl Motion {
    /// All, fastest first.
    pub const ALL: [Motion; 4] = [Motion::Real, Motion::Half, Motion::Quarter, Motion::Tenth];

    /// Seconds of the walk in a second.
    pub const fn rate(self) -> f64 {
        match self {
            Motion::Real => 1.0,
            Motion::Half => 0.5,
            Motion::Quarter => 0.25,
            Motion::Tenth => 0.1,
        }
    }

    /// As its button has it.
    pub const fn words(self) -> &'static str {
        match self {
            Motion::Real => "1×",
            Motion::Half => "1/2",
            Motion::Quarter => "1/4",
            Motion::Tenth => "1/10",
        }
    }

    /// Its name in full.
    pub const fn name(self) -> &'static str {
        match self {
            Motion::Real => "Time at its own pace",
            Motion::Half => "Time at a half",
            Motion::Quarter => "Time at a quarter",
            Motion::Tenth => "Time at a tenth",
        }
    }

    /// The next slower one; after the slowest the first again.
    pub fn next(self) -> Motion {
        Motion::ALL[(self as usize + 1) % Motion::ALL.len()]
    }
}

/// The clock of a walk.
#[derive(Clone, PartialEq, Debug)]
pub struct Clock {
    /// Whether time runs.
    pub playing: bool,
    /// How fast.
    pub motion: Motion,
    /// What has passed and is no whole step yet, seconds.
    owed_secs: f64,
    /// A single step was asked for.
    step_asked: bool,
    /// Steps since the start.
    steps: u64,
}

impl Default for Clock {
    fn default() -> Clock {
        Clock { playing: true, motion: Motion::default(), owed_secs: 0.0, step_asked: false, steps: 0 }
    }
}

impl Clock {
    /// A frame of so many seconds has passed: how many steps are to be made. Time that isn't positive and finite is none.
    pub fn advance(&mut self, frame_secs: f64) -> u32 {
        let steps = if std::mem::take(&mut self.step_asked) {
            self.owed_secs = 0.0;
            1
        } else if self.playing && frame_secs > 0.0 && frame_secs.is_finite() {
            self.owed_secs += frame_secs.min(LONGEST_SECS) * self.motion.rate();
            let steps = ((self.owed_secs + NEAR_SECS) / STEP_SECS).floor();
            self.owed_secs = (self.owed_secs - steps * STEP_SECS).max(0.0);
            steps as u32
        } else {
            0
        };
        self.steps += u64::from(steps);
        steps
    }

    /// How far time is into the next step, 0 to 1: what is shown lies so far between the last two steps.
    pub fn between(&self) -> f64 {
        if self.playing { (self.owed_secs / STEP_SECS).clamp(0.0, 1.0) } else { 1.0 }
    }

    /// Halts, and goes on by one step with the next frame.
    pub fn single(&mut self) {
        self.playing = false;
        self.step_asked = true;
    }

    /// Back to the start.
    pub fn restart(&mut self) {
        (self.owed_secs, self.step_asked, self.steps) = (0.0, false, 0);
    }

    /// Seconds since the start.
    pub fn secs(&self) -> f64 {
        self.steps as f64 * STEP_SECS
    }

    /// Steps since the start.
    pub fn steps(&self) -> u64 {
        self.steps
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_don_t_matter() {
        for motion in Motion::ALL {
            let run = |rate: u32| {
                let mut clock = Clock { motion, ..Clock::default() };
                let steps: u32 = (0..rate * 10).map(|_| clock.advance(1.0 / f64::from(rate))).sum();
                (steps, clock.steps())
            };
            let wanted = (1200.0 * motion.rate()).round() as u32;
            for rate in [10, 24, 30, 60, 144, 1000] {
                assert_eq!(run(rate), (wanted, u64::from(wanted)), "{motion:?} at {rate}");
            }
        }
    }

    #[test]
    fn halted_time_goes_by_single_steps_and_a_long_frame_is_cut() {
        let mut clock = Clock { playing: false, ..Clock::default() };
        assert_eq!(clock.advance(1.0), 0);
        clock.single();
        assert_eq!((clock.advance(0.001), clock.advance(1.0)), (1, 0));
        clock.playing = true;
        assert_eq!(clock.advance(60.0), 30);
        for bad in [f64::NAN, f64::INFINITY, -1.0, 0.0] {
            assert_eq!(clock.advance(bad), 0);
        }
        clock.restart();
        assert_eq!(clock.secs(), 0.0);
    }

    #[test]
    fn slow_motion_goes_round() {
        let mut motion = Motion::Real;
        for _ in Motion::ALL {
            motion = motion.next();
        }
        assert_eq!(motion, Motion::Real);
    }
}
