// How open each seen place is to the light from all around, and how much of the key light arrives there, for one survey
// of the picture: its depth and normals. Follows scene.wgsl.

@group(2) @binding(0) var seen_depth: texture_depth_2d;
@group(2) @binding(1) var seen_normal: texture_2d<f32>;
@group(2) @binding(2) var shadow_map: texture_depth_2d;

@vertex
fn vs_everywhere(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    // At the far end, so that a depth test leaves out places where nothing is seen.
    return vec4(f32(index & 1u) * 2.0 - 1.0, f32(index >> 1u) * 2.0 - 1.0, 1.0, 1.0);
}

const PI: f32 = 3.14159265;
// How far around creases and contacts darken.
const REACH_M: f32 = 0.22;
const SLICES: i32 = 2;
const STEPS: i32 = 6;

fn pixel_size() -> vec2<f32> {
    return vec2<f32>(textureDimensions(seen_depth));
}

fn place(pixel: vec2<f32>, depth: f32) -> vec3<f32> {
    return place_in_view(pixel / pixel_size(), depth);
}

fn arc_cosine(x: f32) -> f32 {
    let a = abs(x);
    let r = (1.5707963 - 0.1565827 * a) * sqrt(max(1.0 - a, 0.0));
    return select(PI - r, r, x >= 0.0);
}

// A number in 0 to 1, other for each pixel of a block of four by four.
fn turn_of(pixel: vec2<u32>) -> f32 {
    let cell = pixel & vec2(3u);
    return f32((cell.x * 4u + cell.y * 9u) & 15u) / 16.0;
}

fn shift_of(pixel: vec2<u32>) -> f32 {
    let cell = pixel & vec2(3u);
    return f32((cell.y * 4u + cell.x * 5u + 3u) & 15u) / 16.0;
}

// Ground-truth ambient occlusion: horizons to both sides of a few slices through the view, weighted by the cosine.
fn openness(pixel: vec2<f32>, at: vec3<f32>, n: vec3<f32>, toward: vec3<f32>) -> f32 {
    let cell = vec2<u32>(pixel);
    let turn = turn_of(cell);
    let start = shift_of(cell);
    // The reach in pixels, at this depth.
    let along = mix(1.0, -at.z, scene.lens.z);
    let reach = clamp(REACH_M / along / scene.lens.y * 0.5 * pixel_size().y, 4.0, pixel_size().y * 0.35);
    var sum = 0.0;
    for (var slice = 0; slice < SLICES; slice++) {
        let angle = (f32(slice) + turn) * (PI / f32(SLICES));
        let ray = vec2(cos(angle), sin(angle));
        let aside = vec3(ray.x, -ray.y, 0.0);
        let across = aside - toward * dot(aside, toward);
        let axis = cross(aside, toward);
        let projected = n - axis * (dot(n, axis) / max(dot(axis, axis), 1e-6));
        let long = max(length(projected), 1e-4);
        let cosine = clamp(dot(projected, toward) / long, -1.0, 1.0);
        let tilt = sign(dot(across, projected)) * arc_cosine(cosine);
        var horizon = vec2(cos(tilt + PI * 0.5), cos(tilt - PI * 0.5));
        for (var i = 0; i < STEPS; i++) {
            let share = (f32(i) + start) / f32(STEPS);
            let off = ray * (share * share * reach + 1.2);
            for (var side = 0; side < 2; side++) {
                let there = floor(pixel + select(-off, off, side == 0)) + 0.5;
                let inside = clamp(there, vec2(0.5), pixel_size() - 0.5);
                let depth = textureLoad(seen_depth, vec2<i32>(inside), 0);
                let to = place(inside, depth) - at;
                let away = length(to);
                let near = clamp(1.6 - 1.6 * away / REACH_M, 0.0, 1.0);
                let low = select(horizon.y, horizon.x, side == 0);
                let high = dot(to, toward) / max(away, 1e-6);
                let risen = max(low, mix(low, high, near));
                horizon = select(vec2(horizon.x, risen), vec2(risen, horizon.y), side == 0);
            }
        }
        let right = min(arc_cosine(horizon.x), tilt + PI * 0.5);
        let left = max(-arc_cosine(horizon.y), tilt - PI * 0.5);
        let arcs = 2.0 * cosine + 2.0 * sin(tilt) * (left + right) - cos(2.0 * left - tilt) - cos(2.0 * right - tilt);
        sum += long * 0.25 * arcs;
    }
    return clamp(sum / f32(SLICES), 0.0, 1.0);
}

// The light's radius over its distance.
const SPREAD: f32 = 0.06;
const TALLEST_M: f32 = 0.7;
const SEARCH: i32 = 10;
const FILTER: i32 = 16;

// How much nearer to the light than the receiver's own plane the map has something, metres; `off` is in the map.
fn above(at: vec3<f32>, slope: vec2<f32>, off: vec2<f32>) -> f32 {
    let last = 1.0 / scene.ranges.w - 1.0;
    let there = clamp((at.xy + off) / scene.ranges.w, vec2(0.0), vec2(last));
    let depth = textureLoad(shadow_map, vec2<i32>(there), 0);
    // Where the map is empty nothing is above, however steep the plane.
    return select((at.z - depth) * scene.light.x + dot(slope, off), -1.0, depth >= 1.0);
}

// Percentage-closer soft shadows against the plane of the receiver: no surface shadows itself.
fn arrival(pixel: vec2<f32>, at: vec3<f32>, n: vec3<f32>) -> f32 {
    let map_m = scene.ranges.z / scene.ranges.w;
    let facing = (scene.shadow_from_view * vec4(n, 0.0)).xyz * vec3(vec2(map_m), scene.light.x);
    let lifted = (scene.shadow_from_view * vec4(at + n * (scene.ranges.z * 1.5), 1.0)).xyz;
    // Metres of depth for the whole width of the map, in both directions.
    let slope = clamp(-facing.xy / min(facing.z, -0.15), vec2(-4.0), vec2(4.0)) * map_m;
    let bias = 0.0025;
    let turn = turn_of(vec2<u32>(pixel)) * 6.2831853;
    var arm = vec2(cos(turn), sin(turn));
    let reach = TALLEST_M * SPREAD / map_m;
    var blockers = 0.0;
    var height = 0.0;
    for (var i = 0; i < SEARCH; i++) {
        let h = above(lifted, slope, arm * (reach * sqrt((f32(i) + 0.5) / f32(SEARCH)))) - bias;
        let blocks = h > 0.0;
        blockers += f32(blocks);
        height += max(h, 0.0);
        arm = turned(arm);
    }
    let radius = clamp(height / max(blockers, 1.0) * SPREAD, 0.0025, TALLEST_M * SPREAD) / map_m;
    var lit = 0.0;
    for (var i = 0; i < FILTER; i++) {
        let h = above(lifted, slope, arm * (radius * sqrt((f32(i) + 0.5) / f32(FILTER))));
        lit += f32(h <= bias);
        arm = turned(arm);
    }
    return lit / f32(FILTER);
}

// Depth over the figures' range in two bytes' worth of a colour.
fn packed(depth: f32) -> vec2<f32> {
    let whole = clamp((depth - scene.surveyed.x) / max(scene.surveyed.y - scene.surveyed.x, 1e-6), 0.0, 1.0) * 65535.0;
    let high = floor(whole / 256.0);
    return vec2(high, whole - high * 256.0) / 255.0;
}

@fragment
fn fs_occlusion(@builtin(position) clip: vec4<f32>) -> @location(0) vec4<f32> {
    let here = vec2<i32>(clip.xy);
    let at = place(clip.xy, textureLoad(seen_depth, here, 0));
    let n = normalize(textureLoad(seen_normal, here, 0).xyz * 2.0 - 1.0);
    let toward = normalize(mix(vec3(0.0, 0.0, 1.0), -at, scene.lens.z));
    let open = openness(clip.xy, at, n, toward);
    return vec4(open, arrival(clip.xy, at, n), packed(-at.z));
}
