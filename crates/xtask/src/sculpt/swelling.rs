//! How much a limb swells or shrinks in a pose, and what would undo it: legs that spread draw a web of skin between them,
//! a raised arm draws skin from its pit, and triangles alone ask for no more than to stay upright.

use glam::DVec3;
use rig::{Bone, Mesh, Palette, Skeleton};

use super::least_change::Row;
use super::pinch::Pinches;
use super::slice::Slice;
use super::trials::Trial;

const ARM: (Bone, Bone) = (Bone::LeftUpperArm, Bone::LeftLowerArm);
const THIGH: (Bone, Bone) = (Bone::LeftUpperLeg, Bone::LeftLowerLeg);
/// Skin nearer to the middle plane than this is the web's between the thighs, metres. What lies farther out doesn't swell,
/// and is not to make up for what does.
const WEB_M: f32 = 0.070;
/// Where slices start, as fractions of the way between two joints, how much each may swell or shrink, and how far from the
/// middle plane the skin lies that is to make up for it. Less right below the crotch can be had, too, but only by weights
/// that dent the thigh elsewhere in return.
const BOUNDS: [((Bone, Bone), f64, f64, f32); 3] =
    [(ARM, 0.15, 0.07, f32::MAX), (THIGH, 0.28, 0.20, WEB_M), (THIGH, 0.346, 0.07, WEB_M)];
/// The part of what is too much that one round asks back.
const AT_ONCE: f64 = 0.5;

struct Bounded {
    bone: Bone,
    slice: Slice,
    /// Cubic metres.
    at_rest: f64,
    bound: f64,
    /// Skin farther out is left alone, metres from the middle plane.
    within: f32,
}

/// The slices of a half mesh's limbs.
pub struct Swellings(Vec<Bounded>);

/// A slice that is too thick or too thin in a pose.
pub struct Swelling {
    slice: usize,
    /// The pose, by its place among the trials.
    pub pose: usize,
    /// How far beyond the bound, over the volume at rest.
    pub excess: f64,
}

impl Swellings {
    /// Of a half mesh at rest.
    pub fn new(mesh: &Mesh, skeleton: &Skeleton) -> Swellings {
        let at = |v: u32| DVec3::from(mesh.positions[v as usize].map(f64::from));
        let bounded = |(segment, start, bound, within): ((Bone, Bone), f64, f64, f32)| {
            let slice = Slice::new(mesh, skeleton, segment, start);
            Bounded { bone: segment.0, at_rest: slice.volume(at), slice, bound, within }
        };
        // A preview of one part may lack them.
        Swellings(BOUNDS.map(bounded).into_iter().filter(|own| own.at_rest > 0.0).collect())
    }

    /// What is beyond the bounds in the poses that are named for the limb's bone.
    pub fn find(&self, pinches: &Pinches<'_>, mesh: &Mesh, trials: &[Trial]) -> Vec<Swelling> {
        let mut all = Vec::new();
        for (pose, trial) in trials.iter().enumerate() {
            let moved = |own: &Bounded| trial.name.starts_with(own.bone.name());
            if !self.0.iter().any(moved) {
                continue;
            }
            let posed = pinches.posed(mesh, &trial.palette);
            for (slice, own) in self.0.iter().enumerate().filter(|(_, own)| moved(own)) {
                let part = own.slice.volume(|v| posed[v as usize]) / own.at_rest - 1.0;
                let excess = part - part.clamp(-own.bound, own.bound);
                if excess != 0.0 {
                    all.push(Swelling { slice, pose, excess });
                }
            }
        }
        all
    }

    /// What one of them asks of the shares; `bones` tells which bones a vertex may follow.
    pub fn row(
        &self,
        swelling: &Swelling,
        pinches: &Pinches<'_>,
        mesh: &Mesh,
        palette: &Palette,
        bones: impl Fn(usize) -> Vec<Bone>,
    ) -> Row {
        let own = &self.0[swelling.slice];
        let posed = pinches.posed(mesh, palette);
        let mut pulls = own.slice.gradient(|v| posed[v as usize]);
        pulls.retain(|pull| mesh.positions[pull.0 as usize][0] < own.within);
        let slopes = pinches.drifts(mesh, palette, &pulls, bones);
        let length = slopes.iter().map(|s| s.2 * s.2).sum::<f64>().sqrt().max(1e-12);
        let short = -AT_ONCE * swelling.excess * own.at_rest / length;
        let parts = slopes.into_iter().map(|(v, bone, slope)| (v, bone, slope / length)).collect();
        Row { parts, short }
    }
}
