//! Turning about an axis with the pointer: the angle on a ring, slowness and steps.

use std::f64::consts::{PI, TAU};

use glam::Vec2;

use crate::{Circle, Modifiers, Sight};

/// A ring held by the pointer.
#[derive(Clone, PartialEq, Debug)]
pub struct Swivel {
    /// The ring as it was when it was taken; angle 0 is where.
    circle: Circle,
    sight: Sight,
    way: Way,
    /// Where the pointer is, radians, counted on beyond half a turn.
    pointer: f64,
    slow: bool,
    /// Where the pointer was when slowness last began or ended, and what it counted as.
    turning: (f64, f64),
}

/// How a place of the picture becomes an angle.
#[derive(Clone, Copy, PartialEq, Debug)]
enum Way {
    /// By the place at which the sight line meets the ring's plane; the angle of the place that was taken.
    Plane { taken: f64 },
    /// Along a line of the picture, as a ring that is seen from its edge moves.
    Line { from: Vec2, along: Vec2, rad_per_px: f64 },
}

/// A ring whose axis makes a smaller angle's sine with the picture is seen from its edge.
const EDGE_ON: f64 = 0.2;
/// Slowed, a turn goes this share of the way.
const SLOW: f64 = 0.1;
/// Steps of a turn, radians: 5 degrees.
const STEP: f64 = PI / 36.0;

impl Swivel {
    /// Takes a ring at an angle with the pointer at a place of the picture. The sight must stay while this lasts.
    pub fn begin(circle: Circle, taken_rad: f64, sight: Sight, at_px: Vec2) -> Swivel {
        let circle = circle.from_angle(taken_rad);
        let toward = sight.toward_viewer(circle.center);
        let seen = circle.angle_under(&sight, at_px).filter(|_| circle.axis.dot(toward).abs() >= EDGE_ON);
        let way = match seen {
            Some(taken) => Way::Plane { taken },
            None => edge(&circle, &sight, at_px),
        };
        Swivel { circle, sight, way, pointer: 0.0, slow: false, turning: (0.0, 0.0) }
    }

    /// The ring; its angle 0 is where it was taken.
    pub fn circle(&self) -> &Circle {
        &self.circle
    }

    /// The turn with the pointer at a place, radians; more than a whole turn is counted on. Places at which the
    /// pointer says nothing count as the one before.
    pub fn angle(&mut self, at_px: Vec2, modifiers: Modifiers) -> f64 {
        if modifiers.slow != self.slow {
            self.turning = (self.pointer, self.counted());
            self.slow = modifiers.slow;
        }
        match self.way {
            Way::Plane { taken } => {
                if let Some(now) = self.circle.angle_under(&self.sight, at_px) {
                    self.pointer += wrapped(now - taken - self.pointer);
                }
            }
            Way::Line { from, along, rad_per_px } => {
                let moved = f64::from((at_px - from).dot(along)) * rad_per_px;
                if moved.is_finite() {
                    self.pointer = moved;
                }
            }
        }
        let angle = self.counted();
        if modifiers.snap { stepped(angle) } else { angle }
    }

    fn counted(&self) -> f64 {
        let share = if self.slow { SLOW } else { 1.0 };
        self.turning.1 + (self.pointer - self.turning.0) * share
    }
}

/// The nearest whole step of 5 degrees, radians.
pub(crate) fn stepped(angle_rad: f64) -> f64 {
    (angle_rad / STEP).round() * STEP
}

/// The way of a ring seen from its edge: the near half moves along a line of the picture.
fn edge(circle: &Circle, sight: &Sight, at_px: Vec2) -> Way {
    let onward = circle.axis.cross(sight.toward_viewer(circle.center)).normalize_or_zero();
    let radius = circle.radius_m.max(1e-6);
    let ends = [sight.pixel_of(circle.center), sight.pixel_of(circle.center + onward * radius)];
    let along = match ends {
        [Some(middle), Some(end)] => end - middle,
        _ => Vec2::ZERO,
    };
    let length = along.length();
    if length < 1e-3 {
        return Way::Line { from: at_px, along: Vec2::X, rad_per_px: 0.01 };
    }
    Way::Line { from: at_px, along: along / length, rad_per_px: 1.0 / f64::from(length) }
}

/// The same angle in [-pi, pi).
pub(crate) fn wrapped(angle: f64) -> f64 {
    (angle + PI).rem_euclid(TAU) - PI
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use glam::DVec3;
    use rig::Camera;

    use super::*;

    const PLAIN: Modifiers = Modifiers { slow: false, snap: false, in_contact: false };

    fn sight() -> Sight {
        Sight { camera: Camera::default(), size_px: Vec2::new(800.0, 600.0) }
    }

    fn ring(axis: DVec3) -> Circle {
        Circle::new(DVec3::new(0.1, 1.1, 0.0), axis, DVec3::X, 0.2)
    }

    #[test]
    fn the_place_that_was_taken_stays_under_the_pointer() {
        let circle = ring(DVec3::new(0.2, 0.4, 1.0));
        let place = |angle| sight().pixel_of(circle.point(angle)).unwrap();
        let mut swivel = Swivel::begin(circle, 0.5, sight(), place(0.5));
        assert!(swivel.angle(place(0.5), PLAIN).abs() < 1e-9);
        for turn in [0.3, 1.2, 2.9, 3.9, 6.0, 7.5] {
            let angle = swivel.angle(place(0.5 + turn), PLAIN);
            assert!((angle - turn).abs() < 1e-3, "{angle} for {turn}: turns count on");
        }
    }

    #[test]
    fn steps_are_five_degrees_and_slow_is_a_tenth() {
        let circle = ring(DVec3::Z);
        let place = |angle| sight().pixel_of(circle.point(angle)).unwrap();
        let mut swivel = Swivel::begin(circle, 0.0, sight(), place(0.0));
        let snapped = swivel.angle(place(0.41), Modifiers { snap: true, ..PLAIN }).to_degrees();
        assert!((snapped - 25.0).abs() < 1e-9, "{snapped}");
        let mut swivel = Swivel::begin(circle, 0.0, sight(), place(0.0));
        swivel.angle(place(0.2), PLAIN);
        let slowed = swivel.angle(place(0.2), Modifiers { slow: true, ..PLAIN });
        assert!((slowed - 0.2).abs() < 1e-3, "nothing jumps when slowness begins");
        let slowed = swivel.angle(place(1.2), Modifiers { slow: true, ..PLAIN });
        assert!((slowed - 0.3).abs() < 1e-3, "{slowed}");
        assert!((swivel.angle(place(1.2), PLAIN) - slowed).abs() < 1e-9, "nor when it ends");
    }

    #[test]
    fn a_ring_seen_from_its_edge_follows_the_pointer_along_its_line() {
        let circle = ring(DVec3::Y);
        let camera = Camera { target: DVec3::new(0.1, 1.1, 0.0).as_vec3(), ..Camera::default() };
        let sight = Sight { camera, ..sight() };
        let near = sight.pixel_of(circle.point(-std::f64::consts::FRAC_PI_2)).unwrap();
        let mut swivel = Swivel::begin(circle, -std::f64::consts::FRAC_PI_2, sight, near);
        let right = swivel.angle(near + Vec2::new(20.0, 0.0), PLAIN);
        assert!(right > 0.1, "the near side goes to the right as it turns to the figure's left: {right}");
        assert!(
            (swivel.angle(near + Vec2::new(20.0, 30.0), PLAIN) - right).abs() < 1e-3,
            "across says nothing"
        );
        assert!(swivel.angle(Vec2::NAN, PLAIN).is_finite());
    }
}
