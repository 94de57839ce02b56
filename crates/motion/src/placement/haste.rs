//! How fast the joints of a leg turn: not much faster than in the motion itself.

use glam::{DQuat, DVec3};
use rig::{Angles, Bone, Frame};

use super::fastest::Fastest;
use crate::Leg;

/// What a motion that was seen for a moment only is taken to turn hip, knee, ankle and the shank against the hips by at
/// most, radians a second.
const AT_LEAST: [f64; 4] = [2.0, 3.5, 2.0, 2.5];

/// What a leg remembers of its turns: hip, knee and ankle.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Haste {
    flat: [DQuat; 4],
    placed: [Angles; 3],
    turned: [DQuat; 4],
    /// Of the motion, radians a second; the shank is the last.
    fastest: [Fastest; 4],
}

impl Haste {
    /// Takes in the turns of the motion's own joints.
    pub fn see(&mut self, flat: &[DQuat; 3], dt_secs: f64) {
        let now = with_shank(*flat);
        if dt_secs > 0.0 {
            let left = Fastest::left(dt_secs);
            for ((fastest, now), before) in self.fastest.iter_mut().zip(now).zip(self.flat) {
                fastest.see(between(before, now), left, dt_secs);
            }
        }
        self.flat = now;
    }

    /// Holds what a placed leg's joints turn since the last step to `times` the motion's fastest turn; the foot keeps its
    /// rotation as far as its own turn allows. A step of no time isn't held. Takes and returns the turns of hip, knee and
    /// ankle.
    pub fn hold(
        &mut self,
        leg: &Leg,
        hips: Frame,
        turned: [DQuat; 3],
        times: f64,
        angles: &mut [Angles; Bone::COUNT],
        dt_secs: f64,
    ) -> [DQuat; 3] {
        let mut now = with_shank(turned);
        if dt_secs > 0.0 {
            let rotation = hips.rotation * now[3] * now[2];
            // Hip and knee go the same share of their ways, so that the foot goes toward its goal and not ahead.
            let share = self.share(&now, [0, 1, 3], times * dt_secs);
            if share < 1.0 {
                self.hold_back(leg, &[0, 1], share, angles);
                leg.hold_foot(hips, rotation, angles);
                now = turns(leg, angles);
            }
            let share = self.share(&now, [2], times * dt_secs);
            if share < 1.0 {
                self.hold_back(leg, &[2], share, angles);
                now = turns(leg, angles);
            }
        }
        self.placed = leg.bones().map(|bone| angles[bone.index()]);
        self.turned = now;
        [now[0], now[1], now[2]]
    }

    /// The share of their ways that turns may go, 0 to 1.
    fn share<const N: usize>(&self, now: &[DQuat; 4], which: [usize; N], secs: f64) -> f64 {
        which.into_iter().fold(1.0, |share, turn| {
            let turned = between(self.turned[turn], now[turn]);
            let most = self.fastest[turn].most(AT_LEAST[turn], secs);
            if turned > most { share.min(most / turned) } else { share }
        })
    }

    fn hold_back(&self, leg: &Leg, joints: &[usize], share: f64, angles: &mut [Angles; Bone::COUNT]) {
        let bones = leg.bones();
        for &joint in joints {
            let angles = &mut angles[bones[joint].index()];
            *angles = mixed(self.placed[joint], *angles, share);
        }
    }
}

/// The turns of hip, knee and ankle in their carriers, and of the shank against the hips.
fn turns(leg: &Leg, angles: &[Angles; Bone::COUNT]) -> [DQuat; 4] {
    with_shank(leg.turns(angles))
}

fn with_shank([hip, knee, foot]: [DQuat; 3]) -> [DQuat; 4] {
    [hip, knee, foot, hip * knee]
}

/// The angle of the turn between two rotations, radians.
fn between(a: DQuat, b: DQuat) -> f64 {
    let d = a.conjugate() * b;
    let sine = DVec3::new(d.x, d.y, d.z).length();
    if sine < SMALL {
        let square = sine * sine;
        // The first terms of the arc sine: off by a millionth at most.
        return 2.0 * sine * (1.0 + square * (1.0 / 6.0 + square * (3.0 / 40.0 + square * (15.0 / 336.0))));
    }
    2.0 * kin::arc_tangent(sine, d.w.abs())
}

/// Sines of half turns from step to step are mostly less.
const SMALL: f64 = 0.2;

fn mixed(a: Angles, b: Angles, share: f64) -> Angles {
    let mix = |a: f64, b: f64| a + share * (b - a);
    Angles {
        flexion: mix(a.flexion, b.flexion),
        abduction: mix(a.abduction, b.abduction),
        twist: mix(a.twist, b.twist),
    }
}
