// The figure in the picture and in the data passes. Follows scene.wgsl, survey.wgsl and skin.wgsl.

@group(2) @binding(0) var shadow_map: texture_depth_2d;
@group(2) @binding(1) var shadow_sampler: sampler_comparison;

// What a pipeline is made for: software adapters run both sides of every branch, so what is not wanted is left out.
override shadowed: bool = true;
override marked: bool = true;
// Reads the survey of openness and shadow in place of the shadow map; a drawing reads its lines there.
override occluded: bool = false;
// The skin has the colours of parts.
override colored: bool = false;

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

// How much of the key light arrives, from the map of what the light sees.
fn lit(world: vec3<f32>, n: vec3<f32>) -> f32 {
    // Looking up a little off the surface keeps it from shadowing itself.
    let off = world + n * (scene.ranges.z * 2.5);
    var at = (scene.shadow_from_world * vec4(off, 1.0)).xyz;
    // Ground may lie beyond the map's range, where nothing is cast from.
    at.z = min(at.z, 1.0);
    let a = 1.5 * scene.ranges.w;
    var sum = textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + vec2(-a, -0.4 * a), at.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + vec2(a, 0.4 * a), at.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + vec2(0.4 * a, -a), at.z);
    sum += textureSampleCompareLevel(shadow_map, shadow_sampler, at.xy + vec2(-0.4 * a, a), at.z);
    return sum * 0.25;
}

// x: how open the place is to light from all around; y: how much of the key light arrives.
fn exposure(in: Surface, n: vec3<f32>) -> vec2<f32> {
    if occluded {
        return surveyed(in.clip.xy, view_depth(in.world));
    }
    if shadowed {
        return vec2(1.0, lit(in.world, n));
    }
    return vec2(1.0);
}

// The studio: a warm key light from above, a fill light that comes with the viewer, two lights from behind that
// draw the edges, and a room that is brighter above than below.
const KEY: vec3<f32> = vec3<f32>(1.70, 1.58, 1.42);
const FILL: vec3<f32> = vec3<f32>(0.146, 0.145, 0.148);
const SKY: vec3<f32> = vec3<f32>(0.170, 0.178, 0.200);
const GROUND: vec3<f32> = vec3<f32>(0.105, 0.083, 0.066);
const RIM: vec3<f32> = vec3<f32>(0.30, 0.34, 0.40);
// Light wanders a little under the skin: past the border of the light, red farthest.
const WRAP: vec3<f32> = vec3<f32>(0.17, 0.085, 0.055);

// What a surface is made of, besides its colour.
struct Matter {
    gloss: f32,
    // Whether the highlight is narrow.
    polished: bool,
    wrap: vec3<f32>,
}

// The tint of what is selected and hovered.
fn tinted(color: vec3<f32>, marks: vec2<f32>) -> vec3<f32> {
    if !marked {
        return color;
    }
    let hovered = mix(color, scene.hovered_tint.rgb, marks.y * scene.hovered_tint.a);
    return mix(hovered, scene.selected_tint.rgb, marks.x * scene.selected_tint.a);
}

// Marked bones glow a little, so that they are found in the shadow too.
fn glow(marks: vec2<f32>, edge: f32) -> vec3<f32> {
    if !marked {
        return vec3(0.0);
    }
    let edge3 = edge * edge * edge;
    return scene.selected_tint.rgb * (marks.x * scene.selected_tint.a * (0.06 + 0.6 * edge3))
        + scene.hovered_tint.rgb * (marks.y * scene.hovered_tint.a * (0.05 + 0.3 * edge3));
}

fn in_studio(in: Surface, n: vec3<f32>, matter: Matter) -> vec3<f32> {
    let v = toward_viewer(in.world);
    let exposed = exposure(in, n);
    let albedo = tinted(in.color, in.marks);
    // Without a survey: what it finds on the whole.
    var open = vec3(0.88);
    if occluded {
        // Light that is caught in a crease takes on the colour of its walls.
        open = pow(vec3(max(exposed.x, 1e-3)), 1.0 - 0.45 * albedo);
    }
    let turned = dot(n, scene.key.xyz);
    let arrives = exposed.y;
    let soft = vec3(arrives) + matter.wrap * (0.55 * arrives * (1.0 - arrives));
    let wrapped = clamp((vec3(turned) + matter.wrap) / (1.0 + matter.wrap), vec3(0.0), vec3(1.0));
    let key = wrapped * soft * mix(vec3(1.0), open, 0.35);
    let sky = 0.5 + 0.5 * n.y;
    let fill = clamp(0.16 + 0.84 * dot(n, scene.fill.xyz), 0.0, 1.0);
    // What is near the ground sees less of the studio.
    let high = 0.6 + 0.4 * smoothstep(-0.1, 0.5, in.world.y - scene.light.z + 0.25 * n.y);
    let around = mix(GROUND, SKY, sky) * high + FILL * (fill * fill * scene.fill.w);
    let edge = 1.0 - clamp(dot(n, v), 0.0, 1.0);
    let behind = clamp(vec2(dot(n, scene.rim_left.xyz), dot(n, scene.rim_right.xyz)), vec2(0.0), vec2(1.0));
    let rim = RIM * ((behind.x + 0.7 * behind.y) * exposed.x * exposed.x);
    let light = around * open + KEY * key + rim;
    let g = max(dot(n, normalize(scene.key.xyz + v)), 0.0);
    let g4 = g * g * g * g;
    let g8 = g4 * g4;
    let shine = select(g8, g8 * g8 * g4, matter.polished) * matter.gloss * clamp(turned * 4.0, 0.0, 1.0);
    let edge3 = edge * edge * edge;
    let sheen = RIM * (edge3 * (0.15 + 0.55 * sky) * exposed.x);
    return albedo * light + KEY * (shine * arrives) + sheen + glow(in.marks, edge);
}

// A soft shoulder: dark and middle tones stay, highlights approach white and never clip. Half of it works on the light
// and half on each colour, so that bright skin turns pale a little and keeps its hue.
fn tone(c: vec3<f32>) -> vec3<f32> {
    let x = max(c, vec3(0.0)) * 0.98;
    let light = max(dot(x, vec3(0.2126, 0.7152, 0.0722)), 1e-4);
    let each = x * inverseSqrt(1.0 + x * x);
    let whole = x * inverseSqrt(1.0 + light * light);
    return clamp(mix(each, whole, 0.5), vec3(0.0), vec3(1.0));
}

// sRGB numbers of light in 0 to 1, to half a step of 255: roots cost a software adapter less than powers.
fn encoded(c: vec3<f32>) -> vec3<f32> {
    let root2 = sqrt(c);
    let root4 = sqrt(root2);
    let root8 = sqrt(root4);
    let high = 0.662002687 * root2 + 0.684122060 * root4 - 0.323583601 * root8 - 0.0225411470 * c;
    return select(high, c * 12.92, c <= vec3(0.0031308));
}

fn painted(color: vec3<f32>) -> vec4<f32> {
    let opacity = figure.look.x;
    return vec4(color * opacity, opacity);
}

fn outward(normal: vec3<f32>, front: bool) -> vec3<f32> {
    return normalize(select(-normal, normal, front));
}

fn studio(in: Surface, front: bool) -> vec4<f32> {
    let n = outward(in.normal, front);
    return painted(encoded(tone(in_studio(in, n, Matter(0.055, true, WRAP)))));
}

// Grey-brown clay with the broad sheen of something moist.
fn clay(in: Surface, front: bool) -> vec4<f32> {
    var of_clay = in;
    let wooden = select(1.0, dot(in.color, vec3(0.9)), colored);
    of_clay.color = vec3(0.375, 0.295, 0.238) * wooden;
    let n = outward(in.normal, front);
    return painted(encoded(tone(in_studio(of_clay, n, Matter(0.075, false, vec3(0.05))))));
}

// Pale wax whose light comes along with the viewer.
fn matcap(in: Surface, front: bool) -> vec4<f32> {
    let n = outward(in.normal, front);
    let v = toward_viewer(in.world);
    let right = normalize(cross(scene.world_from_view[1].xyz, v));
    let m = vec3(dot(n, right), dot(n, cross(v, right)), dot(n, v));
    let exposed = exposure(in, n);
    let d = dot(m, vec3(-0.41, 0.62, 0.67));
    let shade = mix(vec3(0.045, 0.030, 0.036), vec3(0.300, 0.205, 0.172), smoothstep(-0.70, 0.50, d));
    var c = mix(shade, vec3(0.80, 0.715, 0.625), smoothstep(0.10, 1.00, d));
    // A second, cool light low on the other side, a soft gleam, and light that shines through thin edges.
    c += vec3(0.10, 0.14, 0.20) * pow(clamp(dot(m, vec3(0.80, -0.36, 0.48)), 0.0, 1.0), 2.2);
    c += vec3(0.34, 0.33, 0.31) * pow(clamp(dot(m, normalize(vec3(-0.22, 0.40, 0.89))), 0.0, 1.0), 38.0);
    let edge = 1.0 - clamp(m.z, 0.0, 1.0);
    c += vec3(0.30, 0.20, 0.17) * (edge * edge * edge * edge);
    c *= mix(vec3(0.34, 0.22, 0.19), vec3(1.0), exposed.x);
    c *= select(vec3(1.0), in.color * 1.7, colored);
    c = mix(c, c * scene.hovered_tint.rgb * 2.2, in.marks.y * scene.hovered_tint.a);
    c = mix(c, c * scene.selected_tint.rgb * 2.2, in.marks.x * scene.selected_tint.a);
    return painted(encoded(tone(c * 1.06 + glow(in.marks, edge))));
}

// A number in 0 to 1 that looks random and is smooth in space.
fn lattice(p: vec3<f32>) -> f32 {
    return fract(sin(dot(p, vec3(127.1, 311.7, 74.7))) * 43758.5453);
}

fn cloud(p: vec3<f32>) -> f32 {
    let cell = floor(p);
    let f = p - cell;
    let t = f * f * (3.0 - 2.0 * f);
    let low = mix(mix(lattice(cell), lattice(cell + vec3(1.0, 0.0, 0.0)), t.x),
        mix(lattice(cell + vec3(0.0, 1.0, 0.0)), lattice(cell + vec3(1.0, 1.0, 0.0)), t.x), t.y);
    let high = mix(mix(lattice(cell + vec3(0.0, 0.0, 1.0)), lattice(cell + vec3(1.0, 0.0, 1.0)), t.x),
        mix(lattice(cell + vec3(0.0, 1.0, 1.0)), lattice(cell + vec3(1.0, 1.0, 1.0)), t.x), t.y);
    return mix(low, high, t.z);
}

// Wood in the tone of the part, with grain along it and a turned groove along its borders.
fn wood(in: PartSurface) -> Surface {
    var s = Surface(in.clip, in.world, in.normal, in.color, in.marks);
    let tones = array<vec3<f32>, 3>(vec3(0.60, 0.395, 0.215), vec3(0.335, 0.180, 0.088), vec3(0.465, 0.275, 0.135));
    let grey = tones[min(in.part.y, 2u)];
    let along = select(in.rest, in.rest.yxz, in.part.z == 1u);
    let bent = cloud(along * vec3(7.0, 22.0, 22.0));
    let rings = fract(length(along.yz + vec2(0.11, 0.05)) * 95.0 + bent * 2.2);
    let grain = smoothstep(0.0, 0.75, rings) * (1.0 - smoothstep(0.75, 1.0, rings));
    let groove = smoothstep(0.0010, 0.0024, in.border);
    let bevel = 1.0 + 0.18 * (1.0 - smoothstep(0.0024, 0.0060, in.border));
    s.color = grey * (0.86 + 0.20 * grain) * mix(0.16, bevel, groove);
    return s;
}

// One colour for each part of the body, in light and in shade, with a crisp border.
fn flat_tones(in: PartSurface, front: bool) -> vec4<f32> {
    let n = outward(in.normal, front);
    let s = Surface(in.clip, in.world, in.normal, in.color, in.marks);
    let tones = array<vec3<f32>, 3>(vec3(0.925, 0.800, 0.675), vec3(0.770, 0.560, 0.470), vec3(0.850, 0.685, 0.560));
    let exposed = exposure(s, n);
    let turned = dot(n, scene.key.xyz) - 0.06;
    let crisp = clamp(turned / max(fwidth(turned), 1e-4) + 0.5, 0.0, 1.0);
    let edge = exposed.y - 0.5;
    let thrown = clamp(edge / max(fwidth(edge), 1e-2) + 0.5, 0.0, 1.0);
    // Nothing casts a sharp shadow along the border of the light.
    let bright = min(crisp, mix(1.0, thrown, smoothstep(0.0, 0.12, turned)));
    let base = tones[min(in.part.y, 2u)];
    let dark = base * vec3(0.68, 0.63, 0.70);
    let groove = mix(0.74, 1.0, smoothstep(0.0006, 0.0018, in.border));
    var c = mix(dark, base, bright) * groove;
    c = mix(c, encoded(scene.hovered_tint.rgb) * mix(0.7, 1.0, bright), in.marks.y * scene.hovered_tint.a);
    c = mix(c, encoded(scene.selected_tint.rgb) * mix(0.7, 1.0, bright), in.marks.x * scene.selected_tint.a);
    return painted(c);
}

// White paper with lines: those of the survey, or, without one, the surface where it turns away.
fn drawing(in: Surface, front: bool) -> vec4<f32> {
    let n = outward(in.normal, front);
    let facing = dot(n, toward_viewer(in.world));
    let turning = clamp((0.30 - facing) * 6.0, 0.0, 1.0);
    let ink = select(turning, inked(in.clip.xy), occluded);
    var paper = PAPER;
    paper = mix(paper, mix(PAPER, encoded(scene.hovered_tint.rgb), 0.75), in.marks.y * scene.hovered_tint.a);
    paper = mix(paper, mix(PAPER, encoded(scene.selected_tint.rgb), 0.85), in.marks.x * scene.selected_tint.a);
    return painted(mix(paper, INK, ink));
}

// Ground carries the lines of the grid, as ground.wgsl has them on the plane.
override lined: bool = false;

// Coverage of lines every `spacing`, fading as they crowd.
fn lines(at: vec2<f32>, pixel: vec2<f32>, spacing: f32) -> vec2<f32> {
    let off = abs(fract(at / spacing + 0.5) - 0.5) * spacing;
    let cover = clamp(1.1 - off / pixel, vec2(0.0), vec2(1.0));
    return cover * (1.0 - smoothstep(vec2(0.1), vec2(0.4), pixel / spacing));
}

// How much of the ground is there, 1 around the camera's target and 0 from where the grid has faded out.
fn presence(world: vec3<f32>) -> f32 {
    let away = length(world.xz - scene.ground.xz) / scene.ground.y;
    return 1.0 - smoothstep(0.35, 0.98, away);
}

// How much of the grid's lines is at a place.
fn grid_on(at: vec2<f32>, pixel: vec2<f32>, n: vec3<f32>) -> f32 {
    if !lined {
        return 0.0;
    }
    // A line that runs along a riser would cover it whole.
    let level = vec2(1.0) - n.xz * n.xz;
    let fine = lines(at, pixel, scene.ground.w) * level;
    let metre = lines(at, pixel, scene.ground.w * 10.0) * level;
    return max(max(fine.x, fine.y) * 0.10, max(metre.x, metre.y) * 0.30);
}

@fragment
fn fs_ground(in: Surface) -> @location(0) vec4<f32> {
    let there = presence(in.world);
    let pixel = max(fwidth(in.world.xz), vec2(1e-5));
    let n = normalize(in.normal);
    let exposed = exposure(in, n);
    var open = 0.88;
    if occluded {
        open = clamp(exposed.x * 1.12, 0.0, 1.0);
    }
    let key = clamp(dot(n, scene.key.xyz), 0.0, 1.0) * exposed.y;
    let light = mix(GROUND, SKY, 0.5 + 0.5 * n.y) * (1.6 * mix(0.35, 1.0, open)) + KEY * (key * mix(0.6, 1.0, open));
    var c = encoded(tone(in.color * light));
    let bright = dot(scene.background_top.rgb + scene.background_bottom.rgb, vec3(1.0 / 6.0)) > 0.5;
    c = mix(c, select(vec3(0.86, 0.88, 0.91), vec3(0.12, 0.14, 0.17), bright), grid_on(in.world.xz, pixel, n));
    return painted(c) * there;
}

// Ground in a drawing: paper with the survey's lines and, in pencil, those of the grid.
@fragment
fn fs_ground_line(in: Surface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let pixel = max(fwidth(in.world.xz), vec2(1e-5));
    let drawn = drawing(in, front).rgb;
    let pencilled = mix(drawn, INK, grid_on(in.world.xz, pixel, normalize(in.normal)) * 0.9);
    return painted(mix(PAPER, pencilled, presence(in.world)));
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
    return drawing(in, front);
}

@fragment
fn fs_flat(in: PartSurface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    return flat_tones(in, front);
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
    let depth = view_depth(in.world);
    let nearness = (scene.ranges.y - depth) / max(scene.ranges.y - scene.ranges.x, 1e-6);
    return vec4(vec3(clamp(nearness, 0.0, 1.0)), 1.0);
}

@fragment
fn fs_normal(in: Surface, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    let n = outward(in.normal, front);
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
