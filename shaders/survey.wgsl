// What was found in a survey of the picture, for shaders that draw it: how open and how lit places are, or the lines of
// a drawing. Follows scene.wgsl.

@group(3) @binding(0) var survey: texture_2d<f32>;

const PAPER: vec3<f32> = vec3<f32>(0.988, 0.985, 0.976);
const INK: vec3<f32> = vec3<f32>(0.085, 0.080, 0.095);

fn view_depth(world: vec3<f32>) -> f32 {
    return -(scene.view_from_world * vec4(world, 1.0)).z;
}

// The place of a pixel in the survey, which shows the whole picture, perhaps in other pixels.
fn place_in_survey(pixel: vec2<f32>) -> vec2<f32> {
    return (pixel + scene.tile.xy) / scene.tile.zw * vec2<f32>(textureDimensions(survey));
}

fn weigh(sum: ptr<function, vec3<f32>>, at: vec2<f32>, texel: vec2<i32>, depth: f32) {
    let last = vec2<i32>(textureDimensions(survey)) - 1;
    let found = textureLoad(survey, clamp(texel, vec2(0), last), 0);
    let span = scene.surveyed.y - scene.surveyed.x;
    let seen = scene.surveyed.x + (found.b * 65280.0 + found.a * 255.0) / 65535.0 * span;
    let off = (seen - depth) / 0.02;
    let away = abs(vec2<f32>(texel) + 0.5 - at);
    let near = max(1.02 - away.x, 0.02) * max(1.02 - away.y, 0.02);
    let weight = near / (1.0 + off * off * off * off);
    *sum += vec3(found.rg, 1.0) * weight;
}

// Openness and key light of a surface at a pixel and a depth: of the texels around it those that show the same surface.
fn surveyed(pixel: vec2<f32>, depth: f32) -> vec2<f32> {
    let at = place_in_survey(pixel);
    let here = vec2<i32>(floor(at));
    let to = vec2<i32>(select(vec2(-1.0), vec2(1.0), fract(at) >= vec2(0.5)));
    var sum = vec3(0.0);
    weigh(&sum, at, here, depth);
    weigh(&sum, at, here + vec2(to.x, 0), depth);
    weigh(&sum, at, here + vec2(0, to.y), depth);
    weigh(&sum, at, here + to, depth);
    weigh(&sum, at, here - vec2(to.x, 0), depth);
    weigh(&sum, at, here - vec2(0, to.y), depth);
    // Far off at a grazing angle no texel shows quite this place: then the least unlike counts.
    return sum.xy / max(sum.z, 1e-25);
}

// How much ink is on a pixel: each texel of the survey on a line is a dot of its width.
fn inked(pixel: vec2<f32>) -> f32 {
    let at = place_in_survey(pixel);
    let here = vec2<i32>(floor(at));
    let last = vec2<i32>(textureDimensions(survey)) - 1;
    // Half the width of a pixel in texels: edges are as soft as a pixel is wide.
    let soft = clamp(f32(last.y + 1) / scene.tile.w * 0.5, 0.12, 1.0);
    var ink = 0.0;
    for (var y = -3; y <= 3; y++) {
        for (var x = -3; x <= 3; x++) {
            let texel = here + vec2(x, y);
            let found = textureLoad(survey, clamp(texel, vec2(0), last), 0);
            let off = length(vec2<f32>(texel) + 0.5 - at);
            ink = max(ink, found.r * clamp((found.g * 4.0 - off) / (2.0 * soft) + 0.5, 0.0, 1.0));
        }
    }
    return ink;
}
