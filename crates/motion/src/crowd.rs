//! Thousands of walkers on one ground: sixteen abreast in single precision.
//!
//! A crowd is for the eye: its feet go by the ground's height and slope under them, without the memory of where they
//! touched that a [`crate::Walker`] has. Same start, same steps, same bits, on any processor.

mod block;
mod company;
mod gaits;
mod heights;
mod lanes;
mod leg;
mod skeleton;
mod twist;

use pulp::{Arch, Simd, WithSimd};
use rig::PLACES;

use block::Block;
pub use company::Company;
use company::Nudge;
pub use gaits::{Gait, Gaits};
pub use heights::Heights;
pub use lanes::{LANES, Row};
pub use skeleton::CrowdFigure;

/// Matrices of a figure: the palette's places, then where it stands and the ground under it.
pub const ROWS: usize = PLACES + 2;

/// The matrices of figures abreast: by place, then by number of the matrix (three columns of the turn, then the shift),
/// then by figure. They take a point of the skin at rest to the world, metres.
pub type Matrices = [[Row; 12]; ROWS];

/// Metres from the border of the ground at which a walker turns back.
const MARGIN_M: f32 = 2.0;

/// How fast the hips follow the ground: seconds to come within a third.
const FOLLOW_SECS: f32 = 0.12;

/// Many walkers.
#[derive(Clone, Debug)]
pub struct Crowd {
    figure: CrowdFigure,
    gaits: Gaits,
    count: usize,
    walkers: Vec<Wander>,
    blocks: Vec<Block>,
    matrices: Vec<Matrices>,
}

/// What a walker does by itself.
#[derive(Clone, Copy, Debug)]
struct Wander {
    stride: usize,
    phase: f32,
    /// Radians about +Y from +Z, to the left.
    heading: f32,
    /// Radians a second.
    turning: f32,
    at: [f32; 2],
}

impl Crowd {
    /// Walkers spread over a square of `half_m` metres to each side of the origin, from a seed.
    pub fn new(figure: CrowdFigure, gaits: Gaits, count: usize, half_m: f32, seed: u64) -> Crowd {
        let blocks = count.div_ceil(LANES);
        let mut dice = Dice(seed);
        let reach = (half_m - MARGIN_M).max(0.0);
        let walkers = (0..blocks * LANES).map(|_| Wander::any(&mut dice, &gaits, reach)).collect();
        let block = Block::of(&gaits.strides[0].entries[0].turns);
        let nowhere = [[Row::all(0.0); 12]; ROWS];
        Crowd { figure, gaits, count, walkers, blocks: vec![block; blocks], matrices: vec![nowhere; blocks] }
    }

    /// How many walk.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Goes on by a time step, seconds: ways, joints, feet, matrices.
    pub fn step(&mut self, ground: &Heights, dt_secs: f32) {
        self.go(ground, dt_secs, |_| Nudge::NONE);
    }

    /// The same, but walkers go round each other and everyone else on the ground, as they stood before the step.
    pub fn step_among(&mut self, company: &Company, ground: &Heights, dt_secs: f32) {
        self.go(ground, dt_secs, |walker| company.nudge(walker.at, walker.heading));
    }

    /// Where everyone is: x and z, metres, world.
    pub fn places(&self) -> impl Iterator<Item = [f32; 2]> {
        self.walkers.iter().take(self.count).map(|walker| walker.at)
    }

    fn go(&mut self, ground: &Heights, dt_secs: f32, nudge: impl Fn(&Wander) -> Nudge) {
        for walker in &mut self.walkers {
            let nudge = nudge(walker);
            walker.step(&self.gaits, ground.half() - MARGIN_M, dt_secs, nudge);
        }
        self.sample();
        self.place_feet(ground, dt_secs);
        self.write();
    }

    /// Reads the joints of everyone's phase from the table.
    pub fn sample(&mut self) {
        Arch::new().dispatch(Sampling(self));
    }

    /// Places everyone's feet on the ground; a time step that is not finite does so at once.
    pub fn place_feet(&mut self, ground: &Heights, dt_secs: f32) {
        let ease = if dt_secs.is_finite() { 1.0 - (-dt_secs / FOLLOW_SECS).exp() } else { 1.0 };
        Arch::new().dispatch(Placing { crowd: self, ground, ease });
    }

    /// Writes everyone's matrices.
    pub fn write(&mut self) {
        Arch::new().dispatch(Writing(self));
    }

    /// The matrices, sixteen figures abreast; those beyond [`Crowd::count`] in the last block are no one's.
    pub fn matrices(&self) -> &[Matrices] {
        &self.matrices
    }

    /// The same as plain numbers, in the order of [`Matrices`].
    pub fn numbers(&self) -> &[f32] {
        bytemuck::cast_slice(self.matrices.as_flattened().as_flattened())
    }
}

impl Wander {
    fn any(dice: &mut Dice, gaits: &Gaits, reach: f32) -> Wander {
        let stride = (dice.roll() * gaits.strides.len() as f32) as usize;
        Wander {
            stride: stride.min(gaits.strides.len() - 1),
            phase: dice.roll(),
            heading: dice.roll() * std::f32::consts::TAU,
            turning: 0.3 * (dice.roll() - 0.5),
            at: [reach * (2.0 * dice.roll() - 1.0), reach * (2.0 * dice.roll() - 1.0)],
        }
    }

    fn step(&mut self, gaits: &Gaits, reach: f32, dt: f32, nudge: Nudge) {
        let stride = &gaits.strides[self.stride];
        let pace = dt * nudge.pace;
        self.phase = (self.phase + pace * stride.per_sec).rem_euclid(1.0);
        self.at = [self.at[0] + nudge.shift[0] * dt, self.at[1] + nudge.shift[1] * dt];
        // Who stands doesn't turn on the spot.
        if stride.speed == 0.0 {
            return;
        }
        let (sine, cosine) = self.heading.sin_cos();
        let [x, z] = self.at;
        // Who is at the border and walks outward turns on, always to the same side.
        let outward = x * sine + z * cosine > 0.0 && x.abs().max(z.abs()) > reach;
        self.heading += dt * if outward { BACK_RAD_PER_SEC } else { self.turning + nudge.turn };
        self.at = [x + sine * stride.speed * pace, z + cosine * stride.speed * pace];
    }
}

/// How fast a walker turns back at the border.
const BACK_RAD_PER_SEC: f32 = 1.2;

struct Sampling<'a>(&'a mut Crowd);

impl WithSimd for Sampling<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Crowd { gaits, walkers, blocks, .. } = self.0;
        for (block, walkers) in blocks.iter_mut().zip(walkers.chunks_exact(LANES)) {
            for (lane, walker) in walkers.iter().enumerate() {
                let (sine, cosine) = (0.5 * walker.heading).sin_cos();
                for (row, value) in block.heading.iter_mut().zip([sine, cosine]) {
                    row.0[lane] = value;
                }
                for (row, value) in block.place.iter_mut().zip(walker.at) {
                    row.0[lane] = value;
                }
                sample(gaits, walker, block, lane);
            }
        }
    }
}

/// One walker's joints from the table, straight between neighbours and made unit.
#[inline(always)]
fn sample(gaits: &Gaits, walker: &Wander, block: &mut Block, lane: usize) {
    let entries = &gaits.strides[walker.stride].entries;
    let along = walker.phase * (entries.len() - 1) as f32;
    let index = (along as usize).min(entries.len() - 2);
    let (share, [from, to]) = (along - index as f32, [&entries[index], &entries[index + 1]]);
    for (k, row) in block.hips.iter_mut().enumerate() {
        row.0[lane] = from.hips[k] + share * (to.hips[k] - from.hips[k]);
    }
    for &bone in &gaits.moving {
        let (a, b) = (glam::Vec4::from(from.turns[bone]), glam::Vec4::from(to.turns[bone]));
        let turn = a + (b - a) * share;
        let turn = turn * (1.0 / turn.length());
        for (row, value) in block.turns[bone].iter_mut().zip(turn.to_array()) {
            row.0[lane] = value;
        }
    }
}

struct Placing<'a> {
    crowd: &'a mut Crowd,
    ground: &'a Heights,
    ease: f32,
}

impl WithSimd for Placing<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for block in &mut self.crowd.blocks {
            block.place_feet(simd, &self.crowd.figure, self.ground, self.ease);
        }
    }
}

struct Writing<'a>(&'a mut Crowd);

impl WithSimd for Writing<'_> {
    type Output = ();
    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (block, out) in self.0.blocks.iter().zip(&mut self.0.matrices) {
            block.write(simd, &self.0.figure, out);
        }
    }
}

/// Numbers from a seed (splitmix64): the same everywhere.
struct Dice(u64);

impl Dice {
    /// From 0 to just below 1.
    fn roll(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 40) as f32 / (1u64 << 24) as f32
    }
}
