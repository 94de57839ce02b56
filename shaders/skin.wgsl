// Linear blend skinning. CPU twin: `skin_positions` and `skin_normals` in crates/rig/src/skin.rs.
// `Figure` is the twin of `FigureUniform` in crates/render/src/uniforms.rs.

struct Figure {
    palette: array<mat3x4<f32>, 64>,
    world_from_figure: mat4x4<f32>,
    // Bits by bone.
    selected: vec2<u32>,
    hovered: vec2<u32>,
    // x: opacity.
    look: vec4<f32>,
}

@group(1) @binding(0) var<uniform> figure: Figure;

struct SkinVertex {
    @location(0) position: vec3<f32>,
    @location(1) joints: vec4<u32>,
    @location(2) weights: vec4<f32>,
}

struct SurfaceVertex {
    @location(3) normal: vec3<f32>,
    @location(4) color: vec4<f32>,
}

// A column of `mat3x4` holds a row of the affine matrix, so points multiply from the left.
fn skin_matrix(joints: vec4<u32>, weights: vec4<f32>) -> mat3x4<f32> {
    return figure.palette[joints.x] * weights.x + figure.palette[joints.y] * weights.y
        + figure.palette[joints.z] * weights.z + figure.palette[joints.w] * weights.w;
}

fn world_position(in: SkinVertex) -> vec3<f32> {
    let posed = vec4(in.position, 1.0) * skin_matrix(in.joints, in.weights);
    return (figure.world_from_figure * vec4(posed, 1.0)).xyz;
}

fn bit_of(mask: vec2<u32>, bone: u32) -> f32 {
    return f32((select(mask.x, mask.y, bone >= 32u) >> (bone & 31u)) & 1u);
}

// How much of a vertex belongs to the marked bones.
fn share(mask: vec2<u32>, joints: vec4<u32>, weights: vec4<f32>) -> f32 {
    // Mostly nothing is marked, and all vertices agree about that.
    if (mask.x | mask.y) == 0u {
        return 0.0;
    }
    return dot(weights, vec4(bit_of(mask, joints.x), bit_of(mask, joints.y),
        bit_of(mask, joints.z), bit_of(mask, joints.w)));
}
