//! How the root of a chain may be moved about in the world.

use glam::DVec3;
use kin::{Frame, Interval};

/// How the root of a chain may be moved.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub enum RootMoves {
    /// Anywhere, and turned.
    #[default]
    Free,
    /// Along the world's x alone, metres; turned not at all.
    Sideways(Interval),
    /// Not at all.
    Held,
}

impl RootMoves {
    /// As much of a move from one place to another as is allowed. A place outside a range may stay or move inward.
    #[must_use]
    pub fn clamped(self, from: Frame, to: Frame) -> Frame {
        match self {
            RootMoves::Free => to,
            RootMoves::Held => from,
            RootMoves::Sideways(range) => {
                let x = range.reaching(from.position.x).clamp(to.position.x);
                Frame::new(from.rotation, DVec3 { x, ..from.position })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    #[test]
    fn a_root_goes_as_far_as_it_may() {
        let to = Frame::new(DQuat::from_rotation_y(1.0), DVec3::new(9.0, 2.0, 3.0));
        let from = Frame::new(DQuat::IDENTITY, DVec3::new(0.0, 1.0, 0.0));
        assert_eq!(RootMoves::Free.clamped(from, to), to);
        assert_eq!(RootMoves::Held.clamped(from, to), from);
        let sideways = RootMoves::Sideways(Interval::new(-4.0, 4.0));
        assert_eq!(sideways.clamped(from, to), Frame::new(from.rotation, DVec3::new(4.0, 1.0, 0.0)));
        assert_eq!(sideways.clamped(to, to).position.x, 9.0, "outside it may stay");
    }
}
