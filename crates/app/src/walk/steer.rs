//! Keys, pad and the walk by itself as what steers a walker: wishes that the walk follows as fast as a body can.

use motion::Steering;

/// The fastest that the slider goes, metres a second.
pub const TOP_SPEED: f64 = 3.2;
/// How fast the figure turns under a held key, degrees a second.
const TURN_DEG_PER_SEC: f64 = 75.0;
/// Backward and sideways it goes no faster, metres a second.
const BACK_SPEED: f64 = 1.0;
const SIDE_SPEED: f64 = 1.0;
/// Speed changes no faster, metres a second each second.
const ACCELERATION: f64 = 2.4;
/// Turning changes no faster, degrees a second each second.
const TURN_ACCELERATION: f64 = 260.0;

/// What is wished for at a moment; each part from -1 to 1.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Wish {
    /// Ahead; negative is backward.
    pub ahead: f64,
    /// Turning to the figure's left.
    pub turn: f64,
    /// Sideways to the figure's left.
    pub aside: f64,
}

impl Wish {
    /// Whether nothing is wished for.
    pub fn is_none(&self) -> bool {
        *self == Wish::default()
    }

    /// Both wishes together, each part from -1 to 1. What is not finite counts as nothing.
    pub fn and(self, other: Wish) -> Wish {
        let sum = |a: f64, b: f64| {
            let sum = a + b;
            if sum.is_finite() { sum.clamp(-1.0, 1.0) } else { 0.0 }
        };
        Wish {
            ahead: sum(self.ahead, other.ahead),
            turn: sum(self.turn, other.turn),
            aside: sum(self.aside, other.aside),
        }
    }
}

/// What steers, over time.
#[derive(Clone, PartialEq, Debug)]
pub struct Steer {
    /// How fast ahead, metres a second.
    pub speed: f64,
    /// Whether the figure walks ahead while no way is wished for; turns are then curves.
    pub alone: bool,
    /// Whether it is asked to sit.
    pub sit: bool,
    now: Steering,
}

impl Default for Steer {
    fn default() -> Steer {
        Steer { speed: 1.3, alone: true, sit: false, now: Steering::default() }
    }
}

impl Steer {
    /// Goes on by a step of time, seconds; what the walker is told then.
    pub fn step(&mut self, wish: Wish, dt_secs: f64) -> Steering {
        let wish = wish.and(Wish::default());
        // Whoever steers stands up.
        if !wish.is_none() {
            self.sit = false;
        }
        let goes_on = self.alone && !self.sit && wish.ahead == 0.0 && wish.aside == 0.0;
        let ahead = if goes_on { 1.0 } else { wish.ahead };
        let forward = if ahead < 0.0 { ahead * self.speed.min(BACK_SPEED) } else { ahead * self.speed };
        let sideways = wish.aside * self.speed.min(SIDE_SPEED);
        let near = |from: f64, to: f64, most: f64| from + (to - from).clamp(-most, most);
        let forward = near(self.now.forward, forward, ACCELERATION * dt_secs);
        let sideways = near(self.now.sideways, sideways, ACCELERATION * dt_secs);
        let turn = near(self.now.turn, wish.turn * TURN_DEG_PER_SEC, TURN_ACCELERATION * dt_secs);
        self.now = Steering {
            speed: forward.hypot(sideways),
            forward,
            sideways,
            turn,
            sit: self.sit,
            ..Steering::default()
        };
        self.now
    }

    /// What the walker was told last.
    pub fn now(&self) -> &Steering {
        &self.now
    }

    /// Stands still at once, as at the start.
    pub fn restart(&mut self) {
        (self.now, self.sit) = (Steering::default(), false);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DT: f64 = 1.0 / 120.0;

    fn after(steer: &mut Steer, wish: Wish, secs: f64) -> Steering {
        (0..(secs / DT) as u32).map(|_| steer.step(wish, DT)).last().unwrap_or_default()
    }

    #[test]
    fn by_itself_it_walks_ahead_and_keys_take_over() {
        let mut steer = Steer::default();
        let alone = after(&mut steer, Wish::default(), 2.0);
        assert_eq!((alone.forward, alone.speed, alone.turn), (1.3, 1.3, 0.0));
        let turned = after(&mut steer, Wish { turn: 1.0, ..Wish::default() }, 2.0);
        assert_eq!((turned.forward, turned.turn), (1.3, TURN_DEG_PER_SEC), "a curve");
        let back = after(&mut steer, Wish { ahead: -1.0, ..Wish::default() }, 3.0);
        assert_eq!((back.forward, back.speed), (-BACK_SPEED, BACK_SPEED));
        steer.alone = false;
        assert_eq!(after(&mut steer, Wish::default(), 3.0), Steering::default());
    }

    #[test]
    fn speed_changes_as_fast_as_a_body_can_and_never_at_once() {
        let mut steer = Steer { speed: TOP_SPEED, ..Steer::default() };
        let mut before = 0.0;
        for _ in 0..400 {
            let now = steer.step(Wish { ahead: 1.0, aside: 1.0, turn: -1.0 }, DT);
            assert!(now.forward - before <= ACCELERATION * DT + 1e-12);
            before = now.forward;
        }
        assert_eq!(before, TOP_SPEED);
    }

    #[test]
    fn who_steers_stands_up_and_who_sits_stays() {
        let mut steer = Steer { sit: true, ..Steer::default() };
        let seated = after(&mut steer, Wish::default(), 1.0);
        assert!(seated.sit && seated.speed == 0.0);
        assert!(!after(&mut steer, Wish { ahead: 1.0, ..Wish::default() }, 0.1).sit);
    }

    #[test]
    fn wishes_add_up_to_one_and_bad_ones_are_none() {
        let both =
            Wish { ahead: 1.0, ..Wish::default() }.and(Wish { ahead: 0.7, turn: f64::NAN, aside: -2.0 });
        assert_eq!(both, Wish { ahead: 1.0, turn: 0.0, aside: -1.0 });
    }
}
