//! Posewright, the program: command line, window and disk around the crates that do the work.

pub mod cli;
pub mod disk;
pub mod failure;
pub mod load;
pub mod picture;
pub mod window;
