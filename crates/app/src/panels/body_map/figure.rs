//! The drawn figure: one shape a bone, in points about the middle of the map, y down. Its left is at +x.

use std::sync::LazyLock;

use egui::{Pos2, pos2};
use rig::{Bone, Bone::*, Limb};

use super::outline::{capsule, egg, rounded};

/// The map's size, points.
pub const SIZE: egui::Vec2 = egui::vec2(300.0, 250.0);

/// The shape that chooses a bone.
#[derive(Clone, PartialEq, Debug)]
pub struct Shape {
    /// The bone.
    pub bone: Bone,
    /// Its convex outline.
    pub outline: Vec<Pos2>,
    /// Where its lock is drawn: at its joint.
    pub joint: Pos2,
}

/// Every shape, from behind to before.
pub static SHAPES: LazyLock<Vec<Shape>> = LazyLock::new(|| {
    let mut shapes = Vec::new();
    let mut left = legs();
    left.extend(arms());
    left.extend(fingers());
    let right: Vec<Shape> = left.iter().map(mirrored).collect();
    shapes.extend(left);
    shapes.extend(right);
    shapes.extend(middle());
    shapes
});

/// Where the mark of a limb's contact is.
pub fn contact_place(limb: Limb) -> Pos2 {
    let place = if limb.is_arm() { pos2(61.0, 138.0) } else { pos2(28.0, 236.0) };
    if limb.side() == rig::Side::Left { place } else { pos2(-place.x, place.y) }
}

/// The thin line from the small left hand to the large one.
pub const LEAD: [(f32, f32); 2] = [(57.0, 150.0), (95.0, 144.0)];

fn mirrored(shape: &Shape) -> Shape {
    let flip = |at: &Pos2| pos2(-at.x, at.y);
    Shape {
        bone: shape.bone.mirrored(),
        outline: shape.outline.iter().map(flip).collect(),
        joint: flip(&shape.joint),
    }
}

/// A tapered segment from a joint onward.
fn segment(bone: Bone, from: (f32, f32), from_radius: f32, to: (f32, f32), to_radius: f32) -> Shape {
    let outline = capsule(from, from_radius, to, to_radius);
    Shape { bone, outline, joint: pos2(from.0, from.1) }
}

fn plate(bone: Bone, joint: (f32, f32), corners: &[(f32, f32)], radius: f32) -> Shape {
    Shape { bone, outline: rounded(corners, radius), joint: pos2(joint.0, joint.1) }
}

/// A plate that is its own mirror image, by the corners of its left half from top to bottom.
fn slab(bone: Bone, joint_y: f32, half: &[(f32, f32)], radius: f32) -> Shape {
    let right = half.iter().rev().map(|(x, y)| (-x, *y));
    let corners: Vec<(f32, f32)> = half.iter().copied().chain(right).collect();
    plate(bone, (0.0, joint_y), &corners, radius)
}

fn middle() -> Vec<Shape> {
    let eye = |bone, x: f32| segment(bone, (x - 0.8, 18.5), 2.5, (x + 0.8, 18.5), 2.5);
    vec![
        slab(Neck, 42.0, &[(6.0, 32.0), (6.0, 44.0), (4.0, 52.0)], 3.0),
        slab(Hips, 117.0, &[(19.5, 107.0), (23.5, 121.0), (19.0, 126.0), (6.0, 132.0)], 5.0),
        slab(Spine, 97.5, &[(18.5, 91.0), (19.5, 105.0)], 4.0),
        slab(Chest, 81.0, &[(21.5, 73.5), (18.5, 89.0)], 4.0),
        slab(UpperChest, 63.0, &[(21.5, 55.5), (24.0, 60.0), (22.0, 71.5)], 4.5),
        Shape { bone: Head, outline: egg((0.0, 18.0), (13.0, 17.0), 0.24), joint: pos2(0.0, 9.0) },
        slab(Jaw, 31.0, &[(8.6, 27.5), (6.6, 33.6), (3.4, 36.2)], 2.6),
        eye(LeftEye, 5.4),
        eye(RightEye, -5.4),
    ]
}

fn arms() -> Vec<Shape> {
    vec![
        segment(LeftHand, (50.0, 136.5), 4.0, (52.5, 147.5), 4.6),
        segment(LeftLowerArm, (41.8, 97.5), 5.4, (48.4, 127.5), 3.9),
        segment(LeftUpperArm, (31.0, 56.0), 7.0, (39.4, 89.0), 5.4),
        segment(LeftShoulder, (9.6, 48.0), 3.4, (22.0, 49.5), 4.2),
    ]
}

fn legs() -> Vec<Shape> {
    vec![
        plate(LeftFoot, (11.5, 230.0), &[(7.4, 226.5), (14.4, 226.5), (19.0, 237.0), (5.4, 237.0)], 3.0),
        plate(LeftToes, (12.5, 242.0), &[(5.2, 238.6), (19.6, 238.6), (21.0, 245.0), (4.8, 245.0)], 2.6),
        segment(LeftLowerLeg, (12.2, 184.5), 7.0, (11.0, 219.0), 4.6),
        segment(LeftUpperLeg, (12.8, 133.0), 10.2, (12.2, 171.0), 7.4),
    ]
}

/// The large hand, seen from its back, fingers down and thumb toward the body.
fn fingers() -> Vec<Shape> {
    let palm = [(104.0, 140.0), (122.0, 140.0), (133.0, 160.0), (131.0, 176.0), (98.0, 176.0), (96.0, 158.0)];
    let mut shapes = vec![plate(LeftHand, (113.0, 150.0), &palm, 6.0)];
    let rays = [
        (
            [LeftThumbMetacarpal, LeftThumbProximal, LeftThumbDistal],
            (95.0, 160.0),
            (-0.62, 0.78),
            [9.0, 8.0, 6.5],
            4.4,
        ),
        (
            [LeftIndexProximal, LeftIndexIntermediate, LeftIndexDistal],
            (101.5, 183.0),
            (-0.13, 0.99),
            [12.5, 9.0, 7.0],
            3.9,
        ),
        (
            [LeftMiddleProximal, LeftMiddleIntermediate, LeftMiddleDistal],
            (110.5, 184.0),
            (-0.03, 1.0),
            [14.0, 10.5, 7.5],
            3.9,
        ),
        (
            [LeftRingProximal, LeftRingIntermediate, LeftRingDistal],
            (119.5, 183.5),
            (0.07, 1.0),
            [12.5, 9.5, 7.0],
            3.9,
        ),
        (
            [LeftLittleProximal, LeftLittleIntermediate, LeftLittleDistal],
            (128.2, 182.0),
            (0.19, 0.98),
            [9.0, 6.5, 5.5],
            3.5,
        ),
    ];
    for (bones, base, along, lengths, radius) in rays {
        shapes.extend(ray(bones, base, along, lengths, radius));
    }
    shapes
}

/// A finger's three segments, with a small gap between each two.
fn ray(bones: [Bone; 3], base: (f32, f32), along: (f32, f32), lengths: [f32; 3], radius: f32) -> Vec<Shape> {
    let mut start = base;
    let mut radius = radius;
    let mut shapes = Vec::new();
    for (bone, length) in bones.into_iter().zip(lengths) {
        // A segment's discs lie within its length, so it must be longer than they are.
        let straight = (length - 2.0 * radius + 4.0).max(1.0);
        let end = (start.0 + along.0 * straight, start.1 + along.1 * straight);
        shapes.push(segment(bone, start, radius, end, radius * 0.95));
        let step = straight + radius * 1.9 + 0.6;
        start = (start.0 + along.0 * step, start.1 + along.1 * step);
        radius *= 0.94;
    }
    shapes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::panels::body_map::outline::distance;

    /// The shape on top at a place.
    fn at(x: f32, y: f32) -> Option<Bone> {
        SHAPES.iter().rev().find(|shape| distance(&shape.outline, pos2(x, y)) == 0.0).map(|shape| shape.bone)
    }

    #[test]
    fn every_bone_has_a_shape_whose_middle_chooses_it() {
        for bone in Bone::ALL {
            let shape = SHAPES.iter().rev().find(|shape| shape.bone == bone).unwrap();
            let middle = egui::Rect::from_points(&shape.outline).center();
            assert_eq!(at(middle.x, middle.y), Some(bone), "{bone} at {middle}");
        }
    }

    #[test]
    fn the_figure_s_left_is_on_the_picture_s_right() {
        for shape in SHAPES.iter() {
            let x = egui::Rect::from_points(&shape.outline).center().x;
            match shape.bone.side() {
                Some(rig::Side::Left) => assert!(x > 3.0, "{}", shape.bone),
                Some(rig::Side::Right) => assert!(x < -3.0, "{}", shape.bone),
                None => assert!(x.abs() < 1e-3, "{}", shape.bone),
            }
        }
    }

    #[test]
    fn all_of_it_lies_on_the_map() {
        let all = egui::Rect::from_points(
            &SHAPES.iter().flat_map(|shape| shape.outline.clone()).collect::<Vec<_>>(),
        );
        assert!(all.left() >= -SIZE.x * 0.5 && all.right() <= SIZE.x * 0.5, "{all}");
        assert!(all.top() >= 0.0 && all.bottom() <= SIZE.y, "{all}");
    }
}
