// A picture for reference behind everything but the gradient, as high as the view. Follows scene.wgsl.

@group(2) @binding(0) var reference: texture_2d<f32>;
@group(2) @binding(1) var reference_sampler: sampler;

struct Behind {
    @builtin(position) clip: vec4<f32>,
    // From -1 to 1 over the view, y up.
    @location(0) at: vec2<f32>,
}

@vertex
fn vs_image(@builtin(vertex_index) index: u32) -> Behind {
    let at = vec2(f32(index & 1u), f32(index >> 1u));
    let clip = vec4(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, 1.0, 1.0);
    return Behind(clip, place_in_picture(at * scene.viewport.xy));
}

@fragment
fn fs_image(in: Behind) -> @location(0) vec4<f32> {
    let size = vec2<f32>(textureDimensions(reference));
    let wider = scene.tile.z / scene.tile.w * size.y / size.x;
    let uv = in.at * vec2(wider, -1.0) * 0.5 + 0.5;
    if uv.x < 0.0 || uv.x > 1.0 {
        return vec4(0.0);
    }
    let c = textureSampleLevel(reference, reference_sampler, uv, 0.0);
    let alpha = c.a * scene.light.y;
    return vec4(c.rgb * alpha, alpha);
}
