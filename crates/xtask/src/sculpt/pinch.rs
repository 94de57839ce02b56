//! How much of its area each triangle keeps in a pose, and how that changes with the shares of its corners.

use glam::{DVec3, DVec4};
use rig::{Bone, Mesh, PALETTE_LEN, Palette, Skeleton, spread_twist};

use super::nets::Surface;

/// A motion as the skin blends it: the real and the dual part.
#[derive(Clone, Copy)]
struct Motion(DVec4, DVec4);

impl Motion {
    fn plus(self, other: Motion, weight: f64) -> Motion {
        Motion(self.0 + other.0 * weight, self.1 + other.1 * weight)
    }

    fn moved(self, point: DVec3, normal: DVec3) -> Corner {
        let Motion(real, dual) = self;
        let (r, d, w) = (real.truncate(), dual.truncate(), real.w);
        let scale = 2.0 / real.length_squared().max(1e-30);
        Corner {
            point: point + (r.cross(r.cross(point) + point * w + d) + d * w - r * dual.w) * scale,
            normal: normal + r.cross(r.cross(normal) + normal * w) * scale,
        }
    }
}

/// A posed vertex.
#[derive(Clone, Copy)]
struct Corner {
    point: DVec3,
    normal: DVec3,
}

/// A step of the derivatives' differences.
const STEP: f64 = 1e-4;

/// A half mesh at rest, and where its twisting bones' places are.
pub struct Pinches<'a> {
    half: &'a Surface,
    normals: &'a [DVec3],
    /// By triangle, at rest, square metres.
    areas: Vec<f64>,
    /// By bone and vertex: the near and the far place and the share of the far one; nothing where a bone has but one.
    places: Vec<Vec<(u8, u8, f64)>>,
}

/// A triangle that a pose squeezes.
#[derive(Clone, Copy)]
pub struct Pinch {
    /// The triangle.
    pub triangle: u32,
    /// The pose, as the caller counts.
    pub pose: u32,
    /// What is left of its area as seen along its normals; below 0 it is turned.
    pub left: f64,
}

impl<'a> Pinches<'a> {
    /// Of a half mesh and its normals on a skeleton; `bare` is the same without weights.
    pub fn new(half: &'a Surface, normals: &'a [DVec3], bare: &Mesh, skeleton: &Skeleton) -> Pinches<'a> {
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| half.points[v as usize]);
            0.5 * (b - a).cross(c - a).length()
        };
        let twisted = |bone: Bone| {
            let own = bone.index() as u8;
            let mut probe = bare.clone();
            probe.joints = vec![[own, 0, 0, 0]; half.points.len()];
            probe.weights = vec![[u16::MAX, 0, 0, 0]; half.points.len()];
            spread_twist(&mut probe, skeleton);
            let place = |(joints, weights): (&[u8; 4], &[u16; 4])| {
                if weights[1] == 0 {
                    (joints[0], joints[0], 0.0)
                } else {
                    (joints[0], joints[1], f64::from(weights[1]) / 65535.0)
                }
            };
            let rows = || probe.joints.iter().zip(&probe.weights);
            let one = rows().all(|(joints, weights)| joints[0] == own && weights[1] == 0);
            if one { Vec::new() } else { rows().map(place).collect() }
        };
        let places = Bone::ALL.into_iter().map(twisted).collect();
        Pinches { half, normals, areas: half.triangles.iter().map(area).collect(), places }
    }

    fn seen(&self, triangle: u32, [a, b, c]: &[Corner; 3]) -> f64 {
        let face = 0.5 * (b.point - a.point).cross(c.point - a.point);
        face.dot((a.normal + b.normal + c.normal).normalize_or_zero())
            / self.areas[triangle as usize].max(1e-12)
    }

    fn blend(mesh: &Mesh, motions: &[Motion], v: usize) -> Motion {
        let parts = mesh.joints[v].iter().zip(mesh.weights[v]);
        let nothing = Motion(DVec4::ZERO, DVec4::ZERO);
        parts.fold(nothing, |sum, (place, weight)| {
            sum.plus(motions[usize::from(*place)], f64::from(weight) / 65535.0)
        })
    }

    /// The triangles of a weighted mesh of which a pose leaves less than a part of their area.
    pub fn find(&self, mesh: &Mesh, palette: &Palette, pose: usize, least: f64) -> Vec<Pinch> {
        let motions = motions(palette);
        let moved: [bool; PALETTE_LEN] = std::array::from_fn(|i| palette.0[i] != Palette::REST.0[i]);
        // What a vertex follows, if it is one place alone; beyond the last where the pose leaves it.
        let follows = |v: usize| {
            let mut parts = mesh.joints[v].iter().zip(mesh.weights[v]);
            let stays = parts.all(|(place, weight)| weight == 0 || !moved[usize::from(*place)]);
            let alone = mesh.weights[v][0] == u16::MAX;
            if stays { Some(PALETTE_LEN as u8) } else { alone.then_some(mesh.joints[v][0]) }
        };
        let follows: Vec<Option<u8>> = (0..self.half.points.len()).map(follows).collect();
        let mut corners: Vec<Option<Corner>> = vec![None; follows.len()];
        let mut all = Vec::new();
        for (t, triangle) in self.half.triangles.iter().enumerate() {
            let own = triangle.map(|v| follows[v as usize]);
            if own[0].is_some() && own[0] == own[1] && own[1] == own[2] {
                continue;
            }
            let own = triangle.map(|v| {
                let v = v as usize;
                let posed = || Pinches::blend(mesh, &motions, v).moved(self.half.points[v], self.normals[v]);
                *corners[v].get_or_insert_with(posed)
            });
            let left = self.seen(t as u32, &own);
            if left < least {
                all.push(Pinch { triangle: t as u32, pose: pose as u32, left });
            }
        }
        all
    }

    /// How what is left of a triangle changes with the shares of its corners: vertex, bone, slope. Shares need not sum to
    /// 1 for that, as their blend is the same times any factor. `bones` tells which bones a vertex may follow.
    pub fn slopes(
        &self,
        mesh: &Mesh,
        palette: &Palette,
        pinch: Pinch,
        bones: impl Fn(usize) -> Vec<Bone>,
    ) -> Vec<(u32, Bone, f64)> {
        let motions = motions(palette);
        let triangle = self.half.triangles[pinch.triangle as usize];
        let blends = triangle.map(|v| Pinches::blend(mesh, &motions, v as usize));
        let moved = |i: usize, blend: Motion| {
            let v = triangle[i] as usize;
            blend.moved(self.half.points[v], self.normals[v])
        };
        let corners: [Corner; 3] = std::array::from_fn(|i| moved(i, blends[i]));
        let left = self.seen(pinch.triangle, &corners);
        let mut all = Vec::new();
        for (i, v) in triangle.into_iter().enumerate() {
            let slope = |bone: Bone| {
                let mut other = corners;
                other[i] = moved(i, blends[i].plus(self.motion(&motions, bone, v as usize), STEP));
                (self.seen(pinch.triangle, &other) - left) / STEP
            };
            all.extend(centred(v, bones(v as usize).into_iter().map(|b| (b, slope(b))).collect()));
        }
        all
    }

    /// Where a pose takes each vertex of a weighted mesh.
    pub fn posed(&self, mesh: &Mesh, palette: &Palette) -> Vec<DVec3> {
        let motions = motions(palette);
        let place = |v: usize| Pinches::blend(mesh, &motions, v).moved(self.half.points[v], DVec3::Y).point;
        (0..self.half.points.len()).map(place).collect()
    }

    /// How far the shares of vertices drive them along what pulls each of them: vertex, bone, slope, as [`Pinches::slopes`].
    pub fn drifts(
        &self,
        mesh: &Mesh,
        palette: &Palette,
        pulls: &[(u32, DVec3)],
        bones: impl Fn(usize) -> Vec<Bone>,
    ) -> Vec<(u32, Bone, f64)> {
        let motions = motions(palette);
        let mut all = Vec::new();
        for &(vertex, pull) in pulls {
            let v = vertex as usize;
            let blend = Pinches::blend(mesh, &motions, v);
            let along = |blend: Motion| blend.moved(self.half.points[v], self.normals[v]).point.dot(pull);
            let slope =
                |bone: Bone| (along(blend.plus(self.motion(&motions, bone, v), STEP)) - along(blend)) / STEP;
            all.extend(centred(vertex, bones(v).into_iter().map(|b| (b, slope(b))).collect()));
        }
        all
    }

    fn motion(&self, motions: &[Motion], bone: Bone, v: usize) -> Motion {
        match self.places[bone.index()].get(v) {
            None => motions[bone.index()],
            Some(&(near, far, part)) => {
                let nothing = Motion(DVec4::ZERO, DVec4::ZERO);
                nothing.plus(motions[usize::from(near)], 1.0 - part).plus(motions[usize::from(far)], part)
            }
        }
    }
}

/// A vertex's slopes without their mean: what one bone's share gains the others lose.
fn centred(v: u32, slopes: Vec<(Bone, f64)>) -> impl Iterator<Item = (u32, Bone, f64)> {
    let mean = slopes.iter().map(|o| o.1).sum::<f64>() / slopes.len().max(1) as f64;
    slopes.into_iter().map(move |(bone, slope)| (v, bone, slope - mean))
}

fn motions(palette: &Palette) -> Vec<Motion> {
    let wide = |part: [f32; 4]| DVec4::from(part.map(f64::from));
    palette.0.iter().map(|[real, dual]| Motion(wide(*real), wide(*dual))).collect()
}
