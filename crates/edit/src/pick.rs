//! Picking: what part of the posed skin a ray meets.

use glam::{DVec3, Vec3};
use rig::{Bone, Bounds, Frames, Mesh, Palette, Ray, SkinBounds, bone_of_place, skin_position};

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
    /// The bones that move any of its vertices.
    bones: Vec<Bone>,
    /// What holds its vertices in any pose.
    bounds: SkinBounds,
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

/// The place of the skin nearest to a point.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Near {
    /// The bone that moves this place of the skin most.
    pub bone: Bone,
    /// Metres, world.
    pub point_in_world: DVec3,
    /// Unit normal of the triangle, outward, world.
    pub normal_in_world: DVec3,
    /// Metres from the skin to the point; negative inside the body.
    pub height_m: f64,
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
        self.pick_of(mesh, palette, frames, ray, |_| true)
    }

    /// As [`SkinPicker::pick`] for the skin of some bones: what others move most lets the ray through.
    pub fn pick_of(
        &self,
        mesh: &Mesh,
        palette: &Palette,
        frames: &Frames,
        ray: Ray,
        counts: impl Fn(Bone) -> bool,
    ) -> Option<Hit> {
        let mut nearest: Option<Meeting> = None;
        for chunk in self.chunks.iter().filter(|chunk| chunk.has(&counts)) {
            let limit = nearest.as_ref().map_or(f32::INFINITY, |m| m.distance);
            if chunk.meets(palette, ray, limit) {
                let found = chunk.triangles.iter().filter_map(|&at| meeting(mesh, palette, ray, at as usize));
                let found = found.filter(|m| counts(strongest(mesh, m.at, m.shares)));
                nearest = found.chain(nearest).min_by(|a, b| a.distance.total_cmp(&b.distance));
            }
        }
        nearest.map(|meeting| meeting.hit(mesh, frames, ray))
    }

    /// The point of the skin of some bones that is nearest to a point of the palette's space; `None` if none is
    /// within a distance, metres.
    pub fn nearest_of(
        &self,
        mesh: &Mesh,
        palette: &Palette,
        point: DVec3,
        within_m: f64,
        counts: impl Fn(Bone) -> bool,
    ) -> Option<Near> {
        let point = point.as_vec3();
        let (mut nearest, mut limit): (Option<Near>, f32) = (None, within_m as f32);
        for chunk in self.chunks.iter().filter(|chunk| chunk.has(&counts)) {
            if chunk.distance(palette, point) > limit {
                continue;
            }
            for &at in &chunk.triangles {
                let Some(near) = near(mesh, palette, point, at as usize, limit) else { continue };
                if counts(near.bone) {
                    limit = near.height_m.abs() as f32;
                    nearest = Some(near);
                }
            }
        }
        nearest
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
        let mut vertices: Vec<usize> = triangles.iter().flat_map(|&at| corners(mesh, at as usize)).collect();
        vertices.sort_unstable();
        vertices.dedup();
        let influences = vertices.iter().flat_map(|&v| mesh.joints[v].into_iter().zip(mesh.weights[v]));
        let used = influences.filter(|(_, weight)| *weight > 0);
        let mut bones: Vec<Bone> = used.map(|(place, _)| bone_of_place(usize::from(place))).collect();
        bones.sort_unstable();
        bones.dedup();
        let mut triangles = triangles.to_vec();
        triangles.sort_unstable();
        Chunk { triangles, bones, bounds: SkinBounds::of(mesh, vertices.iter().copied()) }
    }

    /// Whether the ray may meet the chunk nearer than a limit.
    fn meets(&self, palette: &Palette, ray: Ray, limit: f32) -> bool {
        enters(self.bounds.posed(palette), ray).is_some_and(|distance| distance <= limit)
    }

    /// Whether any of its skin may be moved most by a bone that counts.
    fn has(&self, counts: impl Fn(Bone) -> bool) -> bool {
        self.bones.iter().any(|bone| counts(*bone))
    }

    /// No more than the distance from a point to the posed chunk, metres.
    fn distance(&self, palette: &Palette, point: Vec3) -> f32 {
        let bounds = self.bounds.posed(palette);
        point.distance(point.max(bounds.min).min(bounds.max))
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

/// The bone that moves a place of a triangle most, given the weights of its corners there.
fn strongest(mesh: &Mesh, at: usize, shares: [f32; 3]) -> Bone {
    let mut pull = [0.0f32; Bone::COUNT];
    for (vertex, share) in corners(mesh, at).into_iter().zip(shares) {
        for (joint, weight) in mesh.joints[vertex].into_iter().zip(mesh.weights[vertex]) {
            pull[bone_of_place(usize::from(joint)).index()] += share * f32::from(weight);
        }
    }
    Bone::ALL[(0..Bone::COUNT).max_by(|&a, &b| pull[a].total_cmp(&pull[b])).unwrap_or(0)]
}

impl Meeting {
    fn hit(&self, mesh: &Mesh, frames: &Frames, ray: Ray) -> Hit {
        let bone = strongest(mesh, self.at, self.shares);
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

/// The place of one posed triangle nearest to a point, if it is nearer than a limit, metres.
fn near(mesh: &Mesh, palette: &Palette, point: Vec3, at: usize, limit: f32) -> Option<Near> {
    let triangle = corners(mesh, at).map(|v| skin_position(mesh, palette, v));
    let shares = nearest_shares(triangle, point);
    let place = triangle.iter().zip(shares).map(|(corner, share)| *corner * share).sum::<Vec3>();
    let distance = place.distance(point);
    if distance.is_nan() || distance >= limit {
        return None;
    }
    let [a, b, c] = triangle;
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let sign = if (point - place).dot(normal) < 0.0 { -1.0 } else { 1.0 };
    Some(Near {
        bone: strongest(mesh, at, shares),
        point_in_world: place.as_dvec3(),
        normal_in_world: normal.as_dvec3(),
        height_m: sign * f64::from(distance),
    })
}

/// The weights of a triangle's corners at its place nearest to a point. Source: `rtcd`, 5.1.5.
fn nearest_shares([a, b, c]: [Vec3; 3], point: Vec3) -> [f32; 3] {
    let (ab, ac) = (b - a, c - a);
    let along = |corner: Vec3| (ab.dot(point - corner), ac.dot(point - corner));
    let ((d1, d2), (d3, d4), (d5, d6)) = (along(a), along(b), along(c));
    let (of_a, of_b, of_c) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
    if d1 <= 0.0 && d2 <= 0.0 {
        [1.0, 0.0, 0.0]
    } else if d3 >= 0.0 && d4 <= d3 {
        [0.0, 1.0, 0.0]
    } else if d6 >= 0.0 && d5 <= d6 {
        [0.0, 0.0, 1.0]
    } else if of_c <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        let v = d1 / (d1 - d3);
        [1.0 - v, v, 0.0]
    } else if of_b <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        let w = d2 / (d2 - d6);
        [1.0 - w, 0.0, w]
    } else if of_a <= 0.0 && d4 >= d3 && d5 >= d6 {
        let w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        [0.0, 1.0 - w, w]
    } else {
        let whole = of_a + of_b + of_c;
        [of_a / whole, of_b / whole, of_c / whole]
    }
}
