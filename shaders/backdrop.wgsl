// The studio behind everything: a wall that runs into the floor in one sweep, with a pool of light on both behind the
// figures. Smooth, so the colour is found at the corners of a net and mixed between them. Follows scene.wgsl.

struct Backdrop {
    @builtin(position) clip: vec4<f32>,
    @location(0) color: vec3<f32>,
}

// As in record.rs.
const ACROSS: u32 = 20u;
const DOWN: u32 = 14u;

// What the camera sees at a place of the picture (-1 to 1, y up).
fn studio_at(place: vec2<f32>) -> vec3<f32> {
    let on_lens = vec3(place * scene.lens.xy, 0.0);
    let sight = mix(vec3(0.0, 0.0, -1.0), vec3(on_lens.xy, -1.0), scene.lens.z);
    let toward = normalize((scene.world_from_view * vec4(sight, 0.0)).xyz);
    let eye = (scene.world_from_view * vec4(on_lens * (1.0 - scene.lens.z), 1.0)).xyz;
    // The sweep: plain height in the picture where the wall is, and the floor's own distance below it.
    let base = mix(scene.background_bottom.rgb, scene.background_top.rgb, smoothstep(0.0, 1.0, place.y * 0.5 + 0.5));
    let fall = max(-toward.y, 1e-3);
    let spot = eye + toward * (max(eye.y, 0.0) / fall);
    let off = length(spot.xz - scene.ground.xz) / 1.5;
    let on_floor = smoothstep(0.02, 0.22, -toward.y) * step(0.0, eye.y);
    let floor_pool = exp(-off * off * 0.55) * on_floor;
    let aside = place * vec2(scene.tile.z / scene.tile.w, 1.0) - vec2(0.0, 0.12);
    let wall_pool = exp(-dot(aside, aside) * 0.9) * (1.0 - 0.7 * on_floor);
    let corner = dot(place, place) * 0.5;
    let pool = scene.lens.w * (0.17 * wall_pool + 0.20 * floor_pool);
    let dim = 1.0 - scene.lens.w * 0.16 * corner * corner;
    return (base + (1.0 - base) * base * (2.0 * pool)) * dim;
}

@vertex
fn vs_backdrop(@builtin(vertex_index) index: u32) -> Backdrop {
    let quad = index / 6u;
    // Two triangles a quad, two bits a corner: 0 1 2, 2 1 3.
    let which = (0xda4u >> (2u * (index % 6u))) & 3u;
    let at = vec2(f32(quad % ACROSS + (which & 1u)) / f32(ACROSS), f32(quad / ACROSS + (which >> 1u)) / f32(DOWN));
    // The net is the whole picture's, whatever part of it is drawn.
    let place = at * vec2(2.0, -2.0) + vec2(-1.0, 1.0);
    let pixel = (place * vec2(0.5, -0.5) + 0.5) * scene.tile.zw - scene.tile.xy;
    let clip = pixel * scene.viewport.zw * vec2(2.0, -2.0) + vec2(-1.0, 1.0);
    return Backdrop(vec4(clip, 1.0, 1.0), studio_at(place));
}

@fragment
fn fs_backdrop(in: Backdrop) -> @location(0) vec4<f32> {
    // Less than one step of noise against bands.
    let noise = fract(52.9829189 * fract(dot(in.clip.xy + scene.tile.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
    return vec4(in.color + noise * (0.9 / 255.0), 1.0);
}
