//! From a seat to standing.

use glam::DVec2;

use super::carriage::{Arm, Hips, Trunk};
use super::curve::Curve;
use super::idle::{self, standing};
use super::motion::Motion;

/// From sitting on a seat 0.45 m high to standing, 2.2 s: the trunk leans first, the seat is left at 40 % of the time.
pub fn sit_to_stand() -> Motion {
    let end = idle::idle();
    let arm = |last: &Arm| Arm {
        swing: Curve::open(&[
            (0.0, 15.0),
            (0.08, 15.0),
            (0.38, 34.0),
            (0.62, 22.0),
            (0.92, last.swing.at(0.0)),
            (1.0, last.swing.at(0.0)),
        ]),
        out: Curve::open(&[(0.0, 13.0), (0.1, 13.0), (0.9, last.out.at(0.0)), (1.0, last.out.at(0.0))]),
        inward: Curve::open(&[
            (0.0, 32.0),
            (0.1, 32.0),
            (0.9, last.inward.at(0.0)),
            (1.0, last.inward.at(0.0)),
        ]),
        elbow: Curve::open(&[
            (0.0, 49.0),
            (0.08, 49.0),
            (0.40, 40.0),
            (0.92, last.elbow.at(0.0)),
            (1.0, last.elbow.at(0.0)),
        ]),
        palm: Curve::open(&[(0.0, -8.0), (0.1, -8.0), (0.9, last.palm.at(0.0)), (1.0, last.palm.at(0.0))]),
        wrist: Curve::open(&[
            (0.0, -8.0),
            (0.1, -8.0),
            (0.45, 6.0),
            (0.9, last.wrist.at(0.0)),
            (1.0, last.wrist.at(0.0)),
        ]),
        collar: Curve::open(&[
            (0.0, 2.0),
            (0.1, 2.0),
            (0.4, 5.0),
            (0.9, last.collar.at(0.0)),
            (1.0, last.collar.at(0.0)),
        ]),
        shrug: Curve::open(&[
            (0.0, -1.0),
            (0.1, -1.0),
            (0.42, 1.0),
            (0.9, last.shrug.at(0.0)),
            (1.0, last.shrug.at(0.0)),
        ]),
    };
    let (hips, trunk) = (&end.hips, &end.trunk);
    Motion {
        name: "sit-to-stand",
        length_secs: 2.2,
        loops: false,
        stride: false,
        path: idle::STILL,
        hips: Hips {
            aside: Curve::open(&[
                (0.0, 0.0),
                (0.3, 0.0),
                (0.95, hips.aside.at(0.0)),
                (1.0, hips.aside.at(0.0)),
            ]),
            height: Curve::open(&[
                (0.0, 0.548),
                (0.28, 0.548),
                (0.38, 0.556),
                (0.50, 0.64),
                (0.64, 0.79),
                (0.78, 0.895),
                (0.90, hips.height.at(0.0)),
                (1.0, hips.height.at(0.0)),
            ]),
            ahead: Curve::open(&[
                (0.0, -0.355),
                (0.10, -0.355),
                (0.28, -0.335),
                (0.40, -0.292),
                (0.52, -0.218),
                (0.66, -0.105),
                (0.80, -0.012),
                (0.92, hips.ahead.at(0.0)),
                (1.0, hips.ahead.at(0.0)),
            ]),
            tilt: Curve::open(&[
                (0.0, -9.0),
                (0.05, -9.0),
                (0.36, 26.0),
                (0.46, 27.0),
                (0.86, hips.tilt.at(0.0)),
                (1.0, hips.tilt.at(0.0)),
            ]),
            list: Curve::open(&[(0.0, 0.0), (0.4, 0.0), (0.95, hips.list.at(0.0)), (1.0, hips.list.at(0.0))]),
            turn: Curve::open(&[(0.0, 0.0), (0.4, 0.0), (0.95, hips.turn.at(0.0)), (1.0, hips.turn.at(0.0))]),
        },
        trunk: Trunk {
            bend: Curve::open(&[
                (0.0, 12.0),
                (0.05, 12.0),
                (0.36, 17.0),
                (0.48, 15.0),
                (0.88, trunk.bend.at(0.0)),
                (1.0, trunk.bend.at(0.0)),
            ]),
            list: Curve::open(&[
                (0.0, 0.0),
                (0.4, 0.0),
                (0.95, trunk.list.at(0.0)),
                (1.0, trunk.list.at(0.0)),
            ]),
            turn: Curve::open(&[
                (0.0, 0.0),
                (0.4, 0.0),
                (0.95, trunk.turn.at(0.0)),
                (1.0, trunk.turn.at(0.0)),
            ]),
            nod: Curve::open(&[
                (0.0, 3.0),
                (0.06, 3.0),
                (0.38, 16.0),
                (0.50, 13.0),
                (0.88, trunk.nod.at(0.0)),
                (1.0, trunk.nod.at(0.0)),
            ]),
            head_list: Curve::open(&[
                (0.0, 0.0),
                (0.4, 0.0),
                (0.95, trunk.head_list.at(0.0)),
                (1.0, trunk.head_list.at(0.0)),
            ]),
            gaze: Curve::open(&[
                (0.0, 0.0),
                (0.4, 0.0),
                (0.95, trunk.gaze.at(0.0)),
                (1.0, trunk.gaze.at(0.0)),
            ]),
        },
        arms: [arm(&end.arms[0]), arm(&end.arms[1])],
        steps: [standing(DVec2::new(0.098, -0.002), 8.0), standing(DVec2::new(0.094, 0.006), 8.0)],
        least_knee: 5.0,
        keys: 66,
    }
}
