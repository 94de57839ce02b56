//! Targets dragged in millimetres through what the ranges allow and what they don't: how fast the joints turn.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

#[path = "../../kin/tests/seeded/mod.rs"]
mod seeded;

use std::sync::LazyLock;

use glam::{DQuat, DVec3};
use rig::{
    Bone, Contact, Dof, Figure, Limb, Pose, Reacher, Space, Target, evaluate, frames, parse_pose, reach,
};
use seeded::Seeded;

/// Where drags begin: bent before the body, nearly straight, raised, far aside.
const FIRST: [&str; 4] = [
    r#"(version: 1, hips: (0.0, 0.91, 0.0), joints: {
        "leftUpperArm": (flexion: 35.0, abduction: -50.0), "leftLowerArm": (flexion: 80.0, twist: -70.0),
        "leftUpperLeg": (flexion: 35.0), "leftLowerLeg": (flexion: 60.0)})"#,
    r#"(version: 1, hips: (0.0, 0.91, 0.0), joints: {
        "leftUpperArm": (abduction: -85.0), "leftLowerArm": (flexion: 10.0, twist: -70.0),
        "leftUpperLeg": (abduction: 5.0), "leftLowerLeg": (flexion: 5.0)})"#,
    r#"(version: 1, hips: (0.0, 0.91, 0.0), joints: {
        "leftUpperArm": (flexion: 60.0, abduction: 30.0, twist: -20.0), "leftLowerArm": (flexion: 60.0, twist: -70.0),
        "leftUpperLeg": (flexion: 90.0, abduction: 10.0), "leftLowerLeg": (flexion: 90.0)})"#,
    r#"(version: 1, hips: (0.0, 0.91, 0.0), joints: {
        "leftUpperArm": (abduction: -60.0, twist: -60.0), "leftLowerArm": (flexion: 100.0, twist: -70.0),
        "leftUpperLeg": (flexion: 60.0, abduction: 40.0, twist: 20.0), "leftLowerLeg": (flexion: 110.0)})"#,
];

fn turn_between(a: DQuat, b: DQuat) -> f64 {
    let d = a.conjugate() * b;
    (2.0 * DVec3::new(d.x, d.y, d.z).length().atan2(d.w.abs())).to_degrees()
}

/// A limb that is dragged, always from the same first pose, as a gesture has it.
struct Dragged<'a> {
    figure: &'a Figure,
    first: Pose,
    limb: Limb,
    root: DVec3,
    span: f64,
}

/// Where a drag left the limb.
struct Left {
    target: DVec3,
    joints: [DQuat; 2],
    articulator: DVec3,
}

impl Left {
    fn missed(&self) -> f64 {
        self.articulator.distance(self.target)
    }

    /// How far root or hinge turned, degrees.
    fn turned(&self, other: &Left) -> f64 {
        (0..2).map(|i| turn_between(self.joints[i], other.joints[i])).fold(0.0, f64::max)
    }
}

impl<'a> Dragged<'a> {
    fn new(figure: &'a Figure, limb: Limb, first: &str) -> Dragged<'a> {
        let first = parse_pose(first).unwrap().onto(&figure.rest_pose());
        let frames = frames(figure, &first);
        let root = frames[limb.parts().root].position;
        let limits = rig::reach_limits(figure, &first, &frames, limb, true).unwrap();
        Dragged { figure, first, limb, root, span: limits.outer_m }
    }

    fn to(&self, target: DVec3) -> Left {
        let goal = Target { space: Space::World, point: target };
        let pose = reach(self.figure, &self.first, self.limb, goal, true).unwrap().pose;
        let parts = self.limb.parts();
        let joints = [parts.root, parts.hinge]
            .map(|bone| self.figure.skeleton.joint(bone).unwrap().rotation(pose.angles(bone)));
        let (at, frames) = (self.figure.articulator(&pose, self.limb), frames(self.figure, &pose));
        Left { target, joints, articulator: frames[at.bone].point(at.at) }
    }

    /// Lines and circles all round the root, in millimetres, at least two centimetres from it.
    fn paths(&self, seeded: &mut Seeded, count: usize) -> Vec<Vec<DVec3>> {
        let place = |i: usize, (along, side, other): (DVec3, DVec3, DVec3), aside: f64, lift: f64| {
            let r = aside * self.span;
            if i.is_multiple_of(2) {
                let step = |k: i32| side * r + along * (f64::from(k) * 1e-3);
                (-1100..=1100).map(step).filter(|p| p.length() < 1.15 * self.span).collect::<Vec<_>>()
            } else {
                let n = (r * std::f64::consts::TAU / 1e-3) as usize;
                let step = |k: usize| {
                    let (sine, cosine) = (k as f64 / n as f64 * std::f64::consts::TAU).sin_cos();
                    along * (lift * self.span) + (side * cosine + other * sine) * r
                };
                (0..=n).map(step).collect()
            }
        };
        (0..count)
            .map(|i| {
                let along = seeded.direction();
                let spin = DQuat::from_axis_angle(along, seeded.between(0.0, std::f64::consts::TAU));
                let side = spin * along.any_orthonormal_vector();
                let (aside, lift) = (seeded.between(0.1, 0.9), seeded.between(-0.6, 0.6));
                let path = place(i, (along, side, along.cross(side)), aside, lift);
                path.into_iter().filter(|p| p.length() > 0.02).map(|p| self.root + p).collect()
            })
            .collect()
    }
}

/// Steps of a millimetre, and how many of them turn a joint by more than 1, 10, 30 and 90 degrees.
#[derive(Default, Debug)]
struct Steps {
    all: usize,
    faster: [usize; 4],
}

impl Steps {
    fn count(&mut self, turned: f64) {
        self.all += 1;
        (0..4).for_each(|i| self.faster[i] += usize::from(turned > [1.0, 10.0, 30.0, 90.0][i]));
    }

    /// The share of a kind of fast steps.
    fn share(&self, faster: usize) -> f64 {
        self.faster[faster] as f64 / self.all as f64
    }
}

/// What happened on the way.
#[derive(Default, Debug)]
struct Tally {
    /// The target is met at both ends of the step.
    met: Steps,
    /// It is missed at one of them.
    missed: Steps,
    /// By how much a step changed the miss at most, metres.
    uneven: f64,
    /// By how much the two places of a jump differed in their distance to the target at most, metres.
    unfair: f64,
}

impl Tally {
    fn count(&mut self, before: &Left, now: &Left) {
        let turned = before.turned(now);
        if before.missed().max(now.missed()) < 1e-6 {
            return self.met.count(turned);
        }
        self.missed.count(turned);
        self.uneven = self.uneven.max((before.missed() - now.missed()).abs());
        if turned > 10.0 {
            let other = before.articulator.distance(now.target);
            self.unfair = self.unfair.max((other - now.missed()).abs());
        }
    }
}

/// Both tests read one and the same drags.
static DRAGS: LazyLock<[(Limb, Tally); 2]> =
    LazyLock::new(|| [Limb::LeftArm, Limb::LeftLeg].map(|limb| (limb, drag(limb, 4))));

fn drag(limb: Limb, paths: usize) -> Tally {
    let figure = interchange::figure::bare_mannequin().unwrap();
    let mut tally = Tally::default();
    for (i, first) in FIRST.iter().enumerate() {
        let dragged = Dragged::new(&figure, limb, first);
        for path in dragged.paths(&mut Seeded(21 + i as u64), paths) {
            let mut before: Option<Left> = None;
            for target in path {
                let now = dragged.to(target);
                // Lines have a gap where they pass the root.
                if let Some(before) = before.filter(|before| before.target.distance(target) < 2e-3) {
                    tally.count(&before, &now);
                }
                before = Some(now);
            }
        }
    }
    tally
}

#[test]
fn where_the_target_is_met_no_millimetre_turns_a_joint_far() {
    // Fastest where the feasible elevations shrink to nothing, opposite to the swing base, and at full stretch. Hops
    // between two feasible elevations are rarer than these lines are long: a test in `kin` counts them.
    for (limb, tally) in DRAGS.iter() {
        assert!(tally.met.all > 10_000 && tally.met.faster[2] == 0, "{}: {tally:?}", limb.name());
        assert!(tally.met.share(0) < 0.02 && tally.met.share(1) < 2e-4, "{}: {tally:?}", limb.name());
    }
}

#[test]
fn where_ranges_stop_the_limb_it_jumps_only_between_two_places_equally_near() {
    for (limb, tally) in DRAGS.iter() {
        // A change of elevation is worth up to 3 mm, and a step is 1 mm.
        assert!(tally.uneven < 4e-3 && tally.unfair < 4e-3, "{}: {tally:?}", limb.name());
        assert!(tally.missed.all > 8_000 && tally.missed.share(0) < 0.01, "{}: {tally:?}", limb.name());
        assert!(tally.missed.share(1) < 0.004 && tally.missed.share(3) < 0.002, "{}: {tally:?}", limb.name());
    }
}

#[test]
fn a_planted_forearm_at_full_stretch_keeps_its_place_when_the_arm_elevates() {
    let figure = interchange::figure::bare_mannequin().unwrap();
    let limb = Limb::RightArm;
    let mut pose = figure.rest_pose();
    for (bone, dof, degrees) in [
        (Bone::RightUpperArm, Dof::Abduction, -30.0),
        (Bone::RightLowerArm, Dof::Flexion, 16.58),
        (Bone::RightLowerArm, Dof::Twist, -92.0),
    ] {
        pose = rig::turn(&figure, &pose, bone, dof, degrees, true).unwrap().pose;
    }
    pose.limbs[limb.index()].reacher = Reacher::Point(Bone::RightLowerArm, DVec3::new(-0.1, 0.03, 0.0));
    let frame = frames(&figure, &pose)[Bone::RightLowerArm];
    let target = frame.point(DVec3::new(-0.1, 0.03, 0.0));
    pose.limbs[limb.index()].contact =
        Contact::Planted { space: Space::World, target, rotation: frame.rotation };
    for degrees in [-20.0, -12.0, -6.0, -2.0, 2.0, 6.0, 12.0, 20.0] {
        let moved = rig::elevate(&figure, &pose, limb, degrees, false, true).unwrap();
        let view = &evaluate(&figure, &moved.pose, true).limbs[limb.index()];
        assert!(view.residual < 1e-9, "elevated by {degrees}, the forearm is off by {} m", view.residual);
    }
}
