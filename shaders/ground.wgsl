// The ground plane y = 0: a grid that fades with distance, and the figures' shadow. Follows scene.wgsl.

@group(2) @binding(0) var soft_map: texture_2d<f32>;
@group(2) @binding(1) var soft_sampler: sampler;

struct Ground {
    @builtin(position) clip: vec4<f32>,
    @location(0) at: vec2<f32>,
}

fn corner(index: u32) -> vec2<f32> {
    return vec2(f32(index & 1u), f32(index >> 1u));
}

@vertex
fn vs_grid(@builtin(vertex_index) index: u32) -> Ground {
    let at = scene.ground.xz + (corner(index) * 2.0 - 1.0) * scene.ground.y;
    return Ground(scene.clip_from_world * vec4(at.x, 0.0, at.y, 1.0), at);
}

// Coverage of lines every `spacing`, `width` pixels wide; fades as the lines crowd below a few pixels.
fn lines(at: vec2<f32>, pixel: vec2<f32>, spacing: f32, width: f32) -> vec2<f32> {
    let off = abs(fract(at / spacing + 0.5) - 0.5) * spacing;
    let cover = clamp(0.5 * width + 0.5 - off / pixel, vec2(0.0), vec2(1.0));
    return cover * (1.0 - smoothstep(vec2(0.1), vec2(0.4), pixel / spacing));
}

@fragment
fn fs_grid(in: Ground) -> @location(0) vec4<f32> {
    let pixel = max(fwidth(in.at), vec2(1e-6));
    let away = length(in.at - scene.ground.xz) / scene.ground.y;
    let fade = (1.0 - away) * clamp(1.0 - away, 0.0, 1.0);
    let fine = lines(in.at, pixel, scene.ground.w, 1.0);
    let metre = lines(in.at, pixel, scene.ground.w * 10.0, 1.2);
    let axis = clamp(vec2(1.3) - abs(in.at) / pixel, vec2(0.0), vec2(1.0));
    var alpha = max(max(fine.x, fine.y) * 0.11, max(metre.x, metre.y) * 0.26);
    // Light lines on a dark ground, dark ones on a light ground.
    let ground = dot(scene.background_top.rgb + scene.background_bottom.rgb, vec3(1.0 / 6.0));
    var color = select(vec3(0.82, 0.84, 0.87), vec3(0.16, 0.18, 0.21), ground > 0.5);
    // Along X the z coordinate is zero, and the other way round.
    color = mix(color, vec3(0.86, 0.36, 0.34), axis.y);
    color = mix(color, vec3(0.36, 0.55, 0.90), axis.x * (1.0 - axis.y));
    alpha = max(alpha, max(axis.x, axis.y) * 0.6) * fade;
    return vec4(color * alpha, alpha);
}

struct Shade {
    @builtin(position) clip: vec4<f32>,
    @location(0) at: vec2<f32>,
}

@vertex
fn vs_shade(@builtin(vertex_index) index: u32) -> Shade {
    let corner = corner(index);
    let at = mix(scene.footprint.xy, scene.footprint.zw, corner);
    return Shade(scene.clip_from_world * vec4(at.x, 0.0, at.y, 1.0), corner);
}

@fragment
fn fs_shade(in: Shade) -> @location(0) vec4<f32> {
    // Four filtered reads average a block of four by four texels.
    let step = 1.0 / vec2<f32>(textureDimensions(soft_map));
    var lit = textureSampleLevel(soft_map, soft_sampler, in.at - step, 0.0).r;
    lit += textureSampleLevel(soft_map, soft_sampler, in.at + step, 0.0).r;
    lit += textureSampleLevel(soft_map, soft_sampler, in.at + vec2(step.x, -step.y), 0.0).r;
    lit += textureSampleLevel(soft_map, soft_sampler, in.at + vec2(-step.x, step.y), 0.0).r;
    return vec4(0.0, 0.0, 0.0, 0.42 * (1.0 - 0.25 * lit));
}
