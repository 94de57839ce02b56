//! Handshapes close on the sculpted skin: what should touch touches, nothing goes through.

use std::sync::OnceLock;

use rig::{Handshape, Mesh};

use super::contact::Hand;
use super::contact::Piece::{self, Finger, Palm, Tip};
use super::posing::posed;
use super::tests::{sculpt, shipped};

/// How far apart pieces that should touch may be, and how deep any may lie in another, millimetres.
const APART: f64 = 1.0;
const DEEP: f64 = 1.0;

fn handshapes() -> &'static std::collections::BTreeMap<String, Handshape> {
    static SHAPES: OnceLock<std::collections::BTreeMap<String, Handshape>> = OnceLock::new();
    SHAPES.get_or_init(|| interchange::figure::bare_mannequin().unwrap().handshapes)
}

/// The left hand of a skin: the rest is of no concern here and only takes time.
fn left_hand(mesh: &Mesh) -> Mesh {
    let wrist = shipped().rest_position(rig::Bone::LeftHand).x as f32;
    let mut place = vec![u32::MAX; mesh.positions.len()];
    let mut hand = Mesh::default();
    for (v, position) in mesh.positions.iter().enumerate().filter(|(_, p)| p[0] > wrist - 0.03) {
        place[v] = hand.positions.len() as u32;
        hand.positions.push(*position);
        hand.normals.push(mesh.normals[v]);
        hand.colors.push(mesh.colors[v]);
        hand.joints.push(mesh.joints[v]);
        hand.weights.push(mesh.weights[v]);
    }
    let kept = |t: &&[u32]| t.iter().all(|&v| place[v as usize] != u32::MAX);
    hand.indices = mesh.indices.chunks_exact(3).filter(kept).flatten().map(|&v| place[v as usize]).collect();
    hand
}

/// The hand at rest and in a handshape.
fn shaped(name: &str) -> (Mesh, Mesh) {
    let rest = left_hand(sculpt());
    let angles = handshapes()[name].iter().map(|(bone, a)| (*bone, [a.flexion, a.abduction, a.twist]));
    let posed = posed(&rest, &shipped(), &angles.collect::<Vec<_>>());
    (rest, posed)
}

fn gap_mm(name: &str, one: Piece, other: Piece) -> f64 {
    let (rest, posed) = shaped(name);
    Hand::new(&posed, &rest).gap(one, other) * 1000.0
}

fn touch(name: &str, pairs: &[(Piece, Piece)]) {
    for &(one, other) in pairs {
        let gap = gap_mm(name, one, other);
        assert!(gap.abs() <= APART, "{name}: {one:?} is {gap:.2} mm from {other:?}");
    }
}

#[test]
fn fingers_of_no_handshape_go_through_each_other_or_the_palm() {
    for name in handshapes().keys() {
        let (rest, posed) = shaped(name);
        let hand = Hand::new(&posed, &rest);
        for finger in 0..5 {
            let others = (finger + 1..5).map(Finger).chain([Palm]);
            for other in others {
                let gap = hand.gap(Finger(finger), other) * 1000.0;
                assert!(gap >= -DEEP, "{name}: finger {finger} lies {:.2} mm deep in {other:?}", -gap);
            }
        }
    }
}

#[test]
fn a_fist_closes_on_the_palm_with_the_thumb_over_the_fingers() {
    for finger in 1..5 {
        touch("fist", &[(Tip(finger), Palm)]);
    }
    for name in ["fist", "s", "i"] {
        touch(name, &[(Finger(0), Finger(1)), (Tip(0), Finger(2))]);
    }
    touch("point", &[(Tip(0), Finger(2))]);
}

#[test]
fn closed_fingers_reach_the_palm_where_the_thumb_stands_off_too() {
    for finger in 1..5 {
        touch("thumbsUp", &[(Tip(finger), Palm)]);
    }
    for finger in 1..4 {
        touch("y", &[(Tip(finger), Palm)]);
    }
}

#[test]
fn the_fingers_of_a_flat_o_lie_side_by_side() {
    touch("flatO", &[(Finger(1), Finger(2)), (Finger(2), Finger(3)), (Finger(3), Finger(4))]);
}

#[test]
fn the_thumb_lies_on_the_fingers_of_letters() {
    touch("a", &[(Tip(0), Finger(1))]);
    touch("v", &[(Tip(0), Finger(3))]);
    touch("w", &[(Tip(0), Finger(4))]);
}

#[test]
fn fingertips_meet_the_thumb() {
    touch("pinch", &[(Tip(0), Tip(1))]);
    touch("o", &[(Tip(0), Tip(1)), (Tip(0), Tip(2))]);
    touch("flatO", &[(Tip(0), Tip(1)), (Tip(0), Tip(2))]);
}
