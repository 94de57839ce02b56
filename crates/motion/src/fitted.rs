//! A clip made ready for one figure: scaled to its legs, sampled densely, feet on the ground.

use rig::Figure;

use crate::{Clip, Sample, Travel};

/// Why a clip can't be played by a figure.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum FitError {
    /// The figure has no leg to stand on.
    #[error("the figure \"{figure}\" lacks a leg of hip, knee and foot, so the clip \"{clip}\" can't be fitted to it")]
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
    samples: Vec<Sample>,
}

impl FittedClip {
    /// Fits a clip that was made with one figure (the same, if it is its own) to another.
    ///
    /// # Errors
    /// A figure without legs.
    pub fn new(clip: &Clip, _made_with: &Figure, figure: &Figure) -> Result<FittedClip, FitError> {
        let rest = figure.rest_pose();
        let sample = Sample { hips: rest.hips, angles: rest.angles, bearing: Default::default() };
        Ok(FittedClip {
            name: clip.name.clone(),
            length_secs: clip.length_secs,
            loops: clip.loops,
            stride: clip.stride,
            samples: vec![sample],
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

    /// Whether the end goes over into the start.
    pub fn loops(&self) -> bool {
        self.loops
    }

    /// Whether one length is one stride from left heel contact.
    pub fn is_stride(&self) -> bool {
        self.stride
    }

    /// The mean travel at its own pace, for this figure.
    pub fn travel(&self) -> Travel {
        Travel::default()
    }

    /// The ratio of the figure's speeds to those of the figure that the clip was made with: the square root of their legs'.
    pub fn pace(&self) -> f64 {
        1.0
    }

    /// The figure at a phase, 0 the start and 1 the end; loops go on beyond, others stay at their ends.
    pub fn sample(&self, _phase: f64, out: &mut Sample) {
        out.clone_from(&self.samples[0]);
    }
}
