//! A crowd does what single figures do, many at a time.

use glam::{DVec3, Mat4, Vec3, Vec4};
use motion::crowd::{Crowd, CrowdFigure, Gait, Gaits, Heights, LANES, Matrices};
use motion::{Ground, Sample};
use rig::{Angles, Bone, Bounds, Figure, PLACES, Place, Pose};

fn figure() -> Figure {
    interchange::figure::bare_mannequin().expect("the shipped figure loads")
}

/// A stride in which everything moves.
fn samples(figure: &Figure, count: usize) -> Vec<Sample> {
    let rest = figure.rest_pose();
    let at = |i: usize| {
        let swing = (i as f64 / count as f64 * std::f64::consts::TAU).sin();
        let mut angles = rest.angles;
        for (bone, side) in [(Bone::LeftUpperLeg, 1.0), (Bone::RightUpperLeg, -1.0)] {
            angles[bone.index()] = Angles { flexion: 22.0 * side * swing, abduction: 3.0, twist: 6.0 };
            angles[bone.index() + 1] = Angles { flexion: 24.0 - 12.0 * side * swing, ..Angles::REST };
            angles[bone.index() + 2] = Angles { flexion: -8.0 * swing, abduction: 4.0, twist: 0.0 };
        }
        for (bone, side) in [(Bone::LeftUpperArm, -1.0), (Bone::RightUpperArm, 1.0)] {
            angles[bone.index()] = Angles { flexion: 20.0 * side * swing, abduction: -70.0, twist: 10.0 };
        }
        angles[Bone::Hips.index()] = Angles { flexion: 2.0, abduction: 3.0 * swing, twist: 5.0 * swing };
        angles[Bone::LeftLowerArm.index()] = Angles { flexion: 30.0, abduction: 0.0, twist: 20.0 * swing };
        let hips = rest.hips - DVec3::new(0.01 * swing, 0.03, 0.0);
        Sample { hips, angles, bearing: Default::default() }
    };
    (0..count).map(at).collect()
}

fn crowd(figure: &Figure, samples: Vec<Sample>, count: usize, half: f32) -> Crowd {
    let shape = CrowdFigure::of(figure).expect("two legs");
    let gait = Gait { speed: 1.4, length_secs: 1.05, samples };
    Crowd::new(shape, Gaits::new(figure, &[gait]).expect("a gait"), count, half, 7)
}

/// World from rest, of one figure's place of the palette.
fn matrix(blocks: &[Matrices], who: usize, place: usize) -> Mat4 {
    let rows = &blocks[who / LANES][place];
    let column = |k: usize, w: f32| {
        let [x, y, z] = [0, 1, 2].map(|c: usize| rows[3 * k + c].0[who % LANES]);
        Vec4::new(x, y, z, w)
    };
    Mat4::from_cols(column(0, 0.0), column(1, 0.0), column(2, 0.0), column(3, 1.0))
}

/// Where a joint's rest place is.
fn joint(figure: &Figure, blocks: &[Matrices], who: usize, bone: Bone) -> Vec3 {
    let rest = figure.skeleton.rest_position(bone).as_vec3();
    matrix(blocks, who, bone.index()).transform_point3(rest)
}

#[test]
fn on_flat_ground_everyone_is_as_one_figure_alone() {
    let figure = figure();
    let sample = samples(&figure, 8).swap_remove(3);
    let mut crowd = crowd(&figure, vec![sample.clone()], 40, 30.0);
    crowd.step(&Heights::of(&Ground::Flat, 30.0, 1.0), 1.0 / 60.0);
    let alone = Pose { hips: sample.hips, angles: sample.angles, ..figure.rest_pose() };
    let rest = Bone::ALL.map(|bone| figure.skeleton.rest_position(bone));
    for who in 0..40 {
        // The row after the palette tells where the figure stands and faces.
        let stands = matrix(crowd.matrices(), who, PLACES);
        let turn = f64::from(stands.x_axis.z).atan2(f64::from(stands.x_axis.x)).to_degrees();
        let place = Place { position: stands.w_axis.truncate().as_dvec3(), turn: -turn };
        let palette = rig::Palette::new(&rig::frames(&figure, &Pose { place, ..alone.clone() }), &rest);
        for place in 0..PLACES {
            let at = rest[rig::bone_of_place(place).index()].as_vec3() + Vec3::new(0.05, -0.1, 0.08);
            let ours = matrix(crowd.matrices(), who, place).transform_point3(at);
            let theirs = moved(&palette, place, at);
            assert!(ours.distance(theirs) < 2e-4, "figure {who}, place {place}: {ours} and {theirs}");
        }
    }
}

/// What a place of a palette does to a point: real and dual part as in the shader.
fn moved(palette: &rig::Palette, place: usize, at: Vec3) -> Vec3 {
    let [r, d] = palette.0[place];
    let turn = glam::Quat::from_array(r);
    let (rv, dv) = (Vec3::new(r[0], r[1], r[2]), Vec3::new(d[0], d[1], d[2]));
    turn * at + 2.0 * (r[3] * dv - d[3] * rv + rv.cross(dv))
}

#[test]
fn on_a_slope_ankles_are_over_the_ground_as_in_the_motion() {
    let figure = figure();
    let slope = |x: f64, z: f64| 0.2 * x - 0.3 * z;
    let mut flat = crowd(&figure, samples(&figure, 32), 64, 30.0);
    let mut sloped = flat.clone();
    let level = Heights::of(&Ground::Flat, 30.0, 0.5);
    let heights = Heights::from_fn(slope, 30.0, 0.5);
    for _ in 0..40 {
        flat.step(&level, 1.0 / 60.0);
        sloped.step(&heights, 1.0 / 60.0);
    }
    // Hips that had time to follow are as low as the lower foot asks.
    sloped.place_feet(&heights, f32::INFINITY);
    sloped.write();
    for who in 0..64 {
        for bone in [Bone::LeftFoot, Bone::RightFoot] {
            let animated = joint(&figure, flat.matrices(), who, bone);
            let placed = joint(&figure, sloped.matrices(), who, bone);
            let wanted = animated + Vec3::Y * slope(f64::from(animated.x), f64::from(animated.z)) as f32;
            assert!(placed.distance(wanted) < 2e-3, "figure {who}, {bone:?}: {placed}, wanted {wanted}");
        }
    }
}

#[test]
fn thighs_and_shins_keep_their_lengths_on_any_ground() {
    let figure = figure();
    let mut crowd = crowd(&figure, samples(&figure, 32), 64, 30.0);
    let cliff = |x: f64, z: f64| if (x + z).rem_euclid(3.0) < 1.5 { 0.0 } else { 4.0 };
    let heights = Heights::from_fn(cliff, 30.0, 0.25);
    for _ in 0..60 {
        crowd.step(&heights, 1.0 / 60.0);
        for who in 0..64 {
            let at = |bone| joint(&figure, crowd.matrices(), who, bone);
            for [a, b] in [[Bone::LeftUpperLeg, Bone::LeftLowerLeg], [Bone::RightLowerLeg, Bone::RightFoot]] {
                let rest = figure.skeleton.rest_position(a).distance(figure.skeleton.rest_position(b)) as f32;
                assert!((at(a).distance(at(b)) - rest).abs() < 1e-3, "figure {who}, {a:?}");
            }
        }
    }
}

#[test]
fn same_start_and_steps_give_the_same_bits_and_nobody_leaves() {
    let figure = figure();
    let heights = Heights::from_fn(|x, z| 0.1 * (x + z).sin(), 12.0, 0.25);
    let run = || {
        let mut crowd = crowd(&figure, samples(&figure, 32), 20, 12.0);
        for _ in 0..1200 {
            crowd.step(&heights, 1.0 / 30.0);
        }
        crowd
    };
    let (a, b) = (run(), run());
    assert_eq!(a.matrices(), b.matrices());
    let square = Bounds { min: Vec3::new(-14.0, -9.0, -14.0), max: Vec3::new(14.0, 9.0, 14.0) };
    for who in 0..20 {
        let hips = joint(&figure, a.matrices(), who, Bone::Hips);
        assert!(hips.clamp(square.min, square.max) == hips, "figure {who} at {hips}");
    }
}

#[test]
fn tables_without_sense_are_none() {
    let figure = figure();
    let gait = |speed, length_secs, samples| Gait { speed, length_secs, samples };
    let some = samples(&figure, 4);
    assert_eq!(Gaits::new(&figure, &[]), None);
    assert_eq!(Gaits::new(&figure, &[gait(1.0, 1.0, Vec::new())]), None);
    assert_eq!(Gaits::new(&figure, &[gait(1.0, 0.0, some.clone())]), None);
    assert_eq!(Gaits::new(&figure, &[gait(f32::NAN, 1.0, some)]), None);
}
