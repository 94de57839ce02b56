//! A smooth curve through rows of numbers, as a sculptor gives sections along a limb.

/// Rows of `N` numbers over a rising parameter, joined by cubics without overshoot at the turning points.
#[derive(Clone, Debug)]
pub struct Curve<const N: usize> {
    at: Vec<f64>,
    rows: Vec<[f64; N]>,
    slopes: Vec<[f64; N]>,
}

impl<const N: usize> Curve<N> {
    /// A curve through rows in rising order of their parameter; needs at least two.
    pub fn new(knots: &[(f64, [f64; N])]) -> Curve<N> {
        let at: Vec<f64> = knots.iter().map(|k| k.0).collect();
        let rows: Vec<[f64; N]> = knots.iter().map(|k| k.1).collect();
        assert!(
            at.len() >= 2 && at.windows(2).all(|w| w[0] < w[1]),
            "sections must be in rising order: {at:?}"
        );
        let slopes = (0..at.len()).map(|i| std::array::from_fn(|c| slope(&at, |j| rows[j][c], i))).collect();
        Curve { at, rows, slopes }
    }

    /// A curve whose bend changes without jumps, too (a natural spline); it may overshoot where rows jump.
    pub fn flowing(knots: &[(f64, [f64; N])]) -> Curve<N> {
        let mut curve = Curve::new(knots);
        let n = curve.at.len();
        // Slopes m with h1 m0 + 2 (h0 + h1) m1 + h0 m2 = 3 (h1 s0 + h0 s1), and no bend at both ends.
        let h = |i: usize| curve.at[i + 1] - curve.at[i];
        let secant = |i: usize, c: usize| (curve.rows[i + 1][c] - curve.rows[i][c]) / h(i);
        let mut above = vec![0.5; n];
        let mut right = vec![[0.0; N]; n];
        right[0] = std::array::from_fn(|c| 1.5 * secant(0, c));
        for i in 1..n {
            let last = i == n - 1;
            let (low, middle, high) =
                if last { (1.0, 2.0, 0.0) } else { (h(i), 2.0 * (h(i - 1) + h(i)), h(i - 1)) };
            let pivot = middle - low * above[i - 1];
            let want = |c: usize| {
                if last {
                    3.0 * secant(i - 1, c)
                } else {
                    3.0 * (h(i) * secant(i - 1, c) + h(i - 1) * secant(i, c))
                }
            };
            right[i] = std::array::from_fn(|c| (want(c) - low * right[i - 1][c]) / pivot);
            above[i] = high / pivot;
        }
        for i in (0..n - 1).rev() {
            right[i] = std::array::from_fn(|c| right[i][c] - above[i] * right[i + 1][c]);
        }
        curve.slopes = right;
        curve
    }

    /// The first and last parameter.
    pub fn ends(&self) -> (f64, f64) {
        (self.at[0], self.at[self.at.len() - 1])
    }

    /// The given rows.
    pub fn rows(&self) -> impl Iterator<Item = (f64, &[f64; N])> {
        self.at.iter().copied().zip(&self.rows)
    }

    /// The row at a parameter; the end rows beyond the ends.
    pub fn sample(&self, t: f64) -> [f64; N] {
        let last = self.at.len() - 1;
        if t <= self.at[0] {
            return self.rows[0];
        }
        if t >= self.at[last] {
            return self.rows[last];
        }
        let i = self.at.partition_point(|&a| a <= t) - 1;
        let span = self.at[i + 1] - self.at[i];
        let s = (t - self.at[i]) / span;
        let (s2, s3) = (s * s, s * s * s);
        let (h0, h1) = (2.0 * s3 - 3.0 * s2 + 1.0, 3.0 * s2 - 2.0 * s3);
        let (g0, g1) = ((s3 - 2.0 * s2 + s) * span, (s3 - s2) * span);
        std::array::from_fn(|c| {
            h0 * self.rows[i][c]
                + h1 * self.rows[i + 1][c]
                + g0 * self.slopes[i][c]
                + g1 * self.slopes[i + 1][c]
        })
    }
}

/// The slope at a knot: the mean of its sides weighted by nearness, at most three times the flatter one.
fn slope(at: &[f64], value: impl Fn(usize) -> f64, i: usize) -> f64 {
    let secant = |j: usize| (value(j + 1) - value(j)) / (at[j + 1] - at[j]);
    if i == 0 {
        return secant(0);
    }
    if i == at.len() - 1 {
        return secant(i - 1);
    }
    let (before, after) = (secant(i - 1), secant(i));
    if before * after <= 0.0 {
        return 0.0;
    }
    let (w0, w1) = (at[i] - at[i - 1], at[i + 1] - at[i]);
    let mean = (before * w1 + after * w0) / (w0 + w1);
    let limit = 3.0 * before.abs().min(after.abs());
    mean.clamp(-limit, limit)
}
