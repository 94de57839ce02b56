//! Steps to the side, and round on the spot.

use glam::DVec2;

use super::carriage::{Arm, Hips, Trunk};
use super::curve::Curve;
use super::idle;
use super::motion::Motion;
use super::path::Path;
use super::step::Step;

/// To the left at 0.8 m/s, the left foot stepping out and the right one closing up.
pub fn strafe() -> Motion {
    let mut motion = on_the_spot("strafe-left");
    motion.length_secs = 0.66;
    motion.least_knee = 18.0;
    motion.path = Path { velocity: DVec2::new(0.8, 0.0), turn_rate: 0.0 };
    // The leading foot lands heel and outer edge first, the trailing one pushes off with the ball.
    let step = |leads: bool| Step {
        print: DVec2::new(0.18, if leads { 0.015 } else { -0.015 }),
        out_turn: 5.0,
        middle: 0.29,
        lift: 0.58,
        pitch: Curve::cyclic(&[
            (0.0, if leads { 3.0 } else { -5.0 }),
            (0.08, 0.0),
            (0.38, 0.0),
            (0.50, if leads { -6.0 } else { -12.0 }),
            (0.58, if leads { -14.0 } else { -24.0 }),
            (0.68, if leads { -16.0 } else { -24.0 }),
            (0.85, if leads { 2.0 } else { -10.0 }),
        ]),
        toes_down: Curve::cyclic(&[(0.0, 0.0), (0.60, 0.0), (0.68, 1.0), (0.80, -4.0), (0.93, -4.0)]),
        heights: vec![(0.30, if leads { 0.131 } else { 0.144 }), (0.72, if leads { 0.115 } else { 0.119 })],
        detour: DVec2::new(0.0, if leads { 0.015 } else { -0.012 }),
        brake: DVec2::new(2.0, 8.0),
        sole_in: if leads { 3.0 } else { -3.0 },
    };
    motion.steps = [step(true), step(false)];
    let hips = &mut motion.hips;
    hips.aside = Curve::waves(0.0, &[(1.0, 0.022, 0.24), (2.0, 0.006, 0.1)]);
    hips.height = Curve::waves(0.9080, &[(2.0, 0.008, 0.42)]);
    hips.list = Curve::waves(0.0, &[(1.0, -2.5, 0.20)]);
    hips.turn = Curve::waves(0.0, &[(1.0, 2.5, 0.10), (2.0, 0.8, 0.3)]);
    hips.tilt = Curve::waves(7.0, &[(2.0, 1.2, 0.1)]);
    let trunk = &mut motion.trunk;
    trunk.bend = Curve::waves(5.0, &[(2.0, 1.4, 0.05)]);
    trunk.list = Curve::waves(1.5, &[(1.0, 3.0, 0.22)]);
    trunk.turn = Curve::waves(0.0, &[(1.0, -3.0, 0.12)]);
    motion
}

/// Round to the left on the spot, 70 degrees a second.
pub fn turn() -> Motion {
    let mut motion = on_the_spot("turn-left");
    motion.path = Path { velocity: DVec2::ZERO, turn_rate: 70.0 };
    motion.trunk.turn = Curve::waves(5.0, &[(1.0, -3.5, 0.2)]);
    motion.trunk.gaze = Curve::waves(17.0, &[(1.0, 1.5, 0.1)]);
    motion.hips.turn = Curve::waves(3.0, &[(2.0, 2.0, 0.35)]);
    motion
}

/// Small steps on the spot, weight from foot to foot.
fn on_the_spot(name: &'static str) -> Motion {
    let step = Step {
        print: DVec2::new(0.118, 0.0),
        out_turn: 8.0,
        middle: 0.33,
        lift: 0.66,
        pitch: Curve::cyclic(&[
            (0.0, -4.0),
            (0.07, 0.0),
            (0.44, 0.0),
            (0.56, -8.0),
            (0.66, -20.0),
            (0.74, -21.0),
            (0.88, -8.0),
        ]),
        toes_down: Curve::cyclic(&[(0.0, 0.0), (0.62, 0.0), (0.72, 8.0), (0.84, -3.0), (0.94, -3.0)]),
        heights: vec![(0.35, 0.128), (0.70, 0.116), (0.88, 0.090)],
        detour: DVec2::new(0.0, 0.012),
        brake: DVec2::ZERO,
        sole_in: 3.0,
    };
    let arm = |own: f64| Arm {
        swing: Curve::waves(2.0, &[(1.0, 5.0, 0.55 + own)]),
        out: Curve::waves(14.0, &[(1.0, 2.5, 0.3)]),
        inward: Curve::waves(18.0, &[(1.0, 4.0, 0.6)]),
        elbow: Curve::waves(29.0, &[(1.0, 5.0, 0.6 + own)]),
        palm: Curve::waves(-34.0, &[(1.0, 4.0, 0.4)]),
        wrist: Curve::waves(5.0, &[(1.0, 4.0, 0.7)]),
        collar: Curve::waves(0.0, &[(1.0, 1.5, 0.5)]),
        shrug: Curve::waves(0.0, &[(1.0, 1.2, 0.3)]),
    };
    Motion {
        name,
        length_secs: 0.90,
        loops: true,
        stride: true,
        hips: Hips {
            aside: Curve::waves(0.0, &[(1.0, 0.026, 0.30)]),
            height: Curve::waves(0.9300, &[(2.0, 0.009, 0.34)]),
            ahead: Curve::waves(0.004, &[(2.0, 0.004, 0.1)]),
            tilt: Curve::waves(4.0, &[(2.0, 1.0, 0.15)]),
            list: Curve::waves(0.0, &[(1.0, -2.6, 0.22)]),
            turn: Curve::waves(0.0, &[(2.0, 1.5, 0.35)]),
        },
        trunk: Trunk {
            bend: Curve::waves(2.0, &[(2.0, 1.0, 0.08)]),
            list: Curve::waves(0.0, &[(1.0, 3.2, 0.24)]),
            turn: Curve::waves(0.0, &[(1.0, -3.5, 0.2)]),
            nod: Curve::waves(3.0, &[(2.0, 0.8, 0.3)]),
            head_list: Curve::waves(0.0, &[(1.0, 0.8, 0.3)]),
            gaze: Curve::waves(0.0, &[(1.0, 1.5, 0.1)]),
        },
        arms: [arm(0.0), arm(0.0)],
        steps: [step.clone(), step],
        path: idle::STILL,
        least_knee: 15.0,
        keys: 40,
    }
}
