//! The mannequin's skin made light for crowds.
#![allow(clippy::unwrap_used)]

use glam::Vec3;
use rig::{Bounds, Mesh, simplified};

fn bounds(mesh: &Mesh) -> Bounds {
    Bounds::of(mesh.positions.iter().map(|p| Vec3::from(*p)))
}

/// By triangle: twice its area over the square of its longest edge, below 0 if it is turned away from its vertices' normals.
fn fatness(mesh: &Mesh) -> impl Iterator<Item = f32> {
    mesh.indices.chunks_exact(3).map(|triangle| {
        let [a, b, c] = [0, 1, 2].map(|k: usize| Vec3::from(mesh.positions[triangle[k] as usize]));
        let outward: Vec3 = triangle.iter().map(|i| Vec3::from(mesh.normals[*i as usize])).sum();
        let across = (b - a).cross(c - a);
        let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
        across.dot(outward).signum() * across.length() / longest
    })
}

#[test]
fn the_light_mannequin_is_as_large_and_no_triangle_is_turned_over_or_nothing() {
    let mannequin = interchange::figure::mannequin().unwrap().skin.unwrap();
    let whole = bounds(&mannequin);
    // Some slivers between the lips are the mannequin's own.
    let slivers = fatness(&mannequin).filter(|fatness| *fatness < 0.02).count();
    for vertices in [6000, 1500, 700] {
        let light = simplified(&mannequin, vertices);
        assert_eq!(light.fault(), None, "weights sum, indices are vertices");
        let count = light.vertex_count();
        assert!(count <= vertices && count + 2 >= vertices, "{count} vertices of {vertices}");
        let seen = bounds(&light);
        assert!(seen.min.distance(whole.min) < 0.01 && seen.max.distance(whole.max) < 0.01, "{seen:?}");
        let left = fatness(&light).filter(|fatness| *fatness < 0.02).count();
        let least = fatness(&light).fold(f32::MAX, f32::min);
        assert!(
            left <= slivers && least > 0.0,
            "{vertices}: {left} of {slivers} slivers, the thinnest {least}"
        );
    }
}
