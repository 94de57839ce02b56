//! Which bones move which part of the skin: eased along the bones, told apart by the parts of the field.

use glam::DVec3;
use rig::{Bone, Side, Skeleton};

use super::blend::{ease, mix};
use super::field::{Field, Region};
use super::fit::figure_scale;
use super::hand::{FINGERS, fingertip};
use super::nets::Surface;

/// Shares of all bones; they sum to 1.
pub type Shares = [f64; Bone::COUNT];

/// Knows the joints and tells shares for points of the left half.
pub struct Weigher<'a> {
    skeleton: &'a Skeleton,
    field: &'a Field,
    thumb: usize,
    /// Size of the figure over that of the drawn one.
    scale: f64,
}

impl<'a> Weigher<'a> {
    /// For a body and its skeleton.
    pub fn new(skeleton: &'a Skeleton, field: &'a Field) -> Weigher<'a> {
        let thumb = field.parts().iter().position(|p| p.region == Region::Finger(0)).unwrap_or(0);
        Weigher { skeleton, field, thumb, scale: figure_scale(skeleton) }
    }

    fn at(&self, bone: Bone) -> DVec3 {
        self.skeleton.rest_position(bone)
    }

    /// Drawn metres from a joint.
    fn from(&self, bone: Bone, p: DVec3) -> DVec3 {
        (p - self.at(bone)) / self.scale
    }

    /// Shares at a point of the left half's surface.
    pub fn shares(&self, p: DVec3) -> Shares {
        let mut shares = [0.0; Bone::COUNT];
        let arm = self.arm_share(p);
        let leg = self.leg_share(p);
        self.trunk(p, (1.0 - arm) * (1.0 - leg), &mut shares);
        self.arm(p, arm * (1.0 - leg), &mut shares);
        self.leg(p, leg, &mut shares);
        // A skeleton may lack bones: their carriers stand in.
        for bone in Bone::ALL.into_iter().rev() {
            if self.skeleton.joint(bone).is_none() && bone != Bone::Hips {
                let share = std::mem::take(&mut shares[bone.index()]);
                shares[bone.carrier().index()] += share;
            }
        }
        shares
    }

    /// How much of a point belongs to the arm beyond the shoulder joint.
    fn arm_share(&self, p: DVec3) -> f64 {
        let d = self.from(Bone::LeftUpperArm, p);
        // The skin over the joint turns early, the armpit late; the flank below it not at all.
        let middle = mix(0.010, -0.012, ease(-0.05, 0.05, d.y));
        ease(middle - 0.050, middle + 0.050, d.x) * ease(-0.125, -0.055, d.y + 0.5 * d.x.max(0.0))
    }

    fn arm(&self, p: DVec3, share: f64, shares: &mut Shares) {
        if share <= 0.0 {
            return;
        }
        let fore = ease(-0.042, 0.052, self.from(Bone::LeftLowerArm, p).x);
        let hand = ease(-0.026, 0.016, self.from(Bone::LeftHand, p).x);
        shares[Bone::LeftUpperArm.index()] += share * (1.0 - fore);
        shares[Bone::LeftLowerArm.index()] += share * fore * (1.0 - hand);
        if hand > 0.0 {
            self.hand(p, share * fore * hand, shares);
        }
    }

    fn hand(&self, p: DVec3, share: f64, shares: &mut Shares) {
        let (finger, part) = self.finger_share(p);
        let d = self.field.part_distances(p)[self.thumb] / self.scale;
        let [base, next, _] = FINGERS[0].map(|b| self.at(b));
        let t = (p - base).dot((next - base).normalize_or_zero()) / self.scale;
        let thumb = ease(0.013, 0.0, d) * ease(-0.010, 0.024, t);
        // In the web between thumb and index finger only the stronger one pulls.
        let both = part.min(thumb);
        let (part, thumb) = (part - both, thumb - both);
        self.along_finger(p, finger, share * part, shares);
        self.along_finger(p, 0, share * thumb, shares);
        shares[Bone::LeftHand.index()] += share * (1.0 - part - thumb);
    }

    /// The one long finger that may move a point of the hand, and how much.
    fn finger_share(&self, p: DVec3) -> (usize, f64) {
        let aside = |f: usize| (p.z - self.at(FINGERS[f][0]).z).abs();
        let mut order = [1, 2, 3, 4];
        order.sort_by(|a, b| aside(*a).total_cmp(&aside(*b)));
        let [first, second, ..] = order;
        let to_border = 0.5 * (aside(second) - aside(first)) / self.scale;
        let d = self.from(FINGERS[first][0], p);
        // The web follows half way.
        let beside = 0.45 + 0.55 * ease(0.0, 0.004, to_border);
        let free = ease(0.014, 0.024, d.x);
        // Down the thumb's side nothing follows the index finger.
        let level = ease(-0.026, -0.015, d.y) * ease(0.0155, 0.0095, aside(first) / self.scale);
        (first, ease(-0.011, 0.012, d.x) * mix(beside, 1.0, free) * level)
    }

    fn along_finger(&self, p: DVec3, finger: usize, share: f64, shares: &mut Shares) {
        if share <= 0.0 {
            return;
        }
        let [a, b, c] = FINGERS[finger].map(|bone| self.at(bone));
        let tip = fingertip(self.skeleton, finger);
        let past = |joint: DVec3, before: DVec3, after: DVec3| {
            let along = (after - joint).normalize_or_zero() + (joint - before).normalize_or_zero();
            ease(-0.0065, 0.0065, (p - joint).dot(along.normalize_or_zero()) / self.scale)
        };
        let middle = past(b, a, c);
        let last = past(c, b, tip);
        let bones = FINGERS[finger];
        shares[bones[0].index()] += share * (1.0 - middle);
        shares[bones[1].index()] += share * middle * (1.0 - last);
        shares[bones[2].index()] += share * middle * last;
    }

    /// How much of a point belongs to the leg below the hip joint.
    fn leg_share(&self, p: DVec3) -> f64 {
        let d = self.from(Bone::LeftUpperLeg, p);
        // The border follows the groin: high outside and in front, low between the legs and under the seat.
        let below = -d.y + 0.45 * d.x + 0.22 * d.z;
        let x = p.x / self.scale;
        let crotch = mix(1.0, 0.3 + 0.7 * ease(0.0, 0.036, x), ease(-0.150, -0.108, d.y));
        ease(-0.078, 0.085, below) * crotch
    }

    fn leg(&self, p: DVec3, share: f64, shares: &mut Shares) {
        if share <= 0.0 {
            return;
        }
        let knee = self.from(Bone::LeftLowerLeg, p);
        let shank = ease(0.050, -0.045, knee.y + 0.15 * knee.z);
        let ankle = self.from(Bone::LeftFoot, p);
        let foot = ease(-0.030, 0.022, -ankle.y + 0.45 * ankle.z);
        let toes = ease(-0.014, 0.010, self.from(Bone::LeftToes, p).z) * foot;
        shares[Bone::LeftUpperLeg.index()] += share * (1.0 - shank);
        shares[Bone::LeftLowerLeg.index()] += share * shank * (1.0 - foot);
        shares[Bone::LeftFoot.index()] += share * shank * (foot - toes);
        shares[Bone::LeftToes.index()] += share * shank * toes;
    }

    fn trunk(&self, p: DVec3, share: f64, shares: &mut Shares) {
        if share <= 0.0 {
            return;
        }
        let rise = |bone: Bone, reach: f64| ease(-reach, reach, self.from(bone, p).y);
        let x = p.x / self.scale;
        let skull = self.from(Bone::Head, p);
        let head = ease(-0.034, 0.010, skull.y + 0.010 + 0.70 * skull.z);
        let neck = head.max(rise(Bone::Neck, 0.050) * ease(0.115, 0.060, x));
        let top = rise(Bone::UpperChest, 0.070);
        let chest = rise(Bone::Chest, 0.070);
        let spine = rise(Bone::Spine, 0.060);
        let jaw = self.jaw(p) * head;
        let joint = self.from(Bone::LeftUpperArm, p);
        let collar = ease(0.035, 0.125, x) * ease(-0.110, -0.010, joint.y) * (1.0 - neck);
        let mut put = |bone: Bone, part: f64| shares[bone.index()] += share * part;
        put(Bone::Jaw, jaw);
        put(Bone::Head, head - jaw);
        put(Bone::Neck, neck - head);
        put(Bone::LeftShoulder, collar);
        let rest = 1.0 - neck - collar;
        put(Bone::UpperChest, rest * top);
        put(Bone::Chest, rest * chest * (1.0 - top));
        put(Bone::Spine, rest * spine * (1.0 - chest) * (1.0 - top));
        put(Bone::Hips, rest * (1.0 - spine) * (1.0 - chest) * (1.0 - top));
    }

    /// Lower lip, chin and the jaw line up to its hinge.
    fn jaw(&self, p: DVec3) -> f64 {
        let d = self.from(Bone::Jaw, p);
        let border = -0.0353 + 0.30 * (0.098 - d.z).max(0.0);
        // At the corners of the mouth the lips part less than in the middle.
        let corner = ease(0.009, 0.026, p.x / self.scale);
        let width = mix(0.0018, 0.016, ease(0.092, 0.040, d.z).max(0.8 * corner));
        ease(border + width, border - width, d.y) * ease(-0.005, 0.045, d.z)
    }
}

/// Shares of every vertex of the half mesh, evened out where limbs meet the trunk.
pub fn half_shares(half: &Surface, weigher: &Weigher<'_>) -> Vec<Shares> {
    let mut all: Vec<Shares> = half.points.iter().map(|p| weigher.shares(*p)).collect();
    let mut rings: Vec<Vec<u32>> = vec![Vec::new(); all.len()];
    for [a, b, c] in &half.triangles {
        for (v, w) in [(a, b), (b, c), (c, a), (b, a), (c, b), (a, c)] {
            if !rings[*v as usize].contains(w) {
                rings[*v as usize].push(*w);
            }
        }
    }
    for _ in 0..3 {
        let before = all.clone();
        for (v, ring) in rings.iter().enumerate() {
            if weigher.is_precise(half.points[v]) {
                continue;
            }
            let mut sum = [0.0; Bone::COUNT];
            for w in ring {
                sum.iter_mut().zip(&before[*w as usize]).for_each(|(s, w)| *s += w / ring.len() as f64);
            }
            if half.points[v].x == 0.0 {
                sum = balanced(&sum);
            }
            for (share, mean) in all[v].iter_mut().zip(&sum) {
                *share = mix(*share, *mean, 0.5);
            }
        }
    }
    for (v, shares) in all.iter_mut().enumerate() {
        if half.points[v].x == 0.0 {
            *shares = balanced(shares);
        } else {
            keep_left(shares);
        }
    }
    all
}

impl Weigher<'_> {
    /// Hands, face and feet keep their shares as they are.
    fn is_precise(&self, p: DVec3) -> bool {
        let beyond_wrist = self.from(Bone::LeftHand, p).x > -0.03;
        let head = self.from(Bone::Head, p).y > 0.0
            || self.from(Bone::Neck, p).z > 0.06 && p.y > self.at(Bone::Neck).y;
        beyond_wrist || head || self.from(Bone::LeftFoot, p).y < 0.0
    }
}

/// Takes away what evening out brought over from the other side.
fn keep_left(shares: &mut Shares) {
    for bone in Bone::ALL {
        if bone.side() == Some(Side::Right) {
            shares[bone.index()] = 0.0;
        }
    }
}

/// The mean of shares and their mirror image.
fn balanced(shares: &Shares) -> Shares {
    std::array::from_fn(|i| 0.5 * (shares[i] + shares[Bone::ALL[i].mirrored().index()]))
}

/// The four largest shares as fractions of 65,535 that sum to it exactly.
pub fn rounded(shares: &Shares) -> ([u8; 4], [u16; 4]) {
    let mut order: Vec<usize> = (0..Bone::COUNT).filter(|&i| shares[i] > 0.004).collect();
    order.sort_by(|a, b| shares[*b].total_cmp(&shares[*a]).then(a.cmp(b)));
    order.truncate(4);
    if order.is_empty() {
        order.push(Bone::Hips.index());
    }
    let total: f64 = order.iter().map(|&i| shares[i]).sum();
    let mut weights = [0u16; 4];
    let mut joints = [0u8; 4];
    for (slot, &i) in order.iter().enumerate() {
        joints[slot] = i as u8;
        weights[slot] = if total > 0.0 { (shares[i] / total * 65535.0) as u16 } else { 0 };
    }
    // What rounding left over goes to a bone of the middle if there is one, so that twins stay equal.
    let middle = order.iter().position(|&i| Bone::ALL[i].side().is_none()).unwrap_or(0);
    let sum: u32 = weights.iter().map(|&w| u32::from(w)).sum();
    weights[middle] += (65535 - sum) as u16;
    (joints, weights)
}
