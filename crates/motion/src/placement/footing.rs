//! What placement needs of a figure, made ready once.

use glam::{DQuat, DVec3};
use rig::{Angles, Bone, Dof, Figure, Frame, Joint};

use crate::{Leg, Legs, Sample, Sole, Soles};

/// What is kept in reserve of how far toes bend up, degrees.
const TOES_RESERVE: f64 = 8.0;

/// What placement needs of a figure: legs, soles, hips and spine.
#[derive(Clone, PartialEq, Debug)]
pub struct Footing {
    /// Its legs.
    pub legs: Legs,
    pub(crate) feet: [Foot; 2],
    hips: Joint,
    spine: Vec<Joint>,
}

/// A foot's sole in its own frame.
#[derive(Clone, PartialEq, Debug)]
pub(crate) struct Foot {
    /// The sole's points and whether they are fixed in the toes' frame.
    pub points: [(DVec3, bool); Sole::COUNT],
    /// The middle of the heel and of the ball, in the foot's frame.
    pub heel: DVec3,
    pub ball: DVec3,
    /// About which the foot rolls off: the toes' joint, else the ball.
    pub roll: DVec3,
    /// Where the ground is asked for, in the foot's frame with the toes at rest.
    pub print: [DVec3; 5],
    /// The whole sole's points, in the foot's frame with the toes at rest.
    pub sole: [DVec3; Sole::COUNT],
    pub(super) toes: Option<Toes>,
}

#[derive(Clone, PartialEq, Debug)]
pub(super) struct Toes {
    pub joint: Joint,
    /// The middle of the tip, in the toes' frame.
    pub tip: DVec3,
}

impl Footing {
    /// Of a figure; `None` if it lacks a leg or a foot.
    pub fn of(figure: &Figure) -> Option<Footing> {
        let (legs, soles) = (Legs::of(figure)?, Soles::of(figure)?);
        let joint = |bone: Bone| figure.skeleton.joint(bone).cloned();
        let feet = [0, 1].map(|side| Foot::of(&legs.sides[side], &soles.feet[side]));
        let spine = [Bone::Spine, Bone::Chest, Bone::UpperChest];
        Some(Footing {
            legs,
            feet,
            hips: joint(Bone::Hips)?,
            spine: spine.into_iter().filter_map(joint).collect(),
        })
    }

    /// The turns of hip, knee and ankle, left and right.
    pub fn turns(&self, sample: &Sample) -> [[DQuat; 3]; 2] {
        [0, 1].map(|side| self.legs.sides[side].turns(&sample.angles))
    }

    /// The frame of a sample's hips in figure space.
    pub fn hips(&self, sample: &Sample) -> Frame {
        Frame::new(self.hips.rotation(sample.angles[Bone::Hips.index()]), sample.hips)
    }

    /// Leans the spine forward by degrees, a share each joint, as far as ranges go.
    pub(super) fn lean(&self, degrees: f64, sample: &mut Sample) {
        let share = degrees / self.spine.len().max(1) as f64;
        for joint in &self.spine {
            let angles = &mut sample.angles[joint.bone.index()];
            if let Some(range) = joint.range(Dof::Flexion) {
                angles.flexion = range.reaching(angles.flexion).clamp(angles.flexion + share);
            }
        }
    }
}

impl Foot {
    fn of(leg: &Leg, sole: &Sole) -> Foot {
        let joint = leg.toes();
        let offset = joint.map_or(DVec3::ZERO, |toes| toes.offset);
        let points = sole.points.map(|p| (p.at, p.bone == leg.toes_bone()));
        let at_rest = |i: usize| if points[i].1 { offset + points[i].0 } else { points[i].0 };
        Foot {
            heel: at_rest(Sole::HEEL),
            ball: at_rest(Sole::BALL),
            roll: joint.map_or(at_rest(Sole::BALL), |toes| toes.offset),
            print: [Sole::HEEL + 1, Sole::HEEL + 2, Sole::BALL + 1, Sole::BALL + 2, Sole::TOES].map(at_rest),
            sole: std::array::from_fn(at_rest),
            toes: joint
                .filter(|_| points[Sole::TOES].1)
                .map(|joint| Toes { joint: joint.clone(), tip: points[Sole::TOES].0 }),
            points,
        }
    }

    /// How far the sole reaches behind the place of roll and before it, metres.
    pub fn extent(&self) -> (f64, f64) {
        (self.roll.z - self.heel.z, self.print[4].z - self.roll.z)
    }

    /// The sole's points for a frame of the foot and of the toes in it.
    pub fn sole_at(&self, foot: Frame, toes: Frame) -> [DVec3; Sole::COUNT] {
        self.points.map(|(point, on_toes)| foot.point(if on_toes { toes.point(point) } else { point }))
    }

    /// `foot_from_toes`; without toes nothing is fixed in them.
    pub fn toes_in_foot(&self, leg: &Leg, sample: &Sample) -> Frame {
        self.toes_bent(sample.angles[leg.toes_bone().index()])
    }

    /// The same for angles of the toes.
    pub fn toes_bent(&self, angles: Angles) -> Frame {
        self.toes.as_ref().map_or(Frame::IDENTITY, |toes| foot_from_toes(toes, angles))
    }

    /// The same with the toes bent up nearly as far as their range goes.
    pub fn toes_up(&self, angles: Angles) -> Frame {
        let range = self.toes.as_ref().and_then(|toes| toes.joint.range(Dof::Flexion));
        let flexion = range.map_or(angles.flexion, |range| (range.min + TOES_RESERVE).min(range.max));
        self.toes_bent(Angles { flexion, ..angles })
    }
}

/// Where the toes are, given their angles.
pub(super) fn foot_from_toes(toes: &Toes, angles: Angles) -> Frame {
    Frame::new(toes.joint.rotation(angles), toes.joint.offset)
}
