//! Writing a part down: shapes one after another.

use super::field::{Blob, Op, Part, Region};
use super::shape::Shape;

impl Part {
    /// An empty part that blends with the rest of the body over that width.
    pub fn new(region: Region, blend: f64) -> Part {
        Part { region, blend, blobs: Vec::new() }
    }

    /// Adds a solid.
    pub fn add(&mut self, blend: f64, shape: Shape) {
        self.blobs.push(Blob { op: Op::Add, blend, crease: 0.0, shape });
    }

    /// Takes a solid away.
    pub fn cut(&mut self, blend: f64, shape: Shape) {
        self.blobs.push(Blob { op: Op::Cut, blend, crease: 0.0, shape });
    }

    /// Raises the skin around the core of a solid by so many metres, or lowers it; see [`Op::Swell`].
    pub fn swell(&mut self, height: f64, shape: Shape) {
        if height != 0.0 {
            self.blobs.push(Blob { op: Op::Swell(height), blend: 0.0, crease: 0.0, shape });
        }
    }

    /// Rounds the crease that the last shape makes with its mirror image.
    pub fn meeting(&mut self, crease: f64) {
        if let Some(last) = self.blobs.last_mut() {
            last.crease = crease;
        }
    }
}
