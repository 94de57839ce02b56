//! A game pad's sticks as wishes: the left one goes, the right one turns.

use super::steer::Wish;

/// Sticks move so far by themselves.
const DEAD: f32 = 0.18;

/// Where the sticks of a pad are: right and up are positive, from -1 to 1.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Sticks {
    /// The left stick.
    pub left: [f32; 2],
    /// The right stick.
    pub right: [f32; 2],
}

impl Sticks {
    /// What they wish for: gentle near the middle, nothing within what sticks move by themselves.
    pub fn wish(&self) -> Wish {
        let [right, up] = self.left.map(eased);
        Wish { ahead: up, aside: -right, turn: -eased(self.right[0]) }
    }
}

fn eased(at: f32) -> f64 {
    if !at.is_finite() {
        return 0.0;
    }
    let beyond = ((at.abs() - DEAD) / (1.0 - DEAD)).clamp(0.0, 1.0);
    f64::from(beyond * beyond.sqrt() * at.signum())
}

/// The pads of this computer.
#[cfg(feature = "gamepad")]
pub struct Pads(Option<gilrs::Gilrs>);

#[cfg(feature = "gamepad")]
impl Default for Pads {
    fn default() -> Pads {
        let opened = gilrs::Gilrs::new();
        if let Err(error) = &opened {
            log::warn!("no game pads: {error}");
        }
        Pads(opened.ok())
    }
}

#[cfg(feature = "gamepad")]
impl Pads {
    /// What the sticks of the first pad wish for.
    pub fn wish(&mut self) -> Wish {
        let Some(gilrs) = &mut self.0 else { return Wish::default() };
        while gilrs.next_event().is_some() {}
        let sticks = gilrs.gamepads().next().map(|(_, pad)| Sticks {
            left: [pad.value(gilrs::Axis::LeftStickX), pad.value(gilrs::Axis::LeftStickY)],
            right: [pad.value(gilrs::Axis::RightStickX), pad.value(gilrs::Axis::RightStickY)],
        });
        sticks.unwrap_or_default().wish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sticks_at_rest_wish_for_nothing_and_full_ones_for_all() {
        assert!(Sticks { left: [0.1, -0.15], right: [0.17, 0.9] }.wish().is_none());
        let full = Sticks { left: [1.0, -1.0], right: [-1.0, 0.0] }.wish();
        assert_eq!(full, Wish { ahead: -1.0, aside: -1.0, turn: 1.0 });
        let bad = Sticks { left: [f32::NAN, 9.0], right: [f32::INFINITY, 0.0] }.wish();
        assert_eq!(bad, Wish { ahead: 1.0, aside: 0.0, turn: 0.0 });
    }

    #[test]
    fn the_wish_grows_with_the_stick_without_a_jump() {
        let at = |x: f32| Sticks { left: [0.0, x], ..Sticks::default() }.wish().ahead;
        let mut before = 0.0;
        for i in 0..=100 {
            let now = at(i as f32 / 100.0);
            assert!((0.0..0.03).contains(&(now - before)), "{i}: {before} {now}");
            before = now;
        }
        assert_eq!(before, 1.0);
    }
}
