//! The size of a figure: what a pose needs to know of it to fit another.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::{Bone, Part, Skeleton};

/// Some lengths of a figure at rest, metres, to a hundredth of a millimetre; 0 where the figure lacks the bones.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Size {
    /// Height of the hips.
    pub hips: f64,
    /// Height of the ankles.
    pub ankle: f64,
    /// Hips to neck.
    pub torso: f64,
    /// Joint of the head to the eyes or, without eyes, neck to head.
    pub head: f64,
    /// Between the shoulder joints.
    pub shoulders: f64,
    /// Between the hip joints.
    pub pelvis: f64,
    /// Shoulder to elbow to wrist.
    pub arm: f64,
    /// Hip to knee to ankle.
    pub leg: f64,
    /// Wrist to the first joint of the middle finger.
    pub hand: f64,
}

/// Ratios beyond these are taken for a mistake and left alone.
const SOUND: std::ops::RangeInclusive<f64> = 0.02..=50.0;

impl Size {
    /// The size of a skeleton.
    pub fn of(skeleton: &Skeleton) -> Size {
        let at = |bone: Bone| skeleton.joint(bone).map(|_| skeleton.rest_position(bone));
        let tidy = |metres: f64| (metres * 1e5).round() / 1e5;
        let span = |a: Bone, b: Bone| at(a).zip(at(b)).map_or(0.0, |(a, b)| a.distance(b));
        let height = |bone: Bone| at(bone).map_or(0.0, |p| p.y.max(0.0));
        let eyes = span(Bone::Head, Bone::LeftEye);
        Size {
            hips: tidy(height(Bone::Hips)),
            ankle: tidy(height(Bone::LeftFoot)),
            torso: tidy(span(Bone::Hips, Bone::Neck)),
            head: tidy(if eyes > 0.0 { eyes } else { span(Bone::Neck, Bone::Head) }),
            shoulders: tidy(span(Bone::LeftUpperArm, Bone::RightUpperArm)),
            pelvis: tidy(span(Bone::LeftUpperLeg, Bone::RightUpperLeg)),
            arm: tidy(
                span(Bone::LeftUpperArm, Bone::LeftLowerArm) + span(Bone::LeftLowerArm, Bone::LeftHand),
            ),
            leg: tidy(
                span(Bone::LeftUpperLeg, Bone::LeftLowerLeg) + span(Bone::LeftLowerLeg, Bone::LeftFoot),
            ),
            hand: tidy(span(Bone::LeftHand, Bone::LeftMiddleProximal)),
        }
    }

    /// This size over another, length by length; 1 where one of them lacks it.
    pub(crate) fn over(&self, other: &Size) -> Size {
        let ratio = |a: f64, b: f64| Some(a / b).filter(|r| SOUND.contains(r)).unwrap_or(1.0);
        Size {
            hips: ratio(self.hips, other.hips),
            ankle: ratio(self.ankle, other.ankle),
            torso: ratio(self.torso, other.torso),
            head: ratio(self.head, other.head),
            shoulders: ratio(self.shoulders, other.shoulders),
            pelvis: ratio(self.pelvis, other.pelvis),
            arm: ratio(self.arm, other.arm),
            leg: ratio(self.leg, other.leg),
            hand: ratio(self.hand, other.hand),
        }
    }

    /// Whether every length is that of another to a thousandth.
    pub(crate) fn is_near(&self, other: &Size) -> bool {
        let Size { hips, ankle, torso, head, shoulders, pelvis, arm, leg, hand } = self.over(other);
        [hips, ankle, torso, head, shoulders, pelvis, arm, leg, hand]
            .into_iter()
            .all(|r| (r - 1.0).abs() <= 1e-3)
    }

    /// For ratios: what takes a point in a bone's joint frame to the same point of the other figure. Limbs are as much
    /// thicker as the trunk is longer.
    pub(crate) fn of_bone(&self, bone: Bone) -> DVec3 {
        let thick = self.torso;
        match bone {
            Bone::Hips | Bone::Spine => DVec3::new(self.pelvis, thick, thick),
            Bone::Chest | Bone::UpperChest | Bone::LeftShoulder | Bone::RightShoulder => {
                DVec3::new(self.shoulders, thick, thick)
            }
            Bone::LeftUpperArm | Bone::LeftLowerArm | Bone::RightUpperArm | Bone::RightLowerArm => {
                DVec3::new(self.arm, thick, thick)
            }
            Bone::LeftUpperLeg | Bone::LeftLowerLeg | Bone::RightUpperLeg | Bone::RightLowerLeg => {
                DVec3::new(thick, self.leg, thick)
            }
            Bone::LeftFoot | Bone::RightFoot | Bone::LeftToes | Bone::RightToes => DVec3::splat(self.ankle),
            _ if bone.part() == Part::Head => DVec3::splat(self.head),
            _ => DVec3::splat(self.hand),
        }
    }
}
