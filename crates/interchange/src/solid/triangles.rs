//! Triangles as they come from files, gathered into a mesh.

use glam::Vec3;
use rig::Solid;

use super::MAX_TRIANGLES;

/// Gathers triangles. Corners of one triangle share nothing with those of others, so flat faces stay flat.
#[derive(Default)]
pub(super) struct Triangles {
    solid: Solid,
}

impl Triangles {
    /// Adds a triangle with its corners' normals, where the file has some, and its colour. One without area is left out.
    ///
    /// # Errors
    /// A corner that is not finite, too many triangles.
    pub fn add(
        &mut self,
        corners: [Vec3; 3],
        normals: Option<[Vec3; 3]>,
        color: [f32; 3],
    ) -> Result<(), String> {
        let [a, b, c] = corners;
        if !corners.iter().all(|p| p.is_finite()) {
            return Err(format!("triangle {} has a corner that is not finite", self.count() + 1));
        }
        if self.count() >= MAX_TRIANGLES {
            return Err(format!("it has more than {MAX_TRIANGLES} triangles, the most that are read"));
        }
        let Some(flat) = (b - a).cross(c - a).try_normalize() else { return Ok(()) };
        for i in 0..3 {
            let own = normals.and_then(|n| n[i].try_normalize());
            self.solid.indices.push(u32::try_from(self.solid.positions.len()).unwrap_or(u32::MAX));
            self.solid.positions.push(corners[i].to_array());
            self.solid.normals.push(own.unwrap_or(flat).to_array());
            self.solid.colors.push(color);
        }
        Ok(())
    }

    fn count(&self) -> usize {
        self.solid.indices.len() / 3
    }

    /// The mesh; corners that are the same in place, normal and colour become one vertex.
    pub fn solid(self) -> Solid {
        let Solid { positions, normals, colors, indices } = self.solid;
        let key = |i: u32| {
            let i = i as usize;
            // One zero: -0 and 0 are the same place.
            let bits = |v: [f32; 3]| v.map(|c| (c + 0.0).to_bits());
            (bits(positions[i]), bits(normals[i]), bits(colors[i]))
        };
        let mut places = std::collections::BTreeMap::new();
        let mut solid = Solid::default();
        for i in indices {
            let next = u32::try_from(solid.positions.len()).unwrap_or(u32::MAX);
            let at = *places.entry(key(i)).or_insert(next);
            if at == next {
                solid.positions.push(positions[i as usize]);
                solid.normals.push(normals[i as usize]);
                solid.colors.push(colors[i as usize]);
            }
            solid.indices.push(at);
        }
        solid
    }
}

/// A colour of a file, as on a screen, as linear light.
pub(super) fn linear(rgb: [f32; 3]) -> [f32; 3] {
    rig::Paint { name: String::new(), rgba: [rgb[0], rgb[1], rgb[2], 1.0].map(f64::from) }.linear_rgb()
}
