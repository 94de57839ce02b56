//! The skin: a triangle mesh with up to four places of the palette a vertex.

use crate::PLACES;

/// A skinned triangle mesh at rest, in figure space, metres; triangles counter-clockwise from outside.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Mesh {
    /// Vertex positions.
    pub positions: Vec<[f32; 3]>,
    /// Unit normals, one a vertex.
    pub normals: Vec<[f32; 3]>,
    /// Linear RGB base colours, one a vertex.
    pub colors: Vec<[f32; 3]>,
    /// Places of the palette that move each vertex: bones by [`Bone::index`](crate::Bone::index), and the twist places
    /// that [`spread_twist`](crate::spread_twist) adds. [`bone_of_place`](crate::bone_of_place) tells the bone of either.
    pub joints: Vec<[u8; 4]>,
    /// Their weights as fractions of 65,535; each row sums to 65,535 exactly.
    pub weights: Vec<[u16; 4]>,
    /// Three vertex numbers a triangle.
    pub indices: Vec<u32>,
}

impl Mesh {
    /// Number of vertices.
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    /// What is wrong with the mesh, if anything: lengths that differ, numbers out of range.
    pub fn fault(&self) -> Option<String> {
        let n = self.positions.len();
        for (what, len) in [
            ("normals", self.normals.len()),
            ("colors", self.colors.len()),
            ("joints", self.joints.len()),
            ("weights", self.weights.len()),
        ] {
            if len != n {
                return Some(format!("{len} {what} for {n} vertices"));
            }
        }
        if !self.indices.len().is_multiple_of(3) {
            return Some(format!("{} indices are not whole triangles", self.indices.len()));
        }
        if let Some(i) = self.indices.iter().find(|&&i| i as usize >= n) {
            return Some(format!("index {i} is beyond the last of {n} vertices"));
        }
        if let Some(v) = self.positions.iter().position(|p| p.iter().any(|c| !c.is_finite())) {
            return Some(format!("vertex {v} has a position that is not finite"));
        }
        if let Some(v) = self.joints.iter().position(|j| j.iter().any(|&b| usize::from(b) >= PLACES)) {
            return Some(format!("vertex {v} names a bone beyond the last"));
        }
        let sum = |w: &[u16; 4]| w.iter().map(|&w| u32::from(w)).sum::<u32>();
        self.weights
            .iter()
            .position(|w| sum(w) != u32::from(u16::MAX))
            .map(|v| format!("the weights of vertex {v} sum to {} instead of 65535", sum(&self.weights[v])))
    }
}
