//! The torso and the head by what they aim at.

use glam::{DQuat, DVec3};
use kin::{Column, ColumnState, Eye, Frame, Gaze, Interval};

use crate::contacts::keep_contacts;
use crate::gesture::{finite, present};
use crate::limb_rig::{radians, set};
use crate::lock::check_unlocked;
use crate::{Articulation, Bone, Dof, Figure, GestureError, Joint, Moved, Pose, frames};

/// Bends the spine evenly so that the line from its first joint to the neck points at a world point, with a total
/// twist in degrees; what an even bend can't express stays. Joints stop at their ranges.
///
/// # Errors
/// A spine with fewer than three joints, a point at the spine's foot, numbers that are not finite.
pub fn aim_spine(
    figure: &Figure,
    before: &Pose,
    at: DVec3,
    twist: f64,
    ranges: bool,
) -> Result<Moved, GestureError> {
    finite(at, "the aim")?;
    if !twist.is_finite() {
        return Err(GestureError::NotFinite { what: "the twist" });
    }
    check_unlocked(&figure.skeleton, &SPINE)?;
    let spine = Spine::of(figure)?;
    let [first, ..] = spine.joints;
    let base = frames(figure, before)[Bone::Hips].then(Frame::new(DQuat::IDENTITY, first.offset));
    let state = spine.recover(before)?;
    let aim = base.inverse().point(at);
    let solved =
        spine.column.solve(&state, aim, twist.to_radians()).map_err(|_| GestureError::NoDirection)?;
    let mut pose = before.clone();
    let mut clamped = !solved.reached();
    for (joint, local) in spine.joints.into_iter().zip(spine.column.pose(&solved.state)) {
        clamped |= turn_to(joint, &mut pose, local, before, ranges);
    }
    clamped |= keep_contacts(figure, before, &mut pose, &[], ranges)?;
    Ok(Moved { pose, clamped })
}

/// The total twist of the spine as it is, degrees: what an aim takes to leave it. `None` for a figure whose spine
/// has fewer than three joints.
pub fn spine_twist(figure: &Figure, pose: &Pose) -> Option<f64> {
    let state = Spine::of(figure).and_then(|spine| spine.recover(pose)).ok()?;
    Some(state.bend.twist.to_degrees())
}

/// The joints of the spine, from the hips up.
const SPINE: [Bone; 3] = [Bone::Spine, Bone::Chest, Bone::UpperChest];

/// The three joints of the spine as one column.
pub(crate) struct Spine<'a> {
    joints: [&'a Joint; 3],
    column: Column<3>,
}

impl<'a> Spine<'a> {
    pub(crate) fn of(figure: &'a Figure) -> Result<Spine<'a>, GestureError> {
        let [spine, chest, upper, neck] =
            [Bone::Spine, Bone::Chest, Bone::UpperChest, Bone::Neck].map(|bone| present(figure, bone));
        let (joints, neck) = ([spine?, chest?, upper?], neck?);
        let segments = [joints[1].offset, joints[2].offset, neck.offset];
        let column = Column::new(segments).map_err(|_| GestureError::NoDirection)?;
        Ok(Spine { joints, column })
    }

    /// Bends and turns the spine further by a rotation vector in the hips' frame, radians, shared evenly; joints stop
    /// at their ranges, and what an even bend can't express stays.
    pub(crate) fn lean(
        &self,
        pose: &mut Pose,
        before: &Pose,
        by: DVec3,
        ranges: bool,
    ) -> Result<(), GestureError> {
        let mut state = self.recover(before)?;
        let about = self.column.axis();
        state.bend.twist += by.dot(about);
        state.bend.swing += by.reject_from_normalized(about);
        for (joint, local) in self.joints.into_iter().zip(self.column.pose(&state)) {
            turn_to(joint, pose, local, before, ranges);
        }
        Ok(())
    }

    fn recover(&self, pose: &Pose) -> Result<ColumnState<3>, GestureError> {
        let locals = self.joints.map(|joint| joint.rotation(pose.angles(joint.bone)));
        self.column.recover(&locals).map_err(|_| GestureError::NoDirection)
    }
}

/// Turns neck and head, sharing the turn, so that the point between the eyes looks at a world point; the eyes take
/// what the ranges leave.
///
/// # Errors
/// A figure without neck or head, a point at the eyes, numbers that are not finite.
pub fn look_at(figure: &Figure, before: &Pose, at: DVec3, ranges: bool) -> Result<Moved, GestureError> {
    finite(at, "the point to look at")?;
    let (neck, head) = (present(figure, Bone::Neck)?, present(figure, Bone::Head)?);
    check_unlocked(&figure.skeleton, &[Bone::Neck, Bone::Head, Bone::LeftEye, Bone::RightEye])?;
    let gaze = Gaze::new([head.offset, between_eyes(figure)], DVec3::Z, DVec3::Y)
        .map_err(|_| GestureError::NoDirection)?;
    let carrier = neck.carrier.unwrap_or(Bone::Hips);
    let base = frames(figure, before)[carrier].then(Frame::new(DQuat::IDENTITY, neck.offset));
    let locals = [neck, head].map(|joint| joint.rotation(before.angles(joint.bone)));
    let state = gaze.recover(&locals).map_err(|_| GestureError::NoDirection)?;
    let solved = gaze.solve(&state, base.inverse().point(at)).map_err(|_| GestureError::NoDirection)?;
    let mut pose = before.clone();
    for (joint, local) in [neck, head].into_iter().zip(gaze.pose(&solved.state)) {
        turn_to(joint, &mut pose, local, before, ranges);
    }
    let mut clamped = turn_eyes(figure, &mut pose, before, at, ranges);
    clamped |= keep_contacts(figure, before, &mut pose, &[], ranges)?;
    Ok(Moved { pose, clamped })
}

/// The point between the eyes in the head's frame; a typical one if the figure has no eyes.
fn between_eyes(figure: &Figure) -> DVec3 {
    let eye = |bone| figure.skeleton.joint(bone).map(|joint| joint.offset);
    match (eye(Bone::LeftEye), eye(Bone::RightEye)) {
        (Some(left), Some(right)) => (left + right) * 0.5,
        _ => DVec3::new(0.0, 0.07, 0.08),
    }
}

/// Turns each eye at the point as far as it goes; whether one was stopped.
fn turn_eyes(figure: &Figure, pose: &mut Pose, before: &Pose, at: DVec3, ranges: bool) -> bool {
    let in_head = frames(figure, pose)[Bone::Head].inverse().point(at);
    let mut stopped = false;
    for bone in [Bone::LeftEye, Bone::RightEye] {
        let Some(joint) = figure.skeleton.joint(bone) else { continue };
        let Articulation::Hinges(hinges) = &joint.articulation else { continue };
        let [outer, inner] = hinges.as_slice() else { continue };
        let eye = Eye { outer: outer.axis, inner: inner.axis, forward: DVec3::Z };
        let Ok(angles) = eye.angles(in_head - joint.offset) else { continue };
        for (hinge, angle) in hinges.iter().zip(angles) {
            stopped |= stop(pose, before, bone, hinge.dof, hinge.range, angle, ranges);
        }
    }
    stopped
}

/// Turns a ball joint to a rotation as far as its ranges allow; whether one stopped it.
fn turn_to(joint: &Joint, pose: &mut Pose, local: DQuat, before: &Pose, ranges: bool) -> bool {
    let Articulation::Ball { ball, ranges: limits, .. } = &joint.articulation else { return true };
    let mut stopped = false;
    for (dof, angle) in Dof::ALL.into_iter().zip(ball.angles(local)) {
        stopped |= stop(pose, before, joint.bone, dof, limits[dof as usize], angle, ranges);
    }
    stopped
}

fn stop(
    pose: &mut Pose,
    before: &Pose,
    bone: Bone,
    dof: Dof,
    range: Interval,
    angle: f64,
    ranges: bool,
) -> bool {
    let range = if ranges { radians(range.reaching(before.angles(bone).get(dof))) } else { Interval::FREE };
    let held = range.clamp(angle);
    set(pose, bone, dof, held.to_degrees());
    (held - angle).abs() > 1e-10
}
