//! Which bones move which part of the skin: eased along the bones, told apart by the parts of the field.

use glam::DVec3;
use rig::{Bone, Skeleton};

use super::bend::{Bend, ramp};
use super::blend::{ease, mix};
use super::field::{Field, Region};
use super::fit::figure_scale;
use super::hand::{FINGERS, fingertip, nail_side};
use super::nets::Surface;
use super::rings::Rings;

/// Shares of all bones; they sum to 1.
pub type Shares = [f64; Bone::COUNT];

/// Knows the joints and tells shares for points of the left half.
pub struct Weigher<'a> {
    skeleton: &'a Skeleton,
    field: &'a Field,
    /// The fingers' places among the field's parts, the thumb's first.
    fingers: [usize; 5],
    /// Size of the figure over that of the drawn one.
    scale: f64,
}

impl<'a> Weigher<'a> {
    /// For a body and its skeleton.
    pub fn new(skeleton: &'a Skeleton, field: &'a Field) -> Weigher<'a> {
        let place = |f| field.parts().iter().position(|p| p.region == Region::Finger(f)).unwrap_or(0);
        let fingers = [0, 1, 2, 3, 4].map(place);
        Weigher { skeleton, field, fingers, scale: figure_scale(skeleton) }
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
        let closes = [(DVec3::NEG_Y, 1.35), (DVec3::Y, 1.5), (DVec3::Z, 2.1), (DVec3::NEG_Z, 1.5)];
        let bend = Bend { closes: &closes, least: 0.040, most: 0.084 };
        // Below, the border lies farther out than on top, so that the pit of a hanging arm lies low and shuts; the flank
        // below it turns not at all.
        let middle = mix(0.0, -0.010, ease(-0.05, 0.05, d.y));
        bend.share(d, d.x - middle) * ease(-0.125, -0.047, d.y + 0.5 * d.x.max(0.0))
    }

    fn arm(&self, p: DVec3, share: f64, shares: &mut Shares) {
        if share <= 0.0 {
            return;
        }
        let elbow = self.from(Bone::LeftLowerArm, p);
        let fore = Bend { closes: &[(DVec3::Z, 2.62)], least: 0.032, most: 0.100 };
        // Inside, the fold lies a little beyond the joint: so it stays shallow.
        let fore = fore.share(elbow, elbow.x - 0.004 * ease(0.0, 0.03, elbow.z));
        let wrist = self.from(Bone::LeftHand, p);
        let closes = [(DVec3::NEG_Y, 1.4), (DVec3::Y, 1.22), (DVec3::Z, 0.35), (DVec3::NEG_Z, 0.52)];
        let hand = Bend { closes: &closes, least: 0.024, most: 0.04 }.share(wrist, wrist.x + 0.003);
        shares[Bone::LeftUpperArm.index()] += share * (1.0 - fore);
        shares[Bone::LeftLowerArm.index()] += share * fore * (1.0 - hand);
        if hand > 0.0 {
            self.hand(p, share * fore * hand, shares);
        }
    }

    fn hand(&self, p: DVec3, share: f64, shares: &mut Shares) {
        let distances = self.field.part_distances(p);
        let distances = self.fingers.map(|part| distances[part] / self.scale);
        let (finger, part) = self.finger_share(p, &distances);
        let d = distances[0];
        let [base, next, _] = FINGERS[0].map(|b| self.at(b));
        let t = (p - base).dot((next - base).normalize_or_zero()) / self.scale;
        let thumb = ramp((0.012 - d) / 0.022) * ease(-0.016, 0.040, t);
        // In the web between thumb and index finger only the stronger one pulls.
        let both = part.min(thumb);
        let (part, thumb) = (part - both, thumb - both);
        self.along_finger(p, finger, share * part, shares);
        self.along_finger(p, 0, share * thumb, shares);
        shares[Bone::LeftHand.index()] += share * (1.0 - part - thumb);
    }

    /// The one long finger that may move a point of the hand, and how much.
    fn finger_share(&self, p: DVec3, distances: &[f64; 5]) -> (usize, f64) {
        let aside = |f: usize| (p.z - self.at(FINGERS[f][0]).z).abs();
        // Fingers lie so near each other that one bulges past the middle between both joints.
        let mut order = [1, 2, 3, 4];
        order.sort_by(|a, b| distances[*a].total_cmp(&distances[*b]));
        let [first, second, ..] = order;
        let to_border = 0.5 * (aside(second) - aside(first)) / self.scale;
        let d = self.from(FINGERS[first][0], p);
        // The web follows half way.
        let beside = 0.62 + 0.38 * ease(0.0, 0.005, to_border);
        let free = ease(0.014, 0.024, d.x);
        // Down the thumb's side nothing follows the index finger.
        let level = ease(-0.028, -0.015, d.y) * ease(0.0165, 0.0095, aside(first) / self.scale);
        let closes = [(DVec3::NEG_Y, 1.57), (DVec3::Y, 0.6)];
        let knuckle = Bend { closes: &closes, least: 0.011, most: 0.024 }.share(d, d.x - 0.001);
        (first, knuckle * mix(beside, 1.0, free) * level)
    }

    fn along_finger(&self, p: DVec3, finger: usize, share: f64, shares: &mut Shares) {
        if share <= 0.0 {
            return;
        }
        let [a, b, c] = FINGERS[finger].map(|bone| self.at(bone));
        let tip = fingertip(self.skeleton, finger);
        let past = |joint: DVec3, before: DVec3, after: DVec3, angle: f64| {
            let along = (after - joint).normalize_or_zero() + (joint - before).normalize_or_zero();
            let along = along.normalize_or_zero();
            let d = (p - joint) / self.scale;
            let closes = [(-nail_side(finger, along), angle)];
            Bend { closes: &closes, least: 0.0055, most: 0.0120 }.share(d, d.dot(along))
        };
        let [middle_angle, last_angle] = if finger == 0 { [1.1, 1.5] } else { [1.92, 1.5] };
        let middle = past(b, a, c, middle_angle);
        let last = past(c, b, tip, last_angle);
        let bones = FINGERS[finger];
        shares[bones[0].index()] += share * (1.0 - middle);
        shares[bones[1].index()] += share * middle * (1.0 - last);
        shares[bones[2].index()] += share * middle * last;
    }

    /// How much of a point belongs to the leg below the hip joint.
    fn leg_share(&self, p: DVec3) -> f64 {
        let d = self.from(Bone::LeftUpperLeg, p);
        let closes = [(DVec3::Z, 1.9), (DVec3::X, 1.5), (DVec3::NEG_X, 1.7), (DVec3::NEG_Z, 0.7)];
        // The border follows the groin: high outside and in front, low under the seat, lowest between the legs.
        let inward = 0.12 * ramp((-d.x - 0.036) / 0.066);
        let bend = Bend { closes: &closes, least: 0.080 + 0.45 * inward, most: 0.130 + 0.25 * inward };
        let lower = inward + 0.25 * (-d.z).max(0.0) - 0.2 * d.x.max(0.0);
        let crotch = mix(1.0, ease(0.004, 0.032, p.x / self.scale), ease(-0.170, -0.100, d.y));
        let border = bend.share(d, -d.y - lower) * crotch;
        let inner = self.inner_thigh(p, d);
        (border.powi(4) + inner.powi(4)).sqrt().sqrt().min(1.0)
    }

    /// How much of the skin between the legs follows its own leg: all of it a little below the crotch. Legs that spread
    /// stretch that skin, only legs that cross squeeze it, so it may change over a short way. Forward it falls off
    /// slowly, as thighs that are raised squeeze it that way.
    fn inner_thigh(&self, p: DVec3, from_hip: DVec3) -> f64 {
        let outward = (p.x / self.scale - 0.004).min(0.03);
        let below = -from_hip.y - 0.098 + outward;
        let forward = from_hip.z / (-from_hip.y).max(0.09);
        ramp(2.0 * below / 0.056 - 1.0) * (1.0 - 0.4 * (forward - 0.35).max(0.0)).max(0.0)
    }

    fn leg(&self, p: DVec3, share: f64, shares: &mut Shares) {
        if share <= 0.0 {
            return;
        }
        let knee = self.from(Bone::LeftLowerLeg, p);
        let bend = Bend { closes: &[(DVec3::NEG_Z, 2.7)], least: 0.050, most: 0.125 };
        let shank = bend.share(knee, -knee.y - 0.008 * ease(0.0, -0.04, knee.z));
        let ankle = self.from(Bone::LeftFoot, p);
        let closes = [(DVec3::NEG_Z, 0.95), (DVec3::Z, 0.5), (DVec3::X, 0.5), (DVec3::NEG_X, 0.5)];
        let bend = Bend { closes: &closes, least: 0.028, most: 0.040 };
        let foot = bend.share(ankle, -ankle.y + 0.45 * ankle.z);
        let ball = self.from(Bone::LeftToes, p);
        let bend = Bend { closes: &[(DVec3::Y, 1.14), (DVec3::NEG_Y, 0.7)], least: 0.012, most: 0.02 };
        let toes = bend.share(ball, ball.z + 0.001) * foot;
        shares[Bone::LeftUpperLeg.index()] += share * (1.0 - shank);
        shares[Bone::LeftLowerLeg.index()] += share * shank * (1.0 - foot);
        shares[Bone::LeftFoot.index()] += share * shank * (foot - toes);
        shares[Bone::LeftToes.index()] += share * shank * toes;
    }

    fn trunk(&self, p: DVec3, share: f64, shares: &mut Shares) {
        if share <= 0.0 {
            return;
        }
        let rise = |bone: Bone, reach: f64| ramp(self.from(bone, p).y / reach);
        let x = p.x / self.scale;
        let skull = self.from(Bone::Head, p);
        // The head's border rises from the throat to the nape and leaves it the chin; under that there is room to fold.
        let chin = 0.45 * (skull.z - 0.030).max(0.0);
        let head =
            ramp((skull.y + 0.020 + 0.55 * skull.z + chin) / (0.034 + 0.25 * skull.z.clamp(0.0, 0.08)));
        let top = rise(Bone::UpperChest, 0.072);
        let chest = rise(Bone::Chest, 0.072);
        let spine = rise(Bone::Spine, 0.065);
        let jaw = self.jaw(p) * head;
        let collar = self.collar(p) * (1.0 - head);
        let neck = head + (1.0 - head - collar) * rise(Bone::Neck, 0.058) * ease(0.150, 0.050, x);
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

    /// Collar bone and shoulder blade: from beside the breast bone outward, down to the blade's tip.
    fn collar(&self, p: DVec3) -> f64 {
        let x = p.x / self.scale;
        let joint = self.from(Bone::LeftUpperArm, p);
        ramp((x - 0.085) / 0.060) * ease(-0.145, 0.0, joint.y) * ease(0.125, 0.060, joint.y)
    }

    /// Lower lip, chin and the jaw line up to its hinge.
    fn jaw(&self, p: DVec3) -> f64 {
        let d = self.from(Bone::Jaw, p);
        let border = -0.0353 + 0.30 * (0.098 - d.z).max(0.0);
        // At the corners of the mouth the lips part less than in the middle.
        let corner = ease(0.009, 0.026, p.x / self.scale);
        let width = mix(0.0018, 0.016, ease(0.092, 0.040, d.z).max(0.8 * corner));
        ease(border + width, border - width, d.y) * ramp((d.z - 0.035) / 0.042)
    }
}

/// Shares of every vertex of the half mesh, evened out where limbs meet the trunk.
pub fn half_shares(half: &Surface, weigher: &Weigher<'_>) -> Vec<Shares> {
    let mut all: Vec<Shares> = half.points.iter().map(|p| weigher.shares(*p)).collect();
    let rings = Rings::new(half);
    for _ in 0..3 {
        rings.even(&mut all, |v| if weigher.is_precise(half.points[v]) { 0.0 } else { 0.5 });
    }
    all.iter_mut().enumerate().for_each(|(v, shares)| rings.tidy(v, shares));
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

/// Where bones need two of a vertex's four places, because their twist is spread along them when the skin is loaded:
/// bone, next bone, and the fractions of the way between which it is.
const TWISTING: [(Bone, Bone, f64, f64); 4] = [
    (Bone::LeftUpperArm, Bone::LeftLowerArm, 0.1, 0.9),
    (Bone::LeftLowerArm, Bone::LeftHand, 0.1, 0.9),
    (Bone::LeftUpperLeg, Bone::LeftLowerLeg, 0.1, 0.9),
    (Bone::LeftLowerLeg, Bone::LeftFoot, 0.3, 0.95),
];

/// Fraction of a segment over which the need comes and goes.
const NEED: f64 = 0.12;

/// Bones that need two places at a point of the left half, and how urgently: 0 to 1.
fn twisting(skeleton: &Skeleton, p: DVec3) -> Vec<(Bone, f64)> {
    let need = |&(bone, next, low, high): &(Bone, Bone, f64, f64)| {
        let [from, to] = [bone, next].map(|b| skeleton.rest_position(b));
        let along = (p - from).dot(to - from) / (to - from).length_squared();
        let outside = (low - along).max(along - high).max(0.0);
        (bone, (1.0 - outside / NEED).max(0.0))
    };
    TWISTING.iter().map(need).filter(|need| need.1 > 0.0).collect()
}

/// Draws the trunk's shares together where a limb needs the room, to the bone that the limb hangs on.
fn gathered(shares: &Shares, needs: &[(Bone, f64)]) -> Shares {
    let mut gathered = *shares;
    for (limb, base) in [(Bone::LeftUpperArm, Bone::UpperChest), (Bone::LeftUpperLeg, Bone::Hips)] {
        let need = needs.iter().find(|need| need.0 == limb).map_or(0.0, |need| need.1);
        for bone in [Bone::Hips, Bone::Spine, Bone::Chest, Bone::UpperChest, Bone::Neck, Bone::Head] {
            if bone != base && need > 0.0 {
                let part = gathered[bone.index()] * need;
                gathered[bone.index()] -= part;
                gathered[base.index()] += part;
            }
        }
    }
    gathered
}

/// How many of the first bones have room in four places.
fn room(order: &[usize], needs_two: impl Fn(Bone) -> bool) -> usize {
    let mut taken = 0;
    let fits = |i: &&usize| {
        taken += if needs_two(Bone::ALL[**i]) { 2 } else { 1 };
        taken <= 4
    };
    order.iter().take_while(fits).count()
}

/// The largest shares, as many as have room in four places, as fractions of 65,535 that sum to it exactly.
///
/// The largest share that finds no room is taken off those that do: so nothing jumps between a vertex and its neighbour
/// where two shares change their order.
pub fn rounded(shares: &Shares, skeleton: &Skeleton, p: DVec3) -> ([u8; 4], [u16; 4]) {
    let needs = twisting(skeleton, p);
    let shares = gathered(shares, &needs);
    let mut order: Vec<usize> = (0..Bone::COUNT).filter(|&i| shares[i] > 0.002).collect();
    order.sort_by(|a, b| shares[*b].total_cmp(&shares[*a]).then(a.cmp(b)));
    let left_out = |room: usize| order.get(room).map_or(0.0, |&i| shares[i]);
    let single = room(&order, |_| false);
    let double = room(&order, |bone| needs.iter().any(|need| need.0 == bone));
    let urgent = needs.iter().map(|need| need.1).fold(0.0, f64::max);
    let left_out = mix(left_out(single), left_out(double), urgent);
    order.truncate(single);
    order.retain(|&i| shares[i] > left_out);
    if order.is_empty() {
        order.push(Bone::Hips.index());
    }
    let total: f64 = order.iter().map(|&i| shares[i] - left_out).sum();
    let mut weights = [0u16; 4];
    let mut joints = [0u8; 4];
    for (slot, &i) in order.iter().enumerate() {
        joints[slot] = i as u8;
        weights[slot] = if total > 1e-9 { ((shares[i] - left_out) / total * 65535.0) as u16 } else { 0 };
    }
    // What rounding left over goes to a bone of the middle if there is one, so that twins stay equal.
    let middle = order.iter().position(|&i| Bone::ALL[i].side().is_none()).unwrap_or(0);
    let sum: u32 = weights.iter().map(|&w| u32::from(w)).sum();
    weights[middle] += (65535 - sum) as u16;
    (joints, weights)
}
