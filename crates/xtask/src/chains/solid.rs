//! Triangles with normals, and their text as an OBJ file.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use glam::DVec3;

/// A closed surface.
#[derive(Clone, Default, Debug)]
pub struct Solid {
    /// Corners of each triangle, counter-clockwise from outside: place and normal.
    corners: Vec<[(DVec3, DVec3); 3]>,
}

impl Solid {
    /// Adds a triangle, unless two of its corners are one.
    pub fn triangle(&mut self, corners: [(DVec3, DVec3); 3]) {
        let at = corners.map(|c| rounded(c.0));
        if at[0] != at[1] && at[1] != at[2] && at[2] != at[0] {
            self.corners.push(corners);
        }
    }

    /// Adds a quadrangle, counter-clockwise from outside.
    pub fn quad(&mut self, [a, b, c, d]: [(DVec3, DVec3); 4]) {
        self.triangle([a, b, c]);
        self.triangle([a, c, d]);
    }

    /// Both together.
    #[must_use]
    pub fn and(mut self, other: Solid) -> Solid {
        self.corners.extend(other.corners);
        self
    }

    /// Moved.
    #[must_use]
    pub fn at(mut self, by: DVec3) -> Solid {
        self.corners.iter_mut().flatten().for_each(|(place, _)| *place += by);
        self
    }

    /// With y and z exchanged for z and -y: what stood along z lies along y.
    #[must_use]
    pub fn lying(mut self) -> Solid {
        let lay = |v: DVec3| DVec3::new(v.x, v.z, -v.y);
        self.corners.iter_mut().flatten().for_each(|(p, n)| (*p, *n) = (lay(*p), lay(*n)));
        self
    }

    /// How many triangles there are.
    pub fn triangles(&self) -> usize {
        self.corners.len()
    }

    /// The text of an OBJ file: tenths of a millimetre, one line for each place and normal that differ.
    pub fn obj(&self) -> String {
        let (mut places, mut normals) = (Numbered::default(), Numbered::default());
        let mut faces = String::new();
        for corners in &self.corners {
            let _ = write!(faces, "f");
            for (place, normal) in corners {
                let (p, n) = (places.number(rounded(*place)), normals.number(rounded(*normal)));
                let _ = write!(faces, " {p}//{n}");
            }
            faces.push('\n');
        }
        format!("{}{}{faces}", places.lines("v"), normals.lines("vn"))
    }

    /// Edges that have no partner running the other way.
    #[cfg(test)]
    pub fn open_edges(&self) -> usize {
        let mut count: BTreeMap<[[i64; 3]; 2], i64> = BTreeMap::new();
        for corners in &self.corners {
            let at = corners.map(|c| rounded(c.0));
            for i in 0..3 {
                let (a, b) = (at[i], at[(i + 1) % 3]);
                *count.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
            }
        }
        count.values().filter(|n| **n != 0).count()
    }

    /// Cubic metres inside; negative if the triangles face inward.
    #[cfg(test)]
    pub fn volume(&self) -> f64 {
        self.corners.iter().map(|[a, b, c]| a.0.dot(b.0.cross(c.0)) / 6.0).sum()
    }
}

/// In tenths of a thousandth.
fn rounded(v: DVec3) -> [i64; 3] {
    v.to_array().map(|c| (c * 1e4).round() as i64)
}

/// Things numbered from 1 in the order in which they came.
#[derive(Default)]
struct Numbered {
    numbers: BTreeMap<[i64; 3], usize>,
    order: Vec<[i64; 3]>,
}

impl Numbered {
    fn number(&mut self, v: [i64; 3]) -> usize {
        *self.numbers.entry(v).or_insert_with(|| {
            self.order.push(v);
            self.order.len()
        })
    }

    fn lines(&self, word: &str) -> String {
        let line = |v: &[i64; 3]| {
            let [x, y, z] = v.map(|c| c as f64 / 1e4);
            format!("{word} {x} {y} {z}\n")
        };
        self.order.iter().map(line).collect()
    }
}
