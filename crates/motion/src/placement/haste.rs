//! How fast the joints of a leg turn: not much faster than in the motion itself.

use glam::{DQuat, DVec3};
use rig::{Angles, Bone, Frame};

use crate::Leg;

/// What a motion that was seen for a moment only is taken to turn hip, knee and ankle by at most, radians a second.
const AT_LEAST: [f64; 3] = [4.4, 7.6, 5.6];
/// How long a motion's fastest turn counts, seconds: a third is left of it then.
const REMEMBERED_SECS: f64 = 6.0;

/// What a leg remembers of its turns: hip, knee and ankle.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub(super) struct Haste {
    flat: [DQuat; 3],
    placed: [Angles; 3],
    /// Of the motion, radians a second.
    fastest: [f64; 3],
}

impl Haste {
    /// Takes in the motion's own joints.
    pub fn see(&mut self, leg: &Leg, flat: &[Angles; Bone::COUNT], dt_secs: f64) {
        let now = leg.turns(flat);
        if dt_secs > 0.0 {
            let left = (-dt_secs / REMEMBERED_SECS).exp();
            for ((fastest, now), before) in self.fastest.iter_mut().zip(now).zip(self.flat) {
                *fastest = (*fastest * left).max(between(before, now) / dt_secs);
            }
        }
        self.flat = now;
    }

    /// Holds what a placed leg's joints turn since the last step to `times` the motion's fastest turn; the foot keeps its
    /// rotation as far as its own turn allows. A step of no time isn't held.
    pub fn hold(
        &mut self,
        leg: &Leg,
        hips: Frame,
        times: f64,
        angles: &mut [Angles; Bone::COUNT],
        dt_secs: f64,
    ) {
        if dt_secs > 0.0 {
            let rotation = leg.ankle_and_foot(hips, angles).rotation;
            let held = [0, 1].map(|joint| self.held(leg, joint, times * dt_secs, angles));
            if held[0] || held[1] {
                leg.hold_foot(hips, rotation, angles);
            }
            self.held(leg, 2, times * dt_secs, angles);
        }
        self.placed = leg.bones().map(|bone| angles[bone.index()]);
    }

    /// Holds one joint, and says whether it had to.
    fn held(&self, leg: &Leg, joint: usize, secs: f64, angles: &mut [Angles; Bone::COUNT]) -> bool {
        let bones = leg.bones();
        let mut before = *angles;
        for (bone, placed) in bones.iter().zip(self.placed) {
            before[bone.index()] = placed;
        }
        let turned = between(leg.turns(&before)[joint], leg.turns(angles)[joint]);
        let most = self.fastest[joint].max(AT_LEAST[joint]) * secs;
        let bone = bones[joint].index();
        if turned > most {
            angles[bone] = mixed(before[bone], angles[bone], most / turned);
        }
        turned > most
    }
}

/// The angle of the turn between two rotations, radians.
fn between(a: DQuat, b: DQuat) -> f64 {
    let d = a.conjugate() * b;
    2.0 * DVec3::new(d.x, d.y, d.z).length().atan2(d.w.abs())
}

fn mixed(a: Angles, b: Angles, share: f64) -> Angles {
    let mix = |a: f64, b: f64| a + share * (b - a);
    Angles {
        flexion: mix(a.flexion, b.flexion),
        abduction: mix(a.abduction, b.abduction),
        twist: mix(a.twist, b.twist),
    }
}
