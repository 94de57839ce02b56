//! Other programs' files, bytes in and values out: no disk, no clock.

pub mod chain_file;
pub mod figure;
pub mod glb;
pub mod solid;
mod spot;
pub mod urdf;

pub use figure::FigureError;
pub use spot::Spot;
