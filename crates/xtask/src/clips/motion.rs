//! A whole motion as it is made: a way, feet that step, and a body carried over them.

use ::motion::{Clip, Key, Mode, Track};
use glam::{DQuat, DVec2, DVec3};
use rig::{Angles, Bone, Figure, Frame, Limb, Pose, Size};

use super::carriage::{Arm, Hips, Trunk};
use super::leg::{self, Foot};
use super::path::Path;
use super::sole::Sole;
use super::step::{Step, Stepping};

const LEGS: [Limb; 2] = [Limb::LeftLeg, Limb::RightLeg];

/// A motion to be made into a clip. All curves run over one length, arms and steps over their own phase.
#[derive(Clone, Debug)]
pub struct Motion {
    pub name: &'static str,
    pub length_secs: f64,
    pub loops: bool,
    /// Whether it is a stride: the left foot's contact at 0, the right's half a length later.
    pub stride: bool,
    pub path: Path,
    pub hips: Hips,
    pub trunk: Trunk,
    /// Left, right; by a phase that leads by half a length on the right, if it is a stride.
    pub arms: [Arm; 2],
    /// Left, right; likewise.
    pub steps: [Step; 2],
    /// Hips sink rather than straighten a knee further than this, degrees: a straight one would snap.
    pub least_knee: f64,
    /// How many keys.
    pub keys: usize,
}

impl Motion {
    /// How far ahead in its own cycle a side is.
    fn offset(&self, side: usize) -> f64 {
        if self.stride && side == 1 { 0.5 } else { 0.0 }
    }

    /// The figure at a phase, standing where the path has brought it. `None` if the figure lacks a part.
    pub fn pose(&self, figure: &Figure, phase: f64) -> Option<Pose> {
        let mut pose = figure.rest_pose();
        pose.place = self.path.place(phase * self.length_secs);
        let (hips, turned) = self.hips.at(figure, phase)?;
        pose.hips = hips.position;
        pose.angles[Bone::Hips.index()] = turned;
        self.trunk.write(figure, hips.rotation, phase, &mut pose.angles)?;
        for (&bone, &angles) in figure.handshapes.get("relaxed")? {
            pose.angles[bone.index()] = angles;
            pose.angles[bone.mirrored().index()] = angles;
        }
        for side in 0..2 {
            let own = phase + self.offset(side);
            self.arms[side].write(figure, side == 0, own, &mut pose.angles)?;
            self.write_leg(figure, hips, side, own, &mut pose.angles)?;
        }
        Some(pose)
    }

    /// The mirror image of a stride, which begins with the left foot's contact, too.
    pub fn mirrored(&self, name: &'static str) -> Motion {
        let DVec2 { x, y } = self.path.velocity;
        let ([left_arm, right_arm], [left, right]) = (self.arms.clone(), self.steps.clone());
        Motion {
            name,
            path: Path { velocity: DVec2::new(-x, y), turn_rate: -self.path.turn_rate },
            hips: self.hips.mirrored(),
            trunk: self.trunk.mirrored(),
            arms: [right_arm, left_arm],
            steps: [right, left],
            ..self.clone()
        }
    }

    /// The loop with its hips lowered where a leg would be straight. `None` if the figure lacks a part.
    pub fn settled(mut self, figure: &Figure) -> Option<Motion> {
        let hips = |phase: f64| self.hips.at(figure, phase).map(|(frame, _)| frame);
        let sinks = |phase: f64, side: usize| {
            let foot = self.foot(figure, side, phase + self.offset(side))?;
            leg::sinks(figure, hips(phase)?, LEGS[side], &foot, self.least_knee)
        };
        sinks(0.0, 0).and(sinks(0.0, 1))?;
        if self.loops {
            let least = |phase: f64| (0..2).filter_map(|side| sinks(phase, side)).fold(0.0, f64::max);
            self.hips.height = self.hips.height.lowered(least);
        }
        Some(self)
    }

    /// The foot of a side at its own phase.
    fn foot(&self, figure: &Figure, side: usize, phase: f64) -> Option<Foot> {
        let stepping = Stepping {
            step: &self.steps[side],
            sole: Sole::of(figure)?,
            path: self.path,
            length_secs: self.length_secs,
            side: if side == 0 { 1.0 } else { -1.0 },
        };
        Some(stepping.at(phase))
    }

    fn write_leg(
        &self,
        figure: &Figure,
        hips: Frame,
        side: usize,
        phase: f64,
        angles: &mut [Angles; Bone::COUNT],
    ) -> Option<()> {
        let foot = self.foot(figure, side, phase)?;
        // The foot's side axis is level or nearly so, its ahead axis may stand on end.
        let aside = foot.rotation * DVec3::X;
        let (foot_yaw, hips_ahead) = ((-aside.z).atan2(aside.x), hips.rotation * DVec3::Z);
        let yaw = 0.6 * foot_yaw + 0.4 * hips_ahead.x.atan2(hips_ahead.z);
        let ahead = DQuat::from_rotation_y(yaw) * DVec3::Z;
        leg::hold(figure, hips, LEGS[side], &foot, ahead, angles)
    }

    /// The clip of the motion, made with a figure. `None` if the figure lacks a part.
    pub fn clip(&self, figure: &Figure) -> Option<Clip> {
        let phases: Vec<f64> = (0..=self.keys).map(|i| i as f64 / self.keys as f64).collect();
        let poses = phases.iter().map(|phase| self.pose(figure, *phase)).collect::<Option<Vec<Pose>>>()?;
        let times: Vec<f64> = phases.iter().map(|phase| rounded(phase * self.length_secs, 1e6)).collect();
        let joints = Bone::ALL.into_iter().filter_map(|bone| {
            let values: Vec<Angles> = poses.iter().map(|pose| tidy(pose.angles(bone))).collect();
            let still = values.iter().all(|value| *value == values[0]);
            let joint = figure.skeleton.joint(bone)?;
            let told = joint.dofs().next().is_some() && !(still && values[0] == Angles::REST);
            told.then(|| (bone, track(&times, if still { &values[..1] } else { &values })))
        });
        let hips: Vec<DVec3> = poses.iter().map(|pose| pose.hips.map(|v| rounded(v, 1e5))).collect();
        let moves = self.path.velocity.length() + self.path.turn_rate.abs() > 0.0;
        let places: Vec<_> = times.iter().map(|secs| self.path.place(*secs)).collect();
        Some(Clip {
            name: self.name.to_owned(),
            figure: Some(figure.name.clone()),
            size: Some(Size::of(&figure.skeleton)),
            length_secs: self.length_secs,
            loops: self.loops,
            stride: self.stride,
            root: moves.then(|| Track { mode: Mode::Linear, ..track(&times, &places) }),
            hips: Some(track(&times, &hips)),
            joints: joints.collect(),
        })
    }
}

fn track<T: Copy>(times: &[f64], values: &[T]) -> Track<T> {
    let keys = times.iter().zip(values).map(|(&at_secs, &value)| Key { at_secs, value }).collect();
    Track { mode: Mode::Cubic, keys }
}

/// Angles as the file tells them: thousandths of a degree.
fn tidy(angles: Angles) -> Angles {
    let [flexion, abduction, twist] =
        [angles.flexion, angles.abduction, angles.twist].map(|degrees| rounded(degrees, 1e3));
    Angles { flexion, abduction, twist }
}

fn rounded(value: f64, per_unit: f64) -> f64 {
    // Adding 0 makes the negative zero a plain one.
    (value * per_unit).round() / per_unit + 0.0
}
