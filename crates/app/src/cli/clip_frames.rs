//! `render` of a clip: which of its frames, and what each shows.

use std::ops::RangeInclusive;
use std::sync::Arc;

use glam::Vec3;
use motion::FittedClip;
use rig::{Figure, Pose};

use super::pictures::MOST_FRAMES;
use crate::load;
use crate::picture::{Moment, Subject, Viewpoint, following};

/// Some frames of a clip: from the first to the last, both included; 0 is how it begins.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct FrameSpan(RangeInclusive<u64>);

impl FrameSpan {
    /// The clip's beginning alone.
    pub fn first() -> FrameSpan {
        FrameSpan(0..=0)
    }

    /// All frames of a clip, so many a second: of a loop each once.
    pub fn whole(clip: &FittedClip, fps: u32) -> FrameSpan {
        let frames = (clip.length_secs() * f64::from(fps)).round() as u64;
        let last = if clip.loops() { frames.saturating_sub(1) } else { frames };
        FrameSpan(0..=last.min(MOST_FRAMES - 1))
    }
}

impl std::str::FromStr for FrameSpan {
    type Err = String;

    fn from_str(text: &str) -> Result<FrameSpan, String> {
        let number = |part: &str| part.parse::<u64>().ok();
        let span = match text.split_once("..") {
            Some((first, last)) => number(first).zip(number(last)),
            None => number(text).map(|frame| (frame, frame)),
        };
        let (first, last) =
            span.filter(|(first, last)| first <= last && last - first < MOST_FRAMES).ok_or_else(|| {
                format!("expected A..B or one number, A no more than B, at most {MOST_FRAMES} frames")
            })?;
        Ok(FrameSpan(first..=last))
    }
}

/// What those frames show, so many a second, the camera going along with the figure.
pub fn moments(
    figure: &Arc<Figure>,
    clip: &FittedClip,
    span: &FrameSpan,
    fps: u32,
    viewpoint: &Viewpoint,
    aspect: f32,
) -> Vec<Moment> {
    let secs = span.0.clone().map(|frame| frame as f64 / f64::from(fps.max(1)));
    let poses: Vec<Pose> = secs.map(|secs| load::pose_at(figure, clip, secs)).collect();
    let subjects: Vec<Subject> = poses.iter().map(|pose| Subject::of_pose(figure, pose, None)).collect();
    let anchor = |pose: &Pose| pose.place.position.as_vec3() * Vec3::new(1.0, 0.0, 1.0);
    let anchors: Vec<Vec3> = poses.iter().map(anchor).collect();
    let boxes = subjects.iter().map(Subject::bounds).enumerate();
    let cameras = following(viewpoint, &anchors, boxes, aspect);
    subjects.into_iter().zip(cameras).map(|(subject, camera)| Moment { subject, camera }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_are_read_and_bad_ones_told() {
        assert_eq!("3..7".parse(), Ok(FrameSpan(3..=7)));
        assert_eq!("12".parse(), Ok(FrameSpan(12..=12)));
        for bad in ["", "..", "7..3", "-1..4", "a..b", "0..99999999", "1..2..3"] {
            assert!(bad.parse::<FrameSpan>().is_err(), "{bad}");
        }
    }
}
