//! Legs of many figures at once: the ankle is brought to another place, the knee stays as near as it can.

use pulp::Simd;

use super::lanes::{Num, Turn, Vector};

/// A leg's lengths and rest directions, the same for a whole crowd.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LegShape {
    /// Hip to knee, metres.
    pub upper: f32,
    /// Knee to ankle, metres.
    pub lower: f32,
    /// Unit, hip to knee at rest.
    pub upper_direction: [f32; 3],
    /// Unit, knee to ankle at rest.
    pub lower_direction: [f32; 3],
    /// Unit, the knee's hinge at rest; the knee points along hinge x downward.
    pub hinge: [f32; 3],
}

/// The turns of thigh and shin in the space of the hips' carrier.
#[derive(Clone, Copy)]
pub struct LegTurns<S: Simd> {
    pub upper: Turn<S>,
    pub lower: Turn<S>,
}

/// Distance short of full stretch where a leg begins to soften, as a fraction of its length.
const SOFT: f32 = 0.02;

impl LegShape {
    /// Bends an animated leg so that its ankle goes by `shift` while the hip stays.
    ///
    /// The leg turns by the shortest turn that takes the line from hip to ankle to its new direction, and then bends in
    /// its own plane: so the knee's side is the animated one. Out of reach it is almost straight toward the target.
    #[inline(always)]
    pub fn shifted<S: Simd>(&self, simd: S, animated: LegTurns<S>, shift: Vector<S>) -> LegTurns<S> {
        let thigh = animated.upper.of(Vector::all(simd, self.upper_direction));
        let shin = animated.lower.of(Vector::all(simd, self.lower_direction));
        let (upper, lower) = (Num::all(simd, self.upper), Num::all(simd, self.lower));
        let from = thigh.times(upper).plus(shin.times(lower));
        let to = from.plus(shift);
        let (from_square, to_square) = (from.dot(from), to.dot(to));
        let (from_inverse, to_inverse) = (from_square.inverse_sqrt(), to_square.inverse_sqrt());
        let direction = to.times(to_inverse);
        let swing = Turn::arc(simd, from.times(from_inverse), direction);
        let hinge = swing.of(animated.upper.of(Vector::all(simd, self.hinge)));
        let forward = direction.cross(hinge);

        let distance = self.softened(simd, from_square * from_inverse, to_square * to_inverse);
        let bend = upper * upper - lower * lower;
        let along = (distance * distance + bend).over(distance + distance);
        let beside = (upper * upper - along * along).max(Num::all(simd, 0.0)).sqrt();
        let knee = direction.times(along).plus(forward.times(beside));
        let upper_to = knee.times(Num::all(simd, 1.0 / self.upper));
        let lower_to = direction.times(distance).minus(knee).times(Num::all(simd, 1.0 / self.lower));
        LegTurns {
            upper: Turn::arc(simd, swing.of(thigh), upper_to).after(swing.after(animated.upper)),
            lower: Turn::arc(simd, swing.of(shin), lower_to).after(swing.after(animated.lower)),
        }
    }

    /// A distance that nears full stretch and never gets there, and is no less than what the folded leg has:
    /// d up to a bound, then bound + s x / (s + x). The animated distance stays as it is.
    #[inline(always)]
    fn softened<S: Simd>(&self, simd: S, animated: Num<S>, distance: Num<S>) -> Num<S> {
        let full = self.upper + self.lower;
        let bound = Num::all(simd, (1.0 - SOFT) * full).max(animated);
        let soft = (Num::all(simd, full) - bound).max(Num::all(simd, 1e-6));
        let beyond = (distance - bound).max(Num::all(simd, 0.0));
        let eased = soft * beyond.over(soft + beyond);
        let least = (self.upper - self.lower).abs() + 0.1 * full;
        (distance.min(bound) + eased).max(Num::all(simd, least))
    }
}
