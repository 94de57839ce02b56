//! One leg of a figure: where it holds the foot, and the joints that hold the foot where it should be.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DQuat, DVec3};
use kin::{Ball, Branch, Interval, LimbGoal, LimbRanges, LimbState, RootRange, arc_tangent, softened};
use rig::{Angles, Articulation, Bone, Dof, Figure, Frame, Joint, Limb, LimbRig};

/// Both legs of a figure, made ready to solve once.
#[derive(Clone, PartialEq, Debug)]
pub struct Legs {
    /// Left, right.
    pub sides: [Leg; 2],
}

impl Legs {
    /// The legs of a figure; `None` if it lacks a hip, a knee or a foot of either, or a leg has no plane to bend in.
    pub fn of(figure: &Figure) -> Option<Legs> {
        Some(Legs { sides: [Leg::of(figure, Limb::LeftLeg)?, Leg::of(figure, Limb::RightLeg)?] })
    }
}

/// One leg, made ready to solve: hip, knee and ankle.
#[derive(Clone, PartialEq, Debug)]
pub struct Leg {
    rig: LimbRig,
    hip: Ball,
    knee: Joint,
    foot: Joint,
    toes: Option<Joint>,
    /// The ankle in the knee's frame and limb axes, the knee having no other angle than its flexion.
    ankle_in_knee: DVec3,
    /// The farthest from the hip that the knee's range lets the ankle be, metres.
    full: f64,
}

/// How a leg bends: what a solve keeps of it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Bend {
    /// Turn of the knee about the line from hip to ankle, radians, as in [`kin::LimbGoal`].
    pub elevation: f64,
    /// From hip to ankle, metres.
    pub distance: f64,
    branch: Branch,
    /// The leg's ranges, stretched to hold it as it is.
    ranges: LimbRanges,
}

/// Where a foot should be, in figure space.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct FootGoal {
    /// The ankle's joint, metres.
    pub ankle: DVec3,
    /// `figure_from_foot`.
    pub rotation: DQuat,
}

/// What kept a leg from its goal.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct LegMiss {
    /// From the ankle to where it should be, metres: soft reach and ranges. Infinite where numbers were no numbers
    /// and the leg stayed as it was.
    pub ankle_m: f64,
    /// How far the foot is turned from its goal, degrees.
    pub foot_degrees: f64,
    /// Whether hip or knee stopped at a range.
    pub leg_stopped: bool,
    /// Flexion, abduction and twist of the ankle: how far the goal lies beyond each range, degrees, signed.
    pub foot_beyond: Angles,
}

/// A leg that was bent.
pub(crate) struct Bent {
    pub miss: LegMiss,
    /// Of hip, knee and ankle, each in its carrier.
    pub turns: [DQuat; 3],
}

impl Leg {
    fn of(figure: &Figure, limb: Limb) -> Option<Leg> {
        let parts = limb.parts();
        let rig = *figure.limbs.get(limb)?;
        let joint = |bone: Bone| figure.skeleton.joint(bone).cloned();
        let (hip, knee, foot) = (joint(parts.root)?, joint(parts.hinge)?, joint(parts.end)?);
        let Articulation::Ball { ball, .. } = hip.articulation else { return None };
        if rig.base != Bone::Hips || foot.carrier != Some(parts.hinge) || knee.carrier != Some(parts.root) {
            return None;
        }
        let toes = joint(if limb == Limb::LeftLeg { Bone::LeftToes } else { Bone::RightToes });
        let ankle_in_knee = rig.vector_in_limb(foot.offset);
        let full = rig.kin.reach_in(ankle_in_knee, rig.ranges.hinge).1;
        Some(Leg { rig, hip: ball, knee, foot, toes, ankle_in_knee, full })
    }

    /// Which limb it is.
    pub fn limb(&self) -> Limb {
        self.rig.limb
    }

    /// The toes' bone, whether or not the figure has it.
    pub fn toes_bone(&self) -> Bone {
        if self.rig.limb == Limb::LeftLeg { Bone::LeftToes } else { Bone::RightToes }
    }

    /// The toes' joint, if the figure has one.
    pub fn toes(&self) -> Option<&Joint> {
        self.toes.as_ref()
    }

    /// The ankle's joint.
    pub fn foot(&self) -> &Joint {
        &self.foot
    }

    /// The farthest from the hip that the ankle can be, metres.
    pub fn full_reach(&self) -> f64 {
        self.full
    }

    /// The hip's joint in figure space, given the frame of the hips.
    pub fn hip(&self, figure_from_hips: Frame) -> DVec3 {
        figure_from_hips.point(self.rig.point_in_base(DVec3::ZERO))
    }

    /// The knee's joint in figure space.
    pub fn knee(&self, figure_from_hips: Frame, angles: &[Angles; Bone::COUNT]) -> DVec3 {
        let root = self.hip_turn(angles[self.rig.limb.parts().root.index()]);
        self.hip(figure_from_hips) + figure_from_hips.rotation * (root * self.knee.offset)
    }

    /// Where the joints hold the foot: `figure_from_foot`, at the ankle's joint.
    pub fn ankle_and_foot(&self, figure_from_hips: Frame, angles: &[Angles; Bone::COUNT]) -> Frame {
        self.foot_held_by(figure_from_hips, &self.turns(angles))
    }

    /// As [`Leg::ankle_and_foot`], given the turns of hip, knee and ankle.
    pub fn foot_held_by(&self, figure_from_hips: Frame, [root, knee, foot]: &[DQuat; 3]) -> Frame {
        let hip = figure_from_hips.then(Frame::new(*root, self.rig.point_in_base(DVec3::ZERO)));
        let shank = hip.then(Frame::new(*knee, self.knee.offset));
        shank.then(Frame::new(*foot, self.foot.offset))
    }

    /// How the leg bends; a leg whose angles are no numbers bends as at rest.
    pub fn bend(&self, angles: &[Angles; Bone::COUNT]) -> Bend {
        self.bend_of(self.hip_turn(angles[self.rig.limb.parts().root.index()]), angles)
    }

    /// As [`Leg::bend`], given the turn of the hip.
    pub fn bend_of(&self, hip: DQuat, angles: &[Angles; Bone::COUNT]) -> Bend {
        let parts = self.rig.limb.parts();
        let root = self.rig.root_in_limb(hip);
        let from = LimbState { root, hinge: angles[parts.hinge.index()].flexion.to_radians() };
        let in_knee = self.in_knee(angles[parts.hinge.index()]);
        let rest = LimbState { root: DQuat::IDENTITY, hinge: 0.0 };
        let read = |state: LimbState, at: DVec3| self.rig.kin.recover(at, &state).map(|goal| (goal, state));
        match read(from, in_knee).or_else(|_| read(rest, self.ankle_in_knee)) {
            Ok((goal, from)) => {
                let distance = goal.target.length();
                let ranges = self.rig.ranges.reaching(&from);
                Bend { elevation: goal.elevation, distance, branch: goal.branch, ranges }
            }
            Err(_) => {
                let ranges = self.rig.ranges.reaching(&rest);
                Bend { elevation: 0.0, distance: self.full, branch: Branch::Plus, ranges }
            }
        }
    }

    /// Holds the foot at its goal: writes the angles of hip, knee and ankle.
    ///
    /// The knee keeps the bend's elevation. Where that leaves the hip's range, the thigh stops there and the knee brings
    /// the ankle as near as it can; the foot's angles stop at their ranges, and its place wins over its rotation. Within `softness_m` of full stretch the
    /// distance eases toward it, but not short of the bend's own distance, so that solving what was read changes
    /// nothing. Joints that were out of range may stay there. Numbers that are none leave the leg as it was.
    pub fn solve(
        &self,
        figure_from_hips: Frame,
        goal: &FootGoal,
        bend: &Bend,
        softness_m: f64,
        angles: &mut [Angles; Bone::COUNT],
    ) -> LegMiss {
        self.bent_to(figure_from_hips, goal, bend, softness_m, angles).miss
    }

    /// As [`Leg::solve`], with the joints' turns.
    pub(crate) fn bent_to(
        &self,
        figure_from_hips: Frame,
        goal: &FootGoal,
        bend: &Bend,
        softness_m: f64,
        angles: &mut [Angles; Bone::COUNT],
    ) -> Bent {
        let unbent = |angles: &[Angles; Bone::COUNT]| Bent {
            miss: LegMiss { ankle_m: f64::INFINITY, ..LegMiss::default() },
            turns: self.turns(angles),
        };
        let parts = self.rig.limb.parts();
        let shin = angles[parts.hinge.index()];
        let in_knee = self.in_knee(shin);
        let wanted = self.rig.target_in_limb(figure_from_hips.inverse().point(goal.ankle));
        let Some((state, stopped)) = self.reached(in_knee, wanted, bend, softness_m) else {
            return unbent(angles);
        };
        let base_from_root = self.rig.root_in_base(state.root);
        let [flexion, abduction, twist] = self.hip.angles(base_from_root).map(f64::to_degrees);
        let knee = state.hinge.to_degrees();
        if !(flexion + abduction + twist + knee).is_finite() {
            return unbent(angles);
        }
        write(&mut angles[parts.root.index()], Angles { flexion, abduction, twist });
        write(&mut angles[parts.hinge.index()], Angles { flexion: knee, ..shin });
        let knee = self.knee.rotation(Angles { flexion: knee, ..shin });
        let shank = figure_from_hips.rotation * base_from_root * knee;
        let reached = self.rig.kin.articulator(&state, in_knee);
        let miss = LegMiss { ankle_m: reached.distance(wanted), leg_stopped: stopped, ..LegMiss::default() };
        let foot = &mut angles[parts.end.index()];
        let (foot, miss) = self.turn_foot(shank.conjugate() * goal.rotation, foot, miss);
        Bent { miss, turns: [base_from_root, knee, foot] }
    }

    /// The flexion that the ankle needs for a goal, degrees, its range aside: what [`Leg::solve`] finds on its way, for
    /// less than half its work. `None` where numbers are no numbers.
    pub fn foot_flexion(
        &self,
        figure_from_hips: Frame,
        goal: &FootGoal,
        bend: &Bend,
        softness_m: f64,
        angles: &[Angles; Bone::COUNT],
    ) -> Option<f64> {
        let parts = self.rig.limb.parts();
        let shin = angles[parts.hinge.index()];
        let wanted = self.rig.target_in_limb(figure_from_hips.inverse().point(goal.ankle));
        let (state, _) = self.reached(self.in_knee(shin), wanted, bend, softness_m)?;
        let knee = self.knee.rotation(Angles { flexion: state.hinge.to_degrees(), ..shin });
        let shank = figure_from_hips.rotation * self.rig.root_in_base(state.root) * knee;
        let shank_from_foot = shank.conjugate() * goal.rotation;
        let flexion = match &self.foot.articulation {
            // The outer of the hinges doesn't wait for the others.
            Articulation::Hinges(hinges) if hinges.first().is_some_and(|h| h.dof == Dof::Flexion) => {
                kin::twist_about(shank_from_foot, hinges[0].axis).to_degrees()
            }
            other => hinge_angles(other, shank_from_foot, angles[parts.end.index()])?.flexion,
        };
        flexion.is_finite().then_some(flexion)
    }

    /// The joints that hold the ankle at a place in the limb's axes, and whether a range changed them.
    fn reached(
        &self,
        in_knee: DVec3,
        wanted: DVec3,
        bend: &Bend,
        softness_m: f64,
    ) -> Option<(LimbState, bool)> {
        let target = self.soft(wanted, bend.distance, softness_m);
        let goal = LimbGoal { target, elevation: bend.elevation, branch: bend.branch };
        let direct = self.rig.kin.solve(in_knee, &goal).ok()?.state;
        if !(direct.root.is_finite() && direct.hinge.is_finite()) {
            return None;
        }
        let ranges = &bend.ranges;
        if ranges.contains(&direct, 1e-9) {
            return Some((direct, false));
        }
        // A knee that swung aside for the thigh's range would have to swing far where the leg is nearly straight, and at
        // once. So the thigh stops, and the knee brings the ankle as near as it then can.
        let root = stopped(direct.root, &ranges.root);
        let at = |hinge: f64| self.rig.kin.articulator(&LimbState { root, hinge }, in_knee);
        let (straight, folded) = (at(0.0), at(PI));
        let center = (straight + folded) * 0.5;
        let toward = target - center;
        let nearest = toward.dot(at(FRAC_PI_2) - center).atan2(toward.dot(straight - center));
        let hinge = ranges.hinge.clamp(nearest);
        hinge.is_finite().then_some((LimbState { root, hinge }, true))
    }

    /// A target brought nearer to the hip where the leg would snap straight.
    fn soft(&self, target: DVec3, kept: f64, softness_m: f64) -> DVec3 {
        let distance = target.length();
        let softness = softness_m.min(self.full - kept);
        let eased = if distance > kept { softened(distance, self.full, softness) } else { distance };
        if eased == distance || !distance.is_finite() { target } else { target * (eased / distance) }
    }

    /// The bones of hip, knee and ankle.
    pub fn bones(&self) -> [Bone; 3] {
        let parts = self.rig.limb.parts();
        [parts.root, parts.hinge, parts.end]
    }

    /// The turns of hip, knee and ankle, each in its carrier.
    pub fn turns(&self, angles: &[Angles; Bone::COUNT]) -> [DQuat; 3] {
        let [hip, knee, foot] = self.bones().map(|bone| angles[bone.index()]);
        [self.hip_turn(hip), self.knee.rotation(knee), self.foot.rotation(foot)]
    }

    /// Turns the foot as far as the ankle goes toward a rotation in figure space, and says how far it then is off it.
    pub fn hold_foot(
        &self,
        figure_from_hips: Frame,
        rotation: DQuat,
        angles: &mut [Angles; Bone::COUNT],
    ) -> LegMiss {
        let parts = self.rig.limb.parts();
        let [hip, knee, _] = self.turns(angles);
        let shank = figure_from_hips.rotation * hip * knee;
        self.turn_foot(shank.conjugate() * rotation, &mut angles[parts.end.index()], LegMiss::default()).1
    }

    /// Turns the foot as far as the ankle goes toward a rotation seen from the shank, and gives the ankle's turn.
    fn turn_foot(&self, shank_from_foot: DQuat, foot: &mut Angles, mut miss: LegMiss) -> (DQuat, LegMiss) {
        let Some(wanted) = hinge_angles(&self.foot.articulation, shank_from_foot, *foot) else {
            return (self.foot.rotation(*foot), miss);
        };
        let mut held = *foot;
        for dof in Dof::ALL {
            let range = self.foot.range(dof).unwrap_or(Interval::FREE).reaching(foot.get(dof));
            let angle = wanted.get(dof);
            let inside = range.clamp(angle);
            miss.foot_beyond.set(dof, angle - inside);
            held.set(dof, inside);
        }
        let turn = self.foot.rotation(held);
        let off = turn.conjugate() * shank_from_foot;
        let half = arc_tangent(DVec3::new(off.x, off.y, off.z).length(), off.w.abs());
        miss.foot_degrees = (2.0 * half).to_degrees();
        write(foot, held);
        (turn, miss)
    }

    fn hip_turn(&self, angles: Angles) -> DQuat {
        self.hip.rotation(
            angles.flexion.to_radians(),
            angles.abduction.to_radians(),
            angles.twist.to_radians(),
        )
    }

    /// The ankle in the knee's frame and limb axes: a knee that twists carries it along.
    fn in_knee(&self, shin: Angles) -> DVec3 {
        if shin.abduction == 0.0 && shin.twist == 0.0 {
            return self.ankle_in_knee;
        }
        self.rig.vector_in_limb(self.knee.rotation(Angles { flexion: 0.0, ..shin }) * self.foot.offset)
    }
}

/// A hip's turn brought into its range: the thigh to the cone's rim, then the twist to its end.
fn stopped(root: DQuat, range: &RootRange) -> DQuat {
    let bone = root * range.bone;
    let root = DQuat::from_rotation_arc(bone, range.cone.clamp(bone)) * root;
    let (swing, twist) = kin::swing_twist(root, range.twist_axis);
    let held = range.twist.clamp(twist);
    if held == twist { root } else { swing * kin::axis_angle(range.twist_axis, held) }
}

/// The angles that turn a joint nearest to a rotation, degrees, ranges aside; `None` if the rotation is no number.
fn hinge_angles(articulation: &Articulation, rotation: DQuat, was: Angles) -> Option<Angles> {
    if !rotation.is_finite() || rotation.length_squared() < 0.25 {
        return None;
    }
    let mut angles = was;
    match articulation {
        Articulation::Ball { ball, .. } => {
            for (dof, angle) in Dof::ALL.into_iter().zip(ball.angles(rotation)) {
                angles.set(dof, angle.to_degrees());
            }
        }
        Articulation::Hinges(hinges) => {
            let mut rest = rotation;
            for (i, hinge) in hinges.iter().enumerate() {
                // Square axes: what is left after the outer turn is the inner one.
                let angle = kin::twist_about(rest, hinge.axis);
                angles.set(hinge.dof, angle.to_degrees());
                if i + 1 < hinges.len() {
                    rest = kin::axis_angle(hinge.axis, -angle) * rest;
                }
            }
        }
    }
    Some(angles)
}

/// Writes angles, but keeps the bits of those that come out as they were give or take the rounding.
fn write(angles: &mut Angles, new: Angles) {
    for dof in Dof::ALL {
        if (angles.get(dof) - new.get(dof)).abs() > 1e-12 || angles.get(dof).is_nan() {
            angles.set(dof, new.get(dof));
        }
    }
}
