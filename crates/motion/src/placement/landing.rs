//! Where and when a foot that swings will come down: as it last did, for the figure goes on as it goes now.

use glam::{DQuat, DVec2, DVec3};
use rig::Frame;

use super::fade::smooth;
use super::foot::Moment;
use super::footing::Foot;
use super::plane::Plane;
use crate::{Ground, Sole};

/// Swings are at least that long, seconds.
const SHORTEST_SECS: f64 = 0.1;

/// How far from where the motion has it a foot may come down, in steps: along its way and aside.
const SHIFTS: i32 = 10;
const SHIFTS_ASIDE: i32 = 5;
const SHIFT_STEP_M: f64 = 0.02;
/// A place that is worth so much is not looked for aside.
const WELL_CARRIED: f64 = 0.9;
/// Room that a foot that comes down leaves before its toes, behind its heel and beside it where the ground is higher, metres.
const ROOM_M: [f64; 3] = [0.045, 0.025, 0.02];
/// How much earlier a foot is lifted on a slope of 45 degrees, metres, and in which part of its swing.
const EARLY_M: f64 = 0.25;
const EARLY: (f64, f64) = (0.05, 0.9);
/// Pieces of a foot's way in which the ground under it is looked at.
const KNOTS: usize = 24;
/// How fast a foot goes up steps, against going there evenly.
const UP_FIRST: f64 = 1.2;
/// How far a sole passes above steps, metres.
const CLEARS_M: f64 = 0.03;
/// How far before an edge a foot that isn't yet above it waits, the farthest
/// that it stays back and how finely that is looked for, metres.
const AHEAD_M: f64 = 0.03;
const MOST_WAIT_M: f64 = 0.25;
const WAIT_STEP_M: f64 = 0.01;
/// A landing that comes out farther from where it was thought has the ground looked at again, metres.
const ELSEWHERE_M: f64 = 0.03;
/// Feet that are less far before the hip than this, metres, are not on a stride; and how long a swing is, as a multiple of
/// the time in which the hip goes that far.
const STRIDE_M: f64 = 0.12;
const SWING: f64 = 2.3;

/// What a foot remembers of coming down, in figure space over flat ground.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Landing {
    touch: Option<Touch>,
    /// Whether that was guessed, or learned of the other foot.
    guessed: bool,
    /// Where the figure was when the foot came down, until its ball holds.
    contact: Option<Frame>,
    /// How long its swing was, seconds.
    swing_secs: f64,
    /// Since it left the ground, seconds.
    aloft_secs: f64,
    down: bool,
    /// The plane that it last stood on.
    from: Plane,
    /// The way of this swing, once it is settled.
    way: Option<Way>,
}

/// The ground on a foot's way, with steps.
#[derive(Clone, Copy, PartialEq, Debug)]
struct Way {
    /// From where, to where the motion has it come down, metres.
    from: DVec2,
    to: DVec2,
    /// How far from there the foot is to come down, metres.
    shift: DVec2,
    /// The highest ground under the sole with its place of roll at each knot between.
    tops: [f64; KNOTS + 1],
}

/// A foot at the moment when it comes down, in figure space over flat ground.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Touch {
    pub ankle: DVec3,
    /// About which it rolls off, where that is once the sole is down.
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
    /// Whether the ground on the way there has steps.
    pub over_steps: bool,
}

impl Landing {
    /// Goes on by a step: `held` is how firmly the foot holds, 0 to 1, `ball` how firmly its ball does, and `plane` what
    /// it holds on to.
    pub fn step(&mut self, held: f64, ball: f64, plane: Plane, now: &Moment<'_>, foot: &Foot) {
        let (down, at_once, dt_secs) = (held > 0.5, now.at_once, now.dt_secs);
        if at_once {
            *self = Landing { down, ..Landing::default() };
        }
        if down && !self.down && self.aloft_secs >= SHORTEST_SECS {
            (self.touch, self.guessed) = (Some(now.touch(foot)), false);
            (self.swing_secs, self.contact) = (self.aloft_secs, Some(*now.world_from_figure));
        }
        if let (true, Some(contact), Some(touch)) = (ball > 0.5, self.contact, &mut self.touch) {
            let stood = contact.inverse().point(now.flat.point(foot.roll));
            touch.roll = DVec3::new(stood.x, touch.roll.y, stood.z);
            self.contact = None;
        }
        if down {
            (self.from, self.way) = (plane, None);
        } else {
            self.contact = None;
        }
        self.aloft_secs = if down { 0.0 } else { self.aloft_secs + dt_secs };
        self.down = down;
    }

    /// What a foot that has not come down yet learns from the other, which has.
    pub fn learn(&mut self, other: &Landing) {
        let knows = other.touch.filter(|_| !other.guessed && other.contact.is_none());
        if let (true, Some(touch)) = (self.guessed || self.touch.is_none(), knows) {
            (self.touch, self.swing_secs, self.guessed) = (Some(touch.mirrored()), other.swing_secs, true);
        }
    }

    /// What both feet take for their landings before any came down, from where the one before the hips is: `touches` are
    /// where they are now, `speed` is how fast the figure goes, metres a second.
    pub fn guess(landings: [&mut Landing; 2], touches: [Touch; 2], speed: f64) {
        let ahead = touches.map(|touch| touch.ankle.z - touch.hip.z);
        let before = usize::from(ahead[1] > ahead[0]);
        if ahead[before] < STRIDE_M || speed < STRIDE_M {
            return;
        }
        for (side, landing) in landings.into_iter().enumerate() {
            let touch = if side == before { touches[side] } else { touches[before].mirrored() };
            (landing.touch, landing.swing_secs, landing.guessed) =
                (Some(touch), SWING * ahead[before] / speed, true);
        }
    }

    /// The landing to come, if the foot swings and it is known where it comes down. `world_from_figure` is where the figure
    /// is `after` so many seconds from now.
    pub fn coming(&mut self, foot: &Foot, ground: &Ground, after: impl Fn(f64) -> Frame) -> Option<Coming> {
        let touch = self.touch.filter(|_| !self.down)?;
        let world_from_figure = after((self.swing_secs - self.aloft_secs).max(0.0));
        let roll = world_from_figure.point(touch.roll);
        let progress = (self.aloft_secs / self.swing_secs).min(1.0);
        let heading = world_from_figure.rotation * DQuat::from_rotation_y(touch.yaw);
        let turned = |point: DVec3| level(heading * (point - foot.roll));
        if ground.has_steps() && self.way.is_none_or(|way| way.to.distance(level(roll)) > ELSEWHERE_M) {
            self.way = Some(Way::new(foot, ground, self.from, level(roll), &foot.sole.map(turned)));
        }
        // The place stays that which was chosen, though the figure's way there changes a little.
        let shift = self.way.map_or(DVec2::ZERO, |way| way.to + way.shift - level(roll));
        let roll = roll + DVec3::new(shift.x, 0.0, shift.y);
        let plane = Plane::of_foot(ground, level(roll), foot, |point| level(roll) + turned(point));
        let tilt = DQuat::from_rotation_arc(DVec3::Y, plane.normal());
        let ankle = DVec3::new(roll.x, plane.height + roll.y, roll.z)
            + tilt * (world_from_figure.rotation * (touch.ankle - touch.roll));
        let hip = world_from_figure.point(touch.hip);
        let away = level(hip - ankle).length_squared();
        let highest = ankle.y + (touch.reach * touch.reach - away).max(0.0).sqrt() - hip.y;
        let hips = level(world_from_figure.point(DVec3::new(0.0, 0.0, touch.hip.z)));
        Some(Coming {
            progress,
            from: self.from,
            plane,
            shift,
            hips,
            highest,
            over_steps: self.way.is_some(),
        })
    }

    /// The plane for a foot on its way at a place: it turns evenly from the one to the other. Over ground with steps it
    /// is as high as a string that is taut over all that the sole passes.
    pub fn on_the_way(&self, coming: &Coming, fitted: Plane) -> Plane {
        let turned = smooth(coming.progress, 0.0, 0.9);
        let gradient = coming.from.gradient.lerp(coming.plane.gradient, turned);
        let near = smooth(coming.progress, 0.8, 1.0);
        let gradient = gradient.lerp(fitted.gradient, near);
        let height = match &self.way {
            Some(way) => way.string(coming.from.height, coming.plane.height, fitted.at, coming.progress),
            None => fitted.height + coming.early(),
        };
        Plane { gradient, height, at: fitted.at }
    }

    /// How far a foot has to stay back from where it would be for its sole not to go through an edge ahead: `points` are
    /// those of the sole. Nothing where staying back doesn't help.
    pub fn wait(&self, ground: &Ground, points: &[DVec3; Sole::COUNT]) -> DVec2 {
        let Some(along) = self.way.map(|way| way.length_along().1) else { return DVec2::ZERO };
        let free = |back: f64| {
            points.iter().all(|p| {
                let at = level(*p) - along * back;
                let ahead = at + along * AHEAD_M;
                let edge = ground.height(at.x, at.y).max(ground.height(ahead.x, ahead.y));
                // What it left is no edge.
                p.y > edge || edge < self.from.height_at(at) + CLEARS_M
            })
        };
        let most = (MOST_WAIT_M / WAIT_STEP_M) as usize;
        let back = (0..=most).map(|i| i as f64 * WAIT_STEP_M).find(|back| free(*back));
        along * -back.unwrap_or(0.0)
    }
}

impl Touch {
    fn mirrored(self) -> Touch {
        let flip = |p: DVec3| DVec3::new(-p.x, p.y, p.z);
        Touch { ankle: flip(self.ankle), roll: flip(self.roll), hip: flip(self.hip), yaw: -self.yaw, ..self }
    }
}

impl Way {
    /// From the plane that a foot leaves to a place where the motion has it come down; `sole` is about it.
    fn new(foot: &Foot, ground: &Ground, from: Plane, to: DVec2, sole: &[DVec2; Sole::COUNT]) -> Way {
        let along = (to - from.at).normalize_or_zero();
        let shift = shift(ground, to, along, sole);
        let mut way = Way { from: from.at, to, shift, tops: [from.height; KNOTS + 1] };
        let (length, along) = way.length_along();
        let (behind, before) = foot.extent();
        let aside = 0.5 * foot.print[2].distance(foot.print[3]) * along.perp();
        // The highest of the ground across the foot's way, piece by piece, then over the sole's length.
        let piece = length.max(0.05) / KNOTS as f64;
        let reach = |extent: f64| (extent / piece).ceil().min(KNOTS as f64) as isize;
        let (behind, before) = (reach(behind), reach(before));
        let across = |i: isize| {
            let at = way.from + along * (i as f64 * piece);
            [-1.0, 0.0, 1.0]
                .map(|k| at + aside * k)
                .map(|p| ground.height(p.x, p.y))
                .into_iter()
                .fold(f64::MIN, f64::max)
        };
        let mut heights = [0.0; 3 * KNOTS + 1];
        for i in -behind..=KNOTS as isize + before {
            heights[(i + KNOTS as isize) as usize] = across(i);
        }
        for i in 0..=KNOTS as isize {
            let under = (i - behind + KNOTS as isize) as usize..=(i + before + KNOTS as isize) as usize;
            way.tops[i as usize] = heights[under].iter().copied().fold(f64::MIN, f64::max);
        }
        way
    }

    /// How far it is, metres, and which way.
    fn length_along(&self) -> (f64, DVec2) {
        let way = self.to + self.shift - self.from;
        (way.length(), way.normalize_or_zero())
    }

    /// The height of a string, taut over all that the sole passes, with the foot's place of roll at a place, and with it
    /// as far as it would be if it went evenly: a foot goes up before it goes ahead.
    fn string(&self, from: f64, to: f64, at: DVec2, progress: f64) -> f64 {
        let (length, along) = self.length_along();
        if length < 0.05 {
            return to;
        }
        let here = ((at - self.from).dot(along) / length).clamp(0.0, 1.0);
        let mut heights =
            self.tops.map(|top| if top > from.min(to) + CLEARS_M { top + CLEARS_M } else { top });
        (heights[0], heights[KNOTS]) = (from, to);
        taut(&heights, here).max(taut(&heights, here.max(progress * UP_FIRST).min(1.0)))
    }
}

/// The least concave curve over evenly spaced heights at a share of their way.
fn taut(heights: &[f64; KNOTS + 1], share: f64) -> f64 {
    let now = share * KNOTS as f64;
    let mut taut = f64::NEG_INFINITY;
    for i in (0..=KNOTS).filter(|i| *i as f64 <= now) {
        for j in (0..=KNOTS).filter(|j| *j as f64 >= now) {
            let share = if i == j { 0.0 } else { (now - i as f64) / (j - i) as f64 };
            taut = taut.max(heights[i] + share * (heights[j] - heights[i]));
        }
    }
    taut
}

impl Coming {
    /// Uphill the foot is lifted early, or the thigh would have to come up fast in the second half of the swing, metres.
    fn early(&self) -> f64 {
        let length = self.plane.at.distance(self.from.at).max(0.3);
        let rise = ((self.plane.height - self.from.height) / length).clamp(0.0, 0.6);
        let part = ((self.progress - EARLY.0) / (EARLY.1 - EARLY.0)).clamp(0.0, 1.0);
        EARLY_M * rise * (part * std::f64::consts::PI).sin().powi(2)
    }
}

/// How far from a place a foot is to come down so that its whole sole is carried; else as much of it as can be.
fn shift(ground: &Ground, at: DVec2, along: DVec2, sole: &[DVec2; Sole::COUNT]) -> DVec2 {
    let tip = sole[Sole::TOES] + along * ROOM_M[0];
    let heel = sole[Sole::HEEL] - along * ROOM_M[1];
    let aside =
        |i: usize| sole[i] + along.perp() * along.perp().dot(sole[i] - sole[i - i % 3]).signum() * ROOM_M[2];
    let room = [tip, heel, aside(1), aside(2), aside(4), aside(5), aside(7), aside(8)];
    // A point more that is carried is worth its way; the foot rather stays where it is.
    let worth = |off: DVec2| {
        let at = at + off;
        Plane::carried(ground, at, &sole.map(|p| at + p), &room.map(|p| at + p)) - 0.3 * off.length()
    };
    let mut best = (worth(DVec2::ZERO), DVec2::ZERO);
    if best.0 > 0.999 {
        return DVec2::ZERO;
    }
    let mut look = |along_steps: [i32; 2], aside_steps: [i32; 2], by: usize, about: DVec2| {
        for step in (along_steps[0]..=along_steps[1]).step_by(by) {
            for aside in (aside_steps[0]..=aside_steps[1]).step_by(by) {
                let off = about + (along * f64::from(step) + along.perp() * f64::from(aside)) * SHIFT_STEP_M;
                let found = worth(off);
                if found > best.0 {
                    best = (found, off);
                }
            }
        }
        best
    };
    if look([-SHIFTS, SHIFTS], [0, 0], 1, DVec2::ZERO).0 > WELL_CARRIED {
        return look([0, 0], [0, 0], 1, DVec2::ZERO).1;
    }
    let (_, about) = look([-SHIFTS, SHIFTS], [-SHIFTS_ASIDE, SHIFTS_ASIDE], 2, DVec2::ZERO);
    look([-1, 1], [-1, 1], 1, about).1
}

fn level(point: DVec3) -> DVec2 {
    DVec2::new(point.x, point.z)
}
