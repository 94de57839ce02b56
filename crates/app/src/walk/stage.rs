//! What walks: the figure on its ground with placed feet and, for comparison, with feet as on flat ground; what was before the
//! last step and after it, and the footprints left.

use std::sync::Arc;

use glam::DVec3;
use motion::{FootView, Ground, Steering, Walker};
use rig::{Angles, Figure, Frames, Place, Pose, Side};

use super::clock::STEP_SECS;
use super::prints::Prints;

/// A walker at a moment.
#[derive(Clone, PartialEq, Debug)]
pub struct Moment {
    /// The pose.
    pub pose: Pose,
    /// Left and right foot.
    pub feet: [FootView; 2],
    /// How far the hips are lowered, metres.
    pub hips_drop_m: f64,
}

impl Moment {
    /// Before the first step; where the feet are the ground will tell.
    fn first(walker: &Walker) -> Moment {
        Moment { pose: walker.pose().clone(), feet: Default::default(), hips_drop_m: 0.0 }
    }

    fn of(walker: &Walker, ground: &Ground) -> Moment {
        let (pose, feet) = (walker.pose().clone(), walker.feet(ground));
        Moment { pose, feet, hips_drop_m: walker.hips_drop_m() }
    }

    /// What lies between two moments that follow each other: 0 is this one, 1 the other.
    fn toward(&self, other: &Moment, share: f64) -> Moment {
        let mix = |a: f64, b: f64| a + (b - a) * share;
        let pose = Pose {
            place: Place {
                position: self.pose.place.position.lerp(other.pose.place.position, share),
                turn: self.pose.place.turn + turned(self.pose.place.turn, other.pose.place.turn) * share,
            },
            hips: self.pose.hips.lerp(other.pose.hips, share),
            angles: std::array::from_fn(|i| {
                let (a, b) = (self.pose.angles[i], other.pose.angles[i]);
                Angles {
                    flexion: mix(a.flexion, b.flexion),
                    abduction: mix(a.abduction, b.abduction),
                    twist: mix(a.twist, b.twist),
                }
            }),
            limbs: other.pose.limbs.clone(),
        };
        let feet = std::array::from_fn(|i| between(&self.feet[i], &other.feet[i], share));
        Moment { pose, feet, hips_drop_m: mix(self.hips_drop_m, other.hips_drop_m) }
    }

    /// How far the lowest of the points that stand is in the ground, and how far the highest of them is above it, metres.
    pub fn off_the_ground(&self) -> [f64; 2] {
        let standing = self.feet.iter().filter(|foot| foot.stance);
        let heights = standing.flat_map(|foot| {
            foot.sole_in_world.iter().zip(&foot.ground_under_sole).map(|(point, ground)| point.y - ground)
        });
        heights.fold([0.0, 0.0], |[deep, high], off| [f64::max(deep, -off), f64::max(high, off)])
    }
}

fn between(a: &FootView, b: &FootView, share: f64) -> FootView {
    let points = |from: &[DVec3], to: &[DVec3]| -> Vec<DVec3> {
        from.iter().zip(to).map(|(a, b)| a.lerp(*b, share)).collect()
    };
    let heights = a.ground_under_sole.iter().zip(&b.ground_under_sole);
    FootView {
        sole_in_world: points(&a.sole_in_world, &b.sole_in_world),
        ground_under_sole: heights.map(|(a, b)| a + (b - a) * share).collect(),
        animated_ankle_in_world: a.animated_ankle_in_world.lerp(b.animated_ankle_in_world, share),
        ankle_in_world: a.ankle_in_world.lerp(b.ankle_in_world, share),
        ..b.clone()
    }
}

/// The shortest way from one turn to another, degrees.
fn turned(from: f64, to: f64) -> f64 {
    (to - from + 180.0).rem_euclid(360.0) - 180.0
}

/// A walker with what it was before its last step, and the prints of its feet.
#[derive(Clone, Debug)]
pub struct Actor {
    walker: Walker,
    former: Moment,
    now: Moment,
    prints: Prints,
}

impl Actor {
    fn new(walker: Walker) -> Actor {
        let now = Moment::first(&walker);
        Actor { walker, former: now.clone(), now, prints: Prints::default() }
    }

    fn step(&mut self, ground: &Ground, steering: &Steering) {
        self.walker.step(ground, steering, STEP_SECS);
        self.former = std::mem::replace(&mut self.now, Moment::of(&self.walker, ground));
        for (side, foot) in [Side::Left, Side::Right].into_iter().zip(&self.now.feet) {
            self.prints.take(side, foot);
        }
    }

    /// What is to be seen so far into the next step, 0 to 1.
    pub fn shown(&self, share: f64) -> Moment {
        self.former.toward(&self.now, share)
    }

    /// As it is after the last step.
    pub fn now(&self) -> &Moment {
        &self.now
    }

    /// Where its feet stood.
    pub fn prints(&self) -> &Prints {
        &self.prints
    }

    /// The walker.
    pub fn walker(&self) -> &Walker {
        &self.walker
    }
}

/// Joints of a moment in the world.
pub fn frames_of(figure: &Figure, moment: &Moment) -> Frames {
    rig::frames(figure, &moment.pose)
}

/// The figure that walks, and the same without foot placement beside it.
#[derive(Clone, Debug)]
pub struct Stage {
    figure: Arc<Figure>,
    start: Walker,
    placed: Actor,
    unplaced: Option<Actor>,
}

impl Stage {
    /// A walker at its start.
    pub fn new(figure: Arc<Figure>, walker: Walker) -> Stage {
        Stage { figure, placed: Actor::new(walker.clone()), start: walker, unplaced: None }
    }

    /// The figure.
    pub fn figure(&self) -> &Arc<Figure> {
        &self.figure
    }

    /// The one that walks, with placed feet unless they are switched off.
    pub fn actor(&self) -> &Actor {
        &self.placed
    }

    /// The one without foot placement, while both are shown.
    pub fn unplaced(&self) -> Option<&Actor> {
        self.unplaced.as_ref()
    }

    /// Places feet or lets them go as on flat ground, and shows both ways or one.
    pub fn place(&mut self, placement: bool, beside: bool) {
        self.placed.walker.feet_on_ground = placement || beside;
        if !beside {
            self.unplaced = None;
        } else if self.unplaced.is_none() {
            let mut actor = self.placed.clone();
            actor.walker.feet_on_ground = false;
            self.unplaced = Some(actor);
        }
    }

    /// Changes the walkers where they are.
    pub fn change(&mut self, change: impl Fn(&mut Walker)) {
        change(&mut self.start);
        let actors = [Some(&mut self.placed), self.unplaced.as_mut()];
        actors.into_iter().flatten().for_each(|actor| change(&mut actor.walker));
    }

    /// Goes on by one step of time.
    pub fn step(&mut self, ground: &Ground, steering: &Steering) {
        self.placed.step(ground, steering);
        if let Some(actor) = &mut self.unplaced {
            actor.step(ground, steering);
        }
    }

    /// Back to the start.
    pub fn restart(&mut self) {
        *self = Stage::new(self.figure.clone(), self.start.clone());
    }
}
