//! The hips over uneven ground: up and down with it, and down by the least that lets both legs reach.

use glam::{DVec2, DVec3};
use rig::Frame;

use super::PlacementSettings;
use super::fade::Fade;
use super::foot::Target;
use super::footing::Footing;
use crate::{Bend, Sample};

/// How quickly the hips go down for a leg, 1/s.
const DROPS: f64 = 14.0;

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
    let at = DVec2::new(hips.x, hips.z);
    let ahead = world_from_figure.rotation * DVec3::Z;
    let (mut height, mut rise, mut sum) = (0.0, 0.0, 0.0);
    for target in targets {
        let weight = (0.2 + target.plane.at.distance(at)).powi(-2);
        height += weight * target.plane.height_at(at);
        rise += weight * target.plane.gradient.dot(DVec2::new(ahead.x, ahead.z));
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
            let ankle = figure_from_world.point(targets[side].frame.position);
            let softness = self.settings.softness.clamp(0.0, 0.2) * leg.full_reach();
            let reach = (leg.full_reach() - softness).max(self.bends[side].distance);
            let away = DVec2::new(hip.x - ankle.x, hip.z - ankle.z).length_squared();
            let highest = ankle.y + (reach * reach - away).max(0.0).sqrt();
            highest - hip.y - around
        });
        let need = needs[0].min(needs[1]).min(0.0);
        state.follow(need, DROPS, dt_secs, at_once);
        state.value.min(0.0)
    }
}
