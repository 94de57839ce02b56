//! How far a limb reaches, and why a contact is missed.

use glam::DVec3;
use kin::Interval;

use crate::{Figure, Frames, Limb, LimbView, Pose};

/// A miss smaller than this is none, metres.
const MET_M: f64 = 0.0005;

/// The shell in which a limb can hold its articulator, the end's and the forearm's angles staying as they are.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct ReachLimits {
    /// The root joint, metres, world: the middle of both spheres.
    pub root_in_world: DVec3,
    /// From the root to the articulator with the hinge folded as far as it goes, metres.
    pub inner_m: f64,
    /// The same with the limb as straight as it goes.
    pub outer_m: f64,
}

/// A contact that is not met.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Miss {
    /// From articulator to target, metres.
    pub by_m: f64,
    /// What is in the way.
    pub why: Why,
}

/// What keeps a limb from its target.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub enum Why {
    /// The target is beyond the outer limit.
    TooFar,
    /// The target is inside the inner limit.
    TooNear,
    /// The target is between the limits, but the root joint's range does not let the limb point there.
    Range,
}

impl ReachLimits {
    /// How far a point of the world is outside the shell, metres; 0 inside it.
    pub fn gap_m(&self, point_in_world: DVec3) -> f64 {
        Interval::new(self.inner_m, self.outer_m).excess(self.root_in_world.distance(point_in_world))
    }

    /// Why a limb misses its target; `None` if it is met within half a millimetre. Where both reach and range are in
    /// the way, the one that takes more of the miss is named.
    pub fn miss(&self, view: &LimbView) -> Option<Miss> {
        let by_m = view.residual;
        if by_m.is_nan() || by_m <= MET_M {
            return None;
        }
        let why = if self.gap_m(view.target) < 0.5 * by_m {
            Why::Range
        } else if self.root_in_world.distance(view.target) > self.outer_m {
            Why::TooFar
        } else {
            Why::TooNear
        };
        Some(Miss { by_m, why })
    }
}

/// The limits of a limb in a pose; `frames` are the pose's. With `ranges` the hinge stays in its range, which
/// stretches to hold the present angle. `None` for a limb that can't reach.
pub fn reach_limits(
    figure: &Figure,
    pose: &Pose,
    frames: &Frames,
    limb: Limb,
    ranges: bool,
) -> Option<ReachLimits> {
    let rig = figure.limbs.get(limb)?;
    let at = figure.articulator(pose, limb);
    let in_hinge = rig.in_hinge(figure, pose, at.bone, at.at);
    let hinge =
        if ranges { rig.ranges.hinge.reaching(rig.state(figure, pose).hinge) } else { Interval::FREE };
    let (inner_m, outer_m) = rig.kin.reach_in(in_hinge, hinge);
    Some(ReachLimits { root_in_world: frames[limb.parts().root].position, inner_m, outer_m })
}
