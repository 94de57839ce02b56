//! The keypoints of a posed figure as OpenPose numbers them: joints, fingertips, and what the skin tells of nose, ears,
//! eyes and toes.

use glam::DVec3;
use render::Keypoints;
use rig::{Bone, Evaluation, Figure, Limb, Mesh, Side};

/// A point that goes with a bone: metres in the bone's joint frame, whose axes are the world's at rest.
type Spot = (Bone, DVec3);

/// How far an eye's middle is from the head's in a figure that has no eyes, metres.
const EYE: DVec3 = DVec3::new(0.031, 0.05, 0.08);
/// A fingertip is so far beyond its last joint as this share of the segment before, where the figure names none.
const TIP_SHARE: f64 = 0.8;

/// Where a figure's keypoints are that no joint is.
#[derive(Clone, PartialEq, Debug)]
pub struct Landmarks {
    nose: Option<Spot>,
    /// Right and left, as in the numbering.
    eyes: [Option<Spot>; 2],
    ears: [Option<Spot>; 2],
    /// Big toe, little toe and heel, left then right.
    feet: [[Option<Spot>; 3]; 2],
    /// Thumb to little finger, left then right.
    fingertips: [[Option<Spot>; 5]; 2],
    has: [bool; Bone::COUNT],
}

const HANDS: [[[Bone; 3]; 5]; 2] = {
    use Bone::*;
    [
        [
            [LeftThumbMetacarpal, LeftThumbProximal, LeftThumbDistal],
            [LeftIndexProximal, LeftIndexIntermediate, LeftIndexDistal],
            [LeftMiddleProximal, LeftMiddleIntermediate, LeftMiddleDistal],
            [LeftRingProximal, LeftRingIntermediate, LeftRingDistal],
            [LeftLittleProximal, LeftLittleIntermediate, LeftLittleDistal],
        ],
        [
            [RightThumbMetacarpal, RightThumbProximal, RightThumbDistal],
            [RightIndexProximal, RightIndexIntermediate, RightIndexDistal],
            [RightMiddleProximal, RightMiddleIntermediate, RightMiddleDistal],
            [RightRingProximal, RightRingIntermediate, RightRingDistal],
            [RightLittleProximal, RightLittleIntermediate, RightLittleDistal],
        ],
    ]
};
const TIPS: [&str; 5] = ["thumbTip", "indexTip", "middleTip", "ringTip", "littleTip"];
const ARMS: [Limb; 2] = [Limb::LeftArm, Limb::RightArm];
const LEGS: [Limb; 2] = [Limb::LeftLeg, Limb::RightLeg];
/// From the right shoulder to the left ankle, in the numbering's order.
const JOINTS: [Bone; 12] = [
    Bone::RightUpperArm,
    Bone::RightLowerArm,
    Bone::RightHand,
    Bone::LeftUpperArm,
    Bone::LeftLowerArm,
    Bone::LeftHand,
    Bone::RightUpperLeg,
    Bone::RightLowerLeg,
    Bone::RightFoot,
    Bone::LeftUpperLeg,
    Bone::LeftLowerLeg,
    Bone::LeftFoot,
];

impl Landmarks {
    /// Looks a figure over: its articulators, its skeleton, its skin. What it lacks is no keypoint.
    pub fn of(figure: &Figure) -> Landmarks {
        let has = Bone::ALL.map(|bone| bone == Bone::Hips || figure.skeleton.joint(bone).is_some());
        let skin = figure.skin.as_ref().map(|mesh| Skin { mesh, figure });
        let eye = figure.skeleton.joint(Bone::LeftEye).map_or(EYE, |joint| joint.offset);
        let head = has[Bone::Head as usize].then_some(Bone::Head);
        let nose =
            head.map(|head| (head, skin.as_ref().and_then(|s| s.nose(eye)).unwrap_or(nose_beside(eye))));
        let both = |spot: &dyn Fn(f64) -> Option<Spot>| [spot(-1.0), spot(1.0)];
        let ear = |x: f64| {
            let found =
                skin.as_ref().and_then(|s| s.ear(eye, x)).unwrap_or(DVec3::new(2.4 * eye.x * x, eye.y, 0.0));
            head.map(|head| (head, found))
        };
        let eyes = both(&|x| match if x < 0.0 { Bone::RightEye } else { Bone::LeftEye } {
            bone if has[bone as usize] => {
                let front = skin.as_ref().and_then(|s| s.most(bone, |_| true, |p| p.z)).map_or(0.0, |p| p.z);
                Some((bone, DVec3::Z * front))
            }
            _ => head.map(|head| (head, eye * DVec3::new(x, 1.0, 1.0))),
        });
        Landmarks {
            nose,
            eyes,
            ears: both(&ear),
            feet: [0, 1].map(|side| feet(figure, skin.as_ref(), side)),
            fingertips: [0, 1]
                .map(|side| [0, 1, 2, 3, 4].map(|finger| fingertip(figure, side, finger, &has))),
            has,
        }
    }

    /// Where they are in a pose, world space, metres.
    pub fn keypoints(&self, evaluation: &Evaluation) -> Keypoints {
        let frames = &evaluation.frames;
        let joint = |bone: Bone| self.has[bone as usize].then(|| frames[bone].position);
        let place = |spot: Option<Spot>| spot.map(|(bone, at)| frames[bone].point(at));
        let shoulders = joint(Bone::RightUpperArm).zip(joint(Bone::LeftUpperArm));
        let mut points = Keypoints::default();
        points.body[0] = place(self.nose);
        points.body[1] = shoulders.map(|(right, left)| (right + left) * 0.5);
        for (point, bone) in points.body[2..14].iter_mut().zip(JOINTS) {
            *point = joint(bone);
        }
        let sides = [self.eyes[0], self.eyes[1], self.ears[0], self.ears[1]];
        for (point, spot) in points.body[14..].iter_mut().zip(sides) {
            *point = place(spot);
        }
        for (point, spot) in points.feet.iter_mut().zip(self.feet.concat()) {
            *point = place(spot);
        }
        for (side, hand) in [&mut points.left_hand, &mut points.right_hand].into_iter().enumerate() {
            hand[0] = joint(ARMS[side].parts().end);
            for (finger, bones) in HANDS[side].iter().enumerate() {
                for (i, bone) in bones.iter().enumerate() {
                    hand[1 + 4 * finger + i] = joint(*bone);
                }
                hand[4 + 4 * finger] = place(self.fingertips[side][finger]);
            }
        }
        points
    }
}

/// Where a nose is that no skin shows: below and before the eyes.
fn nose_beside(eye: DVec3) -> DVec3 {
    DVec3::new(0.0, eye.y - 1.2 * eye.x, eye.z + 1.2 * eye.x)
}

fn named(figure: &Figure, limb: Limb, name: &str) -> Option<Spot> {
    figure.articulators[limb.index()].get(name).map(|point| (point.bone, point.at))
}

fn fingertip(figure: &Figure, side: usize, finger: usize, has: &[bool; Bone::COUNT]) -> Option<Spot> {
    let last = HANDS[side][finger][2];
    let beyond = || {
        let offset = figure.skeleton.joint(last)?.offset;
        Some((last, offset * TIP_SHARE))
    };
    named(figure, ARMS[side], TIPS[finger]).filter(|(bone, _)| has[*bone as usize]).or_else(beyond)
}

/// Big toe, little toe, heel.
fn feet(figure: &Figure, skin: Option<&Skin<'_>>, side: usize) -> [Option<Spot>; 3] {
    let leg = LEGS[side];
    let foot = leg.parts().end;
    let toes = if foot.side() == Some(Side::Left) { Bone::LeftToes } else { Bone::RightToes };
    let tip = named(figure, leg, "toeTip");
    let outward = if side == 0 { 1.0 } else { -1.0 };
    let toe = |medial: bool| {
        let skin = skin?;
        let inner = skin.most(toes, |_| true, |p| -p.x * outward)?.x * outward;
        let outer = skin.most(toes, |_| true, |p| p.x * outward)?.x * outward;
        let share = |p: DVec3| (p.x * outward - inner) / (outer - inner).max(1e-6);
        let inside = |p: DVec3| if medial { share(p) < 0.4 } else { share(p) > 0.75 };
        Some((toes, skin.most(toes, inside, |p| p.z)?))
    };
    let back = || {
        let skin = skin?;
        let low = skin.most(foot, |_| true, |p| -p.y)?.y * 0.5;
        Some((foot, skin.most(foot, |p| p.y < low, |p| -p.z)?))
    };
    [toe(true).or(tip), toe(false).or(tip), named(figure, leg, "heel").or_else(back)]
}

/// The skin at rest.
struct Skin<'a> {
    mesh: &'a Mesh,
    figure: &'a Figure,
}

impl Skin<'_> {
    /// Of the vertices that a bone moves most, those inside: the one with the greatest score, in the bone's frame.
    fn most(
        &self,
        bone: Bone,
        inside: impl Fn(DVec3) -> bool,
        score: impl Fn(DVec3) -> f64,
    ) -> Option<DVec3> {
        let origin = self.figure.skeleton.rest_position(bone);
        let place = |p: &[f32; 3]| DVec3::from(p.map(f64::from)) - origin;
        let strongest = |(joints, weights): (&[u8; 4], &[u16; 4])| {
            let most = (0..4).max_by_key(|i| weights[*i]).unwrap_or(0);
            usize::from(joints[most]) == bone as usize
        };
        let weights = self.mesh.joints.iter().zip(&self.mesh.weights);
        let own = self.mesh.positions.iter().zip(weights).filter(|(_, weights)| strongest(*weights));
        let places = own.map(|(p, _)| place(p)).filter(|p| inside(*p));
        // The first of equals, so that it is the same one each time.
        places.fold(None, |best: Option<DVec3>, p| match best {
            Some(best) if score(best) >= score(p) => Some(best),
            _ => Some(p),
        })
    }

    /// The foremost point between the eyes and somewhat below them.
    fn nose(&self, eye: DVec3) -> Option<DVec3> {
        let inside = |p: DVec3| p.x.abs() < 0.35 * eye.x && (eye.y - 2.0 * eye.x..eye.y).contains(&p.y);
        self.most(Bone::Head, inside, |p| p.z).map(|p| DVec3::new(0.0, p.y, p.z))
    }

    /// The outermost point beside the eyes, behind them.
    fn ear(&self, eye: DVec3, outward: f64) -> Option<DVec3> {
        let inside = |p: DVec3| (p.y - eye.y).abs() < 1.2 * eye.x && p.z < 0.6 * eye.z;
        self.most(Bone::Head, inside, |p| p.x * outward)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load;

    fn at_rest(figure: &Figure) -> Keypoints {
        Landmarks::of(figure).keypoints(&rig::evaluate(figure, &figure.rest_pose(), true))
    }

    #[test]
    fn a_mannequin_has_every_point_where_a_body_has_it() {
        let figure = load::figure(None).unwrap();
        let points = at_rest(&figure);
        let body = points.body.map(Option::unwrap);
        let [nose, neck, eye, ear] = [body[0], body[1], body[15], body[17]];
        assert!(nose.z > eye.z && nose.y < eye.y && nose.x.abs() < 1e-9, "{nose} {eye}");
        assert!(ear.x > eye.x + 0.02 && ear.z < eye.z, "{ear} {eye}");
        assert!(neck.x.abs() < 1e-9 && neck.y < nose.y);
        for (right, left) in [(2, 5), (3, 6), (4, 7), (8, 11), (9, 12), (10, 13), (14, 15), (16, 17)] {
            let mirrored = body[right] * DVec3::new(-1.0, 1.0, 1.0);
            assert!(body[left].x > 0.0 && (mirrored - body[left]).length() < 0.005, "{right} {left}");
        }
        let feet = points.feet.map(Option::unwrap);
        let [big, little, heel] = [feet[0], feet[1], feet[2]];
        assert!(0.0 < big.x && big.x < little.x && big.z > little.z && heel.z < little.z, "{feet:?}");
        assert!((feet[3].x + big.x).abs() < 0.005 && feet.iter().all(|p| p.y < 0.08));
        for hand in [points.left_hand, points.right_hand] {
            let hand = hand.map(Option::unwrap);
            for finger in 0..5 {
                let chain = [hand[0], hand[1 + 4 * finger], hand[2 + 4 * finger], hand[4 + 4 * finger]];
                assert!(
                    chain.windows(2).all(|pair| pair[1].x.abs() > pair[0].x.abs()),
                    "{finger}: {chain:?}"
                );
            }
        }
    }

    #[test]
    fn a_figure_without_skin_and_names_still_has_a_face_and_fingertips() {
        let mut figure = (*load::figure(None).unwrap()).clone();
        let whole = at_rest(&figure);
        figure.skin = None;
        figure.articulators.iter_mut().for_each(std::collections::BTreeMap::clear);
        let points = at_rest(&figure);
        let near = |a: Option<DVec3>, b: Option<DVec3>| (a.unwrap() - b.unwrap()).length();
        for i in 0..18 {
            assert!(near(points.body[i], whole.body[i]) < 0.04, "{i}");
        }
        for i in 0..21 {
            assert!(near(points.left_hand[i], whole.left_hand[i]) < 0.012, "{i}");
        }
        assert_eq!(points.feet, [None; 6], "nothing tells where they are");
    }
}
