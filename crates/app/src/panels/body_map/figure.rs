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
    let place = if limb.is_arm() { pos2(63.5, 140.0) } else { pos2(31.0, 237.0) };
    if limb.side() == rig::Side::Left { place } else { pos2(-place.x, place.y) }
}

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
    let head = egg((0.0, 18.0), (13.0, 17.0), 0.2);
    // The jaw is the head below the mouth, so that both make one outline.
    let jaw = below(&head, 28.5);
    let eye = |bone, x: f32| segment(bone, (x - 0.5, 18.0), 1.8, (x + 0.5, 18.0), 1.8);
    vec![
        slab(Neck, 41.0, &[(6.0, 31.0), (6.0, 44.0), (4.8, 51.2)], 3.0),
        slab(Hips, 116.0, &[(19.0, 106.6), (22.5, 115.0), (23.8, 121.5), (19.5, 126.5), (6.5, 132.0)], 4.0),
        slab(Spine, 98.0, &[(18.6, 90.2), (19.0, 106.4)], 2.2),
        slab(Chest, 81.5, &[(22.4, 72.8), (18.8, 90.0)], 2.2),
        slab(UpperChest, 64.0, &[(5.0, 52.0), (21.0, 56.5), (24.2, 62.0), (22.8, 72.6)], 3.0),
        Shape { bone: Head, outline: head, joint: pos2(0.0, 9.0) },
        Shape { bone: Jaw, outline: jaw, joint: pos2(0.0, 31.0) },
        eye(LeftEye, 5.0),
        eye(RightEye, -5.0),
    ]
}

/// The part of a convex outline below a height.
fn below(outline: &[Pos2], y: f32) -> Vec<Pos2> {
    let mut part = Vec::new();
    for (a, b) in outline.iter().zip(outline.iter().cycle().skip(1)) {
        if a.y >= y {
            part.push(*a);
        }
        if (a.y >= y) != (b.y >= y) {
            part.push(a.lerp(*b, (y - a.y) / (b.y - a.y)));
        }
    }
    part
}

fn arms() -> Vec<Shape> {
    vec![
        segment(LeftHand, (50.2, 136.4), 4.4, (52.8, 147.0), 5.0),
        segment(LeftLowerArm, (41.8, 97.5), 5.4, (48.4, 127.5), 3.9),
        segment(LeftUpperArm, (31.0, 56.0), 7.0, (39.4, 89.0), 5.4),
        plate(
            LeftShoulder,
            (14.0, 48.0),
            &[(7.6, 43.0), (11.0, 43.4), (25.0, 49.0), (24.0, 55.0), (7.6, 50.6)],
            2.5,
        ),
    ]
}

fn legs() -> Vec<Shape> {
    vec![
        plate(LeftFoot, (11.5, 230.0), &[(6.8, 224.6), (15.0, 224.6), (20.4, 237.0), (5.2, 237.0)], 3.5),
        plate(LeftToes, (12.5, 242.0), &[(5.0, 237.8), (20.6, 237.8), (22.4, 245.6), (4.4, 245.6)], 3.0),
        segment(LeftLowerLeg, (12.2, 184.5), 7.0, (11.0, 219.0), 4.6),
        segment(LeftUpperLeg, (12.8, 133.0), 10.2, (12.2, 171.0), 7.4),
    ]
}

/// The large hand, seen from its back, fingers down and thumb toward the body.
fn fingers() -> Vec<Shape> {
    let palm = [(104.0, 136.0), (121.5, 136.0), (135.6, 158.0), (134.4, 174.2), (95.0, 175.8), (93.4, 156.0)];
    let mut shapes = vec![plate(LeftHand, (113.0, 150.0), &palm, 6.0)];
    let rays = [
        (
            [LeftThumbMetacarpal, LeftThumbProximal, LeftThumbDistal],
            (97.0, 152.0),
            (-0.6, 0.8),
            [17.0, 15.0, 13.5],
            5.4,
        ),
        (
            [LeftIndexProximal, LeftIndexIntermediate, LeftIndexDistal],
            (99.6, 180.0),
            (-0.12, 0.99),
            [19.0, 15.0, 13.0],
            4.8,
        ),
        (
            [LeftMiddleProximal, LeftMiddleIntermediate, LeftMiddleDistal],
            (110.0, 181.0),
            (-0.03, 1.0),
            [21.0, 16.5, 13.5],
            4.8,
        ),
        (
            [LeftRingProximal, LeftRingIntermediate, LeftRingDistal],
            (120.4, 180.5),
            (0.06, 1.0),
            [19.0, 15.0, 13.0],
            4.8,
        ),
        (
            [LeftLittleProximal, LeftLittleIntermediate, LeftLittleDistal],
            (130.2, 178.5),
            (0.17, 0.985),
            [15.0, 12.0, 11.0],
            4.3,
        ),
    ];
    for (bones, base, along, lengths, radius) in rays {
        shapes.extend(ray(bones, base, along, lengths, radius));
    }
    shapes
}

/// A finger's three segments, each as long as given and a little over the one before; the seam parts them.
fn ray(bones: [Bone; 3], base: (f32, f32), along: (f32, f32), lengths: [f32; 3], radius: f32) -> Vec<Shape> {
    let (mut start, mut radius) = (base, radius);
    let mut shapes = Vec::new();
    for (bone, length) in bones.into_iter().zip(lengths) {
        let tip = radius * 0.94;
        let onward = |by: f32| (start.0 + along.0 * by, start.1 + along.1 * by);
        let end = onward(length - radius - tip);
        shapes.push(segment(bone, start, radius, end, tip));
        start = onward(length - 0.4);
        radius = tip;
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
