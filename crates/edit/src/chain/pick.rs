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
}

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
                    links.resize(link + 1, Shape { triangles: Vec::new(), bounds: Bounds::EMPTY });
                }
                let triangle = [place(corners[0]), place(corners[1]), place(corners[2])];
                links[link].bounds = triangle.into_iter().fold(links[link].bounds, Bounds::with);
                links[link].triangles.push(triangle);
            }
        }
        LinkPicker { links }
    }

    /// Whether anything is seen of a link.
    pub fn shows(&self, link: usize) -> bool {
        self.links.get(link).is_some_and(|shape| !shape.triangles.is_empty())
    }

    /// The corners of what is seen of a link, in its frame, metres; some of them twice.
    pub fn corners(&self, link: usize) -> impl Iterator<Item = DVec3> + '_ {
        let triangles = self.links.get(link).into_iter().flat_map(|shape| &shape.triangles);
        triangles.flatten().map(|corner| corner.as_dvec3())
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
