//! The window's controls, found by their labels and driven as a hand would, without a display.
#![allow(clippy::unwrap_used)]

mod body;
mod chain;
mod chain_driving;
mod files;
mod grabbing;
mod hand;
mod handles;
mod library;
mod looks;
mod mechanics;
mod parts;
mod picture;
mod program;
mod reaching;
mod selection;
mod sliders;
mod views;
mod walking;
