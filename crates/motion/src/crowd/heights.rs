//! Heights of a piece of ground in a table, for thousands of lookups.

use crate::Ground;

/// Heights over a square, single precision, straight within each triangle of the grid; outside, those of the border.
#[derive(Clone, PartialEq, Debug)]
pub struct Heights {
    /// Corners a side.
    side: usize,
    /// Cells a metre.
    per_metre: f32,
    /// Metres from the middle to the border.
    half: f32,
    rows: Vec<f32>,
}

impl Heights {
    /// Takes the heights of a ground over a square of `half_m` metres to each side of the origin, `cell_m` apart.
    pub fn of(ground: &Ground, half_m: f32, cell_m: f32) -> Heights {
        Heights::from_fn(|x, z| ground.under(x, z).height, half_m, cell_m)
    }

    /// The same of any height for `x` and `z`, metres.
    pub fn from_fn(height: impl Fn(f64, f64) -> f64, half_m: f32, cell_m: f32) -> Heights {
        let side = ((2.0 * half_m / cell_m).ceil() as usize).clamp(1, 4096) + 1;
        let cell = 2.0 * f64::from(half_m) / (side - 1) as f64;
        let at = |i: usize| i as f64 * cell - f64::from(half_m);
        let rows = (0..side * side).map(|i| height(at(i % side), at(i / side)) as f32).collect();
        Heights { side, per_metre: (1.0 / cell) as f32, half: half_m, rows }
    }

    /// Metres from the middle to the border.
    pub fn half(&self) -> f32 {
        self.half
    }

    /// Height and its rise a metre along x and along z.
    #[inline(always)]
    pub fn at(&self, x: f32, z: f32) -> [f32; 3] {
        let last = (self.side - 1) as f32;
        // `max` before `min` sends what is not a number to a border.
        let across = ((x + self.half) * self.per_metre).max(0.0).min(last - 1e-3);
        let along = ((z + self.half) * self.per_metre).max(0.0).min(last - 1e-3);
        let (i, j) = (across as usize, along as usize);
        let (u, v) = (across - i as f32, along - j as f32);
        let corner = (j * self.side + i).min(self.rows.len().saturating_sub(self.side + 2));
        let quad = &self.rows[corner..corner + self.side + 2];
        let (a, b, c, d) = (quad[0], quad[1], quad[self.side], quad[self.side + 1]);
        // Two triangles: the diagonal goes from a to d.
        let (along_x, along_z) = if u >= v { (b - a, d - b) } else { (d - c, c - a) };
        [a + u * along_x + v * along_z, along_x * self.per_metre, along_z * self.per_metre]
    }
}
