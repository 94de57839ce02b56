//! The shaders' sources, put together from the files in `shaders/`.

/// The figure in every pass.
pub(crate) const FIGURE: &str = concat!(
    include_str!("../../../shaders/scene.wgsl"),
    include_str!("../../../shaders/survey.wgsl"),
    include_str!("../../../shaders/skin.wgsl"),
    include_str!("../../../shaders/figure.wgsl")
);
/// Crowds in every pass.
pub(crate) const CROWD: &str = concat!(
    include_str!("../../../shaders/scene.wgsl"),
    include_str!("../../../shaders/survey.wgsl"),
    include_str!("../../../shaders/skin.wgsl"),
    include_str!("../../../shaders/figure.wgsl"),
    include_str!("../../../shaders/crowd.wgsl")
);
/// Depth from the key light.
pub(crate) const SHADOW: &str = concat!(
    include_str!("../../../shaders/scene.wgsl"),
    include_str!("../../../shaders/skin.wgsl"),
    include_str!("../../../shaders/shadow.wgsl")
);
/// The shadow on the ground, softened.
pub(crate) const SOFTEN: &str = concat!(
    include_str!("../../../shaders/scene.wgsl"),
    include_str!("../../../shaders/spiral.wgsl"),
    include_str!("../../../shaders/soften.wgsl")
);
/// The gradient behind everything.
pub(crate) const BACKDROP: &str =
    concat!(include_str!("../../../shaders/scene.wgsl"), include_str!("../../../shaders/backdrop.wgsl"));
/// The picture for reference.
pub(crate) const IMAGE: &str =
    concat!(include_str!("../../../shaders/scene.wgsl"), include_str!("../../../shaders/image.wgsl"));
/// Grid and shadow on the ground.
pub(crate) const GROUND: &str = concat!(
    include_str!("../../../shaders/scene.wgsl"),
    include_str!("../../../shaders/survey.wgsl"),
    include_str!("../../../shaders/ground.wgsl")
);
/// How open and how lit places are.
pub(crate) const OCCLUSION: &str = concat!(
    include_str!("../../../shaders/scene.wgsl"),
    include_str!("../../../shaders/spiral.wgsl"),
    include_str!("../../../shaders/occlusion.wgsl")
);
/// The same, smooth.
pub(crate) const SMOOTH: &str =
    concat!(include_str!("../../../shaders/scene.wgsl"), include_str!("../../../shaders/smooth.wgsl"));
/// The lines of a drawing.
pub(crate) const TRACE: &str =
    concat!(include_str!("../../../shaders/scene.wgsl"), include_str!("../../../shaders/trace.wgsl"));
/// Lines and points.
pub(crate) const OVERLAY: &str =
    concat!(include_str!("../../../shaders/scene.wgsl"), include_str!("../../../shaders/overlay.wgsl"));
/// Balls and sheets.
pub(crate) const SURFACES: &str =
    concat!(include_str!("../../../shaders/scene.wgsl"), include_str!("../../../shaders/surfaces.wgsl"));
/// The picture into another pass.
pub(crate) const BLIT: &str = include_str!("../../../shaders/blit.wgsl");

#[cfg(test)]
mod tests {
    use wgpu::naga;

    /// Every source, so that a file that no picture happens to use is still checked.
    const ALL: [(&str, &str); 13] = [
        ("figure", super::FIGURE),
        ("crowd", super::CROWD),
        ("shadow", super::SHADOW),
        ("soften", super::SOFTEN),
        ("backdrop", super::BACKDROP),
        ("image", super::IMAGE),
        ("ground", super::GROUND),
        ("overlay", super::OVERLAY),
        ("surfaces", super::SURFACES),
        ("occlusion", super::OCCLUSION),
        ("smooth", super::SMOOTH),
        ("trace", super::TRACE),
        ("blit", super::BLIT),
    ];

    fn fault(source: &str) -> Option<String> {
        let module = match naga::front::wgsl::parse_str(source) {
            Ok(module) => module,
            Err(error) => return Some(error.emit_to_string(source)),
        };
        let flags = naga::valid::ValidationFlags::all();
        // No optional capability: the shaders must do with what every device has.
        let mut validator = naga::valid::Validator::new(flags, naga::valid::Capabilities::empty());
        validator.validate(&module).err().map(|e| e.emit_to_string(source))
    }

    #[test]
    fn every_shader_is_valid() {
        for (name, source) in ALL {
            assert_eq!(fault(source), None, "{name}.wgsl");
        }
        assert!(fault("fn f() -> f32 { return 1u; }").is_some(), "the validator must be able to object");
    }

    #[test]
    fn uniforms_are_as_large_as_their_twins() {
        let module = naga::front::wgsl::parse_str(super::CROWD).unwrap();
        let mut layouter = naga::proc::Layouter::default();
        layouter.update(module.to_ctx()).unwrap();
        let size = |name: &str| {
            let (handle, _) = module.types.iter().find(|(_, t)| t.name.as_deref() == Some(name)).unwrap();
            layouter[handle].size as usize
        };
        assert_eq!(size("Scene"), size_of::<crate::uniforms::SceneUniform>());
        assert_eq!(size("Crowd"), size_of::<crate::crowd::CrowdUniform>());
        let padding = size_of::<[f32; 40]>();
        assert_eq!(size("Figure") + padding, size_of::<crate::uniforms::FigureUniform>());
    }
}
