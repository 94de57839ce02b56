//! Walking: ahead, in an arc to either side, and back.

use glam::DVec2;

use super::carriage::{Arm, Hips, Trunk};
use super::curve::Curve;
use super::motion::Motion;
use super::path::Path;
use super::step::Step;

/// The plain walk: 1.40 m/s, 0.98 s a stride. Times of the foot's rockers, shares of hips, trunk and arms.
/// Sources: `winter`, `winter92`, `perry`, `murray`.
pub fn walk() -> Motion {
    let arm = Arm {
        // Back most as its own foot strikes.
        swing: Curve::cyclic(&[(0.02, -23.0), (0.28, -7.0), (0.52, 13.0), (0.78, -4.0)]),
        out: Curve::waves(9.0, &[(1.0, 1.5, 0.1)]),
        inward: Curve::waves(11.0, &[(1.0, 4.0, 0.54)]),
        elbow: Curve::cyclic(&[(0.06, 19.0), (0.30, 27.0), (0.55, 37.0), (0.80, 26.0)]),
        palm: Curve::waves(-24.0, &[(1.0, 6.0, 0.05)]),
        wrist: Curve::waves(4.0, &[(1.0, 5.0, 0.66)]),
        collar: Curve::waves(0.0, &[(1.0, 2.5, 0.52)]),
        shrug: Curve::waves(-1.0, &[(1.0, 1.0, 0.3)]),
    };
    let step = Step {
        print: DVec2::new(0.045, -0.1135),
        out_turn: 6.0,
        middle: 0.30,
        lift: 0.61,
        pitch: Curve::cyclic(&[
            (0.0, 19.0),
            (0.045, 8.0),
            (0.085, 0.8),
            (0.115, 0.0),
            (0.33, 0.0),
            (0.37, -2.0),
            (0.42, -7.2),
            (0.50, -24.2),
            (0.56, -51.0),
            (0.61, -65.0),
            (0.645, -70.0),
            (0.70, -62.0),
            (0.76, -40.0),
            (0.82, -12.0),
            (0.87, 5.7),
            (0.92, 19.0),
            (0.96, 22.0),
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
        heights: vec![(0.17, 0.245), (0.52, 0.1172), (0.80, 0.0955)],
        detour: DVec2::new(0.004, 0.0),
        brake: DVec2::new(-3.0, 0.0),
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
            height: Curve::waves(0.919, &[(2.0, 0.0155, 0.262), (4.0, 0.0011, 0.24)]),
            ahead: Curve::waves(0.0, &[(2.0, 0.018, -0.06)]),
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
        least_knee: 5.0,
        keys: 40,
    }
}

/// Walking in an arc to the left: 1.1 m/s, 32 degrees a second, the body leaning in.
pub fn walk_turn() -> Motion {
    let mut motion = walk();
    motion.name = "walk-turn-left";
    motion.length_secs = 1.06;
    motion.least_knee = 6.0;
    motion.path = Path { velocity: DVec2::new(0.0, 1.1), turn_rate: 32.0 };
    for step in &mut motion.steps {
        step.print = DVec2::new(0.055, -0.095);
    }
    let hips = &mut motion.hips;
    hips.height = Curve::waves(0.9250, &[(2.0, 0.0150, 0.285)]);
    hips.aside = Curve::waves(0.008, &[(1.0, 0.018, 0.31)]);
    hips.list = Curve::waves(1.2, &[(1.0, -3.8, 0.17), (3.0, -0.5, 0.15)]);
    hips.turn = Curve::waves(3.0, &[(1.0, -4.8, 0.02)]);
    motion.trunk.list = Curve::waves(2.2, &[(1.0, 4.5, 0.20)]);
    motion.trunk.turn = Curve::waves(5.0, &[(1.0, 8.0, 0.03)]);
    motion.trunk.gaze = Curve::waves(16.0, &[(1.0, 0.8, 0.04)]);
    motion.trunk.head_list = Curve::waves(1.0, &[(1.0, 0.6, 0.3)]);
    motion
}

/// Walking backward: 0.9 m/s. The toes touch first and the heel leaves last.
pub fn walk_back() -> Motion {
    let mut motion = walk();
    motion.name = "walk-back";
    motion.length_secs = 1.04;
    motion.least_knee = 11.0;
    motion.keys = 60;
    motion.path = Path { velocity: DVec2::new(0.0, -0.90), turn_rate: 0.0 };
    let step = Step {
        print: DVec2::new(0.06, 0.03),
        out_turn: 6.0,
        middle: 0.33,
        lift: 0.64,
        pitch: Curve::cyclic(&[
            (0.0, -24.0),
            (0.06, -15.0),
            (0.17, 0.0),
            (0.47, 0.0),
            (0.56, 5.0),
            (0.64, 14.0),
            (0.70, 13.0),
            (0.78, -6.0),
            (0.88, -28.0),
            (0.95, -29.0),
        ]),
        toes_down: Curve::cyclic(&[
            (0.0, 0.0),
            (0.48, 0.0),
            (0.60, -12.0),
            (0.68, -22.0),
            (0.80, 6.0),
            (0.90, 15.0),
            (0.95, 6.0),
        ]),
        heights: vec![(0.25, 0.130), (0.60, 0.166), (0.85, 0.164)],
        detour: DVec2::new(0.006, 0.0),
        brake: DVec2::new(2.0, 0.0),
        sole_in: 4.0,
    };
    motion.steps = [step.clone(), step];
    let hips = &mut motion.hips;
    hips.height = Curve::waves(0.9200, &[(2.0, 0.012, 0.33)]);
    hips.ahead = Curve::waves(0.0, &[(2.0, 0.005, 0.2)]);
    hips.aside = Curve::waves(0.0, &[(1.0, 0.022, 0.33)]);
    hips.turn = Curve::waves(0.0, &[(1.0, 3.5, 0.02)]);
    hips.tilt = Curve::waves(6.0, &[(2.0, 1.0, 0.2)]);
    motion.trunk.bend = Curve::waves(3.0, &[(2.0, 1.3, 0.1)]);
    motion.trunk.turn = Curve::waves(0.0, &[(1.0, -6.0, 0.03)]);
    for arm in &mut motion.arms {
        arm.swing = Curve::waves(-2.0, &[(1.0, 11.0, 0.02)]);
        arm.elbow = Curve::waves(28.0, &[(1.0, 6.0, 0.06)]);
        arm.out = Curve::waves(12.0, &[(1.0, 1.5, 0.3)]);
    }
    motion
}
