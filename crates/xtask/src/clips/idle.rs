//! Standing at ease: breath, and weight that goes from foot to foot.

use glam::DVec2;

use super::carriage::{Arm, Hips, Trunk};
use super::curve::Curve;
use super::motion::Motion;
use super::path::Path;
use super::step::Step;

/// Staying in one place.
pub const STILL: Path = Path { velocity: DVec2::ZERO, turn_rate: 0.0 };

/// Standing at ease: one breath and one shift of weight in 5 s, feet still.
pub fn idle() -> Motion {
    let arm = |own: f64| Arm {
        swing: Curve::waves(1.0, &[(1.0, 1.2, 0.42 + own), (2.0, 0.4, 0.1)]),
        out: Curve::waves(8.5, &[(1.0, 0.9, 0.46), (2.0, 0.3, own)]),
        inward: Curve::waves(20.0, &[(1.0, 1.5, 0.5 + own)]),
        elbow: Curve::waves(17.0, &[(1.0, 1.6, 0.48 + own), (2.0, 0.4, 0.3)]),
        palm: Curve::waves(-36.0, &[(1.0, 1.5, 0.3 + own)]),
        wrist: Curve::waves(5.0, &[(1.0, 1.5, 0.6 + own)]),
        collar: Curve::waves(0.0, &[(1.0, 0.8, 0.5)]),
        shrug: Curve::waves(-1.0, &[(1.0, 1.3, 0.44)]),
    };
    Motion {
        name: "idle",
        length_secs: 5.0,
        loops: true,
        stride: false,
        path: STILL,
        hips: Hips {
            aside: Curve::waves(0.004, &[(1.0, 0.016, 0.25), (2.0, 0.002, 0.1)]),
            height: Curve::waves(0.9350, &[(2.0, 0.0012, 0.0), (1.0, 0.0008, 0.4)]),
            ahead: Curve::waves(0.006, &[(1.0, 0.003, 0.6), (2.0, 0.0015, 0.2)]),
            tilt: Curve::waves(1.0, &[(1.0, 0.4, 0.4)]),
            list: Curve::waves(-0.3, &[(1.0, -1.7, 0.25)]),
            turn: Curve::waves(0.5, &[(1.0, 1.4, 0.33)]),
        },
        trunk: Trunk {
            bend: Curve::waves(0.5, &[(1.0, -1.6, 0.42), (2.0, 0.3, 0.1)]),
            list: Curve::waves(0.3, &[(1.0, 1.9, 0.27)]),
            turn: Curve::waves(-0.5, &[(1.0, -1.0, 0.38)]),
            nod: Curve::waves(2.0, &[(1.0, 1.0, 0.9), (2.0, 0.4, 0.2)]),
            head_list: Curve::waves(0.0, &[(1.0, 0.8, 0.35)]),
            gaze: Curve::waves(1.0, &[(1.0, 2.0, 0.55), (2.0, 0.6, 0.8)]),
        },
        arms: [arm(0.0), arm(0.08)],
        steps: [standing(DVec2::new(0.098, -0.002), 8.0), standing(DVec2::new(0.094, 0.006), 8.0)],
        least_knee: 5.0,
        keys: 40,
    }
}

/// A foot that stays where it is.
pub fn standing(print: DVec2, out_turn: f64) -> Step {
    Step {
        print,
        out_turn,
        middle: 0.0,
        lift: 1.0,
        pitch: Curve::constant(0.0),
        toes_down: Curve::constant(0.0),
        heights: Vec::new(),
        detour: DVec2::ZERO,
        brake: DVec2::ZERO,
        sole_in: 0.0,
    }
}
