//! The way of a whole figure: even speed, even turn.

use glam::{DQuat, DVec2, DVec3};
use rig::{Frame, Place};

/// Even travel over the ground.
#[derive(Clone, Copy, Debug)]
pub struct Path {
    /// Metres a second to the figure's left and ahead.
    pub velocity: DVec2,
    /// Degrees a second to the left.
    pub turn_rate: f64,
}

impl Path {
    /// Where the figure is after some seconds, or was before them.
    pub fn place(&self, secs: f64) -> Place {
        let rate = self.turn_rate.to_radians();
        let (DVec2 { x, y }, turn) = (self.velocity, rate * secs);
        // The integral of the velocity, which turns along.
        let (ahead, aside) =
            if rate == 0.0 { (secs, 0.0) } else { (turn.sin() / rate, (1.0 - turn.cos()) / rate) };
        let position = DVec3::new(x * ahead + y * aside, 0.0, y * ahead - x * aside);
        Place { position, turn: turn.to_degrees() }
    }

    /// The same as a frame.
    pub fn frame(&self, secs: f64) -> Frame {
        let place = self.place(secs);
        Frame::new(DQuat::from_rotation_y(place.turn.to_radians()), place.position)
    }
}
