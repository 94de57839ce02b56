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
    /// The driver complained or lost the device.
    #[error("the graphics driver failed: {0}")]
    Driver(String),
}
