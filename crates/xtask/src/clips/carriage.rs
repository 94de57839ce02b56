//! How a figure carries itself over its legs: hips, trunk, head, arms.

use glam::{DQuat, DVec3};
use rig::{Angles, Bone, Figure, Frame};

use super::curve::Curve;
use super::leg::angles_of;

/// The hips' joint and its turn over a phase, metres and degrees.
#[derive(Clone, Debug)]
pub struct Hips {
    /// To the left of the figure's origin.
    pub aside: Curve,
    /// Over the ground.
    pub height: Curve,
    /// Ahead of the origin.
    pub ahead: Curve,
    /// Forward tilt.
    pub tilt: Curve,
    /// List to the left: the left side low.
    pub list: Curve,
    /// Turn to the left: the right side ahead.
    pub turn: Curve,
}

/// The trunk, the three joints together, and the head against the world, degrees.
#[derive(Clone, Debug)]
pub struct Trunk {
    /// Forward bend over the hips.
    pub bend: Curve,
    /// To the left over the hips.
    pub list: Curve,
    /// To the left over the hips.
    pub turn: Curve,
    /// The head, forward.
    pub nod: Curve,
    /// The head, listing left.
    pub head_list: Curve,
    /// The head, turned left.
    pub gaze: Curve,
}

/// One arm over its own phase, degrees.
#[derive(Clone, Debug)]
pub struct Arm {
    /// Forward from hanging.
    pub swing: Curve,
    /// Outward from hanging.
    pub out: Curve,
    /// The bent forearm inward.
    pub inward: Curve,
    /// The elbow.
    pub elbow: Curve,
    /// The forearm's turn: 0 has the palm back, -90 the palm to the thigh.
    pub palm: Curve,
    /// The wrist, to the palm.
    pub wrist: Curve,
    /// The collar, forward.
    pub collar: Curve,
    /// The collar, up.
    pub shrug: Curve,
}

impl Hips {
    /// The mirror image half a cycle on.
    pub fn mirrored(&self) -> Hips {
        Hips {
            aside: self.aside.shifted(0.5, -1.0),
            height: self.height.shifted(0.5, 1.0),
            ahead: self.ahead.shifted(0.5, 1.0),
            tilt: self.tilt.shifted(0.5, 1.0),
            list: self.list.shifted(0.5, -1.0),
            turn: self.turn.shifted(0.5, -1.0),
        }
    }

    /// `figure_from_hips`, and the hips' angles.
    pub fn at(&self, figure: &Figure, phase: f64) -> Option<(Frame, Angles)> {
        let angles = Angles {
            flexion: self.tilt.at(phase),
            abduction: self.list.at(phase),
            twist: self.turn.at(phase),
        };
        let at = DVec3::new(self.aside.at(phase), self.height.at(phase), self.ahead.at(phase));
        Some((Frame::new(figure.skeleton.joint(Bone::Hips)?.rotation(angles), at), angles))
    }
}

impl Trunk {
    /// The mirror image half a cycle on.
    pub fn mirrored(&self) -> Trunk {
        Trunk {
            bend: self.bend.shifted(0.5, 1.0),
            list: self.list.shifted(0.5, -1.0),
            turn: self.turn.shifted(0.5, -1.0),
            nod: self.nod.shifted(0.5, 1.0),
            head_list: self.head_list.shifted(0.5, -1.0),
            gaze: self.gaze.shifted(0.5, -1.0),
        }
    }

    /// Writes spine, chest, upper chest, neck and head. The neck takes up what the trunk does, so that the head keeps
    /// its own course.
    pub fn write(
        &self,
        figure: &Figure,
        hips: DQuat,
        phase: f64,
        angles: &mut [Angles; Bone::COUNT],
    ) -> Option<()> {
        let mut carrier = hips;
        for (bone, [bend, list, turn]) in [
            (Bone::Spine, [0.40, 0.45, 0.28]),
            (Bone::Chest, [0.35, 0.33, 0.34]),
            (Bone::UpperChest, [0.25, 0.22, 0.38]),
        ] {
            let each = Angles {
                flexion: bend * self.bend.at(phase),
                abduction: list * self.list.at(phase),
                twist: turn * self.turn.at(phase),
            };
            angles[bone.index()] = each;
            carrier *= figure.skeleton.joint(bone)?.rotation(each);
        }
        let head = figure.skeleton.joint(Bone::Head)?;
        let level = Angles {
            flexion: self.nod.at(phase),
            abduction: self.head_list.at(phase),
            twist: self.gaze.at(phase),
        };
        let whole = angles_of(head, carrier.conjugate() * head.rotation(level))?;
        let neck = Angles {
            flexion: 0.45 * whole.flexion,
            abduction: 0.45 * whole.abduction,
            twist: 0.42 * whole.twist,
        };
        angles[Bone::Neck.index()] = neck;
        let neck = figure.skeleton.joint(Bone::Neck)?.rotation(neck);
        angles[Bone::Head.index()] = angles_of(head, (carrier * neck).conjugate() * head.rotation(level))?;
        Some(())
    }
}

impl Arm {
    /// Writes collar, shoulder, elbow and wrist of the left arm, or the same of the right.
    pub fn write(
        &self,
        figure: &Figure,
        left: bool,
        phase: f64,
        angles: &mut [Angles; Bone::COUNT],
    ) -> Option<()> {
        let sided = |bone: Bone| if left { bone } else { bone.mirrored() };
        // The mirror has the same angles: the left arm's rotation serves both.
        let hanging = DQuat::from_rotation_z(-std::f64::consts::FRAC_PI_2);
        let upper = DQuat::from_rotation_x(-self.swing.at(phase).to_radians())
            * DQuat::from_rotation_z(self.out.at(phase).to_radians())
            * hanging
            * DQuat::from_rotation_x(self.inward.at(phase).to_radians());
        let shoulder = figure.skeleton.joint(Bone::LeftUpperArm)?;
        angles[sided(Bone::LeftUpperArm).index()] = angles_of(shoulder, upper)?;
        let lower = &mut angles[sided(Bone::LeftLowerArm).index()];
        (lower.flexion, lower.twist) = (self.elbow.at(phase), self.palm.at(phase));
        angles[sided(Bone::LeftHand).index()].flexion = self.wrist.at(phase);
        let collar = &mut angles[sided(Bone::LeftShoulder).index()];
        (collar.flexion, collar.abduction) = (self.collar.at(phase), self.shrug.at(phase));
        Some(())
    }
}
