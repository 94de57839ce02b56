//! Picking: what part of the posed skin a ray meets.

use glam::{DVec3, Vec3};
use rig::{Bone, Bounds, Frames, Mesh, Palette, Ray, skin_position};

/// Triangles in one chunk: enough that a box test is worth it, few enough that a hit chunk is skinned quickly.
const CHUNK: usize = 128;

/// A skin cut into chunks that are near in space and move alike, so that a ray skins only those it may meet.
#[derive(Clone, Debug)]
pub struct SkinPicker {
    chunks: Vec<Chunk>,
}

#[derive(Clone, Debug)]
struct Chunk {
    /// First numbers of the triangles in the mesh's indices.
    triangles: Vec<u32>,
    /// Per bone that moves any of its vertices: the box of those vertices at rest.
    boxes: Vec<(Bone, Bounds)>,
}

/// Where a ray meets the skin.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Hit {
    /// The bone that moves this point of the skin most.
    pub bone: Bone,
    /// Metres, world.
    pub point_in_world: DVec3,
    /// The same in the bone's joint frame, metres.
    pub point_in_bone: DVec3,
    /// Unit normal of the triangle, outward, world.
    pub normal_in_world: DVec3,
    /// Metres along the ray.
    pub distance: f64,
}

impl SkinPicker {
    /// Cuts a mesh into chunks. A mesh with a [`Mesh::fault`] has none.
    pub fn new(mesh: &Mesh) -> SkinPicker {
        if mesh.fault().is_some() {
            return SkinPicker { chunks: Vec::new() };
        }
        let mut triangles: Vec<u32> = (0..mesh.indices.len() as u32).step_by(3).collect();
        let mut chunks = Vec::new();
        split(mesh, &mut triangles, &mut chunks);
        SkinPicker { chunks }
    }

    /// The nearest point of the skin that a ray in the palette's space meets from outside; `frames` are those that
    /// the palette was made from.
    pub fn pick(&self, mesh: &Mesh, palette: &Palette, frames: &Frames, ray: Ray) -> Option<Hit> {
        let mut nearest: Option<Meeting> = None;
        for chunk in &self.chunks {
            let limit = nearest.as_ref().map_or(f32::INFINITY, |m| m.distance);
            if chunk.meets(palette, ray, limit) {
                let found = chunk.triangles.iter().filter_map(|&at| meeting(mesh, palette, ray, at as usize));
                nearest = found.chain(nearest).min_by(|a, b| a.distance.total_cmp(&b.distance));
            }
        }
        nearest.map(|meeting| meeting.hit(mesh, frames, ray))
    }
}

/// Cuts triangles across the longest edge of their box until the pieces are small.
fn split(mesh: &Mesh, triangles: &mut [u32], chunks: &mut Vec<Chunk>) {
    if triangles.len() <= CHUNK {
        if !triangles.is_empty() {
            chunks.push(Chunk::new(mesh, triangles));
        }
        return;
    }
    let bounds = Bounds::of(triangles.iter().map(|&at| middle(mesh, at)));
    let size = bounds.max - bounds.min;
    let axis = (0..3).max_by(|&a, &b| size[a].total_cmp(&size[b])).unwrap_or(0);
    let half = triangles.len() / 2;
    triangles.select_nth_unstable_by(half, |&a, &b| {
        middle(mesh, a)[axis].total_cmp(&middle(mesh, b)[axis]).then(a.cmp(&b))
    });
    let (low, high) = triangles.split_at_mut(half);
    split(mesh, low, chunks);
    split(mesh, high, chunks);
}

fn corners(mesh: &Mesh, at: usize) -> [usize; 3] {
    [mesh.indices[at] as usize, mesh.indices[at + 1] as usize, mesh.indices[at + 2] as usize]
}

fn middle(mesh: &Mesh, at: u32) -> Vec3 {
    corners(mesh, at as usize).map(|v| Vec3::from_array(mesh.positions[v])).iter().sum::<Vec3>() / 3.0
}

impl Chunk {
    fn new(mesh: &Mesh, triangles: &[u32]) -> Chunk {
        let mut boxes: Vec<(Bone, Bounds)> = Vec::new();
        for vertex in triangles.iter().flat_map(|&at| corners(mesh, at as usize)) {
            let position = Vec3::from_array(mesh.positions[vertex]);
            for (joint, weight) in mesh.joints[vertex].into_iter().zip(mesh.weights[vertex]) {
                let bone = Bone::ALL[usize::from(joint)];
                match boxes.iter_mut().find(|(b, _)| *b == bone) {
                    _ if weight == 0 => {}
                    Some((_, bounds)) => *bounds = bounds.with(position),
                    None => boxes.push((bone, Bounds::EMPTY.with(position))),
                }
            }
        }
        let mut triangles = triangles.to_vec();
        triangles.sort_unstable();
        Chunk { triangles, boxes }
    }

    /// Whether the ray may meet the chunk nearer than a limit: a posed vertex lies between where its bones would take
    /// it, so the box around all boxes as posed holds the chunk.
    fn meets(&self, palette: &Palette, ray: Ray, limit: f32) -> bool {
        let posed = self.boxes.iter().flat_map(|(bone, b)| b.corners().map(|c| palette.point(*bone, c)));
        enters(Bounds::of(posed), ray).is_some_and(|distance| distance <= limit)
    }
}

/// Where a ray enters a box, metres; 0 from inside.
fn enters(bounds: Bounds, ray: Ray) -> Option<f32> {
    let (mut near, mut far) = (0.0f32, f32::INFINITY);
    for axis in 0..3 {
        let (origin, direction) = (ray.origin[axis], ray.direction[axis]);
        if direction == 0.0 {
            if origin < bounds.min[axis] || origin > bounds.max[axis] {
                return None;
            }
            continue;
        }
        let (a, b) = ((bounds.min[axis] - origin) / direction, (bounds.max[axis] - origin) / direction);
        (near, far) = (near.max(a.min(b)), far.min(a.max(b)));
    }
    (near <= far).then_some(near)
}

/// A triangle that the ray meets, with the weights of its corners at the meeting.
struct Meeting {
    at: usize,
    distance: f32,
    shares: [f32; 3],
    normal: Vec3,
}

/// Ray against one posed triangle, from its outside only.
fn meeting(mesh: &Mesh, palette: &Palette, ray: Ray, at: usize) -> Option<Meeting> {
    let [a, b, c] = corners(mesh, at).map(|v| skin_position(mesh, palette, v));
    let (ab, ac) = (b - a, c - a);
    let normal = ab.cross(ac);
    let facing = -ray.direction.dot(normal);
    if facing <= 0.0 {
        return None;
    }
    let from_a = ray.origin - a;
    let turned = from_a.cross(ray.direction);
    let (u, v) = (ac.dot(turned) / facing, -ab.dot(turned) / facing);
    let distance = from_a.dot(normal) / facing;
    let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance >= 0.0;
    inside.then(|| Meeting { at, distance, shares: [1.0 - u - v, u, v], normal: normal.normalize_or_zero() })
}

impl Meeting {
    fn hit(&self, mesh: &Mesh, frames: &Frames, ray: Ray) -> Hit {
        let mut pull = [0.0f32; Bone::COUNT];
        for (vertex, share) in corners(mesh, self.at).into_iter().zip(self.shares) {
            for (joint, weight) in mesh.joints[vertex].into_iter().zip(mesh.weights[vertex]) {
                pull[usize::from(joint)] += share * f32::from(weight);
            }
        }
        let strongest = (0..Bone::COUNT).max_by(|&a, &b| pull[a].total_cmp(&pull[b])).unwrap_or(0);
        let bone = Bone::ALL[strongest];
        let point_in_world = (ray.origin + ray.direction * self.distance).as_dvec3();
        Hit {
            bone,
            point_in_world,
            point_in_bone: frames[bone].inverse().point(point_in_world),
            normal_in_world: self.normal.as_dvec3(),
            distance: f64::from(self.distance),
        }
    }
}
