//! Where and when a foot that swings will come down: as it last did, for the figure goes on as it goes now.

use glam::{DQuat, DVec2, DVec3};
use rig::Frame;

use super::fade::smooth;
use super::footing::Foot;
use super::plane::Plane;
use crate::{Ground, Sole};

/// Swings are at least that long, seconds.
const SHORTEST_SECS: f64 = 0.1;

/// When it is settled where a foot comes down: the share of its swing.
const SETTLED: f64 = 0.1;
/// How far from where the motion has it a foot may come down, in steps: along its way and aside.
const SHIFTS: i32 = 10;
const SHIFTS_ASIDE: i32 = 3;
const SHIFT_STEP_M: f64 = 0.02;
/// How much earlier a foot is lifted on a slope of 45 degrees, metres, and in which part of its swing.
const EARLY_M: f64 = 0.25;
const EARLY: (f64, f64) = (0.05, 0.9);
/// Pieces of a foot's way in which the ground under it is looked at.
const KNOTS: usize = 16;

/// What a foot remembers of coming down, in figure space over flat ground.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Landing {
    touch: Option<Touch>,
    /// How long its swing was, seconds.
    swing_secs: f64,
    /// Since it left the ground, seconds.
    aloft_secs: f64,
    down: bool,
    /// The plane that it last stood on.
    from: Plane,
    /// How far from where the motion has it the foot is to come down, once that is settled, metres.
    shift: Option<DVec2>,
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
    /// The plane that the foot left, about where it stood.
    pub from: Plane,
    /// The plane that it will stand on, about where.
    pub plane: Plane,
    /// How far that is from where the motion has it, metres.
    pub shift: DVec2,
    /// The hips' place over the level then.
    pub hips: DVec2,
    /// How far the hips may be above their height over flat ground then, metres.
    pub highest: f64,
}

impl Landing {
    /// Goes on by a step: `held` is how firmly the foot holds, 0 to 1, and `plane` what it holds on to.
    pub fn step(
        &mut self,
        held: f64,
        plane: Plane,
        touch: impl FnOnce() -> Touch,
        dt_secs: f64,
        at_once: bool,
    ) {
        let down = held > 0.5;
        if at_once {
            *self = Landing { down, ..Landing::default() };
        }
        if down && !self.down && self.aloft_secs >= SHORTEST_SECS {
            self.touch = Some(touch());
            self.swing_secs = self.aloft_secs;
        }
        if down {
            (self.from, self.shift) = (plane, None);
        }
        self.aloft_secs = if down { 0.0 } else { self.aloft_secs + dt_secs };
        self.down = down;
    }

    /// The landing to come, if the foot swings and has come down before. `world_from_figure` is where the figure is, and
    /// `after` where it would be so many seconds from now.
    pub fn coming(&mut self, foot: &Foot, ground: &Ground, after: impl Fn(f64) -> Frame) -> Option<Coming> {
        let touch = self.touch.filter(|_| !self.down)?;
        let world_from_figure = after((self.swing_secs - self.aloft_secs).max(0.0));
        let roll = world_from_figure.point(touch.roll);
        let progress = (self.aloft_secs / self.swing_secs).min(1.0);
        let heading = world_from_figure.rotation * DQuat::from_rotation_y(touch.yaw);
        let print = foot.print.map(|point| level(heading * (point - foot.roll)));
        if self.shift.is_none() && progress > SETTLED {
            let along = (level(roll) - self.from.at).normalize_or_zero();
            let sole = foot.sole.map(|point| level(heading * (point - foot.roll)));
            let steps = ground.has_steps();
            self.shift = Some(if steps { shift(ground, level(roll), along, &sole) } else { DVec2::ZERO });
        }
        let shift = self.shift.unwrap_or_default();
        let roll = roll + DVec3::new(shift.x, 0.0, shift.y);
        let plane = Plane::under(ground, level(roll), &print.map(|off| level(roll) + off));
        let tilt = DQuat::from_rotation_arc(DVec3::Y, plane.normal());
        let ankle = DVec3::new(roll.x, plane.height + roll.y, roll.z)
            + tilt * (world_from_figure.rotation * (touch.ankle - touch.roll));
        let hip = world_from_figure.point(touch.hip);
        let away = level(hip - ankle).length_squared();
        let highest = ankle.y + (touch.reach * touch.reach - away).max(0.0).sqrt() - hip.y;
        let hips = level(world_from_figure.point(DVec3::new(0.0, 0.0, touch.hip.z)));
        Some(Coming { progress, from: self.from, plane, shift, hips, highest })
    }
}

impl Coming {
    /// The plane for a foot on its way at a place: it turns evenly from the one to the other. Over ground with steps it
    /// is as high as a string that is taut over all that the sole passes.
    pub fn on_the_way(&self, foot: &Foot, ground: &Ground, fitted: Plane) -> Plane {
        let turned = smooth(self.progress, 0.0, 0.9);
        let gradient = self.from.gradient.lerp(self.plane.gradient, turned);
        let near = smooth(self.progress, 0.8, 1.0);
        let gradient = gradient.lerp(fitted.gradient, near);
        if !ground.has_steps() {
            return Plane { gradient, height: fitted.height + self.early(), at: fitted.at };
        }
        Plane { gradient, height: self.string(foot, ground, fitted.at), at: fitted.at }
    }

    /// Uphill the foot is lifted early, or the thigh would have to come up fast in the second half of the swing, metres.
    fn early(&self) -> f64 {
        let length = self.plane.at.distance(self.from.at).max(0.3);
        let rise = ((self.plane.height - self.from.height) / length).clamp(0.0, 0.6);
        let part = ((self.progress - EARLY.0) / (EARLY.1 - EARLY.0)).clamp(0.0, 1.0);
        EARLY_M * rise * (part * std::f64::consts::PI).sin().powi(2)
    }

    fn string(&self, foot: &Foot, ground: &Ground, at: DVec2) -> f64 {
        let way = self.plane.at - self.from.at;
        let length = way.length();
        if length < 0.05 {
            return self.plane.height;
        }
        let along = way / length;
        let now = (at - self.from.at).dot(along).clamp(0.0, length);
        let (behind, before) = foot.extent();
        let height = |s: f64| {
            let p = self.from.at + along * s;
            ground.height(p.x, p.y)
        };
        let knot = |i: usize| length * i as f64 / KNOTS as f64;
        // The highest ground under the sole with the place of roll at each knot.
        let mut heights = [0.0; KNOTS + 1];
        for (i, top) in heights.iter_mut().enumerate() {
            let s = knot(i);
            *top = [-behind, -0.5 * behind, 0.0, 0.5 * before, before]
                .map(|off| height(s + off))
                .into_iter()
                .fold(f64::NEG_INFINITY, f64::max);
        }
        (heights[0], heights[KNOTS]) = (self.from.height, self.plane.height);
        let mut taut = f64::NEG_INFINITY;
        for i in (0..=KNOTS).filter(|i| knot(*i) <= now) {
            for j in (0..=KNOTS).filter(|j| knot(*j) >= now) {
                let share = if i == j { 0.0 } else { (now - knot(i)) / (knot(j) - knot(i)) };
                taut = taut.max(heights[i] + share * (heights[j] - heights[i]));
            }
        }
        taut
    }
}

/// How far from a place a foot is to come down so that its whole sole is carried; else as much of it as can be.
fn shift(ground: &Ground, at: DVec2, along: DVec2, sole: &[DVec2; Sole::COUNT]) -> DVec2 {
    let mut best = (f64::NEG_INFINITY, DVec2::ZERO);
    for step in -SHIFTS..=SHIFTS {
        for aside in -SHIFTS_ASIDE..=SHIFTS_ASIDE {
            let off = (along * f64::from(step) + along.perp() * f64::from(aside)) * SHIFT_STEP_M;
            // A point more that is carried is worth its way; the foot rather stays where it is.
            let found = Plane::carried(ground, at + off, &sole.map(|p| at + off + p)) - 0.3 * off.length();
            if found > best.0 {
                best = (found, off);
            }
        }
    }
    best.1
}

fn level(point: DVec3) -> DVec2 {
    DVec2::new(point.x, point.z)
}
