//! Which feet stand, and how firmly: recovered from the motion of their soles over flat ground.

use glam::DVec3;
use rig::Place;

use crate::refit::Standing;
use crate::{Bearing, Sample, Sole};

/// Up to here above the ground a point bears wholly, from there on not at all: parts of the foot's length.
const HEIGHTS: (f64, f64) = (0.01, 0.05);
/// Up to so fast a point bears wholly, from there on not at all: metres a second for a leg of the height below.
const SPEEDS: (f64, f64) = (0.15, 0.60);
/// The height of leg for which the speeds hold, metres; others by its root, as speeds of walking go.
const LEG_HEIGHT_M: f64 = 0.92;

/// Where heel and ball of a foot are over the ground that the figure goes over: places in the world, heights of the
/// lowest of each.
#[derive(Clone, Copy)]
struct Soles {
    points: [DVec3; 2],
    heights: [f64; 2],
}

/// Fills in the bearing of samples that are `step_secs` apart; `root` tells where the figure is at each, in a loop also
/// one before the first and at the one after the last.
pub(crate) fn fill_bearing(
    samples: &mut [Sample],
    standing: &Standing,
    loops: bool,
    step_secs: f64,
    root: impl Fn(isize) -> Place,
) {
    let count = samples.len() as isize;
    let within = |i: isize| if loops { i.rem_euclid(count) } else { i.clamp(0, count - 1) };
    for side in 0..2 {
        let at = |i: isize| soles(standing, side, root(i), &samples[within(i) as usize]);
        let raw: Vec<[f64; 2]> = (0..count)
            .map(|i| {
                let [before, after] = [i - 1, i + 1].map(|k| if loops { k } else { within(k) });
                let secs = (after - before).max(1) as f64 * step_secs;
                bearing(standing, side, &at(i), &at(before), &at(after), secs)
            })
            .collect();
        let smooth = |i: isize, part: usize| {
            let taps = [(-2, 1.0), (-1, 4.0), (0, 6.0), (1, 4.0), (2, 1.0)];
            taps.iter().map(|(k, weight)| raw[within(i + k) as usize][part] * weight / 16.0).sum()
        };
        for i in 0..count {
            samples[i as usize].bearing[side] = Bearing { heel: smooth(i, 0), ball: smooth(i, 1) };
        }
    }
}

fn soles(standing: &Standing, side: usize, root: Place, sample: &Sample) -> Soles {
    let world_from_figure = root.world_from_figure();
    let sole = standing.sole(side, sample).map(|p| world_from_figure.point(p));
    let lowest = |from: usize| sole[from..from + 3].iter().map(|p| p.y).fold(f64::INFINITY, f64::min);
    Soles { points: [sole[Sole::HEEL], sole[Sole::BALL]], heights: [lowest(Sole::HEEL), lowest(Sole::BALL)] }
}

/// How firmly heel and ball stand, given where they are and were and will be, `secs` apart.
fn bearing(
    standing: &Standing,
    side: usize,
    now: &Soles,
    before: &Soles,
    after: &Soles,
    secs: f64,
) -> [f64; 2] {
    let length_m = standing.soles.feet[side].length_m;
    let pace = (standing.leg_height_m / LEG_HEIGHT_M).sqrt();
    std::array::from_fn(|k| {
        let speed = before.points[k].distance(after.points[k]) / secs / pace;
        fade(now.heights[k] / length_m, HEIGHTS) * fade(speed, SPEEDS)
    })
}

/// 1 up to the first edge, 0 from the second, smooth between.
fn fade(value: f64, (from, to): (f64, f64)) -> f64 {
    let u = ((value - from) / (to - from)).clamp(0.0, 1.0);
    1.0 - u * u * (3.0 - 2.0 * u)
}
