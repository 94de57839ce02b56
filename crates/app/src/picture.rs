//! Pictures without a window: stills of any size, moving pictures, keypoints, sheets of many poses.

mod changed;
mod choices;
mod darkroom;
mod facts;
mod film;
mod following;
mod framing;
mod gif;
mod keypoints;
mod keypoints_file;
mod mp4;
mod naming;
mod order;
mod png;
mod sheet;
mod shot;
mod subject;
mod turntable;
mod underfoot;
mod webp;
mod words;
mod work;

use std::path::Path;

use render::Image;

pub use choices::{Choices, MOST_EDGE, MOST_FRAMES};
pub use darkroom::{Darkroom, bounds, open_gpu, rest_positions};
pub use facts::Facts;
pub use film::Film;
pub use following::{following, smoothed};
pub use framing::fit;
pub use keypoints::Landmarks;
pub use keypoints_file::keypoints_text;
pub use naming::{Format, Naming};
pub use order::{Moment, Order, title_of};
pub use png::Shape;
pub use sheet::{Sheet, Tile, on_plain};
pub use shot::{Shot, Viewpoint, camera_words, pass_name, style_name};
pub use subject::{Posed, Standing, Subject};
pub use turntable::{around, turntable};
pub use underfoot::Underfoot;
pub use work::Work;

use crate::failure::Failure;

/// Writes a picture as a PNG that can be clear, whole or not at all.
///
/// # Errors
/// A file that can't be written.
pub fn write_png(image: &Image, facts: &Facts, path: &Path) -> Result<(), Failure> {
    let shape = Shape { size: [image.width, image.height], alpha: true };
    png::write_rows(path, shape, facts, |rows| rows.take(&image.rgba))
}
