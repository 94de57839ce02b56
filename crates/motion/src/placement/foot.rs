//! One foot: the plane that it stands on, where it is held, and where that wants it to be.

use glam::{DQuat, DVec2, DVec3};
use kin::wrapped;
use rig::Frame;

use super::PlacementSettings;
use super::fade::{Fade, smooth};
use super::footing::{Foot, Footing};
use super::plane::Plane;
use crate::{Bearing, Bend, FootGoal, Ground, Sample};

/// How quickly what a held foot had against the motion fades as it swings, 1/s.
const SLIP_FADES: f64 = 16.0;
/// How quickly the plane that it stood on fades into that of the ground below, 1/s.
const PLANE_FADES: f64 = 22.0;
/// The bearing from which on a part of the sole holds wholly.
const HOLDS: f64 = 0.6;
/// Rounds in which a foot that its ankle can't turn far enough settles.
const ROUNDS: usize = 4;
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
    /// The motion's heel and place of roll, and its yaw.
    flat: [DVec3; 2],
    yaw: f64,
    /// Where the foot was to be.
    placed: Frame,
    on_heel: bool,
}

/// What a foot's step is made of.
pub(super) struct Moment {
    /// `world_from_foot` of the motion on flat ground.
    pub flat: Frame,
    pub bearing: Bearing,
    pub dt_secs: f64,
    pub at_once: bool,
}

/// Where a foot should be.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Target {
    /// `world_from_foot`.
    pub frame: Frame,
    /// About which it turns if the ankle can't: in the foot's frame, and in the world.
    pub pivot_in_foot: DVec3,
    pub pivot: DVec3,
    pub plane: Plane,
    /// How firmly the ball holds.
    pub ball: f64,
}

fn level(point: DVec3) -> DVec2 {
    DVec2::new(point.x, point.z)
}

impl FootState {
    /// Goes on by a moment, and says where the foot should be.
    pub fn step(&mut self, foot: &Foot, ground: &Ground, now: &Moment) -> Target {
        let flat = [foot.heel, foot.roll].map(|point| now.flat.point(point));
        let yaw = yaw(now.flat.rotation);
        let holds = |bearing: f64| smooth(bearing, 0.0, HOLDS);
        let (heel, ball) = (holds(now.bearing.heel), holds(now.bearing.ball));
        if now.at_once {
            *self = FootState { flat, yaw, ..FootState::default() };
        }
        self.turn_about(foot, heel > ball);
        let part = usize::from(!self.on_heel);
        self.slip(flat, yaw, part, heel.max(ball), now.dt_secs);
        let at = level(flat[part]) + DVec2::new(self.slip.value.x, self.slip.value.z);
        let in_foot = if self.on_heel { foot.heel } else { foot.roll };
        let turned = DQuat::from_rotation_y(yaw + self.slip.value.y);
        let print = foot.print.map(|point| at + level(turned * (point - in_foot)));
        let fitted = Plane::under(ground, at, &print);
        self.settle(fitted, if now.at_once { 0.0 } else { ball }, now.dt_secs);
        let plane = self.plane;
        let normal = plane.normal();
        let rotation = DQuat::from_rotation_arc(DVec3::Y, normal)
            * DQuat::from_rotation_y(self.slip.value.y)
            * now.flat.rotation;
        let pivot = DVec3::new(at.x, plane.height + flat[part].y / normal.y, at.y);
        self.placed = Frame::new(rotation, pivot - rotation * in_foot);
        // Where the ankle can't turn so far, the foot turns about the end that is lower in the motion.
        let heel_is_lower = now.flat.point(foot.ball).y - flat[0].y;
        let pivot_in_foot =
            foot.roll.lerp(foot.heel, smooth(heel_is_lower, 0.0, 0.2 * foot.heel.distance(foot.ball)));
        Target { frame: self.placed, pivot_in_foot, pivot: self.placed.point(pivot_in_foot), plane, ball }
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

    /// Takes the motion's own way off what is held, and lets the rest fade.
    fn slip(&mut self, flat: [DVec3; 2], yaw: f64, part: usize, held: f64, dt_secs: f64) {
        let way = flat[part] - self.flat[part];
        let way = DVec3::new(way.x, wrapped(yaw - self.yaw), way.z);
        let still = self.slip.value - way;
        self.slip = self.slip.toward(DVec3::ZERO, SLIP_FADES, dt_secs).held(still, held);
        (self.flat, self.yaw) = (flat, yaw);
    }

    /// Keeps the plane as far as it is held, else lets it fade into the fitted one.
    fn settle(&mut self, fitted: Plane, held: f64, dt_secs: f64) {
        let was = Plane { at: fitted.at, height: self.plane.height_at(fitted.at), ..self.plane };
        let off = |plane: Plane| {
            let gradient = plane.gradient - fitted.gradient;
            DVec3::new(gradient.x, plane.height - fitted.height, gradient.y)
        };
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
    (-across.z).atan2(across.x)
}

/// What holds a foot at its target.
pub(super) struct Grip<'a> {
    pub footing: &'a Footing,
    pub side: usize,
    pub settings: &'a PlacementSettings,
    pub world_from_figure: &'a Frame,
}

impl Grip<'_> {
    /// Bends the leg so that the foot is at its target, and says whether its sole lies as it should. Where the ankle
    /// can't turn so far, the pivot keeps its place: the heel comes up.
    pub fn hold(&self, hips: Frame, target: &Target, bend: &Bend, sample: &mut Sample) -> bool {
        let leg = &self.footing.legs.sides[self.side];
        let figure_from_world = self.world_from_figure.inverse();
        let wanted = figure_from_world.then(target.frame);
        let pivot = figure_from_world.point(target.pivot);
        let softness = self.settings.softness.clamp(0.0, 0.2) * leg.full_reach();
        let mut ankle = wanted.position;
        for _ in 0..ROUNDS {
            let goal = FootGoal { ankle, rotation: wanted.rotation };
            let miss = leg.solve(hips, &goal, bend, softness, &mut sample.angles);
            if miss.foot_degrees < 0.01 {
                break;
            }
            let rotation = leg.ankle_and_foot(hips, &sample.angles).rotation;
            ankle = pivot - rotation * target.pivot_in_foot;
        }
        let held = leg.ankle_and_foot(hips, &sample.angles);
        let foot = &self.footing.feet[self.side];
        [foot.heel, foot.ball].iter().all(|p| held.point(*p).distance(wanted.point(*p)) < ON_PLANE_M)
    }
}
