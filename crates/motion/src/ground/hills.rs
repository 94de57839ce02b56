//! Rolling ground: a grid of quads with noise heights, which repeats seamlessly.

use fastnoise_lite::{FastNoiseLite, FractalType, NoiseType};
use glam::{DVec2, DVec3};

use crate::GroundPoint;

/// Quads along each side of the tile.
const SIDE: usize = 256;

/// How high hills rise.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Rise {
    /// The highest and the lowest corner are that far from 0 on average, metres.
    Amplitude(f64),
    /// The steepest facet has exactly that slope, degrees.
    Steepest(f64),
}

/// What makes hills.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct HillsShape {
    /// The same seed gives the same hills.
    pub seed: u64,
    /// How high they rise.
    pub rise: Rise,
    /// From hill to hill, metres.
    pub wavelength_m: f64,
    /// The side of a quad, metres.
    pub cell_m: f64,
}

impl HillsShape {
    /// The steepest facet's slope by default, degrees.
    pub const STEEPEST_DEG: f64 = 25.0;
    /// From hill to hill by default, metres.
    pub const WAVELENGTH_M: f64 = 5.0;
}

impl Default for HillsShape {
    fn default() -> HillsShape {
        let rise = Rise::Steepest(HillsShape::STEEPEST_DEG);
        HillsShape { seed: 1, rise, wavelength_m: HillsShape::WAVELENGTH_M, cell_m: 0.25 }
    }
}

/// Rolling ground without end: a tile of 256 by 256 quads, over and over. Level at height 0 it is nowhere in
/// particular; the corner at the origin has height 0.
#[derive(Clone, PartialEq, Debug)]
pub struct Hills {
    shape: HillsShape,
    /// Heights of corners, row by row along z.
    corners: Vec<f32>,
    cells_a_metre: f64,
}

impl Hills {
    /// Makes hills. Cells are held within 0.05 and 2 m, wavelengths within 2 cells and half a tile, slopes within 0 and
    /// 60 degrees and amplitudes within 0 and 100 m; numbers that are none count as the default's.
    pub fn new(shape: &HillsShape) -> Hills {
        let shape = sound(shape);
        let mut noise = FastNoiseLite::with_seed((shape.seed ^ (shape.seed >> 32)) as i32);
        noise.set_noise_type(Some(NoiseType::OpenSimplex2));
        noise.set_fractal_type(Some(FractalType::FBm));
        noise.set_fractal_octaves(Some(2));
        noise.set_fractal_gain(Some(0.25));
        noise.set_frequency(Some((1.0 / shape.wavelength_m) as f32));
        let tile = SIDE as f64 * shape.cell_m;
        let raw: Vec<f64> = (0..SIDE * SIDE)
            .map(|i| {
                let (x, z) = ((i % SIDE) as f64 * shape.cell_m, (i / SIDE) as f64 * shape.cell_m);
                seamless(&noise, x, z, tile)
            })
            .collect();
        let scale = match shape.rise {
            Rise::Amplitude(metres) => {
                let (low, high) = raw.iter().fold((0.0f64, 0.0f64), |(l, h), &y| (l.min(y), h.max(y)));
                2.0 * metres / (high - low).max(1e-9)
            }
            Rise::Steepest(degrees) => degrees.to_radians().tan() / steepest(&raw, shape.cell_m).max(1e-9),
        };
        let corners = raw.iter().map(|y| ((y - raw[0]) * scale) as f32).collect();
        Hills { shape, corners, cells_a_metre: 1.0 / shape.cell_m }
    }

    /// What they were made of.
    pub fn shape(&self) -> &HillsShape {
        &self.shape
    }

    /// The height of a corner of the grid, metres.
    pub(crate) fn corner(&self, i: i64, j: i64) -> f64 {
        f64::from(self.corners[wrap(j) * SIDE + wrap(i)])
    }

    /// The height, and the rise over run along x and z, in the triangle of the quad that holds a place: its two
    /// triangles meet in the diagonal from the corner of least x and z.
    pub(crate) fn facet(&self, x: f64, z: f64) -> (f64, DVec2) {
        let (u, v) = (x * self.cells_a_metre, z * self.cells_a_metre);
        let (i, j) = (u.floor(), v.floor());
        let (u, v) = (u - i, v - j);
        let (i, j) = (i as i64, j as i64);
        let (a, d) = (self.corner(i, j), self.corner(i + 1, j + 1));
        let (along_x, along_z) = if u >= v {
            let b = self.corner(i + 1, j);
            (b - a, d - b)
        } else {
            let c = self.corner(i, j + 1);
            (d - c, c - a)
        };
        (a + along_x * u + along_z * v, DVec2::new(along_x, along_z) * self.cells_a_metre)
    }

    pub(crate) fn height(&self, x: f64, z: f64) -> f64 {
        self.facet(x, z).0
    }

    pub(crate) fn under(&self, x: f64, z: f64) -> GroundPoint {
        let (height, gradient) = self.facet(x, z);
        GroundPoint { height, normal: DVec3::new(-gradient.x, 1.0, -gradient.y).normalize() }
    }

    /// The slope of the steepest facet, degrees.
    pub fn steepest_degrees(&self) -> f64 {
        let corners: Vec<f64> = self.corners.iter().map(|&y| f64::from(y)).collect();
        steepest(&corners, self.shape.cell_m).atan().to_degrees()
    }
}

fn wrap(i: i64) -> usize {
    (i & (SIDE as i64 - 1)) as usize
}

fn sound(shape: &HillsShape) -> HillsShape {
    let normal = HillsShape::default();
    let held = |value: f64, otherwise: f64, low: f64, high: f64| {
        if value.is_nan() { otherwise } else { value.clamp(low, high) }
    };
    let cell_m = held(shape.cell_m, normal.cell_m, 0.05, 2.0);
    let half = 0.5 * SIDE as f64 * cell_m;
    HillsShape {
        seed: shape.seed,
        rise: match shape.rise {
            Rise::Amplitude(metres) => Rise::Amplitude(held(metres, 0.5, 0.0, 100.0)),
            Rise::Steepest(degrees) => Rise::Steepest(held(degrees, HillsShape::STEEPEST_DEG, 0.0, 60.0)),
        },
        wavelength_m: held(shape.wavelength_m, normal.wavelength_m, 2.0 * cell_m, half),
        cell_m,
    }
}

/// Noise that repeats: the four tiles that overlap at a place, each by its share, which keeps the variance.
fn seamless(noise: &FastNoiseLite, x: f64, z: f64, tile: f64) -> f64 {
    let (u, v) = (eased(x / tile), eased(z / tile));
    let (mut sum, mut squares) = (0.0, 0.0);
    for (dx, share_x) in [(0.0, 1.0 - u), (tile, u)] {
        for (dz, share_z) in [(0.0, 1.0 - v), (tile, v)] {
            let share = share_x * share_z;
            if share > 0.0 {
                sum += share * f64::from(noise.get_noise_2d(x - dx, z - dz));
                squares += share * share;
            }
        }
    }
    sum / squares.sqrt()
}

/// 0 over most of a tile, and up to 1 at its end, without a kink.
fn eased(t: f64) -> f64 {
    let t = ((t - 0.75) * 4.0).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// Rise over run of the steepest of the triangles.
fn steepest(corners: &[f64], cell_m: f64) -> f64 {
    let at = |i: usize, j: usize| corners[(j % SIDE) * SIDE + i % SIDE];
    let mut most = 0.0f64;
    for j in 0..SIDE {
        for i in 0..SIDE {
            let (a, b, c, d) = (at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1));
            most = most.max((b - a).hypot(d - b)).max((d - c).hypot(c - a));
        }
    }
    most / cell_m
}
