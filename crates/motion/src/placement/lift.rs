//! Feet that a blend puts below flat ground: the legs' angles blend, so feet are not quite where a blend of feet would be.

use glam::DVec3;

use super::Footing;
use crate::{FootGoal, Sample};

/// Feet so little below the ground are left, metres: clips themselves have them there.
const SINKS_M: f64 = 0.001;

/// Raises feet that are more than a millimetre below flat ground at height 0 until their lowest point is so; knees keep their side and ranges are
/// kept. Feet above stay as they are, bit for bit. Never allocates.
pub fn lift_feet(footing: &Footing, sample: &mut Sample) {
    let hips = footing.hips(sample);
    for (leg, foot) in footing.legs.sides.iter().zip(&footing.feet) {
        let ankle = leg.ankle_and_foot(hips, &sample.angles);
        let toes = ankle.then(foot.toes_in_foot(leg, sample));
        // Only heights are asked for: how a frame's own axes rise.
        let rises = [ankle, toes].map(|frame| (frame.position.y, frame.rotation.conjugate() * DVec3::Y));
        let height = |(point, on_toes): &(DVec3, bool)| {
            let (height, rise) = rises[usize::from(*on_toes)];
            height + rise.dot(*point)
        };
        let lowest = foot.points.iter().map(height).fold(f64::INFINITY, f64::min);
        if lowest < -SINKS_M {
            let bend = leg.bend(&sample.angles);
            let goal = FootGoal { ankle: ankle.position - DVec3::Y * (lowest + SINKS_M), rotation: ankle.rotation };
            leg.solve(hips, &goal, &bend, 0.0, &mut sample.angles);
        }
    }
}
