//! Colours of the mannequin: warm clay, a little deeper in the hollows; lips and nails a shade apart.

use glam::DVec3;
use rig::Skeleton;

use super::blend::{ease, mix};
use super::field::Lookup;
use super::fit::figure_scale;
use super::hand::{FINGERS, fingertip, nail_share};
use super::head::{EYE, EYE_RADIUS, head_fit};

/// Linear colours.
const CLAY: DVec3 = DVec3::new(0.640, 0.462, 0.362);
const WARM: DVec3 = DVec3::new(0.640, 0.400, 0.310);
const COOL: DVec3 = DVec3::new(0.600, 0.455, 0.375);
const HOLLOW: DVec3 = DVec3::new(0.440, 0.245, 0.175);
const LIPS: DVec3 = DVec3::new(0.520, 0.265, 0.215);
const MOUTH: DVec3 = DVec3::new(0.200, 0.078, 0.062);
const NAIL: DVec3 = DVec3::new(0.700, 0.490, 0.400);
const BROW: DVec3 = DVec3::new(0.330, 0.215, 0.155);
const LASH: DVec3 = DVec3::new(0.170, 0.100, 0.075);
const CORNER: DVec3 = DVec3::new(0.520, 0.270, 0.225);
/// The height where the lips meet in the middle, as drawn.
const SEAM: f64 = 1.5461;
/// White of the eye, iris and its rim, pupil.
pub const EYE_WHITE: DVec3 = DVec3::new(0.720, 0.690, 0.650);
/// The iris near the pupil and farther out.
pub const IRIS_HEART: DVec3 = DVec3::new(0.150, 0.088, 0.048);
/// The iris.
pub const IRIS: DVec3 = DVec3::new(0.098, 0.064, 0.042);
/// The dark ring around the iris.
pub const IRIS_RIM: DVec3 = DVec3::new(0.040, 0.030, 0.026);
/// The pupil.
pub const PUPIL: DVec3 = DVec3::new(0.006, 0.006, 0.008);

/// The colour of a point of the left half of the skin.
pub fn skin(skeleton: &Skeleton, field: &Lookup<'_>, p: DVec3, normal: DVec3) -> DVec3 {
    let nail = nails(skeleton, p);
    let shut = closeness(field, p, normal, figure_scale(skeleton)) * (1.0 - nail);
    let head = head_fit(skeleton);
    let drawn = DVec3::from(EYE) + (p - head.point(EYE)) / head.girth();
    // The renderer darkens hollows, too: here they only turn warmer.
    let mut color = tone(skeleton, drawn, p).lerp(HOLLOW, 0.42 * shut);
    color = color.lerp(LIPS, 0.60 * lips(drawn));
    color = color.lerp(BROW, 0.42 * brow(drawn));
    color = color.lerp(LASH, lashes(drawn)).lerp(CORNER, 0.8 * corner(drawn));
    color = color.lerp(MOUTH, 0.55 * ease(0.0022, 0.0, (drawn.y - seam(drawn)).abs()) * lips(drawn));
    color.lerp(NAIL, 0.8 * nail)
}

/// Clay with the blood nearer under cheeks, nose, ears, knuckles and finger ends, and a cooler brow.
fn tone(skeleton: &Skeleton, drawn: DVec3, p: DVec3) -> DVec3 {
    let spot = |at: [f64; 3], reach: f64, q: DVec3| ease(reach, 0.0, q.distance(DVec3::from(at)));
    let face = 0.55 * spot([0.042, 1.578, 0.082], 0.030, drawn)
        + 0.55 * spot([0.0, 1.577, 0.120], 0.020, drawn)
        + 0.30 * spot([0.0, 1.508, 0.105], 0.022, drawn)
        + 0.60 * spot([0.072, 1.590, -0.015], 0.042, drawn) * ease(0.066, 0.073, drawn.x);
    let g = figure_scale(skeleton);
    let reddest = |finger: usize| {
        let near = |at: DVec3, reach: f64| ease(reach * g, 0.0, p.distance(at));
        let [_, middle, last] = FINGERS[finger].map(|bone| skeleton.rest_position(bone));
        let tip = fingertip(skeleton, finger);
        (0.6 * near(tip, 0.014)).max(0.35 * near(middle, 0.012)).max(0.25 * near(last, 0.010))
    };
    let hand = (0..5).map(reddest).fold(0.0, f64::max);
    let cool = 0.5 * spot([0.0, 1.665, 0.095], 0.055, drawn);
    CLAY.lerp(WARM, (face + hand).min(1.0)).lerp(COOL, cool)
}

/// 0 in the open to 1 in a hollow: how much nearer the skin is along the normal than over open ground.
fn closeness(field: &Lookup<'_>, p: DVec3, normal: DVec3, scale: f64) -> f64 {
    let mut shut = 0.0;
    for (reach, weight) in [(0.003, 0.30), (0.007, 0.30), (0.015, 0.25), (0.030, 0.15)] {
        let far = reach * scale;
        shut += weight * (1.0 - field.value(p + normal * far) / far).clamp(0.0, 1.0);
    }
    shut.min(1.0)
}

/// The height of the line between the lips, as sculpted.
fn seam(p: DVec3) -> f64 {
    let x = p.x.abs();
    SEAM + 0.0006 * ease(0.0, 0.006, x) + 0.0017 * ease(0.012, 0.0235, x)
}

fn lips(p: DVec3) -> f64 {
    if p.z < 0.085 {
        return 0.0;
    }
    let x = p.x.abs();
    let along = x / 0.0240;
    let fall = (1.0 - along * along).max(0.0);
    // Above, the bow: a dip in the middle between two peaks.
    let bow = 0.0078 * fall + 0.0012 * ease(0.0, 0.0055, x) * fall - 0.0012;
    let height = if p.y > seam(p) { bow } else { 0.0098 * fall.sqrt().min(1.0) * mix(0.72, 1.0, fall) };
    ease(0.0010, -0.0012, (p.y - seam(p)).abs() - height) * ease(1.02, 0.92, along)
}

/// The lids' edges: dark above the eye, faint below, none at the inner corner.
fn lashes(p: DVec3) -> f64 {
    let d = p - DVec3::from(EYE);
    let edge = ease(0.0017, 0.0007, d.length() - EYE_RADIUS) * ease(0.003, 0.006, d.z);
    edge * mix(0.22, 0.85, ease(-0.002, 0.001, d.y)) * ease(-0.0100, -0.0060, d.x)
}

/// The moist inner corner of the eye.
fn corner(p: DVec3) -> f64 {
    let d = p - DVec3::from(EYE);
    ease(0.0050, 0.0028, d.distance(DVec3::new(-0.0122, -0.0023, 0.0060)))
}

fn brow(p: DVec3) -> f64 {
    if p.z < 0.06 {
        return 0.0;
    }
    let x = p.x.abs();
    let line = 1.6305 + 0.0040 * ease(0.014, 0.038, x) - 0.0060 * ease(0.038, 0.056, x);
    let half = mix(0.0027, 0.0012, ease(0.020, 0.055, x));
    ease(half + 0.0016, half - 0.0010, (p.y - line).abs()) * ease(0.0115, 0.0190, x) * ease(0.0560, 0.0460, x)
}

fn nails(skeleton: &Skeleton, p: DVec3) -> f64 {
    (0..5).map(|finger| nail_share(skeleton, finger, p)).fold(0.0, f64::max)
}
