//! Toes that lie on the ground before the ball.

use rig::{Dof, Frame};

use super::fade::{Fade, smooth};
use super::fastest::Fastest;
use super::foot::Target;
use super::footing::{Footing, foot_from_toes};
use crate::{Ground, Sample};

/// How quickly toes follow the ground while the ball holds, and go back when it doesn't, 1/s.
const BENDS: f64 = 60.0;
const STRAIGHTENS: f64 = 12.0;
/// Ground that is so far off the sole's plane bends the toes; from the second on it is a step, metres.
const STEP_M: (f64, f64) = (0.03, 0.06);
/// Rounds of Newton's rule; the second is below a tenth of a degree.
const ROUNDS: usize = 3;
/// A tip that is so near to where it should be is there, metres.
const NEAR_M: f64 = 1e-4;
/// What a motion that was seen for a moment only is taken to bend toes by at most, degrees a second.
const AT_LEAST: f64 = 100.0;
/// What toes that the ball doesn't hold bend up at most, degrees.
const MOST_LIFT: f64 = 25.0;

/// What toes remember.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct ToesState {
    /// What they are bent beyond the motion's, degrees.
    bent: Fade<f64>,
    /// The motion's flexion and the placed one, degrees.
    flat: f64,
    placed: f64,
    /// The motion's fastest bend, degrees a second.
    fastest: Fastest,
}

impl ToesState {
    /// Bends beyond the motion's flexion toward a goal, not much faster than the motion does; gives the flexion.
    fn bend(&mut self, flat: f64, goal: f64, quickness: f64, times: f64, dt_secs: f64) -> f64 {
        self.bent.follow(goal, quickness, dt_secs, dt_secs == 0.0);
        if dt_secs > 0.0 {
            self.fastest.see((flat - self.flat).abs(), Fastest::left(dt_secs), dt_secs);
            let most = self.fastest.most(AT_LEAST, times * dt_secs);
            let held = (flat + self.bent.value).clamp(self.placed - most, self.placed + most);
            if held != flat + self.bent.value {
                self.bent = Fade { value: held - flat, rate: 0.0 };
            }
        }
        self.flat = flat;
        flat + self.bent.value
    }
}

/// What bends the toes of a placed foot.
pub(super) struct Bending<'a> {
    pub footing: &'a Footing,
    pub side: usize,
    pub ground: &'a Ground,
    /// How many times as fast as in the motion.
    pub times: f64,
    pub dt_secs: f64,
}

impl Bending<'_> {
    /// Bends toes so that their tip is as high above the ground there as the motion has it above flat
    /// ground, as far as the ball holds; elsewhere they stay as the motion has them.
    pub fn bend(&self, world_from_foot: Frame, target: &Target, state: &mut ToesState, sample: &mut Sample) {
        let &Bending { footing, side, ground, times, dt_secs } = self;
        let (leg, foot) = (&footing.legs.sides[side], &footing.feet[side]);
        let Some(toes) = &foot.toes else { return };
        let Some(range) = toes.joint.range(Dof::Flexion) else { return };
        let bone = leg.toes_bone().index();
        let was = sample.angles[bone];
        let tip_at = |flexion: f64, frame: Frame| {
            let angles = rig::Angles { flexion, ..was };
            frame.point(foot_from_toes(toes, angles).point(toes.tip))
        };
        // The motion's own height of the tip over the plane.
        let meant = tip_at(was.flexion, target.frame);
        let level = |p: glam::DVec3| glam::DVec2::new(p.x, p.z);
        let above = meant.y - target.plane.height_at(level(meant));
        let mut flexion = was.flexion;
        let rounds = if target.ball > 0.0 { ROUNDS } else { 0 };
        for _ in 0..rounds {
            let tip = tip_at(flexion, world_from_foot);
            let plane = target.plane.height_at(level(tip));
            let step = ground.height(tip.x, tip.z) - plane;
            // Toes bend to the ground, but not up or down a step.
            let bump = step * (1.0 - smooth(step.abs(), STEP_M.0, STEP_M.1));
            let off = tip.y - plane - bump - above;
            if off.abs() < NEAR_M {
                break;
            }
            let sinks = tip.y - tip_at(flexion + 1.0, world_from_foot).y;
            if sinks > 1e-6 {
                flexion += (off / sinks).clamp(-40.0, 40.0);
            }
        }
        // A tip that the ball doesn't hold comes out of the ground, but isn't brought down to it.
        let tip = tip_at(was.flexion, world_from_foot);
        let deep = ground.height(tip.x, tip.z) - tip.y;
        let in_ground = deep > 0.0 && deep < STEP_M.1;
        let mut lifts = 0.0;
        if in_ground {
            let sinks = tip.y - tip_at(was.flexion + 1.0, world_from_foot).y;
            lifts = if sinks > 1e-4 { (-deep / sinks).max(-MOST_LIFT) } else { 0.0 };
        }
        let goal = lifts + target.ball * (flexion - was.flexion - lifts);
        let follows = if lifts < 0.0 { 1.0 } else { target.ball };
        let quickness = STRAIGHTENS + follows * (BENDS - STRAIGHTENS);
        let bent = state.bend(was.flexion, goal, quickness, times, dt_secs);
        let flexion = range.reaching(was.flexion).clamp(bent);
        state.placed = flexion;
        sample.angles[bone].flexion = flexion;
    }
}
