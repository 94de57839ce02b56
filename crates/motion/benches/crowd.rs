//! Ten thousand walkers: the legs' solves alone, and with every matrix written. On one core.
//!
//! The yardstick is plain forward kinematics and skinning matrices of as many bones, one figure at a time, in the same
//! run: what other programs take is known as a ratio to it (docs/performance.md).

#![allow(missing_docs, clippy::unwrap_used)]

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::{Affine3A, DVec3, Quat, Vec3};
use motion::crowd::{Company, Crowd, CrowdFigure, Gait, Gaits, Heights, ROWS};
use motion::{Ground, Sample};
use rig::{Angles, Bone, Figure};

const WALKERS: usize = 10_000;

fn crowd(c: &mut Criterion) {
    let figure = interchange::figure::bare_mannequin().unwrap();
    let heights = Heights::of(&Ground::Flat, 60.0, 0.25);
    let shape = CrowdFigure::of(&figure).unwrap();
    let gaits = Gaits::new(&figure, &[gait(&figure)]).unwrap();
    let mut crowd = Crowd::new(shape, gaits, WALKERS, 60.0, 1);
    crowd.step(&heights, 1.0 / 60.0);
    let mut group = c.benchmark_group("crowd of 10,000");
    group.sample_size(30);
    group.bench_function("feet placed", |b| b.iter(|| crowd.place_feet(black_box(&heights), 1.0 / 60.0)));
    group.bench_function("feet placed, matrices written", |b| {
        b.iter(|| {
            crowd.place_feet(black_box(&heights), 1.0 / 60.0);
            crowd.write();
        });
    });
    group.bench_function("joints sampled", |b| b.iter(|| crowd.sample()));
    group.bench_function("whole step", |b| b.iter(|| crowd.step(black_box(&heights), 1.0 / 60.0)));
    group.bench_function("whole step, going round each other", |b| {
        b.iter(|| {
            let company = Company::of(crowd.places(), heights.half());
            crowd.step_among(&company, black_box(&heights), 1.0 / 60.0);
        });
    });
    let bones = Bones::any();
    let mut out = vec![Affine3A::IDENTITY; ROWS];
    group.bench_function("yardstick: matrices of one figure, plain", |b| {
        b.iter(|| bones.matrices(black_box(&mut out)));
    });
    group.finish();
}

/// As many bones as a crowd writes matrices for, in chains of five.
struct Bones {
    carriers: Vec<usize>,
    turns: Vec<Quat>,
    offsets: Vec<Vec3>,
    rest_inverse: Vec<Affine3A>,
}

impl Bones {
    fn any() -> Bones {
        let turn = |i: usize| Quat::from_euler(glam::EulerRot::XYZ, 0.1 * i as f32, 0.2, -0.05 * i as f32);
        Bones {
            carriers: (0..ROWS).map(|i| if i % 5 == 0 { 0 } else { i - 1 }).collect(),
            turns: (0..ROWS).map(turn).collect(),
            offsets: (0..ROWS).map(|i| Vec3::new(0.01 * i as f32, 0.1, 0.0)).collect(),
            rest_inverse: (0..ROWS).map(|i| Affine3A::from_rotation_translation(turn(i), Vec3::Y)).collect(),
        }
    }

    fn matrices(&self, out: &mut [Affine3A]) {
        let mut posed = [Affine3A::IDENTITY; ROWS];
        for i in 0..ROWS {
            let local = Affine3A::from_rotation_translation(self.turns[i], self.offsets[i]);
            posed[i] = if i == 0 { local } else { posed[self.carriers[i]] * local };
            out[i] = posed[i] * self.rest_inverse[i];
        }
    }
}

/// A stride of 32 phases in which every joint of the legs, the trunk and the arms moves.
fn gait(figure: &Figure) -> Gait {
    let rest = figure.rest_pose();
    let samples = (0..32).map(|i| {
        let swing = (f64::from(i) / 32.0 * std::f64::consts::TAU).sin();
        let mut angles = rest.angles;
        for (bone, side) in [(Bone::LeftUpperLeg, 1.0), (Bone::RightUpperLeg, -1.0)] {
            angles[bone.index()] = Angles { flexion: 20.0 * side * swing, ..Angles::REST };
        }
        for bone in [Bone::LeftLowerLeg, Bone::RightLowerLeg, Bone::LeftLowerArm, Bone::RightLowerArm] {
            angles[bone.index()] = Angles { flexion: 20.0 + 10.0 * swing, ..Angles::REST };
        }
        for bone in [Bone::Hips, Bone::Spine, Bone::Chest, Bone::UpperChest, Bone::Neck, Bone::Head] {
            angles[bone.index()] = Angles { twist: 3.0 * swing, ..Angles::REST };
        }
        Sample { hips: rest.hips - DVec3::Y * 0.03, angles, bearing: Default::default() }
    });
    Gait { speed: 1.4, length_secs: 1.05, samples: samples.collect() }
}

criterion_group!(benches, crowd);
criterion_main!(benches);
