//! Speed under a held key: it grows while the key is down, up to a cap, and fades when it is let go.
//!
//! The law is told in frames of a thirtieth of a second, as on the excavator that it comes from, and integrated exactly:
//! where something is after a while doesn't depend on how the while was cut into frames.

/// Frames a second in which [`DriveLaw`] is told.
pub const DRIVE_FRAMES_PER_SEC: f64 = 30.0;
/// Below this part of the gain of one frame what fades has stopped.
const STOPPED: f64 = 0.01;

/// How speed grows and fades; units are the user's: degrees, or metres.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct DriveLaw {
    /// What a frame of a thirtieth of a second adds to the way of the next one.
    pub gain: f64,
    /// The most that a frame moves.
    pub cap: f64,
    /// The part of the speed that a frame without a key leaves, above 0 and below 1.
    pub left: f64,
}

impl DriveLaw {
    /// That of turns, in degrees.
    pub const TURNS: DriveLaw = DriveLaw { gain: 0.2, cap: 5.0, left: 0.8 };

    /// The same law in another unit.
    #[must_use]
    pub fn scaled(self, factor: f64) -> DriveLaw {
        DriveLaw { gain: self.gain * factor, cap: self.cap * factor, ..self }
    }
}

/// The key that is held.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Push {
    /// Toward smaller values.
    Down,
    /// None.
    #[default]
    None,
    /// Toward larger values.
    Up,
}

/// Something that keys drive.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Drive {
    /// Units a frame of a thirtieth of a second.
    speed: f64,
}

impl Drive {
    /// The speed, units a second; negative toward smaller values.
    pub fn per_sec(self) -> f64 {
        self.speed * DRIVE_FRAMES_PER_SEC
    }

    /// Whether nothing moves.
    pub fn is_still(self) -> bool {
        self.speed == 0.0
    }

    /// Stops at once: what is driven has come to its end.
    pub fn stop(&mut self) {
        self.speed = 0.0;
    }

    /// Goes on for a while, seconds, and tells how far things went. A key against the motion stops it first. Time that
    /// isn't positive and finite is none.
    pub fn go(&mut self, secs: f64, push: Push, law: DriveLaw) -> f64 {
        if !(secs > 0.0 && secs.is_finite()) {
            return 0.0;
        }
        let frames = secs * DRIVE_FRAMES_PER_SEC;
        let way = match push {
            Push::None => return self.fade(frames, law),
            Push::Up => 1.0,
            Push::Down => -1.0,
        };
        let first = (self.speed * way).max(0.0).min(law.cap);
        // The cap is met on the way or not at all.
        let rising = ((law.cap - first) / law.gain).clamp(0.0, frames);
        let last = if rising < frames { law.cap } else { first + law.gain * frames };
        self.speed = way * last;
        way * (0.5 * (first + last) * rising + law.cap * (frames - rising))
    }

    fn fade(&mut self, frames: f64, law: DriveLaw) -> f64 {
        let (first, least) = (self.speed, STOPPED * law.gain);
        if first.abs() <= least {
            self.stop();
            return 0.0;
        }
        let rate = law.left.ln();
        let until_stopped = (least / first.abs()).ln() / rate;
        let last =
            if until_stopped <= frames { least.copysign(first) } else { first * (rate * frames).exp() };
        self.speed = if until_stopped <= frames { 0.0 } else { last };
        (last - first) / rate
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: DriveLaw = DriveLaw::TURNS;

    /// How far and how fast after so many seconds up and then so many without a key, at a frame rate.
    fn drive(rate: u32, up: u32, free: u32) -> (f64, f64) {
        let (mut drive, mut at) = (Drive::default(), 0.0);
        let secs = 1.0 / f64::from(rate);
        (0..up * rate).for_each(|_| at += drive.go(secs, Push::Up, LAW));
        (0..free * rate).for_each(|_| at += drive.go(secs, Push::None, LAW));
        (at, drive.per_sec())
    }

    #[test]
    fn a_frame_of_a_thirtieth_adds_two_tenths_of_a_degree_up_to_five() {
        let mut drive = Drive::default();
        let mut speeds = Vec::new();
        for _ in 0..40 {
            drive.go(1.0 / 30.0, Push::Up, LAW);
            speeds.push(drive.per_sec() / 30.0);
        }
        assert!((speeds[0] - 0.2).abs() < 1e-12 && (speeds[9] - 2.0).abs() < 1e-12);
        assert!((speeds[24] - 5.0).abs() < 1e-12 && speeds[39] == 5.0);
        drive.go(1.0 / 30.0, Push::None, LAW);
        assert!((drive.per_sec() / 30.0 - 4.0).abs() < 1e-12);
        drive.go(2.0 / 30.0, Push::None, LAW);
        assert!((drive.per_sec() / 30.0 - 2.56).abs() < 1e-12);
    }

    #[test]
    fn frames_don_t_matter() {
        for (up, free) in [(1, 0), (2, 0), (1, 1), (2, 3)] {
            let (at, speed) = drive(30, up, free);
            for rate in [10, 24, 60, 144, 1000] {
                let other = drive(rate, up, free);
                assert!((other.0 - at).abs() < 1e-9 && (other.1 - speed).abs() < 1e-9, "{rate}: {other:?}");
            }
        }
        let (at, _) = drive(30, 1, 0);
        // 25 frames to the cap, half of five degrees each, then five frames of five.
        assert!((at - (25.0 * 2.5 + 5.0 * 5.0)).abs() < 1e-9, "{at}");
    }

    #[test]
    fn what_fades_comes_to_rest_and_the_other_key_turns_at_once() {
        let mut drive = Drive::default();
        drive.go(1.0, Push::Up, LAW);
        assert!(drive.go(0.1, Push::Down, LAW) < 0.0);
        drive.go(3.0, Push::None, LAW);
        assert!(drive.is_still() && drive.go(1.0, Push::None, LAW) == 0.0);
        drive.go(0.5, Push::Down, LAW);
        drive.stop();
        assert!(drive.is_still());
    }

    #[test]
    fn no_time_is_no_way() {
        let mut drive = Drive::default();
        for secs in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert_eq!(drive.go(secs, Push::Up, LAW), 0.0);
            assert!(drive.is_still());
        }
    }
}
