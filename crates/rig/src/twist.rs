//! Twist along limb segments: the places that it adds to the palette, and how a skin's weights are spread over them.
//!
//! A forearm turns by 160° between elbow and wrist, and its skin follows a little at a time. So each such segment
//! has two places: its bone, and a twist place that differs by a turn about the segment alone. The skin between is
//! shared by the two.

use glam::DVec3;

use crate::{Bone, Mesh, Skeleton};

/// A segment with a twist place.
#[derive(Debug)]
pub struct TwistPlace {
    /// The segment's bone.
    pub bone: Bone,
    /// The bone at its far end.
    pub next: Bone,
    /// Its twist place in the palette.
    pub place: usize,
    /// If so, the bone's own turn holds at the near end, and the twist place, which holds at the far end, adds the next
    /// bone's turn about the segment. Else the twist place holds at the near end and leaves out the bone's own twist.
    pub twists_with_next: bool,
}

const fn segment(number: usize, bone: Bone, next: Bone) -> TwistPlace {
    let twists_with_next = matches!(bone, Bone::LeftLowerLeg | Bone::RightLowerLeg);
    TwistPlace { bone, next, place: Bone::COUNT + number, twists_with_next }
}

/// The segments, in the order of their twist places, which follow the bones.
pub(crate) static SEGMENTS: [TwistPlace; 8] = [
    segment(0, Bone::LeftUpperArm, Bone::LeftLowerArm),
    segment(1, Bone::LeftLowerArm, Bone::LeftHand),
    segment(2, Bone::LeftUpperLeg, Bone::LeftLowerLeg),
    segment(3, Bone::LeftLowerLeg, Bone::LeftFoot),
    segment(4, Bone::RightUpperArm, Bone::RightLowerArm),
    segment(5, Bone::RightLowerArm, Bone::RightHand),
    segment(6, Bone::RightUpperLeg, Bone::RightLowerLeg),
    segment(7, Bone::RightLowerLeg, Bone::RightFoot),
];

/// The segments with a twist place, in the order of those places in the palette, which follow the bones.
pub fn twist_places() -> &'static [TwistPlace] {
    &SEGMENTS
}

/// The number of places that skin can belong to: the bones, by [`Bone::index`], then the twist places.
pub const PLACES: usize = Bone::COUNT + SEGMENTS.len();

/// The bone that a place of the palette belongs to: a twist place to the bone of its segment, one beyond the last to
/// the hips.
pub fn bone_of_place(place: usize) -> Bone {
    let twist = || SEGMENTS.iter().find(|segment| segment.place == place).map(|segment| segment.bone);
    Bone::ALL.get(place).copied().or_else(twist).unwrap_or(Bone::Hips)
}

/// Spreads the twist of upper arms, forearms, thighs and shins along them: shares what a vertex's weights give to such a
/// bone between the bone and its twist place, by how far along the segment the vertex lies.
///
/// For any figure, once, when its skin comes from a file; the mesh and the skeleton are at rest and of the same
/// proportions. A segment whose ends the skeleton lacks, or that has no length, stays as it is, as does a twist place
/// that is already there. Each bone keeps its weight, to its last bit; where it takes more than four places, the weights
/// of which the least would be moved stay together. What is mirrored in x stays so.
pub fn spread_twist(mesh: &mut Mesh, skeleton: &Skeleton) {
    let spans: Vec<Span> = SEGMENTS.iter().filter_map(|segment| Span::of(segment, skeleton)).collect();
    let rows = mesh.positions.iter().zip(&mut mesh.joints).zip(&mut mesh.weights);
    for ((position, joints), weights) in rows {
        let twists = |place: &u8| spans.iter().any(|span| span.segment.bone.index() == usize::from(*place));
        if joints.iter().any(twists) {
            let at = DVec3::from(position.map(f64::from));
            (*joints, *weights) = shared(&spans, at, *joints, *weights);
        }
    }
}

/// A segment at rest.
struct Span {
    segment: &'static TwistPlace,
    from: DVec3,
    /// Gradient of the fraction along the segment, 1/m.
    gradient: DVec3,
}

impl Span {
    fn of(segment: &'static TwistPlace, skeleton: &Skeleton) -> Option<Span> {
        let ends = [segment.bone, segment.next];
        if ends.iter().any(|bone| skeleton.joint(*bone).is_none()) {
            return None;
        }
        let [from, to] = ends.map(|bone| skeleton.rest_position(bone));
        let gradient = (to - from) / (to - from).length_squared();
        gradient.is_finite().then_some(Span { segment, from, gradient })
    }

    /// The near and the far end's place, and the far one's share at a point. The share grows evenly, so that the skin
    /// is nowhere sheared more than it must be; both ends keep a stretch of their own, where the joints bend.
    fn share(&self, at: DVec3) -> (usize, usize, f64) {
        let along = (at - self.from).dot(self.gradient);
        let (bone, twist) = (self.segment.bone.index(), self.segment.place);
        let ramp = |start: f64, end: f64| ((along - start) / (end - start)).clamp(0.0, 1.0);
        if self.segment.twists_with_next {
            (bone, twist, ramp(0.3, 0.95))
        } else {
            (twist, bone, ramp(0.1, 0.9))
        }
    }
}

/// The near and the far part of each of a vertex's weights: place and weight. What doesn't twist is all near.
type Parts = [[(usize, u16); 2]; 4];

/// The weights of a vertex with twist shared out, over at most four places.
fn shared(spans: &[Span], at: DVec3, joints: [u8; 4], weights: [u16; 4]) -> ([u8; 4], [u16; 4]) {
    let mut parts: Parts = std::array::from_fn(|i| {
        let (bone, weight) = (usize::from(joints[i]), weights[i]);
        let span = spans.iter().find(|span| span.segment.bone.index() == bone);
        let (near, far, share) = span.map_or((bone, bone, 0.0), |span| span.share(at));
        let beyond = (f64::from(weight) * share).round() as u16;
        [(near, weight - beyond), (far, beyond)]
    });
    let count = |parts: &Parts| parts.iter().flatten().filter(|part| part.1 > 0).count();
    while count(&parts) > 4 {
        join_least(&mut parts);
    }
    let (mut joints, mut weights) = ([0; 4], [0; 4]);
    for (i, (place, weight)) in parts.into_iter().flatten().filter(|part| part.1 > 0).enumerate() {
        (joints[i], weights[i]) = (place as u8, weight);
    }
    (joints, weights)
}

/// Puts the weights together again of which the least would be moved: the whole to the larger part. Of several equal
/// ones all, so that a vertex in the middle of the body favours no side.
fn join_least(parts: &mut Parts) {
    let lesser = |[near, far]: &[(usize, u16); 2]| near.1.min(far.1);
    let least = parts.iter().map(lesser).filter(|weight| *weight > 0).min().unwrap_or(0);
    for pair in parts.iter_mut().filter(|pair| lesser(pair) == least) {
        let [near, far] = pair;
        if near.1 < far.1 {
            (near.1, far.1) = (0, near.1 + far.1);
        } else {
            (near.1, far.1) = (near.1 + far.1, 0);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Articulation, Joint};

    /// Hips, thighs, shins and feet of a figure without arms.
    fn legs() -> Skeleton {
        let joint = |bone: Bone, carrier: Option<Bone>, offset: [f64; 3]| Joint {
            bone,
            carrier,
            offset: DVec3::from(offset),
            articulation: Articulation::Hinges(Vec::new()),
            mass: 1.0,
            center_of_mass: DVec3::ZERO,
        };
        let mut joints = vec![joint(Bone::Hips, None, [0.0, 1.0, 0.0])];
        for (x, [thigh, shin, foot]) in [
            (0.1, [Bone::LeftUpperLeg, Bone::LeftLowerLeg, Bone::LeftFoot]),
            (-0.1, [Bone::RightUpperLeg, Bone::RightLowerLeg, Bone::RightFoot]),
        ] {
            joints.push(joint(thigh, Some(Bone::Hips), [x, 0.0, 0.0]));
            joints.push(joint(shin, Some(thigh), [0.0, -0.45, 0.0]));
            joints.push(joint(foot, Some(shin), [0.0, -0.45, 0.0]));
        }
        Skeleton::new(joints).unwrap()
    }

    fn mesh(rows: &[([f32; 3], [u8; 4], [u16; 4])]) -> Mesh {
        Mesh {
            positions: rows.iter().map(|row| row.0).collect(),
            normals: vec![[0.0, 1.0, 0.0]; rows.len()],
            colors: vec![[0.5; 3]; rows.len()],
            joints: rows.iter().map(|row| row.1).collect(),
            weights: rows.iter().map(|row| row.2).collect(),
            indices: Vec::new(),
        }
    }

    fn spread(row: ([f32; 3], [u8; 4], [u16; 4])) -> Vec<(usize, u16)> {
        let mut mesh = mesh(&[row]);
        spread_twist(&mut mesh, &legs());
        assert_eq!(mesh.fault(), None);
        let parts = mesh.joints[0].into_iter().zip(mesh.weights[0]);
        parts.filter(|part| part.1 > 0).map(|(place, weight)| (usize::from(place), weight)).collect()
    }

    const THIGH: u8 = Bone::LeftUpperLeg as u8;
    const SHIN: u8 = Bone::LeftLowerLeg as u8;

    #[test]
    fn places_are_numbered_in_order_and_each_has_its_bone() {
        for (i, segment) in SEGMENTS.iter().enumerate() {
            assert_eq!(segment.place, Bone::COUNT + i);
            assert_eq!(bone_of_place(segment.place), segment.bone);
            assert_eq!(segment.next.carrier(), segment.bone);
        }
        assert!(Bone::ALL.into_iter().all(|bone| bone_of_place(bone.index()) == bone));
        assert_eq!(bone_of_place(PLACES), Bone::Hips);
        const { assert!(PLACES < crate::PALETTE_LEN) };
    }

    #[test]
    fn a_thigh_is_the_twist_place_s_above_and_the_bone_s_below() {
        let place = SEGMENTS[2].place;
        let at = |y: f32| spread(([0.12, y, 0.0], [THIGH, 0, 0, 0], [65535, 0, 0, 0]));
        assert_eq!(at(0.97), [(place, 65535)]);
        assert_eq!(at(0.57), [(usize::from(THIGH), 65535)]);
        let half = at(0.775);
        assert_eq!(half.len(), 2);
        assert!(half.iter().all(|part| part.1.abs_diff(32768) < 3), "{half:?}");
    }

    #[test]
    fn a_shin_is_the_bone_s_above_and_the_twist_place_s_below() {
        let at = |y: f32| spread(([0.12, y, 0.0], [0, SHIN, 0, 0], [0, 65535, 0, 0]));
        assert_eq!(at(0.5), [(usize::from(SHIN), 65535)]);
        assert_eq!(at(0.1), [(SEGMENTS[3].place, 65535)]);
    }

    #[test]
    fn bones_keep_their_weights_and_what_matters_least_stays_together() {
        let joints = [THIGH, 0, SHIN, Bone::Spine as u8];
        let parts = spread(([0.12, 0.7, 0.0], joints, [40000, 20000, 5000, 535]));
        assert_eq!(parts.iter().map(|part| part.1).collect::<Vec<_>>(), [40000, 20000, 5000, 535]);
        let two = [THIGH, SHIN, 0, Bone::Spine as u8];
        let parts = spread(([0.12, 0.45, 0.0], two, [30000, 30000, 5535, 0]));
        assert_eq!(parts, [(usize::from(THIGH), 30000), (usize::from(SHIN), 30000), (0, 5535)]);
        let parts = spread(([0.12, 0.9, 0.0], [THIGH, SHIN, 0, 0], [60000, 5000, 535, 0]));
        assert_eq!(parts.len(), 4);
        assert_eq!(parts[0].1 + parts[1].1, 60000);
    }

    #[test]
    fn a_vertex_in_the_middle_favours_no_side() {
        let other = Bone::RightUpperLeg as u8;
        let parts = spread(([0.0, 0.8, 0.0], [0, THIGH, other, 0], [25535, 20000, 20000, 0]));
        assert_eq!(parts, [(0, 25535), (SEGMENTS[2].place, 20000), (SEGMENTS[6].place, 20000)]);
    }

    #[test]
    fn both_sides_are_spread_alike_and_the_same_twice() {
        let twin = |joints: [u8; 4]| joints.map(|b| Bone::ALL[usize::from(b)].mirrored() as u8);
        let rows: Vec<_> = (0..200_u16)
            .map(|i| {
                let (a, b) = (327 * i, (65535 - 327 * i) / 3);
                let height = 1.0 - f32::from(i) * 0.0047;
                ([0.03 * f32::from(i % 7), height, 0.01], [THIGH, SHIN, 0, 3], [a, b, b, 65535 - a - 2 * b])
            })
            .collect();
        let flipped: Vec<_> = rows.iter().map(|(p, j, w)| ([-p[0], p[1], p[2]], twin(*j), *w)).collect();
        let (mut left, mut right, mut again) = (mesh(&rows), mesh(&flipped), mesh(&rows));
        for mesh in [&mut left, &mut right, &mut again] {
            spread_twist(mesh, &legs());
        }
        assert_eq!(left, again);
        assert_eq!(left.weights, right.weights);
        for (l, r) in left.joints.iter().flatten().zip(right.joints.iter().flatten()) {
            assert_eq!(bone_of_place(usize::from(*l)).mirrored(), bone_of_place(usize::from(*r)));
        }
    }

    #[test]
    fn segments_that_a_figure_lacks_stay_as_they_are() {
        let arm = ([0.3, 1.4, 0.0], [Bone::LeftUpperArm as u8, 0, 0, 0], [65535, 0, 0, 0]);
        assert_eq!(spread(arm), [(Bone::LeftUpperArm.index(), 65535)]);
    }
}
