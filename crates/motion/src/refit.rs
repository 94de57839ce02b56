//! Motion of one figure made that of another: as long steps for its legs, the feet as still and as high.

use glam::{DQuat, DVec3};
use rig::{Angles, Bone, Dof, Figure, Frame};

use crate::{Bend, FootGoal, Footing, Leg, Sample, Sole, Soles};

/// A leg that is nearer to straight than this in both figures bends alike in both: distance over full reach.
const NEARLY_STRAIGHT: f64 = 0.97;
/// Over how long hips that must go lower do so, to either side, seconds.
const EASE_SECS: f64 = 0.08;
/// How often an ankle is placed anew whose foot stopped at a range.
const ROUNDS: usize = 8;

/// A figure on its feet: what the motion of one must know of the other.
pub(crate) struct Standing<'a> {
    pub figure: &'a Figure,
    footing: Footing,
    pub soles: Soles,
    /// Between the hip joints, in the frame of the hips, metres.
    middle: DVec3,
    /// Height of the hip joints over the soles at rest, metres.
    pub leg_height_m: f64,
}

/// What a sample asks of a foot, in figure space, scaled for the other figure.
#[derive(Clone, Copy)]
struct Wish {
    rotation: DQuat,
    /// As far as the other figure's toes bend.
    toes: Angles,
    /// Of the ball, metres; only x and z count.
    ball: DVec3,
    /// Height of the sole's lowest point, metres.
    lowest: f64,
    /// Distance from hip to ankle over full reach.
    stretch: f64,
    bend: Bend,
}

impl<'a> Standing<'a> {
    /// `None` if the figure lacks a leg.
    pub fn of(figure: &'a Figure) -> Option<Standing<'a>> {
        let (footing, soles) = (Footing::of(figure)?, Soles::of(figure)?);
        let rest = figure.rest_pose();
        let hips = Frame::new(DQuat::IDENTITY, rest.hips);
        let middle = (footing.legs.sides[0].hip(hips) + footing.legs.sides[1].hip(hips)) * 0.5;
        let ground = soles.lowest(&rig::frames(figure, &rest));
        let leg_height_m = (middle.y - ground).max(1e-6);
        Some(Standing { figure, footing, soles, middle: middle - rest.hips, leg_height_m })
    }

    /// The sole's points about the ankle, for a foot turned in figure space and its toes.
    fn sole_about_ankle(&self, side: usize, foot: DQuat, toes: Angles) -> [DVec3; Sole::COUNT] {
        let own = &self.footing.feet[side];
        own.sole_at(Frame::new(foot, DVec3::ZERO), own.toes_bent(toes))
    }

    /// The sole's points in figure space.
    pub fn sole(&self, side: usize, sample: &Sample) -> [DVec3; Sole::COUNT] {
        let leg = &self.footing.legs.sides[side];
        let foot = leg.ankle_and_foot(self.footing.hips(sample), &sample.angles);
        let toes = sample.angles[leg.toes_bone().index()];
        self.sole_about_ankle(side, foot.rotation, toes).map(|p| p + foot.position)
    }
}

/// Makes samples of one figure's motion those of another's; times between them are `step_secs`.
pub(crate) fn refit(samples: &mut [Sample], from: &Standing, to: &Standing, loops: bool, step_secs: f64) {
    let scale = to.leg_height_m / from.leg_height_m;
    let mut wishes = Vec::with_capacity(samples.len());
    let mut drops = Vec::with_capacity(samples.len());
    for sample in samples.iter_mut() {
        let mut own = [0, 1].map(|side| wish(from, to, side, sample, scale));
        let middle = from.footing.hips(sample).point(from.middle);
        hold_in_ranges(to.figure, sample);
        for (wish, leg) in own.iter_mut().zip(&to.footing.legs.sides) {
            wish.toes = sample.angles[leg.toes_bone().index()];
        }
        sample.hips = DVec3::ZERO;
        sample.hips = middle * scale - to.footing.hips(sample).point(to.middle);
        drops.push(drop(to, sample, &own));
        wishes.push(own);
    }
    let around = (EASE_SECS / step_secs).round() as usize;
    let drops = eased(&drops, around, loops);
    for ((sample, wishes), drop) in samples.iter_mut().zip(&wishes).zip(drops) {
        sample.hips.y -= drop;
        for (side, wish) in wishes.iter().enumerate() {
            solve(to, side, wish, sample);
        }
    }
}

fn wish(from: &Standing, to: &Standing, side: usize, sample: &Sample, scale: f64) -> Wish {
    let leg = &from.footing.legs.sides[side];
    let foot = leg.ankle_and_foot(from.footing.hips(sample), &sample.angles);
    let toes = sample.angles[leg.toes_bone().index()];
    let sole = from.sole_about_ankle(side, foot.rotation, toes).map(|p| p + foot.position);
    let lowest = sole.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
    let stretch = leg.bend(&sample.angles).distance / leg.full_reach();
    let bend = to.footing.legs.sides[side].bend(&sample.angles);
    Wish {
        rotation: foot.rotation,
        toes,
        ball: sole[Sole::BALL] * scale,
        lowest: lowest * scale,
        stretch,
        bend,
    }
}

/// Angles that a figure's joints lack or can't have, brought to what they have and can.
fn hold_in_ranges(figure: &Figure, sample: &mut Sample) {
    for bone in Bone::ALL {
        let angles = &mut sample.angles[bone.index()];
        let joint = figure.skeleton.joint(bone);
        for dof in Dof::ALL {
            let range = joint.and_then(|joint| joint.range(dof));
            angles.set(dof, range.map_or(0.0, |range| range.clamp(angles.get(dof))));
        }
    }
}

/// Where the ankle is to be so that the sole does what is wished, for a foot turned so.
fn ankle(to: &Standing, side: usize, wish: &Wish, rotation: DQuat) -> DVec3 {
    let sole = to.sole_about_ankle(side, rotation, wish.toes);
    let lowest = sole.iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
    let ball = sole[Sole::BALL];
    DVec3::new(wish.ball.x - ball.x, wish.lowest - lowest, wish.ball.z - ball.z)
}

/// How much lower the hips must be for both legs to reach, metres.
fn drop(to: &Standing, sample: &Sample, wishes: &[Wish; 2]) -> f64 {
    let hips = to.footing.hips(sample);
    let needed = wishes.iter().enumerate().map(|(side, wish)| {
        let leg = &to.footing.legs.sides[side];
        let reach = leg.full_reach() * wish.stretch.clamp(NEARLY_STRAIGHT, 1.0);
        let from_ankle = leg.hip(hips) - ankle(to, side, wish, wish.rotation);
        let level = from_ankle.x * from_ankle.x + from_ankle.z * from_ankle.z;
        from_ankle.y - (reach * reach - level).max(0.0).sqrt()
    });
    needed.fold(0.0, f64::max)
}

/// Drops made smooth and nowhere smaller: the largest around each, then the mean around each of those.
fn eased(drops: &[f64], around: usize, loops: bool) -> Vec<f64> {
    let count = drops.len() as isize;
    let around = (around as isize).min(count / 2);
    let at = |values: &[f64], i: isize| {
        values[if loops { i.rem_euclid(count) } else { i.clamp(0, count - 1) } as usize]
    };
    let largest = |i: isize| (-around..=around).map(|k| at(drops, i + k)).fold(0.0, f64::max);
    let largest: Vec<f64> = (0..count).map(largest).collect();
    let mean = |i: isize| {
        let window = (-around..=around).map(|k| at(&largest, i + k));
        window.sum::<f64>() / (2 * around + 1) as f64
    };
    (0..count).map(mean).collect()
}

/// Bends the leg so that the sole does what is wished. A foot that stops at a range is placed anew as it is turned.
fn solve(to: &Standing, side: usize, wish: &Wish, sample: &mut Sample) {
    let leg: &Leg = &to.footing.legs.sides[side];
    let hips = to.footing.hips(sample);
    let mut rotation = wish.rotation;
    for _ in 0..ROUNDS {
        let goal = FootGoal { ankle: ankle(to, side, wish, rotation), rotation: wish.rotation };
        let miss = leg.solve(hips, &goal, &wish.bend, 0.0, &mut sample.angles);
        if miss.foot_degrees < 1e-6 {
            break;
        }
        rotation = leg.ankle_and_foot(hips, &sample.angles).rotation;
    }
}
