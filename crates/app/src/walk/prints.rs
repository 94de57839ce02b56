//! Footprints: what soles stood on, kept for a while.

use std::collections::VecDeque;

use glam::{DVec2, DVec3};
use motion::FootView;
use rig::Side;

/// So many are kept.
const MOST: usize = 48;
/// A foot that stands again within so far of its last print has not stepped, metres.
const SAME_M: f64 = 0.03;
/// What of a sole is so far above the ground juts out over an edge, metres.
const OVER_M: f64 = 0.03;

/// Where a sole stood.
#[derive(Clone, PartialEq, Debug)]
pub struct Print {
    /// Whose foot.
    pub side: Side,
    /// Its outline on the ground, counter-clockwise from above, metres, world.
    pub outline: Vec<DVec3>,
}

/// The last prints, the oldest first.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Prints {
    all: VecDeque<Print>,
    /// Whether each foot stood at the last step.
    stood: [bool; 2],
}

impl Prints {
    /// All of them, the oldest first, each with how fresh it is: 1 the newest, toward 0 the oldest.
    pub fn all(&self) -> impl Iterator<Item = (&Print, f64)> {
        let count = self.all.len().max(1) as f64;
        self.all.iter().enumerate().map(move |(i, print)| (print, (i + 1) as f64 / count))
    }

    /// Takes note of a foot: one that has come to stand leaves a print.
    pub fn take(&mut self, side: Side, foot: &FootView) {
        let stood = std::mem::replace(&mut self.stood[side as usize], foot.stance);
        if !foot.stance || stood {
            return;
        }
        let grounded = foot.sole_in_world.iter().zip(&foot.ground_under_sole);
        // Beyond an edge the print is where the sole is.
        let height = |point: &DVec3, ground: f64| if point.y > ground + OVER_M { point.y } else { ground };
        let points = grounded.map(|(point, ground)| DVec3 { y: height(point, *ground), ..*point });
        let outline = outline(points.collect());
        if outline.len() < 3 || !outline.iter().all(|point| point.is_finite()) {
            return;
        }
        let last = self.all.iter().rev().find(|print| print.side == side);
        if last.is_some_and(|last| middle(&last.outline).distance(middle(&outline)) < SAME_M) {
            return;
        }
        self.all.push_back(Print { side, outline });
        if self.all.len() > MOST {
            self.all.pop_front();
        }
    }
}

fn middle(points: &[DVec3]) -> DVec3 {
    points.iter().sum::<DVec3>() / points.len().max(1) as f64
}

/// An outline with its corners rounded off, for drawing.
pub fn rounded(outline: &[DVec3]) -> Vec<DVec3> {
    let cut = |points: &[DVec3]| -> Vec<DVec3> {
        let next = points.iter().cycle().skip(1);
        points.iter().zip(next).flat_map(|(a, b)| [a.lerp(*b, 0.25), a.lerp(*b, 0.75)]).collect()
    };
    cut(&cut(outline))
}

/// The corners of what encloses points seen from above, counter-clockwise about +Y.
fn outline(mut points: Vec<DVec3>) -> Vec<DVec3> {
    let flat = |p: &DVec3| DVec2::new(p.z, p.x);
    points.sort_by(|a, b| a.z.total_cmp(&b.z).then(a.x.total_cmp(&b.x)));
    let half = |points: &mut dyn Iterator<Item = &DVec3>| {
        let mut chain: Vec<DVec3> = Vec::new();
        for point in points {
            while let [.., a, b] = chain[..] {
                if (flat(&b) - flat(&a)).perp_dot(flat(point) - flat(&b)) > 1e-12 {
                    break;
                }
                chain.pop();
            }
            chain.push(*point);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter());
    hull.extend(half(&mut points.iter().rev()));
    hull
}

#[cfg(test)]
mod tests {
    use super::*;

    fn foot(stance: bool, z: f64) -> FootView {
        let sole_in_world: Vec<DVec3> = [(-0.04, 0.0), (0.04, 0.0), (0.0, 0.1), (0.05, 0.2), (-0.05, 0.2)]
            .map(|(x, along)| DVec3::new(x, 0.11, z + along))
            .into();
        let ground_under_sole = vec![0.1; sole_in_world.len()];
        FootView { stance, sole_in_world, ground_under_sole, ..FootView::default() }
    }

    #[test]
    fn a_foot_that_comes_to_stand_leaves_one_print_on_the_ground() {
        let mut prints = Prints::default();
        for stance in [false, true, true, true] {
            prints.take(Side::Left, &foot(stance, 1.0));
        }
        let [(print, fresh)] = prints.all().collect::<Vec<_>>()[..] else { panic!("{prints:?}") };
        assert_eq!(
            (print.side, fresh, print.outline.len()),
            (Side::Left, 1.0, 4),
            "the point within is no corner"
        );
        assert!(print.outline.iter().all(|point| point.y == 0.1));
        prints.take(Side::Left, &foot(false, 1.0));
        prints.take(Side::Left, &foot(true, 1.01));
        assert_eq!(prints.all().count(), 1, "it has not stepped");
        for i in 0..200 {
            prints.take(Side::Left, &foot(false, 0.0));
            prints.take(Side::Left, &foot(true, f64::from(i)));
        }
        assert_eq!(prints.all().count(), MOST);
    }

    #[test]
    fn a_foot_without_a_sole_leaves_none() {
        let mut prints = Prints::default();
        let bare = FootView { stance: true, ..FootView::default() };
        prints.take(Side::Right, &bare);
        let mut bad = foot(true, 0.0);
        bad.ground_under_sole[0] = f64::NAN;
        prints.take(Side::Left, &bad);
        assert_eq!(prints.all().count(), 0);
    }
}
