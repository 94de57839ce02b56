//! Boxes that hold a skin in any pose, without touching its vertices.
//!
//! Let `w_i` be a vertex's weights, `x_i` where its places would take it, `r_i` the real parts of their dual quaternions.
//! The linear blend `Σ w_i x_i` lies in the hull of the `x_i`, so boxes around each place's vertices hold it. What dual
//! quaternions make of the vertex is no farther from that than `σ √(V / (1 - V))`, with the variances
//! `σ² = Σ w_i w_j |x_i - x_j|²` and `V = Σ w_i w_j |r_i - r_j|²` over pairs: with `x = Σ w_i x_i` as the origin, `b = Σ w_i r_i`
//! and `r_i b* / |b|² = c_i + u_i` the blend is `Σ w_i (c_i x_i + x_i × u_i)`, `Σ w_i c_i = 1`, and Cauchy's inequality does
//! the rest. For two equal weights this is the height of the arc over its chord.

use glam::Vec3;

use crate::dual_quaternion::DualQuaternion;
use crate::{Bounds, Mesh, PALETTE_LEN, Palette};

/// The boxes around a skin at rest, one a place; bounds any pose.
///
/// Close while joints bend as joints do. Where places that share skin are turned so far against each other that
/// their blend all but cancels out, beyond 300° for two, the skin may leave it.
#[derive(Clone, PartialEq, Debug)]
pub struct SkinBounds {
    boxes: Vec<(usize, Bounds)>,
    mixtures: Vec<Mixture>,
}

/// The vertices that the same places share.
#[derive(Clone, PartialEq, Debug)]
struct Mixture {
    /// In ascending order, then zeros.
    places: [u8; 4],
    count: usize,
    /// About where they give way to each other, metres.
    middle: Vec3,
    /// By pair, see [`PAIRS`]: the most of the product of both weights.
    share: [f32; 6],
    /// By pair: the most of the root of that times the distance from the middle, metres.
    reach: [f32; 6],
    /// The most of the sum of all pairs' products.
    total: f32,
}

/// The pairs of four, those of the first few first.
const PAIRS: [[usize; 2]; 6] = [[0, 1], [0, 2], [1, 2], [0, 3], [1, 3], [2, 3]];
/// What rounding may add, metres.
const ROUNDING_M: f32 = 2e-6;
/// The greatest variance of real parts that is reckoned with; at 1 they cancel out.
const CANCELLED: f32 = 0.95;

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
        let mut boxes = [Bounds::EMPTY; PALETTE_LEN];
        let mut mixtures: Vec<Mixture> = Vec::new();
        let mut numbers = Vec::new();
        for vertex in vertices.clone() {
            let at = Vec3::from_array(mesh.positions[vertex]);
            let (parts, count) = parts(mesh, vertex);
            for (place, _) in &parts[..count] {
                boxes[usize::from(*place)] = boxes[usize::from(*place)].with(at);
            }
            // Neighbours in the mesh are mostly of the same mixture.
            let places = parts.map(|part| part.0);
            let found =
                mixtures.iter().rposition(|mixture| mixture.places == places && mixture.count == count);
            let number = found.unwrap_or(mixtures.len());
            if found.is_none() {
                mixtures.push(Mixture::new(places, count));
            }
            mixtures[number].meet(at, &parts);
            numbers.push(number);
        }
        mixtures.iter_mut().for_each(|mixture| mixture.middle /= mixture.total.max(f32::MIN_POSITIVE));
        mixtures.iter_mut().for_each(|mixture| mixture.total = 0.0);
        for (vertex, number) in vertices.zip(numbers) {
            mixtures[number].stretch(Vec3::from_array(mesh.positions[vertex]), &parts(mesh, vertex).0);
        }
        mixtures.retain(|mixture| mixture.count > 1);
        let boxes = boxes.into_iter().enumerate().filter(|(_, bounds)| !bounds.is_empty()).collect();
        SkinBounds { boxes, mixtures }
    }

    /// Corners of the posed boxes, in the palette's space: their hull holds every posed vertex.
    pub fn corners<'a>(&'a self, palette: &'a Palette) -> impl Iterator<Item = Vec3> + 'a {
        let margins = self.margins(palette);
        self.boxes.iter().flat_map(move |&(place, bounds)| {
            let (motion, margin) = (palette.motion(place), Vec3::splat(margins[place]));
            let grown = Bounds { min: bounds.min - margin, max: bounds.max + margin };
            grown.corners().map(|corner| motion.point(corner))
        })
    }

    /// A box that holds every posed vertex, in the palette's space; somewhat larger than the tightest one.
    pub fn posed(&self, palette: &Palette) -> Bounds {
        let margins = self.margins(palette);
        self.boxes.iter().fold(Bounds::EMPTY, |all, &(place, bounds)| {
            let motion = palette.motion(place);
            let (middle, turn) = (motion.point(bounds.center()), motion.turn());
            let half = (bounds.max - bounds.min) * 0.5;
            let half = turn.x_axis.abs() * half.x + turn.y_axis.abs() * half.y + turn.z_axis.abs() * half.z;
            let half = half + margins[place];
            all.with(middle - half).with(middle + half)
        })
    }

    /// By place, how far the skin may leave the hull of its boxes, metres. It leaves a mixture's hull by no more than
    /// the mixture's margin, so each of the mixture's boxes grows by that.
    fn margins(&self, palette: &Palette) -> [f32; PALETTE_LEN] {
        let mut margins = [ROUNDING_M; PALETTE_LEN];
        for mixture in &self.mixtures {
            let margin = mixture.margin(palette) + ROUNDING_M;
            for place in &mixture.places[..mixture.count] {
                let least = &mut margins[usize::from(*place)];
                *least = least.max(margin);
            }
        }
        margins
    }
}

/// The places of a vertex and their weights, in ascending order of places; how many there are.
fn parts(mesh: &Mesh, vertex: usize) -> ([(u8, f32); 4], usize) {
    let (mut parts, mut count) = ([(0, 0.0); 4], 0);
    for (place, weight) in mesh.joints[vertex].into_iter().zip(mesh.weights[vertex]) {
        if weight > 0 {
            parts[count] = (place.min(PALETTE_LEN as u8 - 1), f32::from(weight) / 65535.0);
            count += 1;
        }
    }
    parts[..count].sort_by_key(|part| part.0);
    (parts, count)
}

impl Mixture {
    fn new(places: [u8; 4], count: usize) -> Mixture {
        Mixture { places, count, middle: Vec3::ZERO, share: [0.0; 6], reach: [0.0; 6], total: 0.0 }
    }

    /// Adds a vertex to the middle, which is a sum for now.
    fn meet(&mut self, at: Vec3, parts: &[(u8, f32); 4]) {
        let product: f32 = PAIRS.iter().map(|[i, j]| parts[*i].1 * parts[*j].1).sum();
        self.middle += at * product;
        self.total += product;
    }

    /// Stretches the reaches to a vertex, once the middle is known.
    fn stretch(&mut self, at: Vec3, parts: &[(u8, f32); 4]) {
        let products = PAIRS.map(|[i, j]| parts[i].1 * parts[j].1);
        let far = at.distance(self.middle);
        for (k, product) in products.into_iter().enumerate() {
            self.share[k] = self.share[k].max(product);
            self.reach[k] = self.reach[k].max(product.sqrt() * far);
        }
        self.total = self.total.max(products.iter().sum());
    }

    /// How far its vertices may be from their linear blend, metres.
    fn margin(&self, palette: &Palette) -> f32 {
        let motions: [DualQuaternion; 4] = self.places.map(|place| palette.motion(usize::from(place)));
        let middles = motions.map(|motion| motion.point(self.middle));
        let (mut spread, mut variance, mut farthest) = (0.0_f32, 0.0_f32, 0.0_f32);
        for (k, [i, j]) in PAIRS.into_iter().enumerate().take(self.count * (self.count - 1) / 2) {
            let apart = motions[i].real.distance_squared(motions[j].real);
            // Twice the sine of half the angle between both turns, the norm of their matrices' difference.
            let turned = (apart * (4.0 - apart)).max(0.0).sqrt();
            let off = self.reach[k] * turned + self.share[k].sqrt() * middles[i].distance(middles[j]);
            spread += off * off;
            variance += self.share[k] * apart;
            farthest = farthest.max(apart);
        }
        let variance = variance.min(self.total * farthest).min(CANCELLED);
        (spread * variance / (1.0 - variance)).sqrt()
    }
}
