//! The hips over uneven ground: up and down with it, and down by the least that lets both legs reach.

use glam::{DVec2, DVec3};
use rig::Frame;

use super::PlacementSettings;
use super::fade::{Fade, smooth};
use super::foot::{Held, Target};
use super::footing::Footing;
use super::landing::Coming;
use super::plane::Plane;
use crate::{Bend, Sample};

/// How quickly the hips go down for a leg, and come up again, 1/s.
const DROPS: f64 = 18.0;
const COMES_BACK: f64 = 10.0;

/// How far before a leg is stretched the hips begin to go down on uneven ground, metres.
const EASED_M: f64 = 0.05;
/// By how much the heel of a foot that rolls off rises before the hips go down for it, radians.
const MAY_RISE: f64 = 0.25;
/// Feet that are less in the ground let hips go down as they do, and the most that hips come up for them in one step, metres.
const SUNK_M: f64 = 0.003;
const MOST_UP_M: f64 = 0.05;
/// A foot reaches farthest a little before it lands: what its landing needs, times this, is enough for that, too.
const BEFORE_LANDING: f64 = 1.4;

/// The ground around the hips.
pub(super) struct Around {
    /// Its height under them, metres.
    pub height: f64,
    /// Its rise ahead, degrees.
    pub ahead_degrees: f64,
}

/// The ground around the hips, as the planes of both feet have it: the nearer foot counts more.
pub(super) fn around(world_from_figure: &Frame, sample: &Sample, targets: &[Target; 2]) -> Around {
    let hips = world_from_figure.point(sample.hips);
    let ahead = world_from_figure.rotation * DVec3::Z;
    let (hips, ahead) = (DVec2::new(hips.x, hips.z), DVec2::new(ahead.x, ahead.z));
    let around = between(hips, ahead, targets.map(|target| target.plane));
    // Over steps hips go evenly from place to place: that which the swinging foot left, where the other stands, and
    // where it will come down.
    let swings = [0, 1].map(|side| targets[side].coming.filter(|coming| coming.over_steps));
    match swings {
        [Some(coming), None] => Around { height: passing(hips, &coming, targets[1].plane), ..around },
        [None, Some(coming)] => Around { height: passing(hips, &coming, targets[0].plane), ..around },
        [None, None] if targets[0].on_steps && targets[1].on_steps => {
            Around { height: along(hips, targets[0].plane, targets[1].plane).0, ..around }
        }
        _ => around,
    }
}

/// The height over a place between where a foot was, where the other stands, and where it will be.
fn passing(at: DVec2, coming: &Coming, stands: Plane) -> f64 {
    let (before, share) = along(at, coming.from, stands);
    if share < 1.0 { before } else { along(at, stands, coming.plane).0 }
}

/// The height over a place on the way from one plane's place to another's, and the share of the way, 0 to 1.
fn along(at: DVec2, from: Plane, to: Plane) -> (f64, f64) {
    let way = to.at - from.at;
    let share = ((at - from.at).dot(way) / way.length_squared().max(0.01)).clamp(0.0, 1.0);
    (from.height + share * (to.height - from.height), share)
}

fn between(at: DVec2, ahead: DVec2, planes: [Plane; 2]) -> Around {
    let (mut height, mut rise, mut sum) = (0.0, 0.0, 0.0);
    for plane in planes {
        let weight = (0.2 + plane.at.distance(at)).powi(-2);
        height += weight * plane.height_at(at);
        rise += weight * plane.gradient.dot(ahead);
        sum += weight;
    }
    Around { height: height / sum, ahead_degrees: (rise / sum).atan().to_degrees() }
}

/// What keeps legs from their feet.
pub(super) struct Reach<'a> {
    pub footing: &'a Footing,
    pub settings: &'a PlacementSettings,
    pub world_from_figure: &'a Frame,
    pub bends: &'a [Bend; 2],
}

impl Reach<'_> {
    /// How far the hips go down from the height of the ground around, metres, 0 or less. `flat_hips` is their frame over
    /// flat ground.
    pub fn drop(
        &self,
        flat_hips: Frame,
        around: f64,
        targets: &[Target; 2],
        state: &mut Fade<f64>,
        dt_secs: f64,
        at_once: bool,
    ) -> f64 {
        let figure_from_world = self.world_from_figure.inverse();
        let needs = [0, 1].map(|side| {
            let leg = &self.footing.legs.sides[side];
            let hip = leg.hip(flat_hips);
            let raised = targets[side].raised(MAY_RISE * targets[side].rolls);
            let ankle = figure_from_world.point(raised.position);
            let reach = self.settings.reach(leg, &self.bends[side]);
            let away = DVec2::new(hip.x - ankle.x, hip.z - ankle.z).length_squared();
            let highest = ankle.y + (reach * reach - away).max(0.0).sqrt();
            highest - hip.y - around
        });
        let ahead = [0, 1].map(|side| {
            let Some(coming) = targets[side].coming else { return 0.0 };
            let other = targets[1 - side].plane;
            let then = if coming.over_steps {
                along(coming.hips, other, coming.plane).0
            } else {
                between(coming.hips, DVec2::ZERO, [coming.plane, other]).height
            };
            (coming.highest - then) * BEFORE_LANDING * smooth(coming.progress, 0.0, 0.65)
        });
        let now = eased(needs[0].min(needs[1]), EASED_M * uneven(targets));
        let before = state.value;
        let need = now.min(ahead[0]).min(ahead[1]);
        let quickness = if need < state.value { DROPS } else { COMES_BACK };
        state.follow(need, quickness, dt_secs, at_once);
        if state.value > now {
            // What legs need at once can't wait.
            let rate = if dt_secs > 0.0 { (now - before) / dt_secs } else { 0.0 };
            *state = Fade { value: now, rate: rate.min(0.0) };
        }
        state.value.min(0.0)
    }
}

/// By how much hips that went down faster than a leg folds have to come up for its foot to be out of the ground, metres;
/// half of it where the other foot stands too.
pub(super) fn held_up(targets: &[Target; 2], held: &[Held; 2]) -> f64 {
    let sunk = held[0].sunk_m.max(held[1].sunk_m) - SUNK_M;
    let both = targets[0].ball.min(targets[1].ball);
    sunk.clamp(0.0, MOST_UP_M) * (1.0 - 0.5 * both)
}

/// How uneven the ground under the feet is, 0 where it is level to 1.
fn uneven(targets: &[Target; 2]) -> f64 {
    let slope: f64 = targets.iter().map(|target| target.plane.gradient.length()).sum();
    let step = (targets[0].plane.height - targets[1].plane.height).abs();
    smooth(slope + 2.0 * step, 0.0, 0.3)
}

/// A need of less than nothing, or nothing; eased within so much of nothing.
fn eased(need: f64, within: f64) -> f64 {
    if need >= within {
        0.0
    } else if need > -within {
        -(within - need).powi(2) / (4.0 * within)
    } else {
        need
    }
}
