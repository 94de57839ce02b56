//! What is measured of a clip's feet on flat ground.

use glam::DVec3;
use motion::{FittedClip, Sample, Sole, Soles};
use rig::{Figure, frames};

/// What a clip does with its feet on flat ground.
#[derive(Clone, Copy, Debug, Default)]
pub struct Feet {
    /// The largest horizontal way of a sole's point from where it was first in a stance of the whole sole, metres.
    pub slide_m: f64,
    /// The largest way of the heel while it bears, and of the ball while it does.
    pub heel_m: f64,
    pub ball_m: f64,
    /// How deep a point comes under the ground at any time.
    pub sink_m: f64,
    /// How high the highest point of a whole sole that stands is.
    pub float_m: f64,
    /// The part of the time that a whole sole stands.
    pub standing: f64,
}

/// Measures two lengths of a clip, 240 times a second.
pub fn feet(clip: &FittedClip, figure: &Figure) -> Feet {
    let soles = Soles::of(figure).unwrap();
    let mut pose = figure.rest_pose();
    let mut sample = Sample::at_rest(figure);
    let mut found = Feet::default();
    let mut starts: [[Option<DVec3>; Sole::COUNT]; 2] = Default::default();
    let mut bears: [[Option<DVec3>; 2]; 2] = Default::default();
    let lengths = if clip.loops() { 2.0 } else { 1.0 };
    let count = (clip.length_secs() * 240.0 * lengths) as usize;
    for i in 0..count {
        let phase = i as f64 / count as f64 * lengths;
        clip.sample(phase, &mut sample);
        sample.write_to(&mut pose);
        pose.place = clip.travel().place_after(phase * clip.length_secs());
        let frames = frames(figure, &pose);
        for (side, sole) in soles.feet.iter().enumerate() {
            let points = sole.points(&frames);
            let bearing = sample.bearing[side];
            let stands = bearing.heel > 0.5 && bearing.ball > 0.5;
            found.standing += if stands { 0.5 / count as f64 } else { 0.0 };
            for (k, p) in points.into_iter().enumerate() {
                found.sink_m = found.sink_m.max(-p.y);
                if stands {
                    found.float_m = found.float_m.max(p.y);
                }
                found.slide_m = found.slide_m.max(way(&mut starts[side][k], stands, p));
            }
            let heel = way(&mut bears[side][0], bearing.heel > 0.5, points[Sole::HEEL]);
            let ball = way(&mut bears[side][1], bearing.ball > 0.5, points[Sole::BALL]);
            (found.heel_m, found.ball_m) = (found.heel_m.max(heel), found.ball_m.max(ball));
        }
    }
    found
}

fn way(start: &mut Option<DVec3>, stands: bool, p: DVec3) -> f64 {
    *start = if stands { start.or(Some(p)) } else { None };
    start.map_or(0.0, |start| (p.x - start.x).hypot(p.z - start.z))
}
