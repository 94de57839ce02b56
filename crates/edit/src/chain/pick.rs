//! Picking: which link of a chain a ray meets.

use glam::{DVec3, Vec3};
use rig::{Bone, Bounds, Frame, Ray, RobotSkin};

/// What is seen of each link, for rays.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct LinkPicker {
    links: Vec<Shape>,
}

/// Triangles in the frame of their link, and a box around them.
#[derive(Clone, PartialEq, Debug)]
struct Shape {
    triangles: Vec<[Vec3; 3]>,
    bounds: Bounds,
    /// The corners that lie farthest out in [`WAYS`] directions.
    outermost: Vec<Vec3>,
}

/// Directions in which what lies farthest out is remembered: the box around a link in a picture is then short by at most a
/// hundredth of its size.
const WAYS: u32 = 96;

/// Where a ray meets a link.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct LinkHit {
    /// The link.
    pub link: usize,
    /// Metres, world.
    pub point_in_world: DVec3,
    /// The same in the link's frame, metres.
    pub point_in_link: DVec3,
}

impl LinkPicker {
    /// Takes the looks of a robot apart by link. Meshes with a fault have nothing to be met.
    pub fn of(skin: &RobotSkin) -> LinkPicker {
        let mut links: Vec<Shape> = Vec::new();
        for (i, mesh) in skin.meshes.iter().enumerate().filter(|(_, mesh)| mesh.fault().is_none()) {
            for corners in mesh.indices.chunks_exact(3) {
                let place = |v: u32| Vec3::from_array(mesh.positions[v as usize]);
                let link = i * Bone::COUNT + usize::from(mesh.joints[corners[0] as usize][0]);
                if links.len() <= link {
                    links.resize(link + 1, Shape::default());
                }
                let triangle = [place(corners[0]), place(corners[1]), place(corners[2])];
                links[link].bounds = triangle.into_iter().fold(links[link].bounds, Bounds::with);
                links[link].triangles.push(triangle);
            }
        }
        links.iter_mut().for_each(Shape::remember_outermost);
        LinkPicker { links }
    }

    /// Whether anything is seen of a link.
    pub fn shows(&self, link: usize) -> bool {
        self.links.get(link).is_some_and(|shape| !shape.triangles.is_empty())
    }

    /// The least edge of the box around what is seen of a link in its frame, metres; 0 where nothing is.
    pub fn thickness(&self, link: usize) -> f64 {
        let shape = self.links.get(link).filter(|shape| !shape.bounds.is_empty());
        shape.map_or(0.0, |shape| f64::from((shape.bounds.max - shape.bounds.min).min_element()))
    }

    /// The corners of what is seen of a link that lie farthest out, in its frame, metres.
    pub fn outermost(&self, link: usize) -> impl Iterator<Item = DVec3> + '_ {
        let corners = self.links.get(link).into_iter().flat_map(|shape| &shape.outermost);
        corners.map(|corner| corner.as_dvec3())
    }

    /// The nearest point at which a ray of the world meets a link; `frames` are those of the links in the world.
    pub fn pick(&self, frames: &[Frame], ray: Ray) -> Option<LinkHit> {
        let (origin, direction) = (ray.origin.as_dvec3(), ray.direction.as_dvec3());
        let mut nearest: Option<(f32, LinkHit)> = None;
        for (link, (shape, frame)) in self.links.iter().zip(frames).enumerate() {
            let back = frame.rotation.conjugate();
            let own = Ray {
                origin: (back * (origin - frame.position)).as_vec3(),
                direction: (back * direction).as_vec3(),
            };
            let limit = nearest.map_or(f32::INFINITY, |(far, _)| far);
            if !meets_box(shape.bounds, own, limit) {
                continue;
            }
            let met = shape.triangles.iter().filter_map(|triangle| meets(triangle, own));
            let Some(far) = met.min_by(f32::total_cmp).filter(|far| *far < limit) else { continue };
            let point_in_link = (own.origin + own.direction * far).as_dvec3();
            let hit = LinkHit { link, point_in_world: frame.point(point_in_link), point_in_link };
            nearest = Some((far, hit));
        }
        nearest.map(|(_, hit)| hit)
    }
}

impl Default for Shape {
    fn default() -> Shape {
        Shape { triangles: Vec::new(), bounds: Bounds::EMPTY, outermost: Vec::new() }
    }
}

impl Shape {
    fn remember_outermost(&mut self) {
        let farthest = |way: Vec3| {
            let corners = self.triangles.iter().flatten().copied();
            corners.max_by(|a, b| a.dot(way).total_cmp(&b.dot(way)))
        };
        self.outermost = ways().filter_map(farthest).collect();
    }
}

/// Directions spread evenly over a sphere, along a spiral.
fn ways() -> impl Iterator<Item = Vec3> {
    let golden = std::f32::consts::PI * (3.0 - 5f32.sqrt());
    (0..WAYS).map(move |i| {
        let y = 1.0 - (2 * i + 1) as f32 / WAYS as f32;
        let (sine, cosine) = (golden * i as f32).sin_cos();
        Vec3::new(cosine, 0.0, sine) * (1.0 - y * y).sqrt() + Vec3::Y * y
    })
}

/// Whether a ray meets a box nearer than a limit. Source: `rtcd`, 5.3.3.
fn meets_box(bounds: Bounds, ray: Ray, limit: f32) -> bool {
    if bounds.is_empty() {
        return false;
    }
    let (mut near, mut far) = (0.0_f32, limit);
    for axis in 0..3 {
        let (from, rate) = (ray.origin[axis], 1.0 / ray.direction[axis]);
        let (a, b) = ((bounds.min[axis] - from) * rate, (bounds.max[axis] - from) * rate);
        // A ray within the plane of a face divides nothing by nothing: `max` and `min` leave that out.
        (near, far) = (near.max(a.min(b)), far.min(a.max(b)));
    }
    // Flat boxes have two faces in one place.
    near <= far * (1.0 + 1e-5) + 1e-6
}

/// How far along a ray it meets a triangle, from either side. Source: `rtcd`, 5.3.6.
fn meets([a, b, c]: &[Vec3; 3], ray: Ray) -> Option<f32> {
    let (ab, ac) = (b - a, c - a);
    let across = ray.direction.cross(ac);
    let volume = ab.dot(across);
    let from_a = ray.origin - a;
    let u = from_a.dot(across) / volume;
    let turned = from_a.cross(ab);
    let v = ray.direction.dot(turned) / volume;
    let far = ac.dot(turned) / volume;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && far > 0.0 && far.is_finite()).then_some(far)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_meets_a_triangle_from_either_side_and_not_beside_it() {
        let triangle = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let ray = |x: f32, y: f32, way: f32| Ray { origin: Vec3::new(x, y, -way), direction: Vec3::Z * way };
        assert_eq!(meets(&triangle, ray(0.2, 0.2, 1.0)), Some(1.0));
        assert_eq!(meets(&triangle, ray(0.2, 0.2, -1.0)), Some(1.0));
        assert_eq!(meets(&triangle, ray(0.8, 0.8, 1.0)), None);
        let beside = Ray { origin: Vec3::new(0.2, 0.2, 0.0), direction: Vec3::X };
        assert_eq!(meets(&triangle, beside), None, "within its plane");
        let flat = Bounds::of(triangle);
        assert!(
            meets_box(flat, ray(0.2, 0.2, 1.0), f32::INFINITY) && !meets_box(flat, ray(0.2, 0.2, 1.0), 0.5)
        );
        assert!(!meets_box(flat, ray(1.2, 0.2, 1.0), f32::INFINITY));
        assert!(!meets_box(Bounds::EMPTY, ray(0.0, 0.0, 1.0), f32::INFINITY));
    }

    #[test]
    fn what_lies_farthest_out_of_a_box_is_all_its_corners() {
        let corners = Bounds { min: -Vec3::ONE, max: Vec3::ONE }.corners();
        let triangles = (0..6).map(|i| [corners[i], corners[i + 1], corners[i + 2]]).collect();
        let mut shape = Shape { triangles, ..Shape::default() };
        shape.remember_outermost();
        assert!(corners.iter().all(|corner| shape.outermost.contains(corner)));
    }
}
