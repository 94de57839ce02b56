// The figure in the picture and in the data passes. Follows scene.wgsl and skin.wgsl.

@group(2) @binding(0) var shadow_map: texture_depth_2d;
@group(2) @binding(1) var shadow_sampler: sampler_comparison;

struct Surface {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) color: vec3<f32>,
    // x: share of selected bones, y: of hovered ones.
    @location(3) marked: vec2<f32>,
    @location(4) shadow: vec3<f32>,
}

@vertex
fn vs_figure(skin: SkinVertex, surface: SurfaceVertex) -> Surface {
    let m = skin_matrix(skin.joints, skin.weights);
    let world = figure.world_from_figure * vec4(vec4(skin.position, 1.0) * m, 1.0);
    let normal = (figure.world_from_figure * vec4(vec4(surface.normal, 0.0) * m, 0.0)).xyz;
    var out: Surface;
    out.clip = scene.clip_from_world * world;
    out.world = world.xyz;
    out.normal = normal;
    out.color = surface.color.rgb;
    out.marked = vec2(share(figure.selected, skin.joints, skin.weights),
        share(figure.hovered, skin.joints, skin.weights));
    // Looking up a little off the surface keeps it from shadowing itself.
    let off = world.xyz + normalize(normal + vec3(0.0, 1e-9, 0.0)) * (scene.ranges.z * 2.5);
    out.shadow = (scene.shadow_from_world * vec4(off, 1.0)).xyz;
    return out;
}

fn lit(at: vec3<f32>) -> f32 {
    let step = 1.5 * scene.ranges.w;
    var sum = textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy, at.z) * 2.0;
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + vec2(-step, -0.4 * step), at.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + vec2(step, 0.4 * step), at.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + vec2(0.4 * step, -step), at.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + vec2(-0.4 * step, step), at.z);
    return sum / 6.0;
}

const KEY: vec3<f32> = vec3<f32>(2.15, 2.05, 1.90);
const FILL: vec3<f32> = vec3<f32>(0.34, 0.37, 0.42);
const SKY: vec3<f32> = vec3<f32>(0.50, 0.55, 0.62);
const GROUND: vec3<f32> = vec3<f32>(0.20, 0.18, 0.165);
const RIM: vec3<f32> = vec3<f32>(0.55, 0.62, 0.72);

fn shade(in: Surface, n: vec3<f32>) -> vec3<f32> {
    let v = toward_viewer(in.world);
    let facing = clamp(dot(n, v), 0.0, 1.0);
    let toward_key = dot(n, scene.key.xyz);
    var key = max(toward_key, 0.0);
    if key > 0.0 && scene.key.w > 0.0 {
        key *= lit(in.shadow);
    }
    let sky = 0.5 + 0.5 * n.y;
    let fill = 0.5 + 0.5 * dot(n, scene.fill.xyz);
    // Creases and undersides near the ground see less of the studio.
    let low = 0.75 + 0.25 * smoothstep(0.0, 0.35, in.world.y);
    var light = mix(GROUND, SKY, sky) * low + FILL * fill * fill + KEY * key;
    let half_way = normalize(scene.key.xyz + v);
    let gloss = pow(max(dot(n, half_way), 0.0), 28.0) * 0.16 * key;
    let edge = 1.0 - facing;
    let edge3 = edge * edge * edge;
    let rim = RIM * (edge3 * (0.35 + 0.65 * sky) * 0.55);
    var albedo = in.color;
    let hover = in.marked.y * scene.hovered_tint.a;
    let select = in.marked.x * scene.selected_tint.a;
    albedo = mix(albedo, scene.hovered_tint.rgb, hover);
    albedo = mix(albedo, scene.selected_tint.rgb, select);
    return albedo * light + KEY * gloss + rim + scene.selected_tint.rgb * (select * edge3);
}

// A soft shoulder: middle tones stay, highlights roll off and keep their hue for long.
fn tone(c: vec3<f32>) -> vec3<f32> {
    let x = max(c, vec3(0.0)) * 0.82;
    return clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), vec3(0.0), vec3(1.0));
}

@fragment
fn fs_color(in: Surface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let n = normalize(select(-in.normal, in.normal, front));
    let opacity = figure.look.x;
    return vec4(tone(shade(in, n)) * opacity, opacity);
}

@fragment
fn fs_depth(in: Surface) -> @location(0) vec4<f32> {
    let depth = -(scene.view_from_world * vec4(in.world, 1.0)).z;
    let nearness = (scene.ranges.y - depth) / max(scene.ranges.y - scene.ranges.x, 1e-6);
    return vec4(vec3(clamp(nearness, 0.0, 1.0)), 1.0);
}

@fragment
fn fs_normal(in: Surface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let n = normalize(select(-in.normal, in.normal, front));
    return vec4((scene.view_from_world * vec4(n, 0.0)).xyz * 0.5 + 0.5, 1.0);
}

@fragment
fn fs_silhouette() -> @location(0) vec4<f32> {
    return vec4(1.0);
}

@fragment
fn fs_nothing() -> @location(0) vec4<f32> {
    return vec4(0.0);
}
