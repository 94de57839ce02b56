// The studio behind everything: a soft gradient over the whole picture. Follows scene.wgsl.

struct Backdrop {
    @builtin(position) clip: vec4<f32>,
    @location(0) color: vec3<f32>,
}

@vertex
fn vs_backdrop(@builtin(vertex_index) index: u32) -> Backdrop {
    let at = vec2(f32(index & 1u), f32(index >> 1u));
    let height = place_in_picture(at * scene.viewport.xy).y;
    var out: Backdrop;
    out.clip = vec4(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, 1.0, 1.0);
    out.color = mix(scene.background_bottom.rgb, scene.background_top.rgb, height * 0.5 + 0.5);
    return out;
}

@fragment
fn fs_backdrop(in: Backdrop) -> @location(0) vec4<f32> {
    // Less than one step of noise against bands.
    let noise = fract(52.9829189 * fract(dot(in.clip.xy + scene.tile.xy, vec2(0.06711056, 0.00583715)))) - 0.5;
    return vec4(in.color + noise * (0.9 / 255.0), 1.0);
}
