//! The smallest of a quadratic in four variables between straight bounds.

/// Four numbers that change together.
pub(crate) type Step = [f64; 4];

/// The most bounds that a step can have.
pub(crate) const BOUNDS: usize = 7;

/// Bounds `slope . step <= room`; what is pushed beyond [`BOUNDS`] is left out.
#[derive(Default)]
pub(crate) struct Bounds {
    slopes: [Step; BOUNDS],
    rooms: [f64; BOUNDS],
    count: usize,
}

impl Bounds {
    pub fn push(&mut self, slope: Step, room: f64) {
        if self.count < BOUNDS {
            (self.slopes[self.count], self.rooms[self.count]) = (slope, room);
            self.count += 1;
        }
    }
}

/// The step within the bounds that makes `step . matrix . step / 2 - pull . step` smallest; the matrix is positive.
/// Where no step is within all bounds, some step.
///
/// Sweeps over the bounds' multipliers find out which bounds hold the step, then a linear system says how
/// hard. Source: `hildreth`.
pub(crate) fn bounded_step(matrix: &[Step; 4], pull: Step, bounds: &Bounds) -> Step {
    let factors = Factors::new(matrix);
    let mut step = factors.solve(pull);
    let mut away = [[0.0; 4]; BOUNDS];
    let mut dual = Dual { count: bounds.count, over: [0.0; BOUNDS], stiff: [[0.0; BOUNDS]; BOUNDS] };
    for (i, away) in away.iter_mut().enumerate().take(bounds.count) {
        *away = factors.solve(bounds.slopes[i]);
        dual.over[i] = dot(&bounds.slopes[i], &step) - bounds.rooms[i];
        for j in 0..=i {
            let stiff = dot(&bounds.slopes[j], away);
            (dual.stiff[i][j], dual.stiff[j][i]) = (stiff, stiff);
        }
    }
    for (push, away) in dual.pushes().iter().zip(&away) {
        (0..4).for_each(|k| step[k] -= push * away[k]);
    }
    step
}

fn dot(a: &Step, b: &Step) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]
}

/// How hard each bound has to push back: `over - stiff * push <= 0` and `push >= 0`, and one of both is 0.
struct Dual {
    count: usize,
    over: [f64; BOUNDS],
    stiff: [[f64; BOUNDS]; BOUNDS],
}

impl Dual {
    fn pushes(&self) -> [f64; BOUNDS] {
        let mut pushes = [0.0; BOUNDS];
        for _ in 0..TRIES {
            for _ in 0..SWEEPS {
                for i in (0..self.count).filter(|i| self.stiff[*i][*i] > 1e-12) {
                    pushes[i] = (pushes[i] + self.left(i, &pushes) / self.stiff[i][i]).max(0.0);
                }
            }
            if let Some(exact) = self.exact(&pushes) {
                return exact;
            }
        }
        pushes
    }

    /// How far a bound is still passed.
    fn left(&self, i: usize, pushes: &[f64; BOUNDS]) -> f64 {
        self.over[i] - (0..self.count).map(|j| self.stiff[i][j] * pushes[j]).sum::<f64>()
    }

    /// The pushes if those that push by now, four at most, are the right ones.
    fn exact(&self, pushes: &[f64; BOUNDS]) -> Option<[f64; BOUNDS]> {
        let (mut active, mut n) = ([0; 4], 0);
        for i in (0..self.count).filter(|i| pushes[*i] > 0.0) {
            *active.get_mut(n)? = i;
            n += 1;
        }
        let mut matrix = [[0.0; 4]; 4];
        let mut over = [0.0; 4];
        for i in 0..4 {
            matrix[i][i] = 1.0;
            if i < n {
                (0..n).for_each(|j| matrix[i][j] = self.stiff[active[i]][active[j]]);
                over[i] = self.over[active[i]];
            }
        }
        let solved = Factors::new(&matrix).solve(over);
        let mut found = [0.0; BOUNDS];
        (0..n).for_each(|k| found[active[k]] = solved[k]);
        let held = (0..self.count).all(|i| self.left(i, &found) <= 1e-10);
        (held && solved.iter().all(|push| *push >= 0.0)).then_some(found)
    }
}

/// A positive matrix as L Lt.
struct Factors([Step; 4]);

impl Factors {
    fn new(matrix: &[Step; 4]) -> Factors {
        let mut l = [[0.0; 4]; 4];
        for i in 0..4 {
            for j in 0..=i {
                let rest = matrix[i][j] - (0..j).map(|k| l[i][k] * l[j][k]).sum::<f64>();
                l[i][j] = if i == j { rest.max(f64::MIN_POSITIVE).sqrt() } else { rest / l[j][j] };
            }
        }
        Factors(l)
    }

    fn solve(&self, mut b: Step) -> Step {
        let l = &self.0;
        for i in 0..4 {
            b[i] = (b[i] - (0..i).map(|k| l[i][k] * b[k]).sum::<f64>()) / l[i][i];
        }
        for i in (0..4).rev() {
            b[i] = (b[i] - (i + 1..4).map(|k| l[k][i] * b[k]).sum::<f64>()) / l[i][i];
        }
        b
    }
}

/// Sweeps between two guesses of which bounds push, and guesses.
const SWEEPS: usize = 8;
const TRIES: usize = 8;

#[cfg(test)]
mod tests {
    use super::{Bounds, bounded_step};

    const MATRIX: [[f64; 4]; 4] =
        [[2.0, 0.3, 0.0, 0.1], [0.3, 1.0, 0.2, 0.0], [0.0, 0.2, 1e-4, 0.0], [0.1, 0.0, 0.0, 0.5]];

    fn worth(step: [f64; 4], pull: [f64; 4]) -> f64 {
        let turned = MATRIX.map(|row| super::dot(&row, &step));
        0.5 * super::dot(&step, &turned) - super::dot(&step, &pull)
    }

    #[test]
    fn no_step_within_the_bounds_is_better() {
        let mut matrix = MATRIX;
        matrix[2][2] = 0.05;
        let pull = [1.0, -2.0, 0.7, 0.3];
        let bounds = [([1.0, 1.0, 0.0, 0.0], 0.1), ([0.0, -1.0, 0.5, 0.2], 0.3), ([0.0, 0.0, 1.0, 0.0], 0.4)];
        let mut all = Bounds::default();
        bounds.iter().for_each(|(slope, room)| all.push(*slope, *room));
        let worth = |step: [f64; 4]| worth(step, pull) + 0.5 * (0.05 - 1e-4) * step[2] * step[2];
        let inside = |step: &[f64; 4], slack: f64| {
            bounds.iter().all(|(slope, room)| super::dot(slope, step) <= room + slack)
        };
        let best = bounded_step(&matrix, pull, &all);
        assert!(inside(&best, 1e-9), "{best:?}");
        for case in 0..10_000 {
            let near =
                std::array::from_fn(|i| best[i] + 0.3 * (f64::from(case * (7 + 5 * i as i32)) * 0.618).sin());
            assert!(!inside(&near, 0.0) || worth(near) >= worth(best) - 1e-9, "{near:?} beats {best:?}");
        }
    }
}
