//! The OpenPose picture: body, feet and hands in the colours that its users expect.

use glam::{DVec3, Vec2};

use crate::keypoints::Keypoints;
use crate::overlay::{Form, Stroke};
use crate::scene::Scene;

/// Pairs of body keypoints in drawing order, as in [`Keypoints::body`].
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

/// Colours of the body's keypoints; limb `i` has colour `i`, darkened.
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

/// From the ankle (a body keypoint) to the toes and the heel (foot keypoints), with the colour of BODY_25's feet.
const FEET: [(usize, [usize; 3], [u8; 3]); 2] =
    [(13, [0, 1, 2], [0, 0, 255]), (10, [3, 4, 5], [0, 255, 255])];

/// Colour of the hands' points; their lines have the rainbow's colours.
const HAND_POINT: [u8; 3] = [0, 0, 255];

/// Radius of joints and half the thickness of limbs in a picture 512 pixels high or wide.
const RADIUS_PX: f32 = 4.0;
/// Half the thickness of a hand's lines.
const HAND_LINE_PX: f32 = 1.0;
/// Points of a small hand shrink, so that its fingers stay apart: to this share of its shortest finger's longest bone.
const HAND_POINT_SHARE: f32 = 0.2;

/// What is needed to place strokes.
struct Canvas<'a> {
    scene: &'a Scene<'a>,
    /// Of the picture that the strokes are drawn to.
    size: Vec2,
    /// Pixels for one pixel of a picture of 512.
    unit_px: f32,
    out: Vec<Stroke>,
}

/// Strokes in clip space for a picture of that size, limbs below joints, hands on top.
pub(crate) fn strokes(scene: &Scene<'_>, size: [u32; 2]) -> Vec<Stroke> {
    let size = Vec2::new(size[0] as f32, size[1] as f32);
    let mut canvas = Canvas { scene, size, unit_px: size.min_element() / 512.0, out: Vec::new() };
    for person in scene.keypoints {
        canvas.body(person);
        canvas.hand(&person.left_hand);
        canvas.hand(&person.right_hand);
    }
    canvas.out
}

impl Canvas<'_> {
    fn pixel(&self, point: Option<DVec3>) -> Option<Vec2> {
        point.and_then(|p| self.scene.camera.pixel_of(p.as_vec3(), self.size))
    }

    fn stroke(&mut self, a: Vec2, b: Vec2, [red, green, blue]: [u8; 3], radius_px: f32, form: Form) {
        let ndc = |p: Vec2| [p.x / self.size.x * 2.0 - 1.0, 1.0 - p.y / self.size.y * 2.0, 0.0];
        self.out.push(Stroke {
            from: ndc(a),
            to: ndc(b),
            color: [red, green, blue, 255],
            outline: [0; 4],
            shape: [radius_px, 0.0, 0.0, form as u8 as f32],
        });
    }

    fn body(&mut self, person: &Keypoints) {
        let body = person.body.map(|p| self.pixel(p));
        let feet = person.feet.map(|p| self.pixel(p));
        let radius = RADIUS_PX * self.unit_px;
        for (&(a, b), color) in LIMBS.iter().zip(COLORS) {
            if let (Some(a), Some(b)) = (body[a], body[b]) {
                self.stroke(a, b, darkened(color), radius, Form::Ellipse);
            }
        }
        for (ankle, [big, little, heel], color) in FEET {
            for (a, b) in [(body[ankle], feet[big]), (feet[big], feet[little]), (body[ankle], feet[heel])] {
                if let (Some(a), Some(b)) = (a, b) {
                    self.stroke(a, b, darkened(color), radius * 0.6, Form::Ellipse);
                }
            }
            for p in [big, little, heel].into_iter().filter_map(|i| feet[i]) {
                self.stroke(p, p, color, radius * 0.7, Form::Capsule);
            }
        }
        for (p, color) in body.into_iter().zip(COLORS) {
            if let Some(p) = p {
                self.stroke(p, p, color, radius, Form::Capsule);
            }
        }
    }

    fn hand(&mut self, points: &[Option<DVec3>]) {
        let at: Vec<Option<Vec2>> = points.iter().map(|&p| self.pixel(p)).collect();
        let bones: Vec<(usize, Vec2, Vec2)> = (1..at.len())
            .filter_map(|i| {
                // Each finger starts at the wrist.
                let from = if i % 4 == 1 { 0 } else { i - 1 };
                at[from].zip(at[i]).map(|(a, b)| (i - 1, a, b))
            })
            .collect();
        let finger = |f: usize| {
            let of_it = bones.iter().filter(|(i, _, _)| i / 4 == f && i % 4 > 0);
            of_it.map(|(_, a, b)| a.distance(*b)).fold(0.0, f32::max)
        };
        let shortest = (0..5).map(finger).filter(|&length| length > 0.0).fold(f32::MAX, f32::min);
        let radius = (RADIUS_PX * self.unit_px).min((shortest * HAND_POINT_SHARE).max(0.8));
        let line = (HAND_LINE_PX * self.unit_px).min(radius * 0.6).max(0.5);
        let edges = at.len() - 1;
        for (edge, a, b) in bones {
            self.stroke(a, b, rainbow(edge, edges), line, Form::Capsule);
        }
        for p in at.into_iter().flatten() {
            self.stroke(p, p, HAND_POINT, radius, Form::Capsule);
        }
    }
}

fn darkened(color: [u8; 3]) -> [u8; 3] {
    color.map(|c| (f32::from(c) * 0.6) as u8)
}

/// The full colour at that place of so many around the circle of hues, red first.
fn rainbow(place: usize, of: usize) -> [u8; 3] {
    let hue = place as f32 / of.max(1) as f32 * 6.0;
    let channel = |shift: f32| {
        let x = (hue + shift).rem_euclid(6.0);
        let level = ((x - 3.0).abs() - 1.0).clamp(0.0, 1.0);
        (level * 255.0) as u8
    };
    [channel(0.0), channel(4.0), channel(2.0)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rainbow_runs_from_red_over_green_to_blue() {
        assert_eq!(rainbow(0, 20), [255, 0, 0]);
        assert_eq!(rainbow(1, 6), [255, 255, 0]);
        assert_eq!(rainbow(2, 6), [0, 255, 0]);
        assert_eq!(rainbow(4, 6), [0, 0, 255]);
        assert_eq!(rainbow(10, 20), [0, 255, 255]);
    }
}
