//! The shaders' sources, put together from the files in `shaders/`.

/// The figure in every pass.
pub(crate) const FIGURE: &str = concat!(
    include_str!("../../../shaders/scene.wgsl"),
    include_str!("../../../shaders/skin.wgsl"),
    include_str!("../../../shaders/figure.wgsl")
);
/// Depth from the key light.
pub(crate) const SHADOW: &str = concat!(
    include_str!("../../../shaders/scene.wgsl"),
    include_str!("../../../shaders/skin.wgsl"),
    include_str!("../../../shaders/shadow.wgsl")
);
/// The gradient behind everything.
pub(crate) const BACKDROP: &str =
    concat!(include_str!("../../../shaders/scene.wgsl"), include_str!("../../../shaders/backdrop.wgsl"));
/// Grid and shadow on the ground.
pub(crate) const GROUND: &str =
    concat!(include_str!("../../../shaders/scene.wgsl"), include_str!("../../../shaders/ground.wgsl"));
/// Lines and points.
pub(crate) const OVERLAY: &str =
    concat!(include_str!("../../../shaders/scene.wgsl"), include_str!("../../../shaders/overlay.wgsl"));
/// The picture into another pass.
pub(crate) const BLIT: &str = include_str!("../../../shaders/blit.wgsl");
