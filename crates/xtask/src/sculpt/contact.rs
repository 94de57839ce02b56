//! How near the fingers of a posed hand come to each other and to the palm, and how far into each other.

use std::collections::BTreeSet;

use glam::DVec3;
use rig::{Bone, Mesh};

use super::hand::FINGERS;

/// A piece of the left hand's skin.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub enum Piece {
    /// Thumb 0 to little finger 4, beyond the web.
    Finger(usize),
    /// The last segment of a finger.
    Tip(usize),
    /// Everything else, the ball of the thumb included.
    Palm,
}

/// The pieces of a posed left hand.
pub struct Hand<'a> {
    posed: &'a Mesh,
    rest: &'a Mesh,
}

/// A triangle of the posed surface with a ball around it.
struct Facet {
    corners: [DVec3; 3],
    normals: [DVec3; 3],
    /// Which corners lie on the border of the piece.
    border: [bool; 3],
    center: DVec3,
    reach: f64,
}

/// A piece of the posed surface, open where it was cut off.
struct Patch(Vec<Facet>);

impl<'a> Hand<'a> {
    /// A posed skin and the same at rest.
    pub fn new(posed: &'a Mesh, rest: &'a Mesh) -> Hand<'a> {
        Hand { posed, rest }
    }

    fn leader(&self, v: usize) -> Option<Bone> {
        let strongest = (0..4).max_by_key(|&i| self.rest.weights[v][i])?;
        Bone::ALL.get(usize::from(self.rest.joints[v][strongest])).copied()
    }

    /// Which finger a vertex belongs to and which of its bones; the thumb's first lies in the palm.
    fn segment(&self, v: usize) -> Option<(usize, usize)> {
        let bone = self.leader(v)?;
        FINGERS.iter().enumerate().find_map(|(f, bones)| {
            let part = bones.iter().position(|b| *b == bone)?;
            (f > 0 || part > 0).then_some((f, part))
        })
    }

    fn belongs(&self, v: usize, piece: Piece) -> bool {
        let segment = self.segment(v);
        match piece {
            Piece::Finger(f) => segment.is_some_and(|s| s.0 == f),
            Piece::Tip(f) => segment == Some((f, 2)),
            Piece::Palm => {
                segment.is_none()
                    && matches!(self.leader(v), Some(Bone::LeftHand | Bone::LeftThumbMetacarpal))
            }
        }
    }

    /// Whether a finger's vertex may touch others: near the web, neighbours belong together.
    fn free(&self, v: usize) -> bool {
        match self.segment(v) {
            Some((0, part)) => part == 2,
            Some((_, part)) => part > 0,
            None => false,
        }
    }

    /// The skin that a finger may touch: another finger whole, or the palm with the roots of the other fingers.
    fn surface(&self, piece: Piece, seen_by: usize) -> Patch {
        let place = |v: u32| DVec3::from(self.posed.positions[v as usize].map(f64::from));
        let normal = |v: u32| DVec3::from(self.posed.normals[v as usize].map(f64::from));
        let own = |v: u32| match (piece, self.segment(v as usize)) {
            (Piece::Palm, Some((f, part))) => f > 0 && f != seen_by && part == 0,
            _ => self.belongs(v as usize, piece),
        };
        let corners = self.posed.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]);
        let (whole, cut): (Vec<_>, Vec<_>) =
            corners.filter(|t| t.iter().any(|&v| own(v))).partition(|t| t.iter().all(|&v| own(v)));
        let border: BTreeSet<u32> = cut.into_iter().flatten().collect();
        let facet = |t: [u32; 3]| {
            let corners = t.map(place);
            let center = (corners[0] + corners[1] + corners[2]) / 3.0;
            let reach = corners.iter().map(|c| c.distance(center)).fold(0.0, f64::max);
            Facet { corners, normals: t.map(normal), border: t.map(|v| border.contains(&v)), center, reach }
        };
        Patch(whole.into_iter().map(facet).collect())
    }

    /// The vertices of a finger or its tip that may touch others.
    fn points(&self, piece: Piece) -> Vec<DVec3> {
        let own = (0..self.posed.positions.len()).filter(|&v| self.belongs(v, piece) && self.free(v));
        own.map(|v| DVec3::from(self.posed.positions[v].map(f64::from))).collect()
    }

    /// The least distance of a finger or its tip to another or to the palm, metres; below 0 how deep a vertex of one
    /// lies in the other.
    pub fn gap(&self, one: Piece, other: Piece) -> f64 {
        let (a, b) = match (one, other) {
            (Piece::Palm, finger) => return self.gap(finger, Piece::Palm),
            (Piece::Finger(a) | Piece::Tip(a), Piece::Palm) => {
                return self.surface(Piece::Palm, a).nearest(&self.points(one), None);
            }
            (Piece::Finger(a) | Piece::Tip(a), Piece::Finger(b) | Piece::Tip(b)) => (a, b),
        };
        let side = |points: Piece, seen_by: usize, piece: Piece, finger: usize| {
            let whole = self.surface(Piece::Finger(finger), seen_by);
            let part = (piece != Piece::Finger(finger)).then(|| self.surface(piece, seen_by));
            whole.nearest(&self.points(points), part.as_ref())
        };
        side(one, a, other, b).min(side(other, b, one, a))
    }
}

impl Patch {
    /// The least distance of points: to the patch where they lie inside it, else to a part of it, if one is given.
    fn nearest(&self, points: &[DVec3], part: Option<&Patch>) -> f64 {
        let each = points.iter().map(|p| match (self.distance(*p), part) {
            (d, Some(part)) if d > 0.0 => part.distance(*p).abs(),
            (d, _) => d,
        });
        each.fold(f64::MAX, f64::min)
    }

    /// The signed distance to the patch. What is nearest to its border lies outside, and so does what would lie
    /// deeper than a finger is thick.
    fn distance(&self, p: DVec3) -> f64 {
        let (mut nearest, mut signed) = (f64::MAX, f64::MAX);
        for facet in &self.0 {
            if p.distance(facet.center) - facet.reach > nearest {
                continue;
            }
            let shares = nearest_shares(p, facet.corners);
            let sum = |of: &[DVec3; 3]| -> DVec3 { (0..3).map(|i| of[i] * shares[i]).sum() };
            let away = p - sum(&facet.corners);
            if away.length() < nearest {
                nearest = away.length();
                let open = (0..3).all(|i| shares[i] == 0.0 || facet.border[i]);
                let inside = !open && nearest < 0.009 && away.dot(sum(&facet.normals)) < 0.0;
                signed = if inside { -nearest } else { nearest };
            }
        }
        signed
    }
}

/// The nearest place of a triangle as shares of its corners (Ericson, Real-Time Collision Detection, 5.1.5).
fn nearest_shares(p: DVec3, [a, b, c]: [DVec3; 3]) -> [f64; 3] {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let (d1, d2) = (ab.dot(ap), ac.dot(ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return [1.0, 0.0, 0.0];
    }
    let bp = p - b;
    let (d3, d4) = (ab.dot(bp), ac.dot(bp));
    if d3 >= 0.0 && d4 <= d3 {
        return [0.0, 1.0, 0.0];
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let v = d1 / (d1 - d3);
        return [1.0 - v, v, 0.0];
    }
    let cp = p - c;
    let (d5, d6) = (ab.dot(cp), ac.dot(cp));
    if d6 >= 0.0 && d5 <= d6 {
        return [0.0, 0.0, 1.0];
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let w = d2 / (d2 - d6);
        return [1.0 - w, 0.0, w];
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return [0.0, 1.0 - w, w];
    }
    let all = va + vb + vc;
    [va / all, vb / all, vc / all]
}
