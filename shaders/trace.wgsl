// The lines of a drawing, from a survey of depth and normals: where one part hides another, where the surface folds, and
// where it dips. Follows scene.wgsl.

@group(2) @binding(0) var seen_depth: texture_depth_2d;
@group(2) @binding(1) var seen_normal: texture_2d<f32>;

@vertex
fn vs_everywhere(@builtin(vertex_index) index: u32) -> @builtin(position) vec4<f32> {
    // At the far end, so that a depth test leaves out places where nothing is seen.
    return vec4(f32(index & 1u) * 2.0 - 1.0, f32(index >> 1u) * 2.0 - 1.0, 1.0, 1.0);
}

struct Sight {
    at: vec3<f32>,
    normal: vec3<f32>,
    // Whether there is anything.
    there: bool,
}

fn sight(pixel: vec2<i32>) -> Sight {
    let size = vec2<i32>(textureDimensions(seen_depth));
    let inside = clamp(pixel, vec2(0), size - 1);
    let depth = textureLoad(seen_depth, inside, 0);
    let at = place_in_view((vec2<f32>(inside) + 0.5) / vec2<f32>(size), depth);
    let normal = normalize(textureLoad(seen_normal, inside, 0).xyz * 2.0 - 1.0);
    return Sight(at, normal, depth < 1.0);
}

// How much farther the neighbours to both sides are than a plane through here would have them, metres.
fn drop_to(here: Sight, a: Sight, b: Sight) -> f32 {
    let left = select(9.0, here.at.z - a.at.z, a.there);
    let right = select(9.0, here.at.z - b.at.z, b.there);
    return left + right;
}

fn facing(s: Sight) -> f32 {
    return dot(s.normal, normalize(mix(vec3(0.0, 0.0, 1.0), -s.at, scene.lens.z)));
}

// How sharply the surface folds inward between two places, 1 / metres; 0 across an edge.
fn fold(a: Sight, b: Sight, gap: f32) -> f32 {
    let run = b.at - a.at;
    let long2 = max(dot(run, run), 1e-12);
    return select(0.0, -dot(b.normal - a.normal, run) / long2, a.there && b.there && abs(run.z) < gap);
}

@fragment
fn fs_trace(@builtin(position) clip: vec4<f32>) -> @location(0) vec4<f32> {
    let p = vec2<i32>(clip.xy);
    let here = sight(p);
    let height = f32(textureDimensions(seen_depth).y);
    let pixel_m = mix(1.0, -here.at.z, scene.lens.z) * scene.lens.y * 2.0 / height;
    let across = drop_to(here, sight(p - vec2(1, 0)), sight(p + vec2(1, 0)));
    let down = drop_to(here, sight(p - vec2(0, 1)), sight(p + vec2(0, 1)));
    let least = 0.0022 + 2.5 * pixel_m;
    let step_m = max(across, down);
    let hides = smoothstep(least, 2.2 * least, step_m);
    // The pen presses harder where more lies behind, and on the side away from the light.
    let normal = (scene.world_from_view * vec4(here.normal, 0.0)).xyz;
    let shaded = 0.5 - 0.5 * dot(normal, scene.key.xyz);
    let press = mix(0.75, 1.30, smoothstep(0.004, 0.10, step_m)) * mix(0.72, 1.28, shaded);

    let near = i32(clamp(0.0016 / pixel_m, 1.0, 4.0));
    let gap = 0.02 + 6.0 * pixel_m;
    let folds = max(fold(sight(p - vec2(near, 0)), sight(p + vec2(near, 0)), gap),
        fold(sight(p - vec2(0, near)), sight(p + vec2(0, near)), gap));
    let creased = smoothstep(75.0, 190.0, folds);

    let far = i32(clamp(0.007 / pixel_m, 2.0, 14.0));
    let own = facing(here);
    var dip = 0.0;
    for (var i = 0; i < 4; i++) {
        let ways = array<vec2<i32>, 4>(vec2(4, 0), vec2(3, 3), vec2(0, 4), vec2(-3, 3));
        let way = ways[i] * far / 4;
        let a = sight(p - way);
        let b = sight(p + way);
        let level = a.there && b.there && abs(a.at.z - here.at.z) < 2.0 * gap && abs(b.at.z - here.at.z) < 2.0 * gap;
        dip = max(dip, select(0.0, min(facing(a), facing(b)) - own, level));
    }
    let dips = smoothstep(0.035, 0.11, dip) * 0.72;
    let inner = max(creased * 0.9, dips);
    let ink = max(hides, inner);
    let half_width = mix(0.80, 1.45 * press, hides);
    // Half the width in texels, over 4.
    return vec4(ink, half_width / 4.0, 0.0, 1.0);
}
