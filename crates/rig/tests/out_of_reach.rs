//! A target that leaves the shell of reach and comes back: the limb points at it, and nothing jumps.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

#[path = "../../kin/tests/seeded/mod.rs"]
mod seeded;

use glam::{DQuat, DVec3};
use rig::{
    Figure, Limb, Pose, ReachLimits, Space, Target, evaluate, frames, parse_pose, reach, reach_limits,
};
use seeded::Seeded;

const READY: &str = r#"(version: 1, hips: (0.0, 0.91, 0.0), joints: {
    "leftUpperArm": (flexion: 35.0, abduction: -50.0), "leftLowerArm": (flexion: 80.0, twist: -70.0),
    "rightUpperArm": (flexion: 35.0, abduction: -50.0), "rightLowerArm": (flexion: 80.0, twist: -70.0),
    "leftUpperLeg": (flexion: 35.0), "leftLowerLeg": (flexion: 60.0), "leftFoot": (flexion: 15.0),
    "rightUpperLeg": (flexion: 35.0), "rightLowerLeg": (flexion: 60.0), "rightFoot": (flexion: 15.0),
})"#;

fn turn_between(a: DQuat, b: DQuat) -> f64 {
    let d = a.conjugate() * b;
    (2.0 * DVec3::new(d.x, d.y, d.z).length().atan2(d.w.abs())).to_degrees()
}

struct Dragged<'a> {
    figure: &'a Figure,
    first: Pose,
    limb: Limb,
    limits: ReachLimits,
    ranges: bool,
}

/// Where a drag left the limb.
struct Left {
    elevation: Option<f64>,
    joints: [DQuat; 2],
    articulator: DVec3,
}

impl<'a> Dragged<'a> {
    fn new(figure: &'a Figure, limb: Limb, ranges: bool) -> Dragged<'a> {
        let first = parse_pose(READY).unwrap().onto(&figure.rest_pose());
        let limits = reach_limits(figure, &first, &frames(figure, &first), limb, ranges).unwrap();
        Dragged { figure, first, limb, limits, ranges }
    }

    /// Where the articulator is in the pose that all begin with.
    fn start(&self) -> DVec3 {
        let first = parse_pose(READY).unwrap().onto(&self.figure.rest_pose());
        let at = self.figure.articulator(&first, self.limb);
        frames(self.figure, &first)[at.bone].point(at.at)
    }

    /// As a gesture has it: from the first state.
    fn to(&self, point: DVec3) -> Left {
        let target = Target { space: Space::World, point };
        let pose = reach(self.figure, &self.first, self.limb, target, self.ranges).unwrap().pose;
        let parts = self.limb.parts();
        let joints = [parts.root, parts.hinge]
            .map(|bone| self.figure.skeleton.joint(bone).unwrap().rotation(pose.angles(bone)));
        let (at, frames) = (self.figure.articulator(&pose, self.limb), frames(self.figure, &pose));
        let elevation = evaluate(self.figure, &pose, self.ranges).limbs[self.limb.index()].elevation;
        Left { elevation, joints, articulator: frames[at.bone].point(at.at) }
    }
}

/// Something is near to what it should be.
const NEAR_M: f64 = 1e-6;

impl Dragged<'_> {
    /// Where the articulator of a limb that points at a target is: there, or where the shell is nearest to it.
    fn pointing(&self, point: DVec3) -> DVec3 {
        let from_root = point - self.limits.root_in_world;
        let distance = from_root.length().clamp(self.limits.inner_m, self.limits.outer_m);
        self.limits.root_in_world + from_root.normalize() * distance
    }

    /// Walks a line in millimetres. The fastest that a joint turned from one place to the next, degrees, and how many
    /// places were within reach, beyond it and too near; places that do not count are passed over.
    fn walk(&self, from: DVec3, to: DVec3, counts: impl Fn(DVec3, &Left) -> bool) -> (f64, [usize; 3]) {
        let steps = (from.distance(to) / 1e-3).ceil() as usize;
        let (mut worst, mut visited, mut before) = (0.0f64, [0; 3], None::<Left>);
        for step in 0..=steps {
            let point = from.lerp(to, step as f64 / steps as f64);
            let now = Some(self.to(point)).filter(|left| counts(point, left));
            if let (Some(before), Some(now)) = (&before, &now) {
                let turned = (0..2).map(|i| turn_between(before.joints[i], now.joints[i]));
                worst = turned.fold(worst, f64::max);
                let distance = point.distance(self.limits.root_in_world);
                let beyond = usize::from(distance > self.limits.outer_m);
                visited[if distance < self.limits.inner_m { 2 } else { beyond }] += 1;
            }
            before = now;
        }
        (worst, visited)
    }
}

/// Lines through and past the shells: some pass within a few centimetres of the root, some far outside.
fn lines(dragged: &Dragged, seeded: &mut Seeded, count: usize) -> Vec<(DVec3, DVec3)> {
    let ReachLimits { root_in_world, inner_m, outer_m } = dragged.limits;
    (0..count)
        .map(|i| {
            let along = seeded.direction();
            let aside = along.any_orthonormal_vector();
            let reaches = [0.6 * inner_m, 0.5 * outer_m, 0.9 * outer_m];
            let middle = root_in_world + aside * reaches[i % 3].max(0.025);
            (middle - along * 1.3 * outer_m, middle + along * 1.3 * outer_m)
        })
        .collect()
}

/// Straightening over the last millimetre turns a hinge by the square root of what is missing.
const FASTEST_DEG: f64 = 9.0;

#[test]
fn a_target_that_leaves_reach_and_comes_back_turns_nothing_over() {
    let figure = interchange::figure::bare_mannequin().unwrap();
    let mut visited = [0; 3];
    for limb in Limb::ALL {
        let dragged = Dragged::new(&figure, limb, false);
        let root = dragged.limits.root_in_world;
        let base = figure.limbs.swing_base(limb);
        for (from, to) in lines(&dragged, &mut Seeded(5), 5) {
            // The carrier turns fast only opposite to its base, behind the upper back; a root has no direction.
            let (worst, at) = dragged.walk(from, to, |point, left| {
                assert!(left.articulator.distance(dragged.pointing(point)) < NEAR_M, "{limb:?} at {point}");
                let from_root = point - root;
                from_root.length() > 0.02 && from_root.normalize().dot(-base) < 0.8
            });
            assert!(worst < FASTEST_DEG, "{}: {worst} degrees in a millimetre", limb.name());
            (0..3).for_each(|i| visited[i] += at[i]);
        }
    }
    assert!(visited[..2].iter().all(|places| *places > 3000), "{visited:?}");
}

#[test]
fn ranges_leave_a_limb_alone_where_they_are_not_in_its_way() {
    let figure = interchange::figure::bare_mannequin().unwrap();
    let mut visited = [0; 3];
    for limb in Limb::ALL {
        let dragged = Dragged::new(&figure, limb, true);
        let (root, kept) = (dragged.limits.root_in_world, dragged.to(dragged.start()).elevation.unwrap());
        for (from, to) in lines(&dragged, &mut Seeded(8), 5) {
            let (worst, at) = dragged.walk(from, to, |point, left| {
                let free = left.elevation.is_some_and(|now| (now - kept).abs() < 1e-3);
                let points = left.articulator.distance(dragged.pointing(point)) < NEAR_M;
                free && points && point.distance(root) > 0.02
            });
            assert!(worst < FASTEST_DEG, "{}: {worst} degrees in a millimetre", limb.name());
            (0..3).for_each(|i| visited[i] += at[i]);
        }
    }
    assert!(visited.iter().all(|places| *places > 200), "{visited:?}");
}

#[test]
fn a_target_that_comes_back_finds_the_limb_as_it_was() {
    let figure = interchange::figure::bare_mannequin().unwrap();
    for limb in Limb::ALL {
        let mut dragged = Dragged::new(&figure, limb, true);
        let home = dragged.to(dragged.start());
        // Each place is a gesture of its own here, so that what a limb forgets out there shows.
        let out = dragged.start() - dragged.limits.root_in_world;
        for far in [1.2, 1.6, 2.5, 1.3, 1.01, 1.0] {
            let point = dragged.limits.root_in_world + out * far;
            let target = Target { space: Space::World, point };
            dragged.first = reach(&figure, &dragged.first, limb, target, true).unwrap().pose;
        }
        let back = dragged.to(dragged.start());
        for i in 0..2 {
            assert!(turn_between(home.joints[i], back.joints[i]) < 1e-3, "{}", limb.name());
        }
    }
}
