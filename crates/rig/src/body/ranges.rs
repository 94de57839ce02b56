//! Ranges of joints widened or narrowed about the rest.

use glam::DQuat;
use kin::{Cone, Interval};

use crate::{Articulation, Bone, Joint, Limb, Part};

/// The share of a flexibility that elbows, knees, forearms and wrists take.
const OF_HINGES: f64 = 0.25;

/// Widens the ranges of a joint by a factor, or narrows them, about where it rests: each end comes to its angle times
/// the factor, at most 180 degrees. A cone goes with its axis toward the bone at rest, so that every border does.
///
/// Elbows, knees, forearms and wrists take a quarter of it, as they lose little with age. Fingers, eyes and jaw keep
/// theirs: handshapes and faces are as before.
pub(super) fn widen(joint: &mut Joint, factor: f64) {
    let limb = Limb::of(joint.bone).map(Limb::parts);
    let factor = match limb {
        Some(parts)
            if joint.bone == parts.hinge || matches!(joint.bone, Bone::LeftHand | Bone::RightHand) =>
        {
            1.0 + (factor - 1.0) * OF_HINGES
        }
        _ => factor,
    };
    let fine = matches!(joint.bone.part(), Part::LeftHand | Part::RightHand);
    if fine || matches!(joint.bone, Bone::Jaw | Bone::LeftEye | Bone::RightEye) || factor == 1.0 {
        return;
    }
    let rest = joint.bone_direction();
    match &mut joint.articulation {
        Articulation::Hinges(hinges) => hinges.iter_mut().for_each(|h| h.range = widened(h.range, factor)),
        Articulation::Ball { ranges, cone, .. } => {
            ranges.iter_mut().for_each(|range| *range = widened(*range, factor));
            if let (Some(cone), Some(rest)) = (cone, rest) {
                let turn = DQuat::from_rotation_arc(rest, cone.axis).to_scaled_axis() * factor;
                *cone = Cone {
                    axis: DQuat::from_scaled_axis(turn) * rest,
                    half_angle: (cone.half_angle * factor).min(std::f64::consts::PI),
                };
            }
        }
    }
}

/// What is endless stays so.
fn widened(range: Interval, factor: f64) -> Interval {
    let end = |degrees: f64| {
        if degrees.is_finite() && degrees.abs() < 180.0 {
            (degrees * factor).clamp(-180.0, 180.0)
        } else {
            degrees
        }
    };
    Interval { min: end(range.min), max: end(range.max) }
}
