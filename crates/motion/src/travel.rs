//! How a motion carries the whole figure along.

use glam::{DVec2, DVec3};
use rig::Place;

/// The figure's own motion over the ground.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Travel {
    /// Metres a second in the figure's axes: x to its left, y ahead.
    pub velocity: DVec2,
    /// Degrees a second about +Y, positive to the figure's left.
    pub turn_rate: f64,
}

impl Travel {
    /// Where a figure gets that travels so for a time, seconds, against where it starts: along a straight line or an arc.
    pub fn place_after(&self, secs: f64) -> Place {
        let turn = self.turn_rate * secs;
        let (ahead, aside) = along_arc(turn.to_radians());
        let DVec2 { x, y } = self.velocity * secs;
        Place { position: DVec3::new(ahead * x + aside * y, 0.0, ahead * y - aside * x), turn }
    }

    /// The travel that gets a figure to a place in a time, seconds. A place that is reached by turning whole rounds is
    /// not; then the velocity is the straight one.
    pub fn to_place(place: Place, secs: f64) -> Travel {
        let (ahead, aside) = along_arc(place.turn.to_radians());
        let (x, y) = (place.position.x, place.position.z);
        let square = ahead * ahead + aside * aside;
        let way = if square > 1e-6 {
            DVec2::new(ahead * x - aside * y, ahead * y + aside * x) / square
        } else {
            DVec2::new(x, y)
        };
        Travel { velocity: way / secs, turn_rate: place.turn / secs }
    }
}

/// The way along and across the first direction that an arc of unit length makes that turns by so many radians.
fn along_arc(turn: f64) -> (f64, f64) {
    if turn.abs() < 1e-9 { (1.0, turn * 0.5) } else { (turn.sin() / turn, (1.0 - turn.cos()) / turn) }
}
