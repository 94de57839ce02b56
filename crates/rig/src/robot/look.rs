//! What a robot's links look like and weigh.

use std::sync::Arc;

use glam::DVec3;
use kin::Frame;

use super::Solid;

/// A part of a robot that moves as one.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct RobotLink {
    /// Its name, of which a robot has one.
    pub name: String,
    /// What is seen of it.
    pub visuals: Vec<Visual>,
    /// What bumps into things: kept to be written again, otherwise unused. Their meshes are never read.
    pub collisions: Vec<Visual>,
    /// What it weighs, if the file says.
    pub inertial: Option<Inertial>,
    /// Where it ends, in its own frame, metres; `None` where that follows from what it carries and looks like: see
    /// [`Robot::tip`](crate::Robot::tip).
    pub tip: Option<DVec3>,
}

/// A shape somewhere on a link.
#[derive(Clone, PartialEq, Debug)]
pub struct Visual {
    /// Its name, if it has one.
    pub name: Option<String>,
    /// Where it is on its link.
    pub link_from_visual: Frame,
    /// What it is.
    pub shape: Shape,
    /// What it is painted with; `None` leaves a mesh its own colours and others a light grey.
    pub paint: Option<Paint>,
}

/// A shape about the origin of its own frame, metres.
#[derive(Clone, PartialEq, Debug)]
pub enum Shape {
    /// A box of those edges.
    Box(DVec3),
    /// A cylinder along z.
    Cylinder {
        /// Its radius.
        radius: f64,
        /// Its whole length.
        length: f64,
    },
    /// A cylinder along z with half a ball on either end.
    Capsule {
        /// Its radius.
        radius: f64,
        /// Its length without the ends.
        length: f64,
    },
    /// A ball of that radius.
    Sphere(f64),
    /// A mesh of another file.
    Mesh {
        /// The file as the robot's file names it.
        file: String,
        /// Factors along its axes.
        scale: DVec3,
        /// Its triangles before scaling; `None` if it could not be had.
        solid: Option<Arc<Solid>>,
    },
}

/// A colour as the file gives it.
#[derive(Clone, PartialEq, Debug)]
pub struct Paint {
    /// The material's name; empty where it has none.
    pub name: String,
    /// Red, green, blue, opacity, each 0 to 1, as on a screen (sRGB).
    pub rgba: [f64; 4],
}

impl Paint {
    /// Red, green and blue as linear light.
    pub fn linear_rgb(&self) -> [f32; 3] {
        let linear = |c: f64| {
            let c = c.clamp(0.0, 1.0);
            if c <= 0.040_45 { c / 12.92 } else { ((c + 0.055) / 1.055).powf(2.4) }
        };
        [0, 1, 2].map(|i| linear(self.rgba[i]) as f32)
    }
}

/// Mass and how it is spread.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Inertial {
    /// The frame of the inertia on its link; its origin is the centre of mass.
    pub link_from_inertia: Frame,
    /// Kilograms.
    pub mass: f64,
    /// xx, xy, xz, yy, yz, zz in kg·m².
    pub inertia: [f64; 6],
}
