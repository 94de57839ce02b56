//! Colours of the mannequin: warm clay, a little deeper in the hollows; lips and nails a shade apart.

use glam::DVec3;
use rig::Skeleton;

use super::blend::{ease, mix};
use super::field::Lookup;
use super::fit::figure_scale;
use super::hand::{FINGERS, fingertip, nail_side};
use super::head::{EYE, EYE_RADIUS, head_fit};

/// Linear colours.
const CLAY: DVec3 = DVec3::new(0.640, 0.470, 0.365);
const HOLLOW: DVec3 = DVec3::new(0.400, 0.235, 0.165);
const LIPS: DVec3 = DVec3::new(0.520, 0.265, 0.215);
const MOUTH: DVec3 = DVec3::new(0.160, 0.060, 0.048);
const NAIL: DVec3 = DVec3::new(0.730, 0.540, 0.445);
const BROW: DVec3 = DVec3::new(0.330, 0.205, 0.145);
const LASH: DVec3 = DVec3::new(0.150, 0.085, 0.060);
/// The height where the lips meet in the middle, as drawn.
const SEAM: f64 = 1.5467;
/// White of the eye, iris and its rim, pupil.
pub const EYE_WHITE: DVec3 = DVec3::new(0.800, 0.780, 0.740);
/// The iris.
pub const IRIS: DVec3 = DVec3::new(0.120, 0.165, 0.175);
/// The dark ring around the iris.
pub const IRIS_RIM: DVec3 = DVec3::new(0.035, 0.045, 0.050);
/// The pupil.
pub const PUPIL: DVec3 = DVec3::new(0.006, 0.006, 0.008);

/// The colour of a point of the left half of the skin.
pub fn skin(skeleton: &Skeleton, field: &Lookup<'_>, p: DVec3, normal: DVec3) -> DVec3 {
    let nail = nails(skeleton, p);
    let shut = closeness(field, p, normal, figure_scale(skeleton)) * (1.0 - nail);
    let mut color = CLAY.lerp(HOLLOW, 0.75 * shut);
    let head = head_fit(skeleton);
    let drawn = DVec3::from(EYE) + (p - head.point(EYE)) / head.girth();
    color = color.lerp(LIPS, 0.75 * lips(drawn));
    color = color.lerp(BROW, 0.45 * brow(drawn));
    color = color.lerp(LASH, lashes(drawn));
    color = color.lerp(MOUTH, 0.55 * ease(0.0022, 0.0, (drawn.y - seam(drawn)).abs()) * lips(drawn));
    color.lerp(NAIL, 0.8 * nail)
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

/// The height of the line between the lips: the corners a little up.
fn seam(p: DVec3) -> f64 {
    SEAM + 0.0010 * (p.x * p.x) / (0.0225 * 0.0225)
}

fn lips(p: DVec3) -> f64 {
    if p.z < 0.085 {
        return 0.0;
    }
    let along = p.x.abs() / 0.0245;
    let bow = 0.0012 * ease(0.008, 0.003, p.x.abs()) * ease(0.0, 0.003, p.x.abs());
    let fall = (1.0 - along * along).max(0.0);
    let height = if p.y > seam(p) { 0.0070 * fall + bow } else { 0.0092 * fall };
    ease(0.0012, -0.0012, (p.y - seam(p)).abs() - height) * ease(1.03, 0.94, along)
}

/// The lids' edges: dark above the eye, faint below.
fn lashes(p: DVec3) -> f64 {
    let d = p - DVec3::from(EYE);
    let edge = ease(0.0021, 0.0009, d.length() - EYE_RADIUS) * ease(0.004, 0.007, d.z);
    edge * mix(0.30, 0.85, ease(-0.002, 0.001, d.y))
}

fn brow(p: DVec3) -> f64 {
    if p.z < 0.06 {
        return 0.0;
    }
    let x = p.x.abs();
    let line = 1.6285 + 0.0055 * ease(0.012, 0.038, x) - 0.0060 * ease(0.038, 0.056, x);
    let half = mix(0.0035, 0.0012, ease(0.020, 0.055, x));
    ease(half + 0.0016, half - 0.0010, (p.y - line).abs()) * ease(0.010, 0.0145, x) * ease(0.0560, 0.0490, x)
}

fn nails(skeleton: &Skeleton, p: DVec3) -> f64 {
    let g = figure_scale(skeleton);
    (0..5)
        .map(|finger| {
            let last = skeleton.rest_position(FINGERS[finger][2]);
            let tip = fingertip(skeleton, finger);
            let along = (tip - last).normalize_or(DVec3::X);
            let up = nail_side(finger, along);
            let d = p - last.lerp(tip, 0.66);
            let size = if finger == 0 { 1.3 } else { 1.0 } * g;
            let (u, v) = (d.dot(along) / (0.0066 * size), d.dot(along.cross(up)) / (0.0048 * size));
            let out = ease(0.0015 * g, 0.0030 * g, d.dot(up));
            ease(1.1, 0.85, (u * u * u * u + v * v * v * v).sqrt().sqrt()) * out
        })
        .fold(0.0, f64::max)
}
