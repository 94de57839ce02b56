//! The key light: a shadow map that fits the figures, and where their shadow falls on the ground.

use glam::{Mat4, Vec3};
use rig::Bounds;

/// Edge of the shadow map, texels.
pub(crate) const SHADOW_SIZE: u32 = 2048;

/// The part of the map's edges that is used where shadows are not softened on the figures.
const SMALL_SHARE: f32 = 0.5;

/// How far the soft shadow reaches beyond the sharp one.
const PENUMBRA_M: f32 = 0.16;

/// A directional light and its shadow map's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Light {
    /// Unit, from the figures to the light.
    pub toward: Vec3,
    /// To the shadow map: xy is the place in the texture, z the depth.
    pub shadow_from_world: Mat4,
    /// What a texel spans, metres.
    pub texel_m: f32,
    /// What depth 0 to 1 spans, metres.
    pub deep_m: f32,
    /// Edge of the shadow map, texels.
    pub size: u32,
    /// Least x and z, greatest x and z of the shadow on the ground.
    pub footprint: [f32; 4],
    /// Whether there is anything to cast a shadow.
    pub casts: bool,
}

impl Light {
    /// Fits the light to what casts shadows, given by the corners of boxes around it. A coarse one uses a corner of the
    /// map: a quarter of the texels to fill.
    pub fn fit(key_light: Vec3, casters: &[Vec3], wanted: bool, coarse: bool) -> Light {
        let toward = raised(key_light);
        let axes = axes(toward);
        let seen = Bounds::of(casters.iter().map(|&p| axes * p));
        if !wanted || seen.is_empty() {
            return Light {
                toward,
                shadow_from_world: Mat4::IDENTITY,
                texel_m: 0.0,
                deep_m: 1.0,
                size: SHADOW_SIZE,
                footprint: [0.0; 4],
                casts: false,
            };
        }
        let on_ground = |p: &Vec3| *p - toward * (p.y / toward.y);
        let fallen = Bounds::of(casters.iter().map(on_ground));
        // Steps of size and place keep still edges still while a limb moves.
        let half = (seen.max - seen.min).truncate().max_element() * 0.5 + PENUMBRA_M;
        let half = (half * 8.0).ceil() / 8.0;
        let share = if coarse { SMALL_SHARE } else { 1.0 };
        let texel_m = 2.0 * half / (SHADOW_SIZE as f32 * share);
        let center = (seen.center() / texel_m).round() * texel_m;
        let lowest =
            fallen.corners().into_iter().map(|p| (axes * p).z).fold(seen.min.z, f32::min) - PENUMBRA_M;
        let highest = seen.max.z + 0.05;
        let deep = highest - lowest;
        let texture_from_light = Mat4::from_cols(
            Vec3::X.extend(0.0) * (0.5 * share / half),
            Vec3::Y.extend(0.0) * (-0.5 * share / half),
            Vec3::Z.extend(0.0) * (-1.0 / deep),
            Vec3::new(
                share * (0.5 - center.x * 0.5 / half),
                share * (0.5 + center.y * 0.5 / half),
                highest / deep,
            )
            .extend(1.0),
        );
        Light {
            toward,
            shadow_from_world: texture_from_light * Mat4::from_mat3(axes),
            texel_m,
            deep_m: deep,
            size: SHADOW_SIZE,
            footprint: [
                fallen.min.x - PENUMBRA_M,
                fallen.min.z - PENUMBRA_M,
                fallen.max.x + PENUMBRA_M,
                fallen.max.z + PENUMBRA_M,
            ],
            casts: true,
        }
    }
}

/// The direction, at least 20 degrees above the ground.
fn raised(key_light: Vec3) -> Vec3 {
    let unit = key_light.normalize_or(Vec3::Y);
    let least = 20.0_f32.to_radians().sin();
    if unit.y >= least {
        return unit;
    }
    let flat = Vec3::new(unit.x, 0.0, unit.z).normalize_or(Vec3::Z);
    flat * (1.0 - least * least).sqrt() + Vec3::Y * least
}

/// Rows: the light's right, up and the direction to it.
fn axes(toward: Vec3) -> glam::Mat3 {
    let right = Vec3::Y.cross(toward).normalize_or(Vec3::X);
    glam::Mat3::from_cols(right, toward.cross(right), toward).transpose()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn casters_and_their_ground_shadow_lie_inside_the_map() {
        let body = Bounds { min: Vec3::new(-0.8, 0.0, -0.3), max: Vec3::new(0.8, 1.7, 0.2) };
        for key in [Vec3::new(0.5, 1.0, 0.7), Vec3::Y, Vec3::new(-1.0, -3.0, 0.0), Vec3::ZERO, Vec3::NAN] {
            for coarse in [false, true] {
                let light = Light::fit(key, &body.corners(), true, coarse);
                assert!(light.casts);
                for p in body.corners() {
                    let ground = p - light.toward * (p.y / light.toward.y);
                    for q in [p, ground] {
                        let at = light.shadow_from_world.transform_point3(q);
                        assert!(
                            at.cmpge(Vec3::ZERO).all() && at.cmple(Vec3::ONE).all(),
                            "{key}: {q} -> {at}"
                        );
                    }
                    let (a, b) = (
                        light.shadow_from_world.transform_point3(p),
                        light.shadow_from_world.transform_point3(ground),
                    );
                    assert!((a - b).truncate().length() < 1e-4 && a.z <= b.z + 1e-6);
                }
            }
        }
        assert!(!Light::fit(Vec3::Y, &[], true, false).casts);
    }
}
