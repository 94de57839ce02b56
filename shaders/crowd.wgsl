// Crowds: many figures of one skin in one draw, each figure's matrices from a buffer. Follows figure.wgsl, which paints
// them. `Crowd` is the twin of `CrowdUniform` in crates/render/src/crowd.rs.

struct Crowd {
    // Figures abreast in a block of the buffer.
    lanes: u32,
    // Matrices of a figure.
    rows: u32,
    seed: u32,
    // How much colours differ from figure to figure: 0 not at all, 1 as people's clothes do.
    variety: f32,
}

// Blocks of figures abreast; in a block by place, then by number of the matrix (three columns of the turn, then the
// shift), then by figure. World from rest.
@group(1) @binding(1) var<storage, read> matrices: array<f32>;
@group(1) @binding(2) var<uniform> crowd: Crowd;

// What a place does to a point, in rows, as much as it weighs.
fn motion(walker: u32, place: u32, weight: f32) -> mat3x4<f32> {
    let n = crowd.lanes;
    let at = ((walker / n) * crowd.rows + place) * 12u * n + walker % n;
    return mat3x4(
        vec4(matrices[at], matrices[at + 3u * n], matrices[at + 6u * n], matrices[at + 9u * n]) * weight,
        vec4(matrices[at + n], matrices[at + 4u * n], matrices[at + 7u * n], matrices[at + 10u * n]) * weight,
        vec4(matrices[at + 2u * n], matrices[at + 5u * n], matrices[at + 8u * n], matrices[at + 11u * n]) * weight,
    );
}

// Linear blending: enough where joints bend as walking bends them, and twist is spread over its places.
fn blended(walker: u32, joints: vec4<u32>, weights: vec4<f32>) -> mat3x4<f32> {
    return motion(walker, joints.x, weights.x) + motion(walker, joints.y, weights.y)
        + motion(walker, joints.z, weights.z) + motion(walker, joints.w, weights.w);
}

// Three numbers in 0 to 1 that look random, from a figure's number (PCG hash in three dimensions).
fn rolled(walker: u32) -> vec3<f32> {
    var v = vec3(walker, crowd.seed, 0x9E3779B9u) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v = v ^ (v >> vec3(16u));
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return vec3<f32>(v >> vec3(8u)) / 16777216.0;
}

// A colour of the figure's own: lighter or darker, and toward some hue.
fn varied(color: vec3<f32>, walker: u32) -> vec3<f32> {
    if crowd.variety == 0.0 {
        return color;
    }
    let roll = rolled(walker);
    let hue = 0.5 + 0.5 * cos(6.2831853 * (roll.x + vec3(0.0, 0.33, 0.67)));
    let tint = mix(vec3(1.0), 0.35 + 0.9 * hue, (0.08 + 0.42 * roll.y) * crowd.variety);
    return color * tint * mix(1.0, 0.55 + 0.75 * roll.z, crowd.variety);
}

fn walking(walker: u32, skin: SkinVertex, surface: SurfaceVertex) -> Surface {
    let m = blended(walker, skin.joints, skin.weights);
    var out: Surface;
    out.world = vec4(skin.position, 1.0) * m;
    out.clip = scene.clip_from_world * vec4(out.world, 1.0);
    out.normal = vec4(surface.normal, 0.0) * m;
    out.color = varied(surface.color.rgb, walker);
    return out;
}

@vertex
fn vs_crowd(skin: SkinVertex, surface: SurfaceVertex, @builtin(instance_index) walker: u32) -> Surface {
    return walking(walker, skin, surface);
}

@vertex
fn vs_crowd_part(
    skin: SkinVertex,
    surface: SurfaceVertex,
    part: PartVertex,
    @builtin(instance_index) walker: u32,
) -> PartSurface {
    let s = walking(walker, skin, surface);
    return PartSurface(s.clip, s.world, s.normal, s.color, s.marks, skin.position, part.border, part.part);
}

@vertex
fn vs_crowd_shadow(skin: SkinVertex, @builtin(instance_index) walker: u32) -> @builtin(position) vec4<f32> {
    let world = vec4(skin.position, 1.0) * blended(walker, skin.joints, skin.weights);
    let at = (scene.shadow_from_world * vec4(world, 1.0)).xyz;
    return vec4(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, at.z, 1.0);
}
