//! Who walks near whom: people in a crowd go round each other.

/// Others nearer than this matter, metres; also the side of a cell.
const NEAR_M: f32 = 1.6;
/// Middles of bodies nearer than this move apart, metres.
const BODY_M: f32 = 0.62;
/// How fast they do, over how much too near they are, 1/s.
const APART_PER_SEC: f32 = 1.6;
/// How fast a walker turns to go round others, radians a second at most.
const ROUND_RAD_PER_SEC: f32 = 1.4;
/// The share of its speed that a walker loses behind another.
const SLOWER: f32 = 0.5;

/// Places of everyone on one ground, sorted into a grid of cells. Of one moment, for everyone's next step, so that it does
/// not matter who steps first.
#[derive(Clone, Debug, Default)]
pub struct Company {
    /// Cells a side.
    side: usize,
    half: f32,
    /// Where each cell's places begin, and the end of all.
    starts: Vec<usize>,
    places: Vec<[f32; 2]>,
}

/// What the others make of a walker's step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Nudge {
    /// Radians a second, to the left.
    pub turn: f32,
    /// Share of its speed.
    pub pace: f32,
    /// Metres a second.
    pub shift: [f32; 2],
}

impl Nudge {
    /// Alone.
    pub const NONE: Nudge = Nudge { turn: 0.0, pace: 1.0, shift: [0.0; 2] };
}

impl Company {
    /// Everyone on a square of `half_m` metres to each side of the origin; places as x and z, metres, world. Those beyond
    /// the border are sorted into its cells.
    pub fn of(places: impl IntoIterator<Item = [f32; 2]>, half_m: f32) -> Company {
        let half = half_m.clamp(NEAR_M, 2048.0);
        let side = (2.0 * half / NEAR_M).ceil() as usize;
        let mut company = Company { side, half, starts: vec![0; side * side + 1], places: Vec::new() };
        let mut sorted: Vec<(usize, [f32; 2])> = places
            .into_iter()
            .map(|place| (company.cell(place[0]) + side * company.cell(place[1]), place))
            .collect();
        sorted.sort_by_key(|(cell, _)| *cell);
        for (cell, _) in &sorted {
            company.starts[cell + 1] += 1;
        }
        for cell in 0..side * side {
            company.starts[cell + 1] += company.starts[cell];
        }
        company.places = sorted.into_iter().map(|(_, place)| place).collect();
        company
    }

    fn cell(&self, along: f32) -> usize {
        // What is not a number is in the first cell.
        (((along + self.half) / NEAR_M) as usize).min(self.side - 1)
    }

    fn around(&self, at: [f32; 2]) -> impl Iterator<Item = [f32; 2]> {
        let [i, j] = if self.side == 0 { [0, 0] } else { at.map(|along| self.cell(along)) };
        let rows = j.saturating_sub(1)..(j + 2).min(self.side);
        rows.flat_map(move |row| {
            let first = row * self.side + i.saturating_sub(1);
            let last = row * self.side + (i + 2).min(self.side);
            self.places[self.starts[first]..self.starts[last]].iter().copied()
        })
    }

    /// What the others make of the step of a walker with that heading, radians. Itself is where it is and doesn't count.
    pub(super) fn nudge(&self, at: [f32; 2], heading: f32) -> Nudge {
        let (sine, cosine) = heading.sin_cos();
        let mut nudge = Nudge::NONE;
        let mut slow = 0.0_f32;
        for other in self.around(at) {
            let [x, z] = [other[0] - at[0], other[1] - at[1]];
            let distance = x.hypot(z);
            if !(1e-4..NEAR_M).contains(&distance) {
                continue;
            }
            let ahead = (x * sine + z * cosine) / distance;
            let left = x * cosine - z * sine;
            if ahead > 0.2 {
                nudge.turn -= ahead * (1.0 - distance / NEAR_M) * 2.0_f32.copysign(left);
            }
            if ahead > 0.7 {
                slow = slow.max(((1.1 - distance) / 0.5).clamp(0.0, 1.0));
            }
            let apart = (BODY_M - distance).max(0.0) * APART_PER_SEC / distance;
            nudge.shift = [nudge.shift[0] - x * apart, nudge.shift[1] - z * apart];
        }
        nudge.turn = nudge.turn.clamp(-ROUND_RAD_PER_SEC, ROUND_RAD_PER_SEC);
        nudge.pace = 1.0 - SLOWER * slow;
        nudge
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn who_comes_up_from_the_left_is_passed_on_the_right() {
        let company = Company::of([[0.0, 0.0], [0.2, 0.9], [50.0, 3.0], [f32::NAN, 0.0]], 20.0);
        let nudge = company.nudge([0.0, 0.0], 0.0);
        assert!(nudge.turn < -0.3 && nudge.pace < 0.9, "{nudge:?}");
        assert_eq!(nudge.shift, [0.0; 2], "not so near as to be pushed");
        let away = company.nudge([0.0, 0.0], std::f32::consts::PI);
        assert_eq!((away.turn, away.pace), (0.0, 1.0), "nobody is ahead");
    }

    #[test]
    fn neighbours_are_found_across_cells_and_beyond_the_border() {
        let at: Vec<[f32; 2]> =
            (0..400).map(|i| [(i % 20) as f32 * 0.9 - 9.0, (i / 20) as f32 * 0.9 - 9.0]).collect();
        let company = Company::of(at.iter().copied(), 8.0);
        for place in &at {
            let near = |other: &[f32; 2]| (other[0] - place[0]).hypot(other[1] - place[1]) < NEAR_M;
            // Beyond the border cells are larger than they seem, so more than the near ones may be found.
            let (found, there) =
                (company.around(*place).filter(near).count(), at.iter().filter(|o| near(o)).count());
            assert_eq!(found, there, "around {place:?}");
        }
        assert_eq!(Company::default().around([0.0, 0.0]).count(), 0);
    }
}
