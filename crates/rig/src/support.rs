//! What a figure stands on: the outline of its soles on the ground, and where its centre of mass is over it.

use glam::{DVec2, DVec3};

use crate::{Figure, Frames, Limb, Pose};

/// The support polygon and the centre of mass over it; metres, world, the ground being y = 0.
#[derive(Clone, PartialEq, Debug)]
pub struct Support {
    /// The convex outline of the soles on the ground, anticlockwise seen from above; three corners or more.
    pub outline: Vec<DVec3>,
    /// The centre of mass brought straight down to the ground.
    pub center: DVec3,
    /// How far inside the outline that is; negative outside.
    pub margin_m: f64,
    /// From the centre to the nearest place on the outline, metres; level.
    pub to_edge: DVec3,
}

/// Where a figure that does not stand falls, in its own words.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[allow(missing_docs)]
pub enum Falls {
    Forward,
    Backward,
    Left,
    Right,
}

impl Support {
    /// Whether the figure could stand so.
    pub fn is_balanced(&self) -> bool {
        self.margin_m >= 0.0
    }

    /// Where the figure falls, as it faces itself; `None` if it is balanced.
    pub fn falls(&self, pose: &Pose) -> Option<Falls> {
        let away = pose.place.world_from_figure().rotation.conjugate() * -self.to_edge;
        let sideways = away.x.abs() > away.z.abs();
        (!self.is_balanced()).then_some(match (sideways, away.x > 0.0, away.z > 0.0) {
            (true, true, _) => Falls::Left,
            (true, false, _) => Falls::Right,
            (false, _, true) => Falls::Forward,
            (false, _, false) => Falls::Backward,
        })
    }
}

/// What the soles that are on the ground make. A foot counts with those of heel, ball and toe tip that are less than
/// 3 cm above y = 0. `None` where none is, or the figure names no such points.
pub fn support(figure: &Figure, frames: &Frames, center_of_mass: DVec3) -> Option<Support> {
    let soles = [Limb::LeftLeg, Limb::RightLeg].map(|leg| sole(figure, frames, leg));
    let outline = convex(soles.into_iter().flatten().map(|point| DVec2::new(point.x, point.z)).collect());
    if outline.len() < 3 || !center_of_mass.is_finite() {
        return None;
    }
    let center = DVec2::new(center_of_mass.x, center_of_mass.z);
    let (margin_m, edge) = margin(&outline, center);
    let ground = |p: DVec2| DVec3::new(p.x, 0.0, p.y);
    Some(Support {
        outline: outline.into_iter().map(ground).collect(),
        center: ground(center),
        margin_m,
        to_edge: ground(edge - center),
    })
}

/// How far above the ground a sole still bears, metres.
const BEARS_M: f64 = 0.03;

/// Half of a foot's width at heel, ball and toe tip, as shares of its length from heel to toe tip.
const HALF_WIDTHS: [(&str, f64); 3] = [("heel", 0.13), ("ball", 0.19), ("toeTip", 0.14)];

/// The corners of a foot's sole that bear, world.
fn sole(figure: &Figure, frames: &Frames, leg: Limb) -> Vec<DVec3> {
    let named = |name: &str| {
        let at = figure.articulators[leg.index()].get(name)?;
        figure.skeleton.joint(at.bone).map(|_| frames[at.bone].point(at.at))
    };
    let rest = |name: &str| {
        let at = figure.articulators[leg.index()].get(name)?;
        Some(figure.skeleton.rest_position(at.bone) + at.at)
    };
    let (Some(heel), Some(toe)) = (rest("heel"), rest("toeTip")) else { return Vec::new() };
    let length = heel.distance(toe);
    let across = frames[leg.parts().end].rotation * DVec3::X;
    let corners = |(name, half): (&str, f64)| {
        let point = named(name)?;
        Some([-1.0, 1.0].map(|side| point + across * (side * half * length)))
    };
    HALF_WIDTHS.into_iter().filter_map(corners).flatten().filter(|corner| corner.y < BEARS_M).collect()
}

/// The convex hull, anticlockwise about y seen from above with z down the page: Andrew's chain. Points that are not
/// finite are left out.
fn convex(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.retain(|p| p.is_finite());
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    points.dedup();
    let chain = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for point in points {
            while let [.., a, b] = chain.as_slice()
                && (*b - *a).perp_dot(point - *b) >= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let mut hull = chain(&mut points.iter().copied());
    hull.extend(chain(&mut points.iter().rev().copied()));
    hull
}

/// How far inside an outline a point is, and the nearest place on it.
fn margin(outline: &[DVec2], point: DVec2) -> (f64, DVec2) {
    let mut inside = true;
    let mut best = (f64::INFINITY, point);
    for (i, &from) in outline.iter().enumerate() {
        let to = outline[(i + 1) % outline.len()];
        let edge = to - from;
        let along = ((point - from).dot(edge) / edge.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let nearest = from + edge * along;
        inside &= edge.perp_dot(point - from) <= 0.0;
        if nearest.distance(point) < best.0 {
            best = (nearest.distance(point), nearest);
        }
    }
    (if inside { best.0 } else { -best.0 }, best.1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_square_and_its_margins() {
        let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0), (1.0, 1.0), (1.0, 0.0)];
        let outline = convex(corners.map(|(x, y)| DVec2::new(x, y)).to_vec());
        assert_eq!(outline.len(), 4, "{outline:?}");
        let at = |x, y| margin(&outline, DVec2::new(x, y));
        assert_eq!(at(1.0, 0.5), (0.5, DVec2::new(1.0, 0.0)));
        assert_eq!(at(3.0, 1.0), (-1.0, DVec2::new(2.0, 1.0)));
        assert_eq!(at(2.0, 1.0).0, 0.0);
        assert!((at(5.0, 6.0).0 + 5.0).abs() < 1e-12);
        // Seen from above, x to the right and z toward the viewer: anticlockwise.
        let area: f64 = (0..4).map(|i| outline[i].perp_dot(outline[(i + 1) % 4])).sum();
        assert!(area < 0.0);
    }

    #[test]
    fn points_without_area_have_no_inside() {
        assert!(convex(vec![DVec2::ZERO; 5]).len() < 3);
        assert!(convex(vec![DVec2::NAN, DVec2::ONE]).len() < 3);
        let line = (0..5).map(|i| DVec2::splat(f64::from(i))).collect();
        assert!(convex(line).len() < 3);
    }
}
