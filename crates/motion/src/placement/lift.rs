//! Feet that a blend puts below flat ground: the legs' angles blend, so feet are not quite where a blend of feet would be.

use glam::{DQuat, DVec3};

use super::Footing;
use crate::{FootGoal, Sample};

/// Feet so little below the ground are left, metres: clips themselves have them there.
const SINKS_M: f64 = 0.0005;

/// Raises feet that are more than half a millimetre below flat ground at height 0 until their lowest point is so; knees keep their side and ranges are
/// kept. Feet above stay as they are, bit for bit. Never allocates.
///
/// Returns the turns of hip, knee and ankle, left and right.
pub fn lift_feet(footing: &Footing, sample: &mut Sample) -> [[DQuat; 3]; 2] {
    let hips = footing.hips(sample);
    let mut turns = footing.turns(sample);
    for ((leg, foot), turns) in footing.legs.sides.iter().zip(&footing.feet).zip(&mut turns) {
        let ankle = leg.foot_held_by(hips, turns);
        let toes = ankle.then(foot.toes_in_foot(leg, sample));
        // Only heights are asked for: how a frame's own axes rise.
        let rises = [ankle, toes].map(|frame| (frame.position.y, frame.rotation.conjugate() * DVec3::Y));
        let height = |(point, on_toes): &(DVec3, bool)| {
            let (height, rise) = rises[usize::from(*on_toes)];
            height + rise.dot(*point)
        };
        let lowest = foot.points.iter().map(height).fold(f64::INFINITY, f64::min);
        if lowest < -SINKS_M {
            let bend = leg.bend_of(turns[0], &sample.angles);
            let goal =
                FootGoal { ankle: ankle.position - DVec3::Y * (lowest + SINKS_M), rotation: ankle.rotation };
            *turns = leg.bent_to(hips, &goal, &bend, 0.0, &mut sample.angles).turns;
        }
    }
    turns
}
