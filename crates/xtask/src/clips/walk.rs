//! Walking: ahead, in an arc to either side, and back.

use glam::DVec2;

use super::carriage::{Arm, Hips, Trunk};
use super::curve::Curve;
use super::motion::Motion;
use super::path::Path;
use super::step::Step;

pub const START: [f64; 26] = [
    -0.1204, 0.9117, 0.0157, 0.2455, 0.0115, -0.0783, 19.0, 8.0, 0.8, -6.7637, -22.9979, -50.0, -65.0, -70.0,
    -62.0, -40.0, -12.0, 4.8832, 19.0, 22.0, 0.2474, 0.118, 0.0888, -7.2653, 0.0007, 0.2179,
];
/// The plain walk: 1.40 m/s, 1.03 s a stride.
pub fn walk() -> Motion {
    walk_of(&START)
}
pub fn walk_of(p: &[f64; 26]) -> Motion {
    let arm = Arm {
        // Back most as its own foot strikes.
        swing: Curve::cyclic(&[(0.02, -23.0), (0.28, -7.0), (0.52, 13.0), (0.78, -4.0)]),
        out: Curve::waves(9.0, &[(1.0, 1.5, 0.1)]),
        inward: Curve::waves(20.0, &[(1.0, 5.0, 0.54)]),
        elbow: Curve::cyclic(&[(0.06, 19.0), (0.30, 27.0), (0.55, 37.0), (0.80, 26.0)]),
        palm: Curve::waves(-24.0, &[(1.0, 6.0, 0.05)]),
        wrist: Curve::waves(4.0, &[(1.0, 5.0, 0.66)]),
        collar: Curve::waves(0.0, &[(1.0, 2.5, 0.52)]),
        shrug: Curve::waves(-1.0, &[(1.0, 1.0, 0.3)]),
    };
    let step = Step {
        print: DVec2::new(0.045, p[0]),
        out_turn: 6.0,
        middle: 0.30,
        lift: 0.61,
        pitch: Curve::cyclic(&[
            (0.0, p[6]),
            (0.045, p[7]),
            (0.085, p[8]),
            (0.115, 0.0),
            (0.33, 0.0),
            (0.37, -2.0),
            (0.42, p[9]),
            (0.50, p[10]),
            (0.56, p[11]),
            (0.61, p[12]),
            (0.645, p[13]),
            (0.70, p[14]),
            (0.76, p[15]),
            (0.82, p[16]),
            (0.87, p[17]),
            (0.92, p[18]),
            (0.96, p[19]),
        ]),
        toes_down: Curve::cyclic(&[
            (0.0, -30.0),
            (0.05, -13.0),
            (0.095, 0.0),
            (0.545, 0.0),
            (0.58, 9.0),
            (0.62, 30.0),
            (0.66, 44.0),
            (0.72, 43.0),
            (0.78, 14.0),
            (0.84, -12.0),
            (0.92, -31.0),
        ]),
        heights: vec![(0.17, p[20]), (0.52, p[21]), (0.80, p[22])],
        detour: DVec2::new(0.004, 0.0),
        brake: DVec2::new(p[23], 0.0),
        sole_in: 5.0,
    };
    Motion {
        name: "walk",
        length_secs: 0.98,
        loops: true,
        stride: true,
        path: Path { velocity: DVec2::new(0.0, 1.40), turn_rate: 0.0 },
        hips: Hips {
            aside: Curve::waves(0.0, &[(1.0, 0.018, 0.31)]),
            height: Curve::waves(p[1], &[(2.0, p[2], p[3]), (4.0, p[24], p[25])]),
            ahead: Curve::waves(0.0, &[(2.0, p[4], p[5])]),
            tilt: Curve::waves(3.0, &[(2.0, 1.2, 0.20)]),
            list: Curve::waves(0.0, &[(1.0, -4.2, 0.17), (3.0, -0.6, 0.15)]),
            turn: Curve::waves(0.0, &[(1.0, -5.6, 0.02)]),
        },
        trunk: Trunk {
            bend: Curve::waves(-1.0, &[(2.0, 1.6, 0.10)]),
            list: Curve::waves(0.0, &[(1.0, 5.0, 0.20)]),
            turn: Curve::waves(0.0, &[(1.0, 9.5, 0.03)]),
            nod: Curve::waves(1.0, &[(2.0, 0.7, 0.33)]),
            head_list: Curve::waves(0.0, &[(1.0, 0.6, 0.3)]),
            gaze: Curve::waves(0.0, &[(1.0, 0.8, 0.04)]),
        },
        arms: [arm.clone(), arm],
        steps: [step.clone(), step],
        keys: 40,
    }
}
