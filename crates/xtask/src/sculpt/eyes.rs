//! The eyeballs: balls of rings about the line of sight, so that iris and pupil have sharp rims.

use glam::DVec3;
use rig::{Bone, Skeleton};

use super::head::{EYE, EYE_RADIUS, head_fit};
use super::nets::Surface;
use super::paint::{EYE_WHITE, IRIS, IRIS_HEART, IRIS_RIM, PUPIL};

/// Points around a ring.
const AROUND: usize = 28;

/// Rings from the front pole: cosine and sine of the angle off the line of sight, colour.
fn rings() -> Vec<(f64, DVec3)> {
    // Sines: the iris has a radius of 6 mm, the pupil of 2.4 mm on a ball of 13.6 mm.
    let front = [
        (0.10, PUPIL),
        (0.175, PUPIL),
        (0.185, IRIS_HEART),
        (0.27, IRIS_HEART),
        (0.33, IRIS),
        (0.405, IRIS),
        (0.425, IRIS_RIM),
        (0.450, IRIS_RIM),
        (0.475, EYE_WHITE),
        (0.60, EYE_WHITE),
        (0.75, EYE_WHITE),
        (0.88, EYE_WHITE),
        (0.97, EYE_WHITE),
    ];
    front.to_vec()
}

/// The left eyeball: surface, normals and colours; nothing if the skeleton has no eyes.
pub fn left(skeleton: &Skeleton) -> Option<(Surface, Vec<DVec3>, Vec<DVec3>)> {
    skeleton.joint(Bone::LeftEye)?;
    let fit = head_fit(skeleton);
    let (center, radius) = (fit.point(EYE), EYE_RADIUS * fit.girth());
    let front = rings();
    let back = [0.85, 0.5].map(|s| (s, EYE_WHITE));
    let heights = front.iter().map(|(s, c)| (*s, (1.0 - s * s).sqrt(), *c));
    let behind = back.iter().map(|(s, c)| (*s, -(1.0f64 - s * s).sqrt(), *c));
    let mut normals = vec![DVec3::Z];
    let mut colors = vec![PUPIL];
    for (sine, cosine, color) in heights.chain(behind) {
        for (x, y) in circle() {
            normals.push(DVec3::new(x * sine, y * sine, cosine));
            colors.push(color);
        }
    }
    normals.push(-DVec3::Z);
    colors.push(EYE_WHITE);
    let points = normals.iter().map(|n| center + *n * radius).collect();
    let count = front.len() + back.len();
    Some((Surface { points, triangles: triangles(count) }, normals, colors))
}

/// Points of the unit circle by repeated turning, without calls whose last bit differs between machines.
fn circle() -> Vec<(f64, f64)> {
    // Cosine and sine of a 28th of a turn.
    let (c, s) = (0.974_927_912_181_823_6, 0.222_520_933_956_314_4);
    let mut at = (1.0, 0.0);
    let mut all = Vec::with_capacity(AROUND);
    for _ in 0..AROUND {
        all.push(at);
        at = (at.0 * c - at.1 * s, at.0 * s + at.1 * c);
    }
    all
}

fn triangles(rings: usize) -> Vec<[u32; 3]> {
    let at = |ring: usize, i: usize| (1 + ring * AROUND + i % AROUND) as u32;
    let last = (1 + rings * AROUND) as u32;
    let mut all = Vec::new();
    for i in 0..AROUND {
        all.push([0, at(0, i), at(0, i + 1)]);
        for ring in 0..rings - 1 {
            all.push([at(ring, i), at(ring + 1, i), at(ring + 1, i + 1)]);
            all.push([at(ring, i), at(ring + 1, i + 1), at(ring, i + 1)]);
        }
        all.push([at(rings - 1, i), last, at(rings - 1, i + 1)]);
    }
    all
}
