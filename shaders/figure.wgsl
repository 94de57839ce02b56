// The figure in the picture and in the data passes. Follows scene.wgsl and skin.wgsl.

@group(2) @binding(0) var shadow_map: texture_depth_2d;
@group(2) @binding(1) var shadow_sampler: sampler_comparison;

// What a pipeline is made for: software adapters run both sides of every branch, so what is not wanted is left out.
override shadowed: bool = true;
override marked: bool = true;

struct Surface {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) color: vec3<f32>,
    // x: share of selected bones, y: of hovered ones.
    @location(3) marks: vec2<f32>,
}

// The same of a skin that is cut into parts.
struct PartSurface {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) color: vec3<f32>,
    @location(3) marks: vec2<f32>,
    // Place of the skin at rest, metres.
    @location(4) rest: vec3<f32>,
    // Metres to the nearest border between parts.
    @location(5) border: f32,
    // Number, tone and grain: twin of `PartVertex` in parts.rs.
    @location(6) @interpolate(flat) part: vec4<u32>,
}

struct PartVertex {
    @location(5) part: vec4<u32>,
    @location(6) border: f32,
}

fn posed(skin: SkinVertex, surface: SurfaceVertex) -> Surface {
    let m = skin_matrix(skin.joints, skin.weights);
    let world = figure.world_from_figure * vec4(vec4(skin.position, 1.0) * m, 1.0);
    var out: Surface;
    out.clip = scene.clip_from_world * world;
    out.world = world.xyz;
    out.normal = (figure.world_from_figure * vec4(vec4(surface.normal, 0.0) * m, 0.0)).xyz;
    out.color = surface.color.rgb;
    if marked {
        out.marks = vec2(share(figure.selected, skin.joints, skin.weights),
            share(figure.hovered, skin.joints, skin.weights));
    }
    return out;
}

@vertex
fn vs_figure(skin: SkinVertex, surface: SurfaceVertex) -> Surface {
    return posed(skin, surface);
}

@vertex
fn vs_part(skin: SkinVertex, surface: SurfaceVertex, part: PartVertex) -> PartSurface {
    let s = posed(skin, surface);
    return PartSurface(s.clip, s.world, s.normal, s.color, s.marks, skin.position, part.border, part.part);
}

// How much of the key light arrives.
fn lit(world: vec3<f32>, n: vec3<f32>) -> f32 {
    // Looking up a little off the surface keeps it from shadowing itself.
    let off = world + n * (scene.ranges.z * 2.5);
    let at = (scene.shadow_from_world * vec4(off, 1.0)).xyz;
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
    if shadowed {
        key *= lit(in.world, n);
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
    let select_share = in.marks.x * scene.selected_tint.a;
    let hover_share = in.marks.y * scene.hovered_tint.a;
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

fn studio(in: Surface, front: bool) -> vec4<f32> {
    let n = normalize(select(-in.normal, in.normal, front));
    let opacity = figure.look.x;
    return vec4(encoded(tone(shade(in, n))) * opacity, opacity);
}

fn clay(in: Surface, front: bool) -> vec4<f32> {
    var of_clay = in;
    of_clay.color = vec3(0.30, 0.24, 0.20);
    return studio(of_clay, front);
}

fn matcap(in: Surface, front: bool) -> vec4<f32> {
    return studio(in, front);
}

fn surface_of(in: PartSurface) -> Surface {
    return Surface(in.clip, in.world, in.normal, in.color, in.marks);
}

// Wood in the tone of the part, with a groove along its borders.
fn wood(in: PartSurface) -> Surface {
    var s = surface_of(in);
    let tone = array<vec3<f32>, 3>(vec3(0.62, 0.42, 0.23), vec3(0.36, 0.20, 0.10), vec3(0.50, 0.31, 0.15));
    s.color = tone[min(in.part.y, 2u)] * mix(0.25, 1.0, smoothstep(0.001, 0.003, in.border));
    return s;
}

@fragment
fn fs_studio(in: Surface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return studio(in, front);
}

@fragment
fn fs_studio_parts(in: PartSurface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return studio(wood(in), front);
}

@fragment
fn fs_clay(in: Surface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return clay(in, front);
}

@fragment
fn fs_clay_parts(in: PartSurface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return clay(wood(in), front);
}

@fragment
fn fs_matcap(in: Surface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return matcap(in, front);
}

@fragment
fn fs_matcap_parts(in: PartSurface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return matcap(wood(in), front);
}

@fragment
fn fs_line(in: Surface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return studio(in, front);
}

@fragment
fn fs_flat(in: PartSurface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return studio(wood(in), front);
}

// The colour map of PASCAL VOC: twin of `part_color` in parts.rs.
@fragment
fn fs_parts(in: PartSurface) -> @location(0) vec4<f32> {
    let low = (vec3(in.part.x) >> vec3(0u, 1u, 2u)) & vec3(1u);
    let high = (vec3(in.part.x) >> vec3(3u, 4u, 5u)) & vec3(1u);
    return vec4(vec3<f32>((low << vec3(7u)) | (high << vec3(6u))) / 255.0, 1.0);
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
