//! Boxes that hold a skin in any pose, without touching its vertices.
//!
//! A vertex goes nearly where its strongest place alone would take it. How far off it is at most has a closed form. Let
//! `t_i` be the distance between where place `i` and the strongest one would take the vertex, `w_i` its weight, `d_i` the
//! product of both real parts; and let the strongest have the weight `w`, the others `s` together. With the vertex's
//! posed place as the origin a dual quaternion's dual part is half its shift times its real part, so the blend is off
//! by no more than `Σ w_i t_i / |b|`, where `|b| ≥ w + Σ w_i d_i` is the length of its real part. That is at most the largest
//! `s t_i / (w + s d_i)`: a bound for each pair of places on its own.

use glam::Vec3;

use crate::{Bounds, Mesh, PALETTE_LEN, Palette};

/// The boxes around a skin at rest, one a place that is some vertex's strongest; bounds any pose.
///
/// Close while joints bend as joints do; where places that share skin are turned against each other by more than about
/// 200°, so that their blend all but cancels out, the skin may leave it.
#[derive(Clone, PartialEq, Debug)]
pub struct SkinBounds(Vec<Owned>);

/// The vertices of which a place is the strongest.
#[derive(Clone, PartialEq, Debug)]
struct Owned {
    place: usize,
    bounds: Bounds,
    partners: Vec<Partner>,
}

/// Another place that has a share in them.
#[derive(Clone, PartialEq, Debug)]
struct Partner {
    place: usize,
    /// About where the two give way to each other, metres.
    middle: Vec3,
    weight: f32,
    /// The most of `s / w` and of `s`, which is `s / (w + s d)` for `d` of 0 and 1.
    share: [f32; 2],
    /// The most of the same times the distance from the middle, metres.
    reach: [f32; 2],
}

/// What rounding may add, metres.
const ROUNDING_M: f32 = 2e-6;
/// The least `w + s d`, over `w`, that is reckoned with.
const CANCELLED: f32 = 0.05;

impl SkinBounds {
    /// Boxes of a mesh's places; places without skin have none.
    pub fn new(mesh: &Mesh) -> SkinBounds {
        let whole = mesh.positions.len().min(mesh.joints.len()).min(mesh.weights.len());
        SkinBounds::of(mesh, 0..whole)
    }

    /// Boxes of some of a mesh's vertices.
    ///
    /// # Panics
    /// A vertex beyond the mesh's last.
    pub fn of(mesh: &Mesh, vertices: impl Iterator<Item = usize> + Clone) -> SkinBounds {
        let mut boxes = Boxes { owned: Vec::new(), number: [None; PALETTE_LEN] };
        vertices.clone().for_each(|vertex| boxes.meet(mesh, vertex));
        for partner in boxes.owned.iter_mut().flat_map(|owned| &mut owned.partners) {
            partner.middle /= partner.weight;
        }
        vertices.for_each(|vertex| boxes.stretch(mesh, vertex));
        SkinBounds(boxes.owned)
    }

    /// Corners of the posed boxes, in the palette's space: their hull holds every posed vertex.
    pub fn corners<'a>(&'a self, palette: &'a Palette) -> impl Iterator<Item = Vec3> + 'a {
        self.0.iter().flat_map(|owned| {
            let (motion, margin) = (palette.motion(owned.place), Vec3::splat(owned.margin(palette)));
            let grown = Bounds { min: owned.bounds.min - margin, max: owned.bounds.max + margin };
            grown.corners().map(|corner| motion.point(corner))
        })
    }

    /// A box that holds every posed vertex, in the palette's space; somewhat larger than the tightest one.
    pub fn posed(&self, palette: &Palette) -> Bounds {
        self.0.iter().fold(Bounds::EMPTY, |all, owned| {
            let motion = palette.motion(owned.place);
            let (middle, turn) = (motion.point(owned.bounds.center()), motion.turn());
            let half = (owned.bounds.max - owned.bounds.min) * 0.5;
            let half = turn.x_axis.abs() * half.x + turn.y_axis.abs() * half.y + turn.z_axis.abs() * half.z;
            let half = half + owned.margin(palette);
            all.with(middle - half).with(middle + half)
        })
    }
}

impl Owned {
    /// How far its vertices may be from where its place alone would take them, metres.
    fn margin(&self, palette: &Palette) -> f32 {
        let own = palette.motion(self.place);
        let margin = |partner: &Partner| {
            let other = palette.motion(partner.place);
            let d: f32 = own.real.dot(other.real);
            // The two turns' difference has this norm, twice the sine of half the angle.
            let apart = 2.0 * (1.0 - d * d).max(0.0).sqrt();
            let shift = own.point(partner.middle).distance(other.point(partner.middle));
            partner.at(partner.reach, d) * apart + partner.at(partner.share, d) * shift
        };
        self.partners.iter().map(margin).fold(0.0, f32::max) + ROUNDING_M
    }
}

impl Partner {
    fn new(place: usize) -> Partner {
        Partner { place, middle: Vec3::ZERO, weight: 0.0, share: [0.0; 2], reach: [0.0; 2] }
    }

    /// The most of something times `s / (w + s d)`, given the same for `d` of 0 and 1.
    fn at(&self, [at_0, at_1]: [f32; 2], d: f32) -> f32 {
        if d >= 0.0 {
            // 1 / (w + s d) is convex in d, so its chord lies above it.
            at_0 + (at_1 - at_0) * d
        } else {
            at_0 / (1.0 + self.share[0] * d).max(CANCELLED)
        }
    }
}

/// Boxes in the making.
struct Boxes {
    owned: Vec<Owned>,
    /// By place, its number among the owners.
    number: [Option<usize>; PALETTE_LEN],
}

impl Boxes {
    /// The boxes of the strongest place of a vertex, that place's weight, and the other places with theirs.
    fn owner(
        &mut self,
        mesh: &Mesh,
        vertex: usize,
    ) -> (&mut Owned, f32, impl Iterator<Item = (usize, f32)> + Clone + use<>) {
        let place = |joint: u8| usize::from(joint).min(PALETTE_LEN - 1);
        let weights = mesh.weights[vertex].map(|weight| f32::from(weight) / 65535.0);
        let parts: [(usize, f32); 4] = std::array::from_fn(|i| (place(mesh.joints[vertex][i]), weights[i]));
        let (own, weight) = parts.into_iter().fold((0, 0.0), |a, b| if b.1 > a.1 { b } else { a });
        let next = self.owned.len();
        let number = *self.number[own].get_or_insert(next);
        if number == next {
            self.owned.push(Owned { place: own, bounds: Bounds::EMPTY, partners: Vec::new() });
        }
        let others = parts.into_iter().filter(move |part| part.0 != own && part.1 > 0.0);
        (&mut self.owned[number], weight, others)
    }

    /// Enters a vertex in the boxes and in the middles of its pairs, which are sums for now.
    fn meet(&mut self, mesh: &Mesh, vertex: usize) {
        let position = Vec3::from_array(mesh.positions[vertex]);
        let (owned, weight, others) = self.owner(mesh, vertex);
        owned.bounds = owned.bounds.with(position);
        for (place, other_weight) in others {
            let partner = owned.partner(place);
            partner.middle += position * (weight * other_weight);
            partner.weight += weight * other_weight;
        }
    }

    /// Stretches its pairs' reaches, once their middles are known.
    fn stretch(&mut self, mesh: &Mesh, vertex: usize) {
        let position = Vec3::from_array(mesh.positions[vertex]);
        let (owned, weight, others) = self.owner(mesh, vertex);
        let rest = others.clone().map(|part| part.1).sum::<f32>();
        for (place, _) in others {
            let partner = owned.partner(place);
            let far = position.distance(partner.middle);
            for (i, share) in [rest / weight, rest / (weight + rest)].into_iter().enumerate() {
                partner.share[i] = partner.share[i].max(share);
                partner.reach[i] = partner.reach[i].max(share * far);
            }
        }
    }
}

impl Owned {
    fn partner(&mut self, place: usize) -> &mut Partner {
        let found = self.partners.iter().position(|partner| partner.place == place);
        let number = found.unwrap_or(self.partners.len());
        if found.is_none() {
            self.partners.push(Partner::new(place));
        }
        &mut self.partners[number]
    }
}
