// Dual quaternion skinning. CPU twin: `skin_positions` and `skin_normals` in crates/rig/src/skin.rs.
// `Figure` is the twin of `FigureUniform` in crates/render/src/uniforms.rs.

struct DualQuaternion {
    real: vec4<f32>,
    dual: vec4<f32>,
}

struct Figure {
    // By place: the bones, then the twist places. Signs are settled, so that they can be summed as they are.
    palette: array<DualQuaternion, 64>,
    world_from_figure: mat4x4<f32>,
    // Bits by place.
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

// The matrix of the blended motion. A column of `mat3x4` holds a row of it, so points multiply from the left.
fn skin_matrix(joints: vec4<u32>, weights: vec4<f32>) -> mat3x4<f32> {
    let r = figure.palette[joints.x].real * weights.x + figure.palette[joints.y].real * weights.y
        + figure.palette[joints.z].real * weights.z + figure.palette[joints.w].real * weights.w;
    let d = figure.palette[joints.x].dual * weights.x + figure.palette[joints.y].dual * weights.y
        + figure.palette[joints.z].dual * weights.z + figure.palette[joints.w].dual * weights.w;
    let scale = 2.0 / max(dot(r, r), 1e-30);
    let s = r * scale;
    let shift = s.w * d.xyz - s.xyz * d.w + cross(s.xyz, d.xyz);
    let square = r.xyz * s.xyz;
    let mixed = r.xyz * s.yzx;
    let turn = s.xyz * r.w;
    return mat3x4(
        vec4(1.0 - square.y - square.z, mixed.x - turn.z, mixed.z + turn.y, shift.x),
        vec4(mixed.x + turn.z, 1.0 - square.x - square.z, mixed.y - turn.x, shift.y),
        vec4(mixed.z - turn.y, mixed.y + turn.x, 1.0 - square.x - square.y, shift.z),
    );
}

fn world_position(in: SkinVertex) -> vec3<f32> {
    let posed = vec4(in.position, 1.0) * skin_matrix(in.joints, in.weights);
    return (figure.world_from_figure * vec4(posed, 1.0)).xyz;
}

fn bit_of(mask: vec2<u32>, place: u32) -> f32 {
    return f32((select(mask.x, mask.y, place >= 32u) >> (place & 31u)) & 1u);
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
