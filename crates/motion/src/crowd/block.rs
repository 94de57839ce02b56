//! A block of a crowd: as many figures as go abreast, and what is done to them at once.

use pulp::Simd;
use rig::{Bone, PLACES};

use super::lanes::{LANES, Num, Row, Turn, Vector};
use super::leg::LegTurns;
use super::skeleton::{CrowdFigure, LEGS};
use super::{Heights, ROWS};

/// Figures abreast: where they are, how their joints are turned on flat ground, and how their feet were placed.
#[derive(Clone, Debug)]
pub(super) struct Block {
    /// World, metres: x and z.
    pub place: [Row; 2],
    /// About +Y: sine and cosine of half the heading.
    pub heading: [Row; 2],
    /// Of the motion on flat ground: the hips in figure space.
    pub hips: [Row; 3],
    /// By bone: the turn against its carrier.
    pub turns: [[Row; 4]; Bone::COUNT],
    /// How far the hips are off their height over flat ground, metres, eased.
    pub lift: Row,
    /// The ground's rise a metre along x and z, between the feet.
    pub slope: [Row; 2],
    /// By leg: thigh, shin and foot in the world, as placed.
    pub legs: [[[Row; 4]; 3]; 2],
}

impl Block {
    /// Figures at the origin, their joints turned as given.
    pub fn of(turns: &[[f32; 4]; Bone::COUNT]) -> Block {
        let none = [Row::all(0.0), Row::all(0.0), Row::all(0.0), Row::all(1.0)];
        Block {
            place: [Row::all(0.0); 2],
            heading: [Row::all(0.0), Row::all(1.0)],
            hips: [Row::all(0.0); 3],
            turns: turns.map(|turn| turn.map(Row::all)),
            lift: Row::all(0.0),
            slope: [Row::all(0.0); 2],
            legs: [[none; 3]; 2],
        }
    }

    /// Places both feet on the ground: hips go by the lower foot's ground, `ease` of the way (1 at once), legs are solved,
    /// soles tilted as they near the ground.
    #[inline(always)]
    pub fn place_feet<S: Simd>(&mut self, simd: S, figure: &CrowdFigure, heights: &Heights, ease: f32) {
        for part in 0..LANES / S::F32_LANES {
            let hips_turn = self.hips_turn(simd, part);
            let hips = self.hips_place(simd, part);
            let left = self.animated(simd, part, figure, 0, hips_turn, hips);
            let right = self.animated(simd, part, figure, 1, hips_turn, hips);
            let left_ground = ground(simd, heights, left.ankle);
            let right_ground = ground(simd, heights, right.ankle);
            let lower = left_ground.height.min(right_ground.height);
            let before = self.lift.get(simd, part);
            let lift = before + (lower - before) * Num::all(simd, ease);
            self.lift.set(part, lift);
            let half = Num::all(simd, 0.5);
            self.slope[0].set(part, (left_ground.along_x + right_ground.along_x) * half);
            self.slope[1].set(part, (left_ground.along_z + right_ground.along_z) * half);
            self.stand(simd, part, figure, 0, Stand { leg: left, ground: left_ground, lift });
            self.stand(simd, part, figure, 1, Stand { leg: right, ground: right_ground, lift });
        }
    }

    /// One leg brought to its ground, the hips being lifted.
    #[inline(always)]
    fn stand<S: Simd>(&mut self, simd: S, part: usize, figure: &CrowdFigure, side: usize, stand: Stand<S>) {
        let Stand { leg, ground, lift } = stand;
        let (zero, one) = (Num::all(simd, 0.0), Num::all(simd, 1.0));
        let shift = Vector { x: zero, y: ground.height - lift, z: zero };
        let turns = figure.legs[side].shifted(simd, leg.turns, shift);
        // The nearer to the ground, the more the sole follows it.
        let rest = Num::all(simd, figure.rest[LEGS[side][2]][1]);
        let raised = (leg.ankle.y - rest) * Num::all(simd, 1.0 / RAISED_M);
        let near = (one - raised).min(one).max(zero);
        let tilt = tilt(simd, ground.along_x * near, ground.along_z * near);
        let [upper, lower, foot] = &mut self.legs[side];
        turns.upper.set(upper, part);
        turns.lower.set(lower, part);
        tilt.after(leg.foot).set(foot, part);
    }

    /// A leg of the motion on flat ground, in the world.
    #[inline(always)]
    fn animated<S: Simd>(
        &self,
        simd: S,
        part: usize,
        figure: &CrowdFigure,
        side: usize,
        hips_turn: Turn<S>,
        hips: Vector<S>,
    ) -> Animated<S> {
        let [thigh, shin, foot, _] = LEGS[side];
        let upper = hips_turn.after(Turn::get(simd, &self.turns[thigh], part));
        let lower = upper.after(Turn::get(simd, &self.turns[shin], part));
        let end = lower.after(Turn::get(simd, &self.turns[foot], part));
        let ankle = hips
            .plus(hips_turn.of(Vector::all(simd, figure.offsets[thigh])))
            .plus(upper.of(Vector::all(simd, figure.offsets[shin])))
            .plus(lower.of(Vector::all(simd, figure.offsets[foot])));
        Animated { turns: LegTurns { upper, lower }, foot: end, ankle }
    }

    /// The heading, then the hips' own turn.
    #[inline(always)]
    fn hips_turn<S: Simd>(&self, simd: S, part: usize) -> Turn<S> {
        self.heading(simd, part).after(Turn::get(simd, &self.turns[Bone::Hips.index()], part))
    }

    #[inline(always)]
    fn heading<S: Simd>(&self, simd: S, part: usize) -> Turn<S> {
        let zero = Num::all(simd, 0.0);
        let y = self.heading[0].get(simd, part);
        Turn { v: Vector { x: zero, y, z: zero }, w: self.heading[1].get(simd, part) }
    }

    /// The hips over flat ground, world.
    #[inline(always)]
    fn hips_place<S: Simd>(&self, simd: S, part: usize) -> Vector<S> {
        let zero = Num::all(simd, 0.0);
        let at = Vector { x: self.place[0].get(simd, part), y: zero, z: self.place[1].get(simd, part) };
        at.plus(self.heading(simd, part).of(Vector::get(simd, &self.hips, part)))
    }

    /// Writes every bone's matrix, world from rest, legs as they were placed.
    #[inline(always)]
    pub fn write<S: Simd>(&self, simd: S, figure: &CrowdFigure, out: &mut [[Row; 12]; ROWS]) {
        for part in 0..LANES / S::F32_LANES {
            self.write_part(simd, part, figure, out);
        }
    }

    #[inline(always)]
    fn write_part<S: Simd>(&self, simd: S, part: usize, figure: &CrowdFigure, out: &mut [[Row; 12]; ROWS]) {
        let origin = Vector::all(simd, [0.0; 3]);
        let none = Turn { v: origin, w: Num::all(simd, 1.0) };
        let mut turns = [none; Bone::COUNT];
        let mut places = [origin; Bone::COUNT];
        for bone in 0..Bone::COUNT {
            let carrier = figure.carriers[bone];
            if bone == Bone::Hips.index() {
                turns[bone] = self.hips_turn(simd, part);
                let at = self.hips_place(simd, part);
                places[bone] = Vector { y: at.y + self.lift.get(simd, part), ..at };
            } else {
                turns[bone] = match placed(bone) {
                    Some((side, segment)) => Turn::get(simd, &self.legs[side][segment], part),
                    None => turns[carrier].after(Turn::get(simd, &self.turns[bone], part)),
                };
                let offset = Vector::all(simd, figure.offsets[bone]);
                places[bone] = places[carrier].plus(turns[carrier].of(offset));
            }
            matrix(simd, part, turns[bone], places[bone], figure.rest[bone], &mut out[bone]);
        }
        for (row, twist) in out[Bone::COUNT..].iter_mut().zip(&figure.twists) {
            let turn = twist.turn(simd, &turns, &figure.carriers);
            matrix(simd, part, turn, places[twist.bone], figure.rest[twist.bone], row);
        }
        let stands = self.stands(simd, part);
        let tilt = tilt(simd, self.slope[0].get(simd, part), self.slope[1].get(simd, part));
        let heading = self.heading(simd, part);
        matrix(simd, part, heading, stands, [0.0; 3], &mut out[PLACES]);
        matrix(simd, part, tilt.after(heading), stands, [0.0; 3], &mut out[PLACES + 1]);
    }

    /// The point below the hips' own height over flat ground.
    #[inline(always)]
    fn stands<S: Simd>(&self, simd: S, part: usize) -> Vector<S> {
        let (x, z) = (self.place[0].get(simd, part), self.place[1].get(simd, part));
        Vector { x, y: self.lift.get(simd, part), z }
    }
}

/// The shortest turn from level to a slope.
#[inline(always)]
fn tilt<S: Simd>(simd: S, along_x: Num<S>, along_z: Num<S>) -> Turn<S> {
    let (zero, one) = (Num::all(simd, 0.0), Num::all(simd, 1.0));
    let normal = Vector { x: -along_x, y: one, z: -along_z };
    let normal = normal.times(normal.dot(normal).inverse_sqrt());
    Turn::arc(simd, Vector { x: zero, y: one, z: zero }, normal)
}

/// Height of an animated ankle over its rest at which the sole no longer follows the ground, metres.
const RAISED_M: f32 = 0.10;

/// The leg and its segment that a bone is.
const fn placed(bone: usize) -> Option<(usize, usize)> {
    let mut side = 0;
    while side < 2 {
        let mut segment = 0;
        while segment < 3 {
            if LEGS[side][segment] == bone {
                return Some((side, segment));
            }
            segment += 1;
        }
        side += 1;
    }
    None
}

/// What brings a leg to its ground.
#[derive(Clone, Copy)]
struct Stand<S: Simd> {
    leg: Animated<S>,
    ground: Underfoot<S>,
    /// Of the hips, metres.
    lift: Num<S>,
}

#[derive(Clone, Copy)]
struct Animated<S: Simd> {
    turns: LegTurns<S>,
    foot: Turn<S>,
    ankle: Vector<S>,
}

#[derive(Clone, Copy)]
struct Underfoot<S: Simd> {
    height: Num<S>,
    along_x: Num<S>,
    along_z: Num<S>,
}

/// The ground under a point of each lane, looked up one by one.
#[inline(always)]
fn ground<S: Simd>(simd: S, heights: &Heights, at: Vector<S>) -> Underfoot<S> {
    let (mut xs, mut zs) = (Row::all(0.0), Row::all(0.0));
    xs.set(0, at.x);
    zs.set(0, at.z);
    let (mut height, mut along_x, mut along_z) = (Row::all(0.0), Row::all(0.0), Row::all(0.0));
    for lane in 0..S::F32_LANES {
        [height.0[lane], along_x.0[lane], along_z.0[lane]] = heights.at(xs.0[lane], zs.0[lane]);
    }
    let (height, along_x) = (height.get(simd, 0), along_x.get(simd, 0));
    Underfoot { height, along_x, along_z: along_z.get(simd, 0) }
}

/// World from rest: three columns of the turn, then the shift.
#[inline(always)]
fn matrix<S: Simd>(
    simd: S,
    part: usize,
    turn: Turn<S>,
    place: Vector<S>,
    rest: [f32; 3],
    out: &mut [Row; 12],
) {
    let columns = turn.columns(simd);
    let [a, b, c] = columns;
    let (x, y, z) = (Num::all(simd, rest[0]), Num::all(simd, rest[1]), Num::all(simd, rest[2]));
    let shift = place.minus(a.times(x)).minus(b.times(y)).minus(c.times(z));
    let mut k = 0;
    for column in [a, b, c, shift] {
        out[k].set(part, column.x);
        out[k + 1].set(part, column.y);
        out[k + 2].set(part, column.z);
        k += 3;
    }
}
