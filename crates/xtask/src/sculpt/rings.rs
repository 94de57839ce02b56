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
        Rings { neighbours, middle: half.points.iter().map(|p| p.x < MIDDLE_M).collect() }
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

/// Leaves the strongest finger alone; the others' shares go to the hand.
fn one_finger(shares: &mut Shares) {
    let of = |finger: &[Bone; 3]| finger.iter().map(|b| shares[b.index()]).sum::<f64>();
    let sums = FINGERS.each_ref().map(of);
    let strongest = (0..FINGERS.len()).max_by(|a, b| sums[*a].total_cmp(&sums[*b]).then(b.cmp(a)));
    for (_, finger) in FINGERS.iter().enumerate().filter(|(f, _)| Some(*f) != strongest) {
        for bone in finger {
            let share = std::mem::take(&mut shares[bone.index()]);
            shares[Bone::LeftHand.index()] += share;
        }
    }
}
