// Depth of the figures, alone: from the key light, or before a translucent figure. Follows scene.wgsl and skin.wgsl.

@vertex
fn vs_shadow(skin: SkinVertex) -> @builtin(position) vec4<f32> {
    let at = (scene.shadow_from_world * vec4(world_position(skin), 1.0)).xyz;
    return vec4(at.x * 2.0 - 1.0, 1.0 - at.y * 2.0, at.z, 1.0);
}

