//! What a motion asks of a figure at a moment.

use glam::DVec3;
use rig::{Angles, Bone, Figure, Pose};

/// How firmly a foot stands, in the motion on flat ground: 0 in the air, 1 with its whole weight to take.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Bearing {
    /// The heel.
    pub heel: f64,
    /// The ball, and the toes with it.
    pub ball: f64,
}

/// A figure at a moment of a motion on flat ground: what clips give, trees blend and the feet's placement bends.
///
/// Angles blend linearly (swing vectors, twists and hinges alike), so blends of poses in range stay in range,
/// and weights of 0 and 1 give the ends bit for bit.
#[derive(Clone, PartialEq, Debug)]
pub struct Sample {
    /// The hips joint in figure space, metres; flat ground is at height 0.
    pub hips: DVec3,
    /// Degrees, by [`Bone::index`].
    pub angles: [Angles; Bone::COUNT],
    /// Left foot, right foot.
    pub bearing: [Bearing; 2],
}

impl Sample {
    /// The figure at rest, standing with both feet.
    pub fn at_rest(figure: &Figure) -> Sample {
        Sample {
            hips: figure.skeleton.rest_position(Bone::Hips),
            angles: [Angles::REST; Bone::COUNT],
            bearing: [Bearing { heel: 1.0, ball: 1.0 }; 2],
        }
    }

    /// Becomes what is straight between two samples: 0 is the first, 1 the second, both bit for bit.
    pub fn set_between(&mut self, a: &Sample, b: &Sample, share: f64) {
        if share == 1.0 {
            return self.clone_from(b);
        }
        let mix = |a: f64, b: f64| a + (b - a) * share;
        self.hips = DVec3::new(mix(a.hips.x, b.hips.x), mix(a.hips.y, b.hips.y), mix(a.hips.z, b.hips.z));
        for ((out, a), b) in self.angles.iter_mut().zip(&a.angles).zip(&b.angles) {
            out.flexion = mix(a.flexion, b.flexion);
            out.abduction = mix(a.abduction, b.abduction);
            out.twist = mix(a.twist, b.twist);
        }
        for ((out, a), b) in self.bearing.iter_mut().zip(&a.bearing).zip(&b.bearing) {
            out.heel = mix(a.heel, b.heel);
            out.ball = mix(a.ball, b.ball);
        }
    }

    /// Writes hips and angles into a pose; where the figure stands and what its limbs hold stays.
    pub fn write_to(&self, pose: &mut Pose) {
        pose.hips = self.hips;
        pose.angles = self.angles;
    }
}
