//! Weights evened out over the neighbours of each vertex of the half mesh.

use rig::{Bone, Side};

use super::blend::mix;
use super::hand::FINGERS;
use super::nets::Surface;
use super::weights::Shares;

/// Half the width of the strip that follows no side, metres.
const MIDDLE_M: f64 = 0.003;

/// The neighbours of every vertex, and what evening out must keep: sides, the middle plane, one finger a vertex.
pub struct Rings {
    neighbours: Vec<Vec<u32>>,
    middle: Vec<bool>,
    /// Which finger each may follow; nothing before that is settled.
    fingers: Vec<Option<usize>>,
}

impl Rings {
    /// Of a half mesh, whose rim lies on the middle plane.
    pub fn new(half: &Surface) -> Rings {
        let mut neighbours: Vec<Vec<u32>> = vec![Vec::new(); half.points.len()];
        for [a, b, c] in &half.triangles {
            for (v, w) in [(a, b), (b, c), (c, a), (b, a), (c, b), (a, c)] {
                if !neighbours[*v as usize].contains(w) {
                    neighbours[*v as usize].push(*w);
                }
            }
        }
        let middle = half.points.iter().map(|p| p.x < MIDDLE_M).collect();
        Rings { neighbours, middle, fingers: Vec::new() }
    }

    /// A vertex's neighbours.
    pub fn around(&self, v: usize) -> &[u32] {
        &self.neighbours[v]
    }

    /// Settles for good which finger each vertex may follow: the one that it follows, else that of the nearest that does.
    pub fn settle_fingers(&mut self, all: &[Shares]) {
        let own = |shares: &Shares| {
            let finger = strongest_finger(shares);
            (finger_shares(shares)[finger] > 0.0).then_some(finger)
        };
        let mut fingers: Vec<Option<usize>> = all.iter().map(own).collect();
        let mut front: Vec<usize> = (0..all.len()).filter(|&v| fingers[v].is_some()).collect();
        while !front.is_empty() {
            let mut next = Vec::new();
            for v in front {
                for &w in &self.neighbours[v] {
                    let w = w as usize;
                    if fingers[w].is_none() {
                        fingers[w] = fingers[v];
                        next.push(w);
                    }
                }
            }
            front = next;
        }
        self.fingers = fingers;
    }

    /// Whether a vertex that follows a finger has a neighbour that may follow none but another one.
    pub fn is_between_fingers(&self, v: usize, shares: &Shares) -> bool {
        let other = |w: &u32| self.fingers[*w as usize] != self.fingers[v];
        finger_shares(shares).iter().any(|share| *share > 0.0) && self.neighbours[v].iter().any(other)
    }

    /// Whether a vertex may follow a bone: in the middle none of a side, of fingers but the settled one.
    pub fn may_follow(&self, v: usize, bone: Bone) -> bool {
        let finger = FINGERS.iter().position(|finger| finger.contains(&bone));
        let settled = self.fingers.get(v).copied().flatten();
        !(self.middle[v] && bone.side().is_some())
            && (finger.is_none() || settled.is_none() || finger == settled)
    }

    /// The bones that a vertex may follow of which it and its neighbours have more than a mean share.
    pub fn bones_near(&self, v: usize, all: &[Shares], share: f64) -> Vec<Bone> {
        let ring = self.around(v);
        let near = |bone: &Bone| {
            let i = bone.index();
            let sum = all[v][i] + ring.iter().map(|w| all[*w as usize][i]).sum::<f64>();
            sum > share * (ring.len() + 1) as f64 && self.may_follow(v, *bone)
        };
        Bone::ALL.into_iter().filter(near).collect()
    }

    /// Draws each vertex's shares toward the mean of its neighbours', by a fraction for each vertex.
    pub fn even(&self, all: &mut [Shares], by: impl Fn(usize) -> f64) {
        let before = all.to_vec();
        for (v, ring) in self.neighbours.iter().enumerate() {
            let part = by(v);
            if part <= 0.0 || ring.is_empty() {
                continue;
            }
            let mut sum = [0.0; Bone::COUNT];
            for w in ring {
                sum.iter_mut().zip(&before[*w as usize]).for_each(|(s, w)| *s += w / ring.len() as f64);
            }
            all[v].iter_mut().zip(&sum).for_each(|(share, mean)| *share = mix(*share, *mean, part));
            self.tidy(v, &mut all[v]);
        }
    }

    /// Brings shares back to what a vertex may have.
    pub fn tidy(&self, v: usize, shares: &mut Shares) {
        give_back(shares, |side| self.middle[v] || side == Side::Right);
        one_finger(shares);
    }
}

/// Gives the shares of those sides to what carries them in the middle: nothing follows the other side, and the middle
/// plane neither, so that what is between two limbs stays where it is.
fn give_back(shares: &mut Shares, sides: impl Fn(Side) -> bool) {
    for bone in Bone::ALL.into_iter().rev().filter(|b| b.side().is_some_and(&sides)) {
        let share = std::mem::take(&mut shares[bone.index()]);
        shares[bone.carrier().index()] += share;
    }
}

fn finger_shares(shares: &Shares) -> [f64; FINGERS.len()] {
    FINGERS.each_ref().map(|finger| finger.iter().map(|b| shares[b.index()]).sum::<f64>())
}

/// The first of those that a vertex follows most.
fn strongest_finger(shares: &Shares) -> usize {
    let sums = finger_shares(shares);
    (0..FINGERS.len()).max_by(|a, b| sums[*a].total_cmp(&sums[*b]).then(b.cmp(a))).unwrap_or(0)
}

/// Leaves the strongest finger alone; the others' shares go to the hand.
fn one_finger(shares: &mut Shares) {
    let strongest = strongest_finger(shares);
    for (_, finger) in FINGERS.iter().enumerate().filter(|(f, _)| *f != strongest) {
        for bone in finger {
            let share = std::mem::take(&mut shares[bone.index()]);
            shares[Bone::LeftHand.index()] += share;
        }
    }
}
