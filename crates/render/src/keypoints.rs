//! Keypoints of a person as OpenPose and its users number them: body, feet and hands.

use glam::DVec3;

/// Keypoints of the body, [`Keypoints::body`].
pub const BODY_POINTS: usize = 18;
/// Keypoints of both feet, [`Keypoints::feet`].
pub const FOOT_POINTS: usize = 6;
/// Keypoints of a hand, [`Keypoints::left_hand`].
pub const HAND_POINTS: usize = 21;

/// Where a person's keypoints are: world space, metres; `None` where the figure lacks it.
///
/// Points with a number that is not finite, and points behind the eye, are not drawn.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Keypoints {
    /// COCO-18, the right side first: nose 0, neck 1, right shoulder, elbow, wrist 2-4, left 5-7, right hip, knee,
    /// ankle 8-10, left 11-13, eyes 14 15, ears 16 17.
    pub body: [Option<DVec3>; BODY_POINTS],
    /// As in COCO-WholeBody and BODY_25: left big toe, little toe, heel, then the right foot's.
    pub feet: [Option<DVec3>; FOOT_POINTS],
    /// Wrist 0, then four points each from the root to the tip: thumb 1-4, index 5-8, middle 9-12, ring 13-16,
    /// little finger 17-20.
    pub left_hand: [Option<DVec3>; HAND_POINTS],
    /// As the left one.
    pub right_hand: [Option<DVec3>; HAND_POINTS],
}

impl Default for Keypoints {
    /// A person without any point.
    fn default() -> Keypoints {
        Keypoints {
            body: [None; BODY_POINTS],
            feet: [None; FOOT_POINTS],
            left_hand: [None; HAND_POINTS],
            right_hand: [None; HAND_POINTS],
        }
    }
}

impl Keypoints {
    /// The numbering BODY_25 of the OpenPose program: its files have the middle of the hips as point 8, eyes 15 16,
    /// ears 17 18 and the feet 19-24.
    pub fn body_25(&self) -> [Option<DVec3>; 25] {
        let b = &self.body;
        let middle = b[8].zip(b[11]).map(|(right, left)| (right + left) * 0.5);
        let mut all = [None; 25];
        all[..8].copy_from_slice(&b[..8]);
        all[8] = middle;
        all[9..19].copy_from_slice(&b[8..]);
        all[19..].copy_from_slice(&self.feet);
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn body_25_has_the_hips_middle_and_moves_the_rest_along() {
        let mut points = Keypoints::default();
        for (i, p) in points.body.iter_mut().enumerate() {
            *p = Some(DVec3::X * i as f64);
        }
        for (i, p) in points.feet.iter_mut().enumerate() {
            *p = Some(DVec3::Y * i as f64);
        }
        let all = points.body_25();
        assert_eq!(all[7], Some(DVec3::X * 7.0), "left wrist");
        assert_eq!(all[8], Some(DVec3::X * 9.5), "between hips 8 and 11");
        assert_eq!(all[9], Some(DVec3::X * 8.0), "right hip");
        assert_eq!(all[18], Some(DVec3::X * 17.0), "left ear");
        assert_eq!([all[19], all[24]], [points.feet[0], points.feet[5]]);
        points.body[11] = None;
        assert_eq!(points.body_25()[8], None);
    }
}
