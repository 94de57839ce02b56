//! How a share passes from one bone to the next across a joint: tight outside the bend, as wide as it must be inside.
//!
//! Skin at a distance r from the hinge's axis, on the side that closes, keeps its order along the limb only while the
//! share grows more slowly than 1 / (r * angle) a metre: beyond that it folds over itself.

use glam::DVec3;

use super::blend::soft_max;

/// Part of the ramp's length at either end over which it bends.
const ROUND: f64 = 0.2;
/// Half a ramp's length over the least that keeps the order: blended turns run faster in the middle than at their ends,
/// and something of the skin must be left.
const ROOM: f64 = 0.5 / (1.0 - ROUND) * 1.25;

/// 0 below -1, 1 above 1; straight in between but for its rounded ends, so that it is nowhere steeper than it must be.
pub fn ramp(x: f64) -> f64 {
    let t = (0.5 * (x + 1.0)).clamp(0.0, 1.0);
    let rising = |t: f64| if t < ROUND { t * t / (2.0 * ROUND) } else { t - 0.5 * ROUND };
    if t < 0.5 { rising(t) / (1.0 - ROUND) } else { 1.0 - rising(1.0 - t) / (1.0 - ROUND) }
}

/// A joint as weights see it.
pub struct Bend<'a> {
    /// Directions of the sides that close, and how far, radians.
    pub closes: &'a [(DVec3, f64)],
    /// Half the ramp's length where nothing closes, metres.
    pub least: f64,
    /// Half the ramp's length at most.
    pub most: f64,
}

impl Bend<'_> {
    /// Half the ramp's length at a place seen from the joint.
    pub fn reach(&self, from_joint: DVec3) -> f64 {
        let squeeze = |(side, angle): &(DVec3, f64)| (from_joint.dot(*side).max(0.0) * angle).powi(2);
        let closes = self.closes.iter().map(squeeze).sum::<f64>().sqrt();
        soft_max(self.least, ROOM * closes, 0.5 * self.least).min(self.most)
    }

    /// The share of the bone beyond the joint: `along` is how far beyond the joint, metres.
    pub fn share(&self, from_joint: DVec3, along: f64) -> f64 {
        ramp(along / self.reach(from_joint))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ramp_rises_from_0_to_1_without_corners_and_mirrors_itself() {
        assert_eq!((ramp(-1.0), ramp(0.0), ramp(1.0)), (0.0, 0.5, 1.0));
        let slope = |x: f64| (ramp(x + 1e-6) - ramp(x - 1e-6)) / 2e-6;
        for i in -120..120 {
            let x = f64::from(i) / 100.0;
            assert!((ramp(x) + ramp(-x) - 1.0).abs() < 1e-12);
            assert!(slope(x) >= 0.0 && slope(x) < 0.63, "{x}");
            assert!((slope(x + 0.01) - slope(x)).abs() < 0.04, "{x}");
        }
    }

    #[test]
    fn inside_a_bend_the_skin_keeps_its_order() {
        let closes = [(DVec3::Z, 2.6)];
        let bend = Bend { closes: &closes, least: 0.02, most: 0.2 };
        for i in -100..100 {
            let at = |x: f64| {
                let from_joint = DVec3::new(x, 0.0, 0.035);
                let turn = bend.share(from_joint, x) * 2.6;
                glam::DQuat::from_rotation_y(-turn) * from_joint
            };
            let x = f64::from(i) / 1000.0;
            let turned =
                glam::DQuat::from_rotation_y(-bend.share(DVec3::new(x, 0.0, 0.035), x) * 2.6) * DVec3::X;
            assert!((at(x + 1e-6) - at(x)).dot(turned) > 0.0, "{x}");
        }
    }
}
