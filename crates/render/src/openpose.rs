//! The OpenPose picture: 18 COCO keypoints and 17 limbs in the colours that its users expect.

use glam::Vec2;

use crate::overlay::{Form, Stroke};
use crate::scene::Scene;

/// Keypoint pairs, in drawing order: nose 0, neck 1, right arm 2-4, left arm 5-7, right leg 8-10, left leg 11-13,
/// eyes 14 15, ears 16 17; the right comes first.
const LIMBS: [(usize, usize); 17] = [
    (1, 2),
    (1, 5),
    (2, 3),
    (3, 4),
    (5, 6),
    (6, 7),
    (1, 8),
    (8, 9),
    (9, 10),
    (1, 11),
    (11, 12),
    (12, 13),
    (1, 0),
    (0, 14),
    (14, 16),
    (0, 15),
    (15, 17),
];

/// Colours of the keypoints; limb `i` has colour `i`, darkened.
const COLORS: [[u8; 3]; 18] = [
    [255, 0, 0],
    [255, 85, 0],
    [255, 170, 0],
    [255, 255, 0],
    [170, 255, 0],
    [85, 255, 0],
    [0, 255, 0],
    [0, 255, 85],
    [0, 255, 170],
    [0, 255, 255],
    [0, 170, 255],
    [0, 85, 255],
    [0, 0, 255],
    [85, 0, 255],
    [170, 0, 255],
    [255, 0, 255],
    [255, 0, 170],
    [255, 0, 85],
];

/// Radius of joints and half the thickness of limbs in a picture 512 pixels high or wide.
const RADIUS_PX: f32 = 4.0;

/// Strokes in clip space for a picture of that size, limbs below joints.
pub(crate) fn strokes(scene: &Scene<'_>, size: [u32; 2]) -> Vec<Stroke> {
    let size = Vec2::new(size[0] as f32, size[1] as f32);
    let radius = RADIUS_PX * size.min_element() / 512.0;
    let mut at: Vec<[Option<Vec2>; 18]> = Vec::new();
    for &(number, point) in scene.keypoints.iter().filter(|(n, _)| *n < COLORS.len()) {
        let pixel = scene.camera.pixel_of(point.as_vec3(), size);
        // A number that comes again starts the next person.
        match at.last_mut() {
            Some(person) if person[number].is_none() => person[number] = pixel,
            _ => {
                let mut person = [None; 18];
                person[number] = pixel;
                at.push(person);
            }
        }
    }
    let ndc = |p: Vec2| [p.x / size.x * 2.0 - 1.0, 1.0 - p.y / size.y * 2.0, 0.0];
    let stroke = |a: Vec2, b: Vec2, [r, g, b2]: [u8; 3], form: Form| Stroke {
        from: ndc(a),
        to: ndc(b),
        color: [r, g, b2, 255],
        outline: [0; 4],
        shape: [radius, 0.0, 0.0, form as u8 as f32],
    };
    let mut out = Vec::new();
    for person in &at {
        for (&(a, b), color) in LIMBS.iter().zip(COLORS) {
            if let (Some(a), Some(b)) = (person[a], person[b]) {
                out.push(stroke(a, b, color.map(|c| (f32::from(c) * 0.6) as u8), Form::Ellipse));
            }
        }
        for (p, color) in person.iter().zip(COLORS) {
            out.extend(p.map(|p| stroke(p, p, color, Form::Capsule)));
        }
    }
    out
}
