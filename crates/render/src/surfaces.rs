//! Balls and sheets among the marks, as surfaces.wgsl reads them.

use bytemuck::{Pod, Zeroable};

use crate::layered::Layered;
use crate::overlay::{Color, Fan, Overlay};

/// Vertices of a ball: two triangles for each of 96 by 48 quads, as in surfaces.wgsl.
pub(crate) const BALL_VERTICES: u32 = 6 * 96 * 48;

/// One instance of `Ball` in surfaces.wgsl.
#[derive(Clone, Copy, PartialEq, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Shell {
    /// Centre and radius.
    pub sphere: [f32; 4],
    pub color: Color,
}

/// One corner of a triangle.
#[derive(Clone, Copy, PartialEq, Debug, Pod, Zeroable)]
#[repr(C)]
pub(crate) struct Corner {
    pub at: [f32; 3],
    pub color: Color,
}

/// The balls of an overlay; those that are not finite, or have no size, are left out.
pub(crate) fn shells(overlay: &Overlay) -> Layered<Shell> {
    let sound = |b: &&crate::Ball| b.center.is_finite() && b.radius_m.is_finite() && b.radius_m > 0.0;
    let shell = |b: &crate::Ball| Shell { sphere: b.center.extend(b.radius_m).to_array(), color: b.color };
    overlay.balls.iter().filter(sound).map(|b| (b.layer, shell(b))).collect()
}

/// The triangles of an overlay's fans; those with a corner that is not finite are left out.
pub(crate) fn corners(overlay: &Overlay) -> Layered<Corner> {
    let triangles = |fan: &Fan| {
        let corner = |at: glam::Vec3, color| Corner { at: at.to_array(), color };
        let (layer, center) = (fan.layer, corner(fan.center, fan.center_color));
        let triangle = |p: &[glam::Vec3]| [center, corner(p[0], fan.color), corner(p[1], fan.color)];
        let sound =
            fan.rim.windows(2).map(triangle).filter(|t| t.iter().flat_map(|c| c.at).all(f32::is_finite));
        sound.flatten().map(move |c| (layer, c)).collect::<Vec<_>>()
    };
    overlay.fans.iter().flat_map(triangles).collect()
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

    use super::*;
    use crate::{Ball, Layer};

    #[test]
    fn a_sector_ends_where_its_angle_does_and_bad_numbers_are_left_out() {
        let mut overlay = Overlay::default();
        overlay.sector(Vec3::Y, Vec3::Z, Vec3::X, 1.5, [9, 9, 9, 200], Layer::Tested);
        let rim = &overlay.fans[0].rim;
        let last = Vec3::Y + Vec3::new(1.5_f32.cos(), 1.5_f32.sin(), 0.0);
        assert!(
            (rim[0] - Vec3::new(1.0, 1.0, 0.0)).length() < 1e-6
                && (rim[rim.len() - 1] - last).length() < 1e-5
        );
        let sound = corners(&overlay).layer(Layer::Tested).len();
        assert_eq!(sound, 3 * (rim.len() - 1));
        overlay.sector(Vec3::Y, Vec3::Z, Vec3::X, f32::NAN, [9; 4], Layer::Tested);
        overlay.polygon(&[Vec3::X, Vec3::NAN, Vec3::Y], [9; 4], Layer::Tested);
        overlay.polygon(&[], [9; 4], Layer::Tested);
        assert_eq!(corners(&overlay).layer(Layer::Tested).len(), sound);
        overlay.polygon(&[Vec3::ZERO, Vec3::X, Vec3::Z], [9; 4], Layer::OnTop);
        assert_eq!(corners(&overlay).layer(Layer::OnTop).len(), 9, "the rim closes");
        for radius_m in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            overlay.balls.push(Ball { center: Vec3::ZERO, radius_m, color: [9; 4], layer: Layer::Ghosted });
        }
        assert!(shells(&overlay).layer(Layer::Ghosted).is_empty());
    }
}
