// What every pass knows. Colours are sRGB numbers except where they meet light, in figure.wgsl.
// Twin of `SceneUniform` in crates/render/src/uniforms.rs.

struct Scene {
    clip_from_world: mat4x4<f32>,
    view_from_world: mat4x4<f32>,
    // Orthographic: xy is the place in the shadow map, z the depth there.
    shadow_from_world: mat4x4<f32>,
    shadow_from_view: mat4x4<f32>,
    world_from_view: mat4x4<f32>,
    // Half the height of the view is y, half its width x: at depth 1 in perspective, everywhere in orthographic
    // projection. z: 1 and 0 for these; w: how much light and shade the background has.
    lens: vec4<f32>,
    // View depth is (x depth + y) / (z depth + w), negative before the eye.
    unproject: vec4<f32>,
    // Perspective: the eye and 1. Orthographic: the direction to the viewer and 0.
    eye: vec4<f32>,
    // Unit direction to the key light; w: 1 with shadows, 0 without.
    key: vec4<f32>,
    // Unit direction to the fill light, which moves with the camera; w: its strength.
    fill: vec4<f32>,
    // Unit directions to the lights behind the figures, which move with the camera.
    rim_left: vec4<f32>,
    rim_right: vec4<f32>,
    // Width, height and their inverses, pixels, of what is drawn.
    viewport: vec4<f32>,
    // What is drawn is a part of a picture: xy: its upper left pixel, zw: size of the whole.
    tile: vec4<f32>,
    background_top: vec4<f32>,
    background_bottom: vec4<f32>,
    // x: nearest, y: farthest view depth of the figures; z: width of a shadow texel in metres; w: 1 / shadow size.
    ranges: vec4<f32>,
    // x: nearest, y: farthest view depth that a survey tells apart.
    surveyed: vec4<f32>,
    // xz: centre; y: radius at which the grid has faded out; w: spacing of the fine lines.
    ground: vec4<f32>,
    // A rectangle around the figures in what is drawn, clip space: least x, least y, greatest x, greatest y.
    silhouette: vec4<f32>,
    // The figures' shadow on the ground: least x, least z, greatest x, greatest z.
    footprint: vec4<f32>,
    // x: depth of the shadow map, metres; y: opacity of the picture for reference;
    // z: height at which the figures stand, metres.
    light: vec4<f32>,
    // Linear; w: strength.
    selected_tint: vec4<f32>,
    hovered_tint: vec4<f32>,
}

@group(0) @binding(0) var<uniform> scene: Scene;

fn toward_viewer(world: vec3<f32>) -> vec3<f32> {
    return normalize(scene.eye.xyz - world * scene.eye.w);
}

// A place of what is drawn, given as pixels, in the whole picture: -1 to 1, y up.
fn place_in_picture(pixel: vec2<f32>) -> vec2<f32> {
    return ((pixel + scene.tile.xy) / scene.tile.zw - 0.5) * vec2(2.0, -2.0);
}

// View space from a place in the whole picture (0 to 1, y down) and the depth buffer's number there.
fn place_in_view(at: vec2<f32>, depth: f32) -> vec3<f32> {
    let z = (scene.unproject.x * depth + scene.unproject.y) / (scene.unproject.z * depth + scene.unproject.w);
    let across = (at * 2.0 - 1.0) * vec2(1.0, -1.0) * scene.lens.xy;
    return vec3(across * mix(1.0, -z, scene.lens.z), z);
}
