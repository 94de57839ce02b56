// The finished picture into a rectangle of any pass.

@group(0) @binding(0) var picture: texture_2d<f32>;
@group(0) @binding(1) var picture_sampler: sampler;

struct Spot {
    @builtin(position) clip: vec4<f32>,
    @location(0) at: vec2<f32>,
}

@vertex
fn vs_blit(@builtin(vertex_index) index: u32) -> Spot {
    let at = vec2(f32(index & 1u), f32(index >> 1u));
    return Spot(vec4(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, 0.0, 1.0), at);
}

@fragment
fn fs_same(in: Spot) -> @location(0) vec4<f32> {
    return textureSampleLevel(picture, picture_sampler, in.at, 0.0);
}

// The target encodes what it gets: give it light.
@fragment
fn fs_decode(in: Spot) -> @location(0) vec4<f32> {
    let c = textureSampleLevel(picture, picture_sampler, in.at, 0.0);
    let low = c.rgb / 12.92;
    let high = pow((c.rgb + 0.055) / 1.055, vec3(2.4));
    return vec4(select(high, low, c.rgb <= vec3(0.04045)), c.a);
}
