//! What can go wrong while drawing.

/// Why there is no picture.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum DrawError {
    /// No pixels, or more than the device can hold.
    #[error("a picture of {width}x{height} pixels cannot be drawn: each edge must be 1 to {limit}")]
    Size {
        /// Asked width, pixels.
        width: u32,
        /// Asked height, pixels.
        height: u32,
        /// The device's longest edge, pixels.
        limit: u32,
    },
    /// A picture that doesn't fit into memory.
    #[error("a picture of {width}x{height} pixels doesn't fit into memory")]
    Memory {
        /// Asked width, pixels.
        width: u32,
        /// Asked height, pixels.
        height: u32,
    },
    /// The skin breaks its own rules.
    #[error("the skin cannot be drawn: {0}")]
    Mesh(String),
    /// A figure shows a skin that was never set.
    #[error("figure {figure} shows skin {skin}, which has not been set")]
    NoSkin {
        /// Place in [`crate::Scene::figures`].
        figure: usize,
        /// The slot that it names.
        skin: usize,
    },
    /// A crowd's matrices are fewer than its figures need.
    #[error(
        "crowd {crowd} has {found} numbers, which is too few for {rows} matrices of each of {count} figures, {lanes} abreast (at least 1 abreast, and {} matrices)",
        rig::PLACES
    )]
    CrowdNumbers {
        /// Place in [`crate::Scene::crowds`].
        crowd: usize,
        /// Numbers given.
        found: usize,
        /// Its figures.
        count: usize,
        /// Figures abreast.
        lanes: usize,
        /// Matrices of a figure.
        rows: usize,
    },
    /// A crowd is larger than the device can hold.
    #[error("crowd {crowd} of {count} figures cannot be drawn: the graphics adapter holds at most {limit}")]
    CrowdSize {
        /// Place in [`crate::Scene::crowds`].
        crowd: usize,
        /// Its figures.
        count: usize,
        /// Figures that the device can hold.
        limit: usize,
    },
    /// A crowd shows a skin that was never set.
    #[error("crowd {crowd} shows skin {skin}, which has not been set")]
    CrowdNoSkin {
        /// Place in [`crate::Scene::crowds`].
        crowd: usize,
        /// The slot that it names.
        skin: usize,
    },
    /// The device can't draw crowds at all; its name.
    #[error("the graphics adapter \"{0}\" can't draw crowds: its vertex shaders read no storage buffers")]
    CrowdDevice(String),
    /// The driver complained or lost the device.
    #[error("the graphics driver failed: {0}")]
    Driver(String),
}
