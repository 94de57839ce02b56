//! Skinning on the CPU, the same as the shader does on the GPU.

use glam::Vec3;

use crate::dual_quaternion::DualQuaternion;
use crate::{Mesh, Palette};

/// The vertex's own motion: the palette blended by its weights. Their unit doesn't matter, so they stay whole numbers.
#[inline]
fn blend(palette: &Palette, joints: [u8; 4], weights: [u16; 4]) -> DualQuaternion {
    let parts = joints.into_iter().zip(weights);
    parts.fold(DualQuaternion::ZERO, |sum, (place, weight)| {
        sum.plus(palette.motion(usize::from(place)), f32::from(weight))
    })
}

/// One posed vertex, in the palette's space, metres.
///
/// # Panics
/// A vertex beyond the mesh's last.
pub fn skin_position(mesh: &Mesh, palette: &Palette, vertex: usize) -> Vec3 {
    blend(palette, mesh.joints[vertex], mesh.weights[vertex]).point(Vec3::from_array(mesh.positions[vertex]))
}

/// Posed vertex positions, in the palette's space, metres. A mesh with a [`Mesh::fault`] yields as many as it has whole
/// vertices.
pub fn skin_positions(mesh: &Mesh, palette: &Palette) -> Vec<Vec3> {
    let rows = mesh.positions.iter().zip(&mesh.joints).zip(&mesh.weights);
    rows.map(|((&p, &j), &w)| blend(palette, j, w).point(Vec3::from_array(p))).collect()
}

/// Posed normals, in the palette's space; as long as at rest, to rounding.
pub fn skin_normals(mesh: &Mesh, palette: &Palette) -> Vec<Vec3> {
    let rows = mesh.normals.iter().zip(&mesh.joints).zip(&mesh.weights);
    rows.map(|((&n, &j), &w)| blend(palette, j, w).vector(Vec3::from_array(n))).collect()
}

#[cfg(test)]
mod tests {
    use glam::{DQuat, DVec3};

    use super::*;
    use crate::{Bone, Frame, Frames};

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
    fn between_two_bones_a_vertex_goes_half_the_way_round_and_not_straight_through() {
        let arm = Bone::LeftUpperArm.index() as u8;
        let mesh = one_vertex([arm, 0, 0, 0], [32768, 32767, 0, 0]);
        let p = skin_positions(&mesh, &turned())[0];
        let half = 0.3 * std::f32::consts::FRAC_1_SQRT_2;
        assert!((p - Vec3::new(0.2 + half, 1.4 - half, 0.1)).length() < 3e-5, "{p}");
        let n = skin_normals(&mesh, &turned())[0];
        assert!((n - Vec3::new(1.0, 1.0, 0.0).normalize()).length() < 3e-5, "{n}");
    }

    #[test]
    fn the_rest_palette_moves_nothing() {
        let mesh = one_vertex([3, 9, 20, 54], [20000, 20000, 20000, 5535]);
        assert_eq!(skin_positions(&mesh, &Palette::REST)[0].to_array(), mesh.positions[0]);
        assert_eq!(skin_normals(&mesh, &Palette::REST)[0].to_array(), mesh.normals[0]);
    }

    #[test]
    fn motions_that_cancel_out_leave_finite_numbers() {
        let mut palette = Palette::REST;
        palette.0[1] = palette.0[1].map(|part| part.map(|c| -c));
        let mesh = one_vertex([0, 1, 0, 0], [32767, 32767, 1, 0]);
        let nothing = one_vertex([0, 0, 0, 0], [0; 4]);
        for mesh in [mesh, nothing] {
            assert!(skin_positions(&mesh, &palette)[0].is_finite());
            assert!(skin_normals(&mesh, &palette)[0].is_finite());
        }
    }
}
