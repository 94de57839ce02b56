//! Feet on uneven ground: a blend tree's last node.
//!
//! The motion gives feet over flat ground. Each foot has a plane, fitted to the ground under it, and stands to that plane
//! as the motion's foot stands to the flat ground. So heel, whole sole and ball roll off as they do there. While a
//! part of the sole bears weight, the foot is held where that part touched; what differs then from the motion and
//! from the ground below fades as the foot swings. Hips go up and down with the ground around, and farther down by
//! the least that lets both legs reach.

mod fade;
mod fastest;
mod foot;
mod footing;
mod haste;
mod hips;
mod landing;
mod lift;
mod plane;
mod stand;
mod toes;

use glam::{DQuat, DVec3};
use rig::{Frame, Place};
use serde::{Deserialize, Serialize};

use crate::{Bend, Ground, Leg, Sample};

pub use footing::Footing;
pub use lift::lift_feet;
pub use stand::stand;

use fade::Fade;
use foot::FootState;
use landing::Landing;

/// How feet are placed.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PlacementSettings {
    /// Whether they are placed at all; off, feet are only looked at.
    pub on: bool,
    /// How near full stretch a leg begins to ease, as a share of its length.
    pub softness: f64,
    /// How much of a slope the spine leans against, 0 to 1.
    pub lean: f64,
    /// How many times as fast as in the motion the joints of a leg may turn, at least 1.
    pub haste: f64,
}

impl Default for PlacementSettings {
    fn default() -> PlacementSettings {
        PlacementSettings { on: true, softness: 0.012, lean: 0.2, haste: 1.4 }
    }
}

impl PlacementSettings {
    /// How near full stretch a leg begins to ease, metres.
    fn softness_m(&self, leg: &Leg) -> f64 {
        self.softness.clamp(0.0, 0.2) * leg.full_reach()
    }

    /// How far from the hip an ankle may be before something gives way, metres: where the leg begins to ease, or where the
    /// motion itself has it.
    fn reach(&self, leg: &Leg, bend: &Bend) -> f64 {
        (leg.full_reach() - self.softness_m(leg)).max(bend.distance)
    }
}

/// What the placement remembers from step to step. The default stands where the next step finds the feet.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct FeetState {
    feet: [FootState; 2],
    /// Hips: what they go down beyond the ground's own rise, metres.
    drop: Fade<f64>,
    /// Forward lean, degrees.
    lean: Fade<f64>,
    place: Place,
    begun: bool,
    /// Whether it has gone on since.
    going: bool,
}

impl FeetState {
    /// Where feet will come down that have not yet: as the other did, or as far ahead as one is when the figure sets off.
    fn foresee(&mut self, footing: &Footing, now: &[foot::Moment<'_>; 2], speed: f64) {
        let [left, right] = &mut self.feet;
        if self.begun && !self.going {
            let touches = [0, 1].map(|side| now[side].touch(&footing.feet[side]));
            Landing::guess([&mut left.landing, &mut right.landing], touches, speed);
        }
        self.going = self.begun;
        let before = left.landing;
        left.landing.learn(&right.landing);
        right.landing.learn(&before);
    }
}

/// A foot as it was placed.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct PlacedFoot {
    /// Whether the whole sole stands on the ground and bears weight.
    pub stance: bool,
    /// The ankle's joint as the motion on flat ground has it, metres, world.
    pub animated_ankle_in_world: DVec3,
    /// Where it was placed.
    pub world_from_foot: Frame,
    /// How far the hips went down beyond the rise of the ground around, metres, 0 or less.
    pub hips_drop: f64,
}

/// A foot as it was placed, and the ground under it: what is shown and measured of it.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct FootView {
    /// Whether the whole sole stands on the ground and bears weight.
    pub stance: bool,
    /// Points of the sole, metres, world: heel, ball and toes, each in the middle, at the outer and the inner edge.
    pub sole_in_world: Vec<DVec3>,
    /// The ground's height under each, metres.
    pub ground_under_sole: Vec<f64>,
    /// The ankle's joint as the motion on flat ground has it, metres, world.
    pub animated_ankle_in_world: DVec3,
    /// Where it was placed, metres, world.
    pub ankle_in_world: DVec3,
    /// How far the hips went down beyond the rise of the ground around, metres, 0 or less.
    pub hips_drop: f64,
}

/// What places a figure's feet on some ground.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Placement<'a> {
    /// Of the figure.
    pub footing: &'a Footing,
    /// Where it walks.
    pub ground: &'a Ground,
    /// How feet are placed.
    pub settings: &'a PlacementSettings,
}

impl Placement<'_> {
    /// Bends a sample of a motion over flat ground so that its feet stand on the ground, a time step after the last.
    ///
    /// `place` is where the figure now stands; its height is left out of account. Ranges are kept. A step of no time, or
    /// the first with a fresh state, places feet and hips at once, without easing. Deterministic; no allocation. The feet
    /// that it returns are left and right.
    pub fn step(
        &self,
        place: &Place,
        sample: &mut Sample,
        state: &mut FeetState,
        dt_secs: f64,
    ) -> [PlacedFoot; 2] {
        let turns = self.footing.turns(sample);
        self.step_turned(place, sample, &turns, state, dt_secs)
    }

    /// As [`Placement::step`], given the turns of the sample's hips, knees and ankles.
    pub(crate) fn step_turned(
        &self,
        place: &Place,
        sample: &mut Sample,
        turns: &[[DQuat; 3]; 2],
        state: &mut FeetState,
        dt_secs: f64,
    ) -> [PlacedFoot; 2] {
        let Placement { footing, settings, .. } = self;
        let level = Place { position: DVec3::new(place.position.x, 0.0, place.position.z), ..*place };
        let world_from_figure = level.world_from_figure();
        let hips = footing.hips(sample);
        let flat = [0, 1]
            .map(|side| world_from_figure.then(footing.legs.sides[side].foot_held_by(hips, &turns[side])));
        let sound = near(level.position) && flat.iter().all(|f| near(f.position) && f.rotation.is_finite());
        let dt_secs = if dt_secs.is_finite() && state.begun { dt_secs.clamp(0.0, 0.25) } else { 0.0 };
        let footed = if settings.on && sound {
            let at_once = !state.begun || dt_secs == 0.0;
            let going = Going::on(state.place, &level, dt_secs, at_once);
            state.place = level;
            let motion = Motion { world_from_figure, hips, flat, turns, going, dt_secs, at_once };
            self.bend(&motion, sample, state)
        } else {
            Footed { frames: flat, drop: 0.0, lies: [true; 2] }
        };
        [0, 1].map(|side| {
            let bearing = sample.bearing[side];
            PlacedFoot {
                stance: bearing.heel >= STANDS && bearing.ball >= STANDS && footed.lies[side],
                animated_ankle_in_world: flat[side].position,
                world_from_foot: footed.frames[side],
                hips_drop: footed.drop,
            }
        })
    }

    /// Bends hips, spine, legs and toes.
    fn bend(&self, motion: &Motion<'_>, sample: &mut Sample, state: &mut FeetState) -> Footed {
        let Placement { footing, ground, settings } = *self;
        let &Motion { ref world_from_figure, hips, flat, turns, dt_secs, at_once, .. } = motion;
        let bends = [0, 1].map(|side| footing.legs.sides[side].bend_of(turns[side][0], &sample.angles));
        let after = |secs: f64| motion.going.after(secs);
        let steps = ground.has_steps();
        let moments = [0, 1].map(|side| {
            let leg = &footing.legs.sides[side];
            foot::Moment {
                flat: flat[side],
                bearing: sample.bearing[side],
                toes: if steps { footing.feet[side].toes_in_foot(leg, sample) } else { Frame::IDENTITY },
                world_from_figure,
                hip: leg.hip(hips),
                reach: settings.reach(leg, &bends[side]),
                dt_secs,
                at_once,
                after: &after,
            }
        });
        state.foresee(footing, &moments, motion.going.velocity.length());
        let targets = [0, 1].map(|side| state.feet[side].step(&footing.feet[side], ground, &moments[side]));
        let around = hips::around(world_from_figure, sample, &targets);
        let reach = hips::Reach { footing, settings, world_from_figure, bends: &bends };
        let mut drop = reach.drop(hips, around.height, &targets, &mut state.drop, dt_secs, at_once);
        sample.hips.y += around.height + drop;
        let lean = settings.lean.clamp(0.0, 1.0) * around.ahead_degrees.clamp(-30.0, 30.0);
        state.lean.follow(lean, 3.0, dt_secs, at_once);
        footing.lean(state.lean.value, sample);
        let placed_hips = footing.hips(sample);
        let grips = [0, 1].map(|side| foot::Grip { footing, side, settings, world_from_figure });
        let held = [0, 1].map(|side| {
            let foot = &mut state.feet[side];
            foot.haste.see(&turns[side], dt_secs);
            grips[side].hold(placed_hips, &targets[side], &bends[side], foot, dt_secs, sample)
        });
        // Hips don't go down faster than the legs below them fold.
        let up = hips::held_up(&targets, &held).min(-drop);
        state.drop.value += up;
        sample.hips.y += up;
        drop += up;
        let frames = held.map(|held| Frame { position: held.frame.position + DVec3::Y * up, ..held.frame });
        let lies = [0, 1].map(|side| grips[side].lies(frames[side], &targets[side]));
        for side in 0..2 {
            let toes = toes::Bending { footing, side, ground, times: settings.haste.max(1.0), dt_secs };
            toes.bend(frames[side], &targets[side], &mut state.feet[side].toes, sample);
        }
        state.begun = true;
        Footed { frames, drop, lies }
    }
}

/// A motion over flat ground at a moment.
struct Motion<'a> {
    world_from_figure: Frame,
    /// Of the hips, in figure space.
    hips: Frame,
    /// `world_from_foot`.
    flat: [Frame; 2],
    turns: &'a [[DQuat; 3]; 2],
    going: Going,
    dt_secs: f64,
    at_once: bool,
}

/// What became of the feet.
struct Footed {
    /// `world_from_foot`.
    frames: [Frame; 2],
    /// Of the hips, metres.
    drop: f64,
    /// Whether each sole lies as it should.
    lies: [bool; 2],
}

/// Whether a point is one with which to reckon.
fn near(point: DVec3) -> bool {
    point.is_finite() && point.abs().max_element() < 1e9
}

/// How the figure goes on.
struct Going {
    place: Place,
    velocity: DVec3,
    turn_rate: f64,
}

impl Going {
    fn on(before: Place, place: &Place, dt_secs: f64, at_once: bool) -> Going {
        let per_sec = if at_once { 0.0 } else { 1.0 / dt_secs };
        Going {
            place: *place,
            velocity: (place.position - before.position) * per_sec,
            turn_rate: (place.turn - before.turn) * per_sec,
        }
    }

    /// Where it is after so many seconds.
    fn after(&self, secs: f64) -> Frame {
        let (position, turn) =
            (self.place.position + self.velocity * secs, self.place.turn + self.turn_rate * secs);
        Place { position, turn }.world_from_figure()
    }
}

/// From here on a part of the sole counts as standing.
const STANDS: f64 = 0.95;

impl PlacedFoot {
    /// What is to be seen of it, given the sample that was bent.
    pub fn view(&self, footing: &Footing, side: usize, ground: &Ground, sample: &Sample) -> FootView {
        let toes = footing.feet[side].toes_in_foot(&footing.legs.sides[side], sample);
        let sole = footing.feet[side].sole_at(self.world_from_foot, toes);
        FootView {
            stance: self.stance,
            sole_in_world: sole.to_vec(),
            ground_under_sole: sole.map(|at| ground.height(at.x, at.z)).to_vec(),
            animated_ankle_in_world: self.animated_ankle_in_world,
            ankle_in_world: self.world_from_foot.position,
            hips_drop: self.hips_drop,
        }
    }
}
