// The ground plane y = 0: a grid that fades with distance, and the figures' shadow. Follows scene.wgsl and survey.wgsl.

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

// How far beyond the shadow the ground is darkened by what stands on it, metres.
const MARGIN_M: f32 = 0.3;

override occluded: bool = false;

struct Shade {
    @builtin(position) clip: vec4<f32>,
    // In the map of the shadow: 0 to 1 over the footprint.
    @location(0) at: vec2<f32>,
    @location(1) world: vec3<f32>,
}

fn around_footprint(index: u32) -> Shade {
    let size = scene.footprint.zw - scene.footprint.xy;
    let margin = select(vec2(0.0), MARGIN_M / max(size, vec2(1e-3)), occluded);
    let at = mix(-margin, 1.0 + margin, corner(index));
    let spot = mix(scene.footprint.xy, scene.footprint.zw, at);
    let world = vec3(spot.x, 0.0, spot.y);
    return Shade(scene.clip_from_world * vec4(world, 1.0), at, world);
}

@vertex
fn vs_shade(@builtin(vertex_index) index: u32) -> Shade {
    return around_footprint(index);
}

@fragment
fn fs_shade(in: Shade) -> @location(0) vec4<f32> {
    // Four filtered reads average a block of four by four texels.
    let step = 1.0 / vec2<f32>(textureDimensions(soft_map));
    var lit = textureSampleLevel(soft_map, soft_sampler, in.at - step, 0.0).r;
    lit += textureSampleLevel(soft_map, soft_sampler, in.at + step, 0.0).r;
    lit += textureSampleLevel(soft_map, soft_sampler, in.at + vec2(step.x, -step.y), 0.0).r;
    lit += textureSampleLevel(soft_map, soft_sampler, in.at + vec2(-step.x, step.y), 0.0).r;
    var left = 1.0 - 0.42 * (1.0 - 0.25 * lit);
    if occluded {
        let open = surveyed(in.clip.xy, view_depth(in.world)).x;
        let off = max(abs(in.at - 0.5) - 0.5, vec2(0.0)) * (scene.footprint.zw - scene.footprint.xy);
        let within = 1.0 - smoothstep(0.5, 0.95, length(off) / MARGIN_M);
        left *= 1.0 - 0.62 * (1.0 - clamp(open * 1.12, 0.0, 1.0)) * within;
    }
    return vec4(0.0, 0.0, 0.0, 1.0 - left);
}

// The ground around the figures as a survey sees it.
@vertex
fn vs_contact(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let size = scene.footprint.zw - scene.footprint.xy;
    let at = scene.footprint.xy - MARGIN_M + corner(index) * (size + 2.0 * MARGIN_M);
    return scene.clip_from_world * vec4(at.x, 0.0, at.y, 1.0);
}

@fragment
fn fs_contact() -> @location(0) vec4<f32> {
    return vec4((scene.view_from_world * vec4(0.0, 1.0, 0.0, 0.0)).xyz * 0.5 + 0.5, 1.0);
}

// The outer half of a drawing's outlines: what of them is beside the figures. Only around the figures.
@vertex
fn vs_ink(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    let at = mix(scene.silhouette.xy, scene.silhouette.zw, corner(index));
    return vec4(at, 0.0, 1.0);
}

@fragment
fn fs_ink(@builtin(position) clip: vec4<f32>) -> @location(0) vec4<f32> {
    let ink = inked(clip.xy);
    return vec4(INK * ink, ink);
}
