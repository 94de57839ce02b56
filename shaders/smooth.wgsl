// Averages the occlusion over the four by four pixels that look in different directions, not across edges.
// Follows scene.wgsl.

@group(2) @binding(0) var rough: texture_2d<f32>;

@vertex
fn vs_everywhere(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    return vec4(f32(index & 1u) * 2.0 - 1.0, f32(index >> 1u) * 2.0 - 1.0, 1.0, 1.0);
}

fn depth_of(texel: vec4<f32>) -> f32 {
    return (texel.b * 65280.0 + texel.a * 255.0) / 65535.0 * (scene.surveyed.y - scene.surveyed.x);
}

@fragment
fn fs_smooth(@builtin(position) clip: vec4<f32>) -> @location(0) vec4<f32> {
    let here = vec2<i32>(clip.xy);
    let last = vec2<i32>(textureDimensions(rough)) - 1;
    let own = textureLoad(rough, here, 0);
    let depth = depth_of(own);
    let right = depth_of(textureLoad(rough, clamp(here + vec2(1, 0), vec2(0), last), 0)) - depth;
    let left = depth - depth_of(textureLoad(rough, clamp(here - vec2(1, 0), vec2(0), last), 0));
    let down = depth_of(textureLoad(rough, clamp(here + vec2(0, 1), vec2(0), last), 0)) - depth;
    let up = depth - depth_of(textureLoad(rough, clamp(here - vec2(0, 1), vec2(0), last), 0));
    // The gentler of both sides is the surface's own slope.
    let slope = vec2(select(left, right, abs(right) < abs(left)), select(up, down, abs(down) < abs(up)));
    var sum = vec2(0.0);
    var weights = 0.0;
    for (var y = -2; y < 2; y++) {
        for (var x = -2; x < 2; x++) {
            let texel = textureLoad(rough, clamp(here + vec2(x, y), vec2(0), last), 0);
            let off = (depth_of(texel) - depth - dot(slope, vec2(f32(x), f32(y)))) / 0.012;
            let weight = 1.0 / (1.0 + off * off * off * off);
            sum += texel.rg * weight;
            weights += weight;
        }
    }
    return vec4(sum / weights, own.ba);
}
