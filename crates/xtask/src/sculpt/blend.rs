//! Soft minimum and maximum of distances, and easing: polynomials only, so that every machine gives the same bits.

/// Stands for "far away" where a shape plays no part; finite, so that differences stay numbers.
pub const FAR: f64 = 1e3;

/// The smaller distance, rounded off where the two differ by less than `k` metres.
pub fn soft_min(a: f64, b: f64, k: f64) -> f64 {
    if k <= 0.0 {
        return a.min(b);
    }
    let h = (k - (a - b).abs()).max(0.0) / k;
    a.min(b) - h * h * h * k * (1.0 / 6.0)
}

/// The larger distance, rounded off where the two differ by less than `k` metres.
pub fn soft_max(a: f64, b: f64, k: f64) -> f64 {
    -soft_min(-a, -b, k)
}

/// 0 below `from`, 1 above `to`, smooth in between; `from` may be the larger one.
pub fn ease(from: f64, to: f64, x: f64) -> f64 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// From `a` at 0 to `b` at 1.
pub fn mix(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}
