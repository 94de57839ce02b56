//! Jogging: both feet off the ground twice a stride.

use glam::DVec2;

use super::carriage::{Arm, Hips, Trunk};
use super::curve::Curve;
use super::motion::Motion;
use super::path::Path;
use super::step::Step;

/// An easy jog: 2.8 m/s, 0.72 s a stride, each foot down for 37 % of it.
pub fn jog() -> Motion {
    let arm = Arm {
        swing: Curve::cyclic(&[(0.03, -44.0), (0.30, -14.0), (0.53, 14.0), (0.80, -16.0)]),
        out: Curve::waves(13.0, &[(1.0, 3.0, 0.05)]),
        inward: Curve::waves(22.0, &[(1.0, 9.0, 0.54)]),
        elbow: Curve::waves(82.0, &[(1.0, 9.0, 0.58)]),
        palm: Curve::waves(-28.0, &[(1.0, 6.0, 0.5)]),
        wrist: Curve::waves(6.0, &[(1.0, 7.0, 0.7), (2.0, 2.0, 0.2)]),
        collar: Curve::waves(-1.0, &[(1.0, 4.0, 0.53)]),
        shrug: Curve::waves(1.0, &[(2.0, 1.5, 0.44)]),
    };
    let step = Step {
        print: DVec2::new(0.032, -0.115),
        out_turn: 5.0,
        middle: 0.17,
        lift: 0.37,
        pitch: Curve::cyclic(&[
            (0.0, 9.0),
            (0.04, 2.0),
            (0.075, 0.0),
            (0.125, 0.0),
            (0.19, -7.5),
            (0.28, -27.0),
            (0.33, -48.0),
            (0.37, -64.0),
            (0.44, -88.0),
            (0.54, -104.0),
            (0.64, -92.0),
            (0.74, -52.0),
            (0.83, -14.0),
            (0.90, 8.0),
            (0.95, 14.0),
        ]),
        toes_down: Curve::cyclic(&[
            (0.0, -18.0),
            (0.07, 0.0),
            (0.31, 0.0),
            (0.34, 8.0),
            (0.38, 33.0),
            (0.46, 70.0),
            (0.56, 92.0),
            (0.66, 78.0),
            (0.78, 22.0),
            (0.88, -18.0),
            (0.95, -25.0),
        ]),
        heights: vec![(0.30, 0.365), (0.62, 0.255), (0.84, 0.150)],
        detour: DVec2::new(0.012, 0.02),
        brake: DVec2::new(4.0, 0.0),
        sole_in: 8.0,
    };
    Motion {
        name: "jog",
        length_secs: 0.72,
        loops: true,
        stride: true,
        path: Path { velocity: DVec2::new(0.0, 2.8), turn_rate: 0.0 },
        hips: Hips {
            aside: Curve::waves(0.0, &[(1.0, 0.010, 0.20)]),
            height: Curve::waves(0.9100, &[(2.0, 0.032, 0.42)]),
            ahead: Curve::waves(0.0, &[(2.0, 0.006, 0.35)]),
            tilt: Curve::waves(8.0, &[(2.0, 2.5, 0.36)]),
            list: Curve::waves(0.0, &[(1.0, -5.0, 0.15)]),
            turn: Curve::waves(0.0, &[(1.0, -7.0, 0.93)]),
        },
        trunk: Trunk {
            bend: Curve::waves(1.5, &[(2.0, 2.5, 0.17)]),
            list: Curve::waves(0.0, &[(1.0, 5.5, 0.16)]),
            turn: Curve::waves(0.0, &[(1.0, 17.0, 0.96)]),
            nod: Curve::waves(3.0, &[(2.0, 1.5, 0.25)]),
            head_list: Curve::waves(0.0, &[(1.0, 0.8, 0.3)]),
            gaze: Curve::waves(0.0, &[(1.0, 1.2, 0.97)]),
        },
        arms: [arm.clone(), arm],
        steps: [step.clone(), step],
        least_knee: 15.0,
        keys: 36,
    }
}
