//! A still pose on the ground: what it was before its feet were brought there, so that it can be moved and stood again.

use std::collections::VecDeque;

use motion::{Footing, Ground};
use rig::{Bone, Contact, Limb, Part, Pose};

/// So many poses that stand are remembered.
const MOST: usize = 64;

/// A pose as it was over level ground, and as it stands.
#[derive(Clone, PartialEq, Debug)]
struct Standing {
    flat: Pose,
    stood: Pose,
}

/// The poses that were brought to the ground lately.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Standings(VecDeque<Standing>);

impl Standings {
    /// Whether a pose has the legs of one that was brought to the ground.
    pub fn knows(&self, pose: &Pose) -> bool {
        self.of(pose).is_some()
    }

    fn of(&self, pose: &Pose) -> Option<&Standing> {
        self.0.iter().rev().find(|standing| legs(&standing.stood).eq(legs(pose)))
    }

    /// What a pose is over level ground: one that was brought to the ground, with what has changed of it since; any other is
    /// taken as it is.
    pub fn flat(&self, pose: &Pose) -> Pose {
        let Some(Standing { flat, stood }) = self.of(pose) else { return pose.clone() };
        let mut found = Pose { hips: flat.hips + (pose.hips - stood.hips), ..pose.clone() };
        for i in 0..found.angles.len() {
            if pose.angles[i] == stood.angles[i] {
                found.angles[i] = flat.angles[i];
            }
        }
        found
    }

    /// Remembers what a pose that stands was over level ground.
    pub fn learn(&mut self, flat: Pose, stood: Pose) {
        if self.of(&stood).is_none_or(|known| known.stood != stood) {
            self.0.push_back(Standing { flat, stood });
            if self.0.len() > MOST {
                self.0.pop_front();
            }
        }
    }

    /// Brings the feet of a pose to the ground. Contacts of legs are let go, for they hold on to where feet were.
    pub fn stand(&mut self, footing: &Footing, ground: &Ground, pose: &Pose) -> Pose {
        let flat = self.flat(pose);
        let mut stood = motion::stand(footing, ground, &flat);
        for leg in [Limb::LeftLeg, Limb::RightLeg] {
            stood.limbs[leg.index()].contact = Contact::Free;
        }
        self.learn(flat, stood.clone());
        stood
    }
}

fn legs(pose: &Pose) -> impl Iterator<Item = &rig::Angles> {
    let is_leg = |bone: &Bone| matches!(bone.part(), Part::LeftLeg | Part::RightLeg);
    Bone::ALL.into_iter().filter(is_leg).map(|bone| &pose.angles[bone.index()])
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use glam::DVec3;
    use motion::Slope;

    use super::*;

    fn lowest(figure: &rig::Figure, pose: &Pose, ground: &Ground) -> f64 {
        let frames = rig::frames(figure, pose);
        let soles = motion::Soles::of(figure).unwrap();
        let points = soles.feet.iter().flat_map(|sole| sole.points(&frames));
        points.map(|p| p.y - ground.under(p.x, p.z).height).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn a_pose_that_stands_stays_and_one_that_is_moved_stands_again() {
        let figure = crate::load::figure(None).unwrap();
        let (footing, pose) = (Footing::of(&figure).unwrap(), crate::load::standing(&figure));
        let ground = Ground::Slope(Slope::new(12.0, 30.0));
        let mut standings = Standings::default();
        let stood = standings.stand(&footing, &ground, &pose);
        assert!(stood.angles != pose.angles && lowest(&figure, &stood, &ground).abs() < 0.01);
        assert_eq!(standings.stand(&footing, &ground, &stood), stood, "standing again changes nothing");
        let mut moved = stood.clone();
        moved.place.position += DVec3::new(0.3, 0.0, 1.0);
        let again = standings.stand(&footing, &ground, &moved);
        assert!(lowest(&figure, &again, &ground).abs() < 0.01, "{}", lowest(&figure, &again, &ground));
        let level = standings.stand(&footing, &Ground::Flat, &again);
        assert!((level.hips.y - pose.hips.y).abs() < 0.02, "back on level ground it is as it was");
    }

    #[test]
    fn a_pose_with_other_legs_is_taken_as_it_is() {
        let figure = crate::load::figure(None).unwrap();
        let (footing, pose) = (Footing::of(&figure).unwrap(), crate::load::standing(&figure));
        let mut standings = Standings::default();
        standings.stand(&footing, &Ground::Slope(Slope::new(12.0, 0.0)), &pose);
        let mut other = pose.clone();
        other.angles[Bone::LeftUpperLeg.index()].flexion += 5.0;
        assert!(!standings.knows(&other) && standings.flat(&other) == other);
    }
}
