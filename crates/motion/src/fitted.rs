//! A clip made ready for one figure: scaled to its legs, sampled densely, feet on the ground.

use glam::DQuat;
use rig::{Angles, Articulation, Bone, Figure, Place};

use crate::bearing::fill_bearing;
use crate::refit::{Standing, refit};
use crate::track::{place_from, wrapped};
use crate::{Clip, Sample, Travel};

/// Samples a second.
const RATE: f64 = 120.0;
/// Root motion that is as near as this to steady is taken for it, metres and degrees.
const STEADY: f64 = 1e-9;

/// Why a clip can't be played by a figure.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum FitError {
    /// The figure has no leg to stand on.
    #[error(
        "the figure \"{figure}\" lacks a leg of hip, knee and foot, so the clip \"{clip}\" can't be fitted to it"
    )]
    NoLegs {
        /// The figure's name.
        figure: String,
        /// The clip's.
        clip: String,
    },
}

/// A clip made ready for one figure.
#[derive(Clone, PartialEq, Debug)]
pub struct FittedClip {
    name: String,
    length_secs: f64,
    loops: bool,
    stride: bool,
    pace: f64,
    travel: Travel,
    /// At equal times from phase 0; in a loop without the one at phase 1.
    samples: Vec<Sample>,
}

impl FittedClip {
    /// Fits a clip that was made with one figure (the same, if it is its own) to another.
    ///
    /// Lengths follow the height of the hip joints, times its root (Froude), so that longer legs make longer and slower
    /// steps. Feet keep their turn, their balls' way and the lowest point's height; the hips go lower where a leg would not
    /// reach; angles stop at the figure's ranges. Root motion becomes a steady [`Travel`], and what it deviates from that goes
    /// into the hips. With the figure that it was made with, nothing but that is changed.
    ///
    /// # Errors
    /// A figure without legs.
    pub fn new(clip: &Clip, made_with: &Figure, figure: &Figure) -> Result<FittedClip, FitError> {
        let standing = |of: &Figure| FitError::NoLegs { figure: of.name.clone(), clip: clip.name.clone() };
        let from = Standing::of(made_with).ok_or_else(|| standing(made_with))?;
        let to = Standing::of(figure).ok_or_else(|| standing(figure))?;
        let pace = (to.leg_height_m / from.leg_height_m).sqrt();
        let length_secs = clip.length_secs * pace;
        let steps = (length_secs * RATE).round().max(2.0);
        let mut samples = samples(clip, made_with, steps);
        let step_secs = length_secs / steps;
        if made_with.skeleton != figure.skeleton {
            refit(&mut samples, &from, &to, clip.loops, step_secs);
        }
        let mut travel = clip.travel();
        travel.velocity *= pace;
        travel.turn_rate /= pace;
        fill_bearing(&mut samples, &to, clip.loops, step_secs, |i| travel.place_after(i as f64 * step_secs));
        Ok(FittedClip {
            name: clip.name.clone(),
            length_secs,
            loops: clip.loops,
            stride: clip.stride,
            pace,
            travel,
            samples,
        })
    }

    /// The clip's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Seconds at its own pace, for this figure.
    pub fn length_secs(&self) -> f64 {
        self.length_secs
    }

    /// How often it is played a second at its own pace: for a stride, strides a second.
    pub fn frequency(&self) -> f64 {
        1.0 / self.length_secs
    }

    /// Whether the end goes over into the start.
    pub fn loops(&self) -> bool {
        self.loops
    }

    /// Whether one length is one stride from left heel contact.
    pub fn is_stride(&self) -> bool {
        self.stride
    }

    /// The steady travel at its own pace, for this figure.
    pub fn travel(&self) -> Travel {
        self.travel
    }

    /// The ratio of the figure's speeds to those of the figure that the clip was made with: the square root of their legs'.
    pub fn pace(&self) -> f64 {
        self.pace
    }

    /// The figure at a phase, 0 the start and 1 the end; loops go on beyond, others stay at their ends. A phase that is not
    /// finite counts as 0. Straight between samples; never allocates.
    pub fn sample(&self, phase: f64, out: &mut Sample) {
        let phase = if phase.is_finite() { phase } else { 0.0 };
        let count = self.samples.len();
        let (steps, phase) =
            if self.loops { (count, wrapped(phase, 1.0)) } else { (count - 1, phase.clamp(0.0, 1.0)) };
        let at = phase * steps as f64;
        let nearest = at.round();
        // A phase that was meant to be a sample's has its bits.
        if (at - nearest).abs() < 1e-9 {
            out.clone_from(&self.samples[nearest as usize % count]);
            return;
        }
        let before = at.floor();
        let next = (before as usize + 1) % count;
        out.set_between(&self.samples[before as usize % count], &self.samples[next], at - before);
    }
}

/// Samples of a clip with the figure that it was made with, at equal times.
fn samples(clip: &Clip, figure: &Figure, steps: f64) -> Vec<Sample> {
    let travel = clip.travel();
    let count = steps as usize + usize::from(!clip.loops);
    let sample = |i: usize| {
        let secs = clip.length_secs * (i as f64 / steps);
        let mut sample = Sample::at_rest(figure);
        clip.sample(figure, secs, &mut sample);
        steady(figure, travel.place_after(secs), clip.root_at(secs), &mut sample);
        sample
    };
    (0..count).map(sample).collect()
}

/// Puts into the hips by how much the root is off its steady way.
fn steady(figure: &Figure, steady: Place, root: Place, sample: &mut Sample) {
    let off = place_from(steady, root);
    if off.position.abs().max_element() < STEADY && off.turn.abs() < STEADY {
        return;
    }
    sample.hips = off.world_from_figure().point(sample.hips);
    let joint = figure.skeleton.joint(Bone::Hips);
    let hips = &mut sample.angles[Bone::Hips.index()];
    if let Some((joint, Articulation::Ball { ball, .. })) = joint.map(|j| (j, &j.articulation)) {
        let turned = DQuat::from_rotation_y(off.turn.to_radians()) * joint.rotation(*hips);
        let [flexion, abduction, twist] = ball.angles(turned).map(f64::to_degrees);
        *hips = Angles { flexion, abduction, twist };
    }
}
