//! Smooth curves through a few values: over a cycle that closes, or over a span that rests at its ends.

/// How densely a curve is tabulated.
const STEPS: usize = 1500;
/// Standard deviation of the bell that rounds the corners off, as a fraction of the whole.
const ROUNDING: f64 = 0.012;
/// The same for what is lowered.
const EASING: f64 = 0.013;

/// A value over a phase, 0 to 1: monotone between its keys, with a rate that nowhere jumps.
#[derive(Clone, Debug)]
pub struct Curve {
    /// Values at even phases from 0; of a cycle the last is one step short of 1.
    table: Vec<f64>,
    cyclic: bool,
}

impl Curve {
    /// The same value always.
    pub fn constant(value: f64) -> Curve {
        Curve { table: vec![value; 4], cyclic: true }
    }

    /// A closed cycle through keys of phase (0 to 1, rising) and value.
    pub fn cyclic(keys: &[(f64, f64)]) -> Curve {
        let around: Vec<(f64, f64)> =
            [-1.0, 0.0, 1.0].iter().flat_map(|turn| keys.iter().map(move |k| (k.0 + turn, k.1))).collect();
        let rough: Vec<f64> = (0..STEPS).map(|i| through(&around, i as f64 / STEPS as f64)).collect();
        let table = rounded(STEPS, ROUNDING, |i| rough[i.rem_euclid(STEPS as i64) as usize]);
        Curve { table, cyclic: true }
    }

    /// A span through keys of phase and value that stays at its ends' values beyond them.
    pub fn open(keys: &[(f64, f64)]) -> Curve {
        let last = STEPS as i64;
        let rough: Vec<f64> = (0..=STEPS).map(|i| through(keys, i as f64 / STEPS as f64)).collect();
        let table = rounded(STEPS + 1, 2.0 * ROUNDING, |i| rough[i.clamp(0, last) as usize]);
        Curve { table, cyclic: false }
    }

    /// A mean and waves: how often in a cycle, how high, and the phase of the first crest.
    pub fn waves(mean: f64, waves: &[(f64, f64, f64)]) -> Curve {
        let value = |phase: f64| {
            let each = |&(times, height, crest): &(f64, f64, f64)| {
                height * (std::f64::consts::TAU * times * (phase - crest)).cos()
            };
            mean + waves.iter().map(each).sum::<f64>()
        };
        Curve { table: (0..STEPS).map(|i| value(i as f64 / STEPS as f64)).collect(), cyclic: true }
    }

    /// The same, ahead by a part of the cycle and times a factor.
    pub fn shifted(&self, ahead: f64, factor: f64) -> Curve {
        let value = |i: usize| factor * self.at(i as f64 / STEPS as f64 + ahead);
        Curve { table: (0..STEPS).map(value).collect(), cyclic: true }
    }

    /// The cycle lowered, at least as far as asked at every phase, and no more abruptly than it has to be.
    pub fn lowered(&self, least: impl Fn(f64) -> f64) -> Curve {
        let count = STEPS as i64;
        let phase = |i: i64| i as f64 / STEPS as f64;
        let asked: Vec<f64> = (0..count).map(|i| least(phase(i))).collect();
        let reach = (3.0 * EASING * STEPS as f64).ceil() as i64;
        let at = |i: i64| asked[i.rem_euclid(count) as usize];
        // As wide a plateau as the bell that rounds it: nowhere lower than what was asked.
        let held: Vec<f64> =
            (0..count).map(|i| (-reach..=reach).map(|o| at(i + o)).fold(f64::MIN, f64::max)).collect();
        let drop = rounded(STEPS, EASING, |i| held[i.rem_euclid(count) as usize]);
        Curve { table: (0..count).map(|i| self.at(phase(i)) - drop[i as usize]).collect(), cyclic: true }
    }

    /// The value at a phase; cycles repeat.
    pub fn at(&self, phase: f64) -> f64 {
        let count = self.table.len();
        if self.cyclic {
            let place = phase.rem_euclid(1.0) * count as f64;
            let (index, part) = (place.floor(), place.fract());
            let value = |offset: i64| self.table[(index as i64 + offset).rem_euclid(count as i64) as usize];
            hermite(part, [value(-1), value(0), value(1), value(2)])
        } else {
            let place = phase.clamp(0.0, 1.0) * (count - 1) as f64;
            let (index, part) = (place.floor(), place.fract());
            let value = |offset: i64| self.table[(index as i64 + offset).clamp(0, count as i64 - 1) as usize];
            hermite(part, [value(-1), value(0), value(1), value(2)])
        }
    }
}

/// Between the middle two of four even values.
fn hermite(part: f64, [before, from, to, after]: [f64; 4]) -> f64 {
    let (leave, arrive) = ((to - before) / 2.0, (after - from) / 2.0);
    let (p2, p3) = (part * part, part * part * part);
    from * (2.0 * p3 - 3.0 * p2 + 1.0)
        + leave * (p3 - 2.0 * p2 + part)
        + to * (3.0 * p2 - 2.0 * p3)
        + arrive * (p3 - p2)
}

/// Each value as the mean of its neighbours under a bell.
fn rounded(count: usize, deviation: f64, value: impl Fn(i64) -> f64) -> Vec<f64> {
    let deviation = deviation * STEPS as f64;
    let reach = (3.0 * deviation).ceil() as i64;
    let bell = |offset: i64| (-0.5 * (offset as f64 / deviation).powi(2)).exp();
    let whole: f64 = (-reach..=reach).map(bell).sum();
    (0..count as i64).map(|i| (-reach..=reach).map(|o| bell(o) * value(i + o)).sum::<f64>() / whole).collect()
}

/// A monotone cubic through keys (Fritsch and Carlson's limits on the rates, in Butland's form).
fn through(keys: &[(f64, f64)], at: f64) -> f64 {
    let next = keys.partition_point(|key| key.0 <= at).clamp(1, keys.len() - 1);
    let (from, to) = (keys[next - 1], keys[next]);
    let width = to.0 - from.0;
    let part = ((at - from.0) / width).clamp(0.0, 1.0);
    let (leave, arrive) = (rate(keys, next - 1) * width, rate(keys, next) * width);
    let (p2, p3) = (part * part, part * part * part);
    from.1 * (2.0 * p3 - 3.0 * p2 + 1.0)
        + leave * (p3 - 2.0 * p2 + part)
        + to.1 * (3.0 * p2 - 2.0 * p3)
        + arrive * (p3 - p2)
}

fn rate(keys: &[(f64, f64)], index: usize) -> f64 {
    if index == 0 || index + 1 == keys.len() {
        return 0.0;
    }
    let slope = |i: usize| (keys[i + 1].1 - keys[i].1) / (keys[i + 1].0 - keys[i].0);
    let (before, after) = (slope(index - 1), slope(index));
    if before * after <= 0.0 {
        return 0.0;
    }
    let (left, right) = (keys[index].0 - keys[index - 1].0, keys[index + 1].0 - keys[index].0);
    let (first, second) = (2.0 * right + left, right + 2.0 * left);
    (first + second) / (first / before + second / after)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_flat_stretch_between_equal_keys_stays_flat_but_for_its_rounded_ends() {
        let curve = Curve::cyclic(&[(0.0, 20.0), (0.2, 0.0), (0.6, 0.0), (0.8, -30.0)]);
        for i in 24..=56 {
            assert!(curve.at(i as f64 / 100.0).abs() < 1e-9, "at {i} %");
        }
        assert!((curve.at(0.999_999) - curve.at(0.0)).abs() < 1e-3);
    }

    #[test]
    fn waves_have_their_crests_where_they_are_said_to() {
        let curve = Curve::waves(1.0, &[(2.0, 0.5, 0.3)]);
        assert!((curve.at(0.3) - 1.5).abs() < 1e-5 && (curve.at(0.05) - 0.5).abs() < 1e-5);
    }
}
