//! The half mesh, its mirror image and the eyes as one skinned mesh.

use glam::DVec3;
use rig::{Bone, Mesh, Skeleton};

use super::eyes;
use super::field::{Field, Lookup};
use super::nets::{Surface, polygonize};
use super::paint;
use super::relax::relax;
use super::remesh::Remesh;
use super::shape::Bounds;
use super::weights::{Weigher, half_shares, rounded};

/// One vertex of the left half.
struct Vertex {
    place: DVec3,
    normal: DVec3,
    color: DVec3,
    joints: [u8; 4],
    weights: [u16; 4],
}

/// The skin of a field on its skeleton, whole or (to judge a part quickly) within a box; `size` is the wanted edge
/// length at a point of given curvature (1/m).
pub fn mesh(
    field: &Field,
    skeleton: &Skeleton,
    within: Option<&Bounds>,
    size: impl Fn(DVec3, f64) -> f64,
) -> anyhow::Result<Mesh> {
    let (net, lookup) = polygonize(field, within);
    let half = Remesh::new(&net, &lookup, size).finish(4);
    let mut mesh = Mesh::default();
    add_twice(&mut mesh, &half.triangles, &skin(&half, &lookup, skeleton)?);
    let seen = |p: &DVec3| within.is_none_or(|b| b.gap(&Bounds { low: *p, high: *p }) <= 0.0);
    if let Some((ball, normals, colors)) = eyes::left(skeleton).filter(|e| e.0.points.iter().all(seen)) {
        let vertex = |i: usize| Vertex {
            place: ball.points[i],
            normal: normals[i],
            color: colors[i],
            joints: [Bone::LeftEye.index() as u8, 0, 0, 0],
            weights: [u16::MAX, 0, 0, 0],
        };
        let vertices: Vec<Vertex> = (0..ball.points.len()).map(vertex).collect();
        add_twice(&mut mesh, &ball.triangles, &vertices);
    }
    Ok(mesh)
}

fn skin(half: &Surface, lookup: &Lookup<'_>, skeleton: &Skeleton) -> anyhow::Result<Vec<Vertex>> {
    let mut shares = half_shares(half, &Weigher::new(skeleton, lookup.field));
    let upright = |(place, face): (&DVec3, DVec3)| {
        // In a crease the field has no one slope; there the triangles decide.
        let slope = lookup.normal(*place);
        if slope.dot(face) > 0.5 { slope } else { face }
    };
    let mut normals: Vec<DVec3> = half.points.iter().zip(face_normals(half)).map(upright).collect();
    lean(half, &mut normals);
    relax(half, &normals, skeleton, &mut shares)?.tell();
    Ok(half
        .points
        .iter()
        .zip(&shares)
        .zip(normals)
        .map(|((&place, shares), normal)| {
            let (joints, weights) = rounded(shares, skeleton, place);
            Vertex { place, normal, color: paint::skin(skeleton, lookup, place, normal), joints, weights }
        })
        .collect())
}

/// The mean normal of the triangles around each vertex, on the middle plane with those of the mirror image.
fn face_normals(half: &Surface) -> Vec<DVec3> {
    let mut sums = vec![DVec3::ZERO; half.points.len()];
    for triangle in &half.triangles {
        let [a, b, c] = triangle.map(|v| half.points[v as usize]);
        let face = (b - a).cross(c - a);
        triangle.iter().for_each(|&v| sums[v as usize] += face);
    }
    for (sum, place) in sums.iter_mut().zip(&half.points) {
        if place.x == 0.0 {
            sum.x = 0.0;
        }
        *sum = sum.normalize_or(DVec3::Y);
    }
    sums
}

/// Leans normals over until each triangle faces the way that its corners do: in the lids' corners neither the field nor
/// the mean of the triangles around knows.
fn lean(half: &Surface, normals: &mut [DVec3]) {
    for _ in 0..60 {
        let mut settled = true;
        for triangle in &half.triangles {
            let [a, b, c] = triangle.map(|v| half.points[v as usize]);
            let face = (b - a).cross(c - a).normalize_or_zero();
            let sum: DVec3 = triangle.iter().map(|&v| normals[v as usize]).sum();
            if face.dot(sum) >= 0.1 {
                continue;
            }
            settled = false;
            for &v in triangle {
                let v = v as usize;
                let mut leant = normals[v] + 0.25 * face;
                if half.points[v].x == 0.0 {
                    leant.x = 0.0;
                }
                normals[v] = leant.normalize_or(normals[v]);
            }
        }
        if settled {
            return;
        }
    }
}

/// Adds the left half and its mirror image; vertices on the middle plane serve both.
fn add_twice(mesh: &mut Mesh, triangles: &[[u32; 3]], half: &[Vertex]) {
    let first = mesh.positions.len() as u32;
    half.iter().for_each(|v| push(mesh, v, false));
    let mut twin = Vec::with_capacity(half.len());
    for (i, vertex) in half.iter().enumerate() {
        if vertex.place.x == 0.0 {
            twin.push(first + i as u32);
        } else {
            twin.push(mesh.positions.len() as u32);
            push(mesh, vertex, true);
        }
    }
    for [a, b, c] in triangles {
        mesh.indices.extend([first + a, first + b, first + c]);
        mesh.indices.extend([a, c, b].map(|v| twin[*v as usize]));
    }
}

fn push(mesh: &mut Mesh, vertex: &Vertex, mirrored: bool) {
    let side = |v: DVec3| if mirrored { DVec3::new(-v.x, v.y, v.z) } else { v };
    mesh.positions.push(side(vertex.place).as_vec3().to_array());
    mesh.normals.push(side(vertex.normal).as_vec3().normalize().to_array());
    mesh.colors.push(vertex.color.as_vec3().to_array());
    let bone = |b: u8| Bone::ALL[usize::from(b)].mirrored().index() as u8;
    let used = |(b, w): (u8, u16)| if mirrored && w > 0 { bone(b) } else { b };
    mesh.joints.push(std::array::from_fn(|i| used((vertex.joints[i], vertex.weights[i]))));
    mesh.weights.push(vertex.weights);
}
