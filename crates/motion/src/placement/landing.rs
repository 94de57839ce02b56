//! Where and when a foot that swings will come down: as it last did, for the figure goes on as it goes now.

use glam::{DQuat, DVec2, DVec3};
use rig::Frame;

use super::footing::Foot;
use super::plane::Plane;
use crate::Ground;

/// Swings are at least that long, seconds.
const SHORTEST_SECS: f64 = 0.1;

/// What a foot remembers of coming down, in figure space over flat ground.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Landing {
    touch: Option<Touch>,
    /// How long its swing was, seconds.
    swing_secs: f64,
    /// Since it left the ground, seconds.
    aloft_secs: f64,
    down: bool,
}

/// A foot at the moment when it comes down, in figure space over flat ground.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Touch {
    pub ankle: DVec3,
    /// About which it rolls off.
    pub roll: DVec3,
    /// The hip's joint.
    pub hip: DVec3,
    /// Its heading, radians.
    pub yaw: f64,
    /// How far from the hip the ankle may be, metres.
    pub reach: f64,
}

/// A landing to come.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Coming {
    /// How much of the swing is over, 0 to 1.
    pub progress: f64,
    pub plane: Plane,
    /// The hips' place over the level then.
    pub hips: DVec2,
    /// How far the hips may be above their height over flat ground then, metres.
    pub highest: f64,
}

impl Landing {
    /// Goes on by a step: `held` is how firmly the foot holds, 0 to 1.
    pub fn step(&mut self, held: f64, touch: impl FnOnce() -> Touch, dt_secs: f64, at_once: bool) {
        let down = held > 0.5;
        if at_once {
            *self = Landing { down, ..Landing::default() };
        }
        if down && !self.down && self.aloft_secs >= SHORTEST_SECS {
            self.touch = Some(touch());
            self.swing_secs = self.aloft_secs;
        }
        self.aloft_secs = if down { 0.0 } else { self.aloft_secs + dt_secs };
        self.down = down;
    }

    /// The landing to come, if the foot swings and has come down before. `world_from_figure` is where the figure is, and
    /// `after` where it would be so many seconds from now.
    pub fn coming(&self, foot: &Foot, ground: &Ground, after: impl FnOnce(f64) -> Frame) -> Option<Coming> {
        let touch = self.touch.filter(|_| !self.down)?;
        let world_from_figure = after((self.swing_secs - self.aloft_secs).max(0.0));
        let roll = world_from_figure.point(touch.roll);
        let at = DVec2::new(roll.x, roll.z);
        let heading = world_from_figure.rotation * DQuat::from_rotation_y(touch.yaw);
        let print = foot.print.map(|point| {
            let off = heading * (point - foot.roll);
            at + DVec2::new(off.x, off.z)
        });
        let plane = Plane::under(ground, at, &print);
        let tilt = DQuat::from_rotation_arc(DVec3::Y, plane.normal());
        let ankle = DVec3::new(roll.x, plane.height + roll.y, roll.z)
            + tilt * (world_from_figure.rotation * (touch.ankle - touch.roll));
        let hip = world_from_figure.point(touch.hip);
        let away = DVec2::new(hip.x - ankle.x, hip.z - ankle.z).length_squared();
        let highest = ankle.y + (touch.reach * touch.reach - away).max(0.0).sqrt() - hip.y;
        let progress = (self.aloft_secs / self.swing_secs).min(1.0);
        let hips = world_from_figure.point(DVec3::new(0.0, 0.0, touch.hip.z));
        Some(Coming { progress, plane, hips: DVec2::new(hips.x, hips.z), highest })
    }
}
