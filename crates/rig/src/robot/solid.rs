//! Triangles that stay as they are: meshes of links, and those of boxes, cylinders and balls.

use std::f64::consts::{FRAC_PI_2, TAU};

use glam::{DVec3, Vec3};

use super::{Shape, Visual};

/// A triangle mesh that doesn't bend, metres; triangles counter-clockwise from outside.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Solid {
    /// Vertex positions.
    pub positions: Vec<[f32; 3]>,
    /// Unit normals, one a vertex.
    pub normals: Vec<[f32; 3]>,
    /// Linear RGB colours, one a vertex.
    pub colors: Vec<[f32; 3]>,
    /// Three vertex numbers a triangle.
    pub indices: Vec<u32>,
}

/// The linear grey of what no file paints.
pub const UNPAINTED: [f32; 3] = [0.6, 0.6, 0.6];
/// The linear orange of what stands in for a mesh that is missing.
pub const STAND_IN: [f32; 3] = [0.9, 0.35, 0.05];
/// The edge of the box that stands in for a missing mesh, metres, whatever the scale of the mesh.
pub const STAND_IN_EDGE_M: f64 = 0.05;
/// Segments around cylinders and balls.
const AROUND: usize = 32;

impl Solid {
    /// Adds a triangle with corners and normals of its own.
    fn corner(&mut self, position: DVec3, normal: DVec3, color: [f32; 3]) -> u32 {
        let at = u32::try_from(self.positions.len()).unwrap_or(u32::MAX);
        self.positions.push(position.as_vec3().to_array());
        self.normals.push(normal.as_vec3().to_array());
        self.colors.push(color);
        at
    }

    /// A box about the origin.
    fn cuboid(edges: DVec3, color: [f32; 3]) -> Solid {
        let mut solid = Solid::default();
        let half = edges.abs() / 2.0;
        for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
            for normal in [axis, -axis] {
                let u = DVec3::new(axis.y, axis.z, axis.x);
                let v = normal.cross(u);
                let corner = |a: f64, b: f64| (normal + u * a + v * b) * half;
                let [a, b, c, d] = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
                    .map(|(a, b)| solid.corner(corner(a, b), normal, color));
                solid.indices.extend([a, b, c, a, c, d]);
            }
        }
        solid
    }

    /// A surface of revolution about z: rings of (distance from z, height, normal's outward part, normal's upward part)
    /// from the bottom up.
    fn turned(rings: &[[f64; 4]], color: [f32; 3]) -> Solid {
        let mut solid = Solid::default();
        for [radius, z, out, up] in rings {
            for i in 0..AROUND {
                let angle = TAU * i as f64 / AROUND as f64;
                let around = DVec3::new(angle.cos(), angle.sin(), 0.0);
                solid.corner(around * *radius + DVec3::Z * *z, around * *out + DVec3::Z * *up, color);
            }
        }
        let around = AROUND as u32;
        for ring in 0..(rings.len() as u32).saturating_sub(1) {
            for i in 0..around {
                let [a, b] = [i, (i + 1) % around].map(|k| ring * around + k);
                let [c, d] = [a + around, b + around];
                // At a pole one of the two has no area.
                solid.indices.extend([a, b, d, a, d, c]);
            }
        }
        solid
    }

    fn cylinder(radius: f64, length: f64, color: [f32; 3]) -> Solid {
        let h = length / 2.0;
        Solid::turned(
            &[
                [0.0, -h, 0.0, -1.0],
                [radius, -h, 0.0, -1.0],
                [radius, -h, 1.0, 0.0],
                [radius, h, 1.0, 0.0],
                [radius, h, 0.0, 1.0],
                [0.0, h, 0.0, 1.0],
            ],
            color,
        )
    }

    /// A ball, or a capsule if its two halves are apart.
    fn capsule(radius: f64, length: f64, color: [f32; 3]) -> Solid {
        let half = AROUND / 4;
        let mut rings = Vec::new();
        for (side, shift) in [(-1.0, -length / 2.0), (1.0, length / 2.0)] {
            for i in 0..=half {
                let step = if side < 0.0 { half - i } else { i };
                let (sin, cos) = (FRAC_PI_2 * step as f64 / half as f64).sin_cos();
                rings.push([radius * cos, side * radius * sin + shift, cos, side * sin]);
            }
        }
        Solid::turned(&rings, color)
    }

    /// The mesh scaled along its axes, in one colour or its own.
    fn scaled(&self, scale: DVec3, color: Option<[f32; 3]>) -> Solid {
        let scale = scale.as_vec3();
        let mut solid = self.clone();
        for p in &mut solid.positions {
            *p = (Vec3::from_array(*p) * scale).to_array();
        }
        // Normals go with the inverse scale, so that they stay across the surface; an axis of scale 0 keeps them finite.
        let cofactor = Vec3::new(scale.y * scale.z, scale.z * scale.x, scale.x * scale.y);
        let mirrored = scale.x * scale.y * scale.z < 0.0;
        let sign = if mirrored { -1.0 } else { 1.0 };
        for n in &mut solid.normals {
            let normal = Vec3::from_array(*n);
            *n = (normal * cofactor * sign).try_normalize().unwrap_or(normal).to_array();
        }
        if mirrored {
            solid.indices.as_chunks_mut::<3>().0.iter_mut().for_each(|t| t.swap(1, 2));
        }
        if let Some(color) = color {
            solid.colors.fill(color);
        }
        solid
    }

    /// The smallest box along the axes that holds it, lowest and highest corner; `None` if it is empty.
    pub fn bounds(&self) -> Option<[Vec3; 2]> {
        let mut points = self.positions.iter().map(|p| Vec3::from_array(*p));
        let first = points.next()?;
        Some(points.fold([first; 2], |[low, high], p| [low.min(p), high.max(p)]))
    }

    /// What is wrong with it, if anything: lengths that differ, numbers out of range or not finite.
    pub fn fault(&self) -> Option<String> {
        let n = self.positions.len();
        if self.normals.len() != n || self.colors.len() != n {
            return Some(format!(
                "{} normals and {} colours for {n} vertices",
                self.normals.len(),
                self.colors.len()
            ));
        }
        if !self.indices.len().is_multiple_of(3) {
            return Some(format!("{} indices are not whole triangles", self.indices.len()));
        }
        if let Some(i) = self.indices.iter().find(|&&i| i as usize >= n) {
            return Some(format!("index {i} is beyond the last of {n} vertices"));
        }
        let whole = |v: &[f32; 3]| v.iter().all(|c| c.is_finite());
        let bad = (0..n).find(|&i| !whole(&self.positions[i]) || !whole(&self.normals[i]));
        bad.map(|i| format!("vertex {i} has a number that is not finite"))
    }
}

impl Visual {
    /// The smallest box along its own axes that holds it, lowest and highest corner, metres; `None` if nothing is seen of it.
    pub fn bounds(&self) -> Option<[DVec3; 2]> {
        let half = match &self.shape {
            Shape::Box(edges) => edges.abs() / 2.0,
            Shape::Cylinder { radius, length } => DVec3::new(*radius, *radius, length / 2.0),
            Shape::Capsule { radius, length } => DVec3::new(*radius, *radius, length / 2.0 + radius),
            Shape::Sphere(radius) => DVec3::splat(*radius),
            Shape::Mesh { scale, solid: Some(solid), .. } => {
                let [a, b] = solid.bounds()?.map(|corner| corner.as_dvec3() * *scale);
                return Some([a.min(b), a.max(b)]);
            }
            Shape::Mesh { solid: None, .. } => DVec3::splat(STAND_IN_EDGE_M / 2.0),
        };
        Some([-half, half])
    }

    /// Its triangles in its own frame. A mesh that could not be had is an orange box of 5 cm.
    pub fn solid(&self) -> Solid {
        let own = self.paint.as_ref().map(super::Paint::linear_rgb);
        let color = own.unwrap_or(UNPAINTED);
        match &self.shape {
            Shape::Box(edges) => Solid::cuboid(*edges, color),
            Shape::Cylinder { radius, length } => Solid::cylinder(*radius, *length, color),
            Shape::Capsule { radius, length } => Solid::capsule(*radius, *length, color),
            Shape::Sphere(radius) => Solid::capsule(*radius, 0.0, color),
            Shape::Mesh { scale, solid: Some(solid), .. } => solid.scaled(*scale, own),
            Shape::Mesh { solid: None, .. } => Solid::cuboid(DVec3::splat(STAND_IN_EDGE_M), STAND_IN),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use kin::Frame;

    fn visual(shape: Shape) -> Visual {
        Visual { name: None, link_from_visual: Frame::IDENTITY, shape, paint: None }
    }

    /// Six times the volume inside, positive if the triangles face outward.
    fn volume(solid: &Solid) -> f64 {
        let p = |i: u32| Vec3::from_array(solid.positions[i as usize]).as_dvec3();
        let six: f64 =
            solid.indices.as_chunks::<3>().0.iter().map(|&[a, b, c]| p(a).dot(p(b).cross(p(c)))).sum();
        six / 6.0
    }

    #[test]
    fn shapes_hold_their_volume_and_face_outward() {
        let about = |shape, expected: f64| {
            let visual = visual(shape);
            let solid = visual.solid();
            assert_eq!(solid.fault(), None);
            let [low, high] = solid.bounds().unwrap();
            let [lowest, highest] = visual.bounds().unwrap().map(DVec3::as_vec3);
            assert!(low.abs_diff_eq(lowest, 1e-6) && high.abs_diff_eq(highest, 1e-6), "{low} {high}");
            let found = volume(&solid);
            assert!((found / expected - 1.0).abs() < 0.02, "{found} instead of {expected}");
            for (p, n) in solid.positions.iter().zip(&solid.normals) {
                let (p, n) = (Vec3::from_array(*p), Vec3::from_array(*n));
                assert!((n.length() - 1.0).abs() < 1e-5 && p.dot(n) > -1e-6, "{p} {n}");
            }
        };
        let pi = std::f64::consts::PI;
        about(Shape::Box(DVec3::new(1.0, 2.0, 3.0)), 6.0);
        about(Shape::Cylinder { radius: 0.5, length: 2.0 }, pi * 0.5);
        about(Shape::Sphere(0.5), pi / 6.0);
        about(Shape::Capsule { radius: 0.5, length: 2.0 }, pi / 6.0 + pi * 0.5);
    }

    #[test]
    fn a_mirrored_mesh_still_faces_outward() {
        let cube = std::sync::Arc::new(Solid::cuboid(DVec3::ONE, UNPAINTED));
        let mirrored = Shape::Mesh {
            file: "cube.stl".to_owned(),
            scale: DVec3::new(-2.0, 1.0, 1.0),
            solid: Some(cube.clone()),
        };
        assert!((volume(&visual(mirrored).solid()) - 2.0).abs() < 1e-6);
    }

    #[test]
    fn a_missing_mesh_has_a_stand_in() {
        let shape = Shape::Mesh { file: "lost.stl".to_owned(), scale: DVec3::ONE, solid: None };
        let solid = visual(shape).solid();
        assert_eq!((solid.indices.len(), solid.colors[0]), (36, STAND_IN));
    }
}
