//! Sums of samples. Angles and the hips' place blend linearly.

use glam::DVec3;
use rig::{Angles, Bone};

use crate::{Bearing, Sample};

/// A sample to write into.
pub(super) fn blank() -> Sample {
    Sample { hips: DVec3::ZERO, angles: [Angles::REST; Bone::COUNT], bearing: [Bearing::default(); 2] }
}

/// `out` times a weight, and how the feet bear times another.
pub(super) fn scale(out: &mut Sample, weight: f64, bearing_weight: f64) {
    out.hips *= weight;
    for angles in &mut out.angles {
        angles.flexion *= weight;
        angles.abduction *= weight;
        angles.twist *= weight;
    }
    for bearing in &mut out.bearing {
        bearing.heel *= bearing_weight;
        bearing.ball *= bearing_weight;
    }
}

/// `out` and another sample times a weight, and how its feet bear times another.
pub(super) fn add(out: &mut Sample, weight: f64, bearing_weight: f64, other: &Sample) {
    out.hips += other.hips * weight;
    add_angles(out, weight, other);
    for (out, other) in out.bearing.iter_mut().zip(&other.bearing) {
        out.heel += other.heel * bearing_weight;
        out.ball += other.ball * bearing_weight;
    }
}

/// The same for the angles alone.
pub(super) fn add_angles(out: &mut Sample, weight: f64, other: &Sample) {
    for (out, other) in out.angles.iter_mut().zip(&other.angles) {
        out.flexion += other.flexion * weight;
        out.abduction += other.abduction * weight;
        out.twist += other.twist * weight;
    }
}

/// Some bones go toward another sample; with amount 1 they have its bits. A foot bears as the sample that its
/// bone is of.
pub(super) fn mask(out: &mut Sample, bones: &[bool; Bone::COUNT], amount: f64, layer: &Sample) {
    let toward = |from: f64, to: f64| if amount == 1.0 { to } else { from + (to - from) * amount };
    let masked = out.angles.iter_mut().zip(&layer.angles).zip(bones).filter(|(_, has)| **has);
    for ((out, layer), _) in masked {
        out.flexion = toward(out.flexion, layer.flexion);
        out.abduction = toward(out.abduction, layer.abduction);
        out.twist = toward(out.twist, layer.twist);
    }
    for (foot, bone) in [Bone::LeftFoot, Bone::RightFoot].into_iter().enumerate() {
        if bones[bone.index()] {
            let (out, layer) = (&mut out.bearing[foot], layer.bearing[foot]);
            out.heel = toward(out.heel, layer.heel);
            out.ball = toward(out.ball, layer.ball);
        }
    }
}

/// The mirror image: twins change sides with their angles, middle joints bend and turn to the other side.
pub(super) fn mirror(out: &mut Sample, twins: &[u8; Bone::COUNT]) {
    out.hips.x = 0.0 - out.hips.x;
    out.bearing.swap(0, 1);
    for (bone, twin) in twins.iter().map(|twin| usize::from(*twin)).enumerate() {
        if bone < twin {
            out.angles.swap(bone, twin);
        } else if bone == twin {
            let angles = &mut out.angles[bone];
            angles.abduction = 0.0 - angles.abduction;
            angles.twist = 0.0 - angles.twist;
        }
    }
}
