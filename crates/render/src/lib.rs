//! Draws posed figures into a texture: scene in, picture out. The window and the command line share every line.
//!
//! A [`Gpu`] is opened once; a [`Renderer`] keeps what lives there (meshes, pipelines, the picture); a [`Scene`]
//! is plain data, made anew for each picture. [`Renderer::draw`] records into the caller's encoder and leaves the
//! picture in a texture, which a [`Blit`] paints into a window; [`Renderer::image`] reads it back, and
//! [`Renderer::bands`] makes one of any size a few rows at a time.

mod backdrop;
mod bands;
mod blit;
mod bodies;
mod crowd;
mod errors;
mod figures;
mod flat;
mod gpu;
mod image;
mod keypoints;
mod layered;
mod layouts;
mod light;
mod openpose;
mod overlay;
mod paints;
mod parts;
mod pipelines;
mod recipe;
mod record;
mod renderer;
mod scene;
mod scene_buffer;
mod shaders;
mod shadow;
mod skins;
mod stats;
mod surfaces;
mod survey;
mod target;
mod tile;
mod uniforms;

pub use bands::Band;
pub use blit::Blit;
pub use crowd::CrowdView;
pub use errors::DrawError;
pub use gpu::{Gpu, GpuError};
pub use image::{Image, canvas, read};
pub use keypoints::{BODY_POINTS, FOOT_POINTS, HAND_POINTS, Keypoints};
pub use overlay::{Ball, Color, Fan, Layer, Line, Marker, Overlay, Shape};
pub use parts::{part_color, part_of_color};
pub use renderer::Renderer;
pub use scene::{FigureView, Look, Msaa, Pass, Scene, Style};
pub use stats::Stats;
