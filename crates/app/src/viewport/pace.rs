//! How well the picture is drawn while it moves: as well as leaves some twenty pictures a second, and in full at rest.
//!
//! A state machine over two kinds of news: that something moves, and how long a frame took. It goes down when frames are
//! late, up when the next better level is known or likely to be in time, and gives a better level that failed no second
//! try before a while has passed; so it doesn't flicker.

use render::Look;

/// How well a picture is drawn, best first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Default)]
pub enum Quality {
    /// As at rest.
    #[default]
    Full,
    /// Without ambient occlusion.
    Open,
    /// With one sample a pixel as well.
    Plain,
    /// Without shadows as well.
    Lean,
    /// With two thirds of the pixels along each edge.
    Coarse,
    /// With half of them.
    Coarsest,
}

impl Quality {
    /// All, best first.
    pub const ALL: [Quality; 6] =
        [Quality::Full, Quality::Open, Quality::Plain, Quality::Lean, Quality::Coarse, Quality::Coarsest];

    /// A look that is drawn so well.
    #[must_use]
    pub fn of(self, look: Look) -> Look {
        use render::Msaa;
        let open = Look { ambient_occlusion: false, ..look };
        let plain = Look { msaa: Msaa::One, ..open };
        match self {
            Quality::Full => look,
            Quality::Open => open,
            Quality::Plain => plain,
            Quality::Lean => look.lean(),
            Quality::Coarse => Look { scale: look.scale * 0.67, ..look.lean() },
            Quality::Coarsest => Look { scale: look.scale * 0.5, ..look.lean() },
        }
    }

    fn place(self) -> usize {
        self as usize
    }

    fn worse(self) -> Quality {
        Quality::ALL[(self.place() + 1).min(Quality::ALL.len() - 1)]
    }

    fn better(self) -> Option<Quality> {
        self.place().checked_sub(1).map(|place| Quality::ALL[place])
    }
}

/// A frame that takes longer is late: 20 a second, with some room for what the desktop needs.
const LATE_SECS: f32 = 0.045;
/// A frame that takes so long is late by so much that two levels are left out at once.
const VERY_LATE_SECS: f32 = 0.1;
/// So many late frames in a row bring a worse level.
const LATE_FRAMES: u8 = 2;
/// A better level that was measured before must have taken less.
const EARLY_SECS: f32 = 0.034;
/// One that was not is tried when the present one takes less: a level takes about twice what the next worse one does.
const UNTRIED_SECS: f32 = 0.024;
/// So many early frames in a row bring a better level.
const EARLY_FRAMES: u8 = 12;
/// So long after the last movement the picture is drawn in full.
const REST_SECS: f64 = 0.18;
/// So long a level that was late is not tried again.
const BARRED_SECS: f64 = 20.0;

/// What is known of the frames so far.
#[derive(Clone, PartialEq, Debug)]
pub struct Pace {
    /// The level for movement.
    level: Quality,
    /// When something last moved, seconds; none since the last rest.
    moved_at: Option<f64>,
    late: u8,
    early: u8,
    /// What each level took, seconds, as a running mean.
    took: [Option<f32>; Quality::ALL.len()],
    /// Until when a level is not tried.
    barred_until: [f64; Quality::ALL.len()],
}

impl Default for Pace {
    fn default() -> Pace {
        Pace {
            level: Quality::Full,
            moved_at: None,
            late: 0,
            early: 0,
            took: [None; Quality::ALL.len()],
            barred_until: [f64::NEG_INFINITY; Quality::ALL.len()],
        }
    }
}

impl Pace {
    /// For an adapter that is known to be slow: the first movement begins lean.
    pub fn slow() -> Pace {
        Pace { level: Quality::Lean, ..Pace::default() }
    }

    /// How well to draw the frame at that time, seconds of any clock that goes forward; `moving` if it shows movement.
    pub fn quality(&mut self, now: f64, moving: bool) -> Quality {
        if moving {
            self.moved_at = Some(now);
        }
        match self.moved_at {
            Some(at) if now - at < REST_SECS => self.level,
            _ => {
                self.moved_at = None;
                (self.late, self.early) = (0, 0);
                Quality::Full
            }
        }
    }

    /// In how many seconds the picture must be drawn again, in full; `None` if it is already.
    pub fn rests_in(&self, now: f64) -> Option<f64> {
        self.moved_at.filter(|_| self.level != Quality::Full).map(|at| (at + REST_SECS - now).max(0.0))
    }

    /// A frame that showed movement took so long, all in all.
    pub fn took(&mut self, now: f64, secs: f32) {
        if self.moved_at.is_none() || !secs.is_finite() || secs < 0.0 {
            return;
        }
        let mean = &mut self.took[self.level.place()];
        *mean = Some(mean.map_or(secs, |mean| mean + (secs - mean) * 0.25));
        (self.late, self.early) = match secs {
            late if late > LATE_SECS => (self.late.saturating_add(1), 0),
            early if early < EARLY_SECS => (0, self.early.saturating_add(1)),
            _ => (0, 0),
        };
        if self.late >= LATE_FRAMES {
            self.go_down(now, secs);
        } else if self.early >= EARLY_FRAMES {
            self.go_up(now);
        }
    }

    fn go_down(&mut self, now: f64, secs: f32) {
        for _ in 0..if secs > VERY_LATE_SECS { 2 } else { 1 } {
            self.barred_until[self.level.place()] = now + BARRED_SECS;
            self.level = self.level.worse();
        }
        (self.late, self.early) = (0, 0);
    }

    /// To the next better level, unless it is barred or was too slow when it was last measured.
    fn go_up(&mut self, now: f64) {
        self.early = 0;
        let Some(better) = self.level.better() else { return };
        let (known, own) = (self.took[better.place()], self.took[self.level.place()]);
        let hopeful = match known {
            // After the bar has gone the machine may have become faster: what was known counts no longer.
            Some(secs) if self.barred_until[better.place()] == f64::NEG_INFINITY => secs < EARLY_SECS,
            _ => own.is_some_and(|secs| secs < UNTRIED_SECS),
        };
        if hopeful && now >= self.barred_until[better.place()] {
            self.level = better;
            self.took[better.place()] = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A drag of so many frames on a machine where a level takes so long; the levels that were drawn.
    fn drag(pace: &mut Pace, clock: &mut f64, frames: usize, cost: impl Fn(Quality) -> f32) -> Vec<Quality> {
        (0..frames)
            .map(|_| {
                let quality = pace.quality(*clock, true);
                *clock += f64::from(cost(quality)).max(1.0 / 60.0);
                pace.took(*clock, cost(quality));
                quality
            })
            .collect()
    }

    fn changes(levels: &[Quality]) -> usize {
        levels.windows(2).filter(|pair| pair[0] != pair[1]).count()
    }

    /// What a level takes as a share of the full one.
    fn share(quality: Quality) -> f32 {
        [1.0, 0.6, 0.4, 0.25, 0.15, 0.1][quality.place()]
    }

    #[test]
    fn a_fast_machine_always_draws_in_full() {
        let (mut pace, mut clock) = (Pace::default(), 0.0);
        let levels = drag(&mut pace, &mut clock, 300, |_| 1.0 / 60.0);
        assert!(levels.iter().all(|level| *level == Quality::Full));
        assert_eq!(pace.rests_in(clock), None);
    }

    #[test]
    fn every_machine_that_can_soon_draws_twenty_a_second_and_stays_there() {
        for full in [0.03, 0.06, 0.1, 0.16, 0.25, 0.4] {
            for mut pace in [Pace::default(), Pace::slow()] {
                let mut clock = 0.0;
                drag(&mut pace, &mut clock, 12, |quality| full * share(quality));
                let levels = drag(&mut pace, &mut clock, 300, |quality| full * share(quality));
                let late = levels.iter().filter(|level| full * share(**level) > 0.05).count();
                assert!(late <= 4, "{full}: {late} of 300 are late");
                let best = Quality::ALL.into_iter().find(|level| full * share(*level) < EARLY_SECS * 0.5);
                assert!(
                    best.is_none_or(|best| levels[299] <= best),
                    "{full}: {:?}, not {best:?}",
                    levels[299]
                );
                assert!(changes(&levels) <= 4, "{full}: {levels:?}");
                let on = drag(&mut pace, &mut clock, 200, |quality| full * share(quality));
                assert!(changes(&on) <= 2, "{full}: no flicker");
            }
        }
    }

    #[test]
    fn one_late_frame_changes_nothing_and_two_do() {
        let (mut pace, mut clock) = (Pace::default(), 0.0);
        drag(&mut pace, &mut clock, 5, |_| 0.02);
        drag(&mut pace, &mut clock, 1, |_| 0.08);
        assert_eq!(drag(&mut pace, &mut clock, 1, |_| 0.02), [Quality::Full]);
        drag(&mut pace, &mut clock, 2, |_| 0.08);
        assert_eq!(drag(&mut pace, &mut clock, 1, |_| 0.02), [Quality::Open]);
        drag(&mut pace, &mut clock, 2, |_| 0.2);
        assert_eq!(
            drag(&mut pace, &mut clock, 1, |_| 0.02),
            [Quality::Lean],
            "very late: two levels at once"
        );
    }

    #[test]
    fn the_picture_is_drawn_in_full_after_a_short_rest_and_the_level_is_kept_for_the_next_drag() {
        let (mut pace, mut clock) = (Pace::slow(), 10.0);
        assert_eq!(pace.quality(clock, false), Quality::Full, "nothing has moved yet");
        assert_eq!(pace.rests_in(clock), None);
        drag(&mut pace, &mut clock, 3, |_| 0.04);
        assert_eq!(pace.quality(clock + 0.05, false), Quality::Lean, "a pause within a movement");
        let rest = pace.rests_in(clock).unwrap();
        assert!(rest > 0.0 && rest <= REST_SECS);
        assert_eq!(pace.quality(clock + REST_SECS + 0.01, false), Quality::Full);
        assert_eq!(pace.rests_in(clock + 1.0), None);
        pace.took(clock + 1.0, 0.3);
        assert_eq!(pace.quality(clock + 2.0, true), Quality::Lean, "a slow frame at rest doesn't count");
    }

    #[test]
    fn numbers_that_are_none_are_left_out() {
        let mut pace = Pace::default();
        pace.quality(0.0, true);
        for bad in [f32::NAN, f32::INFINITY, -1.0] {
            pace.took(0.0, bad);
            pace.took(0.0, bad);
        }
        assert_eq!(pace.quality(0.0, true), Quality::Full);
    }

    #[test]
    fn every_level_draws_less_than_the_one_before() {
        let looks = Quality::ALL.map(|quality| quality.of(Look::default()));
        assert_eq!(looks[0], Look::default());
        assert!(looks.windows(2).all(|pair| pair[0] != pair[1] && pair[1].scale <= pair[0].scale));
    }
}
