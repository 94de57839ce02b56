//! Parts of the skin: which bone has each piece of it, with sharp borders.
//!
//! A bone has the skin where its weight is the greatest. Weights are linear over a triangle, so the border between two
//! bones is a straight cut through it: triangles that more than one bone shares are cut there, once, and every piece
//! belongs to one bone as a whole. Nothing is decided or mixed pixel by pixel.

use bytemuck::{Pod, Zeroable};
use glam::Vec3;
use rig::{Bone, Mesh, bone_of_place};

/// What else a vertex of a cut skin has; `PartVertex` in skin.wgsl's followers.
#[derive(Clone, Copy, PartialEq, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct PartVertex {
    /// Number of the part (bone + 1), tone of its wood, axis of its grain (0 x, 1 y), 0.
    pub part: [u8; 4],
    /// How far the nearest border is along the skin, metres, roughly; 0 on it, at most [`FAR_M`].
    pub border_m: f32,
}

/// The layout of that buffer.
pub(crate) const PART_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<PartVertex>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![5 => Uint8x4, 6 => Float32],
};

/// Borders farther off than this are not measured.
const FAR_M: f32 = 0.05;

/// The colour of a bone's skin in [`crate::Pass::Parts`]: that of its number in the colour map of PASCAL VOC, as used
/// for labelled pictures. The number is the bone's place in [`Bone::ALL`] plus 1; 0, the background, is black.
///
/// Bit 0 of the number is the highest bit of red, bit 1 of green, bit 2 of blue; bits 3 to 5 are the next lower ones.
pub fn part_color(bone: Bone) -> [u8; 3] {
    let number = bone.index() as u8 + 1;
    std::array::from_fn(|channel| {
        let bit = |place: usize| (number >> (place + channel)) & 1;
        bit(0) << 7 | bit(3) << 6
    })
}

/// The bone whose colour that is, if it is any bone's.
pub fn part_of_color(color: [u8; 3]) -> Option<Bone> {
    Bone::ALL.into_iter().find(|&bone| part_color(bone) == color)
}

/// A skin cut along the borders of its parts.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cut {
    pub mesh: Mesh,
    pub parts: Vec<PartVertex>,
}

/// The weights of a vertex by part, at most one entry a bone.
type Shares = Vec<(u8, f32)>;

/// A corner of a piece: shares of the triangle's three corners.
type Corner = [f32; 3];

/// A triangle to cut: its vertices in ascending order.
struct Whole {
    triangle: [u32; 3],
    /// Whether that order turns it over.
    flipped: bool,
    /// How far the border of its block is at its cuts.
    border_m: f32,
}

fn least(values: [f32; 3]) -> f32 {
    values.into_iter().fold(FAR_M, f32::min)
}

impl Cut {
    /// Cuts a mesh without faults.
    pub fn new(mesh: &Mesh) -> Cut {
        let shares: Vec<Shares> =
            mesh.joints.iter().zip(&mesh.weights).map(|(j, w)| shares_of(*j, *w)).collect();
        let own: Vec<u8> = shares.iter().map(|s| strongest(s)).collect();
        let borders = border_distances(mesh, &shares, &own);
        let parts =
            own.iter().zip(&borders).map(|(&part, &border_m)| PartVertex::of(part, border_m)).collect();
        let mut cut = Cut { mesh: Mesh { indices: Vec::new(), ..mesh.clone() }, parts };
        for t in mesh.indices.chunks_exact(3) {
            let t = [t[0], t[1], t[2]];
            let [a, b, c] = t.map(|i| own[i as usize]);
            if a == b && b == c {
                cut.mesh.indices.extend(t);
            } else {
                cut.pieces(mesh, t, &shares, &own);
            }
        }
        cut
    }

    /// Adds the pieces of a triangle that several bones share.
    fn pieces(&mut self, mesh: &Mesh, triangle: [u32; 3], shares: &[Shares], own: &[u8]) {
        let [a, b, c] = triangle.map(|i| block(own[i as usize]));
        let far = if a == b && b == c { triangle.map(|i| self.parts[i as usize].border_m) } else { [0.0; 3] };
        // Always cut in the same order, so that neighbours have the same corners on their common edge.
        let (sorted, flipped) = sorted(triangle);
        let of = sorted.map(|i| &shares[i as usize]);
        let mut all: Vec<u8> = of.iter().flat_map(|s| s.iter().map(|&(part, _)| part)).collect();
        all.sort_unstable();
        all.dedup();
        for &part in &all {
            let mut piece: Vec<Corner> = vec![[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
            for &other in all.iter().filter(|&&other| other != part) {
                let ahead = of.map(|s| share(s, part) - share(s, other));
                if ahead.iter().all(|&d| d == 0.0) && other < part {
                    piece.clear();
                }
                piece = clipped(&piece, ahead);
            }
            if piece.len() >= 3 {
                let whole = Whole { triangle: sorted, flipped, border_m: least(far) };
                self.add_piece(mesh, &whole, own, part, &piece);
            }
        }
    }

    fn add_piece(&mut self, mesh: &Mesh, whole: &Whole, own: &[u8], part: u8, piece: &[Corner]) {
        let corners: Vec<u32> = piece
            .iter()
            .map(|corner| {
                let kept = corner.iter().position(|&s| s == 1.0).map(|i| whole.triangle[i]);
                match kept.filter(|&i| own[i as usize] == part) {
                    Some(i) => i,
                    None => self.add_vertex(mesh, whole, part, *corner),
                }
            })
            .collect();
        for i in 1..corners.len() - 1 {
            let [a, b, c] = [corners[0], corners[i], corners[i + 1]];
            self.mesh.indices.extend(if whole.flipped { [a, c, b] } else { [a, b, c] });
        }
    }

    fn add_vertex(&mut self, mesh: &Mesh, whole: &Whole, part: u8, corner: Corner) -> u32 {
        let triangle = whole.triangle;
        let mixed = |values: &[[f32; 3]]| {
            let rows = triangle.iter().zip(corner);
            rows.map(|(&i, s)| Vec3::from_array(values[i as usize]) * s).sum::<Vec3>()
        };
        let (position, normal, color) =
            (mixed(&mesh.positions), mixed(&mesh.normals).normalize_or_zero(), mixed(&mesh.colors));
        let (joints, weights) = mixed_weights(mesh, triangle, corner);
        let index = self.mesh.positions.len() as u32;
        self.mesh.positions.push(position.to_array());
        self.mesh.normals.push(normal.to_array());
        self.mesh.colors.push(color.to_array());
        self.mesh.joints.push(joints);
        self.mesh.weights.push(weights);
        self.parts.push(PartVertex::of(part, whole.border_m));
        index
    }
}

impl PartVertex {
    fn of(part: u8, border_m: f32) -> PartVertex {
        let (tone, grain) = wood(Bone::ALL[usize::from(part).min(Bone::COUNT - 1)]);
        PartVertex { part: [part + 1, tone, grain, 0], border_m }
    }
}

/// Tone of a bone's wood, 0 to 2, other than that of the bone that carries it; and the axis of its grain.
fn wood(bone: Bone) -> (u8, u8) {
    let mut links = 0;
    let mut at = bone;
    while at.carrier() != at {
        at = at.carrier();
        links += 1;
    }
    let tone = match bone {
        Bone::Jaw | Bone::LeftEye | Bone::RightEye => return wood(Bone::Head),
        Bone::Neck | Bone::LeftShoulder | Bone::RightShoulder => 1,
        _ => [0, 1, 0, 2][links % 4],
    };
    let sideways = matches!(
        bone.part(),
        rig::Part::LeftArm | rig::Part::RightArm | rig::Part::LeftHand | rig::Part::RightHand
    );
    (tone, u8::from(!sideways))
}

/// The bone that owns a place of the palette.
fn bone_of(place: u8) -> u8 {
    bone_of_place(usize::from(place)).index() as u8
}

fn shares_of(joints: [u8; 4], weights: [u16; 4]) -> Shares {
    let mut shares = Shares::new();
    for (joint, weight) in joints.into_iter().zip(weights).filter(|(_, w)| *w > 0) {
        let (part, weight) = (bone_of(joint), f32::from(weight) / 65535.0);
        match shares.iter_mut().find(|(p, _)| *p == part) {
            Some((_, sum)) => *sum += weight,
            None => shares.push((part, weight)),
        }
    }
    shares
}

fn share(shares: &[(u8, f32)], part: u8) -> f32 {
    shares.iter().find(|(p, _)| *p == part).map_or(0.0, |(_, w)| *w)
}

/// The part with the greatest weight; of equal ones the first in the order of bones.
fn strongest(shares: &[(u8, f32)]) -> u8 {
    let mut best = (0, 0.0);
    for &(part, weight) in shares {
        if weight > best.1 || (weight == best.1 && part < best.0) {
            best = (part, weight);
        }
    }
    best.0
}

/// The bone whose block of wood a part belongs to: jaw and eyes are one with the head.
fn block(part: u8) -> u8 {
    let head =
        [Bone::Jaw, Bone::LeftEye, Bone::RightEye].iter().any(|bone| bone.index() == usize::from(part));
    if head { Bone::Head.index() as u8 } else { part }
}

/// How far ahead of all others a part's block is at a vertex; below 0 where it is behind.
fn ahead(shares: &[(u8, f32)], part: u8) -> f32 {
    let own: f32 = shares.iter().filter(|(p, _)| block(*p) == block(part)).map(|(_, w)| w).sum();
    let others = shares.iter().filter(|(p, _)| block(*p) != block(part)).map(|(_, w)| *w);
    own - others.fold(0.0, f32::max)
}

/// The part of a convex polygon where a linear function, given at the triangle's corners, is not negative.
fn clipped(piece: &[Corner], ahead: [f32; 3]) -> Vec<Corner> {
    let value = |c: &Corner| c[0] * ahead[0] + c[1] * ahead[1] + c[2] * ahead[2];
    let mut out = Vec::with_capacity(piece.len() + 1);
    for (i, a) in piece.iter().enumerate() {
        let b = &piece[(i + 1) % piece.len()];
        let (at_a, at_b) = (value(a), value(b));
        if at_a >= 0.0 {
            out.push(*a);
        }
        if (at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0) {
            let t = at_a / (at_a - at_b);
            out.push(std::array::from_fn(|k| a[k] + (b[k] - a[k]) * t));
        }
    }
    out
}

/// The corners in ascending order, and whether that turns the triangle over.
fn sorted([a, b, c]: [u32; 3]) -> ([u32; 3], bool) {
    let mut t = [a, b, c];
    t.sort_unstable();
    let turns = t == [a, b, c] || t == [b, c, a] || t == [c, a, b];
    (t, !turns)
}

/// The four strongest joints of a mixture, their weights again of sum 65535.
fn mixed_weights(mesh: &Mesh, triangle: [u32; 3], corner: Corner) -> ([u8; 4], [u16; 4]) {
    let mut all: Vec<(u8, f32)> = Vec::new();
    for (&i, s) in triangle.iter().zip(corner) {
        let rows = mesh.joints[i as usize].into_iter().zip(mesh.weights[i as usize]);
        for (joint, weight) in rows.filter(|(_, w)| *w > 0) {
            match all.iter_mut().find(|(j, _)| *j == joint) {
                Some((_, sum)) => *sum += f32::from(weight) * s,
                None => all.push((joint, f32::from(weight) * s)),
            }
        }
    }
    all.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
    all.truncate(4);
    let total: f32 = all.iter().map(|(_, w)| w).sum();
    let (mut joints, mut weights) = ([0; 4], [0_u16; 4]);
    for (k, (joint, weight)) in all.iter().enumerate() {
        joints[k] = *joint;
        weights[k] = (weight / total.max(1.0) * 65535.0).round() as u16;
    }
    let rest: u32 = weights[1..].iter().map(|&w| u32::from(w)).sum();
    weights[0] = 65535_u32.saturating_sub(rest) as u16;
    (joints, weights)
}

/// For each vertex, how far ahead its part is over how fast that falls, metres.
fn border_distances(mesh: &Mesh, shares: &[Shares], own: &[u8]) -> Vec<f32> {
    let mut slopes = vec![(0.0_f32, 0.0_f32); own.len()];
    for t in mesh.indices.chunks_exact(3) {
        let t = [t[0] as usize, t[1] as usize, t[2] as usize];
        let [a, b, c] = t.map(|i| Vec3::from_array(mesh.positions[i]));
        let normal = (b - a).cross(c - a);
        let area2 = normal.length();
        if area2 < 1e-12 {
            continue;
        }
        for i in t {
            let [fa, fb, fc] = t.map(|k| ahead(&shares[k], own[i]));
            // The gradient of a linear function over a triangle.
            let gradient = (normal.cross(c - b) * fa + normal.cross(a - c) * fb + normal.cross(b - a) * fc)
                / (area2 * area2);
            slopes[i].0 += gradient.length() * area2;
            slopes[i].1 += area2;
        }
    }
    let distance = |(i, (sum, weight)): (usize, &(f32, f32))| {
        let slope = if *weight > 0.0 { sum / weight } else { 0.0 };
        (ahead(&shares[i], own[i]) / slope.max(1e-6)).clamp(0.0, FAR_M)
    };
    slopes.iter().enumerate().map(distance).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A strip of two triangles whose weights run from the hips to the spine along x.
    fn strip() -> Mesh {
        let positions = vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        let ends = [[65535, 0, 0, 0], [0, 65535, 0, 0], [0, 65535, 0, 0], [65535, 0, 0, 0]];
        Mesh {
            normals: vec![[0.0, 0.0, 1.0]; 4],
            colors: vec![[0.5; 3]; 4],
            joints: vec![[Bone::Hips.index() as u8, Bone::Spine.index() as u8, 0, 0]; 4],
            weights: ends.to_vec(),
            indices: vec![0, 1, 2, 0, 2, 3],
            positions,
        }
    }

    #[test]
    fn pieces_cover_the_skin_once_and_meet_at_equal_weights() {
        let cut = Cut::new(&strip());
        assert_eq!(cut.mesh.fault(), None);
        let mut areas = [0.0_f32; 2];
        for t in cut.mesh.indices.chunks_exact(3) {
            let [a, b, c] = [t[0], t[1], t[2]].map(|i| Vec3::from_array(cut.mesh.positions[i as usize]));
            let area = (b - a).cross(c - a).z * 0.5;
            assert!(area > 0.0, "no piece is turned over");
            let parts = [t[0], t[1], t[2]].map(|i| cut.parts[i as usize].part[0]);
            assert!(parts.iter().all(|&p| p == parts[0]), "a piece belongs to one bone");
            areas[usize::from(parts[0] - 1)] += area;
            let middle = (a.x + b.x + c.x) / 3.0;
            assert_eq!(parts[0] == 1, middle < 0.5, "the hips have the left half");
        }
        assert!(areas.iter().all(|a| (a - 0.5).abs() < 1e-6), "{areas:?}");
        for (vertex, part) in cut.mesh.positions.iter().zip(&cut.parts).skip(4) {
            assert!((vertex[0] - 0.5).abs() < 1e-6 && part.border_m == 0.0);
        }
    }

    #[test]
    fn colors_are_those_of_the_known_map_and_differ() {
        // Known colours of the map's numbers 1 to 5 and 21.
        let first = [[128, 0, 0], [0, 128, 0], [128, 128, 0], [0, 0, 128], [128, 0, 128]];
        for (bone, color) in Bone::ALL.into_iter().zip(first) {
            assert_eq!(part_color(bone), color, "{bone}");
        }
        assert_eq!(part_color(Bone::ALL[20]), [128, 64, 128]);
        for bone in Bone::ALL {
            assert_eq!(part_of_color(part_color(bone)), Some(bone));
        }
        assert_eq!(part_of_color([0; 3]), None);
    }
}
