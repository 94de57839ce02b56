// The figures' shadow on the ground, once for each texel of a small map over the footprint: sharp where the
// figure stands, softer the farther it is above (percentage-closer soft shadows). Follows scene.wgsl.

@group(2) @binding(0) var shadow_map: texture_depth_2d;

struct Spot {
    @builtin(position) clip: vec4<f32>,
    @location(0) shadow: vec3<f32>,
}

@vertex
fn vs_soften(@builtin(vertex_index) index: u32) -> Spot {
    let at = vec2(f32(index & 1u), f32(index >> 1u));
    let ground = mix(scene.footprint.xy, scene.footprint.zw, at);
    let shadow = (scene.shadow_from_world * vec4(ground.x, 0.0, ground.y, 1.0)).xyz;
    return Spot(vec4(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, 0.0, 1.0), shadow);
}

// The light's radius over its distance.
const SPREAD: f32 = 0.055;
const TALLEST_M: f32 = 1.6;
const SEARCH: i32 = 12;
const FILTER: i32 = 20;

fn depth_at(at: vec2<f32>) -> f32 {
    let last = 1.0 / scene.ranges.w - 1.0;
    return textureLoad(shadow_map, vec2<i32>(clamp(at / scene.ranges.w, vec2(0.0), vec2(last))), 0);
}

@fragment
fn fs_soften(in: Spot) -> @location(0) vec4<f32> {
    let map_m = scene.ranges.z / scene.ranges.w;
    let deep_m = scene.light.x;
    // Below the cleared map's 1, where nothing may seem to lie before the ground.
    let ground = min(in.shadow.z - 0.004 / deep_m, 0.999);
    // Neighbours look in other directions; whoever reads the map averages over them.
    let cell = vec2<u32>(in.clip.xy) & vec2(3u);
    let turn = f32((cell.x * 4u + cell.y * 9u) & 15u) * 0.3927;
    var arm = vec2(cos(turn), sin(turn));
    let reach = TALLEST_M * SPREAD / map_m;
    var blockers = 0.0;
    var above = 0.0;
    for (var i = 0; i < SEARCH; i++) {
        let depth = depth_at(in.shadow.xy + arm * (reach * sqrt((f32(i) + 0.5) / f32(SEARCH))));
        let blocks = depth < ground;
        blockers += f32(blocks);
        above += select(0.0, ground - depth, blocks);
        arm = turned(arm);
    }
    if blockers == 0.0 {
        return vec4(1.0);
    }
    let radius = max(above / blockers * deep_m * SPREAD, 0.006) / map_m;
    var lit = 0.0;
    for (var i = 0; i < FILTER; i++) {
        let depth = depth_at(in.shadow.xy + arm * (radius * sqrt((f32(i) + 0.5) / f32(FILTER))));
        lit += f32(depth >= ground);
        arm = turned(arm);
    }
    return vec4(lit / f32(FILTER));
}
