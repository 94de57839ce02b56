//! The gaze: where the eyes look, and both eyes turned as one.

use glam::DVec3;
use rig::{Bone, Dof, Evaluation, Figure, Pose};

use crate::{By, Command};

/// The point between the eyes, metres, world; the head's joint for a figure without eyes.
pub fn eye_point(evaluation: &Evaluation) -> DVec3 {
    let eye = |bone| evaluation.frames[bone].position;
    (eye(Bone::LeftEye) + eye(Bone::RightEye)) * 0.5
}

/// The point that the eyes look at, at a distance in metres; straight ahead of the head where they look opposite ways.
pub fn gaze_point(evaluation: &Evaluation, distance_m: f64) -> DVec3 {
    let along = |bone| evaluation.frames[bone].rotation * DVec3::Z;
    let ahead = (along(Bone::LeftEye) + along(Bone::RightEye)).normalize_or(along(Bone::Head));
    eye_point(evaluation) + ahead * distance_m
}

/// An angle of both eyes as one, degrees: how far they look down (flexion) or to the figure's left (twist), in the mean. `None`
/// for a figure whose eyes lack it.
pub fn eyes(figure: &Figure, pose: &Pose, dof: Dof) -> Option<f64> {
    let has = |bone| figure.skeleton.joint(bone).is_some_and(|joint| joint.has(dof));
    let [left, right] = [Bone::LeftEye, Bone::RightEye].map(|bone| pose.angles(bone).get(dof));
    (has(Bone::LeftEye) && has(Bone::RightEye)).then_some((left + sense(dof) * right) * 0.5)
}

/// The turns that bring both eyes to an angle together; how far they squint is kept.
pub fn set_eyes(figure: &Figure, pose: &Pose, dof: Dof, degrees: f64) -> Vec<Command> {
    let Some(now) = eyes(figure, pose, dof) else { return Vec::new() };
    let by = degrees - now;
    [(Bone::LeftEye, 1.0), (Bone::RightEye, sense(dof))]
        .into_iter()
        .map(|(joint, sense)| {
            let degrees = pose.angles(joint).get(dof) + sense * by;
            Command::Turn { joint, dof, degrees, by: By::To }
        })
        .collect()
}

/// The right eye mirrors the left: the same number of twist or abduction looks the other way.
fn sense(dof: Dof) -> f64 {
    if dof == Dof::Flexion { 1.0 } else { -1.0 }
}
