//! The skin palette: where posed bones take the skin, as dual quaternions.

use bytemuck::{Pod, Zeroable};
use glam::{DQuat, DVec3, Vec3};

use crate::dual_quaternion::DualQuaternion;
use crate::twist::{SEGMENTS, TwistPlace};
use crate::{Bone, Frames};

/// Places in a palette: the bones, the twist places (see [`crate::spread_twist`]), padded to a round number for the
/// uniform buffer.
pub const PALETTE_LEN: usize = 64;

/// One unit dual quaternion a place, real part before dual part, each `x, y, z, w`: takes a point of the skin at rest
/// to the posed figure, metres, in the space of the frames that it was made from (figure or world).
///
/// Laid out as the shader's `array<DualQuaternion, 64>`; places beyond the last are the identity.
///
/// A turn has two quaternions, `q` and `-q`, and between them a blend goes the short or the long way round. The signs
/// are settled here, down the hierarchy: each place has that sign which lies within a half turn of its carrier's. So
/// two vertices can't decide it differently, no test is needed a vertex, and neighbours on a body, which share bones of
/// one chain, blend the way that the chain bends. Only a joint that is turned beyond a half turn changes its sign.
#[derive(Clone, Copy, PartialEq, Debug, Pod, Zeroable)]
#[repr(transparent)]
pub struct Palette(pub [[[f32; 4]; 2]; PALETTE_LEN]);

const IDENTITY: [[f32; 4]; 2] = [[0.0, 0.0, 0.0, 1.0], [0.0; 4]];

impl Palette {
    /// The palette of the rest pose.
    pub const REST: Palette = Palette([IDENTITY; PALETTE_LEN]);

    /// The palette of posed joints, given where each joint is at rest (axis-aligned there).
    pub fn new(figure_from_joint: &Frames, rest_positions: &[DVec3; Bone::COUNT]) -> Palette {
        let mut palette = Palette::REST;
        let mut turns = [DQuat::IDENTITY; Bone::COUNT];
        let mut set = |place: usize, bone: Bone, turn: DQuat| {
            let (from, to) = (rest_positions[bone.index()], figure_from_joint[bone].position);
            palette.0[place] = DualQuaternion::rigid(turn, from, to).to_rows();
        };
        for bone in Bone::ALL {
            let turn = figure_from_joint[bone].rotation;
            let turn = if turn.dot(turns[bone.carrier().index()]) < 0.0 { -turn } else { turn };
            turns[bone.index()] = turn;
            set(bone.index(), bone, turn);
        }
        for segment in &SEGMENTS {
            set(segment.place, segment.bone, twist_turn(segment, &turns, rest_positions));
        }
        palette
    }

    /// Where a rest point goes if it belongs to that bone alone.
    pub fn point(&self, bone: Bone, rest: Vec3) -> Vec3 {
        self.motion(bone.index()).point(rest)
    }

    /// What a place does; one beyond the last does what the last does.
    #[inline]
    pub(crate) fn motion(&self, place: usize) -> DualQuaternion {
        DualQuaternion::from_rows(self.0[place.min(PALETTE_LEN - 1)])
    }
}

/// The turn of a segment's twist place. A segment without length has no twist of its own.
fn twist_turn(segment: &TwistPlace, turns: &[DQuat; Bone::COUNT], rest: &[DVec3; Bone::COUNT]) -> DQuat {
    let turn = turns[segment.bone.index()];
    let along = rest[segment.next.index()] - rest[segment.bone.index()];
    let Some(axis) = along.try_normalize() else { return turn };
    if segment.twists_with_next {
        turn * twist_of(turn.conjugate() * turns[segment.next.index()], axis)
    } else {
        let carrier = turns[segment.bone.carrier().index()];
        turn * twist_of(carrier.conjugate() * turn, axis).conjugate()
    }
}

/// The twist about a unit axis in a turn, the angle within a half turn, as `kin::swing_twist` has it but without the
/// angle. It is exact until the swing is a half turn, at which every twist would do; then it is none.
fn twist_of(turn: DQuat, axis: DVec3) -> DQuat {
    let along = DVec3::new(turn.x, turn.y, turn.z).dot(axis);
    let upright = (along * along + turn.w * turn.w).sqrt();
    if upright == 0.0 {
        return DQuat::IDENTITY;
    }
    let sine = axis * (along / upright.copysign(turn.w));
    DQuat::from_xyzw(sine.x, sine.y, sine.z, turn.w.abs() / upright)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Frame;

    const ARM: Bone = Bone::LeftUpperArm;

    fn rest() -> [DVec3; Bone::COUNT] {
        let mut rest = [DVec3::new(0.0, 1.0, 0.0); Bone::COUNT];
        rest[ARM.index()] = DVec3::new(0.2, 1.4, 0.0);
        rest[Bone::LeftLowerArm.index()] = DVec3::new(0.5, 1.4, 0.0);
        rest
    }

    /// Everything at rest but the left upper arm.
    fn turned(turn: DQuat) -> Palette {
        let mut frames = Frames(rest().map(|position| Frame { rotation: DQuat::IDENTITY, position }));
        frames.0[ARM.index()].rotation = turn;
        Palette::new(&frames, &rest())
    }

    fn twist_place() -> usize {
        SEGMENTS.iter().find(|s| s.bone == ARM).unwrap().place
    }

    #[test]
    fn joints_at_rest_give_the_rest_palette() {
        assert_eq!(turned(DQuat::IDENTITY), Palette::REST);
    }

    #[test]
    fn a_twist_place_swings_with_its_bone_and_leaves_out_its_twist() {
        let swing = DQuat::from_rotation_z(1.1);
        let palette = turned(swing * DQuat::from_rotation_x(1.3));
        let swung = turned(swing);
        let place = palette.motion(twist_place());
        for p in [Vec3::new(0.3, 1.45, 0.02), Vec3::new(0.5, 1.4, 0.0), Vec3::new(0.1, 1.3, -0.1)] {
            assert!(place.point(p).distance(swung.point(ARM, p)) < 1e-6);
        }
        assert!(
            palette.point(ARM, Vec3::new(0.3, 1.45, 0.02)).distance(place.point(Vec3::new(0.3, 1.45, 0.02)))
                > 0.03
        );
    }

    #[test]
    fn a_swing_near_a_half_turn_keeps_its_twist_place_and_one_of_a_half_turn_is_finite() {
        for degrees in [170.0_f64, 176.0, 179.9] {
            let swing = DQuat::from_rotation_z(-degrees.to_radians());
            let place = turned(swing * DQuat::from_rotation_x(-1.2)).motion(twist_place());
            let p = Vec3::new(0.3, 1.45, 0.02);
            assert!(place.point(p).distance(turned(swing).point(ARM, p)) < 1e-6, "{degrees}");
        }
        for turn in [DQuat::from_xyzw(0.0, 1.0, 0.0, 0.0), DQuat::from_xyzw(0.0, 0.0, -1.0, 0.0)] {
            assert!(turned(turn).0.iter().flatten().flatten().all(|c| c.is_finite()));
        }
    }

    #[test]
    fn either_sign_of_a_turn_gives_the_same_palette() {
        let turn = DQuat::from_rotation_z(2.0) * DQuat::from_rotation_x(0.4);
        assert_eq!(turned(turn), turned(-turn));
    }
}
