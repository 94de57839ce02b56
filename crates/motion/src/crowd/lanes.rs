//! Numbers, vectors and turns of many figures abreast: one lane a figure.

use std::ops::{Add, Mul, Neg, Sub};

use pulp::Simd;

/// Figures in a block: as many as the widest registers hold. Narrower ones take a block in parts.
pub const LANES: usize = 16;

/// One number of each figure in a block.
#[derive(Clone, Copy, PartialEq, Debug, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(C, align(64))]
pub struct Row(pub [f32; LANES]);

impl Row {
    /// The same number for all.
    pub const fn all(value: f32) -> Row {
        Row([value; LANES])
    }

    /// The numbers of one part of the block.
    #[inline(always)]
    pub fn get<S: Simd>(&self, simd: S, part: usize) -> Num<S> {
        Num { simd, lanes: S::as_simd_f32s(&self.0).0[part] }
    }

    /// Sets the numbers of one part.
    #[inline(always)]
    pub fn set<S: Simd>(&mut self, part: usize, value: Num<S>) {
        S::as_mut_simd_f32s(&mut self.0).0[part] = value.lanes;
    }
}

/// One number a lane.
#[derive(Clone, Copy)]
pub struct Num<S: Simd> {
    simd: S,
    lanes: S::f32s,
}

impl<S: Simd> Num<S> {
    /// The same number in all lanes.
    #[inline(always)]
    pub fn all(simd: S, value: f32) -> Num<S> {
        Num { simd, lanes: simd.splat_f32s(value) }
    }

    #[inline(always)]
    pub fn over(self, other: Num<S>) -> Num<S> {
        Num { lanes: self.simd.div_f32s(self.lanes, other.lanes), ..self }
    }

    /// One over the square root; of a millionth for 0.
    #[inline(always)]
    pub fn inverse_sqrt(self) -> Num<S> {
        let simd = self.simd;
        Num::all(simd, 1.0).over(self.max(Num::all(simd, 1e-12)).sqrt())
    }

    #[inline(always)]
    pub fn sqrt(self) -> Num<S> {
        Num { lanes: self.simd.sqrt_f32s(self.lanes), ..self }
    }

    #[inline(always)]
    pub fn min(self, other: Num<S>) -> Num<S> {
        Num { lanes: self.simd.min_f32s(self.lanes, other.lanes), ..self }
    }

    #[inline(always)]
    pub fn max(self, other: Num<S>) -> Num<S> {
        Num { lanes: self.simd.max_f32s(self.lanes, other.lanes), ..self }
    }
}

// No fused multiply-add: the same bits on every processor.
impl<S: Simd> Add for Num<S> {
    type Output = Num<S>;
    #[inline(always)]
    fn add(self, other: Num<S>) -> Num<S> {
        Num { lanes: self.simd.add_f32s(self.lanes, other.lanes), ..self }
    }
}

impl<S: Simd> Sub for Num<S> {
    type Output = Num<S>;
    #[inline(always)]
    fn sub(self, other: Num<S>) -> Num<S> {
        Num { lanes: self.simd.sub_f32s(self.lanes, other.lanes), ..self }
    }
}

impl<S: Simd> Mul for Num<S> {
    type Output = Num<S>;
    #[inline(always)]
    fn mul(self, other: Num<S>) -> Num<S> {
        Num { lanes: self.simd.mul_f32s(self.lanes, other.lanes), ..self }
    }
}

impl<S: Simd> Neg for Num<S> {
    type Output = Num<S>;
    #[inline(always)]
    fn neg(self) -> Num<S> {
        Num { lanes: self.simd.neg_f32s(self.lanes), ..self }
    }
}

/// A vector a lane.
#[derive(Clone, Copy)]
pub struct Vector<S: Simd> {
    pub x: Num<S>,
    pub y: Num<S>,
    pub z: Num<S>,
}

impl<S: Simd> Vector<S> {
    /// The same vector in all lanes.
    #[inline(always)]
    pub fn all(simd: S, [x, y, z]: [f32; 3]) -> Vector<S> {
        Vector { x: Num::all(simd, x), y: Num::all(simd, y), z: Num::all(simd, z) }
    }

    /// The vectors of one part of a block.
    #[inline(always)]
    pub fn get(simd: S, rows: &[Row; 3], part: usize) -> Vector<S> {
        Vector { x: rows[0].get(simd, part), y: rows[1].get(simd, part), z: rows[2].get(simd, part) }
    }

    #[inline(always)]
    pub fn dot(self, other: Vector<S>) -> Num<S> {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub fn cross(self, other: Vector<S>) -> Vector<S> {
        Vector {
            x: self.y * other.z - self.z * other.y,
            y: self.z * other.x - self.x * other.z,
            z: self.x * other.y - self.y * other.x,
        }
    }

    #[inline(always)]
    pub fn times(self, by: Num<S>) -> Vector<S> {
        Vector { x: self.x * by, y: self.y * by, z: self.z * by }
    }

    #[inline(always)]
    pub fn plus(self, other: Vector<S>) -> Vector<S> {
        Vector { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }

    #[inline(always)]
    pub fn minus(self, other: Vector<S>) -> Vector<S> {
        Vector { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

/// A unit quaternion a lane.
#[derive(Clone, Copy)]
pub struct Turn<S: Simd> {
    pub v: Vector<S>,
    pub w: Num<S>,
}

impl<S: Simd> Turn<S> {
    /// The turns of one part of a block.
    #[inline(always)]
    pub fn get(simd: S, rows: &[Row; 4], part: usize) -> Turn<S> {
        let [x, y, z, w] = rows;
        let v = Vector { x: x.get(simd, part), y: y.get(simd, part), z: z.get(simd, part) };
        Turn { v, w: w.get(simd, part) }
    }

    /// Writes the turns of one part.
    #[inline(always)]
    pub fn set(self, rows: &mut [Row; 4], part: usize) {
        rows[0].set(part, self.v.x);
        rows[1].set(part, self.v.y);
        rows[2].set(part, self.v.z);
        rows[3].set(part, self.w);
    }

    /// First `inner`, then this one.
    #[inline(always)]
    pub fn after(self, inner: Turn<S>) -> Turn<S> {
        let v = inner.v.times(self.w).plus(self.v.times(inner.w)).plus(self.v.cross(inner.v));
        Turn { v, w: self.w * inner.w - self.v.dot(inner.v) }
    }

    /// The turn back.
    #[inline(always)]
    pub fn inverse(self) -> Turn<S> {
        Turn { v: Vector { x: -self.v.x, y: -self.v.y, z: -self.v.z }, w: self.w }
    }

    /// Turns a vector.
    #[inline(always)]
    pub fn of(self, vector: Vector<S>) -> Vector<S> {
        let twice = self.v.cross(vector);
        let twice = twice.plus(twice);
        vector.plus(twice.times(self.w)).plus(self.v.cross(twice))
    }

    /// The shortest turn between two unit vectors that are not opposite.
    #[inline(always)]
    pub fn arc(simd: S, from: Vector<S>, to: Vector<S>) -> Turn<S> {
        let w = Num::all(simd, 1.0) + from.dot(to);
        Turn { v: from.cross(to), w }.unit()
    }

    /// Made a unit quaternion.
    #[inline(always)]
    pub fn unit(self) -> Turn<S> {
        let scale = (self.v.dot(self.v) + self.w * self.w).inverse_sqrt();
        Turn { v: self.v.times(scale), w: self.w * scale }
    }

    /// The three columns of its matrix.
    #[inline(always)]
    pub fn columns(self, simd: S) -> [Vector<S>; 3] {
        let one = Num::all(simd, 1.0);
        let Turn { v: Vector { x, y, z }, w } = self;
        let (x2, y2, z2) = (x + x, y + y, z + z);
        let (xx, yy, zz) = (x * x2, y * y2, z * z2);
        let (xy, xz, yz) = (x * y2, x * z2, y * z2);
        let (wx, wy, wz) = (w * x2, w * y2, w * z2);
        [
            Vector { x: one - (yy + zz), y: xy + wz, z: xz - wy },
            Vector { x: xy - wz, y: one - (xx + zz), z: yz + wx },
            Vector { x: xz + wy, y: yz - wx, z: one - (xx + yy) },
        ]
    }
}
