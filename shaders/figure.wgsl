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
    let a = 1.3 * scene.ranges.w;
    let b = 2.9 * scene.ranges.w;
    var sum = textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy, at.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + vec2(-a, -0.4 * a), at.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + vec2(a, 0.4 * a), at.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + vec2(0.4 * a, -a), at.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + vec2(-0.4 * a, a), at.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + vec2(-b, 0.3 * b), at.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + vec2(b, -0.3 * b), at.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + vec2(0.3 * b, b), at.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + vec2(-0.3 * b, -b), at.z);
    return sum / 9.0;
}

const KEY: vec3<f32> = vec3<f32>(1.36, 1.27, 1.15);
const FILL: vec3<f32> = vec3<f32>(0.160, 0.165, 0.175);
const SKY: vec3<f32> = vec3<f32>(0.235, 0.265, 0.315);
const GROUND: vec3<f32> = vec3<f32>(0.105, 0.094, 0.085);
const RIM: vec3<f32> = vec3<f32>(0.30, 0.34, 0.40);

fn shade(in: Surface, n: vec3<f32>) -> vec3<f32> {
    let v = toward_viewer(in.world);
    let facing = clamp(dot(n, v), 0.0, 1.0);
    var key = max(dot(n, scene.key.xyz), 0.0);
    if key > 0.0 && scene.key.w > 0.0 {
        key *= lit(in.shadow);
    }
    let sky = 0.5 + 0.5 * n.y;
    let fill = 0.5 + 0.5 * dot(n, scene.fill.xyz);
    // What is near the ground sees less of the studio.
    let open = 0.6 + 0.4 * smoothstep(-0.1, 0.5, in.world.y + 0.25 * n.y);
    let light = mix(GROUND, SKY, sky) * open + FILL * (fill * fill * fill * scene.fill.w) + KEY * key;
    let half_way = normalize(scene.key.xyz + v);
    let g = max(dot(n, half_way), 0.0);
    let g2 = g * g;
    let g8 = g2 * g2 * g2 * g2;
    let gloss = g8 * g8 * g8 * 0.10 * key;
    let edge = 1.0 - facing;
    let edge3 = edge * edge * edge;
    let rim = RIM * (edge3 * (0.3 + 0.7 * sky));
    let select_share = in.marked.x * scene.selected_tint.a;
    let hover_share = in.marked.y * scene.hovered_tint.a;
    var albedo = mix(in.color, scene.hovered_tint.rgb, hover_share);
    albedo = mix(albedo, scene.selected_tint.rgb, select_share);
    // Marked bones glow a little, so that they are found in the shadow too.
    let glow = scene.selected_tint.rgb * select_share * (0.06 + 0.6 * edge3)
        + scene.hovered_tint.rgb * hover_share * (0.05 + 0.3 * edge3);
    return albedo * light + KEY * gloss + rim + glow;
}

// A soft shoulder: dark and middle tones stay, highlights approach white and never clip.
fn tone(c: vec3<f32>) -> vec3<f32> {
    let x = max(c, vec3(0.0)) * 1.12;
    return x * inverseSqrt(1.0 + x * x);
}

// sRGB numbers of light in 0 to 1.
fn encoded(c: vec3<f32>) -> vec3<f32> {
    return select(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, c * 12.92, c <= vec3(0.0031308));
}

@fragment
fn fs_color(in: Surface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let n = normalize(select(-in.normal, in.normal, front));
    let opacity = figure.look.x;
    return vec4(encoded(tone(shade(in, n))) * opacity, opacity);
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
