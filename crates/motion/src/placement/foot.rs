//! One foot: the plane that it stands on, where it is held, and where that wants it to be.

use glam::{DQuat, DVec2, DVec3};
use kin::{arc_tangent, axis_angle, wrapped};
use rig::{Dof, Frame};

use super::PlacementSettings;
use super::fade::{Fade, smooth};
use super::footing::{Foot, Footing};
use super::haste::Haste;
use super::landing::{Coming, Landing, Touch};
use super::plane::Plane;
use super::toes::ToesState;
use crate::{Bearing, Bend, FootGoal, Ground, Leg, Sample, Sole};

/// How quickly what a held foot had against the motion fades as it swings, 1/s.
const SLIP_FADES: f64 = 16.0;
/// How quickly the plane that it stood on fades into that of the ground below, 1/s.
const PLANE_FADES: f64 = 30.0;
/// What a foot's plane goes up or down at once, at most, metres.
const JUMP_M: f64 = 0.05;
/// So near the ground a plane may be held, metres.
const SETTLED_M: f64 = 0.01;
/// The bearing from which on a part of the sole holds wholly.
const HOLDS: f64 = 0.6;
/// Rounds in which a foot settles whose ankle can't bend far enough, and the angle at which it has, radians.
const ROUNDS: usize = 5;
const NEAR: f64 = 1e-3;
/// What is kept in reserve of the ankle's range, radians.
const RESERVE: f64 = 0.03;
/// How quickly a heel that has to rise does so, and how quickly it comes down again, 1/s.
const RISES: f64 = 55.0;
const FALLS: f64 = 12.0;
const ROLLING_FALLS: f64 = 30.0;
/// A foot that leaves the ground waits before edges for a leg that lags behind; until so much of its swing is over, and for so
/// much at most, metres.
const LAGS_UNTIL: f64 = 0.4;
const MOST_LAG_M: f64 = 0.04;
/// The most by which a heel rises, and by which it does so to help a leg reach, radians.
const MOST_RISE: f64 = 1.0;
const REACH_RISE: f64 = 0.3;
/// From here on a foot rolls off: the heel's height over the ball's, over their distance.
const ROLLS: f64 = 0.3;
/// A sole whose ends are nearer to where they should be than this stands, metres.
const ON_PLANE_M: f64 = 0.006;

/// What a foot remembers.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct FootState {
    /// The pivot against the motion's: along x, the yaw in radians, along z.
    slip: Fade<DVec3>,
    /// The plane against the fitted one: rise along x, height at the pivot, rise along z.
    lift: Fade<DVec3>,
    plane: Plane,
    settled: bool,
    /// The motion's heel and place of roll, and its yaw.
    flat: [DVec3; 2],
    yaw: f64,
    pub landing: Landing,
    pub toes: ToesState,
    /// By how much the heel is up for the leg's and the ankle's sake, radians.
    rise: Fade<f64>,
    /// By how much toes that are up are down for the same, radians.
    lower: Fade<f64>,
    pub haste: Haste,
    /// Where the foot was to be.
    placed: Frame,
    /// How far the tip of the foot was below that, as the leg doesn't fold faster, metres.
    lag_m: f64,
    on_heel: bool,
}

/// What a foot's step is made of.
pub(super) struct Moment<'a> {
    /// `world_from_foot` of the motion on flat ground.
    pub flat: Frame,
    pub bearing: Bearing,
    /// `foot_from_toes` of the motion; asked for over steps only.
    pub toes: Frame,
    pub world_from_figure: &'a Frame,
    /// The hip's joint over flat ground, figure space.
    pub hip: DVec3,
    /// How far from it the ankle may be, metres.
    pub reach: f64,
    pub dt_secs: f64,
    pub at_once: bool,
    /// `world_from_figure` after so many seconds.
    pub after: &'a dyn Fn(f64) -> Frame,
}

impl Moment<'_> {
    pub fn touch(&self, foot: &Foot) -> Touch {
        let flat = self.world_from_figure.inverse().then(self.flat);
        let yaw = yaw(flat.rotation);
        // The sole comes down about the heel.
        let roll = flat.point(foot.heel) + axis_angle(DVec3::Y, yaw) * (foot.roll - foot.heel);
        Touch {
            ankle: flat.position,
            roll: DVec3::new(roll.x, flat.point(foot.roll).y, roll.z),
            hip: self.hip,
            yaw,
            reach: self.reach,
        }
    }
}

/// Where a foot should be.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Target {
    /// `world_from_foot`.
    pub frame: Frame,
    heel: DVec3,
    roll: DVec3,
    /// By how much the ball is above the heel, against the plane, radians; 0 where it is lower.
    toes_up: f64,
    /// How far the foot rolls off over its ball, 0 to 1: then the heel may rise as much as a leg needs.
    pub rolls: f64,
    pub plane: Plane,
    /// How firmly the ball holds.
    pub ball: f64,
    pub coming: Option<Coming>,
    /// Whether the ground has steps.
    pub on_steps: bool,
}

impl Target {
    /// The foot with its heel higher by an angle in radians, 0 or more: toes that are up come down first, about the heel;
    /// then the foot rolls over its ball.
    pub fn raised(&self, angle: f64) -> Frame {
        if angle <= 0.0 {
            return self.frame;
        }
        let about = |frame: Frame, point: DVec3, angle: f64| {
            let rotation = frame.rotation * axis_angle(DVec3::X, angle);
            Frame::new(rotation, frame.point(point) - rotation * point)
        };
        let down = angle.min(self.toes_up);
        let flat = if down > 0.0 { about(self.frame, self.heel, down) } else { self.frame };
        if angle > down { about(flat, self.roll, angle - down) } else { flat }
    }

    /// The least angle by which the heel rises so that the ankle is within a distance of a place (a hip), at most
    /// [`MOST_RISE`]; 0 if it is, or if rising doesn't help.
    pub fn rise_to_reach(&self, hip: DVec3, reach: f64) -> f64 {
        if self.frame.position.distance(hip) <= reach {
            return 0.0;
        }
        let flat = self.raised(self.toes_up);
        // |w + Rx(angle) v| = reach, seen from the foot: a cos(angle) + b sin(angle) = c.
        let w = flat.rotation.conjugate() * (flat.point(self.roll) - hip);
        let v = -self.roll;
        let (a, b) = (w.y * v.y + w.z * v.z, w.z * v.y - w.y * v.z);
        let c = 0.5 * (reach * reach - w.length_squared() - v.length_squared()) - w.x * v.x;
        let most = (a * a + b * b).sqrt();
        if b >= 0.0 || most < 1e-9 {
            return 0.0;
        }
        let rolled = arc_tangent(b, a) + (c / most).clamp(-1.0, 1.0).acos();
        (self.toes_up + rolled.max(0.0)).min(MOST_RISE)
    }
}

fn level(point: DVec3) -> DVec2 {
    DVec2::new(point.x, point.z)
}

impl FootState {
    /// Goes on by a moment, and says where the foot should be.
    pub fn step(&mut self, foot: &Foot, ground: &Ground, now: &Moment<'_>) -> Target {
        let flat = [foot.heel, foot.roll].map(|point| now.flat.point(point));
        let yaw = yaw(now.flat.rotation);
        let holds = |bearing: f64| if bearing.is_nan() { 0.0 } else { smooth(bearing, 0.0, HOLDS) };
        let (heel, ball) = (holds(now.bearing.heel), holds(now.bearing.ball));
        if now.at_once {
            *self = FootState { flat, yaw, landing: self.landing, ..FootState::default() };
        }
        self.landing.step(heel.max(ball), ball, self.plane, now, foot);
        let coming = self.landing.coming(foot, ground, now.after);
        self.turn_about(foot, heel > ball);
        let part = usize::from(!self.on_heel);
        let shift = coming.map_or(DVec2::ZERO, |coming| coming.shift);
        self.slip(flat, yaw, part, heel.max(ball), DVec3::new(shift.x, 0.0, shift.y), now.dt_secs);
        let at = level(flat[part]) + DVec2::new(self.slip.value.x, self.slip.value.z);
        let in_foot = if self.on_heel { foot.heel } else { foot.roll };
        let turned = axis_angle(DVec3::Y, yaw + self.slip.value.y);
        let fitted = Plane::of_foot(ground, at, foot, |point| at + level(turned * (point - in_foot)));
        let fitted = coming.map_or(fitted, |coming| self.landing.on_the_way(&coming, fitted));
        self.settle(fitted, if now.at_once { 0.0 } else { ball }, now.dt_secs);
        let plane = self.plane;
        let normal = plane.normal();
        let rotation = DQuat::from_rotation_arc(DVec3::Y, normal)
            * axis_angle(DVec3::Y, self.slip.value.y)
            * now.flat.rotation;
        let pivot = DVec3::new(at.x, plane.height + flat[part].y / normal.y, at.y);
        self.placed = Frame::new(rotation, pivot - rotation * in_foot);
        if let Some(coming) = coming.filter(|_| heel.max(ball) <= 0.0) {
            let lag = if coming.progress < LAGS_UNTIL { self.lag_m } else { 0.0 };
            let sole = foot.sole_at(self.placed, now.toes).map(|p| p - DVec3::Y * lag);
            let wait = self.landing.wait(ground, &sole);
            let back = DVec3::new(wait.x, 0.0, wait.y);
            self.placed.position += back;
            self.slip.value += back;
            if wait != DVec2::ZERO {
                self.slip.rate = DVec3::new(0.0, self.slip.rate.y, 0.0);
            }
        }
        // How the motion's sole lies to flat ground: with the toes up, or with the heel.
        let up = now.flat.point(foot.ball).y - flat[0].y;
        let length = foot.heel.distance(foot.ball);
        Target {
            frame: self.placed,
            heel: foot.heel,
            roll: foot.roll,
            toes_up: (up / length).clamp(0.0, 1.0).asin(),
            rolls: smooth(-up / length, 0.0, ROLLS),
            plane,
            ball,
            coming,
            on_steps: ground.has_steps(),
        }
    }

    /// Changes the part about which the foot turns, and leaves the foot where it was.
    fn turn_about(&mut self, foot: &Foot, heel: bool) {
        if heel == self.on_heel {
            return;
        }
        self.on_heel = heel;
        let (part, in_foot) = if heel { (0, foot.heel) } else { (1, foot.roll) };
        let off = self.placed.point(in_foot) - self.flat[part];
        if self.placed != Frame::IDENTITY {
            self.slip.value = DVec3::new(off.x, self.slip.value.y, off.z);
        }
    }

    /// Takes the motion's own way off what is held, and lets the rest go to where the foot is to come down.
    fn slip(&mut self, flat: [DVec3; 2], yaw: f64, part: usize, held: f64, goal: DVec3, dt_secs: f64) {
        let way = flat[part] - self.flat[part];
        let way = DVec3::new(way.x, wrapped(yaw - self.yaw), way.z);
        let still = self.slip.value - way;
        self.slip = self.slip.toward(goal, SLIP_FADES, dt_secs).held(still, held);
        (self.flat, self.yaw) = (flat, yaw);
    }

    /// Keeps the plane as far as it is held, else lets it fade into the fitted one.
    fn settle(&mut self, fitted: Plane, held: f64, dt_secs: f64) {
        let was = Plane { at: fitted.at, height: self.plane.height_at(fitted.at), ..self.plane };
        let off = |plane: Plane| {
            let gradient = plane.gradient - fitted.gradient;
            DVec3::new(gradient.x, plane.height - fitted.height, gradient.y)
        };
        // What jumps from step to step isn't taken at once.
        let jump = off(was) - self.lift.value;
        if dt_secs > 0.0 && jump.y.abs() > JUMP_M {
            self.lift.value += jump;
        }
        // A foot that came down elsewhere than was thought finds the ground first; then it holds its plane.
        self.settled = held > 0.0 && (self.settled || (held > 0.5 && off(was).y.abs() < SETTLED_M));
        let held = if self.settled { held } else { 0.0 };
        self.lift = self.lift.toward(DVec3::ZERO, PLANE_FADES, dt_secs).held(off(was), held);
        let lift = self.lift.value;
        self.plane = Plane {
            at: fitted.at,
            height: fitted.height + lift.y,
            gradient: fitted.gradient + DVec2::new(lift.x, lift.z),
        };
    }
}

/// The heading of a foot, radians about +Y, whatever its pitch: that of its axis from side to side.
fn yaw(rotation: DQuat) -> f64 {
    let across = rotation * DVec3::X;
    arc_tangent(-across.z, across.x)
}

/// Where a leg holds a foot.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Held {
    /// `world_from_foot`.
    pub frame: Frame,
    /// How far a ball that bears is below where it should be, as the leg can't fold faster, metres; above: negative.
    pub sunk_m: f64,
}

/// What holds a foot at its target.
pub(super) struct Grip<'a> {
    pub footing: &'a Footing,
    pub side: usize,
    pub settings: &'a PlacementSettings,
    pub world_from_figure: &'a Frame,
}

impl Grip<'_> {
    /// Bends the leg so that the foot is at its target, and says where it then is. The state has seen the motion. Where the leg can't
    /// reach or the ankle can't bend so far, the heel comes up, and down again slowly.
    pub fn hold(
        &self,
        hips: Frame,
        target: &Target,
        bend: &Bend,
        state: &mut FootState,
        dt_secs: f64,
        sample: &mut Sample,
    ) -> Held {
        let leg = &self.footing.legs.sides[self.side];
        let needed = self.needed_rise(hips, target, bend, sample);
        // Toes that are up come down at once; a heel that is off the ground goes back to it slowly.
        let at_once = dt_secs == 0.0;
        let rolled = (needed - target.toes_up).max(0.0);
        // A foot that rolls off has its heel up anyway.
        let falls = FALLS + target.rolls * (ROLLING_FALLS - FALLS);
        let quickness = if rolled > state.rise.value { RISES } else { falls };
        state.rise.follow(rolled, quickness, dt_secs, at_once);
        state.rise.value = state.rise.value.max(0.0);
        state.lower.follow(needed - rolled, RISES, dt_secs, at_once);
        state.lower.value = state.lower.value.clamp(0.0, target.toes_up);
        let rise = state.lower.value + state.rise.value;
        let softness = self.settings.softness_m(leg);
        let raised = target.raised(rise);
        let raised = if target.on_steps { self.no_lower(target, raised, sample) } else { raised };
        let bent = leg.bent_to(hips, &self.goal(raised), bend, softness, &mut sample.angles);
        let times = self.settings.haste.max(1.0);
        let turns = state.haste.hold(leg, hips, bent.turns, times, &mut sample.angles, dt_secs);
        let frame = self.world_from_figure.then(leg.foot_held_by(hips, &turns));
        let foot = &self.footing.feet[self.side];
        let tip = foot.sole[Sole::TOES];
        state.lag_m = (target.frame.point(tip).y - frame.point(tip).y).clamp(0.0, MOST_LAG_M);
        let sunk = raised.point(foot.roll).y - frame.point(foot.roll).y;
        Held { frame, sunk_m: target.ball * sunk }
    }

    /// Whether a foot's sole lies as it should.
    pub fn lies(&self, frame: Frame, target: &Target) -> bool {
        let foot = &self.footing.feet[self.side];
        [foot.heel, foot.ball].iter().all(|p| frame.point(*p).distance(target.frame.point(*p)) < ON_PLANE_M)
    }

    /// The least angle by which the heel has to rise, radians.
    fn needed_rise(&self, hips: Frame, target: &Target, bend: &Bend, flat: &Sample) -> f64 {
        let leg = &self.footing.legs.sides[self.side];
        let hip = self.world_from_figure.point(leg.hip(hips));
        let may = REACH_RISE * target.rolls.max(target.ball);
        let mut rise = target.rise_to_reach(hip, self.settings.reach(leg, bend)).min(may);
        let mut beyond = self.beyond(hips, target, rise, bend, flat) + RESERVE;
        if beyond <= 0.0 {
            return rise;
        }
        // The ankle's angle falls a little more slowly than the heel rises.
        let (mut low, mut low_beyond) = (rise, beyond);
        rise += 1.3 * beyond;
        for _ in 0..ROUNDS {
            beyond = self.beyond(hips, target, rise, bend, flat) + RESERVE;
            if beyond.abs() < NEAR || (beyond - low_beyond).abs() < 1e-9 {
                break;
            }
            let next = rise - beyond * (rise - low) / (beyond - low_beyond);
            (low, low_beyond) = (rise, beyond);
            rise = next.clamp(0.0, MOST_RISE);
        }
        rise
    }

    /// How far the ankle's flexion is beyond its range with the heel raised by an angle, radians; negative: how much is
    /// left.
    fn beyond(&self, hips: Frame, target: &Target, rise: f64, bend: &Bend, sample: &Sample) -> f64 {
        let leg = &self.footing.legs.sides[self.side];
        let was = sample.angles[leg.limb().parts().end.index()];
        let softness = self.settings.softness_m(leg);
        let flexion = leg.foot_flexion(hips, &self.goal(target.raised(rise)), bend, softness, &sample.angles);
        flexion.map_or(0.0, |flexion| beyond_range(leg, was.flexion, flexion))
    }

    /// A foot whose heel was raised, higher by as much as its toes are then nearer to the plane than they were to be: as the
    /// motion has them while the foot swings, bent up as far as they go while it stands.
    fn no_lower(&self, target: &Target, raised: Frame, sample: &Sample) -> Frame {
        let (leg, foot) = (&self.footing.legs.sides[self.side], &self.footing.feet[self.side]);
        let toes = if target.coming.is_some() {
            foot.toes_in_foot(leg, sample)
        } else {
            foot.toes_up(sample.angles[leg.toes_bone().index()])
        };
        let lowest = |frame: Frame| {
            let above = foot.sole_at(frame, toes).map(|p| p.y - target.plane.height_at(level(p)));
            above.into_iter().fold(f64::INFINITY, f64::min)
        };
        let up = (lowest(target.frame) - lowest(raised)).max(0.0);
        Frame { position: raised.position + DVec3::Y * up, ..raised }
    }

    fn goal(&self, world_from_foot: Frame) -> FootGoal {
        let wanted = self.world_from_figure.inverse().then(world_from_foot);
        FootGoal { ankle: wanted.position, rotation: wanted.rotation }
    }
}

/// How far a flexion of the ankle is beyond its range, which stretches to what it was, radians; 0 for what is no number.
fn beyond_range(leg: &Leg, was: f64, flexion: f64) -> f64 {
    let range = leg.foot().range(Dof::Flexion);
    let beyond = flexion - range.map_or(f64::INFINITY, |range| range.reaching(was).max);
    if beyond.is_finite() { beyond.to_radians() } else { 0.0 }
}
