//! The report of a walk: every step of time, then what it comes to. World space, metres, full `f64` precision.

use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;

use motion::{FootView, Summary};
use rig::Figure;
use serde::Serialize;

use super::stroll::{Moment, Strolled};
use crate::disk::Draft;
use crate::failure::Failure;

/// A step of time.
#[derive(Serialize)]
struct FrameRecord<'a> {
    time: f64,
    weights: &'a BTreeMap<String, f64>,
    hips: [f64; 3],
    joints: BTreeMap<&'static str, JointRecord>,
    feet: FeetRecord,
}

#[derive(Serialize)]
struct JointRecord {
    position: [f64; 3],
    rotation: [f64; 4],
}

#[derive(Serialize)]
struct FeetRecord {
    left: FootRecord,
    right: FootRecord,
}

#[derive(Serialize)]
struct FootRecord {
    sole_points_in_world: Vec<[f64; 3]>,
    ground_under_sole_points: Vec<f64>,
    stance: bool,
    hips_drop: f64,
}

/// What a walk comes to.
#[derive(Serialize)]
struct SummaryRecord {
    penetration_mm: f64,
    float_mm: f64,
    slide_mm: f64,
    pop_deg: f64,
    mean_penetration_mm: f64,
    mean_float_mm: f64,
    swing_penetration_mm: f64,
    /// The largest turn of any joint over its largest on flat ground, which joint's, and when.
    pop_ratio: f64,
    pop_joint: Option<&'static str>,
    pop_time: Option<f64>,
    /// The most that the hips were lowered, metres.
    hips_drop: f64,
    stance_share: f64,
    slides_mm: Vec<f64>,
}

impl SummaryRecord {
    fn of(summary: &Summary, moments: &[Moment]) -> SummaryRecord {
        let time = |(_, frame): (rig::Bone, usize)| moments.get(frame).map(|moment| moment.time);
        SummaryRecord {
            penetration_mm: summary.penetration_mm,
            float_mm: summary.float_mm,
            slide_mm: summary.slide_mm,
            pop_deg: summary.pop_deg,
            mean_penetration_mm: summary.mean_penetration_mm,
            mean_float_mm: summary.mean_float_mm,
            swing_penetration_mm: summary.swing_penetration_mm,
            pop_ratio: summary.pop_ratio,
            pop_joint: summary.popped.map(|(bone, _)| bone.name()),
            pop_time: summary.popped.and_then(time),
            hips_drop: lowered(summary.hips_drop_m[0]),
            stance_share: summary.stance_share,
            slides_mm: summary.slides_mm.clone(),
        }
    }
}

/// How far down, from how far up; never -0.
fn lowered(raised_m: f64) -> f64 {
    0.0 - raised_m
}

/// The summary for people.
pub fn words(summary: &Summary) -> String {
    let Summary { penetration_mm, float_mm, slide_mm, pop_deg, pop_ratio, .. } = summary;
    let joint = summary.popped.map_or_else(String::new, |(bone, _)| format!(" ({bone})"));
    format!(
        "standing soles in the ground   {penetration_mm:7.1} mm at most, {:.1} mm on average\n\
         above it                       {float_mm:7.1} mm at most, {:.1} mm on average\n\
         slid in a step                 {slide_mm:7.1} mm at most\n\
         turn of a joint in a frame     {pop_deg:7.2}° at most, {pop_ratio:.2} times that on flat ground{joint}\n",
        summary.mean_penetration_mm, summary.mean_float_mm
    )
}

/// Whether a report can be written there.
///
/// # Errors
/// It can't: why.
pub fn check(to: &Path) -> Result<(), Failure> {
    // What is begun and not finished leaves nothing.
    if to == Path::new("-") { Ok(()) } else { Draft::begin(to).map(drop) }
}

/// Writes the report into a file, or to standard output for "-": a line for each step of time.
///
/// # Errors
/// A file that can't be written.
pub fn write(figure: &Figure, strolled: &Strolled, to: &Path) -> Result<(), Failure> {
    if to == Path::new("-") {
        let mut text = Vec::new();
        return match lines(figure, strolled, &mut text) {
            Ok(()) => crate::cli::print(&String::from_utf8_lossy(&text)),
            Err(e) => Err(Failure::Input(format!("standard output: {e}"))),
        };
    }
    let mut draft = std::io::BufWriter::new(Draft::begin(to)?);
    lines(figure, strolled, &mut draft).map_err(|e| Draft::fault(to, &e))?;
    draft.into_inner().map_err(|e| Draft::fault(to, e.error()))?.finish()
}

fn lines(figure: &Figure, strolled: &Strolled, to: &mut impl Write) -> std::io::Result<()> {
    for (i, moment) in strolled.moments.iter().enumerate() {
        to.write_all(if i == 0 { b"{\"frames\": [\n" } else { b",\n" })?;
        serde_json::to_writer(&mut *to, &frame(figure, moment))?;
    }
    to.write_all(b"\n],\n\"summary\": ")?;
    serde_json::to_writer(&mut *to, &SummaryRecord::of(&strolled.summary, &strolled.moments))?;
    to.write_all(b"}\n")
}

fn frame<'a>(figure: &Figure, moment: &'a Moment) -> FrameRecord<'a> {
    let frames = rig::frames(figure, &moment.pose);
    let joint = |joint: &rig::Joint| {
        let at = &frames[joint.bone];
        let record = JointRecord { position: at.position.to_array(), rotation: at.rotation.to_array() };
        (joint.bone.name(), record)
    };
    let [left, right] = &moment.feet;
    FrameRecord {
        time: moment.time,
        weights: &moment.weights,
        hips: frames[rig::Bone::Hips].position.to_array(),
        joints: figure.skeleton.joints().map(joint).collect(),
        feet: FeetRecord { left: foot(left), right: foot(right) },
    }
}

fn foot(view: &FootView) -> FootRecord {
    FootRecord {
        sole_points_in_world: view.sole_in_world.iter().map(|p| p.to_array()).collect(),
        ground_under_sole_points: view.ground_under_sole.clone(),
        stance: view.stance,
        hips_drop: lowered(view.hips_drop),
    }
}
