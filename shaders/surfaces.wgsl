// Translucent balls and fans over the picture. Follows scene.wgsl.

// What of a ghosted surface shows behind something, and what of a ball's far half shows at all.
const HIDDEN: f32 = 0.28;
const FAR_HALF: f32 = 0.6;
// Quads around and down a ball, and lines of its net: whole numbers of the one between two of the other.
const AROUND: u32 = 96u;
const DOWN: u32 = 48u;
const MERIDIANS: f32 = 16.0;
const PARALLELS: f32 = 8.0;
const TAU: f32 = 6.2831853;

struct Ball {
    // xyz: centre; w: radius; metres, world.
    @location(0) sphere: vec4<f32>,
    // sRGB, straight alpha.
    @location(1) color: vec4<f32>,
}

struct Shell {
    @builtin(position) clip: vec4<f32>,
    @location(0) world: vec3<f32>,
    @location(1) normal: vec3<f32>,
    // Whole numbers lie on the lines of the net.
    @location(2) net: vec2<f32>,
    @location(3) @interpolate(flat) color: vec4<f32>,
}

@vertex
fn vs_ball(@builtin(vertex_index) index: u32, in: Ball) -> Shell {
    let quad = index / 6u;
    // Two triangles a quad, two bits a corner: 0 1 2, 2 1 3, outside counter-clockwise.
    let which = (0xda4u >> (2u * (index % 6u))) & 3u;
    let at = vec2(f32(quad % AROUND + (which & 1u)) / f32(AROUND), f32(quad / AROUND + (which >> 1u)) / f32(DOWN));
    let around = at.x * TAU;
    let down = at.y * 0.5 * TAU;
    let normal = vec3(sin(down) * cos(around), cos(down), sin(down) * sin(around));
    let world = in.sphere.xyz + normal * in.sphere.w;
    return Shell(
        scene.clip_from_world * vec4(world, 1.0),
        world,
        normal,
        at * vec2(MERIDIANS, PARALLELS),
        in.color,
    );
}

// Clear where one looks straight through, dense along the rim; the net shows the curve, above all from within.
fn shell(in: Shell, near_half: bool) -> vec4<f32> {
    let facing = abs(dot(normalize(in.normal), toward_viewer(in.world)));
    let rim = pow(1.0 - facing, 3.0);
    let pixel = max(fwidth(in.net), vec2(1e-6));
    let off = abs(fract(in.net + 0.5) - 0.5) / pixel;
    let crowded = smoothstep(vec2(0.05), vec2(0.25), pixel);
    let lines = clamp(vec2(1.1) - off, vec2(0.0), vec2(1.0)) * (1.0 - crowded);
    let net = max(lines.x, lines.y);
    let cover = clamp(0.09 + 0.2 * net + 0.8 * rim, 0.0, 1.0) * select(FAR_HALF, 1.0, near_half);
    let alpha = in.color.a * cover;
    return vec4(in.color.rgb * alpha, alpha);
}

@fragment
fn fs_ball(in: Shell, @builtin(front_facing) near_half: bool) -> @location(0) vec4<f32> {
    return shell(in, near_half);
}

@fragment
fn fs_ball_hidden(in: Shell, @builtin(front_facing) near_half: bool) -> @location(0) vec4<f32> {
    return shell(in, near_half) * HIDDEN;
}

struct Sheet {
    @builtin(position) clip: vec4<f32>,
    @location(0) color: vec4<f32>,
}

@vertex
fn vs_fan(@location(0) world: vec3<f32>, @location(1) color: vec4<f32>) -> Sheet {
    var clip = scene.clip_from_world * vec4(world, 1.0);
    // A hair toward the viewer, so that a sheet on a surface is not swallowed by it.
    clip.z *= 1.0 - 2e-5;
    return Sheet(clip, vec4(color.rgb * color.a, color.a));
}

@fragment
fn fs_fan(in: Sheet) -> @location(0) vec4<f32> {
    return in.color;
}

@fragment
fn fs_fan_hidden(in: Sheet) -> @location(0) vec4<f32> {
    return in.color * HIDDEN;
}
