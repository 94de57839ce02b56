//! Feet on uneven ground: a blend tree's last node.
//!
//! The motion gives feet over flat ground. Each foot has a plane, fitted to the ground under it, and stands to that plane
//! as the motion's foot stands to the flat ground. So heel, whole sole and ball roll off as they do there. While a
//! part of the sole bears weight, the foot is held where that part touched; what differs then from the motion and
//! from the ground below fades as the foot swings. Hips go up and down with the ground around, and farther down by
//! the least that lets both legs reach.

mod fade;
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

/// Bends a sample of a motion over flat ground so that its feet stand on the ground, a time step after the last.
///
/// `place` is where the figure now stands; its height is left out of account. Ranges are kept. A step of no time, or the
/// first with a fresh state, places feet and hips at once, without easing. Deterministic; no allocation once the
/// views have grown.
#[allow(clippy::too_many_arguments)] // a node's inputs, its state and its outputs
pub fn place_feet(
    footing: &Footing,
    ground: &Ground,
    place: &Place,
    sample: &mut Sample,
    settings: &PlacementSettings,
    state: &mut FeetState,
    dt_secs: f64,
    views: &mut [FootView; 2],
) {
    let turns = footing.turns(sample);
    place_turned_feet(footing, ground, place, sample, &turns, settings, state, dt_secs, views);
}

/// As [`place_feet`], given the turns of the sample's hips, knees and ankles.
#[allow(clippy::too_many_arguments)] // a node's inputs, its state and its outputs
pub(crate) fn place_turned_feet(
    footing: &Footing,
    ground: &Ground,
    place: &Place,
    sample: &mut Sample,
    turns: &[[DQuat; 3]; 2],
    settings: &PlacementSettings,
    state: &mut FeetState,
    dt_secs: f64,
    views: &mut [FootView; 2],
) {
    let level = Place { position: DVec3::new(place.position.x, 0.0, place.position.z), ..*place };
    let world_from_figure = level.world_from_figure();
    let flat_hips = footing.hips(sample);
    let flat = [0, 1]
        .map(|side| world_from_figure.then(footing.legs.sides[side].foot_held_by(flat_hips, &turns[side])));
    let dt_secs = if dt_secs.is_finite() && state.begun { dt_secs.clamp(0.0, 0.25) } else { 0.0 };
    let at_once = !state.begun || dt_secs == 0.0;
    let mut drop = 0.0;
    let (mut frames, mut soles) = (flat, [true; 2]);
    let sound = near(level.position) && flat.iter().all(|f| near(f.position) && f.rotation.is_finite());
    if settings.on && sound {
        let bends = [0, 1].map(|side| footing.legs.sides[side].bend_of(turns[side][0], &sample.angles));
        let going = Going::on(state.place, &level, dt_secs, at_once);
        let after = |secs: f64| going.after(secs);
        state.place = level;
        let steps = ground.has_steps();
        let moments = [0, 1].map(|side| {
            let leg = &footing.legs.sides[side];
            foot::Moment {
                flat: flat[side],
                bearing: sample.bearing[side],
                toes: if steps { footing.feet[side].toes_in_foot(leg, sample) } else { Frame::IDENTITY },
                world_from_figure: &world_from_figure,
                hip: leg.hip(flat_hips),
                reach: settings.reach(leg, &bends[side]),
                dt_secs,
                at_once,
                after: &after,
            }
        });
        state.foresee(footing, &moments, going.velocity.length());
        let targets = [0, 1].map(|side| state.feet[side].step(&footing.feet[side], ground, &moments[side]));
        let around = hips::around(&world_from_figure, sample, &targets);
        let reach = hips::Reach { footing, settings, world_from_figure: &world_from_figure, bends: &bends };
        drop = reach.drop(flat_hips, around.height, &targets, &mut state.drop, dt_secs, at_once);
        sample.hips.y += around.height + drop;
        let lean = settings.lean.clamp(0.0, 1.0) * around.ahead_degrees.clamp(-30.0, 30.0);
        state.lean.follow(lean, 3.0, dt_secs, at_once);
        footing.lean(state.lean.value, sample);
        let placed_hips = footing.hips(sample);
        let held = [0, 1].map(|side| {
            let grip = foot::Grip { footing, side, settings, world_from_figure: &world_from_figure };
            let foot = &mut state.feet[side];
            foot.haste.see(&turns[side], dt_secs);
            grip.hold(placed_hips, &targets[side], &bends[side], foot, dt_secs, sample)
        });
        // Hips don't go down faster than the legs below them fold.
        let up = hips::held_up(&targets, &held).min(-drop);
        state.drop.value += up;
        sample.hips.y += up;
        drop += up;
        for side in 0..2 {
            let grip = foot::Grip { footing, side, settings, world_from_figure: &world_from_figure };
            frames[side] = held[side].frame;
            frames[side].position.y += up;
            soles[side] = grip.lies(frames[side], &targets[side]);
            let (toes, times) = (&mut state.feet[side].toes, settings.haste.max(1.0));
            toes::bend(footing, side, ground, frames[side], &targets[side], toes, times, dt_secs, sample);
        }
        state.begun = true;
    }
    for side in 0..2 {
        let seen = Seen { flat: flat[side], drop, foot: frames[side], sole_is_down: soles[side] };
        view(footing, side, ground, sample, &seen, &mut views[side]);
    }
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

/// What a view tells besides the sample.
struct Seen {
    flat: Frame,
    drop: f64,
    foot: Frame,
    sole_is_down: bool,
}

/// From here on a part of the sole counts as standing.
const STANDS: f64 = 0.95;

fn view(footing: &Footing, side: usize, ground: &Ground, sample: &Sample, seen: &Seen, view: &mut FootView) {
    let leg = &footing.legs.sides[side];
    let foot = seen.foot;
    let toes = footing.feet[side].toes_in_foot(leg, sample);
    view.sole_in_world.clear();
    view.ground_under_sole.clear();
    for at in footing.feet[side].sole_at(foot, toes) {
        view.sole_in_world.push(at);
        view.ground_under_sole.push(ground.height(at.x, at.z));
    }
    let bearing = sample.bearing[side];
    view.stance = bearing.heel >= STANDS && bearing.ball >= STANDS && seen.sole_is_down;
    view.animated_ankle_in_world = seen.flat.position;
    view.ankle_in_world = foot.position;
    view.hips_drop = seen.drop;
}
