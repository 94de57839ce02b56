//! The soles of shipped figures lie under their skin.

#![allow(clippy::unwrap_used)] // helpers of tests may unwrap too

mod figures;

use std::collections::BTreeMap;

use figures::{all_shipped, shipped};
use motion::{Sole, Soles};
use rig::{Bone, Figure, Limb, frames};

fn points(figure: &Figure) -> [[glam::DVec3; Sole::COUNT]; 2] {
    let at_rest = frames(figure, &figure.rest_pose());
    Soles::of(figure).unwrap().feet.map(|sole| sole.points(&at_rest))
}

#[test]
fn soles_of_every_preset_lie_on_the_floor_at_rest_and_touch_the_skin() {
    for (name, figure) in all_shipped() {
        let skin = figure.skin.as_ref().unwrap();
        for foot in points(&figure) {
            for (i, p) in foot.iter().enumerate() {
                assert!(p.y.abs() < 5e-4, "{name} {i}: {p} is off the floor");
                let near =
                    skin.positions.iter().map(|v| (glam::Vec3::from_array(*v).as_dvec3() - *p).length());
                let nearest = near.fold(f64::INFINITY, f64::min);
                assert!(nearest < 0.008, "{name} {i}: {p} is {nearest} from the skin");
            }
        }
    }
}

/// The deepest that any skin of a foot lies under its sole's lowest point as the foot pitches: so much may a heel
/// or a toe sink that the points say is on the ground.
#[test]
fn the_skin_of_a_pitched_foot_is_hardly_below_its_lowest_sole_point() {
    for (name, figure) in all_shipped() {
        let skin = figure.skin.as_ref().unwrap();
        let ankle = figure.skeleton.rest_position(Bone::LeftFoot);
        let sole = points(&figure)[0];
        for pitch in [-30.0_f64, -20.0, -10.0, 10.0, 20.0, 30.0] {
            let turn = glam::DQuat::from_rotation_x(pitch.to_radians());
            let height = |p: glam::DVec3| (turn * (p - ankle)).y;
            let lowest = sole.iter().map(|p| height(*p)).fold(f64::INFINITY, f64::min);
            let skin = skin.positions.iter().map(|v| glam::Vec3::from_array(*v).as_dvec3());
            let skin = skin.filter(|p| p.x > 0.0 && p.y < 0.1).map(height).fold(f64::INFINITY, f64::min);
            assert!(lowest - skin < 0.0025, "{name} at {pitch}: {} mm", (lowest - skin) * 1e3);
        }
    }
}

#[test]
fn soles_are_mirror_images_and_their_edges_lie_on_either_side() {
    for (name, figure) in all_shipped() {
        let [left, right] = points(&figure);
        for (l, r) in left.iter().zip(&right) {
            let image = glam::DVec3::new(-r.x, r.y, r.z);
            assert!(l.distance(image) < 0.002, "{name}: {l} and {r}");
        }
        for place in [Sole::HEEL, Sole::BALL, Sole::TOES] {
            let [middle, outer, inner] = [left[place], left[place + 1], left[place + 2]];
            assert!(
                outer.x > middle.x + 0.01 && inner.x < middle.x - 0.01,
                "{name}: {outer} {middle} {inner}"
            );
        }
        assert!(left[Sole::HEEL].z < left[Sole::BALL].z && left[Sole::BALL].z < left[Sole::TOES].z);
    }
}

#[test]
fn without_skin_and_articulators_soles_are_guessed_nearby() {
    let figure = shipped("mannequin");
    let with = points(&figure)[0];
    let bare = Figure { skin: None, ..figure.clone() };
    let poor = Figure { articulators: std::array::from_fn(|_| BTreeMap::new()), ..bare.clone() };
    for (i, p) in points(&bare)[0].iter().enumerate() {
        assert!(p.distance(with[i]) < 0.010, "{i}: {p} instead of {}", with[i]);
    }
    for (i, p) in points(&poor)[0].iter().enumerate() {
        assert!(p.distance(with[i]) < 0.025, "{i}: {p} instead of {}", with[i]);
    }
    assert!(figure.articulators[Limb::LeftLeg.index()].contains_key("heel"), "else the test tells nothing");
}
