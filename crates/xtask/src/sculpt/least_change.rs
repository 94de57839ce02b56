//! The least and smoothest change of shares that does what is asked of them, by conjugate gradients.

use rig::Bone;

use super::rings::Rings;
use super::weights::Shares;

/// What one triangle asks: the sum over its parts of slope times change is to be `short`.
pub struct Row {
    /// Vertices, bones and slopes, of length 1 altogether.
    pub parts: Vec<(u32, Bone, f64)>,
    /// How much is asked for.
    pub short: f64,
}

/// How much a change itself weighs, over that: the change fades over some rings, the reciprocal of its root.
const SMALL: f64 = 0.06;
/// Rings around what asks that may change.
const AROUND: usize = 24;
/// Steps of the solver.
const STEPS: usize = 40;

/// The vertices that may change, numbered anew, and the bones that take part.
struct Free {
    vertices: Vec<u32>,
    /// By vertex of the mesh, the place in `vertices`.
    slots: Vec<u32>,
    bones: Vec<Bone>,
    channels: [usize; Bone::COUNT],
}

impl Free {
    fn new(rows: &[Row], rings: &Rings, held: &[bool]) -> Free {
        let mut bones: Vec<Bone> = rows.iter().flat_map(|r| r.parts.iter().map(|p| p.1)).collect();
        bones.sort_unstable();
        bones.dedup();
        let mut channels = [usize::MAX; Bone::COUNT];
        bones.iter().enumerate().for_each(|(i, b)| channels[b.index()] = i);
        let mut slots = vec![u32::MAX; held.len()];
        let mut vertices: Vec<u32> = Vec::new();
        let mut meet = |v: u32, vertices: &mut Vec<u32>| {
            if slots[v as usize] == u32::MAX && !held[v as usize] {
                slots[v as usize] = vertices.len() as u32;
                vertices.push(v);
            }
        };
        rows.iter().flat_map(|r| &r.parts).for_each(|p| meet(p.0, &mut vertices));
        let mut from = 0;
        for _ in 0..AROUND {
            let to = vertices.len();
            for i in from..to {
                for &w in rings.around(vertices[i] as usize) {
                    meet(w, &mut vertices);
                }
            }
            from = to;
        }
        Free { vertices, slots, bones, channels }
    }
}

/// The change, by vertex: `smooth` is how much a difference between neighbours weighs against what is asked.
pub fn least_change(rows: &[Row], rings: &Rings, held: &[bool], smooth: f64) -> Vec<(usize, Shares)> {
    let free = Free::new(rows, rings, held);
    let width = free.bones.len();
    let may = |v: &u32| free.bones.iter().map(|b| rings.may_follow(*v as usize, *b)).collect::<Vec<bool>>();
    let open: Vec<bool> = free.vertices.iter().flat_map(may).collect();
    let x = free.solve(rows, rings, &open, smooth);
    let row = |(slot, &v): (usize, &u32)| {
        let mut change = [0.0; Bone::COUNT];
        free.bones.iter().enumerate().for_each(|(c, b)| change[b.index()] = x[slot * width + c]);
        (v as usize, change)
    };
    free.vertices.iter().enumerate().map(row).collect()
}

impl Free {
    /// The change of each vertex's shares of each bone where that is open.
    fn solve(&self, rows: &[Row], rings: &Rings, open: &[bool], smooth: f64) -> Vec<f64> {
        let width = self.bones.len();
        let place = |&(v, bone, slope): &(u32, Bone, f64)| {
            let slot = self.slots[v as usize];
            let at = slot as usize * width + self.channels[bone.index()];
            (slot != u32::MAX && open[at]).then_some((at, slope))
        };
        let places: Vec<Vec<(usize, f64)>> =
            rows.iter().map(|row| row.parts.iter().filter_map(place).collect()).collect();
        let mut ask = vec![0.0; open.len()];
        for (row, parts) in rows.iter().zip(&places) {
            parts.iter().for_each(|(i, slope)| ask[*i] += slope * row.short);
        }
        let weigh = |x: &[f64]| {
            let mut y = self.unevenness(x, rings, open, smooth);
            for parts in &places {
                let sum: f64 = parts.iter().map(|(i, slope)| slope * x[*i]).sum();
                parts.iter().for_each(|(i, slope)| y[*i] += slope * sum);
            }
            y
        };
        conjugate_gradients(weigh, ask)
    }

    /// How much each change differs from those around, and a little of itself; where it isn't open, nothing.
    fn unevenness(&self, x: &[f64], rings: &Rings, open: &[bool], smooth: f64) -> Vec<f64> {
        let width = self.bones.len();
        let mut y = vec![0.0; x.len()];
        for (slot, &v) in self.vertices.iter().enumerate() {
            let at = slot * width..(slot + 1) * width;
            let ring = rings.around(v as usize);
            let own = smooth * (ring.len() as f64 + SMALL);
            y[at.clone()].iter_mut().zip(&x[at.clone()]).for_each(|(y, x)| *y = own * x);
            for &w in ring {
                let other = self.slots[w as usize] as usize;
                if let Some(theirs) = x.get(other * width..(other + 1) * width) {
                    y[at.clone()].iter_mut().zip(theirs).for_each(|(y, x)| *y -= smooth * x);
                }
            }
            y[at.clone()].iter_mut().zip(&open[at]).filter(|(_, open)| !**open).for_each(|(y, _)| *y = 0.0);
        }
        y
    }
}

/// An approximate solution of `apply(x) = ask`.
fn conjugate_gradients(apply: impl Fn(&[f64]) -> Vec<f64>, ask: Vec<f64>) -> Vec<f64> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let mut x = vec![0.0; ask.len()];
    let mut rest = ask;
    let mut along = rest.clone();
    let mut square = dot(&rest, &rest);
    let enough = square * 1e-6;
    for _ in 0..STEPS {
        if square <= enough {
            break;
        }
        let image = apply(&along);
        let step = square / dot(&along, &image).max(1e-300);
        x.iter_mut().zip(&along).for_each(|(x, a)| *x += step * a);
        rest.iter_mut().zip(&image).for_each(|(r, i)| *r -= step * i);
        let next = dot(&rest, &rest);
        let part = next / square.max(1e-300);
        along.iter_mut().zip(&rest).for_each(|(a, r)| *a = r + part * *a);
        square = next;
    }
    x
}
