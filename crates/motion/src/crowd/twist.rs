//! Twist places of a crowd's figure, as the palette of a single figure has them.

use pulp::Simd;
use rig::{Bone, TwistPlace};

use super::lanes::{Turn, Vector};

/// A place that differs from its bone by a turn about the segment.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Twist {
    pub bone: usize,
    next: usize,
    with_next: bool,
    /// Unit, along the segment at rest.
    axis: [f32; 3],
}

impl Twist {
    /// A twist place of a figure whose joints are at these places at rest.
    pub fn of(place: &TwistPlace, rest: &[[f32; 3]; Bone::COUNT]) -> Twist {
        let (bone, next) = (place.bone.index(), place.next.index());
        let along = glam::Vec3::from(rest[next]) - glam::Vec3::from(rest[bone]);
        Twist {
            bone,
            next,
            with_next: place.twists_with_next,
            axis: along.normalize_or(glam::Vec3::Y).to_array(),
        }
    }

    /// The place's turn, those of the bones being given.
    #[inline(always)]
    pub fn turn<S: Simd>(
        &self,
        simd: S,
        turns: &[Turn<S>; Bone::COUNT],
        carriers: &[usize; Bone::COUNT],
    ) -> Turn<S> {
        let turn = turns[self.bone];
        let (outer, inner) =
            if self.with_next { (turn, turns[self.next]) } else { (turn, turns[carriers[self.bone]]) };
        // For the bone's own twist, left out: its carrier's turn seen from the bone has the opposite one.
        turn.after(twist(outer.inverse().after(inner), Vector::all(simd, self.axis)))
    }
}

/// The twist about a unit axis in a turn.
#[inline(always)]
fn twist<S: Simd>(turn: Turn<S>, axis: Vector<S>) -> Turn<S> {
    let along = turn.v.dot(axis);
    let scale = (along * along + turn.w * turn.w).inverse_sqrt();
    Turn { v: axis.times(along * scale), w: turn.w * scale }
}
