//! The skin palette, and the same skinning on the CPU as the shader does on the GPU.

use bytemuck::{Pod, Zeroable};
use glam::{DMat3, DVec3, Vec3};

use crate::{Bone, Bounds, Frames, Mesh};

/// Places in a palette: the bones, padded to a round number for the uniform buffer.
pub const PALETTE_LEN: usize = 64;

/// One affine matrix a bone, three rows of four: takes a point of the skin at rest to the posed figure, metres,
/// in the space of the frames that it was made from (figure or world).
///
/// Laid out as the shader's `array<mat3x4<f32>, 64>`; places beyond the last bone are the identity.
#[derive(Clone, Copy, PartialEq, Debug, Pod, Zeroable)]
#[repr(transparent)]
pub struct Palette(pub [[[f32; 4]; 3]; PALETTE_LEN]);

const IDENTITY: [[f32; 4]; 3] = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];

impl Palette {
    /// The palette of the rest pose.
    pub const REST: Palette = Palette([IDENTITY; PALETTE_LEN]);

    /// The palette of posed joints, given where each joint is at rest (axis-aligned there).
    pub fn new(figure_from_joint: &Frames, rest_positions: &[DVec3; Bone::COUNT]) -> Palette {
        let mut palette = Palette::REST;
        for (bone, rest) in Bone::ALL.into_iter().zip(rest_positions) {
            let frame = figure_from_joint[bone];
            let r = DMat3::from_quat(frame.rotation);
            let t = frame.point(-*rest);
            palette.0[bone.index()] = std::array::from_fn(|i| {
                let row = r.row(i);
                [row.x as f32, row.y as f32, row.z as f32, t[i] as f32]
            });
        }
        palette
    }

    /// Where a rest point goes if it belongs to that bone alone.
    pub fn point(&self, bone: Bone, rest: Vec3) -> Vec3 {
        apply(&self.0[bone.index()], rest, 1.0)
    }
}

/// `matrix * (v, w)`.
fn apply(matrix: &[[f32; 4]; 3], v: Vec3, w: f32) -> Vec3 {
    Vec3::from_array(std::array::from_fn(|i| {
        let [x, y, z, t] = matrix[i];
        x * v.x + y * v.y + z * v.z + t * w
    }))
}

/// The vertex's own matrix: the palette blended by its weights.
fn blend(palette: &Palette, joints: [u8; 4], weights: [u16; 4]) -> [[f32; 4]; 3] {
    let mut m = [[0.0; 4]; 3];
    for (joint, weight) in joints.into_iter().zip(weights) {
        let w = f32::from(weight) / 65535.0;
        let bone = &palette.0[usize::from(joint).min(PALETTE_LEN - 1)];
        for (sum, row) in m.iter_mut().zip(bone) {
            for (s, x) in sum.iter_mut().zip(row) {
                *s += w * x;
            }
        }
    }
    m
}

/// One posed vertex, in the palette's space, metres.
///
/// # Panics
/// A vertex beyond the mesh's last.
pub fn skin_position(mesh: &Mesh, palette: &Palette, vertex: usize) -> Vec3 {
    let matrix = blend(palette, mesh.joints[vertex], mesh.weights[vertex]);
    apply(&matrix, Vec3::from_array(mesh.positions[vertex]), 1.0)
}

/// Posed vertex positions, figure space, metres. A mesh with a [`Mesh::fault`] yields as many as it has whole vertices.
pub fn skin_positions(mesh: &Mesh, palette: &Palette) -> Vec<Vec3> {
    let rows = mesh.positions.iter().zip(&mesh.joints).zip(&mesh.weights);
    rows.map(|((&p, &j), &w)| apply(&blend(palette, j, w), Vec3::from_array(p), 1.0)).collect()
}

/// Posed unit normals, figure space; where the blend cancels out a normal is zero.
pub fn skin_normals(mesh: &Mesh, palette: &Palette) -> Vec<Vec3> {
    let rows = mesh.normals.iter().zip(&mesh.joints).zip(&mesh.weights);
    rows.map(|((&n, &j), &w)| apply(&blend(palette, j, w), Vec3::from_array(n), 0.0).normalize_or_zero())
        .collect()
}

/// The box around each bone's part of a skin at rest; bounds any pose without touching the vertices.
#[derive(Clone, PartialEq, Debug)]
pub struct SkinBounds(Vec<(Bone, Bounds)>);

impl SkinBounds {
    /// Boxes of a mesh's bones; bones without skin have none.
    pub fn new(mesh: &Mesh) -> SkinBounds {
        let mut boxes = [Bounds::EMPTY; Bone::COUNT];
        for ((&p, joints), weights) in mesh.positions.iter().zip(&mesh.joints).zip(&mesh.weights) {
            for (&joint, &weight) in joints.iter().zip(weights) {
                if let Some(b) = boxes.get_mut(usize::from(joint)).filter(|_| weight > 0) {
                    *b = b.with(Vec3::from_array(p));
                }
            }
        }
        SkinBounds(Bone::ALL.into_iter().zip(boxes).filter(|(_, b)| !b.is_empty()).collect())
    }

    /// Corners of the posed boxes, figure space: their hull holds every posed vertex.
    pub fn corners<'a>(&'a self, palette: &'a Palette) -> impl Iterator<Item = Vec3> + 'a {
        self.0.iter().flat_map(|&(bone, b)| b.corners().map(|c| palette.point(bone, c)))
    }

    /// A box that holds every posed vertex, figure space; somewhat larger than the tightest one.
    pub fn posed(&self, palette: &Palette) -> Bounds {
        Bounds::of(self.corners(palette))
    }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::*;
    use crate::Frame;

    fn one_vertex(joints: [u8; 4], weights: [u16; 4]) -> Mesh {
        Mesh {
            positions: vec![[0.5, 1.4, 0.1]],
            normals: vec![[0.0, 1.0, 0.0]],
            colors: vec![[1.0; 3]],
            joints: vec![joints],
            weights: vec![weights],
            indices: vec![],
        }
    }

    /// The left arm turned by 90 degrees about the shoulder, everything else at rest.
    fn turned() -> Palette {
        let mut rest = [DVec3::new(0.0, 1.0, 0.0); Bone::COUNT];
        rest[Bone::LeftUpperArm.index()] = DVec3::new(0.2, 1.4, 0.0);
        let mut frames = Frames(rest.map(|position| Frame { rotation: DQuat::IDENTITY, position }));
        frames.0[Bone::LeftUpperArm.index()].rotation = DQuat::from_rotation_z(-std::f64::consts::FRAC_PI_2);
        Palette::new(&frames, &rest)
    }

    #[test]
    fn a_turned_bone_carries_its_skin_about_its_joint() {
        let arm = Bone::LeftUpperArm.index() as u8;
        let mesh = one_vertex([arm, 0, 0, 0], [65535, 0, 0, 0]);
        let p = skin_positions(&mesh, &turned())[0];
        assert!((p - Vec3::new(0.2, 1.1, 0.1)).length() < 1e-6, "{p}");
        let n = skin_normals(&mesh, &turned())[0];
        assert!((n - Vec3::X).length() < 1e-6, "{n}");
    }

    #[test]
    fn weights_blend_linearly_and_normals_stay_unit() {
        let arm = Bone::LeftUpperArm.index() as u8;
        let mesh = one_vertex([arm, 0, 0, 0], [32768, 32767, 0, 0]);
        let p = skin_positions(&mesh, &turned())[0];
        assert!((p - Vec3::new(0.35, 1.25, 0.1)).length() < 1e-5, "{p}");
        assert!((skin_normals(&mesh, &turned())[0].length() - 1.0).abs() < 1e-6);
    }

    #[test]
    fn the_rest_palette_moves_nothing() {
        let mesh = one_vertex([3, 9, 20, 54], [20000, 20000, 20000, 5535]);
        let p = skin_positions(&mesh, &Palette::REST)[0];
        assert!((p - Vec3::from_array(mesh.positions[0])).length() < 1e-6);
    }

    #[test]
    fn posed_bounds_hold_the_posed_skin() {
        let arm = Bone::LeftUpperArm.index() as u8;
        let mesh = one_vertex([arm, 0, 0, 0], [40000, 25535, 0, 0]);
        let p = skin_positions(&mesh, &turned())[0];
        let b = SkinBounds::new(&mesh).posed(&turned());
        assert!(b.min.cmple(p + 1e-6).all() && b.max.cmpge(p - 1e-6).all());
    }
}
