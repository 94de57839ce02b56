//! Dual quaternions: rigid motions whose weighted sum is a rigid motion again. Source: `dqs`.

use glam::{DQuat, DVec3, Mat3, Vec3, Vec3A, Vec4};

/// A dual quaternion of any length: that of a rigid motion times a factor, which doesn't matter to what it does.
///
/// Both parts are `x, y, z, w`. Where the real part has no length it does nothing useful, but stays finite.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) struct DualQuaternion {
    pub real: Vec4,
    pub dual: Vec4,
}

/// The square of a length below which a sum has cancelled out; keeps the division finite.
const NOTHING: f32 = 1e-30;

impl DualQuaternion {
    /// The sum of nothing.
    pub const ZERO: DualQuaternion = DualQuaternion { real: Vec4::ZERO, dual: Vec4::ZERO };

    /// The unit one that turns about a point and takes that point somewhere else, metres: half of `to q - q from`, written out.
    pub fn rigid(turn: DQuat, from: DVec3, to: DVec3) -> DualQuaternion {
        let about = turn.xyz();
        let dual = 0.5 * ((to - from) * turn.w + (to + from).cross(about));
        let dual_w = 0.5 * (from - to).dot(about);
        let part = |v: DVec3, w: f64| v.as_vec3().extend(w as f32);
        DualQuaternion { real: part(about, turn.w), dual: part(dual, dual_w) }
    }

    #[inline]
    pub fn from_rows([real, dual]: [[f32; 4]; 2]) -> DualQuaternion {
        DualQuaternion { real: Vec4::from_array(real), dual: Vec4::from_array(dual) }
    }

    pub fn to_rows(self) -> [[f32; 4]; 2] {
        [self.real.to_array(), self.dual.to_array()]
    }

    /// This one and another times a weight.
    #[inline]
    pub fn plus(self, other: DualQuaternion, weight: f32) -> DualQuaternion {
        DualQuaternion { real: self.real + other.real * weight, dual: self.dual + other.dual * weight }
    }

    /// Twice the reciprocal of the squared length, so that no root is drawn.
    #[inline]
    fn scale(self) -> f32 {
        2.0 / self.real.length_squared().max(NOTHING)
    }

    /// Where a point goes: `p + 2 (r × (r × p + w p + d) + w d - d_w r) / |q|²`. A motion that does nothing keeps
    /// every bit.
    #[inline]
    pub fn point(self, point: Vec3) -> Vec3 {
        let (r, d, p) = (Vec3A::from_vec4(self.real), Vec3A::from_vec4(self.dual), Vec3A::from(point));
        let (w, dual_w) = (self.real.w, self.dual.w);
        let moved = r.cross(r.cross(p) + p * w + d) + d * w - r * dual_w;
        (p + moved * self.scale()).into()
    }

    /// Where a direction turns; as long as it was, to rounding.
    #[inline]
    pub fn vector(self, vector: Vec3) -> Vec3 {
        let (r, v) = (Vec3A::from_vec4(self.real), Vec3A::from(vector));
        (v + r.cross(r.cross(v) + v * self.real.w) * self.scale()).into()
    }

    /// The turn as a matrix.
    pub fn turn(self) -> Mat3 {
        Mat3::from_cols_array_2d(&[Vec3::X, Vec3::Y, Vec3::Z].map(|axis| self.vector(axis).to_array()))
    }
}
