//! A still pose on the ground.

use rig::Pose;

use super::fade::smooth;
use super::{FeetState, Footing, Placement, PlacementSettings, lift_feet};
use crate::{Bearing, Ground, Sample, Sole};

/// Up to here above the lower sole a part of a foot bears wholly, from there on not at all, metres.
const BEARS_M: (f64, f64) = (0.01, 0.06);

/// Rounds in which feet come up to the level; a foot that an ankle tilts is lower than it was to be.
const LIFTS: usize = 5;

/// Puts the feet of a posed figure on the ground: feet near the level at height 0 or below it lie on it as they do on that
/// level, raised ones are as high above it; hips go along, down as far as both legs need. Contacts of limbs are left as they are.
pub fn stand(footing: &Footing, ground: &Ground, pose: &Pose) -> Pose {
    let mut sample = Sample { hips: pose.hips, angles: pose.angles, bearing: Default::default() };
    // Hips that are too low for the legs bend them; where ankles don't bend so far, heels come up.
    for _ in 0..LIFTS {
        lift_feet(footing, &mut sample);
    }
    let hips = footing.hips(&sample);
    for side in 0..2 {
        let foot = footing.legs.sides[side].ankle_and_foot(hips, &sample.angles);
        let height = |from: usize| {
            let points = footing.feet[side].points[from..from + 3].iter();
            points.filter(|(_, toes)| !toes).map(|(p, _)| foot.point(*p).y).fold(f64::INFINITY, f64::min)
        };
        let bears = |height: f64| 1.0 - smooth(height, BEARS_M.0, BEARS_M.1);
        sample.bearing[side] = Bearing { heel: bears(height(Sole::HEEL)), ball: bears(height(Sole::BALL)) };
    }
    let settings = PlacementSettings::default();
    let placement = Placement { footing, ground, settings: &settings };
    placement.step(&pose.place, &mut sample, &mut FeetState::default(), 0.0);
    Pose { hips: sample.hips, angles: sample.angles, ..pose.clone() }
}
