//! Pictures of a walk: the figure and the ground, the camera going along.

use std::path::Path;

use glam::Vec3;
use motion::Ground;
use rig::Pose;

use super::WalkArguments;
use super::stroll::{Stroll, Strolled};
use crate::failure::Failure;
use crate::picture::{Darkroom, Moment, Shot, Subject, Underfoot, Work, following, smoothed};

/// Of so many frames at most the figure's box is taken to find where the camera stands.
const BOXES: usize = 48;
/// Where the camera stands unless another view is told: from the right, where the light comes from and neither what rises
/// ahead nor what rises behind hides the feet.
const YAW_DEG: f32 = -68.0;
const PITCH_DEG: f32 = 13.0;
/// The camera doesn't follow what comes and goes within so long, seconds.
const CALM_SECS: f64 = 0.8;

/// Whether the output suits several frames, or one.
///
/// # Errors
/// It doesn't: why, and what would.
pub fn check(told: &WalkArguments, output: &Path) -> Result<(), Failure> {
    let order = told.shot.order(String::new(), Vec::new(), output, told.fps)?;
    order.check_for(told.frames().len())
}

/// Draws the walk.
///
/// # Errors
/// Files that can't be written, a driver that complains, the user has stopped it.
pub fn draw(
    told: &WalkArguments,
    stroll: &Stroll,
    strolled: &Strolled,
    output: &Path,
) -> Result<(), Failure> {
    let poses: Vec<&Pose> = told
        .frames()
        .into_iter()
        .filter_map(|i| strolled.moments.get(i))
        .map(|moment| &moment.pose)
        .collect();
    let moments = moments(told, stroll, &poses);
    let title = format!("walk on {}", told.ground);
    let order = told.shot.order(title, moments, output, told.fps)?;
    order.carry_out(&mut Darkroom::open()?, &Work::on_terminal())
}

fn moments(told: &WalkArguments, stroll: &Stroll, poses: &[&Pose]) -> Vec<Moment> {
    let rest_height = stroll.figure.rest_pose().hips.y;
    let place = |pose: &&Pose| {
        let at = pose.place.position;
        Vec3::new(at.x as f32, (at.y + pose.hips.y - rest_height) as f32, at.z as f32)
    };
    let anchors: Vec<Vec3> = poses.iter().map(place).collect();
    let anchors = smoothed(&anchors, (CALM_SECS * f64::from(told.fps) / 2.0).round() as usize);
    let subject = |pose: &Pose, underfoot| Subject::of_pose(&stroll.figure, pose, underfoot);
    let stride = poses.len().div_ceil(BOXES).max(1);
    let boxes = (0..poses.len()).step_by(stride).map(|i| (i, subject(poses[i], None).bounds()));
    let aspect = Shot::new(told.shot.size()).aspect();
    let cameras = following(&told.shot.viewpoint_or(YAW_DEG, PITCH_DEG), &anchors, boxes, aspect);
    let mut underfoot = None;
    let moment = |(pose, camera): (&&Pose, rig::Camera)| {
        let (place, distance) = (pose.place.position, f64::from(camera.distance));
        let patch = patch_for(underfoot.take(), &stroll.ground, place, distance, told.shot.is_bright());
        underfoot = Some(patch.clone());
        Moment { subject: subject(pose, Some(patch)), camera }
    };
    poses.iter().zip(cameras).map(moment).collect()
}

fn patch_for(
    former: Option<Underfoot>,
    ground: &Ground,
    place: glam::DVec3,
    distance: f64,
    bright: bool,
) -> Underfoot {
    match former {
        Some(former) => former.following(ground, place, distance, bright),
        None => Underfoot::around(ground, place, distance, bright),
    }
}
