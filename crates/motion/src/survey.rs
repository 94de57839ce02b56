//! A walk measured: how feet stood on the ground, and how fast joints turned.

use glam::{DQuat, DVec3};
use rig::{Bone, Figure, Pose, frames};

use crate::{FootView, Sole};

/// Joints that turn less from frame to frame are never said to pop, degrees.
const STILL_DEGREES: f64 = 0.1;

/// What one walk was like, frame after frame at an even rate.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Survey {
    frames: usize,
    last: Option<[[DQuat; 2]; Bone::COUNT]>,
    /// The fastest turn of each joint in its carrier and in the world, degrees a frame, and when it was.
    fastest: Vec<[(f64, usize); 2]>,
    stance: Depths,
    swing_penetration_m: f64,
    starts: [Option<[DVec3; Sole::COUNT]>; 2],
    way: [f64; 2],
    slides: Vec<f64>,
    stances: usize,
    drop: Option<(f64, f64)>,
}

#[derive(Clone, Copy, PartialEq, Debug, Default)]
struct Depths {
    points: usize,
    deepest: f64,
    highest: f64,
    below: f64,
    above: f64,
}

/// How a walk went. Lengths in millimetres, turns in degrees a frame.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Summary {
    /// The deepest that a point of a standing sole was in the ground.
    pub penetration_mm: f64,
    /// The highest that one was above it.
    pub float_mm: f64,
    /// The mean over all points of standing soles, those above the ground counting 0.
    pub mean_penetration_mm: f64,
    /// The mean over them, those in the ground counting 0.
    pub mean_float_mm: f64,
    /// The deepest that a point of any other sole was in the ground.
    pub swing_penetration_mm: f64,
    /// The farthest that a point of a sole went over the ground from where its stance began.
    pub slide_mm: f64,
    /// The same, one by one for each stance that has ended.
    pub slides_mm: Vec<f64>,
    /// The largest turn of any joint from one frame to the next.
    pub pop_deg: f64,
    /// The largest turn over the same joint's largest in the reference; 0 without one.
    pub pop_ratio: f64,
    /// The joint of that ratio, and the number of its frame.
    pub popped: Option<(Bone, usize)>,
    /// The least and the most that hips were lowered below the rise of the ground, metres, 0 or less.
    pub hips_drop_m: [f64; 2],
    /// The share of feet that stood, over all frames.
    pub stance_share: f64,
    /// How many frames there were.
    pub frames: usize,
}

impl Survey {
    /// A survey of no frames yet.
    pub fn new() -> Survey {
        Survey::default()
    }

    /// Takes in the next frame.
    pub fn add(&mut self, figure: &Figure, pose: &Pose, feet: &[FootView; 2]) {
        self.turns(figure, pose);
        for (side, foot) in feet.iter().enumerate() {
            self.foot(side, foot);
            let (low, high) = self.drop.unwrap_or((foot.hips_drop, foot.hips_drop));
            self.drop = Some((low.min(foot.hips_drop), high.max(foot.hips_drop)));
        }
        self.frames += 1;
    }

    fn turns(&mut self, figure: &Figure, pose: &Pose) {
        let all = frames(figure, pose);
        let now = Bone::ALL.map(|bone| {
            let local = figure.skeleton.joint(bone).map(|joint| joint.rotation(pose.angles(bone)));
            [local.unwrap_or(DQuat::IDENTITY), all[bone].rotation]
        });
        self.fastest.resize(Bone::COUNT, [(0.0, 0); 2]);
        if let Some(last) = self.last.replace(now) {
            for ((fastest, now), last) in self.fastest.iter_mut().zip(now).zip(last) {
                for ((fastest, now), last) in fastest.iter_mut().zip(now).zip(last) {
                    let turned = degrees_between(now, last);
                    if turned > fastest.0 {
                        *fastest = (turned, self.frames);
                    }
                }
            }
        }
    }

    fn foot(&mut self, side: usize, foot: &FootView) {
        let off =
            foot.sole_in_world.iter().zip(&foot.ground_under_sole).map(|(point, ground)| point.y - ground);
        if !foot.stance {
            self.swing_penetration_m = off.fold(self.swing_penetration_m, |deepest, off| deepest.max(-off));
            if self.starts[side].take().is_some() {
                self.slides.push(std::mem::take(&mut self.way[side]));
            }
            return;
        }
        self.stances += 1;
        for off in off {
            let all = &mut self.stance;
            all.points += 1;
            all.deepest = all.deepest.max(-off);
            all.highest = all.highest.max(off);
            all.below += (-off).max(0.0);
            all.above += off.max(0.0);
        }
        let Some(points) = foot.sole_in_world.first_chunk::<{ Sole::COUNT }>() else { return };
        let start = self.starts[side].get_or_insert(*points);
        for (point, start) in points.iter().zip(start.iter()) {
            let way = DVec3::new(point.x - start.x, 0.0, point.z - start.z).length();
            self.way[side] = self.way[side].max(way);
        }
    }

    /// The largest turn of a joint in its carrier from one frame to the next, degrees.
    pub fn fastest_turn(&self, bone: Bone) -> f64 {
        self.fastest.get(bone.index()).map_or(0.0, |[local, _]| local.0)
    }

    /// The largest turn of each joint over its largest in a reference, in its carrier and in the world, with the number of
    /// its frame.
    pub fn pops(&self, flat: &Survey) -> Vec<(Bone, f64, usize)> {
        let mut pops = Vec::new();
        for (i, (turns, before)) in self.fastest.iter().zip(&flat.fastest).enumerate() {
            for ((turn, frame), (fastest, _)) in turns.iter().zip(before) {
                pops.push((Bone::ALL[i], turn / fastest.max(STILL_DEGREES), *frame));
            }
        }
        pops
    }

    /// How the walk went so far. The reference is the same figure's walk over flat ground, in frames of the same length;
    /// joints are compared both in their carriers and in the world.
    pub fn summary(&self, flat: Option<&Survey>) -> Summary {
        let mean =
            |sum: f64| if self.stance.points > 0 { 1e3 * sum / self.stance.points as f64 } else { 0.0 };
        let slide = self.slides.iter().chain(&self.way).fold(0.0f64, |most, way| most.max(*way));
        let (low, high) = self.drop.unwrap_or_default();
        let mut summary = Summary {
            penetration_mm: 1e3 * self.stance.deepest,
            float_mm: 1e3 * self.stance.highest,
            mean_penetration_mm: mean(self.stance.below),
            mean_float_mm: mean(self.stance.above),
            swing_penetration_mm: 1e3 * self.swing_penetration_m,
            slide_mm: 1e3 * slide,
            slides_mm: self.slides.iter().map(|way| 1e3 * way).collect(),
            pop_deg: self.fastest.iter().flatten().fold(0.0, |most, (turn, _)| turn.max(most)),
            hips_drop_m: [low, high],
            stance_share: self.stances as f64 / (2 * self.frames).max(1) as f64,
            frames: self.frames,
            ..Summary::default()
        };
        for (bone, ratio, frame) in flat.map(|flat| self.pops(flat)).unwrap_or_default() {
            if ratio > summary.pop_ratio {
                (summary.pop_ratio, summary.popped) = (ratio, Some((bone, frame)));
            }
        }
        summary
    }
}

fn degrees_between(a: DQuat, b: DQuat) -> f64 {
    let d = a.conjugate() * b;
    (2.0 * DVec3::new(d.x, d.y, d.z).length().atan2(d.w.abs())).to_degrees()
}
