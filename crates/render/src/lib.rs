//! Draws posed figures into a texture: scene in, picture out. The window and the command line share every line.
//!
//! A [`Gpu`] is opened once; a [`Renderer`] keeps what lives there (meshes, pipelines, the picture); a [`Scene`]
//! is plain data, made anew for each picture. [`Renderer::draw`] records into the caller's encoder and leaves the
//! picture in a texture, which a [`Blit`] paints into a window; [`Renderer::image`] reads it back.

mod backdrop;
mod blit;
mod errors;
mod figures;
mod gpu;
mod image;
mod layered;
mod layouts;
mod light;
mod openpose;
mod overlay;
mod pipelines;
mod recipe;
mod renderer;
mod scene;
mod shaders;
mod shadow;
mod skins;
mod surfaces;
mod target;
mod uniforms;

pub use blit::Blit;
pub use errors::DrawError;
pub use gpu::{Gpu, GpuError};
pub use image::{Image, read};
pub use overlay::{Ball, Color, Fan, Layer, Line, Marker, Overlay, Shape};
pub use renderer::Renderer;
pub use scene::{FigureView, Look, Msaa, Pass, Scene};
