// Lines and points of a width in pixels, smooth at their edges: each a capsule between two world points.
// A point is a line without length. Follows scene.wgsl.

struct Stroke {
    @location(0) from_world: vec3<f32>,
    @location(1) to_world: vec3<f32>,
    // sRGB, straight alpha.
    @location(2) color: vec4<f32>,
    @location(3) outline: vec4<f32>,
    // x: radius, y: width of the outline outside it, z: period of the dashes or 0, all in pixels; w: which shape.
    @location(4) shape: vec4<f32>,
}

// Shapes: twins of `Form` in overlay.rs.
const ELLIPSE: f32 = 1.0;
const RING: f32 = 2.0;
const DIAMOND: f32 = 3.0;
const SQUARE: f32 = 4.0;
const CROSS: f32 = 5.0;
// A diamond reaches farther than its radius, so that it looks as large as a disc.
const FARTHEST: f32 = 1.3;

struct Ink {
    @builtin(position) clip: vec4<f32>,
    @location(0) @interpolate(flat) from_px: vec2<f32>,
    @location(1) @interpolate(flat) to_px: vec2<f32>,
    @location(2) @interpolate(flat) color: vec4<f32>,
    @location(3) @interpolate(flat) outline: vec4<f32>,
    @location(4) @interpolate(flat) shape: vec4<f32>,
}

fn pixel_of(clip: vec4<f32>) -> vec2<f32> {
    return (clip.xy / clip.w * vec2(0.5, -0.5) + 0.5) * scene.viewport.xy;
}

// The part of a line that lies before the near plane is cut off.
fn cut(inner: vec4<f32>, outer: vec4<f32>) -> vec4<f32> {
    if outer.z >= 0.0 || inner.z <= 0.0 {
        return outer;
    }
    return mix(outer, inner, -outer.z / (inner.z - outer.z));
}

@vertex
fn vs_stroke(@builtin(vertex_index) index: u32, in: Stroke) -> Ink {
    let a = scene.clip_from_world * vec4(in.from_world, 1.0);
    let b = scene.clip_from_world * vec4(in.to_world, 1.0);
    let start = cut(b, a);
    let end = cut(a, b);
    var out: Ink;
    out.color = in.color;
    out.outline = in.outline;
    out.shape = in.shape;
    if start.z < 0.0 || end.z < 0.0 || start.w <= 0.0 || end.w <= 0.0 {
        out.clip = vec4(0.0, 0.0, 2.0, 1.0);
        return out;
    }
    out.from_px = pixel_of(start);
    out.to_px = pixel_of(end);
    let run = out.to_px - out.from_px;
    let long = length(run);
    let along = select(vec2(1.0, 0.0), run / max(long, 1e-6), long > 1e-3);
    let across = vec2(-along.y, along.x);
    let reach = in.shape.x * select(1.0, FARTHEST, in.shape.w > ELLIPSE) + in.shape.y + 1.0;
    let tip = f32(index & 1u) * 2.0 - 1.0;
    let side = f32(index >> 1u) * 2.0 - 1.0;
    let at = select(out.from_px, out.to_px, tip > 0.0) + (along * tip + across * side) * reach;
    let near = select(start, end, tip > 0.0);
    let ndc = (at * scene.viewport.zw - 0.5) * vec2(2.0, -2.0);
    // A hair toward the viewer, so that marks on a surface are not swallowed by it.
    out.clip = vec4(ndc * near.w, near.z * (1.0 - 2e-5), near.w);
    return out;
}

// How far a place lies outside a point's shape (negative: inside), pixels.
fn outside(off: vec2<f32>, radius: f32, form: f32) -> f32 {
    let q = abs(off);
    if form == RING {
        let half = max(0.16 * radius, 0.8);
        return abs(length(off) - radius + half) - half;
    }
    if form == DIAMOND {
        return (q.x + q.y - FARTHEST * radius) * 0.70710678;
    }
    if form == SQUARE {
        return max(q.x, q.y) - 0.88 * radius;
    }
    // Two bars across each other: of the two, the one along which this place lies.
    let half = max(0.2 * radius, 0.9);
    let along = (q.x + q.y) * 0.70710678;
    let across = abs(q.x - q.y) * 0.70710678;
    return length(vec2(max(along - FARTHEST * radius + half, 0.0), across)) - half;
}

fn ink(in: Ink) -> vec4<f32> {
    let run = in.to_px - in.from_px;
    let off = in.clip.xy - in.from_px;
    let long2 = dot(run, run);
    let t = clamp(dot(off, run) / max(long2, 1e-9), 0.0, 1.0);
    var away = length(off - run * t);
    if in.shape.w > ELLIPSE {
        away = in.shape.x + outside(off, in.shape.x, in.shape.w);
    } else if in.shape.w == ELLIPSE && long2 > 1e-6 {
        // An ellipse with the line as its long axis.
        let half = 0.5 * sqrt(long2);
        let along = run / (2.0 * half);
        let q = off - run * 0.5;
        let e = vec2(dot(q, along) / half, (q.x * -along.y + q.y * along.x) / in.shape.x);
        let k = length(e);
        let slope = length(e / vec2(half, in.shape.x));
        away = in.shape.x + select((k - 1.0) * k / max(slope, 1e-6), -in.shape.x, k < 1e-4);
    }
    var fill = clamp(in.shape.x + 0.5 - away, 0.0, 1.0);
    if in.shape.z > 0.0 {
        // Ink for 0.56 of each period, starting at the line's beginning.
        let off_middle = abs(fract(t * sqrt(long2) / in.shape.z + 0.22) - 0.5);
        fill *= clamp((0.28 - off_middle) * in.shape.z + 0.5, 0.0, 1.0);
    }
    let edge = clamp(in.shape.x + in.shape.y + 0.5 - away, 0.0, 1.0) * in.outline.a;
    let base = vec4(in.outline.rgb * edge, edge);
    let top = vec4(in.color.rgb, 1.0) * (in.color.a * fill);
    return top + base * (1.0 - fill * in.color.a);
}

@fragment
fn fs_stroke(in: Ink) -> @location(0) vec4<f32> {
    return ink(in);
}

// What of a ghosted stroke lies behind something.
@fragment
fn fs_hidden(in: Ink) -> @location(0) vec4<f32> {
    return ink(in) * 0.28;
}
