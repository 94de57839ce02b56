//! Inverse gestures on one limb: reach, elevate, flip, and following its contact.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_6, PI};

use glam::{DQuat, DVec3};
use kin::{Degenerate, LimbGoal, LimbRanges, LimbState, wrapped};

use crate::end::turn_end;
use crate::limb_rig::{LimbRig, set};
use crate::{Angles, Bone, Contact, Dof, Figure, Frames, GestureError, Limb, Pose};

/// How far a reach may change the elevation to stay inside the ranges, radians.
const WINDOW: f64 = FRAC_PI_6;

/// A limb of a pose and what an inverse gesture keeps of it, read when the gesture begins.
pub(crate) struct Grip<'a> {
    pub figure: &'a Figure,
    pub rig: LimbRig,
    /// The pose at the gesture's start: what ranges stretch to hold.
    pub before: &'a Pose,
    pub from: LimbState,
    pub kept: LimbGoal,
    pub ranges: bool,
    /// Whether the elevation must stay as it is, even if a range then leaves the target missed.
    strict: bool,
}

impl<'a> Grip<'a> {
    pub fn new(
        figure: &'a Figure,
        before: &'a Pose,
        limb: Limb,
        ranges: bool,
    ) -> Result<Grip<'a>, GestureError> {
        let rig = *figure.limbs.get(limb).ok_or(GestureError::NoLimb(limb))?;
        let about = rig.about(figure, before);
        Grip::about(figure, before, rig, about, ranges)
    }

    /// The grip whose elevation is about the articulator's line even if the end is planted.
    pub fn about_articulator(
        figure: &'a Figure,
        before: &'a Pose,
        limb: Limb,
        ranges: bool,
    ) -> Result<Grip<'a>, GestureError> {
        let rig = *figure.limbs.get(limb).ok_or(GestureError::NoLimb(limb))?;
        let at = figure.articulator(before, limb);
        let about = rig.in_hinge(figure, before, at.bone, at.at);
        Grip::about(figure, before, rig, about, ranges)
    }

    fn about(
        figure: &'a Figure,
        before: &'a Pose,
        rig: LimbRig,
        about: DVec3,
        ranges: bool,
    ) -> Result<Grip<'a>, GestureError> {
        let from = rig.state(figure, before);
        let fault = |why| GestureError::Degenerate { limb: rig.limb, why };
        let kept = rig.kin.recover(about, &from).map_err(fault)?;
        Ok(Grip { figure, rig, before, from, kept, ranges, strict: false })
    }

    fn limits(&self) -> LimbRanges {
        if self.ranges { self.rig.ranges } else { LimbRanges::FREE }
    }

    /// Brings a point of the limb to a world target; `frames` are the pose's for the limb's base.
    pub fn bring(
        &self,
        pose: &mut Pose,
        frames: &Frames,
        in_hinge: DVec3,
        target_in_world: DVec3,
        kept: &LimbGoal,
    ) -> Result<bool, GestureError> {
        let limb = self.rig.limb;
        let target = self.rig.target_in_limb(frames[self.rig.base].inverse().point(target_in_world));
        let goal = LimbGoal { target, ..*kept };
        let fault = |why| GestureError::Degenerate { limb, why };
        if self.rig.root_locked {
            return Ok(self.bring_by_hinge(pose, in_hinge, target));
        }
        if self.strict {
            let held =
                self.rig.kin.hold_within(in_hinge, &goal, &self.from, &self.limits(), 1e-9).map_err(fault)?;
            if let Some(state) = held {
                self.rig.write(self.figure, pose, &state);
            }
            return Ok(held.is_none());
        }
        let solve = |goal| self.rig.kin.reach_within(in_hinge, goal, &self.from, &self.limits(), WINDOW);
        let reach = match solve(&goal) {
            // At the root there is no direction: fold along the present one.
            Err(Degenerate::TargetAtRoot) => {
                solve(&LimbGoal { target: kept.target.normalize_or(DVec3::Y) * 1e-9, ..goal })
            }
            other => other,
        };
        let reach = reach.map_err(fault)?;
        self.rig.write(self.figure, pose, &reach.state);
        Ok(reach.limited || reach.residual > MET)
    }

    /// Bends the hinge so that a point of the limb comes nearest to a target in the limb frame, the root being locked.
    ///
    /// Bending carries the point round a circle, p(g) = c + u cos g + v sin g; the nearest is where the target's
    /// direction from the centre lies.
    fn bring_by_hinge(&self, pose: &mut Pose, in_hinge: DVec3, target: DVec3) -> bool {
        let at = |hinge: f64| self.rig.kin.articulator(&LimbState { hinge, ..self.from }, in_hinge);
        let center = (at(0.0) + at(PI)) * 0.5;
        let (u, v) = (at(0.0) - center, at(FRAC_PI_2) - center);
        let toward = target - center;
        let nearest = toward.dot(v).atan2(toward.dot(u));
        let range = self.limits().hinge.reaching(self.from.hinge);
        let free = self.from.hinge + wrapped(nearest - self.from.hinge);
        let missed = |hinge: &f64| at(*hinge).distance(target);
        let ends = [range.min, range.max];
        let hinge = if range.contains(free) {
            free
        } else {
            let ends = ends.into_iter().filter(|end| end.is_finite());
            ends.min_by(|a, b| missed(a).total_cmp(&missed(b))).unwrap_or(free)
        };
        set(pose, self.rig.limb.parts().hinge, Dof::Flexion, hinge.to_degrees());
        missed(&hinge) > MET
    }

    /// Brings the limb to the target of a contact: the pose's root, hinge and, if planted, end.
    pub fn follow(&self, pose: &mut Pose, frames: &Frames, contact: &Contact) -> Result<bool, GestureError> {
        match *contact {
            Contact::Free => Ok(false),
            Contact::Point { space, target } => {
                let at = self.figure.articulator(pose, self.rig.limb);
                let in_hinge = self.rig.in_hinge(self.figure, pose, at.bone, at.at);
                self.bring(pose, frames, in_hinge, frames.space(space).point(target), &self.kept)
            }
            Contact::Planted { space, target, rotation } => {
                let space = frames.space(space);
                self.plant(pose, frames, space.point(target), space.rotation * rotation)
            }
        }
    }

    /// As [`Grip::follow`] with the elevation kept: where a range is in the way, the limb stays as it is.
    pub fn follow_strictly(
        &self,
        pose: &mut Pose,
        frames: &Frames,
        contact: &Contact,
    ) -> Result<bool, GestureError> {
        Grip { strict: true, ..*self }.follow(pose, frames, contact)
    }

    /// Brings the end's joint to where the articulator is on its target with the end's rotation kept. Where
    /// wrist or ankle can't keep the rotation, or the limb can't reach, the articulator's place wins.
    fn plant(
        &self,
        pose: &mut Pose,
        frames: &Frames,
        target: DVec3,
        rotation: DQuat,
    ) -> Result<bool, GestureError> {
        let limb = self.rig.limb;
        let end = limb.parts().end;
        let at = self.figure.articulator(pose, limb);
        if at.bone == limb.parts().hinge {
            return self.plant_segment(pose, frames, target, rotation);
        }
        let in_end = self.in_end(pose, at.bone, at.at);
        let joint_target = target - rotation * in_end;
        let mut limited = false;
        let mut stopped = false;
        // The second round matters only where the forearm's twist moves the wrist: a twist axis beside it.
        for _ in 0..2 {
            let joint = self.rig.in_hinge(self.figure, pose, end, DVec3::ZERO);
            limited = self.bring(pose, frames, joint, joint_target, &self.kept)?;
            stopped = self.turn(pose, frames, rotation);
        }
        if !stopped && self.place(pose, frames, at.bone, at.at).distance(target) <= MET {
            return Ok(limited);
        }
        for round in 0..PLANT_ROUNDS {
            if round > 0 {
                self.turn(pose, frames, rotation);
            }
            let in_hinge = self.rig.in_hinge(self.figure, pose, at.bone, at.at);
            let kept = self.rig.kin.recover(in_hinge, &self.rig.state(self.figure, pose));
            let kept = kept.map_err(|why| GestureError::Degenerate { limb, why })?;
            self.bring(pose, frames, in_hinge, target, &kept)?;
        }
        Ok(true)
    }

    /// As [`Grip::plant`] for a point of the lower segment, which the end's rotation does not move.
    fn plant_segment(
        &self,
        pose: &mut Pose,
        frames: &Frames,
        target: DVec3,
        rotation: DQuat,
    ) -> Result<bool, GestureError> {
        let at = self.figure.articulator(pose, self.rig.limb);
        let first = self.twist(pose);
        let mut limited = false;
        // The forearm's twist moves a point on its skin by a little: turn, bring the point back, until it stays.
        for _ in 0..SEGMENT_ROUNDS {
            let in_hinge = self.rig.in_hinge(self.figure, pose, at.bone, at.at);
            limited = self.bring(pose, frames, in_hinge, target, &self.kept)?;
            limited |= self.turn(pose, frames, rotation);
            if self.place(pose, frames, at.bone, at.at).distance(target) < 1e-13 {
                break;
            }
        }
        let in_hinge = self.rig.in_hinge(self.figure, pose, at.bone, at.at);
        limited |= self.bring(pose, frames, in_hinge, target, &self.kept)?;
        if self.place(pose, frames, at.bone, at.at).distance(target) > MET {
            self.give_way(pose, frames, target, first)?;
            return Ok(true);
        }
        Ok(limited)
    }

    /// Takes back as much of the forearm's twist since `first`, degrees, as puts a point of the lower segment within
    /// reach: with a nearly straight limb a twist can carry it away. The twist stays if that doesn't help.
    fn give_way(
        &self,
        pose: &mut Pose,
        frames: &Frames,
        target: DVec3,
        first: f64,
    ) -> Result<(), GestureError> {
        let (mut reached, mut lost) = (first, self.twist(pose));
        let reaches = |twist: f64| -> Result<Option<Pose>, GestureError> {
            let mut turned = pose.clone();
            set(&mut turned, self.rig.limb.parts().hinge, Dof::Twist, twist);
            Ok(self.hold(&mut turned, frames, target)?.then_some(turned))
        };
        let Some(mut found) = reaches(reached)? else { return Ok(()) };
        for _ in 0..GIVE_WAY_ROUNDS {
            let middle = 0.5 * (reached + lost);
            match reaches(middle)? {
                Some(pose) => (reached, found) = (middle, pose),
                None => lost = middle,
            }
        }
        *pose = found;
        Ok(())
    }

    /// Brings the articulator to a world target if some elevation in the window does; returns whether it did.
    fn hold(&self, pose: &mut Pose, frames: &Frames, target_in_world: DVec3) -> Result<bool, GestureError> {
        let at = self.figure.articulator(pose, self.rig.limb);
        let in_hinge = self.rig.in_hinge(self.figure, pose, at.bone, at.at);
        let target = self.rig.target_in_limb(frames[self.rig.base].inverse().point(target_in_world));
        let goal = LimbGoal { target, ..self.kept };
        let window = if self.strict { 1e-9 } else { WINDOW };
        let held = self.rig.kin.hold_within(in_hinge, &goal, &self.from, &self.limits(), window);
        let held = held.map_err(|why| GestureError::Degenerate { limb: self.rig.limb, why })?;
        let Some(state) = held.filter(|_| !self.rig.root_locked) else { return Ok(false) };
        self.rig.write(self.figure, pose, &state);
        Ok(self.place(pose, frames, at.bone, at.at).distance(target_in_world) <= 1e-3 * MET)
    }

    /// The twist of the lower segment, degrees.
    fn twist(&self, pose: &Pose) -> f64 {
        pose.angles(self.rig.limb.parts().hinge).get(Dof::Twist)
    }

    /// Turns the end toward a world rotation as far as it goes.
    fn turn(&self, pose: &mut Pose, frames: &Frames, rotation: DQuat) -> bool {
        let bent = frames[self.rig.base].rotation * self.base_from_bent_hinge(pose);
        turn_end(self.figure, pose, self.rig.limb, bent.conjugate() * rotation, self.before, self.ranges)
    }

    fn base_from_bent_hinge(&self, pose: &Pose) -> DQuat {
        let parts = self.rig.limb.parts();
        let rotation =
            |bone, angles| self.figure.skeleton.joint(bone).map_or(DQuat::IDENTITY, |j| j.rotation(angles));
        let bent = Angles { flexion: pose.angles(parts.hinge).flexion, ..Angles::REST };
        rotation(parts.root, pose.angles(parts.root)) * rotation(parts.hinge, bent)
    }

    /// A point of a bone at or beyond the end, in the end's frame.
    fn in_end(&self, pose: &Pose, bone: Bone, at: DVec3) -> DVec3 {
        let end = self.rig.limb.parts().end;
        let (mut bone, mut point) = (bone, at);
        while bone != end {
            if let Some(joint) = self.figure.skeleton.joint(bone) {
                point = joint.offset + joint.rotation(pose.angles(bone)) * point;
            }
            bone = bone.carrier();
        }
        point
    }

    /// Where a point of the limb is in the world, the base's frame being given.
    fn place(&self, pose: &Pose, frames: &Frames, bone: Bone, at: DVec3) -> DVec3 {
        let in_hinge = self.rig.in_hinge(self.figure, pose, bone, at);
        let in_limb = self.rig.kin.articulator(&self.rig.state(self.figure, pose), in_hinge);
        frames[self.rig.base].point(self.rig.point_in_base(in_limb))
    }

    /// Swings the hinge about the line from root to articulator, or to a planted end's joint.
    ///
    /// `to` is the goal as an internal elevation; `by` a signed change. Returns whether a range stopped it.
    pub fn elevate(&self, pose: &mut Pose, goal: Elevate) -> bool {
        let about = self.rig.about(self.figure, self.before);
        let now = self.kept.elevation;
        let direction = self.kept.target.normalize_or(DVec3::Y);
        let limits = self.limits().reaching(&self.from);
        let around = self.rig.kin.elevations(about, self.from.hinge, direction, &limits.root).around(now);
        let (low, high) = around.unwrap_or((now, now));
        let whole = high - low >= std::f64::consts::TAU - 1e-12;
        let wanted = match goal {
            Elevate::By(change) => now + change,
            Elevate::To(elevation) => now + wrapped(elevation - now),
        };
        let held = match goal {
            _ if whole || (low <= wanted && wanted <= high) => wanted,
            Elevate::By(_) => wanted.clamp(low, high),
            Elevate::To(_) => nearest_on_arc(wanted, low, high),
        };
        let root = self.rig.kin.root_for(about, self.from.hinge, direction, held);
        self.rig.write(self.figure, pose, &LimbState { root, ..self.from });
        (wrapped(held - wanted)).abs() > 1e-9
    }

    /// Takes the other bend of the hinge for the same place.
    pub fn flip(&self, pose: &mut Pose) -> Result<bool, GestureError> {
        let limb = self.rig.limb;
        let about = self.rig.about(self.figure, self.before);
        let goal = LimbGoal { branch: self.kept.branch.flipped(), ..self.kept };
        let fault = |why| GestureError::Degenerate { limb, why };
        let other = self.rig.kin.hinge_for(about, goal.target.length(), goal.branch).map_err(fault)?;
        if self.limits().hinge.excess(other.angle) > 1e-9 {
            return Err(GestureError::NoFlip { limb, degrees: other.angle.to_degrees() });
        }
        let reach =
            self.rig.kin.reach_within(about, &goal, &self.from, &self.limits(), WINDOW).map_err(fault)?;
        self.rig.write(self.figure, pose, &reach.state);
        Ok(reach.limited)
    }
}

/// How near an articulator has met its target, metres.
const MET: f64 = 1e-9;

/// Rounds in which a planted end that can't keep its rotation settles between rotation and place.
const PLANT_ROUNDS: usize = 3;

/// The most rounds in which a planted forearm settles; each comes several times nearer.
const SEGMENT_ROUNDS: usize = 32;

/// Halvings of the twist that a planted forearm takes back.
const GIVE_WAY_ROUNDS: usize = 40;

/// The goal of an elevation, radians.
#[derive(Clone, Copy)]
pub(crate) enum Elevate {
    By(f64),
    To(f64),
}

/// The point of an arc from `low` to `high` nearest to an angle, given as one of its whole turns.
fn nearest_on_arc(wanted: f64, low: f64, high: f64) -> f64 {
    let inside = low + (wanted - low).rem_euclid(std::f64::consts::TAU);
    if inside <= high {
        return inside;
    }
    if wrapped(wanted - low).abs() <= wrapped(wanted - high).abs() { low } else { high }
}
